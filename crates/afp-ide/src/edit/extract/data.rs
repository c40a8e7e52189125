//! The data that a selection reads and writes.

use std::collections::{BTreeMap, BTreeSet};

use super::Selection;
use crate::edit::port::{data_of, reads};
use crate::edit::tree::{self, Scope, binds, children, edges, is_named, keyword, name_of, target};
use crate::edit::{Refused, name};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// An entry of the plan that the selection uses.
struct Used {
    name: String,
    ty: String,
    /// Its range as written, after a space; empty without a range.
    range: String,
    written: bool,
    /// The input that passes its value, if needed.
    input: Option<String>,
}

/// The entries that the new plan needs.
pub(super) struct Data {
    used: Vec<Used>,
    consts: Vec<String>,
}

impl Data {
    /// Finds the entries that a selection reads and writes, if it starts with `first`.
    pub fn of(selection: &Selection, first: &str) -> Result<Data, Refused> {
        let mut read = BTreeSet::new();
        let mut written = BTreeSet::new();
        for element in &selection.elements {
            read.extend(read_by(selection, element));
            written.extend(written_by(selection, element));
            for guard in children(element, Kind::Guard) {
                written.extend(written_by(selection, &guard));
            }
        }
        for entry in children(&selection.plan, Kind::Entry) {
            if name_of(&entry).is_some_and(|name| written.contains(&name)) {
                let ranges = children(&entry, Kind::Range);
                let names = ranges.flat_map(|range| reads(&range)).collect::<Vec<_>>();
                read.extend(names.iter().filter_map(|name| selection.entry(name)));
            }
        }
        let before = read_before_written(selection, first);
        let mut taken = Scope::Plan(selection.plan.clone()).names();
        let mut data = Data { used: Vec::new(), consts: consts(selection, &read) };
        for entry in children(&selection.plan, Kind::Entry) {
            let Some(name) = name_of(&entry) else { continue };
            let is_const = keyword(&entry).is_some_and(|word| word.text() == "const");
            let is_written = written.contains(&name);
            if is_const || !(is_written || read.contains(&name)) {
                continue;
            }
            let input = match (is_written, before.contains(&name)) {
                (false, _) => Some(name.clone()),
                (true, true) => {
                    let input = name::fresh(&format!("{name}Before"), &taken);
                    taken.push(input.clone());
                    Some(input)
                }
                (true, false) => None,
            };
            let ty = type_of(&entry).ok_or_else(|| {
                Refused::new(format!("'{name}' needs a written type for the new plan"))
            })?;
            let range = children(&entry, Kind::Range).next();
            let range = range.map(|range| format!(" {}", solid(&range))).unwrap_or_default();
            data.used.push(Used { name, ty, range, written: is_written, input });
        }
        Ok(data)
    }

    pub fn entries(&self) -> Vec<String> {
        let inputs = self.used.iter().filter_map(|used| {
            let input = used.input.as_ref()?;
            Some(format!("in {input}: {}", used.ty))
        });
        let outputs = self.used.iter().filter(|used| used.written).map(|used| {
            let value = used.input.iter().map(|input| format!(" = {input}")).collect::<String>();
            format!("out {}: {}{value}{}", used.name, used.ty, used.range)
        });
        inputs.chain(outputs).chain(self.consts.iter().cloned()).collect()
    }

    pub fn ports(&self) -> Vec<String> {
        let inputs = self.used.iter().filter_map(|used| {
            let input = used.input.as_ref()?;
            Some(format!("{input} = {}", used.name))
        });
        let outputs = self.used.iter().filter(|used| used.written);
        inputs.chain(outputs.map(|used| format!("{0} => {0}", used.name))).collect()
    }
}

pub(in crate::edit) fn type_of(entry: &Node) -> Option<String> {
    let ty = children(entry, Kind::Type).next()?;
    let tokens = ty.descendants_with_tokens().filter_map(|each| each.into_token());
    Some(tokens.filter(|token| !token.kind().is_trivia()).map(|t| t.text().to_owned()).collect())
}

/// The entries that an element and its supervisors read.
fn read_by(selection: &Selection, element: &Node) -> BTreeSet<String> {
    let all = data_of(element).filter(|bound| !selection.is_output(bound));
    all.flat_map(|bind| reads(&bind)).filter_map(|token| selection.entry(&token)).collect()
}

/// The entries written by a component's own outputs.
fn written_by(selection: &Selection, component: &Node) -> BTreeSet<String> {
    let outputs = binds(component).into_iter().filter(|bind| selection.is_output(bind));
    outputs.filter_map(|bind| selection.entry(&target(&bind)?)).collect()
}

/// The constants that are read, and the constants in their formulas, as written.
fn consts(selection: &Selection, read: &BTreeSet<String>) -> Vec<String> {
    let all: Vec<_> = children(&selection.plan, Kind::Entry)
        .filter(|entry| keyword(entry).is_some_and(|word| word.text() == "const"))
        .collect();
    let mut needed = read.clone();
    let mut open: Vec<String> = read.iter().cloned().collect();
    while let Some(name) = open.pop() {
        for entry in all.iter().filter(|entry| is_named(entry, &name)) {
            for part in reads(entry).iter().filter_map(|token| selection.entry(token)) {
                if needed.insert(part.clone()) {
                    open.push(part);
                }
            }
        }
    }
    let is_needed = |entry: &&Node| name_of(entry).is_some_and(|name| needed.contains(&name));
    // A comma after the entry does not belong to it.
    let text = |entry: &Node| solid(entry).trim_end_matches([',', ' ']).to_owned();
    all.iter().filter(is_needed).map(text).collect()
}

/// The text of a node without comments and with single spaces.
fn solid(node: &Node) -> String {
    let tokens = node.descendants_with_tokens().filter_map(|each| each.into_token());
    let solid = tokens.filter(|token| !token.kind().is_trivia());
    let words: Vec<_> = solid.map(|token| token.text().to_owned()).collect();
    words.join(" ")
}

/// The entries that an element may read before the selection has written them.
///
/// Outputs count as written in every state of their element. If this is wrong, the entry had a
/// value before, and the check reports it as missing.
fn read_before_written(selection: &Selection, first: &str) -> BTreeSet<String> {
    let mut known: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut open = vec![(first.to_owned(), BTreeSet::new())];
    while let Some((name, arriving)) = open.pop() {
        let met = match known.get(&name) {
            Some(before) => before.intersection(&arriving).cloned().collect(),
            None => arriving,
        };
        if known.get(&name) == Some(&met) {
            continue;
        }
        known.insert(name.clone(), met.clone());
        let element = selection.elements.iter().find(|element| is_named(element, &name));
        let Some(element) = element else { continue };
        let guards = children(element, Kind::Guard);
        for component in std::iter::once(element.clone()).chain(guards) {
            for edge in edges(&component) {
                let Some(target) = target(&edge).filter(|t| selection.is_inside(t)) else {
                    continue;
                };
                let mut leaving = met.clone();
                let silent = |name: &str| ["Error", "DeadlineMissed"].contains(&name);
                let commits = !tree::outcomes(&edge).any(|name| silent(name.text()));
                if commits {
                    leaving.extend(written_by(selection, &component));
                }
                open.push((target.text().to_owned(), leaving));
            }
        }
    }
    let mut before = BTreeSet::new();
    for element in &selection.elements {
        let surely = tree::name_of(element).and_then(|name| known.get(&name));
        let read = read_by(selection, element);
        before.extend(read.into_iter().filter(|name| !surely.is_some_and(|s| s.contains(name))));
    }
    before
}
