//! Profiles: robots made of parts from a shop, which `[robot]` describes without Rust.
//!
//! A profile is the Carbot's toolbox on other hardware. Its tables and keys are data here, so that
//! every command and every editor checks them, also without a driver for the robot.

mod robots;
mod wires;

use std::ops::Range;

use afp_core::Duration;
use afp_types::{Scale, SingleUnit, Unit, parse_quantity};

use crate::key::Key;
use crate::time::duration;

pub use robots::PROFILES;
pub use wires::{Wire, WireKind};

/// The highest line on the header of a Raspberry Pi.
const LAST_LINE: u32 = 27;

/// A kind of robot.
#[derive(Debug)]
pub struct Profile {
    pub name: &'static str,
    /// A description in one sentence.
    pub help: &'static str,
    pub sections: &'static [Section],
    /// Devices of the Carbot's toolbox that no such robot has.
    pub lacks: &'static [&'static str],
    /// Sensors of that toolbox whose readings such robots estimate from their commands.
    pub estimates: &'static [&'static str],
}

/// A table of `[robot]`.
#[derive(Debug)]
pub struct Section {
    /// The table's key; empty for `[robot]` itself.
    pub key: Key,
    /// Whether every robot of the profile has it.
    pub needed: bool,
    /// Devices of the Carbot's toolbox that only robots with this table have.
    pub devices: &'static [&'static str],
    pub settings: &'static [Setting],
}

/// A key of such a table.
#[derive(Debug)]
pub struct Setting {
    pub key: Key,
    pub of: Of,
    /// The default value; `None` if the key is required.
    pub usual: Option<&'static str>,
    /// The key in the files of the Carbot's worlds, with which the simulator takes the value.
    pub in_world: Option<&'static str>,
}

/// The values of a setting, with the limits of numbers in SI units.
#[derive(Clone, Copy, Debug)]
pub enum Of {
    Text,
    Length([f64; 2]),
    Speed([f64; 2]),
    Time([Duration; 2]),
    Count([u32; 2]),
    Number([f64; 2]),
    Choice(&'static [&'static str]),
    Angle([f64; 2]),
    /// The number of a line of the GPIO chip, on the header of a Raspberry Pi.
    Line,
    /// Two such lines.
    Lines,
    /// A PWM channel of the kernel: `pwmchip0/1`.
    Pwm,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileRobot {
    pub name: &'static str,
    /// The tables in the file.
    pub sections: Vec<&'static str>,
    /// Values as written, and default values, by path: `drive.track`.
    pub values: Vec<(String, String)>,
    /// The date of its calibration, whose values are among `values`.
    pub calibrated: Option<String>,
    /// Byte range of the profile's name.
    pub span: Range<usize>,
}

impl Profile {
    pub fn named(name: &str) -> Option<&'static Profile> {
        PROFILES.iter().find(|profile| profile.name == name)
    }

    pub fn section(&self, name: &str) -> Option<&'static Section> {
        self.sections.iter().find(|section| section.key.name == name)
    }

    /// The setting of a path such as `drive.track`, and of `port`.
    pub fn setting(&self, path: &str) -> Option<&'static Setting> {
        let (section, name) = path.rsplit_once('.').unwrap_or(("", path));
        self.section(section)?.settings.iter().find(|setting| setting.key.name == name)
    }
}

