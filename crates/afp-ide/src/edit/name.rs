//! Names in a change: whether they are valid and free.

use std::collections::BTreeSet;

use super::Refused;
use super::tree::Scope;

/// Words that are never names.
const REFUSED: &[&str] = &["self", "Self", "super", "crate", "true", "false", "repeat"];

pub(super) fn check(name: &str) -> Result<(), Refused> {
    let mut letters = name.chars();
    let first = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_');
    let rest = letters.all(|each| each.is_ascii_alphanumeric() || each == '_');
    let begins = key(name).starts_with(|first: char| first.is_ascii_alphabetic());
    if !first || !rest || !begins || REFUSED.contains(&name) {
        return Err(Refused::new(format!("'{name}' cannot be a name")));
    }
    Ok(())
}

/// Checks that a word can be the name of an element.
pub(super) fn check_element(name: &str) -> Result<(), Refused> {
    check(name)?;
    if matches!(name, "terminate" | "fail" | "ignore" | "resume" | "suspend" | "return") {
        return Err(Refused::new(format!("'{name}' cannot be the name of an element")));
    }
    Ok(())
}

/// Checks that a name is free in a scope, apart from the name `own`.
pub(super) fn check_free(scope: &Scope, name: &str, own: Option<&str>) -> Result<(), Refused> {
    let taken = scope
        .names()
        .into_iter()
        .find(|known| own != Some(known.as_str()) && key(known) == key(name));
    match taken {
        None => Ok(()),
        Some(known) if known == name => Err(Refused::new(format!("'{name}' already exists"))),
        Some(known) => {
            Err(Refused::new(format!("'{name}' and '{known}' differ only in case or '_'")))
        }
    }
}

/// Returns the name, with the lowest free number if it is taken.
pub(super) fn fresh(name: &str, taken: &[String]) -> String {
    Taken::of(taken.iter().map(String::as_str)).fresh(name)
}

/// A set of taken names, for many free ones.
#[derive(Debug, Default)]
pub(crate) struct Taken(BTreeSet<String>);

impl Taken {
    pub fn of<'n>(names: impl Iterator<Item = &'n str>) -> Taken {
        Taken(names.map(key).collect())
    }

    /// Returns the name, with the lowest free number if it is taken.
    pub fn fresh(&self, name: &str) -> String {
        let numbered = (2_u32..).map(|number| format!("{name}{number}"));
        let mut candidates = std::iter::once(name.to_owned()).chain(numbered);
        candidates.find(|candidate| !self.0.contains(&key(candidate))).unwrap_or_default()
    }
}

/// A name without its differences in spelling.
fn key(name: &str) -> String {
    name.chars().filter(|each| *each != '_').collect::<String>().to_lowercase()
}
