//! The values of options as people write them.

use std::path::PathBuf;

use afp_carbot::table::{Carbot, TABLE};
use afp_core::devices::{AmountRow, Devices, faults};
use afp_core::{Duration, Instant};
use afp_project::duration;
use afp_sim::Fault;

/// How fast simulated time passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// As fast as the machine allows.
    Max,
    /// So many times as fast as real time.
    Times(f64),
}

/// A button pressed at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Press {
    /// Which one.
    pub button: Button,
    /// When.
    pub at: Instant,
}

/// What can be pressed on the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The escape button.
    Escape,
    /// The bumper.
    Touch,
}

/// Something that breaks at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Failure {
    /// What breaks, and how.
    pub fault: Fault,
    /// From when on.
    pub from: Instant,
    /// For how long; [`Duration::MAX`] for good.
    pub lasting: Duration,
}

/// Where output goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Nowhere.
    None,
    /// Into this file.
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

pub(super) fn press(text: &str) -> Result<Press, String> {
    let (button, time) =
        text.split_once('@').ok_or("expected a button and a time, such as escape@20s")?;
    let button = match button {
        "escape" => Button::Escape,
        "touch" => Button::Touch,
        other => {
            return Err(format!("the robot has no button '{other}'; it has 'escape' and 'touch'"));
        }
    };
    Ok(Press { button, at: instant(time)? })
}

pub(super) fn failure(text: &str) -> Result<Failure, String> {
    let (what, when) = text
        .split_once('@')
        .ok_or("expected what fails, how and when, such as ultrasonic.frozen@5s..7s")?;
    let (what, amount) = match what.split_once('=') {
        Some((what, amount)) => (what, Some(amount)),
        None => (what, None),
    };
    let (device, kind) = what.split_once('.').unwrap_or((what, ""));
    let found = faults(TABLE).find(|(_, at, row)| at.name == device && row.name == kind);
    let (id, _, row) = found.ok_or_else(|| no_fault(device, kind))?;
    let amount = amount.map(|text| self::amount(text, row.amount)).transpose()?;
    let fault = Carbot::fault(id, amount).ok_or_else(|| no_fault(device, kind))?;
    let (from, to) = match when.split_once("..") {
        Some((from, to)) => (instant(from)?, instant(to)?),
        None => (instant(when)?, Instant::MAX),
    };
    if to <= from {
        return Err("it ends before it begins".to_owned());
    }
    let lasting = if to == Instant::MAX { Duration::MAX } else { to.since(from) };
    Ok(Failure { fault, from, lasting })
}

fn instant(text: &str) -> Result<Instant, String> {
    Ok(Instant::ZERO + duration(text)?)
}

/// How much of a fault, in SI units.
fn amount(text: &str, of: Option<AmountRow>) -> Result<f64, String> {
    let of = of.ok_or_else(|| format!("there is no more or less of it: leave '={text}' out"))?;
    let AmountRow { name, from, to, .. } = of;
    let wrong = || format!("'{text}' is no {name} from {from} to {to}");
    let amount = match of.unit {
        "s" => duration(text)?.as_secs_f64(),
        _ => text.parse().map_err(|_| wrong())?,
    };
    of.checked(Some(amount)).ok_or_else(wrong)
}

fn no_fault(device: &str, kind: &str) -> String {
    let of_device = faults(TABLE).filter(|(_, at, _)| at.name == device);
    let kinds: Vec<_> = of_device.map(|(_, _, row)| row.name).collect();
    if !kinds.is_empty() {
        let what = format!("'{device}' cannot be '{kind}'");
        return format!("{what}; it can be {}", kinds.join(", "));
    }
    let mut devices: Vec<_> = faults(TABLE).map(|(_, at, _)| at.name).collect();
    devices.sort_unstable();
    devices.dedup();
    format!("nothing called '{device}' can fail; there are {}", devices.join(", "))
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("expected an entry and its value, such as walldist=35cm".to_owned()),
    }
}

pub(super) fn destination(text: &str) -> Result<Destination, String> {
    Ok(match text {
        "none" => Destination::None,
        path => Destination::File(path.into()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_have_names() {
        let at = Instant::ZERO + Duration::from_secs(20);
        assert_eq!(press("escape@20s"), Ok(Press { button: Button::Escape, at }));
        assert!(press("escape").is_err());
        assert!(press("start@1s").unwrap_err().contains("no button 'start'"));
    }

    #[test]
    fn what_fails_has_a_kind_an_amount_and_a_time() {
        use afp_sim::{Defect, Sensor};
        let secs = |s: u64| Instant::ZERO + Duration::from_secs(s);
        let frozen = Fault::Sensor(Sensor::Ultrasonic, Defect::Frozen);
        let lasting = Duration::from_secs(2);
        let told = failure("ultrasonic.frozen@5s..7s");
        assert_eq!(told, Ok(Failure { fault: frozen, from: secs(5), lasting }));
        let late = Defect::Delayed(Duration::from_millis(300));
        let told = failure("odometry.delayed=300ms@1s").unwrap();
        assert_eq!(told.fault, Fault::Sensor(Sensor::Odometry, late));
        assert_eq!(told.lasting, Duration::MAX);
        assert_eq!(failure("wheels.slip=0.3@0s").unwrap().fault, Fault::Slip(0.3));
    }

    #[test]
    fn what_cannot_fail_so_is_told_what_can() {
        for (text, says) in [
            ("ultrasonic.frozen", "such as ultrasonic.frozen@5s..7s"),
            ("battery.stuck@1s", "'battery' cannot be 'stuck'; it can be frozen, lost"),
            ("sonar.lost@1s", "nothing called 'sonar' can fail; there are battery, buttons"),
            ("wheels.slip=3@1s", "no share from 0 to 1"),
            ("touch.lost=3@1s", "no more or less of it"),
            ("touch.slow=3@1s", "20s or 500ms"),
            ("touch.lost@3s..2s", "it ends before it begins"),
            ("touch.lost@3", "20s or 500ms"),
        ] {
            let error = failure(text).unwrap_err();
            assert!(error.contains(says), "{text}: {error}");
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
