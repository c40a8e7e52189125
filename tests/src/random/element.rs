//! Random elements and supervisors with their ports.

use super::Channel;
use super::dice::Dice;
use super::entries::{Entries, Kind, Type};
use super::formula::{converted, formula, ranged};
use super::plan::Shape;
use super::table::{Table, index};

/// An element or supervisor without its edges.
pub struct Made {
    /// `actor`, `computation`, `subplan` or `supervise`.
    pub word: &'static str,
    /// Template or plan, with its bindings.
    pub call: String,
    /// Its states or events; all must be connected.
    pub outcomes: Vec<&'static str>,
}

/// Types whose entries accept a value of a type, possibly by conversion.
pub const NUMBERS: &[Type] = &[Type::Float, Type::Int, Type::Text];
pub const TEXTS: &[Type] = &[Type::Text];
const SIDES: &[Type] = &[Type::Side];
const MAPS: &[Type] = &[Type::Map];

/// Bindings under construction.
pub struct Bindings<'a> {
    entries: &'a Entries,
    list: Vec<String>,
    taken: Vec<String>,
}

impl<'a> Bindings<'a> {
    pub fn new(entries: &'a Entries) -> Self {
        Bindings { entries, list: Vec::new(), taken: Vec::new() }
    }

    pub fn bind(&mut self, port: &str, formula: &str) {
        self.list.push(format!("{port} = {formula}"));
    }

    fn maybe(&mut self, port: &str, ty: Type, dice: &mut Dice) {
        if dice.percent(60) {
            let formula = converted(ty, self.entries, dice);
            self.bind(port, &formula);
        }
    }

    /// For values with a range: only entries that change can leave it.
    fn maybe_changing(&mut self, port: &str, ty: Type, dice: &mut Dice) {
        if dice.percent(60) {
            let entry = dice.pick(&self.entries.changing(ty));
            let formula = if dice.percent(50) { entry } else { format!("2 * {entry}") };
            self.bind(port, &formula);
        }
    }

    fn maybe_ranged(&mut self, port: &str, dice: &mut Dice) {
        if dice.percent(40) {
            let formula = ranged(self.entries, dice);
            self.bind(port, &formula);
        }
    }

    /// Excludes an entry from outputs.
    pub fn keep(&mut self, entry: &str) {
        self.taken.push(entry.to_owned());
    }

    /// Connects an output, each entry at most once.
    pub fn output(&mut self, port: &str, types: &[Type], dice: &mut Dice) {
        let mut free = self.entries.writable(types);
        free.retain(|entry| !self.taken.contains(entry));
        if !free.is_empty() && dice.percent(60) {
            let entry = dice.pick(&free);
            self.list.push(format!("{port} => {entry}"));
            self.taken.push(entry);
        }
    }

    pub fn call(self, template: &str) -> String {
        format!("{template}({})", self.list.join(", "))
    }
}

fn channel(
    name: &str,
    outcomes: &'static [&'static str],
    actor: bool,
    channels: &mut Vec<Channel>,
) {
    channels.push(Channel { name: name.to_owned(), outcomes, actor });
}

/// An actor; `name` is its name in scripts.
pub fn actor(name: &str, entries: &Entries, dice: &mut Dice, channels: &mut Vec<Channel>) -> Made {
    let mut bindings = Bindings::new(entries);
    if dice.percent(10) {
        bindings.bind("duration", dice.pick(&["5 ms", "20 ms", "33 ms"]));
        return Made { word: "actor", call: bindings.call("Wait"), outcomes: vec!["Elapsed"] };
    }
    bindings.bind("name", &format!("\"{name}\""));
    if dice.percent(30) {
        channel(name, &["Done"], true, channels);
        return Made { word: "actor", call: bindings.call("Task"), outcomes: vec!["Done"] };
    }
    channel(name, &["Done", "Other"], true, channels);
    bindings.maybe("value", Type::Float, dice);
    bindings.maybe("label", Type::Text, dice);
    bindings.maybe("side", Type::Side, dice);
    bindings.maybe("seen", Type::Float, dice);
    bindings.maybe_ranged("size", dice);
    bindings.maybe_ranged("reach", dice);
    bindings.output("result", NUMBERS, dice);
    bindings.output("count", NUMBERS, dice);
    bindings.output("last", NUMBERS, dice);
    bindings.output("text", TEXTS, dice);
    bindings.output("chosen", SIDES, dice);
    Made { word: "actor", call: bindings.call("Work"), outcomes: vec!["Done", "Other"] }
}

