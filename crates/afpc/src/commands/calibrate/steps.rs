//! The steps of a calibration, and the questions to the user.

use std::io::{self, BufRead};

use afp_pi::{Calibrated, Drive, Halt, Spin, Straight};
use afp_run::{RunError, say};
use afp_types::{SingleUnit, parse_quantity};

use super::written::Part;

/// The length of the drive in metres, and the number of turns.
const AHEAD: f64 = 2.0;
const TURNS: f64 = 10.0;
/// The same with the wheels off the ground.
const SHORT: (f64, f64) = (0.2, 0.5);
/// The number of circles of a car.
const CIRCLES: f64 = 2.0;

/// The rest of a calibration.
pub struct Steps<'a> {
    pub robot: &'a mut dyn Calibrated,
    pub user: User,
    pub goes: &'a dyn Fn() -> bool,
}

impl Steps<'_> {
    /// Does the next step; returns whether there was one.
    ///
    /// # Errors
    /// The drive ended early, or the user ended the input.
    pub fn next(&mut self, part: &mut Part, has_sonar: bool) -> Result<bool, RunError> {
        if !part.wheels {
            self.wheels()?;
            part.wheels = true;
        } else if part.straight.is_none() {
            let (straight, stop) = self.straight()?;
            // A car without encoders does not notice when it stops.
            part.stop = (!self.is_car()).then_some(stop);
            part.straight = Some(straight);
        } else if part.spin.is_none() {
            part.spin = Some(self.spin()?);
            part.radius = self.robot.radius();
        } else if has_sonar && part.offset.is_none() {
            part.offset = Some(self.sonar()?);
        } else {
            return Ok(false);
        }
        Ok(true)
    }

    /// Whether the robot steers and has no encoders.
    fn is_car(&self) -> bool {
        self.robot.radius() > 0.0
    }

    fn wheels(&mut self) -> Result<(), RunError> {
        let (then, seen) = match self.is_car() {
            true => ("then in a curve", "Did the front wheels steer to the left?"),
            false => (
                "then against each other",
                "Did the right wheel turn forwards and the left wheel backwards?",
            ),
        };
        let lift = format!("Lift the wheels off the ground. Both turn forwards, {then}.");
        self.user.wait(&lift)?;
        let (metres, turns) = SHORT;
        finished(self.robot.ahead(metres, self.goes))?;
        self.user.agree("Did both wheels turn forwards?")?;
        finished(self.robot.turns(turns, self.goes))?;
        self.user.agree(seen)
    }

    fn straight(&mut self) -> Result<(Straight, f64), RunError> {
        self.user.wait(
            "Put the robot on the floor with 2.5 m of free way. Draw the line on which it stands, in \
             its direction, and mark the middle between its wheels. It drives 2 m.",
        )?;
        let Drive { way, turned, stop } = finished(self.robot.ahead(AHEAD, self.goes))?;
        let ahead =
            self.user.length("How far along the line did the middle come, such as 201.5 cm?")?;
        let left =
            self.user.length("How far is it left of the line? To the right, write -3 cm.")?;
        Ok((Straight { counted: way, turned, end: [ahead, left] }, stop.as_secs_f64()))
    }

    fn spin(&mut self) -> Result<Spin, RunError> {
        let (turns, many, what) = match self.is_car() {
            true => (CIRCLES, "two", "drives two circles to the left"),
            false => (TURNS, "ten", "turns ten times to the left on the spot"),
        };
        let mark = format!("Mark the direction of the robot. It {what}. Count the turns.");
        self.user.wait(&mark)?;
        let drive = finished(self.robot.turns(turns, self.goes))?;
        let beyond = self.user.angle(&format!(
            "How far did it turn beyond {many} turns, such as 15 deg? If it fell short, write -15 deg."
        ))?;
        Ok(Spin { counted: drive.turned, seen: turns * std::f64::consts::TAU + beyond })
    }

    fn sonar(&mut self) -> Result<f64, RunError> {
        let wall = self.user.length(
            "Put the robot in front of a wall, about half a metre away. How far is the wall from the \
             axis of the servo?",
        )?;
        let heard = self.robot.echoes(self.goes).map_err(error)?.ok_or_else(|| {
            let help = "the wall must be flat and in front of the robot; run the command again";
            RunError::usage("the range sensor hears no wall", help)
        })?;
        match wall - heard {
            offset if offset.abs() <= 0.1 => Ok(offset),
            offset => Err(RunError::usage(
                format!("the sensor hears the wall {:.1} cm too near", offset * 100.0),
                "measure from the servo's axis; run the command again",
            )),
        }
    }
}

fn finished(drive: Result<Drive, Halt>) -> Result<Drive, RunError> {
    drive.map_err(error)
}

fn error(halt: Halt) -> RunError {
    RunError::usage(halt.to_string(), AGAIN)
}

const AGAIN: &str = "run 'afpc calibrate' again: it continues with this step";

/// The person at the terminal.
pub struct User;

impl User {
    fn ask(&self, question: &str) -> Result<String, RunError> {
        say(question);
        let mut line = String::new();
        let read = io::stdin().lock().read_line(&mut line);
        match read.map_err(RunError::file("cannot read", "standard input".as_ref()))? {
            0 => Err(RunError::usage("the calibration is not finished", AGAIN)),
            _ => Ok(line.trim().to_owned()),
        }
    }

    fn wait(&self, what: &str) -> Result<(), RunError> {
        self.ask(&format!("{what} Press Enter.")).map(|_| ())
    }

    fn agree(&self, question: &str) -> Result<(), RunError> {
        match &*self.ask(&format!("{question} [y/n]"))? {
            "y" | "yes" => Ok(()),
            _ => Err(RunError::usage(
                "the wheels do not turn as the program expects",
                "swap the two wires of a motor that turns backwards; then run the command again",
            )),
        }
    }

    fn length(&self, question: &str) -> Result<f64, RunError> {
        self.quantity(question, "length", "a length such as '12.5 cm'")
    }

    fn angle(&self, question: &str) -> Result<f64, RunError> {
        self.quantity(question, "angle", "an angle such as '15 deg'")
    }

    /// Asks until the answer is a quantity.
    fn quantity(&self, question: &str, kind: &str, what: &str) -> Result<f64, RunError> {
        loop {
            let answer = self.ask(question)?;
            match parse_quantity(&answer, SingleUnit::of(kind).map(SingleUnit::unit)) {
                Ok(value) => return Ok(value),
                Err(_) => say(format_args!("'{answer}' is not {what}")),
            }
        }
    }
}
