//! Conditions with a name that is not an entry: a supervisor, an event, an element, a sensor or a misspelling.

use super::words::{time, type_of};
use super::{Found, OF_STD};
use crate::diagnostics::words;
use crate::habits::{BEHIND, GUARD, Sensor};
use crate::kind::Kind;
use crate::parser::Parser;

/// The value that a computation of a help reads.
pub(super) struct Reads<'h> {
    pub name: &'h str,
    /// The other side of the comparison.
    pub value: &'h str,
    /// The element that follows if the condition holds.
    then: &'h str,
}

impl<'h> Reads<'h> {
    /// The value that a help reads first, if it is a name.
    pub fn of(help: &'h str) -> Option<Reads<'h>> {
        let begins =
            ["choose: Is(value = ", "choose: Compare(left = ", "value: CheckValue(value = "];
        let begin = begins.into_iter().find_map(|begin| Some(help.find(begin)? + begin.len()))?;
        let (name, rest) = help[begin..].split_once(", ")?;
        let is_name = name.starts_with(|it: char| it.is_ascii_alphabetic())
            && name.bytes().all(|it| it.is_ascii_alphanumeric() || matches!(it, b'_' | b'.'));
        let (value, edges) = rest.split_once("= ")?.1.split_once(')')?;
        let targets = edges.split("-> ").skip(1).filter_map(|edge| edge.split([',', ' ']).next());
        let then = targets.clone().find(|target| !matches!(*target, "terminate" | "ignore"));
        let then = then.or_else(|| targets.clone().next()).unwrap_or("terminate");
        let is_name = is_name && !matches!(name, "true" | "false");
        is_name.then_some(Reads { name, value, then })
    }
}

impl Parser<'_, '_> {
    /// Whether a name belongs to a value, a component or a sensor, and not to a state or event.
    pub(in crate::parser) fn is_read(&self, name: &str) -> bool {
        let known = self.known();
        let is_small = name.starts_with(|first: char| first.is_ascii_lowercase());
        known.entries.contains_key(name)
            || known.supervisors.contains_key(name)
            || is_small && Sensor::named(name).is_some()
    }

    /// The fault and its help, if a condition reads something that is not an entry; `says` and
    /// `help` are for an entry.
    pub(super) fn no_entry(
        &self,
        (says, help): (&str, &str),
        found: &Found<'_>,
    ) -> Option<(String, String)> {
        let reads = Reads::of(help)?;
        let (known, name, then) = (self.known(), reads.name, reads.then);
        if known.entries.contains_key(name) {
            return None;
        }
        let edge = self.edge_of(found);
        let edge = edge.map_or_else(String::new, |name| format!("'{name} -> {then}', and "));
        if let Some(watch) = known.supervisors.get(name) {
            let event = if watch.event.is_empty() { "Event" } else { watch.event };
            return Some(leads((name, event), then, &edge));
        }
        if let Some(supervisor) = known.events.get(name) {
            return Some(leads((supervisor, name), then, &edge));
        }
        if let Some(state) = known.elements.get(name) {
            let state = if state.is_empty() { "State" } else { state };
            let says = format!("'{name}' is an element: its states lead on");
            return Some((
                says,
                format!("write {edge}'{state} -> {then}' in the braces of '{name}'"),
            ));
        }
        if let Some(near) = words::nearest(name, known.entries.keys().copied()) {
            let help = help.replace(&format!("= {name},"), &format!("= {near},"));
            return Some((format!("{says}; there is no entry '{name}'"), help));
        }
        self.sensor((help, &edge), &reads, found)
    }

    /// The help for an edge of an event or state in another language; the sensor that it names
    /// watches.
    pub(super) fn watch_for(&self, event: &str, then: &str) -> String {
        if let Some(supervisor) = self.known().events.get(event) {
            return format!("write '{event} -> {then}' in the braces of '{supervisor}'");
        }
        let is_state = event.starts_with(|first: char| first.is_ascii_uppercase())
            && event.contains(|each: char| each.is_ascii_lowercase());
        let sensor = Sensor::named(event);
        if is_state && sensor.is_none() {
            return format!(
                "write '{event} -> {then}'; an event belongs in the braces of its supervisor"
            );
        }
        let sensor = sensor.unwrap_or_else(Sensor::touch);
        let text = sensor.supervisor.replace("{limit}", sensor.limit.2).replace("{then}", then);
        format!("write '{}'", text.replacen("supervise ", "supervise on_", 1))
    }

