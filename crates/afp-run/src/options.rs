//! The options of `afpc run` and of every generated binary.
#![allow(
    rustdoc::invalid_html_tags,
    reason = "the comments are the help, in which '<plan>' is a name"
)]

mod help;
mod parse;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};

use afp_core::{Duration, Instant};
use afp_session::{DEFAULT_UNTIL, Pose2};
use clap::{Args, ValueEnum};

use crate::error::RunError;
use crate::world::change;

/// The prefix of settings of a real robot.
pub const OF_ROBOT: &str = "robot.";

pub(crate) use help::words;
pub use help::{for_devices, for_robot};
pub use parse::{Destination, Failure, Press, Speed, failure, press, whole};

/// The options of a run.
#[derive(Args, Clone, Debug)]
pub struct RunOptions {
    /// Robot that runs the plan
    #[arg(long, value_enum, value_name = "ROBOT", default_value_t = OnRobot::Sim)]
    pub robot: OnRobot,

    /// World file, map (.yaml) or random:SEED; else `[run] world` in afp.toml, else worlds/<plan>.toml, else a built-in room
    #[arg(long, value_name = "FILE")]
    pub world: Option<PathBuf>,

    /// Repeat the run of a log: its plan, world, seed, values and requests
    #[arg(
        long,
        value_name = "LOG",
        conflicts_with_all = ["world", "start", "set", "seed", "press", "fail"]
    )]
    pub again: Option<PathBuf>,

    /// Start pose of the robot [default: the world's]: --start 2m,1m,90deg
    #[arg(
        long,
        value_name = "X,Y,HEADING",
        value_parser = parse::start,
        allow_hyphen_values = true
    )]
    pub start: Option<Pose2>,

    /// Set an 'in' entry, with its unit, or a value of the world: --set distance=35cm, --set
    /// world.KEY=VALUE
    #[arg(long, value_name = "ENTRY=VALUE", value_parser = parse::assignment)]
    pub set: Vec<(String, String)>,

    /// Seed of all noise in the simulator
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        value_parser = whole,
        allow_hyphen_values = true
    )]
    pub seed: u64,

    /// Stop the plan at this time [default: 60s at speed max, else never]
    #[arg(
        long,
        value_name = "TIME",
        value_parser = afp_project::duration,
        allow_hyphen_values = true
    )]
    pub until: Option<Duration>,

    /// Speed of simulated time: 1x is real time, max has no limit [default: max; 1x with --live or --attach]
    #[arg(long, value_name = "SPEED", value_parser = parse::speed, allow_hyphen_values = true)]
    pub speed: Option<Speed>,

    /// Press a control of the robot: --press NAME@3s, --press DEVICE.NAME@3s
    #[arg(long, value_name = "CONTROL@TIME", value_parser = parse::press)]
    pub press: Vec<Press>,

    /// Inject a temporary or permanent fault: --fail DEVICE.FAULT@5s..7s, --fail
    /// DEVICE.FAULT=0.2@3s
    #[arg(long, value_name = "DEVICE.FAULT[=AMOUNT]@TIME[..TIME]", value_parser = parse::failure)]
    pub fail: Vec<Failure>,

    /// Also report this measure of the robot
    #[arg(long, value_name = "NAME")]
    pub measure: Vec<String>,

    /// Path of the log; 'none' for no log [default: target/afp/runs/<plan>.mcap]
    #[arg(long, value_name = "FILE", value_parser = parse::destination)]
    pub log: Option<Destination>,

    /// Also log the camera's pictures, twice a second
    #[arg(long)]
    pub camera: bool,

    /// Path of the picture, an SVG or (only afpc) a PNG; 'none' for no picture [default: target/afp/runs/<plan>.svg]
    #[arg(long, value_name = "FILE", value_parser = parse::destination)]
    pub svg: Option<Destination>,

    /// Print one JSON object per line, the summary last
    #[arg(long)]
    pub json: bool,

    /// Serve Foxglove and other viewers during the run, on a port or address
    /// [default: 127.0.0.1:8765]
    #[arg(
        long,
        hide = cfg!(not(feature = "live")),
        value_name = "ADDRESS",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "8765",
        value_parser = parse::address
    )]
    pub live: Option<SocketAddr>,

    /// Simulate the first second in the built-in room and print the trace's hash
    #[arg(long, conflicts_with_all = ["robot", "world", "again", "start", "press", "fail", "live"])]
    pub self_check: bool,

    /// Only stop the robot; needs '--robot hardware'
    #[arg(long, conflicts_with = "self_check")]
    pub stop_only: bool,

    /// Wait for the line 'arm' on standard input before the run
    #[arg(long, hide = true, conflicts_with_all = ["self_check", "stop_only"])]
    pub disarmed: bool,

    /// Print the delays and step times of the real robot's control loop
    #[arg(long)]
    pub rt_report: bool,

    /// Let debuggers attach to a simulated run, see 'afpc attach' [default speed: 1x]
    #[arg(long, hide = cfg!(not(unix)))]
    pub attach: bool,
}

