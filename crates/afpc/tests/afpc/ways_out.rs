//! The ways out of a run with the driver of the profile `carbot`. The controller's own program is at
//! the other end of a pseudo-terminal, and notes when the commands arrive.
//!
//! By day each way is tried once, with limits of seconds. `AFP_WAYS_OUT=100` tries each a hundred
//! times with FIFO priority and two busy processors, and checks the limits of the safety page.

mod board;

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::{self, sleep};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};

use crate::common::Place;
use board::{Board, Reports};

/// The number of runs in a series.
const RUNS: &str = "AFP_WAYS_OUT";
/// The limit by day, on a busy machine.
const LATE: Duration = Duration::from_secs(20);

const PLAN: &str = "use carbot\nplan Ahead forever {\n    start go\n    actor go: Drive {}\n}\n";

/// The runs of a way out: one by day, and many on busy processors at night.
struct Series {
    place: Place,
    /// The number of runs at night.
    runs: Option<usize>,
    busy: Vec<Child>,
}

impl Series {
    fn new() -> Series {
        let place = Place::new();
        place.afpc("new mycar --profile carbot").succeeds();
        place.write("mycar/plans/ahead.afp", PLAN);
        let runs = std::env::var(RUNS).ok().and_then(|runs| runs.parse().ok());
        let mut series = Series { place, runs, busy: Vec::new() };
        if runs.is_some() {
            // They would inherit the priority of this thread, and stop the machine.
            let spin = ["--other", "0", "sh", "-c", "while :; do :; done"];
            let spin = || Command::new("chrt").args(spin).spawn().unwrap();
            series.busy.extend((0..2).map(|_| spin()));
            // This thread and the boards that it starts must not wait for the busy processors.
            let thread = rustix::thread::gettid().as_raw_nonzero().to_string();
            let raised = Command::new("chrt").args(["--fifo", "--pid", "60", &thread]).status();
            assert!(raised.unwrap().success(), "a series needs the permission for priorities");
        }
        series
    }

    /// A run on a board, that drives.
    fn drive(&self, board: &Board) -> Run {
        let mut run = self.run(board, "none");
        run.waits("it does not drive", || board.drives());
        run
    }

    /// A run with normal priority and a log; its control loop has more priority.
    fn run(&self, board: &Board, log: &str) -> Run {
        let afpc = self.place.command();
        let mut command = Command::new("chrt");
        command.args(["--other", "0"]).arg(afpc.get_program());
        command.envs(afpc.get_envs().filter_map(|(name, value)| Some((name, value?))));
        command.current_dir(self.place.path("mycar"));
        command.args(["run", "plans/ahead.afp", "--robot", "hardware", "--json", "--log", log]);
        // A busy machine must not count as a stall by day.
        let (priority, stall) = if self.runs.is_some() { (50, 100) } else { (1, 2000) };
        for (name, value) in [
            ("port", board.port.clone()),
            ("realtime.priority", priority.to_string()),
            ("realtime.stall", format!("{stall}ms")),
        ] {
            command.arg("--set").arg(format!("robot.{name}={value}"));
        }
        let pipe = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        Run::new(pipe.spawn().unwrap())
    }

    /// How long a program is suspended in order to count as stalled.
    fn stall(&self) -> Duration {
        Duration::from_millis(if self.runs.is_some() { 150 } else { 3000 })
    }

    /// Repeats a way out, and compares its p99 and its longest time with limits in milliseconds.
    fn times(&self, name: &str, limits: [f64; 2], run: impl Fn() -> Duration) {
        let runs = self.runs.unwrap_or(1);
        let mut times: Vec<f64> = (0..runs).map(|_| run().as_secs_f64() * 1000.0).collect();
        times.sort_by(f64::total_cmp);
        let at = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
        let [median, p99, worst] = [0.5, 0.99, 1.0].map(at);
        println!("{name:<8} {runs} runs: p50 {median:.1} ms, p99 {p99:.1} ms, worst {worst:.1} ms");
        if self.runs.is_some() {
            assert!(p99 <= limits[0] && worst <= limits[1], "{name}: {times:?}");
        }
    }

