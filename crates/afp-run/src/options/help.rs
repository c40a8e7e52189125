//! The help texts of `--press`, `--fail` and `--measure`, with the names of the robot at hand.

use afp_core::devices::{DeviceRow, FaultRow, controls, faults};
use afp_session::AnyRobot;
use clap::Command;

/// Adds the names of a robot to the help of a command with the arguments of [`RunOptions`].
///
/// [`RunOptions`]: super::RunOptions
pub fn for_robot(command: Command, robot: &dyn AnyRobot) -> Command {
    let measures = measures(robot.measures());
    for_devices(command, robot.devices()).mut_arg("measure", |argument| argument.help(measures))
}

/// As [`for_robot`], if only the devices of the robot are known.
pub fn for_devices(command: Command, devices: &[DeviceRow]) -> Command {
    let (press, fail) = (press(devices), fail(devices));
    command
        .mut_arg("press", |argument| argument.help(press.0).long_help(press.1))
        .mut_arg("fail", |argument| argument.help(fail.0).long_help(fail.1))
}

/// The controls as written in options: the name alone if only one device has it.
pub(crate) fn words(devices: &[DeviceRow]) -> Vec<(String, &'static str)> {
    let alone = |name: &str| controls(devices).filter(|(.., row)| row.name == name).count() == 1;
    let word = |device: &DeviceRow, name: &str| match alone(name) {
        true => name.to_owned(),
        false => format!("{}.{name}", device.name),
    };
    controls(devices).map(|(_, device, row)| (word(device, row.name), row.help)).collect()
}

fn measures(names: &[&str]) -> String {
    let names: Vec<_> = names.iter().map(|name| format!("--measure {name}")).collect();
    match names.is_empty() {
        true => "Also judge the run by a measure; this robot has no measures".to_owned(),
        false => format!("Also judge the run by this measure: {}", names.join(", ")),
    }
}

/// The short and the long help.
fn press(devices: &[DeviceRow]) -> (String, String) {
    let words = words(devices);
    let Some((first, _)) = words.first() else {
        let none = "Press a control; this robot has no controls".to_owned();
        return (none.clone(), none);
    };
    let examples: Vec<_> =
        words.iter().take(2).map(|(word, _)| format!("--press {word}@3s")).collect();
    let short = format!("Press a control of the robot for 200 ms: {}", examples.join(", "));
    let width = words.iter().map(|(word, _)| word.len()).max().unwrap_or(first.len());
    let rows = words.iter().map(|(word, help)| format!("  {word:width$}  {help}"));
    let rows: Vec<_> = rows.map(|row| row.trim_end().to_owned()).collect();
    let long = format!("{short}\n\n{}", rows.join("\n"));
    (short, long)
}

/// The short and the long help.
fn fail(devices: &[DeviceRow]) -> (String, String) {
    let mut plain = faults(devices).filter(|(.., row)| row.amount.is_none());
    let mut measured =
        faults(devices).filter(|(.., row)| row.amount.is_some_and(|of| of.unit.is_empty()));
    let plain =
        plain.next().map(|(_, device, row)| format!("--fail {}.{}@5s..7s", device.name, row.name));
    let measured = measured.next().and_then(|(_, device, row)| {
        Some(format!("--fail {}.{}={}@3s", device.name, row.name, row.amount?.default))
    });
    let examples: Vec<_> = plain.into_iter().chain(measured).collect();
    if faults(devices).next().is_none() {
        let none = "Inject a fault; this robot has no faults".to_owned();
        return (none.clone(), none);
    }
    let short = format!("Inject a temporary or permanent fault: {}", examples.join(", "));
    let long = format!("{short}\n\n{}", groups(devices).join("\n"));
    (short, long)
}

/// The faults of devices; devices with the same faults form a group.
fn groups(devices: &[DeviceRow]) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, Vec<String>)> = Vec::new();
    let mut seen: Vec<String> = Vec::new();
    for (_, _, row) in faults(devices) {
        let way = way(row);
        if seen.contains(&way) {
            continue;
        }
        let fails = |device: &&DeviceRow| device.faults.iter().any(|known| self::way(known) == way);
        let having: Vec<_> = devices.iter().filter(fails).map(|device| device.name).collect();
        match groups.iter_mut().find(|(known, _)| *known == having) {
            Some((_, ways)) => ways.push(way.clone()),
            None => groups.push((having, vec![way.clone()])),
        }
        seen.push(way);
    }
    let line = |(devices, ways): (Vec<&str>, Vec<String>)| {
        format!("  {}: {}", devices.join(", "), ways.join(", "))
    };
    groups.into_iter().map(line).collect()
}

/// `frozen`, `slip=SHARE`
fn way(row: &FaultRow) -> String {
    match row.amount {
        Some(of) => format!("{}={}", row.name, of.name.to_uppercase()),
        None => row.name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use afp_carbot::table::TABLE;

    use super::*;

    #[test]
    fn the_help_lists_the_controls_and_faults_of_the_robot() {
        let (short, long) = press(TABLE);
        assert!(short.ends_with("--press touch@3s, --press escape@3s"), "{short}");
        assert!(long.contains("  escape  the button that ends plans"), "{long}");
        let (short, long) = fail(TABLE);
        let examples = "--fail ultrasonic.frozen@5s..7s, --fail battery.low=0.05@3s";
        assert!(short.ends_with(examples), "{short}");
        for line in [
            "\n  ultrasonic, rotator, odometry, touch, buttons, infrared, color, camera, battery: \
             frozen, lost, nan, delayed=TIME, slow=TIME\n",
            "\n  left_motor, right_motor, controller: stalled\n",
            "\n  wheels: slip=SHARE\n",
        ] {
            assert!(long.contains(line), "{long}");
        }
    }

    #[test]
    fn the_help_of_a_robot_without_devices_has_no_examples() {
        assert_eq!(press(&[]).0, "Press a control; this robot has no controls");
        assert_eq!(fail(&[]).0, "Inject a fault; this robot has no faults");
        assert_eq!(measures(&[]), "Also judge the run by a measure; this robot has no measures");
    }
}
