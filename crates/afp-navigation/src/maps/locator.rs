//! Localisation as a sensor: the platform's part of a
//! [`Localisation`](afp_carbot::devices::Localisation).
//!
//! The platform passes it each echo. The filter runs as a job, so that no poll waits for it, and
//! the odometry updates its latest belief.

use crate::maps::filter::{Filter, Ping, relative, wrap};
use afp_carbot::devices::{Belief, Echo, Invalid, Motion, Reading};
use afp_carbot::history::{History, Pose};
use afp_core::quantity::{Angle, Length};
use afp_core::{Duration, Fault, Instant, Job, Poll, Ticket, Worker};
use afp_session::Pose2;

/// The maximum number of pings that wait for the filter: most of a second. The oldest are dropped.
const WAITING: usize = 16;

/// A filter and its next pings.
#[derive(Clone, Debug)]
pub struct LocateJob {
    filter: Filter,
    pings: Vec<Ping>,
}

impl LocateJob {
    /// A job with this filter.
    pub fn new(filter: Filter) -> Self {
        LocateJob { filter, pings: Vec::with_capacity(WAITING) }
    }
}

impl Job for LocateJob {
    /// Ten times the time of a desktop core for a ping of a lost robot.
    const TAKES: Duration = Duration::from_millis(5);

    fn run(&mut self) -> Result<(), Fault> {
        self.pings.iter().for_each(|ping| self.filter.update(ping));
        Ok(())
    }
}

/// Locates the robot on its map.
#[derive(Clone, Debug)]
pub struct Locator<W> {
    worker: W,
    history: History,
    /// The time of the last handled ping.
    heard: Option<Instant>,
    waiting: Vec<Ping>,
    under_way: Option<(Ticket, Pose)>,
    failed: Option<Fault>,
    /// The last belief, and its odometry.
    believed: (Belief, Pose),
}

impl<W: Worker<LocateJob>> Locator<W> {
    /// A locator for a worker with one slot, whose filter knows this start.
    pub fn new(worker: W, start: Pose2) -> Self {
        let belief = Belief {
            x: Length::from_si(start.x),
            y: Length::from_si(start.y),
            heading: Angle::from_si(start.heading),
            spread: Length::from_si(0.0),
            heading_spread: Angle::from_si(0.0),
        };
        Locator {
            worker,
            history: History::new(),
            heard: None,
            waiting: Vec::with_capacity(WAITING),
            under_way: None,
            failed: None,
            believed: (belief, Pose { x: 0.0, y: 0.0, heading: 0.0 }),
        }
    }

    /// Handles the readings of range sensor and odometry if they are new. Call it for each echo,
    /// even if the belief is not used.
    pub fn on_echo(&mut self, echo: Reading<Echo>, motion: Reading<Motion>, now: Instant) {
        self.history.note(motion);
        if self.heard.is_none_or(|last| echo.time > last)
            && let Ok((Echo { distance, bearing }, robot)) = self.history.placed(echo).value
        {
            self.heard = Some(echo.time);
            if self.waiting.len() == WAITING {
                self.waiting.remove(0);
            }
            let distance = distance.map(Length::si);
            self.waiting.push(Ping { robot, bearing: bearing.si(), distance });
        }
        self.fetch(now);
        if let Err(fault) = self.begin(now) {
            self.failed = Some(fault);
        }
    }

    /// The robot's place, from the echoes and the later odometry.
    ///
    /// # Errors
    /// The job panicked.
    pub fn belief(
        &mut self,
        motion: Reading<Motion>,
        now: Instant,
    ) -> Result<Reading<Belief>, Fault> {
        self.fetch(now);
        self.failed.map_or(Ok(()), Err)?;
        Ok(self.latest(motion))
    }

    /// The latest belief, without checking the worker.
    pub fn latest(&self, motion: Reading<Motion>) -> Reading<Belief> {
        let (belief, at) = self.believed;
        let carried = motion.value.map(|motion| carried(belief, at, motion.into()));
        let finite = |belief: &Belief| belief.x.si().is_finite() && belief.y.si().is_finite();
        let value =
            carried.and_then(|belief| Some(belief).filter(finite).ok_or(Invalid::NotFinite));
        Reading { time: motion.time, value }
    }

    /// The robot's place at an instant of the last half second, by the present belief.
    pub fn belief_at(&self, when: Instant) -> Option<Belief> {
        let (belief, at) = self.believed;
        self.history.at(when).map(|pose| carried(belief, at, pose))
    }

    fn fetch(&mut self, now: Instant) {
        let Some((ticket, at)) = self.under_way else { return };
        match self.worker.poll(ticket, now) {
            Ok(Poll::Pending) => return,
            Ok(Poll::Ready(job)) => self.believed = (job.filter.belief(), at),
            Err(fault) => self.failed = Some(fault),
        }
        self.under_way = None;
    }

    fn begin(&mut self, now: Instant) -> Result<(), Fault> {
        let Some(last) = self.waiting.last().filter(|_| self.under_way.is_none()) else {
            return Ok(());
        };
        let (at, waiting) = (last.robot, &self.waiting);
        let mut prepare = |job: &mut LocateJob| job.pings.clone_from(waiting);
        if let Some(ticket) = self.worker.begin(now, &mut prepare)? {
            self.under_way = Some((ticket, at));
            self.waiting.clear();
        }
        Ok(())
    }
}

/// A belief, moved from one odometry pose to another.
fn carried(belief: Belief, from: Pose, to: Pose) -> Belief {
    let pose = Pose2 { x: belief.x.si(), y: belief.y.si(), heading: belief.heading.si() };
    let Pose2 { x, y, heading } = pose.beyond(relative(from, to));
    let heading = Angle::from_si(wrap(heading));
    Belief { x: Length::from_si(x), y: Length::from_si(y), heading, ..belief }
}
