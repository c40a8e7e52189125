//! The available toolboxes of a compilation.

use std::sync::Arc;

use crate::index::{Declared, Meanings};
use crate::toolbox::{Device, Toolbox};
use afp_syntax::ast::Name;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::{Source, Sources, Span};

/// Toolboxes by name, with their texts.
///
/// The compiler reads no files: its caller adds the toolboxes, including built-in ones.
#[derive(Clone, Debug, Default)]
pub struct Toolboxes {
    list: Vec<Arc<Toolbox>>,
    broken: Vec<Name>,
    robot: Option<String>,
    /// Devices that the robot does not have although its toolbox declares them.
    lacks: Vec<String>,
    /// Sensors whose readings the robot estimates from its commands.
    estimates: Vec<String>,
    sources: Sources,
    diags: Diagnostics,
    meanings: Meanings,
    declared: Vec<Declared>,
}

/// Result of reading a toolbox file.
pub(crate) struct ToolboxFile {
    pub toolbox: Option<Toolbox>,
    /// Its name, if known despite errors.
    pub name: Option<Name>,
    pub diags: Diagnostics,
    pub meanings: Meanings,
    pub declared: Vec<Declared>,
}

impl Toolboxes {
    /// Adds a text and returns its index among [`Toolboxes::sources`]; `None` if there are too many
    /// files for spans.
    pub(crate) fn add_source(&mut self, source: Arc<Source>) -> Option<u16> {
        self.sources.add(source)
    }

    /// Adds a toolbox file; replaces an earlier toolbox with the same name.
    pub(crate) fn add_read(&mut self, read: ToolboxFile) {
        match read.toolbox {
            Some(toolbox) => {
                self.list.retain(|known| known.name != toolbox.name);
                self.list.push(Arc::new(toolbox));
            }
            None => self.broken.extend(read.name),
        }
        self.diags.extend(read.diags);
        self.meanings.extend(read.meanings);
        self.declared.extend(read.declared);
    }

    /// The toolbox with that name; `None` if it is missing or has errors.
    pub fn get(&self, name: &str) -> Option<&Arc<Toolbox>> {
        self.list.iter().find(|toolbox| toolbox.name == name)
    }

    /// Sets the toolbox with the robot's devices. Scenarios can use its names, independent of their
    /// plans.
    pub fn set_robot(&mut self, toolbox: &str) {
        self.robot = Some(toolbox.to_owned());
    }

    /// Sets the devices that the robot does not have although its toolbox declares them.
    pub fn set_lacks(&mut self, devices: impl IntoIterator<Item = String>) {
        self.lacks = devices.into_iter().collect();
    }

    /// Sets the sensors whose readings the robot estimates from its commands.
    pub fn set_estimates(&mut self, sensors: impl IntoIterator<Item = String>) {
        self.estimates = sensors.into_iter().collect();
    }

    /// Whether the robot estimates the readings of a sensor.
    pub(crate) fn estimates(&self, sensor: &str) -> bool {
        self.estimates.iter().any(|estimated| estimated == sensor)
    }

    /// Whether the robot does not have a device that its toolbox declares.
    pub(crate) fn lacks(&self, device: &str) -> bool {
        self.lacks.iter().any(|lacking| lacking == device)
    }

    /// The toolbox set by [`Self::set_robot`].
    pub(crate) fn said_robot(&self) -> Option<&Arc<Toolbox>> {
        self.get(self.robot.as_ref()?)
    }

    /// The toolbox with the robot's devices: the one set; else the first used one that declares a
    /// robot; else the first that does.
    pub fn robot<'a>(&'a self, used: &'a [Arc<Toolbox>]) -> Option<&'a Arc<Toolbox>> {
        let is_robot = |toolbox: &&Arc<Toolbox>| toolbox.declares_robot();
        match &self.robot {
            Some(name) => self.get(name),
            None => used.iter().find(is_robot).or_else(|| self.iter().find(is_robot)),
        }
    }

