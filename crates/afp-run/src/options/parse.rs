//! The values of options as people write them.

use std::path::PathBuf;

use afp_core::rt::{Scale, Unit, parse_quantity};
use afp_core::{Duration, Instant};

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

/// A button of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The escape button.
    Escape,
}

/// Where output goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// Nowhere.
    None,
    /// Into this file.
    File(PathBuf),
}

/// Units of time on the command line.
const TIMES: [Unit<'static>; 6] = [
    Unit { name: "s", scale: Scale::Decimal(0) },
    Unit { name: "ms", scale: Scale::Decimal(-3) },
    Unit { name: "us", scale: Scale::Decimal(-6) },
    Unit { name: "ns", scale: Scale::Decimal(-9) },
    Unit { name: "min", scale: Scale::Factor(60.0) },
    Unit { name: "h", scale: Scale::Factor(3600.0) },
];

pub(super) fn duration(text: &str) -> Result<Duration, String> {
    match parse_quantity(text, TIMES) {
        Ok(secs) if secs >= 0.0 => Ok(Duration::from_nanos(libm::round(secs * 1e9) as u64)),
        Ok(_) => Err("a time cannot be negative".to_owned()),
        Err(_) => Err("expected a number with its unit, such as 20s or 500ms".to_owned()),
    }
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
        other => return Err(format!("the robot has no button '{other}'; it has 'escape'")),
    };
    Ok(Press { button, at: Instant::ZERO + duration(time)? })
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
    fn times_are_exact() {
        assert_eq!(duration("20s"), Ok(Duration::from_secs(20)));
        assert_eq!(duration("0.29 s"), Ok(Duration::from_millis(290)));
        assert_eq!(duration("1.5 min"), Ok(Duration::from_secs(90)));
        assert_eq!(duration("3us"), Ok(Duration::from_micros(3)));
        assert!(duration("20").is_err());
        assert!(duration("-1s").is_err());
        assert!(duration("20 m").is_err());
    }

    #[test]
    fn buttons_have_names() {
        let at = Instant::ZERO + Duration::from_secs(20);
        assert_eq!(press("escape@20s"), Ok(Press { button: Button::Escape, at }));
        assert!(press("escape").is_err());
        assert!(press("start@1s").unwrap_err().contains("no button 'start'"));
    }

    #[test]
    fn speeds_are_multiples() {
        assert_eq!(speed("1x"), Ok(Speed::Times(1.0)));
        assert_eq!(speed("0.5x"), Ok(Speed::Times(0.5)));
        assert!(speed("fast").is_err());
        assert!(speed("0x").is_err());
    }
}