impl Of {
    /// The number of a value in SI units, or the position of a choice; 0 for other texts.
    ///
    /// # Errors
    /// The valid values, in words.
    pub fn read(self, text: &str) -> Result<f64, String> {
        let within = |limits: [f64; 2], value: Option<f64>| {
            value.filter(|value| (limits[0]..=limits[1]).contains(value))
        };
        let value = match self {
            Of::Text => (!text.is_empty()).then_some(0.0),
            Of::Length(limits) => {
                let units = SingleUnit::of("length").map(SingleUnit::unit);
                within(limits, parse_quantity(text, units).ok())
            }
            Of::Speed(limits) => within(limits, speed(text)),
            Of::Time([least, most]) => {
                let limits = [least, most].map(Duration::as_secs_f64);
                within(limits, duration(text).ok().map(Duration::as_secs_f64))
            }
            Of::Count([least, most]) => {
                let count = text.parse::<u32>().ok();
                count.filter(|count| (least..=most).contains(count)).map(f64::from)
            }
            Of::Number(limits) => within(limits, text.parse().ok()),
            Of::Choice(names) => names.iter().position(|name| *name == text).map(|at| at as f64),
            Of::Angle(limits) => {
                let units = SingleUnit::of("angle").map(SingleUnit::unit);
                within(limits, parse_quantity(text, units).ok())
            }
            Of::Line => line(text).map(f64::from),
            Of::Lines => {
                let two = text.split_once(',').and_then(|(a, b)| Some((line(a)?, line(b)?)));
                two.map(|_| 0.0)
            }
            Of::Pwm => {
                let number = |text: Option<&str>| text?.parse::<u32>().ok();
                let (chip, channel) = text.split_once('/').unwrap_or_default();
                let chip = number(chip.strip_prefix("pwmchip"));
                chip.and(number(Some(channel))).map(f64::from)
            }
        };
        value.ok_or_else(|| self.words())
    }

    /// The valid values, in words.
    fn words(self) -> String {
        let cm = |metres: f64| metres * 100.0;
        match self {
            Of::Text => "a string in quotes".to_owned(),
            Of::Length([least, most]) => {
                format!("a length in quotes, from {} cm to {} cm", cm(least), cm(most))
            }
            Of::Speed([least, most]) => {
                format!("a speed in quotes, from {} cm/s to {} cm/s", cm(least), cm(most))
            }
            Of::Time(limits) => {
                let [least, most] = limits.map(|limit| limit.as_nanos() / 1_000_000);
                format!("a time in quotes, from {least} ms to {most} ms")
            }
            Of::Count([least, most]) => format!("a whole number from {least} to {most}"),
            Of::Number([least, most]) => format!("a number from {least} to {most}"),
            Of::Choice(names) => {
                let names: Vec<_> = names.iter().map(|name| format!("\"{name}\"")).collect();
                names.join(" or ")
            }
            Of::Angle([least, most]) => {
                let [least, most] = [least, most].map(|angle| angle.to_degrees().round());
                format!("an angle in quotes, from {least} deg to {most} deg")
            }
            Of::Line => format!("the number of a line, from 0 to {LAST_LINE}"),
            Of::Lines => format!("two lines in a list, such as [5, 6], from 0 to {LAST_LINE}"),
            Of::Pwm => "a PWM channel in quotes, such as \"pwmchip0/0\"".to_owned(),
        }
    }

    /// The things that a value occupies, so that no other value may name them.
    pub fn occupies(self, text: &str) -> Vec<String> {
        match self {
            Of::Line | Of::Lines => {
                text.split(',').filter_map(line).map(|line| format!("line {line}")).collect()
            }
            Of::Pwm => vec![format!("channel '{text}'")],
            _ => Vec::new(),
        }
    }
}

/// A line of the header.
fn line(text: &str) -> Option<u32> {
    text.trim().parse().ok().filter(|line| *line <= LAST_LINE)
}

/// A speed in metres a second, from a length over a time.
fn speed(text: &str) -> Option<f64> {
    let all = SingleUnit::of("length").flat_map(|length| {
        SingleUnit::of("duration")
            .map(move |time| (format!("{}/{}", length.symbol, time.symbol), length.over(time)))
    });
    let all: Vec<(String, Scale)> = all.collect();
    parse_quantity(text, all.iter().map(|(name, scale)| Unit { name, scale: *scale })).ok()
}

