//! Changes of meaning in Python's form: a kind, and named parts.

use afp_ide::edit::{Binding, Change, TextEdit};
use afp_syntax::ast::Item as Node;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::item::Item;
use afp_syntax::parse;
use afp_syntax::source::Span;
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The names of the plans of a text.
pub fn plans(text: &str) -> Vec<String> {
    names(text, |node| match node {
        Node::Plan(plan) => plan.name().map(|name| name.text),
        _ => None,
    })
}

fn names(text: &str, name: impl Fn(Node) -> Option<String>) -> Vec<String> {
    let file = parse(text, 0, &mut Diagnostics::default()).file();
    file.items().into_iter().filter_map(name).collect()
}

/// The parts of a change.
struct Parts<'a, 'py> {
    parts: &'a Bound<'py, PyDict>,
    text: &'a str,
    plans: Vec<String>,
}

impl Parts<'_, '_> {
    fn maybe(&self, key: &str) -> PyResult<Option<String>> {
        match self.parts.get_item(key)? {
            Some(value) if !value.is_none() => Ok(Some(text(key, &value)?)),
            _ => Ok(None),
        }
    }

    fn part(&self, key: &str) -> PyResult<String> {
        let value = self.parts.get_item(key)?;
        let value = value.ok_or_else(|| PyKeyError::new_err(format!("no part '{key}'")))?;
        text(key, &value)
    }

    /// The named plan, or the first one.
    fn plan(&self) -> PyResult<String> {
        let first = || self.plans.first().cloned();
        let none = || PyValueError::new_err("the file has no plan yet; add one");
        self.maybe("plan")?.or_else(first).ok_or_else(none)
    }

    /// `Plan`, `Enum`, `[Plan.]element` or `[Plan.]element.supervisor`.
    fn item(&self, key: &str) -> PyResult<Item> {
        let path = self.part(key)?;
        let words: Vec<&str> = path.split('.').collect();
        let is_plan = |name: &str| self.plans.iter().any(|plan| plan == name);
        let is_enum = |name: &str| {
            let enums = names(self.text, |node| match node {
                Node::Enum(choices) => choices.name().map(|name| name.text),
                _ => None,
            });
            enums.iter().any(|each| each == name)
        };
        let (plan, inner) = match words.split_first() {
            Some((first, rest)) if is_plan(first) => ((*first).to_owned(), rest),
            _ => (self.plan()?, &words[..]),
        };
        match *inner {
            [] => Ok(Item::plan(plan)),
            [name] if words.len() == 1 && is_enum(name) => Ok(Item::enumeration(name)),
            [name] => Ok(Item::inner(plan, name)),
            [owner, name] => Ok(Item::local(plan, owner, name)),
            _ => Err(PyValueError::new_err(format!(
                "'{path}' is not the path of an item: write 'element' or 'element.supervisor'"
            ))),
        }
    }
}

/// A string part of a change.
fn text(key: &str, value: &Bound<'_, PyAny>) -> PyResult<String> {
    let text = value.extract();
    let repr = |_| match value.repr() {
        Ok(shown) => PyTypeError::new_err(format!("{key} must be a string, not {shown}")),
        Err(why) => why,
    };
    text.map_err(repr)
}

