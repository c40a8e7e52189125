//! Positions, searches and signals of the test robot.

use super::{Fake, reading};
use crate::devices::{Aim, Belief, Localisation, Odometry, PathPlanner, Reading, Signals, Trip};
use crate::helpers::motion::wrap;
use crate::objects::Path;
use afp_core::quantity::{Angle, Frequency, Length};
use afp_core::{Duration, Fault, Instant, Poll, Ticket};

/// Duration of a search.
const SEARCH: Duration = Duration::from_millis(50);

impl Localisation for Fake {
    fn belief(&mut self, now: Instant) -> Result<Reading<Belief>, Fault> {
        let [x, y] = self.map_offset;
        let spread = if self.millis() < self.lost_from { self.spread } else { 5.0 };
        let belief = self.motion().value.map(|motion| Belief {
            x: motion.x + Length::from_si(x),
            y: motion.y + Length::from_si(y),
            heading: Angle::from_si(wrap(motion.heading.si())),
            spread: Length::from_si(spread),
            heading_spread: Angle::from_si(self.spread),
        });
        let dead = reading(self.dead_localisation, (), now).value;
        Ok(Reading { time: now, value: dead.and(belief) })
    }
}

/// Every path is a straight line.
impl PathPlanner for Fake {
    fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault> {
        let to = match trip.to {
            Aim::Place { at: (x, y), .. } => [x.si(), y.si()],
            Aim::View { .. } => self.view,
        };
        let from = [trip.from.0.si(), trip.from.1.si()];
        let path = if self.no_way { None } else { Some(Path::new([from, to])?) };
        self.search = Some((now + SEARCH, path));
        self.searches += 1;
        Ok(Some(Ticket::new(0, u64::from(self.searches))))
    }

    fn found(&mut self, _: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault> {
        let (ready, path) = self.search.take().ok_or(Fault::JOB_LOST)?;
        if now < ready {
            self.search = Some((ready, path));
            return Ok(Poll::Pending);
        }
        Ok(Poll::Ready(path))
    }
}

impl Signals for Fake {
    fn signal(&mut self, light: bool, tone: Option<Frequency>, _: Instant) {
        self.signals.push((light, tone));
    }
}
