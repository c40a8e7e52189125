//! The real vacuum cleaner: a board on a serial line drives the motors and reads the sensors.
//!
//! [`vacuum_protocol`] has the messages. The board stops the motors after 200 ms without a command,
//! so the driver repeats its commands every 20 ms, which takes 15 % of 115,200 baud. A board that has
//! stopped while it moved obeys again after the next start. A stop is sent at once, before everything
//! in the output queue. While the board is silent, the driver sends only stops. After a restart of
//! the board the driver also sends only stops, because the counters and the state were reset.

mod line;

use std::error::Error;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::{io, mem, thread};

use afp::core::{Invalid, Platform};
use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Environment, Instant, Reading};
use afp_platform::{Hardware, LastResort, RealTime, Robot, SampleRef, Samples, Settings};
use vacuum::templates::devices::Devices;
use vacuum::templates::signal;
use vacuum::{Nozzle, Senses, Way, Wheels};
use vacuum_protocol::{Command, Report};

use line::{Ear, Heard, Line};

/// Speed of the serial line, unless the settings have another 'baud'.
const BAUD: &str = "115200";

/// Reports are discarded after this time.
const STALE: Duration = Duration::from_millis(100);
/// Commands are repeated this often.
const OFTEN: Duration = Duration::from_millis(20);
/// The slowest line in baud that carries 45 bytes of ten bits every 20 ms.
const SLOWEST: u32 = 38_400;
/// Time between two looks at the line.
const GLANCE: std::time::Duration = std::time::Duration::from_millis(2);

/// The robot.
pub struct Board {
    time: RealTime,
    line: Line,
    /// The board's last message.
    heard: Arc<Mutex<Option<Heard>>>,
    asked: [f64; 2],
    suction: bool,
    /// The time of the last commands.
    told: Instant,
}

impl Board {
    fn heard(&self) -> Option<Heard> {
        *self.heard.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The last report, or the reason why there is none. A board that has stopped by itself counts as silent.
    fn report(&self) -> Result<(Report, Instant), Invalid> {
        match self.heard() {
            Some(Heard::Report(report, at))
                if self.time.now().since(at) < STALE && !report.stopped =>
            {
                Ok((report, at))
            }
            Some(Heard::Restarted) => Err(Invalid::Restarted),
            _ => Err(Invalid::NoAnswer),
        }
    }

    /// A sensor's reading, from the last report.
    fn sense<T: Copy>(&self, of: impl Fn(&Report) -> T) -> Reading<T> {
        match self.report() {
            Ok((report, at)) => Reading::valid(of(&report), at),
            Err(why) => Reading::invalid(why, self.time.now()),
        }
    }

    /// Repeats the commands if it is time.
    fn tell_again(&mut self) {
        if self.time.now().since(self.told) >= OFTEN {
            self.tell();
        }
    }

    /// Connects and starts the board. Frames may be lost, so both are repeated until the board obeys.
    fn begin(&mut self) -> Result<(), String> {
        let patience = self.time.now() + Duration::from_secs(1);
        loop {
            self.line.hello();
            self.line.say(&[Command::Start]);
            self.time.sleep_until(self.time.now() + OFTEN);
            match self.heard() {
                Some(Heard::Report(Report { stopped: false, .. }, _)) => return Ok(()),
                Some(Heard::Version(theirs)) => {
                    let ours = vacuum_protocol::VERSION;
                    return Err(format!(
                        "the board has version {theirs} of the protocol, this program version {ours}"
                    ));
                }
                _ if self.time.now() <= patience => {}
                Some(Heard::Report(..)) => return Err("the board does not start".to_owned()),
                Some(Heard::Restarted) => return Err("the board restarts".to_owned()),
                None => return Err("the board does not answer".to_owned()),
            }
        }
    }

    fn tell(&mut self) {
        self.told = self.time.now();
        self.line.say(&self.wanted());
    }

    fn tell_at_once(&mut self) {
        self.told = self.time.now();
        self.line.say_at_once(&self.wanted());
    }

    /// The commands: a stop while the board is silent, because a board that still receives would
    /// not stop by itself, and `Stop` after a restart.
    fn wanted(&self) -> Vec<Command> {
        match self.report() {
            Ok(_) => {
                let [speed, turn] = self.asked;
                vec![Command::Drive { speed, turn }, Command::Suck(self.suction)]
            }
            Err(Invalid::Restarted) => vec![Command::Stop],
            Err(_) => vec![Command::Drive { speed: 0.0, turn: 0.0 }, Command::Suck(false)],
        }
    }
}

/// Keeps the board's messages, until the line or the driver ends. Nothing follows a restart.
fn listen(mut ear: Ear, time: RealTime, heard: Weak<Mutex<Option<Heard>>>) {
    while let Some(heard) = heard.upgrade() {
        match ear.hear(&time) {
            Ok(said) => {
                let mut heard = heard.lock().unwrap_or_else(PoisonError::into_inner);
                if *heard != Some(Heard::Restarted) {
                    *heard = Some(said);
                }
            }
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => thread::sleep(GLANCE),
            Err(_) => return,
        }
    }
}

impl Hardware for Board {
    type Error = Box<dyn Error + Send + Sync>;