    /// Whether a toolbox declares another robot than the set one.
    pub fn is_of_another_robot(&self, toolbox: &Toolbox) -> bool {
        toolbox.declares_robot()
            && self.said_robot().is_some_and(|robot| robot.name != toolbox.name)
    }

    /// Devices of the robot's toolbox, then of other used ones; the first of equal names.
    pub fn devices<'a>(&'a self, used: &'a [Arc<Toolbox>]) -> Vec<&'a Device> {
        let mut devices: Vec<&Device> = Vec::new();
        for toolbox in self.robot(used).into_iter().chain(used) {
            for device in &toolbox.devices {
                if !devices.iter().any(|known| known.name == device.name) {
                    devices.push(device);
                }
            }
        }
        devices
    }

    pub fn iter(&self) -> impl Iterator<Item = &Arc<Toolbox>> {
        self.list.iter()
    }

    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diags
    }

    /// The texts of the toolboxes, for spans of [`Toolboxes::diagnostics`].
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    pub(crate) fn meanings(&self) -> &Meanings {
        &self.meanings
    }

    pub(crate) fn declared(&self) -> &[Declared] {
        &self.declared
    }

    /// The name of a toolbox that was added under that name and has errors.
    pub(crate) fn broken(&self, name: &str) -> Option<Span> {
        self.broken.iter().find(|known| known.text == name).map(|known| known.span)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compile_plan;

    const PLAN: &str = "use base\nuse rover\nplan P { start go actor go: Go { Done -> terminate } }\n\
                        scenario \"the wheels are blocked\" for P { at 1 s: fail wheels.blocked expect end by Error within 1 s after 1 s until 3 s }\n";

    fn toolboxes() -> Toolboxes {
        let files = [
            (
                "base",
                "toolbox base version \"1\"\ndevice wheels { fault stuck }\nactor Go { uses wheels state Done }\n",
            ),
            (
                "rover",
                "toolbox rover version \"1\"\ndevice wheels { fault blocked }\nrobot { truth pose: pose }\n",
            ),
            ("other", "toolbox other version \"1\"\ndevice lamp { fault dark }\n"),
        ];
        files.map(|(name, text)| (name, text, name)).into_iter().collect()
    }

    /// The error codes, and the known devices.
    fn told(robot: Option<&str>) -> (Vec<String>, Vec<String>) {
        let mut toolboxes = toolboxes();
        if let Some(robot) = robot {
            toolboxes.set_robot(robot);
        }
        let compiled = compile_plan(
            &Source::new("p.afp", PLAN),
            &toolboxes,
            &|_: &str| Err(String::new()),
            None,
        );
        let codes = compiled.diags.iter().map(|diag| format!("{:?}", diag.code)).collect();
        let used: Vec<_> =
            ["base", "rover"].iter().filter_map(|it| toolboxes.get(it).cloned()).collect();
        let all = toolboxes.devices(&used);
        let faults = all.iter().map(|device| {
            let faults: Vec<_> = device.faults.iter().map(|fault| &*fault.name).collect();
            format!("{} {}", device.name, faults.join(" "))
        });
        (codes, faults.map(|text| text.trim_end().to_owned()).collect())
    }

    #[test]
    fn a_robot_may_have_devices_of_another_toolbox() {
        let (codes, devices) = told(Some("rover"));
        assert_eq!(codes, Vec::<String>::new());
        assert_eq!(devices, ["wheels blocked", "robot"]);
    }

    #[test]
    fn devices_of_two_toolboxes_are_an_error_if_neither_is_the_robots() {
        for robot in [None, Some("other")] {
            assert!(told(robot).0.contains(&"E0517".to_owned()), "{robot:?}: {:?}", told(robot).0);
        }
        assert_eq!(told(Some("other")).1[0], "lamp dark");
    }
}
