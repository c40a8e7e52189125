//! The program under test: a plan on a robot with a serial line, in its own process.

use std::fs::File;
use std::io::{self, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::time::Duration as Span;

use afp::load::{LoadedPlan, Registry};
use afp_carbot::table::Carbot;
use afp_core::rt::Registry as _;
use afp_core::{Actor, Environment, Fault, Instant, Platform, Poll, Reason};
use afp_dsl::files::Texts;
use afp_dsl::{Toolboxes, compile};
use afp_platform::{Hardware, LastResort, RealTime, Robot, Samples, Settings, open_device};
use afp_run::options::RunOptions;
use afp_run::{Extras, Program, run_on_hardware};
use afp_session::{Opened, SessionError};
use afp_syntax::source::Source;
use clap::{Args, Command, FromArgMatches};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

mod templates {
    afp_macros::toolbox!("tests/port.afp", robot = super::Rover);
}

/// A robot that receives `drive` every 10 ms during motion, and `stop`.
pub struct Rover {
    time: RealTime,
    port: File,
    moves: bool,
    /// How often time has passed while it moves.
    advances: u32,
}

/// From here on the program under test has all that it needs.
const SETTLED: u32 = 50;

impl Rover {
    /// From the call that says so, the system kills the program for any system call of the control
    /// thread that is not on the list of the design.
    #[cfg(target_os = "linux")]
    fn trap(&mut self) {
        self.advances += 1;
        if self.advances == SETTLED && std::env::var(super::TRAP).is_ok() {
            afp_counting::trap_system_calls();
            self.say("trapped");
        }
    }

    #[cfg(not(target_os = "linux"))]
    fn trap(&mut self) {}

    fn say(&mut self, word: &str) {
        // A full line loses the word.
        let _ = writeln!(self.port, "{word}");
    }
}

impl Hardware for Rover {
    type Error = io::Error;

    fn open(settings: &Settings) -> io::Result<Self> {
        let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32;
        let port = settings.get_or("port", "");
        let port = open_device(File::options().read(true).write(true).custom_flags(flags), port)?;
        let mut modes = tcgetattr(&port)?;
        modes.make_raw();
        tcsetattr(&port, OptionalActions::Now, &modes)?;
        Ok(Rover { time: RealTime::start(), port, moves: false, advances: 0 })
    }

    fn last_resort(&self) -> Option<LastResort> {
        let mut port = self.port.try_clone().ok()?;
        Some(Box::new(move || drop(writeln!(port, "cut"))))
    }
}

impl Environment for Rover {
    fn stop(&mut self, _: Instant) {
        self.emergency_stop();
    }

    fn emergency_stop(&mut self) {
        self.moves = false;
        self.say("stop");
    }
}

impl Platform for Rover {
    type Clock = RealTime;

    fn clock(&self) -> RealTime {
        self.time
    }

    fn now(&self) -> Instant {
        self.time.now()
    }

    fn advance(&mut self, to: Instant) {
        if self.moves {
            self.say("drive");
            self.trap();
        }
        self.time.sleep_until(to);
    }
}

impl Robot for Rover {
    type Devices = Carbot;

    fn sample(&self, _: &mut Samples<'_, '_>) {}
}

#[derive(Clone)]
struct Go {
    does: String,
    polls: u32,
}

const FAILS: Fault = Fault::new(&Reason { code: "fails", text: "it fails" });

impl Actor<templates::Go, Rover> for Go {
    fn start(inputs: templates::go::Inputs, env: &mut Rover, _: Instant) -> Result<Self, Fault> {
        env.moves = true;
        Ok(Go { does: inputs.does.to_string(), polls: 0 })
    }

    fn poll(
        &mut self,
        _: templates::go::Live,
        env: &mut Rover,
        _: Instant,
    ) -> Result<Poll<templates::go::State>, Fault> {
        self.polls += 1;
        if self.polls < 20 && self.does != "laps" {
            return Ok(Poll::Pending);
        }
        match &*self.does {
            "arrives" | "laps" => Ok(Poll::Ready(templates::go::State::Arrived)),
            "fails" => Err(FAILS),
            "panics" => panic!("it breaks"),
            "hangs" => loop {
                env.say("hangs");
                std::thread::sleep(Span::from_secs(1000));
            },
            _ => Ok(Poll::Pending),
        }
    }

    fn interrupt(&mut self, env: &mut Rover, _: Instant) -> Result<(), Fault> {
        env.moves = false;
        Ok(())
    }
}

/// Runs a plan with options of `afpc run`, and ends the process.
pub fn drive(plan: &str, port: &str, options: &[&str]) -> ! {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    toolboxes.add(Source::new("port.afp", templates::SOURCE), "port");
    let compiled = compile(&Source::new("plan.afp", plan), &toolboxes, &Texts::default());
    let graph = compiled.graph.clone().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    registry.actor::<templates::Go, Go>("port", "Go");
    let command = RunOptions::augment_args(Command::new("rover").no_binary_name(true));
    let own = ["--robot", "hardware"];
    let options = command.get_matches_from(own.iter().chain(options));
    let options = RunOptions::from_arg_matches(&options).unwrap();
    // A busy machine must not count as a stall.
    let hardware = [("port", port), ("realtime.stall", "10 s")];
    let program = Program {
        name: "Rove",
        file: "plan.afp",
        texts: &[],
        toolboxes: &[],
        project: "",
        hardware: &hardware,
    };
    let open = |settings: &Settings| {
        let plan = LoadedPlan::new(&graph, &registry).map_err(SessionError::Load)?;
        Opened::new::<_, Rover>(plan, settings)
    };
    let code = match run_on_hardware(&program, Box::new(open), &options, Extras::default()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("{error}");
            error.code()
        }
    };
    std::process::exit(code.into());
}
