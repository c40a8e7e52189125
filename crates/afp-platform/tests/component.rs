//! A component with a job: polls, interruption and failures.

use afp_core::rt::NamedPlan;
use afp_core::trace::{Ending, Line, Names, Record, Sink};
use afp_core::{
    Actor, Duration, Environment, Events, Fault, Instant, Job, Platform, Poll, Scheduler,
    StillClock, Supervisor, Ticket, Wake, Worker,
};
use afp_platform::VirtualWorker;
use std::thread;
use std::time::Duration as Span;

mod templates {
    afp_macros::toolbox!("tests/sums.afp", robot = super::Bench);
}

afp_macros::plan!("tests/add.afp", toolboxes = { "tests/sums.afp" => crate });

/// A sum; a sum of numbers up to 13 panics.
#[derive(Default)]
struct Sum {
    limit: i64,
    sum: i64,
    /// Slowness of the machine.
    slow: Span,
}

impl Job for Sum {
    const TAKES: Duration = Duration::from_millis(25);

    fn run(&mut self) -> Result<(), Fault> {
        assert_ne!(self.limit, 13, "a job that panics, as the test wants it to");
        thread::sleep(self.slow);
        self.sum = (1..=self.limit).sum();
        Ok(())
    }
}

struct Bench {
    worker: VirtualWorker<Sum>,
    now: Instant,
    pressed: Instant,
    /// Stops and cancellations, in order.
    heard: Vec<&'static str>,
}

impl Bench {
    fn new(slow: Span, pressed: Instant) -> Self {
        let job = || Sum { slow, ..Sum::default() };
        let worker = VirtualWorker::new([job(), job()]);
        Bench { worker, now: Instant::ZERO, pressed, heard: Vec::new() }
    }
}

impl Environment for Bench {
    fn stop(&mut self, _: Instant) {
        self.heard.push("stop");
    }

    fn emergency_stop(&mut self) {
        self.heard.push("emergency stop");
    }
}

#[derive(Clone)]
struct Add(Ticket);

impl Actor<templates::Add, Bench> for Add {
    fn start(inputs: templates::add::Inputs, env: &mut Bench, now: Instant) -> Result<Self, Fault> {
        let begun = env.worker.begin(now, &mut |job| job.limit = inputs.limit)?;
        begun.map(Add).ok_or(Fault::INTERNAL)
    }

    fn poll(
        &mut self,
        _: templates::add::Live,
        env: &mut Bench,
        now: Instant,
    ) -> Result<Poll<templates::add::State>, Fault> {
        Ok(match env.worker.poll(self.0, now)? {
            Poll::Pending => Poll::Pending,
            Poll::Ready(job) => Poll::Ready(templates::add::State::Added { sum: job.sum }),
        })
    }

    fn interrupt(&mut self, env: &mut Bench, now: Instant) -> Result<(), Fault> {
        env.worker.cancel(self.0, now);
        env.heard.push("cancel");
        Ok(())
    }
}

impl Platform for Bench {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        self.now = self.now.max(to);
    }
}

#[derive(Clone)]
struct CheckButton {
    seen: bool,
}

impl Supervisor<templates::CheckButton, Bench> for CheckButton {
    fn start(_: templates::check_button::Inputs, _: &mut Bench, _: Instant) -> Result<Self, Fault> {
        Ok(CheckButton { seen: false })
    }

    fn poll(
        &mut self,
        _: templates::check_button::Live,
        _: Events,
        env: &mut Bench,
        now: Instant,
    ) -> Result<Option<templates::check_button::Event>, Fault> {
        let news = now >= env.pressed && !self.seen;
        self.seen |= news;
        Ok(news.then_some(templates::check_button::Event::Pressed))
    }
}

struct Text<N> {
    names: N,
    lines: Vec<String>,
}

impl<N: Names> Sink for Text<N> {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.lines.push(Line { at, record, names: &self.names }.to_string());
    }
}

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

/// Runs the plan; returns time and kind of its ending, its sum, and its trace.
fn run(bench: &mut Bench, limit: i64) -> (Instant, Ending, Option<i64>, Vec<String>) {
    let mut plan = AddUp::new();
    plan.set_limit(limit);
    let mut sink = Text { names: plan.names(), lines: Vec::new() };
    let mut scheduler = Scheduler::new(plan);
    let wake = scheduler.run_until(bench, &mut sink, at(1000)).unwrap();
    let Wake::Ended(ending) = wake else { panic!("it goes on") };
    (bench.now, ending, scheduler.plan().sum(), sink.lines)
}

#[test]
fn a_run_does_not_depend_on_the_speed_of_the_machine() {
    let mut quick = Bench::new(Span::ZERO, Instant::MAX);
    let mut slow = Bench::new(Span::from_millis(60), Instant::MAX);
    let (end, ending, sum, trace) = run(&mut quick, 4);
    assert_eq!((end, ending, sum), (at(30), Ending::Ok, Some(10)), "the first poll after 25 ms");
    assert_eq!(run(&mut slow, 4).3, trace);
    assert!(trace.len() > 5);
}

#[test]
fn an_interrupted_actor_cancels_its_job_and_the_next_has_its_own() {
    let mut bench = Bench::new(Span::ZERO, at(12));
    let (end, ending, sum, _) = run(&mut bench, 100);
    assert_eq!(bench.heard, ["cancel", "stop"]);
    // The worker is busy with the first job until 25 ms; the second begins at 20 ms.
    assert_eq!((end, ending, sum), (at(50), Ending::Ok, Some(6)));
}

#[test]
fn a_job_that_panics_is_a_fault_of_its_component_which_stops_the_robot() {
    let mut bench = Bench::new(Span::ZERO, Instant::MAX);
    let (end, ending, sum, trace) = run(&mut bench, 13);
    assert_eq!((end, ending), (at(30), Ending::Error(Fault::JOB_PANICKED)));
    assert_eq!(sum, Some(0), "nothing was committed");
    assert_eq!(bench.heard.first(), Some(&"cancel"), "the actor is interrupted: {:?}", bench.heard);
    assert!(trace.iter().any(|line| line.contains("job-panicked")), "{trace:#?}");
}
