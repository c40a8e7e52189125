//! Choose the place on the map to look around from next.

use crate::devices::{Aim, Localisation, Navigator, Odometry, PathPlanner, Trip};
use crate::helpers::guard::{Guard, NO_ODOMETRY, NO_POSITION};
use crate::objects::Path;
use crate::templates;
use crate::templates::choose_view::{Inputs, Live, State};
use afp_core::quantity::Length;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable, Ticket};

/// Lets the platform search from the robot's estimated position.
#[derive(Clone, Debug)]
pub struct ChooseView {
    seen: Path,
    sight: Length,
    odometry: Guard,
    position: Guard,
    /// The search and its first place, metres.
    under_way: Option<(Ticket, [f64; 2])>,
}

impl<E> Actor<templates::ChooseView, E> for ChooseView
where
    E: Navigator + Odometry + Localisation + PathPlanner + ?Sized,
{
    fn start(inputs: Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        env.belief(now)?;
        Ok(ChooseView {
            seen: inputs.seen.clone(),
            sight: inputs.sight,
            odometry: Guard::new(NO_ODOMETRY, now),
            position: Guard::new(NO_POSITION, now),
            under_way: None,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        env.halt(now);
        self.odometry.current(env.motion(), now)?;
        let reading = env.belief(now)?;
        let here = self.position.current(reading, now)?;
        if let Some((ticket, from)) = self.under_way {
            let Poll::Ready(path) = env.found(ticket, now)? else { return Ok(Poll::Pending) };
            let end = path.as_ref().and_then(Path::end);
            self.seen.note(from);
            return Ok(Poll::Ready(end.map_or(State::NoView, |end| {
                let [x, y] = end.map(Length::from_si);
                State::ViewChosen { x, y, next: self.seen.clone() }
            })));
        }
        if let Some(here) = here {
            let to = Aim::View { seen: &self.seen, sight: self.sight };
            let ticket = env.search(&Trip { from: (here.x, here.y), to }, now)?;
            self.under_way = ticket.map(|ticket| (ticket, [here.x.si(), here.y.si()]));
        }
        Ok(Poll::Pending)
    }

    halts_when_interrupted!();
}

/// The search begins again, because its result may be gone.
impl<E> Resumable<templates::ChooseView, E> for ChooseView
where
    E: Navigator + Odometry + Localisation + PathPlanner + ?Sized,
{
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        self.under_way = None;
        Ok(())
    }

    fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
        self.odometry.restart(now);
        self.position.restart(now);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use std::vec::Vec;

    fn choose(robot: &mut Fake, seen: &Path) -> Result<Option<State>, Fault> {
        let inputs = Inputs { seen, sight: Length::from_si(4.0) };
        robot.run::<templates::ChooseView, ChooseView>(inputs, || Live {}, 3)
    }

    #[test]
    fn the_next_place_is_returned_and_the_place_of_the_robot_is_remembered() {
        let mut robot = Fake::new(&[]);
        robot.map_offset = [0.5, 0.25];
        robot.view = [2.0, 1.0];
        let seen = Path::new([[3.0, 3.0]]).unwrap();
        let Ok(Some(State::ViewChosen { x, y, next })) = choose(&mut robot, &seen) else {
            panic!("no view");
        };
        assert_eq!((x.si(), y.si()), (2.0, 1.0));
        assert_eq!(next.places().collect::<Vec<_>>(), [[3.0, 3.0], [0.5, 0.25]]);
        // A search takes 50 ms.
        assert_eq!((robot.millis(), robot.command), (60, (0.0, 0.0)));
    }

    #[test]
    fn a_robot_without_progress_gets_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.no_way = true;
        assert!(matches!(choose(&mut robot, &Path::default()), Ok(Some(State::NoView))));
    }

    #[test]
    fn silence_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_localisation = true;
        assert_eq!(choose(&mut robot, &Path::default()).map(|_| ()), Err(NO_POSITION));
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        assert_eq!(choose(&mut robot, &Path::default()).map(|_| ()), Err(NO_ODOMETRY));
    }
}