    /// The operand before a sign, with its unit or its brackets.
    pub(super) fn operand_before(&self) -> String {
        let mut first = self.at.saturating_sub(1);
        let kind = |at: usize| self.solid.get(at).map(|at| self.tokens[*at as usize].kind);
        if kind(first) == Some(Kind::Unit) {
            first = first.saturating_sub(1);
        } else if kind(first) == Some(Kind::CloseParen) {
            let opens = (0..first).rev().find(|at| kind(*at) == Some(Kind::OpenParen));
            first = opens.unwrap_or(first);
            first -= usize::from(first > 0 && kind(first - 1) == Some(Kind::Name));
        }
        self.text_between(first, self.at)
    }

    /// The state or event of an edge with a condition; the edge stays without it.
    fn edge_of<'f>(&'f self, found: &'f Found<'_>) -> Option<&'f str> {
        let is_first = found.habit.pattern.starts_with("NAME");
        match found.habit.says {
            GUARD if found.habit.at == BEHIND => Some(self.event),
            GUARD if is_first => found.captures.first().map(String::as_str),
            _ => None,
        }
    }

    /// The supervisor for a condition that reads a sensor.
    fn sensor(
        &self,
        (help, edge): (&str, &str),
        reads: &Reads<'_>,
        found: &Found<'_>,
    ) -> Option<(String, String)> {
        let then = reads.then;
        let is_called = |text: &&String| {
            let behind = text.split_once(reads.name).map_or("", |(_, behind)| behind);
            behind.starts_with(['(', '.'])
        };
        let call = found.captures.iter().find(is_called).map(String::as_str);
        let sensor = Sensor::named(reads.name)
            .or_else(|| call.map(|call| Sensor::named(call).unwrap_or_else(Sensor::touch)))?;
        let is_above = found.captures.iter().any(|capture| capture.contains('>'));
        let supervisor = match is_above && !sensor.above.is_empty() {
            true => sensor.above,
            false => sensor.supervisor,
        };
        let template = supervisor.split([' ', '(']).nth(2).unwrap_or_default();
        let mut watching =
            self.known().supervisors.iter().filter(|(_, it)| it.template == template);
        if let Some((name, watch)) = watching.find(|(_, watch)| !watch.event.is_empty()) {
            return Some(leads((name, watch.event), then, edge));
        }
        let limit = limit(reads.value, sensor.limit);
        let supervisor = supervisor.replace("{limit}", &limit).replace("{then}", then);
        let mut help = match help.contains("wait: Idle {") {
            true => format!("write 'actor wait: Idle {{ {supervisor} }}'"),
            false => format!("write {edge}in the braces of an element: '{supervisor}'"),
        };
        if !self.has_carbot && !OF_STD.contains(&template) {
            help += "; 'use carbot' at the top";
        }
        Some(("a plan has no conditions: a supervisor watches for an event".to_owned(), help))
    }
}

/// The fault of a condition that names a supervisor or one of its events, and its help.
fn leads((supervisor, event): (&str, &str), then: &str, edge: &str) -> (String, String) {
    let says = format!("'{supervisor}' is a supervisor: connect its event");
    (says, format!("write {edge}'{event} -> {then}' in the braces of '{supervisor}'"))
}

/// The limit of a condition, with the unit that it needs.
fn limit(value: &str, (ty, unit, default): (&str, &str, &str)) -> String {
    match type_of(value) {
        written if written == ty => value.to_owned(),
        number if number == "int" && unit == "s" => time(value, "s"),
        number if number == "int" && value.parse::<f64>().is_ok() => format!("{value} {unit}"),
        _ => default.to_owned(),
    }
}
