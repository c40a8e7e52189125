//! The robot of a project as its toolbox file declares it, for help: nothing need be built to show its words.

use std::ffi::OsString;
use std::path::Path;

use afp_build::OwnToolboxes;
use afp_core::devices::{AmountRow, ControlRow, DeviceRow, FaultRow};
use afp_dsl::toolbox::{Amount, Control, Device, Fault};
use afp_project::{ProjectError, ProjectFile};

/// The devices of the robot of the project that a command line is about, if that has one.
///
/// The project is that of the first plan among the arguments, else that of the current folder.
pub fn devices(arguments: &[OsString]) -> Option<&'static [DeviceRow]> {
    let plan = arguments.iter().map(Path::new).find(|path| {
        let name = path.to_string_lossy();
        name.ends_with(".afp") || name.contains(".afp:")
    });
    // A project that is wrong is no reason to show no help.
    read(plan.unwrap_or(Path::new("plan.afp"))).ok().flatten()
}

fn read(plan: &Path) -> Result<Option<&'static [DeviceRow]>, ProjectError> {
    let own = OwnToolboxes::read(ProjectFile::of_plan(plan)?)?;
    if own.project.project.robot.is_none() {
        return Ok(None);
    }
    let toolboxes = own.with_built_in()?;
    let rows = toolboxes.devices(&[]).into_iter().map(row).collect();
    Ok(Some(list(rows)))
}

fn row(device: &Device) -> DeviceRow {
    DeviceRow {
        name: text(&device.name),
        help: text(&device.doc),
        controls: list(device.controls.iter().map(control).collect()),
        faults: list(device.faults.iter().map(fault).collect()),
        signals: &[],
    }
}

fn control(control: &Control) -> ControlRow {
    ControlRow { name: text(&control.name), help: text(&control.doc), stops: control.stops }
}

fn fault(fault: &Fault) -> FaultRow {
    let amount = |amount: &Amount| AmountRow {
        name: text(&amount.name),
        unit: text(&amount.dimension.si_unit()),
        default: amount.default,
        from: amount.from,
        to: amount.to,
    };
    FaultRow {
        name: text(&fault.name),
        amount: fault.amount.as_ref().map(amount),
        help: text(&fault.doc),
    }
}

/// Rows live as long as the program does; this one shows its help and ends.
fn list<T>(rows: Vec<T>) -> &'static [T] {
    Box::leak(rows.into_boxed_slice())
}

fn text(text: &str) -> &'static str {
    Box::leak(text.to_owned().into_boxed_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(arguments: &[&str]) -> Option<String> {
        let arguments: Vec<_> = arguments.iter().map(OsString::from).collect();
        let devices = devices(&arguments)?;
        let controls = afp_core::devices::controls(devices);
        let words: Vec<_> =
            controls.map(|(_, at, row)| format!("{}.{}", at.name, row.name)).collect();
        Some(words.join(" "))
    }

    #[test]
    fn a_plan_of_a_project_has_the_words_of_its_robot() {
        let vacuum = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/vacuum/plans/clean.afp");
        let found = "bumper.left bumper.right button.halt";
        assert_eq!(words(&["run", vacuum, "--help"]).as_deref(), Some(found));
        assert_eq!(words(&["run", &format!("{vacuum}:Clean"), "--help"]).as_deref(), Some(found));
        assert_eq!(words(&["run", "--help"]), None);
    }
}
