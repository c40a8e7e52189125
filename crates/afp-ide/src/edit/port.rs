//! The head of an element or supervisor: template, bindings, times.

use super::buffer::{Splice, TextBuffer};
use super::list::Page;
use super::tree::{self, binds, children, name_of, name_token, range, solid_range};
use super::{Binding, Item, Refused, fragment, name};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

pub(super) fn bind(
    buffer: &mut TextBuffer,
    component: &Item,
    port: &str,
    to: &Binding,
) -> Result<(), Refused> {
    name::check(port)?;
    let root = buffer.root();
    let node = tree::component(&root, component)?;
    let (sign, value) = match to {
        Binding::In(formula) => {
            fragment::formula(formula)?;
            ("=", formula.trim())
        }
        Binding::Out(entry) => {
            check_entry(&tree::plan(&root, component.plan_name())?, entry)?;
            ("=>", entry.as_str())
        }
    };
    let bound = binds(&node).into_iter().find(|bind| tree::is_named(bind, port));
    let splice = match bound {
        Some(bound) => rebound(buffer.text(), &bound, sign, value)?,
        None => new_binding(buffer, &node, &format!("{port} {sign} {value}"))?,
    };
    buffer.splice(splice.into_iter().collect());
    Ok(())
}

fn check_entry(plan: &Node, entry: &str) -> Result<(), Refused> {
    if children(plan, Kind::Entry).any(|node| tree::is_named(&node, entry)) {
        return Ok(());
    }
    Err(Refused::new(format!("there is no entry '{entry}' in the plan")))
}

/// The formula or the target of a binding.
pub(super) fn value(bind: &Node) -> Option<Node> {
    bind.children().find(|child| child.kind() != Kind::Error)
}

fn rebound(text: &str, bind: &Node, sign: &str, new: &str) -> Result<Option<Splice>, Refused> {
    if bind.kind() == Kind::BindSame {
        let name = name_token(bind).filter(|name| name.text() != new);
        return Ok(name.map(|name| (range(&name), format!("{} {sign} {new}", name.text()))));
    }
    let whole = "the binding is incomplete";
    let is_sign = |token: &Token| matches!(token.kind(), Kind::Equal | Kind::FatArrow);
    let tokens = bind.children_with_tokens().filter_map(|each| each.into_token());
    let old_sign = tokens.into_iter().find(is_sign).ok_or_else(|| Refused::new(whole))?;
    let value = value(bind).and_then(|value| Some((solid_range(&value)?, value)));
    let Some((place, value)) = value else {
        let end = range(&old_sign).end;
        return Ok(Some((range(&old_sign).start..end, format!("{sign} {new}"))));
    };
    if tree::holds_comment(&value) {
        return Err(Refused::new("the formula contains a comment"));
    }
    if old_sign.text() != sign {
        let old = range(&old_sign).start..place.end;
        return Ok(Some((old, format!("{sign} {new}"))));
    }
    Ok((text[place.clone()] != *new).then(|| (place, new.to_owned())))
}

fn new_binding(buffer: &TextBuffer, node: &Node, text: &str) -> Result<Option<Splice>, Refused> {
    let page = Page { text: buffer.text(), root: buffer.root() };
    if let Some(args) = children(node, Kind::Args).next() {
        return page.append(&args, &binds(node), text).map(Some);
    }
    let end = head_end(node)?;
    Ok(Some((end..end, format!("({text})"))))
}

/// The place after the template's name.
fn head_end(node: &Node) -> Result<usize, Refused> {
    let reference = children(node, Kind::Ref).next().and_then(|node| solid_range(&node));
    let refused = || Refused::new("it has no template yet");
    reference.map(|range| range.end).ok_or_else(refused)
}

/// Removes the binding of a port, and empty parentheses.
pub(super) fn unbind(buffer: &mut TextBuffer, component: &Item, port: &str) -> Result<(), Refused> {
    let root = buffer.root();
    let node = tree::component(&root, component)?;
    let bound = binds(&node).into_iter().find(|bind| tree::is_named(bind, port));
    let bound = bound
        .ok_or_else(|| Refused::new(format!("'{port}' of '{}' is not bound", component.name())))?;
    let splice = removal(buffer, &node, &bound);
    buffer.splice(vec![splice]);
    Ok(())
}

