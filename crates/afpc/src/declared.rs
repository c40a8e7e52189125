//! The declarations that a command line needs: the devices of the project's robot, from its toolbox
//! file, and the plan's inputs. Help and errors use them without a build.

use std::ffi::OsString;
use std::path::Path;

use afp_core::devices::{AmountRow, ControlRow, DeviceRow, FaultRow};
use afp_dsl::Compiled;
use afp_dsl::graph::EntryKind;
use afp_dsl::toolbox::{Amount, Control, Device, Fault};
use afp_project::ProjectError;
use afp_toolboxes::project::OwnToolboxes;

use crate::plan_file::PlanFile;

/// The devices of the project's robot, if the project has a robot.
///
/// The project is that of the first plan among the arguments, or else of the current folder.
pub fn devices(arguments: &[OsString]) -> Option<&'static [DeviceRow]> {
    // Help is shown even if the project is invalid.
    read(plan(arguments).unwrap_or(Path::new("plan.afp"))).ok().flatten()
}

/// The first plan among the arguments.
fn plan(arguments: &[OsString]) -> Option<&Path> {
    arguments.iter().map(Path::new).find(|path| {
        let name = path.to_string_lossy();
        name.ends_with(".afp") || name.contains(".afp:")
    })
}

/// The inputs of the command line's plan, one line each; `None` without a plan or inputs.
pub fn inputs(arguments: &[OsString]) -> Option<String> {
    let argument = plan(arguments)?.to_str()?;
    // Help is shown even if the plan is unreadable.
    let Compiled { outline, sources, .. } = PlanFile::read(argument).ok()?.compiled;
    let plan = outline.plan(outline.main?);
    let inputs = plan.entries.iter().filter(|entry| entry.kind == EntryKind::In);
    let lines: Vec<_> = inputs
        .filter_map(|entry| {
            let declared = entry.name.as_ref()?.span.to(entry.span);
            Some((one_line(sources.text(declared)), &entry.doc))
        })
        .collect();
    let width = lines.iter().map(|(line, _)| line.chars().count()).max()?;
    let lines = lines.iter().map(|(line, help)| {
        format!("  {}", format!("{line:width$}  {}", one_line(help)).trim_end())
    });
    let name = plan.name.as_ref().map_or("The plan", |name| name.text.as_str());
    Some(format!("{name} takes:\n{}", lines.collect::<Vec<_>>().join("\n")))
}

/// A text on one line, with single spaces.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn read(plan: &Path) -> Result<Option<&'static [DeviceRow]>, ProjectError> {
    of_project(&OwnToolboxes::of_plan(plan)?)
}

/// The devices of the robot of a project, if the project has a robot.
///
/// # Errors
/// The project file or a toolbox is invalid.
pub fn of_project(own: &OwnToolboxes) -> Result<Option<&'static [DeviceRow]>, ProjectError> {
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

/// Leaks the rows: they are read once and live as long as the program.
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