impl ProfileRobot {
    /// The kind of robot.
    pub fn profile(&self) -> Option<&'static Profile> {
        Profile::named(self.name)
    }

    /// The number of a setting in SI units, or the position of a choice; `None` if the robot has
    /// no such setting.
    pub fn number(&self, path: &str) -> Option<f64> {
        let (_, text) = self.values.iter().find(|(name, _)| name == path)?;
        self.profile()?.setting(path)?.of.read(text).ok()
    }

    /// Replaces the value of a setting, or adds it.
    pub(crate) fn replace(&mut self, path: &str, text: String) {
        match self.values.iter_mut().find(|(name, _)| name == path) {
            Some((_, value)) => *value = text,
            None => self.values.push((path.to_owned(), text)),
        }
    }

    /// The values that the simulator takes: keys of a world's file, and values with units.
    pub fn in_world(&self) -> Vec<(&'static str, &str)> {
        let Some(profile) = self.profile() else { return Vec::new() };
        let values = self.values.iter();
        let known =
            values.filter_map(|(path, text)| Some((profile.setting(path)?.in_world?, &**text)));
        let blind = profile.lacks.contains(&"encoders").then_some(("robot.encoders", "false"));
        known.chain(blind).collect()
    }

    /// The devices of the Carbot's toolbox that this robot does not have.
    pub fn lacks(&self) -> Vec<&'static str> {
        let Some(profile) = self.profile() else { return Vec::new() };
        let absent =
            profile.sections.iter().filter(|section| !self.sections.contains(&section.key.name));
        let absent = absent.flat_map(|section| section.devices);
        profile.lacks.iter().chain(absent).copied().collect()
    }

    /// The sensors whose readings this robot estimates from its commands.
    pub fn estimates(&self) -> impl Iterator<Item = &'static str> {
        self.profile().into_iter().flat_map(|profile| profile.estimates).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn examples_and_defaults_are_valid_values() {
        for setting in PROFILES.iter().flat_map(|it| it.sections).flat_map(|it| it.settings) {
            let (_, example) = setting.key.example.split_once(" = ").unwrap();
            for text in [example.trim_matches(['"', '[', ']'])].into_iter().chain(setting.usual) {
                assert!(setting.of.read(text).is_ok(), "{}: {text}", setting.key.name);
            }
        }
    }

    #[test]
    fn values_have_units_and_limits() {
        let of = |path| Profile::named("carbot").unwrap().setting(path).unwrap().of;
        assert_eq!(of("drive.track").read("140 mm"), Ok(0.14));
        assert_eq!(of("drive.fastest").read("50 cm/s"), Ok(0.5));
        assert_eq!(of("drive.ramp").read("0.1 s"), Ok(0.1));
        assert_eq!(of("bumper.closed").read("pressed"), Ok(1.0));
        let wrong = of("drive.track").read("2 m").unwrap_err();
        assert_eq!(wrong, "a length in quotes, from 3 cm to 100 cm");
        assert_eq!(of("drive.ticks").read("3").unwrap_err(), "a whole number from 4 to 1000000");
        assert_eq!(of("bumper.closed").read("open").unwrap_err(), "\"free\" or \"pressed\"");
        let of = |path| Profile::named("pi").unwrap().setting(path).unwrap().of;
        assert_eq!(of("guard.line").read("25"), Ok(25.0));
        for text in ["28", "-1", "25.0", "five"] {
            assert!(of("guard.line").read(text).is_err(), "{text}");
        }
        assert!(of("left.in").read("5, 6").is_ok() && of("left.in").read("5,6").is_ok());
        assert!(of("left.in").read("5").is_err() && of("left.in").read("5, 6, 7").is_err());
        assert_eq!(of("left.in").occupies("5, 6"), ["line 5", "line 6"]);
        assert!(of("left.pwm").read("pwmchip0/1").is_ok());
        for text in ["pwmchip0", "pwm0/1", "pwmchip/1", "../pwmchip0/1"] {
            assert!(of("left.pwm").read(text).is_err(), "{text}");
        }
        let of = |path| Profile::named("carbot").unwrap().setting(path).unwrap().of;
        for text in ["140", "", "-1 cm", "nan cm"] {
            assert!(of("drive.track").read(text).is_err(), "{text}");
        }
    }
}