    /// Repeats a check that has no time.
    fn holds(&self, name: &str, run: impl Fn()) {
        let runs = self.runs.unwrap_or(1);
        (0..runs).for_each(|_| run());
        println!("{name:<8} {runs} of {runs}");
    }
}

impl Drop for Series {
    fn drop(&mut self) {
        for child in &mut self.busy {
            child.kill().unwrap();
            child.wait().unwrap();
        }
    }
}

/// How often each thread of a process has given up its processor, by thread.
fn switches(process: u32) -> BTreeMap<u32, (String, u64)> {
    let tasks = fs::read_dir(format!("/proc/{process}/task")).unwrap();
    let of = |task: fs::DirEntry| {
        let status = fs::read_to_string(task.path().join("status")).ok()?;
        let value =
            |key: &str| Some(status.lines().find_map(|line| line.strip_prefix(key))?.trim());
        let count = value("voluntary_ctxt_switches:")?.parse().ok()?;
        let thread = task.file_name().to_str()?.parse().ok()?;
        Some((thread, (value("Name:")?.to_owned(), count)))
    };
    tasks.filter_map(|task| of(task.unwrap())).collect()
}

/// A run, which is killed when it is dropped.
struct Run {
    child: Child,
    /// The lines of its output with their times.
    lines: Receiver<(Instant, String)>,
}

impl Run {
    fn new(mut child: Child) -> Run {
        let (sends, lines) = channel();
        let out = child.stdout.take().unwrap();
        thread::spawn(move || {
            let lines = BufReader::new(out).lines().map_while(Result::ok);
            lines.for_each(|line| drop(sends.send((Instant::now(), line))));
        });
        Run { child, lines }
    }

    fn send(&self, signal: Signal) -> Instant {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
        Instant::now()
    }

    /// Waits until something holds.
    fn waits(&mut self, what: &str, mut holds: impl FnMut() -> bool) {
        let late = Instant::now() + LATE;
        while !holds() {
            if Instant::now() > late || self.child.try_wait().unwrap().is_some() && !holds() {
                let _ = self.child.kill();
                panic!("{what}: {}", self.said());
            }
            sleep(Duration::from_millis(1));
        }
    }

    /// Waits for the end.
    fn ends(&mut self) -> ExitStatus {
        let late = Instant::now() + LATE;
        loop {
            match self.child.try_wait().unwrap() {
                Some(status) => return status,
                None if Instant::now() > late => panic!("the run does not end"),
                None => sleep(Duration::from_millis(1)),
            }
        }
    }

    /// The standard error of a run that has ended.
    fn said(&mut self) -> String {
        let mut said = String::new();
        self.child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        said
    }
}

