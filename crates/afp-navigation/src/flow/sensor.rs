//! A camera's flow as a sensor: what a platform needs to be a
//! [`FlowCamera`](afp_carbot::devices::FlowCamera).

use super::{FlowJob, OpticalFlow, Picture};
use afp_carbot::devices::{Flow, Frame, Grid, Invalid, Reading, Shift};
use afp_core::{Duration, Fault, Instant, Poll, Ticket, Worker};
use std::marker::PhantomData;

/// Pictures farther apart than this are not compared: too much has happened.
const APART: Duration = Duration::from_millis(250);
/// A camera that has said the same picture for this long is frozen.
const FROZEN: Duration = Duration::from_millis(200);

/// Compares the pictures of a camera, each with the one before, on a worker.
#[derive(Clone)]
pub struct FlowSensor<M, W> {
    worker: W,
    /// The last two pictures that differ, the earlier one first.
    pictures: [Seen; 2],
    under_way: Option<UnderWay>,
    latest: Latest,
    method: PhantomData<fn() -> M>,
}

/// A picture with its number and time.
#[derive(Clone, Debug, Default)]
struct Seen {
    picture: Picture,
    /// 0 when there is none yet.
    number: u64,
    time: Instant,
}

/// The comparison that the worker has.
#[derive(Clone, Copy, Debug)]
struct UnderWay {
    ticket: Ticket,
    time: Instant,
    span: Duration,
}

/// The latest flow.
#[derive(Clone, Debug)]
struct Latest {
    /// The number of the picture that was compared last, whatever came of it.
    number: u64,
    /// The time of the flow's later picture; none when there is no flow yet.
    time: Option<Instant>,
    span: Duration,
    grid: Grid,
    shifts: Vec<Option<Shift>>,
}

impl<M: OpticalFlow, W: Worker<FlowJob<M>>> FlowSensor<M, W> {
    /// For pictures of this size, which `worker` has slots for; one is enough. A camera with larger
    /// pictures makes it allocate.
    pub fn new(width: usize, height: usize, worker: W) -> Self {
        let grid = super::grid(width, height);
        let seen = || Seen { picture: Picture::new(width, height), ..Seen::default() };
        let latest = Latest {
            number: 0,
            time: None,
            span: Duration::ZERO,
            grid,
            shifts: vec![None; grid.len()],
        };
        FlowSensor {
            worker,
            pictures: [seen(), seen()],
            under_way: None,
            latest,
            method: PhantomData,
        }
    }

    /// Looks at what the camera says now, begins to compare it if it is new and the worker has nothing
    /// else to do, and gives the latest flow there is.
    ///
    /// # Errors
    /// The fault of the computation.
    pub fn look(
        &mut self,
        frame: Reading<Frame<'_>>,
        now: Instant,
    ) -> Result<Reading<Flow<'_>>, Fault> {
        self.fetch(now)?;
        let picture = match frame.value {
            Ok(picture) => picture,
            Err(reason) => return Ok(Reading::invalid(reason, frame.time)),
        };
        self.see(&picture, frame.time);
        self.begin(now)?;
        Ok(self.reading(frame.time))
    }

    /// Takes the flow that the worker has finished.
    fn fetch(&mut self, now: Instant) -> Result<(), Fault> {
        let Some(UnderWay { ticket, time, span }) = self.under_way else { return Ok(()) };
        let polled = self.worker.poll(ticket, now);
        if !matches!(polled, Ok(Poll::Pending)) {
            self.under_way = None;
        }
        if let Poll::Ready(job) = polled? {
            self.latest.grid = job.grid;
            self.latest.shifts.clone_from(&job.shifts);
            (self.latest.time, self.latest.span) = (Some(time), span);
        }
        Ok(())
    }

    /// Keeps a picture if it is a new one.
    fn see(&mut self, frame: &Frame<'_>, time: Instant) {
        let [older, newer] = &mut self.pictures;
        if frame.number == newer.number {
            return;
        }
        older.picture.take(frame);
        if older.picture == newer.picture && newer.number != 0 {
            // Another number on the same picture: no camera without a fault sees twice the same.
            older.number = 0;
            return;
        }
        (older.number, older.time) = (frame.number, time);
        self.pictures.swap(0, 1);
    }

    /// Lets the worker compare the last two pictures, unless that has been done or they do not belong
    /// together.
    fn begin(&mut self, now: Instant) -> Result<(), Fault> {
        let [before, after] = &self.pictures;
        let span = after.time.since(before.time);
        let news = after.number != self.latest.number && before.number != 0;
        if self.under_way.is_some() || !news || span == Duration::ZERO || span > APART {
            return Ok(());
        }
        let mut prepare = |job: &mut FlowJob<M>| job.prepare(&before.picture, &after.picture);
        if let Some(ticket) = self.worker.begin(now, &mut prepare)? {
            self.under_way = Some(UnderWay { ticket, time: after.time, span });
            self.latest.number = after.number;
        }
        Ok(())
    }

    /// The latest flow, for a camera whose reading has this time.
    fn reading(&self, time: Instant) -> Reading<Flow<'_>> {
        let Latest { span, grid, ref shifts, .. } = self.latest;
        if time.since(self.pictures[1].time) > FROZEN {
            return Reading::invalid(Invalid::Frozen, time);
        }
        match self.latest.time {
            Some(time) => Reading::valid(Flow { grid, shifts, span }, time),
            None => Reading::invalid(Invalid::NotYet, time),
        }
    }
}
