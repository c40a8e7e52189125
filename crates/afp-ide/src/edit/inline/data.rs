//! The entries of a sub-plan's plan in the outer plan.

use std::collections::BTreeMap;

use super::Call;
use crate::edit::extract::type_of;
use crate::edit::port::{port_of, reads, value};
use crate::edit::tree::{
    self, Scope, binds, children, init, keyword, name_of, range, solid_range, target,
};
use crate::edit::{Refused, name};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

pub(super) struct Data {
    read: BTreeMap<String, String>,
    /// After `=>`.
    written: BTreeMap<String, String>,
    /// New entries of the outer plan.
    pub new_entries: Vec<String>,
}

impl Data {
    /// Finds a replacement for every entry.
    pub fn of(call: &Call) -> Result<Data, Refused> {
        let mut taken = Scope::Plan(call.outer.clone()).names();
        taken.extend(call.names.iter().map(|(_, new)| new.clone()));
        let mut data =
            Data { read: BTreeMap::new(), written: BTreeMap::new(), new_entries: Vec::new() };
        for word in ["const", "out", "var", "in"] {
            for entry in children(&call.inner, Kind::Entry) {
                let Some(name) = name_of(&entry) else { continue };
                match keyword(&entry).filter(|keyword| keyword.text() == word) {
                    None => {}
                    Some(_) if word == "const" => data.constant(call, &entry, name, &mut taken),
                    Some(_) if word == "in" => data.input(call, &entry, name)?,
                    Some(_) => data.variable(call, &entry, name, &mut taken)?,
                }
            }
        }
        Ok(data)
    }

    /// The formula that replaces an entry of the inner plan.
    pub fn read_as(&self, name: &str) -> Option<&str> {
        self.read.get(name).map(String::as_str)
    }

    /// The entry of the outer plan that replaces an output of the inner one.
    pub fn written_to(&self, name: &str) -> Option<&str> {
        self.written.get(name).map(String::as_str)
    }

    /// The text of a node of the inner plan, with the outer names.
    fn translated(&self, call: &Call, node: &Node) -> String {
        let solid = solid_range(node).unwrap_or_default();
        let start = usize::from(node.text_range().start());
        let mut text = node.text().to_string()[solid.start - start..solid.end - start].to_owned();
        for token in reads(node).iter().rev() {
            let entry = call.project.entry(call.from, token);
            if let Some(new) = entry.and_then(|entry| self.read_as(&entry)) {
                let place = range(token);
                text.replace_range(place.start - solid.start..place.end - solid.start, new);
            }
        }
        text
    }

    fn constant(&mut self, call: &Call, entry: &Node, name: String, taken: &mut Vec<String>) {
        let Some(value) = init(entry) else { return };
        let ty = type_of(entry).map(|ty| format!(": {ty}")).unwrap_or_default();
        let rest = format!("{ty} = {}", self.translated(call, &value));
        let line = |entry: &Node| {
            let ty = type_of(entry).map(|ty| format!(": {ty}")).unwrap_or_default();
            let init = init(entry).as_ref().map(plain).unwrap_or_default();
            format!("{ty} = {init}")
        };
        let same = children(&call.outer, Kind::Entry).any(|known| {
            tree::is_named(&known, &name)
                && keyword(&known).is_some_and(|word| word.text() == "const")
                && line(&known) == rest
        });
        let new = if same { name.clone() } else { name::fresh(&name, taken) };
        if !same {
            taken.push(new.clone());
            self.new_entries.push(format!("const {new}{rest}"));
        }
        self.read.insert(name, new);
    }

    fn variable(
        &mut self,
        call: &Call,
        entry: &Node,
        name: String,
        taken: &mut Vec<String>,
    ) -> Result<(), Refused> {
        if init(entry).is_some() {
            return Err(Refused::new(format!("'{name}' begins with a value at every activation")));
        }
        let ty =
            type_of(entry).ok_or_else(|| Refused::new(format!("'{name}' has no written type")))?;
        let range = self.range(call, entry);
        let bound = binds(&call.element).into_iter().find(|bind| port_of(bind) == name);
        let new = match bound.and_then(|bind| target(&bind)) {
            Some(outer) => {
                let known = tree::inner(&call.outer, outer.text());
                let same_range = known.as_ref().is_some_and(|known| {
                    let own = children(known, Kind::Range).next().as_ref().map(plain);
                    range == own.map(|own| format!(" {own}")).unwrap_or_default()
                });
                let what = match known.as_ref().and_then(type_of).as_ref() == Some(&ty) {
                    false => Some("type"),
                    true => (!same_range).then_some("range"),
                };
                if let Some(what) = what {
                    let outer = outer.text();
                    return Err(Refused::new(format!("'{name}' and '{outer}' differ in {what}")));
                }
                outer.text().to_owned()
            }
            None => {
                let new = name::fresh(&name, taken);
                taken.push(new.clone());
                self.new_entries.push(format!("var {new}: {ty}{range}"));
                new
            }
        };
        self.read.insert(name.clone(), new.clone());
        self.written.insert(name, new);
        Ok(())
    }

