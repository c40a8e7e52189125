//! The times of the ways out, in series: `AFP_WAYS_OUT=100` runs each of them a hundred times with FIFO
//! priority and two busy processors, and checks the limits of the safety page.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use rustix::process::Signal;
use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

use super::{LIMIT, PATIENCE, Robot, ended, send, start};

/// The environment variable with the number of runs.
const RUNS: &str = "AFP_WAYS_OUT";
/// Settings of the control loop in a series.
const FIFO: [&str; 4] =
    ["--set", "robot.realtime.priority=50", "--set", "robot.realtime.stall=100ms"];

/// Programs that use the processors until they are dropped.
struct Busy(Vec<Child>);

impl Busy {
    fn new() -> Busy {
        let spin = || Command::new("sh").args(["-c", "while :; do :; done"]).spawn();
        Busy((0..2).map(|_| spin().unwrap()).collect())
    }
}

impl Drop for Busy {
    fn drop(&mut self) {
        for child in &mut self.0 {
            child.kill().unwrap();
            child.wait().unwrap();
        }
    }
}

/// The times of a way out in milliseconds. Prints p50, p99 and the worst, and compares the last two
/// with limits.
fn series(name: &str, runs: usize, limits: Option<[f64; 2]>, run: impl Fn() -> Duration) {
    let mut times: Vec<f64> = (0..runs).map(|_| run().as_secs_f64() * 1000.0).collect();
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    let [median, p99, worst] = [0.5, 0.99, 1.0].map(at);
    println!("{name:<8} {runs} runs: p50 {median:.1} ms, p99 {p99:.1} ms, worst {worst:.1} ms");
    if let Some(limits) = limits {
        assert!(p99 <= limits[0] && worst <= limits[1], "{name}: {times:?}");
    }
}

/// Starts the program without the priority of this thread.
fn started(robot: &Robot, does: &str) -> Child {
    let program = start(robot, does, &FIFO);
    let mut command = Command::new("chrt");
    command.args(["--other", "0"]).arg(program.get_program()).args(program.get_args());
    command.envs(program.get_envs().filter_map(|(name, value)| Some((name, value?))));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// The time from a signal to the first `stop`.
fn to_stop(signal: Signal) -> Duration {
    let mut robot = Robot::new();
    let child = started(&robot, "drives");
    robot.waits_for("drive", PATIENCE);
    send(&child, signal);
    let sent = Instant::now();
    robot.waits_for("stop", LIMIT);
    let took = sent.elapsed();
    ended(child);
    robot.rest();
    took
}

/// The time from the last command of a component that hangs to the cut by the watchdog.
fn to_cut() -> Duration {
    let mut robot = Robot::new();
    let child = started(&robot, "hangs");
    robot.waits_for("drive", PATIENCE);
    let mut driven = Instant::now();
    while let Ok(word) = robot.heard.recv_timeout(PATIENCE) {
        match &*word {
            "cut" => break,
            "drive" => driven = Instant::now(),
            _ => {}
        }
    }
    let took = driven.elapsed();
    send(&child, Signal::TERM);
    ended(child);
    robot.rest();
    took
}

/// A program that was suspended for 150 ms stays stopped.
fn stays_stopped() -> Duration {
    let mut robot = Robot::new();
    let child = started(&robot, "drives");
    robot.waits_for("drive", PATIENCE);
    send(&child, Signal::STOP);
    std::thread::sleep(Duration::from_millis(150));
    while robot.heard.try_recv().is_ok() {}
    send(&child, Signal::CONT);
    let sent = Instant::now();
    let before = robot.waits_for("stop", LIMIT);
    let took = sent.elapsed();
    assert!(!before.contains(&"drive".to_owned()), "it drives on: {before:?}");
    ended(child);
    assert!(!robot.rest().contains(&"drive".to_owned()), "it drives on");
    took
}

#[test]
fn ways_out_in_series() {
    let Some(runs) = std::env::var(RUNS).ok().and_then(|runs| runs.parse().ok()) else { return };
    let _busy = Busy::new();
    // This clock must not wait for the busy processors.
    let priority = ThreadPriority::Crossplatform(ThreadPriorityValue::try_from(60).unwrap());
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    if let Err(why) = set_thread_priority_and_policy(thread_native_id(), priority, policy) {
        println!("the times include waiting for a processor: {why:?}");
    }
    for (name, signal) in
        [("SIGINT", Signal::INT), ("SIGTERM", Signal::TERM), ("SIGHUP", Signal::HUP)]
    {
        series(name, runs, Some([15.0, 30.0]), || to_stop(signal));
    }
    // Up to 10 ms pass between the last command and the call that hangs.
    series("hang", runs, Some([110.0, 140.0]), to_cut);
    series("resume", runs, None, stays_stopped);
}
