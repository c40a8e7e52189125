//! A worker with its own thread.

use super::attempt;
use super::slots::Slots;
use afp_core::{Fault, Instant, Job, Poll, Ticket, Worker};
use rtrb::{Consumer, Producer, RingBuffer};
use std::io;
use std::thread::{self, Thread};
use std::time::Instant as Wall;

/// Runs jobs sequentially on its own thread. Submitting and fetching a job neither locks nor
/// allocates.
///
/// Create it before the thread that steps the plan gets its priority: on Linux a thread inherits
/// the priority of its creator. After a drop the thread ends when its current job is done, and the
/// drop does not wait.
#[derive(Debug)]
pub struct ThreadWorker<J> {
    slots: Slots,
    /// The jobs that are not with the thread, by slot.
    here: Vec<Option<Box<J>>>,
    /// `None` during a drop.
    to_do: Option<Producer<Task<J>>>,
    done: Consumer<Task<J>>,
    thread: Thread,
    overruns: u64,
}

/// A job that is sent to the thread, or its result.
#[derive(Debug)]
struct Task<J> {
    slot: u16,
    job: Box<J>,
    result: Result<(), Fault>,
    /// Whether it exceeded its declared time.
    overran: bool,
}

impl<J: Job> ThreadWorker<J> {
    /// Makes a worker with a slot for each of these jobs, whose buffers are reused. `name` is the
    /// thread's name.
    ///
    /// # Errors
    /// The system cannot create a thread.
    ///
    /// # Panics
    /// With more than 65536 jobs.
    pub fn new(name: &str, jobs: impl IntoIterator<Item = J>) -> io::Result<Self> {
        let here: Vec<_> = jobs.into_iter().map(|job| Some(Box::new(job))).collect();
        let (to_do, their_to_do) = RingBuffer::new(here.len());
        let (their_done, done) = RingBuffer::new(here.len());
        let work = move || work(their_to_do, their_done);
        let thread = thread::Builder::new().name(name.to_owned()).spawn(work)?.thread().clone();
        let slots = Slots::new(here.len());
        Ok(ThreadWorker { slots, here, to_do: Some(to_do), done, thread, overruns: 0 })
    }

    /// Number of jobs that exceeded their declared time.
    pub fn overruns(&self) -> u64 {
        self.overruns
    }

    fn take_finished(&mut self, now: Instant) {
        while let Ok(Task { slot, job, result, overran }) = self.done.pop() {
            self.overruns += u64::from(overran);
            if let Some(here) = self.here.get_mut(usize::from(slot)) {
                *here = Some(job);
            }
            self.slots.finish(slot, result, now);
        }
    }
}

impl<J: Job> Worker<J> for ThreadWorker<J> {
    fn begin(
        &mut self,
        now: Instant,
        prepare: &mut dyn FnMut(&mut J),
    ) -> Result<Option<Ticket>, Fault> {
        self.take_finished(now);
        let Some(ticket) = self.slots.take(now)? else { return Ok(None) };
        let here = self.here.get_mut(usize::from(ticket.slot()));
        let mut job = here.and_then(Option::take).ok_or(Fault::INTERNAL)?;
        prepare(&mut job);
        let task = Task { slot: ticket.slot(), job, result: Ok(()), overran: false };
        let to_do = self.to_do.as_mut().ok_or(Fault::INTERNAL)?;
        to_do.push(task).map_err(|_| Fault::INTERNAL)?;
        self.thread.unpark();
        Ok(Some(ticket))
    }

    fn poll(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<&J>, Fault> {
        self.take_finished(now);
        Ok(match self.slots.fetch(ticket)? {
            Poll::Pending => Poll::Pending,
            Poll::Ready(slot) => {
                Poll::Ready(self.here.get(slot).and_then(Option::as_deref).ok_or(Fault::INTERNAL)?)
            }
        })
    }

    fn cancel(&mut self, ticket: Ticket, now: Instant) {
        self.take_finished(now);
        self.slots.give_up(ticket);
    }
}

impl<J> Drop for ThreadWorker<J> {
    fn drop(&mut self) {
        self.to_do = None;
        self.thread.unpark();
    }
}

/// The loop of the thread.
fn work<J: Job>(mut to_do: Consumer<Task<J>>, mut done: Producer<Task<J>>) {
    loop {
        match to_do.pop() {
            Ok(mut task) => {
                let begun = Wall::now();
                task.result = attempt(&mut *task.job);
                task.overran = begun.elapsed() > J::TAKES.into();
                // The queue has room for every job, so only a dropped worker rejects it.
                if done.push(task).is_err() {
                    return;
                }
            }
            Err(_) if to_do.is_abandoned() => return,
            // Returns at once after an earlier `unpark`, so no job is missed.
            Err(_) => thread::park(),
        }
    }
}
