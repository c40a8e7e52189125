//! The robot of a plan: what can be pressed and broken.

use afp_ide::robot::{Fault, RobotDevice, Signal, Stimulus};
use serde::Deserialize;
use serde_json::{Value, json};

use super::Document;
use crate::answer::{Answer, ok};
use crate::server::Server;

/// The robot of a document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Robot {
    text_document: Document,
}

/// Its devices by the words of scenarios.
pub(crate) fn robot(server: &mut Server, params: Robot) -> Answer {
    let Some(analysis) = server.analysis(&params.text_document.uri) else { return Ok(Value::Null) };
    let robot = afp_ide::robot::robot(&analysis.set.toolboxes, &[], Vec::new());
    let devices: Vec<_> = robot.devices.iter().map(device).collect();
    ok(json!({ "platform": robot.platform, "devices": devices }))
}

fn device(device: &RobotDevice) -> Value {
    json!({
        "name": device.name,
        "help": device.help,
        "stimuli": device.stimuli.iter().map(stimulus).collect::<Vec<_>>(),
        "signals": device.signals.iter().filter(|it| !it.truth).map(signal).collect::<Vec<_>>(),
        "faults": device.faults.iter().map(fault).collect::<Vec<_>>(),
    })
}

fn stimulus(it: &Stimulus) -> Value {
    json!({ "words": it.words, "help": it.help, "stops": it.stops })
}

fn signal(it: &Signal) -> Value {
    json!({ "words": it.words, "help": it.help })
}

fn fault(it: &Fault) -> Value {
    let amount = it.amount.as_ref().map(|amount| {
        let range = [amount.from, amount.to];
        json!({ "name": amount.name, "unit": amount.unit, "default": amount.default, "range": range })
    });
    json!({ "words": it.words, "help": it.help, "amount": amount })
}
