//! The control thread with a shipped driver allocates nothing, and makes only the system calls of
//! its list. It has its own binary, because it counts in the global allocator.
#![cfg(target_os = "linux")]

#[path = "../examples/controller.rs"]
#[allow(dead_code)]
mod controller;
#[path = "../examples/ugv.rs"]
#[allow(dead_code)]
mod ugv;

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration as Span;

use afp_core::{Duration, Instant};
use afp_counting::{Counting, allocations, trap_system_calls};
use afp_dsl::files::Texts;
use afp_dsl::{Toolboxes, compile};
use afp_pi::opener;
use afp_session::{Counts, Observer, Open, Opened, Settings, queue};
use afp_syntax::source::Source;

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

/// The environment variable with the profile of the program.
const PROFILE: &str = "AFP_TEST_PROFILE";

/// Drives and stops, with supervisors and commits.
const PLAN: &str = "use carbot
use std
plan Rounds {
    var round: int = 0
    start go
    supervise late: After(duration = 3600 s) { Elapsed -> terminate }
    actor go: Drive {
        supervise soon: CheckTimeout(duration = 100 ms) { TimedOut -> rest }
    }
    actor rest: Stop { Stopped -> count }
    computation count: Count(value = round, limit = 1000000, next => round) {
        Again -> go
        Done -> terminate
    }
}";

/// Settings that both profiles have.
const SETTINGS: [(&str, &str); 5] = [
    ("body.length", "24 cm"),
    ("body.width", "24 cm"),
    ("drive.track", "17 cm"),
    ("drive.fastest", "35 cm/s"),
    ("realtime.stall", "10 s"),
];
const OF_CARBOT: [(&str, &str); 4] = [
    ("drive.wheel_diameter", "65 mm"),
    ("drive.ticks", "1440"),
    ("drive.ramp", "50 ms"),
    ("bumper.closed", "free"),
];

/// Starts a controller; returns its port.
fn start(profile: &str) -> String {
    match profile {
        "carbot" => {
            let (mut fake, port) = controller::Fake::new().unwrap();
            thread::spawn(move || while fake.step().is_ok() {});
            port
        }
        _ => {
            let (mut fake, port) = ugv::Fake::new().unwrap();
            thread::spawn(move || while fake.step().is_ok() {});
            port
        }
    }
}

/// Not a test: the test below starts it as its program.
#[test]
fn program() {
    let Ok(profile) = std::env::var(PROFILE) else { return };
    let port = start(&profile);
    let own = OF_CARBOT.into_iter().filter(|_| profile == "carbot");
    let settings = SETTINGS.into_iter().chain(own).chain([("port", &*port)]);
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", PLAN), &toolboxes, &Texts::default());
    let graph = compiled.graph.clone().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let opened = opener(&profile).unwrap().open(&graph, &Settings::new(settings));
    let Opened { mut session, .. } = opened.unwrap_or_else(|why| panic!("{why}"));
    session.set_stall(Duration::from_secs(10));
    let mut counts = Counts::new(session.names());
    let (mut writer, mut reader) = queue(session.owned_names(), session.devices(), &[&mut counts]);
    let reading = thread::spawn(move || {
        while reader.read(&mut [&mut counts as &mut dyn Observer]) {
            thread::park_timeout(Span::from_millis(50));
        }
    });
    let thread = reading.thread().clone();
    writer.set_wake(Box::new(move || thread.unpark()));
    let mut run = |seconds| {
        let until = session.now() + Duration::from_secs(seconds);
        session.run(until, &mut Open, &mut [&mut writer]).unwrap();
        assert_eq!(session.ending(), None);
    };
    run(1);
    let before = allocations();
    run(1);
    let allocated = allocations() - before;
    assert_eq!(allocated, 0, "{profile}");
    trap_system_calls();
    run(1);
    let out = rustix::stdio::stdout();
    rustix::io::write(out, b"\nit went on\n").unwrap();
    let time = afp_platform::RealTime::start();
    loop {
        time.sleep_until(Instant::MAX);
    }
}

#[test]
fn the_control_thread_of_shipped_drivers_allocates_nothing_and_keeps_to_its_system_calls() {
    for profile in ["carbot", "ugv"] {
        // On a busy machine the two ends may lose each other.
        let went_on = (0..5).any(|_| {
            let mut command = Command::new(std::env::current_exe().unwrap());
            command.args(["--exact", "program", "--nocapture", "--test-threads=1"]);
            let mut child = command.env(PROFILE, profile).stdout(Stdio::piped()).spawn().unwrap();
            let lines = BufReader::new(child.stdout.take().unwrap()).lines();
            let went_on = lines.map_while(Result::ok).any(|line| line == "it went on");
            let _ = child.kill();
            child.wait().unwrap();
            went_on
        });
        assert!(went_on, "{profile}: the trap or a count ended five programs");
    }
}
