//! `--press` and `--fail` as requests of a session.

use afp_core::devices::{
    AmountRow, ControlId, DeviceRow, FaultId, faults, find_control, find_stop,
};
use afp_core::{Duration, Instant};
use afp_excerpt::words::nearest;
use afp_project::duration;
use afp_session::{AnySession, HOLD, Recipe, Request, RequestError};

use crate::error::RunError;
use crate::options::{Failure, Press, words};

/// Checks that the devices have the controls and faults of the options.
///
/// # Errors
/// A control or fault does not exist.
pub fn check(table: &[DeviceRow], presses: &[Press], failures: &[Failure]) -> Result<(), RunError> {
    failures.iter().try_for_each(|failure| find_fault(table, failure).map(|_| ()))?;
    presses.iter().try_for_each(|press| control(table, press).map(|_| ()))
}

fn control(table: &[DeviceRow], press: &Press) -> Result<ControlId, RunError> {
    find_control(table, &press.control).ok_or_else(|| {
        RunError::usage(no_control(table, &press.control), such_control(table, press))
    })
}

/// Makes the requests of the options in a session.
///
/// # Errors
/// A control or fault does not exist.
pub fn make(
    session: &mut dyn AnySession,
    presses: &[Press],
    failures: &[Failure],
) -> Result<(), RunError> {
    let table = session.devices();
    for failure in failures {
        let (id, amount) = find_fault(table, failure)?;
        let lasting = failure.to.map_or(Duration::MAX, |to| to.since(failure.from));
        let made = session.at(failure.from, Request::Break(id, amount, lasting));
        made.map_err(|why| refused(&failure.to_string(), &why))?;
    }
    for press in presses {
        let id = control(table, press)?;
        let made = session.at(press.at, Request::Hold(id, HOLD));
        made.map_err(|why| refused(&press.to_string(), &why))?;
    }
    Ok(())
}

/// Makes the requests of a repeated run.
///
/// # Errors
/// The plan or robot is another one.
pub(crate) fn repeat(session: &mut dyn AnySession, recipe: &Recipe) -> Result<(), RunError> {
    recipe.ask(session).map_err(|error| {
        RunError::usage(error.to_string(), "the plan or the robot differs from the log")
    })
}

/// Presses the stop control of the robot, if it has one, for the Escape key.
pub(crate) fn press_stop(session: &mut dyn AnySession, at: Instant) {
    if let Some(id) = find_stop(session.devices()) {
        // The only possible error is that the run has ended.
        let _ = session.at(at, Request::Hold(id, HOLD));
    }
}

fn refused(what: &str, why: &RequestError) -> RunError {
    RunError::usage(format!("'{what}': {why}"), "leave it out")
}

/// A hint with a similar control and the same time.
fn such_control(table: &[DeviceRow], press: &Press) -> String {
    let known = words(table);
    let names = || known.iter().map(|(word, _)| word.as_str());
    match nearest(&press.control, names()).or(names().next()) {
        Some(word) => format!("such as '{}'", Press { control: word.to_owned(), at: press.at }),
        None => "this robot has no controls".to_owned(),
    }
}

/// The error for an unknown control; lists the known ones.
pub fn no_control(table: &[DeviceRow], name: &str) -> String {
    let known: Vec<_> = words(table).into_iter().map(|(word, _)| format!("'{word}'")).collect();
    match known.is_empty() {
        true => format!("the robot has no control '{name}', and no other controls"),
        false => format!("the robot has no control '{name}'; it has {}", known.join(", ")),
    }
}

/// A fault and its amount in SI units.
fn find_fault(table: &[DeviceRow], failure: &Failure) -> Result<(FaultId, Option<f64>), RunError> {
    let Failure { device, kind, .. } = failure;
    let mut all = faults(table);
    let found = all.find(|(_, at, row)| at.name == device && row.name == kind);
    let wrong = |why: String| RunError::usage(why, such(table, failure));
    let (id, _, row) = found.ok_or_else(|| wrong(no_fault(table, device, kind)))?;
    let amount = failure.amount.as_deref().map(|text| amount(text, row.amount)).transpose();
    let amount = amount.map_err(|why| {
        let usual = row.amount.map(|of| format!("={}{}", of.default, of.unit));
        let usual = usual.unwrap_or_default();
        RunError::usage(why, format!("such as '{device}.{kind}{usual}@5s..7s'"))
    })?;
    Ok((id, amount))
}