/// The robot of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum OnRobot {
    /// The simulated robot
    #[default]
    Sim,
    /// The real robot of '[robot.hardware]' in afp.toml, in real time
    Hardware,
}

/// The part that limits the speed of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum TimeKeeper {
    /// No limit.
    Nobody,
    /// The gate of the run, at a multiple of real time.
    Gate(f64),
    /// The robot, which sleeps.
    Robot,
}

impl RunOptions {
    /// The output files.
    pub fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.log, &self.svg].into_iter().filter_map(|output| match output {
            Some(Destination::File(path)) => Some(path.as_path()),
            Some(Destination::None) | None => None,
        })
    }

    /// Refuses options that this release lacks.
    ///
    /// # Errors
    /// [`RunError::Usage`] explains the option.
    pub fn check(&self) -> Result<(), RunError> {
        if self.rt_report && self.robot == OnRobot::Sim {
            return Err(RunError::usage(
                "'--rt-report' measures the real robot's control loop, and this run is simulated",
                "add '--robot hardware', or leave it out",
            ));
        }
        if self.attach && self.robot == OnRobot::Sim && self.speed() == Speed::Max {
            return Err(RunError::usage(
                "'--attach' needs a run in real time, and this one has no limit",
                "leave '--speed max' out",
            ));
        }
        if self.camera && matches!(self.log, Some(Destination::None)) {
            return Err(RunError::usage(
                "'--camera' logs the camera's pictures, and there is no log",
                "leave out '--log none' or '--camera'",
            ));
        }
        match self.robot {
            OnRobot::Sim => self.check_sim(),
            OnRobot::Hardware => self.check_hardware(),
        }
    }

    /// Refuses options for real robots.
    fn check_sim(&self) -> Result<(), RunError> {
        if self.stop_only {
            return Err(RunError::usage(
                "'--stop-only' stops the real robot, and this run is simulated",
                "add '--robot hardware'",
            ));
        }
        let Some((name, _)) = self.set.iter().find(|(name, _)| name.starts_with(OF_ROBOT)) else {
            return Ok(());
        };
        Err(RunError::usage(
            format!("'{name}' is a setting of the real robot, and this run is simulated"),
            "add '--robot hardware', or leave it out",
        ))
    }

    /// Refuses options for simulations.
    fn check_hardware(&self) -> Result<(), RunError> {
        let of_simulation = [
            ("--world", self.world.is_some()),
            ("--again", self.again.is_some()),
            ("--start", self.start.is_some()),
            ("--seed", self.seed != 0),
            ("--speed", self.speed.is_some_and(|speed| speed != Speed::Times(1.0))),
            ("--press", !self.press.is_empty()),
            ("--fail", !self.fail.is_empty()),
            ("--measure", !self.measure.is_empty()),
        ];
        let option =
            of_simulation.iter().find(|(_, given)| *given).map(|(name, _)| name.to_string());
        let of_world = self.set.iter().find(|(name, _)| change::key(name).is_some());
        match option.or(of_world.map(|(name, _)| format!("--set {name}"))) {
            None => Ok(()),
            Some(option) => Err(RunError::usage(
                format!("'{option}' is only for the simulated robot"),
                format!("leave out '{option}' or '--robot hardware'"),
            )),
        }
    }

    pub(crate) fn time_keeper(&self) -> TimeKeeper {
        match (self.robot, self.speed()) {
            (OnRobot::Hardware, _) => TimeKeeper::Robot,
            (OnRobot::Sim, Speed::Max) => TimeKeeper::Nobody,
            (OnRobot::Sim, Speed::Times(times)) => TimeKeeper::Gate(times),
        }
    }

    /// The speed of time; by default unlimited, or real time while other programs watch.
    pub fn speed(&self) -> Speed {
        let real = self.live.is_some() || self.attach || self.robot == OnRobot::Hardware;
        let usual = if real { Speed::Times(1.0) } else { Speed::Max };
        self.speed.unwrap_or(usual)
    }

    /// The time limit of the run.
    pub fn end(&self) -> Instant {
        match (self.until, self.speed()) {
            (Some(until), _) => Instant::ZERO + until,
            (None, Speed::Max) => Instant::ZERO + DEFAULT_UNTIL,
            (None, Speed::Times(_)) => Instant::MAX,
        }
    }
}
