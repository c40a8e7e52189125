//! The vacuum cleaner itself: a board that drives motors and reads sensors, spoken to over a serial line.
//!
//! [`vacuum_protocol`] is what is said there. A board that has heard nothing for 200 ms stops the motors by itself; so what is asked
//! for is said every 20 ms, whether it has changed or not, and takes 20 % of 115,200 baud. Standing still alone is said at once, before
//! whatever waits on the line. While the board says nothing, standing still is all that is asked for.

mod line;

use std::error::Error;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::{io, thread};

use afp::core::{Invalid, Platform};
use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{Duration, Environment, Instant, Reading};
use afp_platform::{Hardware, LastResort, RealTime, Robot, SampleRef, Samples, Settings};
use vacuum::templates::devices::Devices;
use vacuum::templates::signal;
use vacuum::{Nozzle, Senses, Way, Wheels};
use vacuum_protocol::{Command, Report};

use line::{Ear, Line};

/// Of the serial line, unless 'baud' in the settings says another one.
const BAUD: &str = "115200";

/// What the board has not said for so long is not known any more.
const STALE: Duration = Duration::from_millis(100);
/// The board hears from us this often.
const OFTEN: Duration = Duration::from_millis(20);
/// A slower line, in baud, would not carry that: 45 bytes of ten bits every 20 ms.
const SLOWEST: u32 = 38_400;
/// How long to wait for what the board says.
const GLANCE: std::time::Duration = std::time::Duration::from_millis(2);

/// The robot.
pub struct Board {
    time: RealTime,
    line: Line,
    /// What the board said last, and when.
    heard: Arc<Mutex<Option<(Report, Instant)>>>,
    asked: [f64; 2],
    suction: bool,
    /// When it was said last what is asked for.
    told: Instant,
}

impl Board {
    /// What the board said last, unless that was too long ago.
    fn said(&self) -> Option<(Report, Instant)> {
        let heard = *self.heard.lock().unwrap_or_else(PoisonError::into_inner);
        heard.filter(|(_, at)| self.time.now().since(*at) < STALE)
    }

    /// A sensor's reading; lost where the board says nothing any more.
    fn sense<T: Copy>(&self, of: impl Fn(&Report) -> T) -> Reading<T> {
        match self.said() {
            Some((said, at)) => Reading::valid(of(&said), at),
            None => Reading::invalid(Invalid::NoAnswer, self.time.now()),
        }
    }

    /// Says what is asked for, where the board has not heard from us for a while.
    fn tell_again(&mut self) {
        if self.time.now().since(self.told) >= OFTEN {
            self.tell();
        }
    }

    /// Tells the board to start, again and again, since a word may be lost, until it says that it obeys.
    fn begin(&mut self) -> Result<(), &'static str> {
        let patience = self.time.now() + Duration::from_secs(1);
        loop {
            self.line.say(&[Command::Start]);
            self.time.sleep_until(self.time.now() + OFTEN);
            match self.said() {
                Some((Report { stopped: false, .. }, _)) => return Ok(()),
                _ if self.time.now() <= patience => {}
                Some(_) => return Err("the board says that it is stopped, whatever it is told"),
                None => return Err("the board says nothing"),
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

    /// What is asked for; while the board is not heard, to stand still: as long as it hears, it would not stop by itself.
    fn wanted(&self) -> [Command; 2] {
        let heard = self.said().is_some();
        let [speed, turn] = if heard { self.asked } else { [0.0; 2] };
        [Command::Drive { speed, turn }, Command::Suck(heard && self.suction)]
    }
}

/// Keeps what the board says, until the line ends or nobody asks for it any more.
fn listen(mut ear: Ear, time: RealTime, heard: Weak<Mutex<Option<(Report, Instant)>>>) {
    while let Some(heard) = heard.upgrade() {
        match ear.hear() {
            Ok(said) => {
                *heard.lock().unwrap_or_else(PoisonError::into_inner) = Some((said, time.now()));
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
        while self.time.now() < to {
            self.tell_again();
            self.time.sleep_until(to.min(self.told + OFTEN));
        }
        self.tell_again();
    }
}

impl Wheels for Board {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed) {
        let asked = [speed.si(), turn.si()];
        let stands = asked == [0.0; 2] && asked != self.asked;
        self.asked = asked;
        if stands {
            self.tell_at_once();
        }
    }

    fn way(&self) -> Way {
        // Counters that are not known any more stand still, and soon so do the wheels: the board has stopped them, or is told to.
        let heard = *self.heard.lock().unwrap_or_else(PoisonError::into_inner);
        let way = heard.map_or([0.0; 2], |(said, _)| said.way);
        Way { ahead: Length::from_si(way[0]), turned: Angle::from_si(way[1]) }
    }
}

impl Nozzle for Board {
    fn suck(&mut self, on: bool) {
        self.suction = on;
    }
}

impl Senses for Board {
    fn bumper(&self) -> Reading<[bool; 2]> {
        self.sense(|said| said.bumper)
    }

    fn drop(&self) -> Reading<bool> {
        self.sense(|said| said.drop)
    }

    fn dirt(&self) -> Reading<f64> {
        self.sense(|said| said.dirt)
    }

    fn button(&self) -> Reading<bool> {
        self.sense(|said| said.button)
    }
}

impl Robot for Board {
    type Devices = Devices;
    /// Nobody tells where it is.
    const LACKS: &'static [&'static str] = &["robot"];

    fn sample(&self, to: &mut Samples<'_, '_>) {
        let Some((said, _)) = self.said() else { return };
        let [left, right] = said.bumper;
        to.put(signal::BUMPER_LEFT, SampleRef::Bool(left));
        to.put(signal::BUMPER_RIGHT, SampleRef::Bool(right));
        to.put(signal::CLIFF_DROP, SampleRef::Bool(said.drop));
        to.put(signal::DIRT_LEVEL, SampleRef::Float(said.dirt));
        to.put(signal::BUTTON_HALT, SampleRef::Bool(said.button));
        to.put(signal::SUCTION_ON, SampleRef::Bool(self.suction));
    }
}
