//! What it knows of places, and what it shows.

use super::{Fake, reading};
use crate::devices::{Belief, Localisation, Odometry, PathPlanner, Reading, Signals, Trip};
use crate::motion::wrap;
use crate::path::Path;
use afp_core::quantity::{Angle, Frequency, Length};
use afp_core::{Duration, Fault, Instant, Poll, Ticket};

/// A search takes so long.
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

/// Straight on is its way.
impl PathPlanner for Fake {
    fn search(&mut self, trip: &Trip, now: Instant) -> Result<Option<Ticket>, Fault> {
        self.search = Some((now + SEARCH, *trip));
        self.searches += 1;
        Ok(Some(Ticket::new(0, u64::from(self.searches))))
    }

    fn found(&mut self, _: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault> {
        let (ready, trip) = self.search.ok_or(Fault::JOB_LOST)?;
        if now < ready {
            return Ok(Poll::Pending);
        }
        self.search = None;
        let places = [trip.from, trip.to].map(|(x, y)| [x.si(), y.si()]);
        Ok(Poll::Ready(if self.no_way { None } else { Some(Path::new(places)?) }))
    }
}

impl Signals for Fake {
    fn signal(&mut self, light: bool, tone: Option<Frequency>, _: Instant) {
        self.signals.push((light, tone));
    }
}