    fn open(settings: &Settings) -> Result<Self, Self::Error> {
        let port = settings.get("port").ok_or("'settings' in afp.toml does not say the 'port'")?;
        let baud = settings.get_or("baud", BAUD);
        let baud =
            baud.parse().map_err(|_| format!("'baud' is a number such as {BAUD}, not '{baud}'"))?;
        if baud < SLOWEST {
            let why = format!("'baud' is {SLOWEST} or more, not '{baud}': commands would be late");
            return Err(why.into());
        }
        let (line, ear) = line::open(port, baud).map_err(|error| format!("'{port}': {error}"))?;
        let (time, heard) = (RealTime::start(), Arc::new(Mutex::new(None)));
        let hears = Arc::downgrade(&heard);
        thread::spawn(move || listen(ear, time, hears));
        let told = time.now();
        let mut board = Board { time, line, heard, asked: [0.0; 2], suction: false, told };
        board.begin().map_err(|error| format!("'{port}': {error}"))?;
        Ok(board)
    }

    fn last_resort(&self) -> Option<LastResort> {
        self.line.last_resort()
    }
}

impl Environment for Board {
    fn stop(&mut self, _: Instant) {
        (self.asked, self.suction) = ([0.0; 2], false);
        self.tell_at_once();
    }

    fn emergency_stop(&mut self) {
        (self.asked, self.suction) = ([0.0; 2], false);
        self.line.say_at_once(&[Command::Stop]);
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.emergency_stop();
        self.line.release();
    }
}

impl Platform for Board {
    type Clock = RealTime;

    fn clock(&self) -> RealTime {
        self.time
    }

    fn now(&self) -> Instant {
        self.time.now()
    }

    fn advance(&mut self, to: Instant) {
        loop {
            self.tell_again();
            self.time.sleep_until(to.min(self.told + OFTEN));
            // A sleep that lasted too long is noticed before anything is sent.
            if self.time.now() >= to {
                return;
            }
        }
    }
}

impl Wheels for Board {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed) {
        let asked = [speed.si(), turn.si()];
        let before = mem::replace(&mut self.asked, asked);
        if asked == [0.0; 2] && asked != before {
            self.tell_at_once();
        }
    }

    fn way(&self) -> Reading<Way> {
        self.sense(|report| {
            let [ahead, turned] = report.way;
            Way { ahead: Length::from_si(ahead), turned: Angle::from_si(turned) }
        })
    }
}

impl Nozzle for Board {
    fn suck(&mut self, on: bool) {
        self.suction = on;
    }
}

impl Senses for Board {
    fn bumper(&self) -> Reading<[bool; 2]> {
        self.sense(|report| report.bumper)
    }

    fn drop(&self) -> Reading<bool> {
        self.sense(|report| report.drop)
    }

    fn dirt(&self) -> Reading<f64> {
        self.sense(|report| report.dirt)
    }

    fn button(&self) -> Reading<bool> {
        self.sense(|report| report.button)
    }
}

impl Robot for Board {
    type Devices = Devices;
    /// No device knows the robot's pose.
    const LACKS: &'static [&'static str] = &["robot"];

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let Ok((report, _)) = self.report() else { return };
        let [left, right] = report.bumper;
        to.put(signal::BUMPER_LEFT, SampleRef::Bool(left));
        to.put(signal::BUMPER_RIGHT, SampleRef::Bool(right));
        to.put(signal::CLIFF_DROP, SampleRef::Bool(report.drop));
        to.put(signal::DIRT_LEVEL, SampleRef::Float(report.dirt));
        to.put(signal::BUTTON_HALT, SampleRef::Bool(report.button));
        to.put(signal::SUCTION_ON, SampleRef::Bool(self.suction));
    }
}
