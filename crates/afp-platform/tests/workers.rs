//! Guarantees of every worker, and of each kind.

use afp_core::{Duration, Fault, Instant, Job, Poll, Reason, Ticket, Worker};
use afp_platform::{ThreadWorker, VirtualWorker};
use std::sync::mpsc::{Receiver, channel};
use std::thread;

const REFUSED: Fault = Fault::new(&Reason { code: "refused", text: "no even number" });

/// Squares a number, or misbehaves on request.
#[derive(Default)]
struct Square {
    number: u64,
    square: u64,
    task: Task,
    gate: Option<Receiver<()>>,
}

#[derive(Clone, Copy, Default)]
enum Task {
    #[default]
    Compute,
    Refuse,
    Panic,
}

impl Job for Square {
    const TAKES: Duration = Duration::from_millis(30);

    fn run(&mut self) -> Result<(), Fault> {
        if let Some(gate) = self.gate.take() {
            let _ = gate.recv();
        }
        match self.task {
            Task::Compute => self.square = self.number * self.number,
            Task::Refuse => return Err(REFUSED),
            Task::Panic => panic!("a job that panics, as the test wants it to"),
        }
        Ok(())
    }
}

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

fn squares(count: usize) -> impl Iterator<Item = Square> {
    (0..count).map(|_| Square::default())
}

/// Begins to square a number.
fn begin(worker: &mut dyn Worker<Square>, now: u64, number: u64, task: Task) -> Option<Ticket> {
    let mut prepare = |job: &mut Square| (job.number, job.task) = (number, task);
    worker.begin(at(now), &mut prepare).expect("a slot is left that works")
}

/// Polls until the job is over, as a component does.
fn fetch(worker: &mut dyn Worker<Square>, ticket: Ticket) -> Result<u64, Fault> {
    for tick in 1..10_000 {
        match worker.poll(ticket, at(1_000_000 + tick))? {
            Poll::Ready(job) => return Ok(job.square),
            Poll::Pending => thread::sleep(std::time::Duration::from_millis(1)),
        }
    }
    panic!("the job never ends");
}

/// Runs a test with each kind of worker.
fn with_each(slots: usize, test: impl Fn(&mut dyn Worker<Square>)) {
    test(&mut VirtualWorker::new(squares(slots)));
    test(&mut ThreadWorker::new("squares", squares(slots)).expect("a thread"));
}

#[test]
fn jobs_give_their_results_to_their_tickets_once() {
    with_each(2, |worker| {
        for round in 0..100 {
            let a = begin(worker, 0, round, Task::Compute).unwrap();
            let b = begin(worker, 0, round + 1, Task::Compute).unwrap();
            assert_eq!(begin(worker, 0, 7, Task::Compute), None, "both slots are taken");
            assert_eq!(fetch(worker, b), Ok((round + 1) * (round + 1)));
            assert_eq!(fetch(worker, a), Ok(round * round));
            assert_eq!(fetch(worker, a), Err(Fault::JOB_LOST));
        }
    });
}

#[test]
fn a_fault_of_a_job_reaches_the_caller_and_the_slot_continues() {
    with_each(1, |worker| {
        let ticket = begin(worker, 0, 4, Task::Refuse).unwrap();
        assert_eq!(fetch(worker, ticket), Err(REFUSED));
        let ticket = begin(worker, 0, 5, Task::Compute).unwrap();
        assert_eq!(fetch(worker, ticket), Ok(25));
    });
}

#[test]
fn a_slot_where_a_job_panicked_is_not_used_again() {
    with_each(2, |worker| {
        let ticket = begin(worker, 0, 4, Task::Panic).unwrap();
        assert_eq!(fetch(worker, ticket), Err(Fault::JOB_PANICKED));
        let ticket = begin(worker, 0, 5, Task::Compute).unwrap();
        assert_eq!(begin(worker, 0, 6, Task::Compute), None, "one slot is left");
        assert_eq!(fetch(worker, ticket), Ok(25));
        let ticket = begin(worker, 0, 4, Task::Panic).unwrap();
        assert_eq!(fetch(worker, ticket), Err(Fault::JOB_PANICKED));
        assert_eq!(worker.begin(at(0), &mut |_| ()), Err(Fault::JOB_PANICKED));
    });
}

#[test]
fn a_cancelled_job_is_lost_and_gives_its_slot_back() {
    with_each(1, |worker| {
        let cancelled = begin(worker, 0, 3, Task::Compute).unwrap();
        worker.cancel(cancelled, at(1));
        assert_eq!(fetch(worker, cancelled), Err(Fault::JOB_LOST));
        let next = (100..10_000).find_map(|now| {
            thread::sleep(std::time::Duration::from_micros(50));
            begin(worker, now, 5, Task::Compute)
        });
        assert_eq!(fetch(worker, next.expect("the slot gets free")), Ok(25));
        worker.cancel(cancelled, at(2));
    });
}

#[test]
fn a_finished_job_without_a_reader_is_dropped_after_a_second() {
    with_each(1, |worker| {
        let forgotten = begin(worker, 0, 1, Task::Compute).unwrap();
        let since = (100..10_000).find(|now| {
            thread::sleep(std::time::Duration::from_millis(1));
            begin(worker, *now, 2, Task::Compute).is_some()
        });
        assert!(since.is_some_and(|since| since > 1000), "{since:?}");
        assert_eq!(fetch(worker, forgotten), Err(Fault::JOB_LOST));
    });
}

#[test]
fn in_virtual_time_jobs_are_ready_one_after_the_other() {
    let mut worker = VirtualWorker::new(squares(3));
    let a = begin(&mut worker, 10, 2, Task::Compute).unwrap();
    let b = begin(&mut worker, 20, 3, Task::Compute).unwrap();
    worker.cancel(a, at(25));
    let c = begin(&mut worker, 25, 4, Task::Compute).unwrap();
    let mut ready = |ticket, now| matches!(worker.poll(ticket, now), Ok(Poll::Ready(_)));
    assert!(!ready(b, Instant::from_nanos(69_999_999)), "what was cancelled takes its time");
    assert!(ready(b, at(70)));
    assert!(!ready(c, at(99)));
    assert!(ready(c, at(100)));
}

#[test]
fn polling_a_thread_does_not_wait() {
    let mut worker = ThreadWorker::new("squares", squares(1)).unwrap();
    let (open, gate) = channel();
    let mut gate = Some(gate);
    let mut prepare = |job: &mut Square| (job.number, job.gate) = (6, gate.take());
    let ticket = worker.begin(at(0), &mut prepare).unwrap().unwrap();
    for _ in 0..1000 {
        assert!(matches!(worker.poll(ticket, at(0)), Ok(Poll::Pending)));
    }
    assert_eq!(begin(&mut worker, 0, 1, Task::Compute), None);
    thread::sleep(std::time::Duration::from_millis(40));
    open.send(()).unwrap();
    assert_eq!(fetch(&mut worker, ticket), Ok(36));
    assert_eq!(worker.overruns(), 1, "it took longer than the declared 30 ms");
}
