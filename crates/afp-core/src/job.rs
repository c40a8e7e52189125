//! Long computations on a worker, outside of the step.
//!
//! No poll may take long, so a component describes a long computation (a path, optical flow) as a
//! [`Job`]. A [`Worker`] runs it; the platform owns the worker and every buffer that the job needs.
//! Nothing is allocated and nothing blocks:
//!
//! ```text
//!   begin ──Some(ticket)──▶ under way ──poll: Ready──▶ over
//!     │                       │   ╲───poll: Err──────▶ over
//!    None: every slot          ╲──────cancel──────────▶ over, the result is lost
//!     is taken, ask again
//! ```
//!
//! In virtual time a job is ready after its declared time, however long the machine took, so traces
//! do not depend on the machine. The workers are in `afp-platform`.

use core::task::Poll;

use afp_types::{Duration, Instant};

use crate::{Fault, faults};

/// A long computation with its input and output buffers.
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
    /// Longest time on the slowest platform. In virtual time the job takes exactly this.
    const TAKES: Duration;

    /// Computes, on a worker. The caller of `begin` has prepared the input.
    ///
    /// # Errors
    /// [`Worker::poll`] returns the fault.
    fn run(&mut self) -> Result<(), Fault>;
}

/// Identifies a job to its worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ticket {
    slot: u16,
    round: u64,
}

impl Ticket {
    /// The `round`-th job of a slot; for implementations of workers.
    pub const fn new(slot: u16, round: u64) -> Self {
        Ticket { slot, round }
    }

    /// The slot.
    pub const fn slot(self) -> u16 {
        self.slot
    }

    /// Number of jobs of the slot so far, with this job.
    pub const fn round(self) -> u64 {
        self.round
    }
}

/// Runs jobs of one kind sequentially, in a fixed number of slots.
///
/// A component may end without fetching its job: after a second, a finished job's slot is available
/// to other jobs.
///
/// A worker for tests, which computes immediately:
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
/// # const TAKES: afp_core::Duration = afp_core::Duration::ZERO;
/// # fn run(&mut self) -> Result<(), Fault> { self.0 *= 2; Ok(()) }
/// # }
/// # let mut worker = AtOnce { job: Double(0), round: 0, done: None };
/// # let ticket = worker.begin(Instant::ZERO, &mut |job| job.0 = 4)?.expect("it is free");
/// # assert!(matches!(worker.poll(ticket, Instant::ZERO)?, Poll::Ready(Double(8))));
/// # assert_eq!(worker.poll(ticket, Instant::ZERO).err(), Some(Fault::JOB_LOST));
/// # Ok::<(), Fault>(())
/// ```
pub trait Worker<J: Job> {
    /// Lets `prepare` write the job's input, and begins it. `None` if every slot is taken; try
    /// again at the next poll.
    ///
    /// # Errors
    /// [`Fault::JOB_PANICKED`] if jobs have panicked at every slot.
    fn begin(
        &mut self,
        now: Instant,
        prepare: &mut dyn FnMut(&mut J),
    ) -> Result<Option<Ticket>, Fault>;

    /// Returns the finished job with its results, once; pending before.
    ///
    /// # Errors
    /// The fault of the job; [`Fault::JOB_PANICKED`] if it panicked; [`Fault::JOB_LOST`] if it was
    /// fetched or cancelled before or lost its slot. After an error the job is over.
    fn poll(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<&J>, Fault>;

    /// Cancels a job, for example when its actor is interrupted. The computation may continue; its
    /// result is lost. Has no effect on a job that is over.
    fn cancel(&mut self, ticket: Ticket, now: Instant);
}

impl Fault {
    faults! {
        /// A job panicked. Its slot is not used again, because its buffers may be inconsistent.
        pub JOB_PANICKED = "job-panicked", "a job on a worker panicked";
        /// The job is over.
        pub JOB_LOST = "job-lost",
            "a job was asked after that nobody had fetched in time, or that was cancelled";
    }
}
