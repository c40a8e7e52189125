//! The values of options as people write them.

use std::path::PathBuf;

use afp_core::Instant;
use afp_project::duration;

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
    use afp_core::Duration;

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