impl Drop for Run {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_signal_stops_the_controller() {
    let series = Series::new();
    for (name, signal) in
        [("SIGINT", Signal::INT), ("SIGTERM", Signal::TERM), ("SIGHUP", Signal::HUP)]
    {
        series.times(name, [15.0, 30.0], || {
            let board = Board::start();
            let mut run = series.drive(&board);
            let sent = run.send(signal);
            run.waits("it drives on", || board.is_commanded_zero());
            let status = run.ends();
            assert!(status.code().is_some_and(|code| code != 3), "{status}: {}", run.said());
            board.zero_after(sent)
        });
    }
}

#[test]
fn silence_garbage_and_impossible_numbers_stop_the_robot() {
    let series = Series::new();
    for (name, reports) in
        [("silence", Reports::None), ("garbage", Reports::Garbage), ("NaN", Reports::NotANumber)]
    {
        series.times(name, [110.0, 130.0], || {
            let board = Board::start();
            let mut run = series.drive(&board);
            let since = board.report(reports);
            run.waits("it drives on", || board.is_commanded_zero());
            // The end comes half a second later; once is enough.
            if series.runs.is_none() {
                assert_eq!(run.ends().code(), Some(3), "{}", run.said());
                assert!(board.is_commanded_zero(), "it drives on");
            }
            board.zero_after(since)
        });
    }
}

#[test]
fn a_killed_or_suspended_run_is_stopped_by_the_controller() {
    let series = Series::new();
    for (name, signal) in [("SIGKILL", Signal::KILL), ("SIGSTOP", Signal::STOP)] {
        series.times(name, [210.0, 230.0], || {
            let board = Board::start();
            let mut run = series.drive(&board);
            let sent = run.send(signal);
            if signal == Signal::KILL {
                assert_eq!(run.ends().signal(), Some(9));
            }
            let late = Instant::now() + LATE;
            while board.power_off_after(sent).is_none() {
                assert!(Instant::now() < late, "the controller does not stop");
                sleep(Duration::from_millis(1));
            }
            assert!(!board.is_commanded_zero(), "the run has stopped it");
            board.power_off_after(sent).unwrap()
        });
    }
}

#[test]
fn a_run_does_not_continue_after_a_stall() {
    let series = Series::new();
    series.holds("stall", || {
        let board = Board::start();
        let mut run = series.drive(&board);
        run.send(Signal::STOP);
        sleep(series.stall());
        board.forget();
        run.send(Signal::CONT);
        assert_eq!(run.ends().code(), Some(3), "{}", run.said());
        // The last bytes are on the line.
        sleep(Duration::from_millis(20));
        assert!(!board.drives(), "it drives on");
        let named = run.lines.iter().any(|(_, line)| line.contains("\"stalled\""));
        assert!(named, "the run does not name the stall: {}", run.said());
    });
}

#[test]
fn a_second_run_on_the_same_controller_is_refused() {
    let series = Series::new();
    series.holds("second", || {
        let board = Board::start();
        let mut first = series.drive(&board);
        let mut second = series.run(&board, "none");
        assert_eq!(second.ends().code(), Some(2));
        let said = second.said();
        let owner = format!("process {} ", first.child.id());
        assert!(said.contains("has it open") && said.contains(&owner), "{said}");
        board.forget();
        first.waits("the first run does not drive on", || board.drives());
    });
}

#[test]
fn other_threads_wake_up_at_most_twenty_times_a_second() {
    let series = Series::new();
    let board = Board::start();
    let mut run = series.run(&board, "drive.mcap");
    run.waits("it does not drive", || board.drives());
    // A busy machine has fewer wake-ups, not more.
    let (process, began) = (run.child.id(), Instant::now());
    let before = switches(process);
    sleep(Duration::from_secs(3));
    let after = switches(process);
    let seconds = began.elapsed().as_secs_f64();
    let mut others = 0.0;
    for (thread, (name, count)) in after {
        let count = count - before.get(&thread).map_or(0, |(_, count)| *count);
        let rate = count as f64 / seconds;
        println!("{name:<16} {rate:.1} wake-ups a second");
        match thread == process {
            // Polls each 10 ms, commands each 20 ms, samples each 20 ms.
            true => assert!(rate <= 100.0 + 50.0 + 50.0 + 5.0, "{rate} of the control loop"),
            false => others += rate,
        }
    }
    println!("all others       {others:.1} wake-ups a second");
    assert!(others <= 20.0, "{others} wake-ups a second");
    run.send(Signal::TERM);
    run.ends();
}

#[test]
fn a_restart_of_the_controller_is_reported_by_name() {
    let series = Series::new();
    series.times("restart", [100.0, 100.0], || {
        let board = Board::start();
        let mut run = series.drive(&board);
        let since = board.restart();
        assert_eq!(run.ends().code(), Some(3), "{}", run.said());
        let named = run.lines.iter().find(|(_, line)| line.contains("controller-restarted"));
        let (at, _) = named.expect("the run does not name the restart");
        assert!(!board.drives(), "the new controller was driven");
        at.duration_since(since)
    });
}
