//! Paths on the map, to a place or to a viewpoint: the platform's part of a
//! [`PathPlanner`](afp_carbot::devices::PathPlanner).
//!
//! The platform passes it each echo and each bump, with the robot's estimated place. Paths avoid
//! obstacles that are missing on the map. The search runs as a job.

use crate::maps::field::EchoField;
use crate::maps::found::{self, Finds, Heard};
use crate::maps::grid::Grid;
use crate::maps::room::Room;
use crate::maps::{search, view};
use afp_carbot::Path;
use afp_carbot::devices::{Aim, Belief, Body, Echo, Trip};
use afp_core::quantity::Length;
use afp_core::{Duration, Fault, Instant, Job, Poll, Ticket, Worker};
use afp_session::Pose2;
use std::sync::Arc;

/// The maximum uncertainty of a place for handling its echoes, in metres.
const CERTAIN: f64 = 0.25;

/// The additional distance of found obstacles, in metres: first none, and if no path is left, the
/// error of an echo and a belief.
const DOUBTED: [f64; 2] = [0.0, 0.1];

/// A robot within this distance of its path is on it, in metres.
const ON_IT: f64 = 0.1;

/// The input of a search: the found obstacles, and the goal.
#[derive(Clone, Debug, PartialEq)]
struct Quest {
    found: Vec<[f64; 2]>,
    goal: Goal,
    /// The places of earlier views.
    seen: Vec<[f64; 2]>,
}

/// The goal of a search, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    Place { at: [f64; 2], near: f64 },
    View { sight: f64 },
}

impl Quest {
    /// A quest with all buffers: later requests allocate nothing.
    fn new() -> Self {
        let goal = Goal::Place { at: [0.0; 2], near: 0.0 };
        let [found, seen] = [found::MOST, Path::MOST].map(Vec::with_capacity);
        Quest { found, goal, seen }
    }

    fn set(&mut self, aim: &Aim<'_>, found: impl Iterator<Item = [f64; 2]>) {
        self.found.clear();
        self.found.extend(found);
        self.seen.clear();
        self.goal = match aim {
            Aim::Place { at, near } => Goal::Place { at: [at.0.si(), at.1.si()], near: near.si() },
            Aim::View { seen, sight } => {
                self.seen.extend(seen.places());
                Goal::View { sight: sight.si() }
            }
        };
    }
}

/// A path search and its data.
#[derive(Clone, Debug)]
pub struct SearchJob {
    map: Arc<Grid>,
    grid: Grid,
    from: [f64; 2],
    quest: Quest,
    path: Option<Path>,
    /// The input of the last search.
    last: Quest,
}

impl SearchJob {
    fn new(map: Arc<Grid>) -> Self {
        let [quest, last] = [Quest::new(), Quest::new()];
        SearchJob { grid: (*map).clone(), map, from: [0.0; 2], quest, path: None, last }
    }

    /// The goal of the path, and the tolerance; `None` if there is no viewpoint.
    fn goal(&self) -> Option<([f64; 2], f64)> {
        match self.quest.goal {
            Goal::Place { at, near } => Some((at, near)),
            Goal::View { sight } => {
                let place = view::best(&self.grid, self.from, &self.quest.seen, sight)?;
                Some((place, 0.0))
            }
        }
    }

    /// The rest of the last path if it is still valid: no new obstacle was found, and the robot is
    /// on it.
    fn rest_of_the_last(&self) -> Option<Path> {
        let path = self.path.as_ref().filter(|_| self.last == self.quest)?;
        let rest = path.rest_from(self.from, ON_IT)?;
        let next = rest.places().nth(1)?;
        search::is_free(&self.grid, self.from, next).then_some(rest)
    }
}

impl Job for SearchJob {
    /// Several times the time of a desktop core for a failing search on a map of ten metres by ten.
    const TAKES: Duration = Duration::from_millis(60);

    fn run(&mut self) -> Result<(), Fault> {
        if let Some(rest) = self.rest_of_the_last() {
            self.path = Some(rest);
            return Ok(());
        }
        self.last.clone_from(&self.quest);
        self.path = None;
        for doubted in DOUBTED {
            self.grid.clone_clearance(&self.map);
            self.quest.found.iter().for_each(|place| self.grid.add(*place, doubted));
            if let Some((to, near)) = self.goal() {
                self.path = search::path(&self.grid, self.from, to, near)?;
            }
            if self.path.is_some() || self.quest.found.is_empty() {
                break;
            }
        }
        Ok(())
    }
}

/// Plans paths on a map.
#[derive(Clone, Debug)]
pub struct Planner<W> {
    worker: W,
    field: EchoField,
    finds: Finds,
    /// The distance from the robot's centre to the range sensor, in metres.
    forward: f64,
}

