//! Paths on the map, to a place or to where much comes in sight: what a platform needs to be a
//! [`PathPlanner`](afp_carbot::devices::PathPlanner).
//!
//! The platform passes it each echo and each bump, with where the robot takes itself to be; what the map does not
//! explain is avoided from then on. The search runs as a job.

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

/// A robot that knows its place no better than this knows nothing of what it hears, metres.
const CERTAIN: f64 = 0.25;

/// What was found stands so much farther away than it seems to, metres: at first not at all, and where no path is left as
/// far as an echo and a belief err.
const DOUBTED: [f64; 2] = [0.0, 0.1];

/// A robot within so many metres of its path is on it.
const ON_IT: f64 = 0.1;

/// What a search is for: what has been found so far, and where it leads.
#[derive(Clone, Debug, PartialEq)]
struct Quest {
    found: Vec<[f64; 2]>,
    goal: Goal,
    /// From where has been looked around, for a view.
    seen: Vec<[f64; 2]>,
}

/// Where a search leads, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    Place { at: [f64; 2], near: f64 },
    View { sight: f64 },
}

impl Quest {
    /// With room for all that can be asked for: who asks allocates nothing.
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

/// A search for a path, and what it needs.
#[derive(Clone, Debug)]
pub struct SearchJob {
    map: Arc<Grid>,
    grid: Grid,
    from: [f64; 2],
    quest: Quest,
    path: Option<Path>,
    /// For which the path was found.
    last: Quest,
}

impl SearchJob {
    fn new(map: Arc<Grid>) -> Self {
        let [quest, last] = [Quest::new(), Quest::new()];
        SearchJob { grid: (*map).clone(), map, from: [0.0; 2], quest, path: None, last }
    }

    /// The place that the path has to lead to, and how near to it will do; none where no view is to be had.
    fn goal(&self) -> Option<([f64; 2], f64)> {
        match self.quest.goal {
            Goal::Place { at, near } => Some((at, near)),
            Goal::View { sight } => {
                let place = view::best(&self.grid, self.from, &self.quest.seen, sight)?;
                Some((place, 0.0))
            }
        }
    }

    /// What is left of the path that was found last, where that still is one: nothing else has been found, and the robot is on it.
    fn rest_of_the_last(&self) -> Option<Path> {
        let path = self.path.as_ref().filter(|_| self.last == self.quest)?;
        let rest = path.rest_from(self.from, ON_IT)?;
        let next = rest.places().nth(1)?;
        search::is_free(&self.grid, self.from, next).then_some(rest)
    }
}

impl Job for SearchJob {
    /// Several times what a core of a desktop computer takes for a map of ten metres by ten that leads nowhere.
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

/// Searches for paths on a map.
#[derive(Clone, Debug)]
pub struct Planner<W> {
    worker: W,
    field: EchoField,
    finds: Finds,
    /// From the robot's centre to the range sensor, metres.
    forward: f64,
}

impl<W: Worker<SearchJob>> Planner<W> {
    /// For a robot with this body, its range sensor so far before its middle, on the map of a field, with a worker that
    /// `make_worker` makes of its jobs.
    pub fn new(
        field: EchoField,
        body: &Body,
        forward: Length,
        make_worker: impl FnOnce(Vec<SearchJob>) -> W,
    ) -> Self {
        /// Two elements of a plan may search at a time.
        const SLOTS: usize = 2;
        let map = Arc::new(Grid::new(field.map(), Room::of(body)));
        let worker = make_worker((0..SLOTS).map(|_| SearchJob::new(map.clone())).collect());
        Planner { worker, field, finds: Finds::new(body), forward: forward.si() }
    }

    /// Takes in an echo that was sent where the robot takes itself to have been.
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

    /// Takes in that something stands right before the robot, where it takes itself to be: its bumper is pressed, or its drive
    /// does not get ahead.
    pub fn on_bump(&mut self, robot: &Belief, now: Instant) {
        if is_certain(robot) {
            self.finds.on_bump(pose(robot), now);
        }
    }

    /// As [`PathPlanner::search`](afp_carbot::devices::PathPlanner::search).
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

    /// As [`PathPlanner::found`](afp_carbot::devices::PathPlanner::found).
    ///
    /// # Errors
    /// The search failed, or has been asked after before.
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

    /// Whether a search leads past things found at these places, in a hall of four metres by two, from its left to its right.
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
    fn what_was_found_is_doubted_where_no_way_is_left_and_only_by_as_much_as_it_may_be_off() {
        assert!(leads_past(&[]));
        // So far apart, half a metre and 30 cm, from wall to wall; the robot wants 56 cm.
        let row = |count: i32, apart: f64| -> Vec<_> {
            (0..count).map(|n| [2.0, 0.25 + apart * f64::from(n)]).collect()
        };
        assert!(leads_past(&row(4, 0.5)));
        assert!(!leads_past(&row(6, 0.3)));
    }

    #[test]
    fn a_path_is_kept_for_as_long_as_nothing_else_is_found_and_the_robot_is_on_it() {
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
