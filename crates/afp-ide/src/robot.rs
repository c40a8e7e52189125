//! The robot of a plan as editors show it: what can be pressed and broken, what it signals, worlds to run in.
//!
//! All of a robot's words come from the toolbox that declares it, so nothing need be built or linked to show them. Which
//! worlds there are says who has files.

use std::sync::Arc;

use afp_dsl::Toolboxes;
use afp_dsl::toolbox::{Device, Toolbox};

#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The toolbox that declares it; empty where none does.
    pub platform: String,
    /// Its devices, as declared; one that cannot be pressed or broken is among them.
    pub devices: Vec<RobotDevice>,
    /// The worlds that a run may take place in, the one that is taken without a word first.
    pub worlds: Vec<WorldSource>,
}

/// A device of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotDevice {
    pub name: String,
    pub help: String,
    /// What can be held down.
    pub stimuli: Vec<Stimulus>,
    /// How it can be broken.
    pub faults: Vec<Fault>,
    pub signals: Vec<Signal>,
}

/// Something that can be held down.
#[derive(Clone, Debug, PartialEq)]
pub struct Stimulus {
    /// As scenarios and `--press` name it: `bumper.left`.
    pub words: String,
    pub help: String,
    /// Whether it is there to end what runs.
    pub stops: bool,
}

/// A way to break a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// As scenarios and `--fail` name it: `wheels.slip`.
    pub words: String,
    /// What happens.
    pub help: String,
    /// How much of it there can be.
    pub amount: Option<Amount>,
}

/// How much of a fault there can be, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Amount {
    pub name: String,
    /// Its unit; empty for a plain number.
    pub unit: String,
    /// What is taken where nothing is said.
    pub default: f64,
    /// The least; none without a bound.
    pub from: Option<f64>,
    /// The greatest; none without a bound.
    pub to: Option<f64>,
}

/// Something that a device signals.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// As scenarios name it: `bumper.left`.
    pub words: String,
    pub help: String,
    /// Whether only a judge may know it.
    pub truth: bool,
}

/// A world that a run may take place in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldSource {
    /// As `--world` takes it: a path, or `random:7`; empty for the built-in one.
    pub name: String,
    /// Where it comes from, in words.
    pub from: String,
}

/// The robot of a plan that uses some toolboxes. The worlds come from whoever has files, as `afp_run::world::all` does.
pub fn robot(toolboxes: &Toolboxes, used: &[Arc<Toolbox>], worlds: Vec<WorldSource>) -> Robot {
    Robot {
        platform: toolboxes.robot(used).map(|toolbox| toolbox.name.clone()).unwrap_or_default(),
        devices: toolboxes.devices(used).into_iter().map(shown).collect(),
        worlds,
    }
}

fn shown(device: &Device) -> RobotDevice {
    let words = |name: &str| format!("{}.{name}", device.name);
    let stimuli = device.controls.iter().map(|control| Stimulus {
        words: words(&control.name),
        help: control.doc.clone(),
        stops: control.stops,
    });
    let faults = device.faults.iter().map(|fault| Fault {
        words: words(&fault.name),
        help: fault.doc.clone(),
        amount: fault.amount.as_ref().map(|amount| Amount {
            name: amount.name.clone(),
            unit: amount.dimension.si_unit(),
            default: amount.default,
            from: Some(amount.from).filter(|bound| bound.is_finite()),
            to: Some(amount.to).filter(|bound| bound.is_finite()),
        }),
    });
    let signals = device.signals.iter().map(|signal| Signal {
        words: words(&signal.name),
        help: signal.doc.clone(),
        truth: signal.truth,
    });
    RobotDevice {
        name: device.name.clone(),
        help: device.doc.clone(),
        stimuli: stimuli.collect(),
        faults: faults.collect(),
        signals: signals.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::source::Source;

    const VACUUM: &str = include_str!("../../../examples/vacuum/vacuum.afp");

    fn all(robot: &Robot, rows: impl Fn(&RobotDevice) -> Vec<String>) -> String {
        robot.devices.iter().flat_map(rows).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_project_shows_its_own_robot() {
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        toolboxes.add(Source::new("vacuum.afp", VACUUM), "vacuum");
        toolboxes.set_robot("vacuum");
        let robot = robot(&toolboxes, &[], Vec::new());
        assert_eq!(robot.platform, "vacuum");
        let stimuli =
            |device: &RobotDevice| device.stimuli.iter().map(|it| it.words.clone()).collect();
        assert_eq!(all(&robot, stimuli), "bumper.left bumper.right button.halt");
        let stops = |device: &RobotDevice| {
            device.stimuli.iter().filter(|it| it.stops).map(|it| it.words.clone()).collect()
        };
        assert_eq!(all(&robot, stops), "button.halt");
        let wheels = &robot.devices[0];
        let faults: Vec<_> = wheels.faults.iter().map(|it| &*it.words).collect();
        assert_eq!(faults, ["wheels.blocked", "wheels.slip"]);
        let share = wheels.faults[1].amount.as_ref().unwrap();
        assert_eq!((&*share.name, &*share.unit, share.default), ("share", "", 0.5));
        assert_eq!((share.from, share.to), (Some(0.0), Some(1.0)));
        let truth = |device: &RobotDevice| {
            device.signals.iter().filter(|it| it.truth).map(|it| it.words.clone()).collect()
        };
        assert_eq!(all(&robot, truth), "robot.pose robot.cleaned robot.fallen");
        let bumper = robot.devices.iter().find(|device| device.name == "bumper").unwrap();
        assert!(bumper.faults.iter().any(|it| it.words == "bumper.frozen"));
        assert_eq!(bumper.help, "The bumper in front, with a switch on either side.");
    }

    #[test]
    fn without_a_project_it_is_the_built_in_robot() {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let robot = robot(&toolboxes, &[], Vec::new());
        assert_eq!(robot.platform, "carbot");
        assert!(robot.devices.iter().any(|device| device.stimuli.iter().any(|it| it.stops)));
    }
}
