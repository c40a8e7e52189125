//! The syntax of option values.

use std::fmt;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use afp_core::Instant;
use afp_excerpt::words::read_setting;
use afp_project::duration;
use afp_session::Pose2;

use crate::world::Measure;

/// The speed of simulated time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// As fast as the machine allows.
    Max,
    /// A multiple of real time.
    Times(f64),
}

/// A press of a control at an instant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Press {
    pub control: String,
    pub at: Instant,
}

/// A fault that begins at an instant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    pub device: String,
    pub kind: String,
    /// The amount as written.
    pub amount: Option<String>,
    pub from: Instant,
    /// `None`: until the end of the run.
    pub to: Option<Instant>,
}

impl fmt::Display for Press {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}s", self.control, self.at.as_secs_f64())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.device, self.kind)?;
        if let Some(amount) = &self.amount {
            write!(f, "={amount}")?;
        }
        write!(f, "@{}s", self.from.as_secs_f64())?;
        self.to.map_or(Ok(()), |to| write!(f, "..{}s", to.as_secs_f64()))
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    None,
    File(PathBuf),
}

pub(super) fn speed(text: &str) -> Result<Speed, String> {
    if text == "max" {
        return Ok(Speed::Max);
    }
    let number = text.strip_suffix('x').and_then(|number| number.parse::<f64>().ok());
    match number {
        Some(times) if times > 0.0 && times.is_finite() => Ok(Speed::Times(times)),
        _ => Err("expected 'max' or a multiple of real time such as 1x".to_owned()),
    }
}

/// Reads a whole number, such as a seed.
///
/// # Errors
/// It is negative or not a whole number.
pub fn whole(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("expected a whole number from 0 to {}", u64::MAX))
}

/// Reads `8765`, a port of this machine only, or `0.0.0.0:8765`.
pub(super) fn address(text: &str) -> Result<SocketAddr, String> {
    match text.parse::<u16>() {
        Ok(port) => Ok((Ipv4Addr::LOCALHOST, port).into()),
        Err(_) => text.parse().map_err(|_| {
            "expected a port, 8765, or the number of an interface with one, 0.0.0.0:8765".to_owned()
        }),
    }
}

/// Reads `start@20s`. Does not check that the robot has the control.
///
/// # Errors
/// A syntax error.
pub fn press(text: &str) -> Result<Press, String> {
    let (control, time) =
        text.split_once('@').ok_or("expected a control and a time, CONTROL@20s")?;
    Ok(Press { control: control.to_owned(), at: instant(time)? })
}

/// Reads `wheels.slip=0.2@3s..5s`. Does not check that the robot has the fault.
///
/// # Errors
/// A syntax error.
pub fn failure(text: &str) -> Result<Failure, String> {
    let (what, when) = text
        .split_once('@')
        .ok_or("expected a fault and its time, DEVICE.FAULT@5s or DEVICE.FAULT@5s..7s")?;
    let (what, amount) = match what.split_once('=') {
        Some((what, amount)) => (what, Some(amount.to_owned())),
        None => (what, None),
    };
    let (device, kind) = what.split_once('.').unwrap_or((what, ""));
    let (from, to) = match when.split_once("..") {
        Some((from, to)) => (instant(from)?, Some(instant(to)?)),
        None => (instant(when)?, None),
    };
    if to.is_some_and(|to| to <= from) {
        return Err("it ends before it begins".to_owned());
    }
    Ok(Failure { device: device.to_owned(), kind: kind.to_owned(), amount, from, to })
}

fn instant(text: &str) -> Result<Instant, String> {
    Ok(Instant::ZERO + duration(text)?)
}

/// Reads `2m,1m,90deg`.
pub(super) fn start(text: &str) -> Result<Pose2, String> {
    let wrong = || "expected x, y and a heading, such as 2m,1m,90deg".to_owned();
    let quantity = |text: &str, measure: Measure| measure.read(text.trim()).map_err(|_| wrong());
    let [x, y, heading] = text.split(',').collect::<Vec<_>>().try_into().map_err(|_| wrong())?;
    Ok(Pose2 {
        x: quantity(x, Measure::Length)?,
        y: quantity(y, Measure::Length)?,
        heading: quantity(heading, Measure::Angle)?.to_radians(),
    })
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) =
        read_setting(text).ok_or("expected an entry and its value, such as distance=35cm")?;
    Ok((name.to_owned(), value.to_owned()))
}

pub(super) fn destination(text: &str) -> Result<Destination, String> {
    Ok(match text {
        "none" => Destination::None,
        "" => return Err("expected the name of a file, or 'none'".to_owned()),
        path => Destination::File(path.into()),
    })
}

#[cfg(test)]
mod tests {
    use afp_core::Duration;

    use super::*;

    #[test]
    fn a_press_has_a_name_and_a_time() {
        let at = Instant::ZERO + Duration::from_secs(20);
        assert_eq!(press("escape@20s"), Ok(Press { control: "escape".to_owned(), at }));
        assert!(press("escape").is_err());
    }

    #[test]
    fn a_parsed_value_is_displayed_as_written() {
        for text in
            ["ultrasonic.frozen@5s..7s", "odometry.delayed=300ms@1.5s", "wheels.slip=0.3@0s"]
        {
            assert_eq!(failure(text).map(|failure| failure.to_string()), Ok(text.to_owned()));
        }
        assert_eq!(
            press("touch@0.25s").map(|press| press.to_string()),
            Ok("touch@0.25s".to_owned())
        );
    }

    #[test]
    fn a_fault_has_a_time_range_that_increases() {
        for (text, says) in [
            ("ultrasonic.frozen", "DEVICE.FAULT@5s..7s"),
            ("touch.lost@3s..2s", "it ends before it begins"),
            ("touch.lost@3", "20s or 500ms"),
        ] {
            let error = failure(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
        }
    }

    #[test]
    fn a_start_has_units() {
        let pose = start("1m, -50cm,180deg").unwrap();
        assert_eq!((pose.x, pose.y, pose.heading), (1.0, -0.5, std::f64::consts::PI));
        let small = start("100um,1mm,100mrad").unwrap();
        assert_eq!((small.x, small.y), (0.0001, 0.001));
        assert!((small.heading - 0.1).abs() < 1e-15);
        for wrong in ["1,2,3", "1m,2m", "1m,2m,90deg,", "1m,2m,1m", "", "1m,2s,0deg"] {
            assert!(start(wrong).is_err_and(|why| why.contains("2m,1m,90deg")), "{wrong}");
        }
    }

    #[test]
    fn addresses_are_local_by_default() {
        assert_eq!(address("8765"), Ok(([127, 0, 0, 1], 8765).into()));
        assert_eq!(address("0.0.0.0:80"), Ok(([0, 0, 0, 0], 80).into()));
        assert!(address("[::1]:80").is_ok_and(|at| at.ip().is_loopback()));
        for wrong in ["", "70000", "here", "1.2.3.4", "wall.afp"] {
            assert!(address(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn speeds_are_multiples() {
        assert_eq!(speed("1x"), Ok(Speed::Times(1.0)));
        assert_eq!(speed("0.5x"), Ok(Speed::Times(0.5)));
        assert!(speed("fast").is_err());
        assert!(speed("0x").is_err());
    }
}