/// Parses a change; `text` is that of the plan's file.
pub fn read(kind: &str, parts: &Bound<'_, PyDict>, text: &str) -> PyResult<Change> {
    let of = Parts { parts, text, plans: plans(text) };
    Ok(match kind {
        "use" => Change::AddUse { toolbox: of.part("toolbox")?, alias: of.maybe("alias")? },
        "add_plan" => Change::AddPlan { text: of.part("text")? },
        "add" => Change::Add {
            plan: of.plan()?,
            owner: of.maybe("owner")?,
            text: of.part("text")?,
            before: of.maybe("before")?,
        },
        "remove" => Change::Remove { item: of.item("item")? },
        "rename" => Change::Rename { item: of.item("item")?, to: of.part("to")? },
        "connect" => Change::Connect {
            from: of.item("item")?,
            outcome: of.part("outcome")?,
            to: of.part("to")?,
        },
        "disconnect" => Change::Disconnect { from: of.item("item")?, outcome: of.part("outcome")? },
        "start" => Change::SetStart { plan: of.plan()?, to: of.part("to")? },
        "reorder" => Change::Reorder { item: of.item("item")?, before: of.maybe("before")? },
        "bind" => Change::Bind {
            component: of.item("item")?,
            port: of.part("port")?,
            to: match of.maybe("entry")? {
                Some(entry) => Binding::Out(entry),
                None => Binding::In(of.part("formula")?),
            },
        },
        "unbind" => Change::Unbind { component: of.item("item")?, port: of.part("port")? },
        "template" => {
            Change::SetTemplate { component: of.item("item")?, template: of.part("template")? }
        }
        "timing" => Change::SetTiming {
            supervisor: of.item("item")?,
            keyword: of.part("keyword")?,
            value: of.maybe("value")?,
        },
        "entry_kind" => {
            Change::SetEntryKind { entry: of.item("item")?, keyword: of.part("keyword")? }
        }
        "entry_type" => Change::SetEntryType { entry: of.item("item")?, ty: of.maybe("type")? },
        "entry_value" => {
            Change::SetEntryValue { entry: of.item("item")?, value: of.maybe("value")? }
        }
        "condition" => Change::SetCondition {
            computation: of.part("computation")?,
            state: of.part("state")?,
            condition: of.maybe("condition")?,
        },
        "assign" => Change::Assign {
            computation: of.part("computation")?,
            state: of.part("state")?,
            output: of.part("output")?,
            formula: of.maybe("formula")?,
        },
        "doc" => Change::SetDoc { item: of.item("item")?, text: of.part("text")? },
        "move" => Change::Move {
            item: of.item("item")?,
            plan: of.part("to_plan")?,
            owner: of.maybe("owner")?,
        },
        "extract" => Change::Extract {
            plan: of.plan()?,
            elements: match parts.get_item("elements")? {
                Some(elements) => elements.extract()?,
                None => Vec::new(),
            },
            new_plan: of.part("new_plan")?,
            element: of.part("element")?,
        },
        "inline" => Change::Inline { plan: of.plan()?, element: of.part("element")? },
        other => return Err(PyValueError::new_err(format!("no change '{other}'"))),
    })
}

/// The spans of the new texts after all edits of a file.
pub fn written(edits: &[TextEdit]) -> Vec<Span> {
    let mut moved = 0_i64;
    let at = |place: i64| u32::try_from(place).unwrap_or(u32::MAX);
    let one = |edit: &TextEdit| {
        let start = i64::from(edit.span.start) + moved;
        let length = i64::try_from(edit.text.len()).unwrap_or(i64::MAX);
        moved += length - i64::from(edit.span.end - edit.span.start);
        Span { file: edit.span.file, start: at(start), end: at(start + length) }
    };
    edits.iter().map(one).collect()
}

/// Whether two spans of a file overlap; an edit can be shorter than a word.
pub fn meet(one: Span, other: Span) -> bool {
    one.start <= other.end && other.start <= one.end
}

/// The exception for a value that does not fit.
pub fn misfit(wrong: &Diagnostic) -> PyErr {
    // The help's unit is for plan files and does not apply to Python.
    let help = match wrong.code {
        Code::E0203 => "give it its unit, as in afp.cm(30) or afp.deg(90)",
        _ => &wrong.help_text(),
    };
    let text = match help {
        "" => wrong.message_text(),
        help => format!("{}; {help}", wrong.message_text()),
    };
    match wrong.code {
        Code::E0203 | Code::E0204 | Code::E0205 | Code::E0206 => PyTypeError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}
