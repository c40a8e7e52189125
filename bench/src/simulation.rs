//! A minute of wall following in the simulator, compared with the bare engine.
//!
//! The baseline is the same number of rapier steps of the same room and body, and the same rays as
//! those of the range sensor.

mod applications;
mod crowd;

use std::hint::black_box;
use std::time;

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{NoTrace, Sink};
use afp_core::{Instant, Scheduler, StillClock, Wake};
use afp_log::robot::{Pose2, Ranging};
use afp_log::{About, Recorder, WhenFull};
use afp_sim::{Bare, Pose, STEP, Simulation, World};

use crate::measure::{Race, Times};
use crate::plans::wall_following::WallFollowing;
use crate::report::{Report, Row};

/// The simulated seconds of one operation.
const SECONDS: u64 = 60;
const END: Instant = Instant::from_nanos(SECONDS * 1_000_000_000);
/// The physics steps between two pings of the range sensor.
const STEPS_PER_PING: u64 = 10;
const SEED: u64 = 7;

/// The largest ratio of simulator to bare engine.
const OF_BARE: f64 = 1.5;
/// The largest ratio of a run with a log to a run without one.
const OF_NO_LOG: f64 = 2.0;
/// The smallest speed of the simulator as a multiple of real time.
const OF_REAL_TIME: f64 = 1000.0;

/// Races the bare engine, a run without a log and one with a log.
pub fn run(rounds: u32, report: &mut Report) {
    let world = World::parse(include_str!("../../worlds/wall_following.toml"));
    let world = &world.unwrap_or_else(|why| panic!("{why:?}"));
    let mut pings = Pings::default();
    follow(world, &mut pings);
    let mut race = Race::default();
    race.add("bare engine", |count| (0..count).for_each(|_| bare(world, &pings.sent)));
    race.add("no log", |count| (0..count).for_each(|_| follow(world, &mut NoLog)));
    race.add("log", |count| (0..count).for_each(|_| logged(world)));
    let times = race.run(rounds.div_ceil(25));
    let [engine, quiet, logged] = &times[..] else { return };
    let row = |case: &Times| {
        Row::new(
            format!("simulated second/{}", case.name),
            case.median / SECONDS as f64 / 1e3,
            "us",
        )
    };
    report.add(row(engine));
    for (case, most) in [(quiet, Some(OF_BARE)), (logged, None)] {
        let ratio = case.ratio(engine);
        let row = row(case).against("simulated second/bare engine", ratio);
        report.add(match most {
            Some(most) => row.limit(format!("<= {most}"), ratio <= most),
            None => row,
        });
        let speed = SECONDS as f64 * 1e9 / case.median;
        let row = Row::new(format!("simulated second/{}, speed", case.name), speed, "x");
        let row = row.against("real time", speed);
        report.add(match most {
            Some(_) => row.limit(format!(">= {OF_REAL_TIME}"), speed >= OF_REAL_TIME),
            None => row,
        });
    }
    let ratio = logged.ratio(quiet);
    let row = row(logged).against("simulated second/no log", ratio);
    report.add(row.limit(format!("<= {OF_NO_LOG}"), ratio <= OF_NO_LOG));
    crowd::run(rounds, report);
    applications::run(rounds, report);
}

/// Only the engine.
fn bare(world: &World, pings: &[(Pose, f64)]) {
    let mut engine = Bare::new(world).unwrap_or_else(|why| panic!("{why:?}"));
    let mut pings = pings.iter();
    for step in 0..END.as_nanos() / STEP.as_nanos() {
        engine.step();
        if step % STEPS_PER_PING == 0
            && let Some((from, bearing)) = pings.next()
        {
            black_box(engine.ping(*from, *bearing));
        }
    }
}

/// A sink for events at the robot and for the plan's trace.
trait RobotSink: Sink {
    fn robot(&mut self, sim: &Simulation);
}

/// Discards everything.
struct NoLog;

impl Sink for NoLog {
    const ENABLED: bool = NoTrace::ENABLED;
    fn record(&mut self, _: Instant, _: &afp_core::trace::Record<'_>) {}
}

impl RobotSink for NoLog {
    fn robot(&mut self, _: &Simulation) {}
}

/// Records the origin and the bearing of each ping.
#[derive(Default)]
struct Pings {
    sent: Vec<(Pose, f64)>,
    last: Option<Instant>,
}

impl Sink for Pings {
    const ENABLED: bool = NoTrace::ENABLED;
    fn record(&mut self, _: Instant, _: &afp_core::trace::Record<'_>) {}
}

impl RobotSink for Pings {
    fn robot(&mut self, sim: &Simulation) {
        let snapshot = sim.snapshot();
        if let Some(sonar) = snapshot.sonar
            && self.last != Some(sonar.time)
        {
            self.last = Some(sonar.time);
            self.sent.push((snapshot.pose, sonar.bearing));
        }
    }
}

impl RobotSink for Recorder {
    fn robot(&mut self, sim: &Simulation) {
        let snapshot = sim.snapshot();
        let pose = snapshot.pose;
        let pose = Pose2 { x: pose.x, y: pose.y, heading: pose.heading };
        self.pose(snapshot.time, "world", pose);
        if let Some(sonar) = snapshot.sonar {
            let at = Pose2 { x: 0.0, y: 0.0, heading: sonar.bearing };
            let ranging = Ranging {
                time: sonar.time,
                frame: "base_link",
                pose: at,
                half_angle: 0.26,
                range: sonar.distance,
            };
            self.ranging(snapshot.time, "ultrasonic", ranging, 0.15);
        }
    }
}

/// The plan of the paper drives the robot until the end.
fn follow(world: &World, log: &mut impl RobotSink) {
    let (_, ended) = drive(WallFollowing::new(), world, log);
    assert!(!ended, "the robot follows the wall until the time limit");
}

/// A plan drives the robot until it ends or its time is up; returns the time, and whether it has
/// ended.
fn drive(plan: impl Plan<Simulation>, world: &World, log: &mut impl RobotSink) -> (Instant, bool) {
    let mut sim = Simulation::new(world, SEED).unwrap_or_else(|why| panic!("{why:?}"));
    let mut plan = Scheduler::new(plan);
    let wake = plan.start((&mut sim, &mut *log, &StillClock), Instant::ZERO);
    let mut wake = wake.unwrap_or_else(|why| panic!("{why:?}"));
    while let Wake::At(due) = wake
        && due <= END
    {
        sim.advance_to(due);
        wake = plan.step((&mut sim, &mut *log, &StillClock), due);
        log.robot(&sim);
    }
    (sim.now(), plan.ending().is_some())
}

/// The same run with a log.
fn logged(world: &World) {
    let name = format!("afp-bench-{}-{:?}.mcap", std::process::id(), time::Instant::now());
    let path = std::env::temp_dir().join(name);
    let names = Box::new(WallFollowing::new().names());
    let log = Recorder::create(&path, &About::default(), names, WhenFull::Wait);
    let mut log = log.unwrap_or_else(|why| panic!("{why}"));
    log.started(Instant::ZERO);
    follow(world, &mut log);
    log.finish().unwrap_or_else(|why| panic!("{why}"));
    // A remaining file in the temporary folder does no harm.
    let _ = std::fs::remove_file(path);
}
