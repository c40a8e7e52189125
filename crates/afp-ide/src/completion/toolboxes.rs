//! Items of toolboxes and their parts.

use super::List;
use super::bodies::Piece;
use afp_syntax::kind::Kind;

fn with_holes(parts: &[&str]) -> Vec<Piece> {
    let piece = |(index, text): (usize, &&str)| match index % 2 {
        0 => Piece::Text((*text).to_owned()),
        _ => Piece::Hole((*text).to_owned()),
    };
    parts.iter().enumerate().map(piece).collect()
}

pub(super) fn of_file(list: &mut List) {
    list.keyword("toolbox", with_holes(&["toolbox ", "name", " version \"", "1.0", "\""]), 1);
    let state = " {\n    state ";
    list.keyword("actor", with_holes(&["actor ", "Name", state, "Done", "\n}"]), 0);
    list.keyword("computation", with_holes(&["computation ", "Name", state, "Done", "\n}"]), 0);
    let event = " {\n    event ";
    list.keyword("supervisor", with_holes(&["supervisor ", "Name", event, "Happened", "\n}"]), 0);
    list.keyword("enum", with_holes(&["enum ", "Name", " { ", "first second", " }"]), 1);
    list.keyword("object", with_holes(&["object ", "Name"]), 1);
    let signal = " {\n    signal ";
    list.keyword("sensor", with_holes(&["sensor ", "name", signal, "value: float", "\n}"]), 1);
    list.keyword("device", with_holes(&["device ", "name", signal, "value: float", "\n}"]), 1);
    list.keyword("robot", with_holes(&["robot {\n    truth ", "pose: pose", "\n}"]), 1);
}

/// Parts of a template or device.
pub(super) fn parts(list: &mut List, within: Kind) {
    if within == Kind::Device {
        return list.keywords(&["press", "stop", "fault", "signal", "truth"], 0);
    }
    list.keyword("in", with_holes(&["in ", "port", ": ", "float"]), 0);
    list.keyword("in live", with_holes(&["in live ", "port", ": ", "float"]), 0);
    list.keyword("out", with_holes(&["out ", "port", ": ", "float"]), 0);
    list.keywords(&["state", "event"], 0);
    list.keywords(&["every", "deadline", "budget", "stop", "uses"], 1);
    list.keyword("icon", with_holes(&["icon \"", "name", "\""]), 1);
}
