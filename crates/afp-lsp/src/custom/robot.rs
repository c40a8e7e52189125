//! The robot of a plan: its controls, faults and signals.
//!
//! All names come from the toolbox that declares the robot, so nothing has to be built or linked.

use afp_dsl::Toolboxes;
use afp_dsl::toolbox::Device;
use serde_json::{Value, json};

use super::WholeDocument;
use crate::answer::{Answer, ok};
use crate::server::Server;

/// Describes the robot's devices in the words of scenarios, without ground truth for judges.
pub(crate) fn robot(server: &mut Server, params: WholeDocument) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    ok(described(&analysis.set.toolboxes))
}

fn described(toolboxes: &Toolboxes) -> Value {
    let platform = toolboxes.robot(&[]).map_or("", |toolbox| &*toolbox.name);
    let devices: Vec<_> = toolboxes.devices(&[]).into_iter().map(device).collect();
    json!({ "platform": platform, "devices": devices })
}

fn device(device: &Device) -> Value {
    let words = |name: &str| format!("{}.{name}", device.name);
    let stimuli = device.controls.iter();
    let stimuli =
        stimuli.map(|it| json!({ "words": words(&it.name), "help": it.doc, "stops": it.stops }));
    let signals = device.signals.iter().filter(|it| !it.truth);
    let signals = signals.map(|it| json!({ "words": words(&it.name), "help": it.doc }));
    let faults = device.faults.iter().map(|it| {
        // An infinite bound becomes `null`.
        let amount = it.amount.as_ref().map(|of| {
            let (unit, range) = (of.dimension.si_unit(), [of.from, of.to]);
            json!({ "name": of.name, "unit": unit, "default": of.default, "range": range })
        });
        json!({ "words": words(&it.name), "help": it.doc, "amount": amount })
    });
    json!({
        "name": device.name,
        "help": device.doc,
        "stimuli": stimuli.collect::<Vec<_>>(),
        "signals": signals.collect::<Vec<_>>(),
        "faults": faults.collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::source::Source;

    const VACUUM: &str = include_str!("../../../../examples/vacuum/vacuum.afp");

    /// Collects one list over all devices.
    fn words(robot: &Value, list: &str, wanted: impl Fn(&Value) -> bool) -> String {
        let devices = robot["devices"].as_array().into_iter().flatten();
        let all = devices.flat_map(|device| device[list].as_array().into_iter().flatten());
        let all = all.filter(|it| wanted(it)).filter_map(|it| it["words"].as_str());
        all.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn a_project_shows_its_own_robot() {
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        toolboxes.add(Source::new("vacuum.afp", VACUUM), "vacuum");
        toolboxes.set_robot("vacuum");
        let robot = described(&toolboxes);
        assert_eq!(robot["platform"], "vacuum");
        assert_eq!(words(&robot, "stimuli", |_| true), "bumper.left bumper.right button.halt");
        assert_eq!(words(&robot, "stimuli", |it| it["stops"] == true), "button.halt");
        let faults = &robot["devices"][0]["faults"];
        assert_eq!(faults.as_array().map(Vec::len), Some(2));
        assert_eq!([&faults[0]["words"], &faults[1]["words"]], ["wheels.blocked", "wheels.slip"]);
        let share = json!({ "name": "share", "unit": "", "default": 0.5, "range": [0.0, 1.0] });
        assert_eq!(faults[1]["amount"], share);
        let signals = words(&robot, "signals", |_| true);
        for truth in ["robot.pose", "robot.cleaned", "robot.fallen"] {
            assert!(!signals.contains(truth), "{signals}");
        }
        let devices = robot["devices"].as_array().into_iter().flatten();
        let bumper = devices.clone().find(|device| device["name"] == "bumper").unwrap();
        assert!(words(&robot, "faults", |_| true).contains("bumper.frozen"));
        assert_eq!(bumper["help"], "The bumper in front, with a switch on either side.");
    }

    #[test]
    fn without_a_project_it_is_the_built_in_robot() {
        let robot = described(&afp_toolboxes::sources().collect());
        assert_eq!(robot["platform"], "carbot");
        assert!(!words(&robot, "stimuli", |it| it["stops"] == true).is_empty());
    }
}
