//! Profiles: robots made of parts from a shop, which `[robot]` describes without Rust.
//!
//! A profile is the Carbot's toolbox on other hardware. Its tables and keys are data here, so that
//! every command and every editor checks them, also without a driver for the robot.

use std::ops::Range;

use afp_core::Duration;
use afp_types::{Scale, SingleUnit, Unit, parse_quantity};

use crate::key::{Key, key};
use crate::time::duration;

/// A kind of robot.
#[derive(Debug)]
pub struct Profile {
    pub name: &'static str,
    /// A description in one sentence.
    pub help: &'static str,
    pub sections: &'static [Section],
    /// Devices of the Carbot's toolbox that no such robot has.
    pub lacks: &'static [&'static str],
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

const fn section(
    key: Key,
    needed: bool,
    devices: &'static [&'static str],
    settings: &'static [Setting],
) -> Section {
    Section { key, needed, devices, settings }
}

const fn needed(key: Key, of: Of) -> Setting {
    Setting { key, of, usual: None, in_world: None }
}

const fn usual(key: Key, of: Of, usual: &'static str) -> Setting {
    Setting { key, of, usual: Some(usual), in_world: None }
}

const fn simulated(setting: Setting, in_world: &'static str) -> Setting {
    Setting { in_world: Some(in_world), ..setting }
}

pub const PROFILES: &[Profile] = &[CARBOT, UGV];

const CARBOT: Profile = Profile {
    name: "carbot",
    help: "A second controller on a serial port drives two motors with encoders.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[usual(
                key("port", "The serial port of the controller.", "port = \"/dev/ttyACM0\""),
                Of::Text,
                "/dev/ttyACM0",
            )],
        ),
        section(key("body", "The outline from above.", "[robot.body]"), true, &[], BODY),
        section(key("drive", "The wheels and their motors.", "[robot.drive]"), true, &[], DRIVE),
        section(
            key("ultrasonic", "The range sensor on its servo.", "[robot.ultrasonic]"),
            false,
            &["ultrasonic", "rotator"],
            &[
                simulated(
                    needed(
                        key(
                            "forward",
                            "From the wheels' axis ahead to the axis of the servo.",
                            "forward = \"8 cm\"",
                        ),
                        Of::Length([0.0, 0.5]),
                    ),
                    "robot.sonar_m",
                ),
                OFFSET,
            ],
        ),
        section(
            key("bumper", "The switch of the bumper.", "[robot.bumper]"),
            false,
            &["touch"],
            SWITCH,
        ),
        section(key("button", "The escape button.", "[robot.button]"), false, &["buttons"], SWITCH),
    ],
    lacks: &["infrared", "color", "camera", "battery", "localisation", "signals"],
};

const UGV: Profile = Profile {
    name: "ugv",
    help: "A Waveshare UGV, whose controller speaks JSON on a serial port.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[usual(
                key("port", "The serial port of the controller.", "port = \"/dev/serial0\""),
                Of::Text,
                "/dev/serial0",
            )],
        ),
        section(key("body", "The outline from above.", "[robot.body]"), true, &[], BODY),
        section(
            key("drive", "The wheels and their motors.", "[robot.drive]"),
            true,
            &[],
            &[TRACK, FASTEST, SCALE, TRIM],
        ),
    ],
    lacks: &[
        "ultrasonic",
        "rotator",
        "touch",
        "buttons",
        "infrared",
        "color",
        "camera",
        "battery",
        "localisation",
        "signals",
    ],
};

const BODY: &[Setting] = &[
    simulated(
        needed(
            key(
                "length",
                "Twice the distance from the wheels' axis to the farther end.",
                "length = \"24 cm\"",
            ),
            Of::Length([0.05, 1.0]),
        ),
        "robot.length_m",
    ),
    simulated(
        needed(key("width", "The whole width.", "width = \"18 cm\""), Of::Length([0.05, 1.0])),
        "robot.width_m",
    ),
];

const TRACK: Setting = simulated(
    needed(
        key("track", "Between the middles of the two tyres.", "track = \"14 cm\""),
        Of::Length([0.03, 1.0]),
    ),
    "robot.track_m",
);

const FASTEST: Setting = simulated(
    needed(
        key(
            "fastest",
            "The top speed of a wheel: nine tenths of its speed at full power.",
            "fastest = \"50 cm/s\"",
        ),
        Of::Speed([0.02, 2.0]),
    ),
    "robot.fastest_m_s",
);

// Errors of a robot that `afpc calibrate` measures.
const SCALE: Setting = usual(
    key("scale", "The driven distance over the counted distance.", "scale = 1.02"),
    Of::Number([0.5, 2.0]),
    "1",
);
const TRIM: Setting = usual(
    key("trim", "The right wheel's diameter over the left wheel's.", "trim = 1.01"),
    Of::Number([0.8, 1.25]),
    "1",
);
const OFFSET: Setting = usual(
    key("offset", "The distance to add to each echo.", "offset = \"1.5 cm\""),
    Of::Length([-0.1, 0.1]),
    "0 cm",
);

const DRIVE: &[Setting] = &[
    TRACK,
    TRIM,
    needed(
        key("wheel_diameter", "The diameter of a driven wheel.", "wheel_diameter = \"65 mm\""),
        Of::Length([0.01, 0.3]),
    ),
    needed(
        key("ticks", "The counts of an encoder in one turn of its wheel.", "ticks = 1440"),
        Of::Count([4, 1_000_000]),
    ),
    FASTEST,
    usual(
        key("ramp", "The time from standstill to the top speed, and back.", "ramp = \"150 ms\""),
        Of::Time([Duration::from_millis(10), Duration::from_millis(250)]),
        "150 ms",
    ),
];

const SWITCH: &[Setting] = &[usual(
    key(
        "closed",
        "When the switch is closed; 'free' makes a broken wire read as pressed.",
        "closed = \"free\"",
    ),
    Of::Choice(&["free", "pressed"]),
    "free",
)];

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
        }
    }
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
        known.collect()
    }

    /// The devices of the Carbot's toolbox that this robot does not have.
    pub fn lacks(&self) -> Vec<&'static str> {
        let Some(profile) = self.profile() else { return Vec::new() };
        let absent =
            profile.sections.iter().filter(|section| !self.sections.contains(&section.key.name));
        let absent = absent.flat_map(|section| section.devices);
        profile.lacks.iter().chain(absent).copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn examples_and_defaults_are_valid_values() {
        for setting in PROFILES.iter().flat_map(|it| it.sections).flat_map(|it| it.settings) {
            let (_, example) = setting.key.example.split_once(" = ").unwrap();
            for text in [example.trim_matches('"')].into_iter().chain(setting.usual) {
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
        for text in ["140", "", "-1 cm", "nan cm"] {
            assert!(of("drive.track").read(text).is_err(), "{text}");
        }
    }
}