/// A hint with a similar fault, if possible of the same device and with the same time.
fn such(table: &[DeviceRow], failure: &Failure) -> String {
    let ways = || faults(table).filter(|(_, at, _)| at.name == failure.device);
    let same = nearest(&failure.kind, ways().map(|(.., row)| row.name));
    let mut fits = ways().filter(|(.., row)| same.is_none_or(|same| same == row.name));
    if let Some((.., row)) = fits.next() {
        let amount = failure.amount.clone().filter(|_| row.amount.is_some());
        return format!(
            "such as '{}'",
            Failure { kind: row.name.to_owned(), amount, ..failure.clone() }
        );
    }
    match faults(table).next() {
        Some((_, at, row)) => format!("such as '{}.{}@5s..7s'", at.name, row.name),
        None => "this robot has no faults".to_owned(),
    }
}

/// The amount of a fault, in SI units.
fn amount(text: &str, of: Option<AmountRow>) -> Result<f64, String> {
    let of = of.ok_or_else(|| format!("this fault has no amount: leave out '={text}'"))?;
    let AmountRow { name, unit, from, to, .. } = of;
    let wrong =
        || format!("'{text}' is not a {name} from {from} to {to} {unit}").trim_end().to_owned();
    let amount = match of.unit {
        "s" => duration(text)?.as_secs_f64(),
        unit => text.strip_suffix(unit).unwrap_or(text).parse().map_err(|_| wrong())?,
    };
    of.checked(Some(amount)).ok_or_else(wrong)
}

/// The error for an unknown fault; lists the known ones.
pub fn no_fault(table: &[DeviceRow], device: &str, kind: &str) -> String {
    let of_device = faults(table).filter(|(_, at, _)| at.name == device);
    let kinds: Vec<_> = of_device.map(|(_, _, row)| row.name).collect();
    if !kinds.is_empty() {
        let what = match kind {
            "" => format!("the fault of '{device}' is missing"),
            kind => format!("'{device}' cannot be '{kind}'"),
        };
        return format!("{what}; it can be {}", kinds.join(", "));
    }
    let mut devices: Vec<_> = faults(table).map(|(_, at, _)| at.name).collect();
    devices.sort_unstable();
    devices.dedup();
    match nearest(device, devices.iter().copied()) {
        Some(meant) => format!("unknown device '{device}'; did you mean '{meant}'?"),
        None => format!("unknown device '{device}'; there are {}", devices.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use afp_carbot::table::TABLE;
    use afp_core::devices::find_fault as id;

    use super::*;
    use crate::options::failure;

    #[test]
    fn amounts_match_the_table() {
        for (text, device, kind, amount) in [
            ("ultrasonic.frozen@5s..7s", "ultrasonic", "frozen", None),
            ("odometry.delayed=300ms@1s", "odometry", "delayed", Some(0.3)),
            ("wheels.slip=0.3@0s", "wheels", "slip", Some(0.3)),
        ] {
            let found = find_fault(TABLE, &failure(text).unwrap()).unwrap();
            assert_eq!(found, (id(TABLE, device, kind).unwrap(), amount), "{text}");
        }
    }

    #[test]
    fn an_impossible_request_gets_a_list_of_the_possible_ones() {
        for (text, says) in [
            ("battery.stuck@1s", "'battery' cannot be 'stuck'; it can be frozen, lost"),
            ("battery.losst@1s", "such as 'battery.lost@1s'"),
            ("wheels@1s", "the fault of 'wheels' is missing; it can be "),
            ("wheels@1s..2s", "such as 'wheels.slip@1s..2s'"),
            ("wheels.=0.2@1s", "such as 'wheels.slip=0.2@1s'"),
            ("sonar.lost@1s", "unknown device 'sonar'; there are battery, buttons"),
            ("wheel.slip@1s", "unknown device 'wheel'; did you mean 'wheels'?"),
            ("wheels.slip=3@1s", "not a share from 0 to 1"),
            ("touch.lost=3@1s", "has no amount"),
            ("touch.slow=3@1s", "20s or 500ms"),
        ] {
            let error = find_fault(TABLE, &failure(text).unwrap()).unwrap_err().to_string();
            // The option that the help suggests must be valid.
            let such =
                error.rsplit("such as ").next().unwrap_or_default().trim().trim_matches('\'');
            assert!(find_fault(TABLE, &failure(such).unwrap()).is_ok(), "{error}");
            assert!(error.contains(says), "{text}: {error}");
        }
        assert!(
            no_control(TABLE, "start").contains("no control 'start'; it has 'touch', 'escape'")
        );
    }
}