impl<W: Worker<SearchJob>> Planner<W> {
    /// A planner for a robot with this body and with its range sensor `forward` of its middle, on
    /// the map of a field. `make_worker` creates a worker from its jobs.
    pub fn new(
        field: EchoField,
        body: &Body,
        forward: Length,
        make_worker: impl FnOnce(Vec<SearchJob>) -> W,
    ) -> Self {
        /// Two elements of a plan may search at the same time.
        const SLOTS: usize = 2;
        let map = Arc::new(Grid::new(field.map(), Room::of(body)));
        let worker = make_worker((0..SLOTS).map(|_| SearchJob::new(map.clone())).collect());
        Planner { worker, field, finds: Finds::new(body), forward: forward.si() }
    }

    /// Handles an echo from a ping at the robot's estimated place.
    pub fn on_echo(&mut self, echo: &Echo, robot: &Belief, now: Instant) {
        let Some(distance) = echo.distance.filter(|_| is_certain(robot)) else { return };
        let robot = pose(robot);
        let sensor = robot.beyond(Pose2 { x: self.forward, y: 0.0, heading: echo.bearing.si() });
        let heard = Heard {
            sensor: [sensor.x, sensor.y],
            direction: sensor.heading,
            distance: distance.si(),
        };
        self.finds.on_echo(&heard, &self.field, now);
    }

    /// Handles an obstacle directly ahead of the robot's estimated place: its bumper is pressed, or
    /// its drive is blocked.
    pub fn on_bump(&mut self, robot: &Belief, now: Instant) {
        if is_certain(robot) {
            self.finds.on_bump(pose(robot), now);
        }
    }

    /// Like [`PathPlanner::search`](afp_carbot::devices::PathPlanner::search).
    ///
    /// # Errors
    /// Searches have panicked.
    pub fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault> {
        let finds = &self.finds;
        let mut prepare = |job: &mut SearchJob| {
            job.from = [trip.from.0.si(), trip.from.1.si()];
            job.quest.set(&trip.to, finds.places(now));
        };
        self.worker.begin(now, &mut prepare)
    }

    /// Like [`PathPlanner::found`](afp_carbot::devices::PathPlanner::found).
    ///
    /// # Errors
    /// The search failed, or its result was already taken.
    pub fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault> {
        Ok(match self.worker.poll(ticket, now)? {
            Poll::Pending => Poll::Pending,
            Poll::Ready(job) => Poll::Ready(job.path.clone()),
        })
    }
}

fn is_certain(robot: &Belief) -> bool {
    robot.spread.si() <= CERTAIN
}

fn pose(belief: &Belief) -> Pose2 {
    Pose2 { x: belief.x.si(), y: belief.y.si(), heading: belief.heading.si() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maps::map::Map;
    use crate::maps::room::tests::carbot;

    fn to_the_right() -> Aim<'static> {
        let at = (Length::from_si(3.4), Length::from_si(1.0));
        Aim::Place { at, near: Length::from_si(0.0) }
    }

    /// Whether a path leads past obstacles at these places, from left to right in a hall of four
    /// metres by two.
    fn leads_past(found: &[[f64; 2]]) -> bool {
        let wall =
            |x: [f64; 2], y: [f64; 2]| vec![[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
        let map = Map::new([wall([0.0, 4.0], [0.0, 0.1]), wall([0.0, 4.0], [1.9, 2.0])]);
        let mut job = SearchJob::new(Arc::new(Grid::new(&map, Room::of(&carbot()))));
        job.from = [0.6, 1.0];
        job.quest.set(&to_the_right(), found.iter().copied());
        job.run().expect("the path has few corners");
        job.path.is_some()
    }

    #[test]
    fn found_obstacles_shrink_by_their_error_only_if_no_path_is_left() {
        assert!(leads_past(&[]));
        // At these distances, half a metre and 30 cm, from wall to wall; the robot needs 56 cm.
        let row = |count: i32, apart: f64| -> Vec<_> {
            (0..count).map(|n| [2.0, 0.25 + apart * f64::from(n)]).collect()
        };
        assert!(leads_past(&row(4, 0.5)));
        assert!(!leads_past(&row(6, 0.3)));
    }

    #[test]
    fn a_path_is_kept_until_a_new_obstacle_is_found_or_the_robot_leaves_it() {
        let wall = |y: f64| vec![[0.0, y], [4.0, y], [4.0, y + 0.1], [0.0, y + 0.1]];
        let map = Map::new([wall(0.0), wall(1.9)]);
        let mut job = SearchJob::new(Arc::new(Grid::new(&map, Room::of(&carbot()))));
        let mut ask = |from: [f64; 2], found: &[[f64; 2]]| {
            job.from = from;
            job.quest.set(&to_the_right(), found.iter().copied());
            let kept = job.rest_of_the_last().is_some();
            job.run().expect("the path has few corners");
            (kept, job.path.is_some())
        };
        assert_eq!(ask([0.6, 1.0], &[]), (false, true));
        assert_eq!(ask([1.0, 1.05], &[]), (true, true));
        assert_eq!(ask([1.0, 1.4], &[]), (false, true));
        assert_eq!(ask([1.0, 1.4], &[[2.0, 1.0]]), (false, true));
    }
}