/// A supervisor.
pub fn guard(name: &str, entries: &Entries, dice: &mut Dice, channels: &mut Vec<Channel>) -> Made {
    let mut bindings = Bindings::new(entries);
    if dice.percent(10) {
        bindings.bind("duration", dice.pick(&["15 ms", "40 ms", "101 ms"]));
        let call = bindings.call("CheckTimeout");
        return Made { word: "supervise", call, outcomes: vec!["TimedOut"] };
    }
    if dice.percent(15) {
        let ty = dice.pick(&[Type::Int, Type::Float, Type::Length]);
        bindings.bind("value", &formula(ty, entries, 2, dice));
        bindings.bind("limit", &formula(ty, entries, 1, dice));
        let call = bindings.call("CheckValue");
        return Made { word: "supervise", call, outcomes: vec!["Below", "Above"] };
    }
    if dice.percent(10) {
        bindings.bind("period", dice.pick(&["15 ms", "40 ms", "101 ms"]));
        return Made { word: "supervise", call: bindings.call("Every"), outcomes: vec!["Due"] };
    }
    if dice.percent(10) {
        let ty = dice.pick(&[Type::Int, Type::Length, Type::Text, Type::Side]);
        bindings.bind("value", &formula(ty, entries, 2, dice));
        return Made {
            word: "supervise",
            call: bindings.call("Changed"),
            outcomes: vec!["Changed"],
        };
    }
    bindings.bind("name", &format!("\"{name}\""));
    if dice.percent(30) {
        channel(name, &["Seen"], false, channels);
        return Made { word: "supervise", call: bindings.call("Glance"), outcomes: vec!["Seen"] };
    }
    let outcomes = &["First", "Second", "Third"];
    channel(name, outcomes, false, channels);
    bindings.maybe("value", Type::Float, dice);
    bindings.maybe("limit", Type::Float, dice);
    if dice.percent(20) {
        let armed = dice.pick(&entries.readable(Type::Bool));
        bindings.bind("armed", &armed);
    }
    bindings.maybe_ranged("size", dice);
    bindings.output("result", NUMBERS, dice);
    bindings.output("count", NUMBERS, dice);
    Made { word: "supervise", call: bindings.call("Watch"), outcomes: outcomes.to_vec() }
}

/// A computation outside loops.
pub fn computation(entries: &Entries, tables: &[Table], dice: &mut Dice) -> Made {
    if !tables.is_empty() && dice.percent(15) {
        let index = index(entries, dice);
        return dice.pick(tables).reader(&index, None, entries, dice);
    }
    let mut bindings = Bindings::new(entries);
    let (template, outcomes) = match dice.between(0, 10) {
        0 => {
            let ty = dice.pick(&[Type::Int, Type::Float, Type::Length]);
            let (left, right) = (formula(ty, entries, 2, dice), formula(ty, entries, 2, dice));
            bindings.bind("left", &left);
            bindings.bind("right", &right);
            ("Compare", vec!["Less", "Equal", "Greater"])
        }
        1 => {
            let ty = dice.pick(&[
                Type::Int,
                Type::Float,
                Type::Length,
                Type::Text,
                Type::Side,
                Type::Map,
            ]);
            let value = match ty {
                Type::Map => dice.pick(&entries.readable(Type::Map)),
                ty => formula(ty, entries, 2, dice),
            };
            bindings.bind("value", &value);
            bindings.output("result", &[ty], dice);
            ("Assign", vec!["Done"])
        }
        2 => {
            bindings.bind("id", &formula(Type::Int, entries, 1, dice));
            bindings.output("map", MAPS, dice);
            ("MakeMap", vec!["Done"])
        }
        3 => {
            bindings.bind("map", &dice.pick(&entries.readable(Type::Map)));
            bindings.output("id", NUMBERS, dice);
            ("ReadMap", vec!["Done"])
        }
        4 => {
            let ty = dice.pick(&[Type::Bool, Type::Int, Type::Text, Type::Side]);
            bindings.bind("value", &formula(ty, entries, 2, dice));
            bindings.bind("equals", &formula(ty, entries, 1, dice));
            ("Is", vec!["Yes", "No"])
        }
        5 => {
            bindings.bind("value", &formula(Type::Side, entries, 1, dice));
            ("Switch", vec!["left", "right"])
        }
        6 => {
            bindings.bind("value", &formula(Type::Text, entries, 2, dice));
            ("Log", vec!["Done"])
        }
        _ => {
            pick(&mut bindings, entries, dice);
            ("Pick", vec!["One", "Two", "Three"])
        }
    };
    Made { word: "computation", call: bindings.call(template), outcomes }
}

/// The ports of `Pick`.
fn pick(bindings: &mut Bindings<'_>, entries: &Entries, dice: &mut Dice) {
    let choice = match dice.percent(50) {
        true => format!("{} % 4", dice.pick(&entries.changing(Type::Int))),
        false => converted(Type::Int, entries, dice),
    };
    bindings.bind("choice", &choice);
    bindings.maybe("value", Type::Float, dice);
    bindings.maybe("label", Type::Text, dice);
    bindings.maybe_ranged("size", dice);
    bindings.output("result", NUMBERS, dice);
    bindings.output("text", TEXTS, dice);
    bindings.output("next", NUMBERS, dice);
}

/// A use of another plan.
pub fn sub_plan(of: &Shape, entries: &Entries, dice: &mut Dice) -> Made {
    let mut bindings = Bindings::new(entries);
    for port in of.entries.of_kind(Kind::In) {
        match port.ranged {
            false => bindings.maybe(&port.name, port.ty, dice),
            true => bindings.maybe_changing(&port.name, port.ty, dice),
        }
    }
    for port in of.entries.of_kind(Kind::Out) {
        let types = match port.ty {
            Type::Int | Type::Float => NUMBERS.to_vec(),
            ty => vec![ty],
        };
        bindings.output(&port.name, &types, dice);
    }
    let mut outcomes = vec!["OK"];
    if of.interruptible {
        outcomes.push("Interrupted");
    }
    Made { word: "subplan", call: bindings.call(&of.name), outcomes }
}
