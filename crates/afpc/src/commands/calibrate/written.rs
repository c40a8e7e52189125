//! The files of a calibration: the finished steps, and the result.

use std::time::{SystemTime, UNIX_EPOCH};

use afp_pi::{Spin, Straight, solve, solve_car};
use afp_project::ProfileRobot;
use serde::{Deserialize, Serialize};

/// The finished steps.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Part {
    robot: String,
    /// The hash of afp.toml, whose values the drives used.
    project: String,
    pub wheels: bool,
    pub straight: Option<Straight>,
    pub spin: Option<Spin>,
    /// The radius of the turns in metres.
    pub radius: f64,
    /// The distance to add to an echo, in metres.
    pub offset: Option<f64>,
    /// The time from the command to stop to standstill, in seconds.
    pub stop: Option<f64>,
}

impl Part {
    pub fn new(robot: &str, project: String) -> Self {
        Part { robot: robot.to_owned(), project, ..Part::default() }
    }

    /// Whether it is of the same robot.
    pub fn is_of(&self, other: &Part) -> bool {
        self.robot == other.robot && self.project == other.project
    }
}

/// The text of `calibration.toml`; `None` if steps are missing or the numbers are impossible.
pub fn calibration(robot: &ProfileRobot, part: &Part) -> Option<String> {
    let drive = match robot.number("drive.wheelbase") {
        Some(wheelbase) => car(robot, part, wheelbase)?,
        None => wheels(robot, part)?,
    };
    let mut text = format!(
        "# Written by 'afpc calibrate'. Its values replace those of '[robot]' in afp.toml.\n\
         date = \"{}\"\nrobot = \"{}\"\n\n[drive]\n{drive}",
        today(),
        robot.name,
    );
    if let Some(offset) = part.offset {
        text += &format!("\n[ultrasonic]\noffset = \"{:.1} mm\"\n", offset * 1000.0);
    }
    if let Some(stop) = part.stop {
        text += &format!("\n[measured]\nstop = \"{:.0} ms\"\n", stop * 1000.0);
    }
    Some(text)
}

/// The values of a car without encoders.
fn car(robot: &ProfileRobot, part: &Part, wheelbase: f64) -> Option<String> {
    let circles = (part.radius, part.spin.as_ref()?);
    let found = solve_car(wheelbase, part.straight.as_ref()?, circles)?;
    // The drives used the values of afp.toml.
    let fastest = robot.number("drive.fastest")? * found.scale;
    let straight = robot.number("drive.straight").unwrap_or_default() + found.straight;
    Some(format!(
        "fastest = \"{:.3} cm/s\"\nwheelbase = \"{:.2} mm\"\nstraight = \"{:.2} deg\"\n",
        fastest * 100.0,
        found.wheelbase * 1000.0,
        straight.to_degrees()
    ))
}

/// The values of driven wheels with encoders.
fn wheels(robot: &ProfileRobot, part: &Part) -> Option<String> {
    let (straight, spin) = (part.straight.as_ref()?, part.spin.as_ref()?);
    let found = solve(robot.number("drive.track")?, straight, spin)?;
    // The drives used the values of afp.toml, which may have a trim.
    let trim = robot.number("drive.trim").unwrap_or(1.0) * found.trim;
    let mut text = format!("track = \"{:.2} mm\"\ntrim = {trim:.5}\n", found.track * 1000.0);
    text += &match robot.number("drive.wheel_diameter") {
        Some(diameter) => {
            format!("wheel_diameter = \"{:.3} mm\"\n", diameter * found.scale * 1000.0)
        }
        None => {
            let scale = robot.number("drive.scale").unwrap_or(1.0) * found.scale;
            format!("scale = {scale:.5}\n")
        }
    };
    Some(text)
}

/// Today's date in UTC, by the clock of this computer: `2026-11-29`.
fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    date(since.as_secs() / 86_400)
}

/// The date of a day after 1970-01-01.
fn date(mut days: u64) -> String {
    let mut year = 1970;
    let is_leap = |year: u64| {
        year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
    };
    loop {
        let length = if is_leap(year) { 366 } else { 365 };
        if days < length {
            break;
        }
        days -= length;
        year += 1;
    }
    let february = if is_leap(year) { 29 } else { 28 };
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_become_dates() {
        let days = [0, 58, 59, 11_016, 11_017, 20_786, 20_818];
        let dates = days.map(date);
        let expected = [
            "1970-01-01",
            "1970-02-28",
            "1970-03-01",
            "2000-02-29",
            "2000-03-01",
            "2026-11-29",
            "2026-12-31",
        ];
        assert_eq!(dates, expected);
    }
}
