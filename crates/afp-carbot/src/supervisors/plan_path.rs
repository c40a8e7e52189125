//! Plan the path to a place repeatedly.

use crate::devices::{Aim, Localisation, Odometry, PathPlanner, Trip};
use crate::helpers::guard::{Guard, NO_ODOMETRY, NO_POSITION};
use crate::templates;
use crate::templates::plan_path::{Event, Inputs, Live};
use afp_core::quantity::Length;
use afp_core::{Duration, Events, Fault, Instant, Poll, Supervisor, Ticket};

/// Lets the platform search from the robot's estimated position, and reports the result.
#[derive(Clone, Debug)]
pub struct PlanPath {
    near: Length,
    period: Duration,
    odometry: Guard,
    position: Guard,
    /// Time of the next search.
    next: Instant,
    under_way: Option<Ticket>,
}

impl<E: Odometry + Localisation + PathPlanner + ?Sized> Supervisor<templates::PlanPath, E>
    for PlanPath
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.belief(now)?;
        Ok(PlanPath {
            near: inputs.near,
            period: inputs.period.duration(),
            odometry: Guard::new(NO_ODOMETRY, now),
            position: Guard::new(NO_POSITION, now),
            next: now,
            under_way: None,
        })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        self.odometry.current(env.motion(), now)?;
        let reading = env.belief(now)?;
        let here = self.position.current(reading, now)?;
        if let Some(ticket) = self.under_way {
            let Poll::Ready(path) = env.found(ticket, now)? else { return Ok(None) };
            self.under_way = None;
            return Ok(match path {
                Some(path) if wanted.contains(0) => Some(Event::PathFound { path }),
                None if wanted.contains(1) => Some(Event::NoPath),
                _ => None,
            });
        }
        if let Some(here) = here.filter(|_| now >= self.next) {
            let to = Aim::Place { at: (live.x, live.y), near: self.near };
            let trip = Trip { from: (here.x, here.y), to };
            self.under_way = env.search(&trip, now)?;
            if self.under_way.is_some() {
                self.next = now + self.period;
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::Time;

    fn plan(robot: &mut Fake, wanted: u64, millis: u64) -> Result<Option<Event>, Fault> {
        let inputs = Inputs { near: Length::from_si(0.1), period: Time::from_si(1.0) };
        let live = || Live { x: Length::from_si(2.0), y: Length::from_si(1.0) };
        robot.watch::<templates::PlanPath, PlanPath>(inputs, live, wanted, millis)
    }

    #[test]
    fn the_path_begins_at_the_robot() {
        let mut robot = Fake::new(&[]);
        robot.map_offset = [0.5, 0.0];
        let Ok(Some(Event::PathFound { path })) = plan(&mut robot, 3, 1000) else {
            panic!("no way")
        };
        assert_eq!(path.places().collect::<std::vec::Vec<_>>(), [[0.5, 0.0], [2.0, 1.0]]);
        // A search takes 50 ms.
        assert_eq!(robot.millis(), 60);
    }

    #[test]
    fn an_unreachable_goal_is_reported() {
        let mut robot = Fake::new(&[]);
        robot.no_way = true;
        assert!(matches!(plan(&mut robot, 3, 1000), Ok(Some(Event::NoPath))));
    }

    #[test]
    fn an_ignored_path_is_searched_again_after_the_period() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(plan(&mut robot, 2, 3200), Ok(None)));
        assert_eq!(robot.searches, 4);
    }

    #[test]
    fn silence_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_localisation = true;
        assert_eq!(plan(&mut robot, 3, 1000).map(|_| ()), Err(NO_POSITION));
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(plan(&mut robot, 3, 1000).map(|_| ()), Err(NO_ODOMETRY));
    }
}
