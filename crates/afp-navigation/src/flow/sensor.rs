//! A camera's flow as a sensor: the platform's part of a
//! [`FlowCamera`](afp_carbot::devices::FlowCamera).

use super::{FlowJob, OpticalFlow, Picture};
use afp_carbot::devices::{Flow, Frame, Grid, Invalid, Reading, Shift};
use afp_core::{Duration, Fault, Instant, Poll, Ticket, Worker};
use std::marker::PhantomData;

/// The maximum time between two compared pictures.
const APART: Duration = Duration::from_millis(250);
/// A camera with the same picture for this time is frozen.
const FROZEN: Duration = Duration::from_millis(200);

/// Compares the pictures of a camera, each with the previous one, on a worker.
#[derive(Clone)]
pub struct FlowSensor<M, W> {
    worker: W,
    /// The last two different pictures, the earlier one first.
    pictures: [Seen; 2],
    under_way: Option<UnderWay>,
    latest: Latest,
    method: PhantomData<fn() -> M>,
}

#[derive(Clone, Debug, Default)]
struct Seen {
    picture: Picture,
    /// 0 if there is no picture yet.
    number: u64,
    time: Instant,
}

#[derive(Clone, Copy, Debug)]
struct UnderWay {
    ticket: Ticket,
    time: Instant,
    span: Duration,
}

#[derive(Clone, Debug)]
struct Latest {
    /// The number of the last compared picture, even without a result.
    number: u64,
    /// The time of the flow's later picture; `None` without a flow.
    time: Option<Instant>,
    span: Duration,
    grid: Grid,
    shifts: Vec<Option<Shift>>,
}

impl<M: OpticalFlow, W: Worker<FlowJob<M>>> FlowSensor<M, W> {
    /// A sensor for pictures of this size. `worker` needs one slot for them. Larger pictures
    /// allocate.
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

    /// Takes the camera's present picture and compares it if it is new and the worker is free.
    /// Returns the latest flow.
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

    /// Takes a finished flow from the worker.
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

    /// Keeps a picture if it is new.
    fn see(&mut self, frame: &Frame<'_>, time: Instant) {
        let [older, newer] = &mut self.pictures;
        if frame.number == newer.number {
            return;
        }
        older.picture.take(frame);
        if older.picture == newer.picture && newer.number != 0 {
            // The same picture with a new number: only a broken camera repeats a picture.
            older.number = 0;
            return;
        }
        (older.number, older.time) = (frame.number, time);
        self.pictures.swap(0, 1);
    }

    /// Starts the comparison of the last two pictures, unless it was already done or they do not
    /// belong together.
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

    /// The latest flow, for a camera reading with this time.
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