    /// The range of an entry, with the outer names and after a space; empty without a range.
    fn range(&self, call: &Call, entry: &Node) -> String {
        let range = children(entry, Kind::Range).next();
        range.map(|range| format!(" {}", self.translated(call, &range))).unwrap_or_default()
    }

    fn input(&mut self, call: &Call, entry: &Node, name: String) -> Result<(), Refused> {
        let bound = binds(&call.element).into_iter().find(|bind| port_of(bind) == name);
        let formula = bound.as_ref().and_then(value);
        let text = match (&formula, init(entry)) {
            (Some(formula), _) => {
                self.check_steady(formula, &name)?;
                plain(formula)
            }
            (None, Some(default)) => self.translated(call, &default),
            (None, None) => return Err(Refused::new(format!("'{name}' is not bound"))),
        };
        let passed = formula.as_ref().is_some_and(|formula| formula.kind() != Kind::Literal);
        if passed && children(entry, Kind::Range).next().is_some() {
            return Err(Refused::new(format!(
                "the sub-plan checks the range of its input '{name}'"
            )));
        }
        let shape = formula.or_else(|| init(entry));
        let Some(shape) = shape else { return Ok(()) };
        if tree::holds_comment(&shape) {
            return Err(Refused::new(format!("the formula of '{name}' contains a comment")));
        }
        let ty = type_of(entry).unwrap_or_default();
        let homes = [&call.outer, &call.inner];
        let exact = is_exact(&shape, &ty, &homes);
        if !exact {
            return Err(Refused::new(format!(
                "the sub-plan converts its input '{name}'; give it the type '{ty}' first"
            )));
        }
        let text = match shape.kind() {
            Kind::Ref | Kind::Brackets | Kind::Call => text,
            Kind::Literal if ty == "float" && text.bytes().all(|b| b.is_ascii_digit()) => {
                text + ".0"
            }
            Kind::Literal => text,
            _ => format!("({text})"),
        };
        self.read.insert(name, text);
        Ok(())
    }

    /// Checks that the sub-plan does not change the entries in an input's formula.
    fn check_steady(&self, formula: &Node, name: &str) -> Result<(), Refused> {
        let mut read = reads(formula).into_iter();
        let changed = read.find(|token| self.written.values().any(|outer| outer == token.text()));
        match changed {
            None => Ok(()),
            Some(token) => Err(Refused::new(format!(
                "'{name}' is computed from '{}', which the sub-plan changes",
                token.text()
            ))),
        }
    }
}

/// The text of a node without trivia around it.
fn plain(node: &Node) -> String {
    let solid = solid_range(node).unwrap_or_default();
    let start = usize::from(node.text_range().start());
    node.text().to_string()[solid.start - start..solid.end - start].to_owned()
}

/// Whether a formula has a definite type, and so the same meaning in every context.
fn is_exact(formula: &Node, ty: &str, homes: &[&Node]) -> bool {
    let converts = matches!(ty, "bool" | "int" | "float" | "string");
    match formula.kind() {
        Kind::Ref => match tree::single(formula) {
            None => true,
            Some(token) => homes.iter().any(|home| {
                let entry = tree::inner(home, token.text());
                entry.as_ref().and_then(type_of).as_deref() == Some(ty)
            }),
        },
        Kind::Literal => {
            let mut tokens = formula.descendants_with_tokens().filter_map(|t| t.into_token());
            let kind = tokens.find(|token| !token.kind().is_trivia()).map(|token| token.kind());
            let unit = tree::tokens(formula, Kind::Unit).next().is_some();
            match (ty, kind) {
                ("int", Some(Kind::Int)) | ("float", Some(Kind::Int | Kind::Float)) => !unit,
                ("string", Some(Kind::Text)) | ("bool", Some(Kind::Name)) => true,
                _ => !converts && unit,
            }
        }
        _ => !converts,
    }
}
