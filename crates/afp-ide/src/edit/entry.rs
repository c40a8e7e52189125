//! The parts of an entry: keyword, type, initial value.

use super::buffer::TextBuffer;
use super::tree::{self, children, name_token, range, solid_range};
use super::{Item, Refused, fragment, name};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

fn find(buffer: &TextBuffer, entry: &Item) -> Result<Node, Refused> {
    let node = tree::find(&buffer.root(), entry)?;
    match node.kind() {
        Kind::Entry => Ok(node),
        _ => Err(Refused::new(format!("'{}' is not an entry", entry.name()))),
    }
}

/// The text of an entry.
pub(super) fn text(
    keyword: &str,
    name: &str,
    ty: Option<&str>,
    value: Option<&str>,
) -> Result<String, Refused> {
    check_keyword(keyword)?;
    name::check(name)?;
    ty.map_or(Ok(()), fragment::ty)?;
    value.map_or(Ok(()), fragment::formula)?;
    if ty.is_none() && value.is_none() {
        return Err(Refused::new(format!("the entry '{name}' needs a type or a value")));
    }
    let ty = ty.map(|ty| format!(": {}", ty.trim())).unwrap_or_default();
    let value = value.map(|value| format!(" = {}", value.trim())).unwrap_or_default();
    Ok(format!("{keyword} {name}{ty}{value}"))
}

fn check_keyword(keyword: &str) -> Result<(), Refused> {
    match keyword {
        "in" | "out" | "var" | "const" => Ok(()),
        _ => {
            Err(Refused::new(format!("an entry is 'in', 'out', 'var' or 'const', not '{keyword}'")))
        }
    }
}

pub(super) fn set_kind(
    buffer: &mut TextBuffer,
    entry: &Item,
    keyword: &str,
) -> Result<(), Refused> {
    check_keyword(keyword)?;
    let node = find(buffer, entry)?;
    let old = tree::keyword(&node).ok_or_else(|| Refused::new("the entry has no keyword"))?;
    if old.text() == keyword {
        return Ok(());
    }
    // Only an 'in' can be live. A padded 'in' keeps its column.
    let live = tree::tokens(&node, Kind::Keyword).nth(1);
    let (place, text) = (range(&old), buffer.text());
    let place = place.start..live.map_or(place.end, |live| range(&live).end);
    let blanks = text[place.end..].len() - text[place.end..].trim_start_matches(' ').len();
    let column = place.len() + blanks;
    let end = place.end + blanks;
    let width = if blanks > 1 { column.max(keyword.len() + 1) } else { keyword.len() + 1 };
    let splice = (place.start..end, format!("{keyword:width$}"));
    buffer.splice(vec![splice]);
    Ok(())
}

pub(super) fn set_type(
    buffer: &mut TextBuffer,
    entry: &Item,
    ty: Option<&str>,
) -> Result<(), Refused> {
    ty.map_or(Ok(()), fragment::ty)?;
    let node = find(buffer, entry)?;
    let name = name_token(&node).ok_or_else(|| Refused::new("the entry has no name"))?;
    let name = range(&name);
    let old = children(&node, Kind::Type).next();
    set_part(buffer, old, name.end, ":", " ", ty)
}

pub(super) fn set_value(
    buffer: &mut TextBuffer,
    entry: &Item,
    value: Option<&str>,
) -> Result<(), Refused> {
    value.map_or(Ok(()), fragment::formula)?;
    let node = find(buffer, entry)?;
    let name = name_token(&node).ok_or_else(|| Refused::new("the entry has no name"))?;
    let ty = children(&node, Kind::Type).next().and_then(|ty| solid_range(&ty));
    let end = ty.map_or(range(&name).end, |ty| ty.end);
    let old = tree::init(&node);
    set_part(buffer, old, end, " =", " ", value)
}

/// Replaces, adds or removes the part after a sign.
pub(super) fn set_part(
    buffer: &mut TextBuffer,
    old: Option<Node>,
    behind: usize,
    sign: &str,
    gap: &str,
    new: Option<&str>,
) -> Result<(), Refused> {
    let text = buffer.text();
    let place = old.as_ref().and_then(solid_range);
    if let Some(place) = &place {
        let is_comment = |token: afp_syntax::Token| {
            tree::is_comment(&token) && (behind..place.end).contains(&range(&token).start)
        };
        let root = buffer.root();
        let mut tokens = root.descendants_with_tokens().filter_map(|each| each.into_token());
        if tokens.any(is_comment) {
            return Err(Refused::new("it contains a comment"));
        }
    }
    let splice = match (place, new.map(str::trim)) {
        (None, None) => return Ok(()),
        (Some(place), Some(new)) if text[place.clone()] == *new => return Ok(()),
        (Some(place), Some(new)) => (place, new.to_owned()),
        (Some(place), None) => (behind..place.end, String::new()),
        (None, Some(new)) => (behind..behind, format!("{sign}{gap}{new}")),
    };
    buffer.splice(vec![splice]);
    Ok(())
}
