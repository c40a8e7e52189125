//! The time of the watchdog in a series, and how punctual the control loop is: `AFP_WAYS_OUT=100` runs a
//! component that hangs a hundred times with FIFO priority and two busy processors. `afpc` has the
//! series of the other ways out, with a shipped driver.

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use rustix::process::Signal;
use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadPriorityValue, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

use super::{PATIENCE, Robot, ended, send, start};

/// The environment variable with the number of runs.
const RUNS: &str = "AFP_WAYS_OUT";
/// Settings of the control loop in a series.
const FIFO: [&str; 4] =
    ["--set", "robot.realtime.priority=50", "--set", "robot.realtime.stall=100ms"];

/// Programs that use the processors until they are dropped.
struct Busy(Vec<Child>);

impl Busy {
    fn new() -> Busy {
        // They would inherit the priority of this thread, and stop the machine.
        let spin = ["--other", "0", "sh", "-c", "while :; do :; done"];
        Busy((0..2).map(|_| Command::new("chrt").args(spin).spawn().unwrap()).collect())
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

/// Starts the program without the priority of this thread.
fn started(robot: &Robot, does: &str) -> Child {
    let program = start(robot, does, &FIFO);
    let mut command = Command::new("chrt");
    command.args(["--other", "0"]).arg(program.get_program()).args(program.get_args());
    command.envs(program.get_envs().filter_map(|(name, value)| Some((name, value?))));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// The time from the begin of a poll that hangs to the cut by the watchdog.
fn to_cut() -> Duration {
    let mut robot = Robot::new();
    let child = started(&robot, "hangs");
    robot.waits_for("hangs", PATIENCE);
    let hangs = Instant::now();
    robot.waits_for("cut", PATIENCE);
    let took = hangs.elapsed();
    send(&child, Signal::TERM);
    ended(child);
    robot.rest();
    took
}

/// The report of a control loop at 1 kHz: how late it wakes up, and its missed deadlines.
fn release_jitter() -> (String, u64) {
    let mut robot = Robot::new();
    let report = ["--until", "18s", "--rt-report", "--json"];
    let mut program = start(&robot, "often", &[&FIFO[..], &report].concat());
    let child = program.stdout(Stdio::piped()).spawn().unwrap();
    // The other end of the line is read, so that it never fills.
    robot.waits_for("drive", PATIENCE);
    let output = child.wait_with_output().unwrap();
    robot.rest();
    let text = String::from_utf8(output.stdout).unwrap();
    let summary = text.lines().rfind(|line| line.starts_with("{\"summary\""));
    let summary: serde_json::Value = serde_json::from_str(summary.unwrap()).unwrap();
    let summary = &summary["summary"];
    let late = summary["loop_late"].as_str().unwrap().to_owned();
    (late, summary["deadline_misses"].as_u64().unwrap())
}

/// The times of `cyclictest`: p50, p99 and worst in microseconds.
fn cyclictest(histogram: &str) -> [f64; 3] {
    let rows = histogram.lines().filter(|line| !line.starts_with('#'));
    let rows: Vec<(f64, u64)> = rows
        .filter_map(|line| {
            let mut words = line.split_whitespace();
            Some((words.next()?.parse().ok()?, words.next()?.parse().ok()?))
        })
        .collect();
    let all: u64 = rows.iter().map(|(_, count)| count).sum();
    [0.5, 0.99, 1.0].map(|share| {
        let mut seen = 0;
        let found = rows.iter().find(|(_, count)| {
            seen += count;
            seen as f64 >= share * all as f64
        });
        found.unwrap().0
    })
}

/// Uses both processors, and gives this thread a priority above the control loop.
fn busy() -> Busy {
    let busy = Busy::new();
    let priority = ThreadPriority::Crossplatform(ThreadPriorityValue::try_from(60).unwrap());
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    if let Err(why) = set_thread_priority_and_policy(thread_native_id(), priority, policy) {
        println!("the times include waiting for a processor: {why:?}");
    }
    busy
}

fn runs() -> Option<usize> {
    std::env::var(RUNS).ok().and_then(|runs| runs.parse().ok())
}

/// The control loop wakes up as punctually as a program that does nothing else. Its histogram
/// rounds up by at most an eighth.
#[test]
fn ways_out_jitter() {
    if runs().is_none() {
        return;
    }
    let _busy = Busy::new();
    let mut peer = Command::new("cyclictest");
    peer.args(["--quiet", "--mlockall", "--priority=50", "--interval=1000", "--threads=1"]);
    peer.args(["--duration=20", "--histogram=20000"]);
    let peer = peer.stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
    let peer = peer.expect("the package rt-tests has cyclictest");
    let (ours, misses) = release_jitter();
    let theirs = cyclictest(&String::from_utf8(peer.wait_with_output().unwrap().stdout).unwrap());
    let [half, p99, worst] = theirs;
    println!("jitter   {ours}, {misses} deadlines missed");
    println!("         cyclictest: p50 {half} us, p99 {p99} us, worst {worst} us");
    let median = ours.split("p50 ").nth(1).and_then(|text| text.split(' ').next());
    let median: f64 = median.unwrap().parse().unwrap();
    assert!(median <= 1.3 * half, "{median} us, {half} us");
}

/// The watchdog takes the power from a component that hangs, in time.
#[test]
fn ways_out_hang() {
    let Some(runs) = runs() else { return };
    let _busy = busy();
    let mut times: Vec<f64> = (0..runs).map(|_| to_cut().as_secs_f64() * 1000.0).collect();
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    let [median, p99, worst] = [0.5, 0.99, 1.0].map(at);
    println!("hang     {runs} runs: p50 {median:.1} ms, p99 {p99:.1} ms, worst {worst:.1} ms");
    assert!(p99 <= 100.0 && worst <= 130.0, "{times:?}");
}
