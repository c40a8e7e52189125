//! Long computations beside the plan: handed to a worker, asked after at every poll.
//!
//! No poll may take long, so a component that has much to compute (a path, the flow of a picture)
//! describes it as a [`Job`] and hands it to a [`Worker`], which the platform owns together with
//! every buffer the job needs. Nothing is allocated and nobody waits:
//!
//! ```text
//!   begin ──Some(ticket)──▶ under way ──poll: Ready──▶ over
//!     │                       │   ╲───poll: Err──────▶ over
//!    None: every slot          ╲──────cancel──────────▶ over, the result is lost
//!     is taken, ask again
//! ```
//!
//! In virtual time a job is ready when its declared time has passed, however long the machine took,
//! so a trace is the same everywhere. The workers themselves are in `afp-platform`.

use core::task::Poll;

use afp_types::{Duration, Instant};

use crate::{Fault, faults};

/// A long computation together with its buffers: what it works on and what it gives.
///
/// ```
/// use afp_core::{Duration, Fault, Job};
///
/// struct Sum {
///     numbers: Vec<u32>,
///     sum: u32,
/// }
///
/// impl Job for Sum {
///     const TAKES: Duration = Duration::from_millis(20);
///
///     fn run(&mut self) -> Result<(), Fault> {
///         self.sum = self.numbers.iter().sum();
///         Ok(())
///     }
/// }
/// # let mut job = Sum { numbers: vec![1, 2, 3], sum: 0 };
/// # job.run()?;
/// # assert_eq!(job.sum, 6);
/// # Ok::<(), Fault>(())
/// ```
pub trait Job: Send + 'static {
    /// How long it takes at most on the slowest platform; in virtual time it takes just that.
    const TAKES: Duration;

    /// Computes, on a worker. What it works on has been written into it by whoever began it.
    ///
    /// # Errors
    /// Whoever asks after the job gets the fault.
    fn run(&mut self) -> Result<(), Fault>;
}

/// Names a job that was begun, to the worker that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticket {
    /// The worker's slot and how many jobs it has had there.
    slot: u16,
    round: u64,
}

impl Ticket {
    /// The `round`-th job at a slot; for those who implement workers.
    pub const fn new(slot: u16, round: u64) -> Self {
        Ticket { slot, round }
    }

    /// The slot.
    pub const fn slot(self) -> u16 {
        self.slot
    }

    /// How many jobs had been there, this one included.
    pub const fn round(self) -> u64 {
        self.round
    }
}

/// Does jobs of one kind, one after the other, with a fixed number of slots for them.
///
/// A component that ends without asking after its job need not tell anybody: a finished job that
/// nobody has fetched for a second gives its slot up when another needs it.
///
/// A worker for tests, which computes at once:
///
/// ```
/// use afp_core::{Fault, Instant, Job, Poll, Ticket, Worker};
///
/// struct AtOnce<J> {
///     job: J,
///     round: u64,
///     done: Option<Result<(), Fault>>,
/// }
///
/// impl<J: Job> Worker<J> for AtOnce<J> {
///     fn begin(
///         &mut self,
///         _: Instant,
///         prepare: &mut dyn FnMut(&mut J),
///     ) -> Result<Option<Ticket>, Fault> {
///         prepare(&mut self.job);
///         self.round += 1;
///         self.done = Some(self.job.run());
///         Ok(Some(Ticket::new(0, self.round)))
///     }
///
///     fn poll(&mut self, ticket: Ticket, _: Instant) -> Result<Poll<&J>, Fault> {
///         let done = self.done.take_if(|_| ticket.round() == self.round);
///         done.unwrap_or(Err(Fault::JOB_LOST)).map(|()| Poll::Ready(&self.job))
///     }
///
///     fn cancel(&mut self, _: Ticket, _: Instant) {
///         self.done = None;
///     }
/// }
/// # struct Double(u32);
/// # impl Job for Double {
/// #     const TAKES: afp_core::Duration = afp_core::Duration::ZERO;
/// #     fn run(&mut self) -> Result<(), Fault> { self.0 *= 2; Ok(()) }
/// # }
/// # let mut worker = AtOnce { job: Double(0), round: 0, done: None };
/// # let ticket = worker.begin(Instant::ZERO, &mut |job| job.0 = 4)?.expect("it is free");
/// # assert!(matches!(worker.poll(ticket, Instant::ZERO)?, Poll::Ready(Double(8))));
/// # assert_eq!(worker.poll(ticket, Instant::ZERO).err(), Some(Fault::JOB_LOST));
/// # Ok::<(), Fault>(())
/// ```
pub trait Worker<J: Job> {
    /// Lets `prepare` write what a job works on into its buffers, and begins it. None if every slot
    /// is taken; the same can be asked for again at the next poll.
    ///
    /// # Errors
    /// [`Fault::JOB_PANICKED`] when jobs have panicked at every slot.
    fn begin(
        &mut self,
        now: Instant,
        prepare: &mut dyn FnMut(&mut J),
    ) -> Result<Option<Ticket>, Fault>;

    /// The job with its results, once; pending while it is under way.
    ///
    /// # Errors
    /// The fault of the job; [`Fault::JOB_PANICKED`] if it panicked; [`Fault::JOB_LOST`] if it was
    /// fetched or cancelled before or gave up its slot. All of them end the job.
    fn poll(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<&J>, Fault>;

    /// Gives up a job, which may go on computing for nobody; an actor does so when it is
    /// interrupted. One that is over already is none of the ticket's business.
    fn cancel(&mut self, ticket: Ticket, now: Instant);
}

impl Fault {
    faults! {
        /// A job panicked. Its slot is not used again, for who knows what it left in its buffers.
        pub JOB_PANICKED = "job-panicked", "a job on a worker panicked";
        /// A job that was asked after is over already.
        pub JOB_LOST = "job-lost",
            "a job was asked after that nobody had fetched in time, or that was cancelled";
    }
}
