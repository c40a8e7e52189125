//! A worker in virtual time.

use super::attempt;
use super::slots::Slots;
use afp_core::{Fault, Instant, Job, Poll, Ticket, Worker};
use std::collections::VecDeque;

/// Runs jobs on demand and delivers each after its declared time, one after the other: like one
/// thread that is as fast as declared on every machine.
///
/// ```
/// use afp_core::{Duration, Fault, Instant, Job, Poll, Worker};
/// use afp_platform::VirtualWorker;
///
/// struct Sum { numbers: Vec<u32>, sum: u32 }
/// impl Job for Sum {
///     const TAKES: Duration = Duration::from_millis(20);
///     fn run(&mut self) -> Result<(), Fault> {
///         self.sum = self.numbers.iter().sum();
///         Ok(())
///     }
/// }
///
/// let mut worker = VirtualWorker::new([Sum { numbers: vec![0; 3], sum: 0 }]);
/// let at = |ms| Instant::ZERO + Duration::from_millis(ms);
/// let fill = &mut |job: &mut Sum| job.numbers.copy_from_slice(&[1, 2, 3]);
/// let ticket = worker.begin(at(100), fill)?.expect("the slot is free");
/// assert!(matches!(worker.poll(ticket, at(119))?, Poll::Pending));
/// assert!(matches!(worker.poll(ticket, at(120))?, Poll::Ready(job) if job.sum == 6));
/// # Ok::<(), Fault>(())
/// ```
#[derive(Clone, Debug)]
pub struct VirtualWorker<J> {
    jobs: Vec<J>,
    slots: Slots,
    /// Jobs under way with their times of completion; the first is current.
    under_way: VecDeque<(Instant, Ticket)>,
    /// Completion time of all jobs.
    free: Instant,
}

impl<J: Job> VirtualWorker<J> {
    /// Makes a worker with a slot for each of these jobs, whose buffers are reused.
    ///
    /// # Panics
    /// With more than 65536 jobs.
    pub fn new(jobs: impl IntoIterator<Item = J>) -> Self {
        let jobs: Vec<J> = jobs.into_iter().collect();
        VirtualWorker {
            slots: Slots::new(jobs.len()),
            under_way: VecDeque::with_capacity(jobs.len()),
            jobs,
            free: Instant::ZERO,
        }
    }

    /// Runs the due jobs, in order of submission.
    fn run_due(&mut self, now: Instant) {
        while let Some((ready, ticket)) = self.under_way.pop_front_if(|(ready, _)| *ready <= now) {
            let job = self.jobs.get_mut(usize::from(ticket.slot()));
            let awaited = self.slots.awaited(ticket);
            let result = job.filter(|_| awaited).map_or(Ok(()), attempt);
            self.slots.finish(ticket.slot(), result, ready);
        }
    }
}

impl<J: Job> Worker<J> for VirtualWorker<J> {
    fn begin(
        &mut self,
        now: Instant,
        prepare: &mut dyn FnMut(&mut J),
    ) -> Result<Option<Ticket>, Fault> {
        self.run_due(now);
        let Some(ticket) = self.slots.take(now)? else { return Ok(None) };
        let job = self.jobs.get_mut(usize::from(ticket.slot())).ok_or(Fault::INTERNAL)?;
        prepare(job);
        self.free = self.free.max(now) + J::TAKES;
        self.under_way.push_back((self.free, ticket));
        Ok(Some(ticket))
    }

    fn poll(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<&J>, Fault> {
        self.run_due(now);
        Ok(match self.slots.fetch(ticket)? {
            Poll::Pending => Poll::Pending,
            Poll::Ready(slot) => Poll::Ready(self.jobs.get(slot).ok_or(Fault::INTERNAL)?),
        })
    }

    fn cancel(&mut self, ticket: Ticket, now: Instant) {
        self.run_due(now);
        self.slots.give_up(ticket);
    }
}