pub(super) fn removal(buffer: &TextBuffer, component: &Node, bind: &Node) -> Splice {
    let page = Page { text: buffer.text(), root: buffer.root() };
    if let Some(args) =
        children(component, Kind::Args).next().filter(|_| binds(component).len() == 1)
        && let (Some(all), Some(one)) = (solid_range(&args), solid_range(bind))
        && buffer.text()[all.start + 1..one.start].trim().is_empty()
        && buffer.text()[one.end..all.end].trim_end_matches(')').trim().is_empty()
    {
        return (all, String::new());
    }
    page.remove(bind)
}

pub(super) fn set_template(
    buffer: &mut TextBuffer,
    component: &Item,
    template: &str,
) -> Result<(), Refused> {
    fragment::reference(template)?;
    let node = tree::component(&buffer.root(), component)?;
    let splice = match children(&node, Kind::Ref).next().and_then(|node| solid_range(&node)) {
        Some(old) if buffer.text()[old.clone()] == *template.trim() => return Ok(()),
        Some(old) => (old, template.trim().to_owned()),
        None => {
            let colon = tree::tokens(&node, Kind::Colon).next();
            let name = name_token(&node).ok_or_else(|| Refused::new("it has no name"))?;
            let end = range(colon.as_ref().unwrap_or(&name)).end;
            let sign = if colon.is_some() { "" } else { ":" };
            (end..end, format!("{sign} {}", template.trim()))
        }
    };
    buffer.splice(vec![splice]);
    Ok(())
}

pub(super) fn set_timing(
    buffer: &mut TextBuffer,
    supervisor: &Item,
    keyword: &str,
    value: Option<&str>,
) -> Result<(), Refused> {
    if !matches!(keyword, "every" | "deadline") {
        return Err(Refused::new(format!("a supervisor has no '{keyword}'")));
    }
    value.map_or(Ok(()), fragment::time)?;
    let node = tree::find(&buffer.root(), supervisor)?;
    if node.kind() != Kind::Guard {
        return Err(Refused::new(format!("'{}' is not a supervisor", supervisor.name())));
    }
    let timings: Vec<_> = children(&node, Kind::Timing).collect();
    let is_meant = |timing: &&Node| tree::keyword(timing).is_some_and(|k| k.text() == keyword);
    let old = timings.iter().find(is_meant).and_then(solid_range);
    let splice = match (old, value.map(str::trim)) {
        (None, None) => return Ok(()),
        (Some(old), Some(value)) => {
            let text = format!("{keyword} {value}");
            if buffer.text()[old.clone()] == text {
                return Ok(());
            }
            (old, text)
        }
        (Some(old), None) => {
            let before = buffer.text()[..old.start].trim_end_matches([' ', '\t']).len();
            (before..old.end, String::new())
        }
        (None, Some(value)) => {
            let args = children(&node, Kind::Args).next().and_then(|args| solid_range(&args));
            let timing = timings.last().and_then(solid_range);
            // 'every' comes before 'deadline'.
            let first = timings.first().and_then(solid_range).filter(|_| keyword == "every");
            match first {
                Some(first) => (first.start..first.start, format!("{keyword} {value} ")),
                None => {
                    let end = timing.or(args).map(|range| range.end);
                    let end = end.map_or_else(|| head_end(&node), Ok)?;
                    (end..end, format!(" {keyword} {value}"))
                }
            }
        }
    };
    buffer.splice(vec![splice]);
    Ok(())
}

/// The bindings and times of a component and its supervisors.
pub(super) fn data_of(component: &Node) -> impl Iterator<Item = Node> {
    let components =
        tree::below(component, Kind::Element).chain(tree::below(component, Kind::Guard));
    let bound = components.flat_map(|component| binds(&component));
    bound.chain(tree::below(component, Kind::Timing))
}

/// The names of the entries that a formula reads.
pub(super) fn reads(formula: &Node) -> Vec<Token> {
    let references = tree::below(formula, Kind::Ref);
    references.filter_map(|reference| tree::single(&reference)).collect()
}

pub(super) fn port_of(bind: &Node) -> String {
    name_of(bind).unwrap_or_default()
}
