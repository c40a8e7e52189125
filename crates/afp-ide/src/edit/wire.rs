//! Items in messages, with paths as strings.
//!
//! `Plan`, `Plan.element` and `Plan.element.supervisor` as [`Item`] displays them; an enum is `enum
//! Side`, to differ from a plan.

use super::Item;
use serde::{Deserialize, Deserializer, Serializer};

pub fn item(path: &str) -> Option<Item> {
    if let Some(name) = path.strip_prefix("enum ") {
        return Some(Item::enumeration(name));
    }
    if let Some(name) = path.strip_prefix("table ") {
        return Some(Item::table(name));
    }
    let names: Vec<_> = path.split('.').collect();
    match names.as_slice() {
        [""] => None,
        [plan] => Some(Item::plan(*plan)),
        [plan, name] => Some(Item::inner(*plan, *name)),
        [plan, owner, name] => Some(Item::local(*plan, *owner, *name)),
        _ => None,
    }
}

pub fn path(item: &Item) -> String {
    match item {
        Item::Enum { name } => format!("enum {name}"),
        Item::Table { name } => format!("table {name}"),
        _ => item.to_string(),
    }
}

pub(super) fn serialize<S: Serializer>(item: &Item, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path(item))
}

pub(super) fn deserialize<'d, D: Deserializer<'d>>(deserializer: D) -> Result<Item, D::Error> {
    let text = String::deserialize(deserializer)?;
    let wrong = || serde::de::Error::custom(format!("'{text}' is not the path of an item"));
    item(&text).ok_or_else(wrong)
}
