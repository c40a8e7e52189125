//! Values of a robot's settings.

use afp_drive::Setup;
use afp_platform::Settings;
use afp_project::Profile;

/// The measures of a robot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Values {
    pub setup: Setup,
    /// Half the length and half the width of the body, in metres.
    pub half: [f64; 2],
    /// The distance from the wheels' axis ahead to the range sensor, in metres; `None` without it.
    pub sonar: Option<f64>,
    /// The distance to add to each echo, in metres.
    pub echo: f32,
    pub bumper: bool,
    pub button: bool,
}

/// The number of a setting; `None` if the robot does not have it.
///
/// # Errors
/// The value is invalid.
pub(crate) fn number(
    profile: &str,
    settings: &Settings,
    path: &str,
) -> Result<Option<f64>, String> {
    let setting = Profile::named(profile).and_then(|profile| profile.setting(path));
    let (Some(text), Some(setting)) = (settings.get(path), setting) else { return Ok(None) };
    let read = setting.of.read(text).map(Some);
    read.map_err(|what| format!("'{path}' cannot be '{text}': write {what}"))
}

/// Two lines, such as `17, 27`.
pub(crate) fn pair(text: &str) -> Option<[u32; 2]> {
    let (one, other) = text.split_once(',')?;
    Some([one.trim().parse().ok()?, other.trim().parse().ok()?])
}

/// The radius of the narrowest curve of a car with this wheelbase, in metres, and this steering
/// angle, in radians; 0 for robots that turn in place.
fn narrowest(wheelbase: Option<f64>, steering: Option<f64>) -> f32 {
    let radius = wheelbase.zip(steering).map(|(base, angle)| base / libm::tan(angle));
    radius.unwrap_or_default() as f32
}

impl Values {
    /// Reads the settings of the profile.
    ///
    /// # Errors
    /// A value is missing or invalid. A project file is checked before; `--set` is not.
    pub(crate) fn read(profile: &str, settings: &Settings) -> Result<Values, String> {
        let number = |path: &str| number(profile, settings, path);
        let needed = |path: &str| number(path)?.ok_or_else(|| format!("'{path}' has no value"));
        let opens = |path: &str| Ok::<_, String>(number(path)?.map(|closed| closed == 0.0));
        let usual = Setup::default();
        // A controller with another program counts metres. Wheels without counters have any ticks.
        let metres = match (number("drive.wheel_diameter")?, number("drive.ticks")?) {
            (Some(diameter), Some(ticks)) => diameter * std::f64::consts::PI / ticks,
            _ if Profile::named(profile).is_some_and(|it| it.setting("drive.scale").is_none()) => {
                f64::from(usual.metres_per_tick[0])
            }
            _ => number("drive.scale")?.unwrap_or(1.0),
        };
        let trim = number("drive.trim")?.unwrap_or(1.0);
        let left = 2.0 * metres / (1.0 + trim);
        let metres_per_tick = [left, left * trim].map(|metres| metres as f32);
        let (bumper, button) = (opens("bumper.closed")?, opens("button.closed")?);
        let setup = Setup {
            track: needed("drive.track")? as f32,
            metres_per_tick,
            fastest: needed("drive.fastest")? as f32,
            ramp: number("drive.ramp")?.map_or(usual.ramp, |ramp| ramp as f32),
            narrowest: narrowest(number("drive.wheelbase")?, number("drive.steering")?),
            bumper_opens: bumper.unwrap_or_default(),
            button_opens: button.unwrap_or_default(),
        };
        Ok(Values {
            setup,
            half: [needed("body.length")? / 2.0, needed("body.width")? / 2.0],
            sonar: number("ultrasonic.forward")?,
            echo: number("ultrasonic.offset")?.unwrap_or_default() as f32,
            bumper: bumper.is_some(),
            button: button.is_some(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [(&str, &str); 7] = [
        ("body.length", "24 cm"),
        ("body.width", "18 cm"),
        ("drive.track", "14 cm"),
        ("drive.wheel_diameter", "65 mm"),
        ("drive.ticks", "1440"),
        ("drive.fastest", "50 cm/s"),
        ("drive.ramp", "150 ms"),
    ];

    #[test]
    fn settings_become_measures() {
        let values = Values::read("carbot", &Settings::new(ALL)).unwrap();
        assert_eq!((values.half, values.sonar), ([0.12, 0.09], None));
        assert!(values.setup.metres_per_tick.iter().all(|it| (it - 0.000_141_8).abs() < 1e-7));
        let more = [ALL.to_vec(), vec![("bumper.closed", "pressed"), ("drive.track", "20 cm")]];
        let values = Values::read("carbot", &Settings::new(more.concat())).unwrap();
        assert!(values.bumper && !values.setup.bumper_opens && !values.button);
        assert_eq!(values.setup.track, 0.2);
        let trimmed = [ALL.to_vec(), vec![("drive.trim", "1.1")]].concat();
        let values = Values::read("carbot", &Settings::new(trimmed)).unwrap();
        let [left, right] = values.setup.metres_per_tick;
        assert!((right / left - 1.1).abs() < 1e-6 && (left + right - 0.000_283_6).abs() < 1e-7);
    }

    #[test]
    fn an_invalid_value_is_named_with_the_valid_ones() {
        let wrong = [ALL.to_vec(), vec![("drive.track", "2 km")]].concat();
        let why = Values::read("carbot", &Settings::new(wrong)).unwrap_err();
        assert_eq!(
            why,
            "'drive.track' cannot be '2 km': write a length in quotes, from 3 cm to 100 cm"
        );
        assert!(
            Values::read("carbot", &Settings::new(ALL[1..].to_vec()))
                .unwrap_err()
                .contains("body.length")
        );
    }
}
