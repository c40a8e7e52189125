//! Edges and the start of a plan.

use super::braces::{self, edge};
use super::buffer::TextBuffer;
use super::list::Page;
use super::tree::{self, children, edges, name_token, range};
use super::{Item, Refused, add, name};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

pub(super) fn connect(
    buffer: &mut TextBuffer,
    from: &Item,
    outcome: &str,
    to: &str,
) -> Result<(), Refused> {
    let root = buffer.root();
    let component = tree::component(&root, from)?;
    if !outcome.is_empty() || tree::nameless(&component).is_none() {
        name::check(outcome)?;
    }
    check_target(&tree::plan(&root, from.plan_name())?, &component, to)?;
    let edge = edge(buffer, &component, outcome);
    if edge.is_none() && tree::nameless(&component).is_some() {
        braces::with_braces(buffer, from)?;
        return connect(buffer, from, outcome, to);
    }
    let target = edge.as_ref().and_then(|edge| children(edge, Kind::Target).next());
    let target = target.and_then(|target| tree::solid_range(&target));
    let shared = edge.as_ref().and_then(|edge| tree::without_outcome(edge, outcome));
    let leaves = shared.filter(|_| target.is_some_and(|target| buffer.text()[target] != *to));
    let Some(edge) = edge.filter(|_| leaves.is_none()) else {
        let text = format!("{} -> {to}", padded(&component, outcome, buffer.text()));
        let all: Vec<_> = edges(&component).collect();
        let page = Page { text: buffer.text(), root };
        let mut splices = vec![page.append(&component, &all, &text)?];
        // Outcomes that shared its edge keep it.
        splices.extend(leaves.map(|place| (place, String::new())));
        buffer.splice(splices);
        return Ok(());
    };
    match children(&edge, Kind::Target).next().and_then(|target| tree::solid_range(&target)) {
        Some(target) if buffer.text()[target.clone()] == *to => {}
        Some(target) => buffer.splice(vec![(target, to.to_owned())]),
        None => {
            let arrow = tree::tokens(&edge, Kind::Arrow).next();
            let end = arrow.or_else(|| name_token(&edge)).map(|token| (range(&token).end, token));
            let Some((end, token)) = end else {
                return Err(Refused::new("the edge is incomplete"));
            };
            let sign = if token.kind() == Kind::Arrow { "" } else { " ->" };
            buffer.splice(vec![(end..end, format!("{sign} {to}"))]);
        }
    }
    Ok(())
}

/// The name of a new edge, padded like those above it.
fn padded(component: &Node, outcome: &str, text: &str) -> String {
    let Some(last) = edges(component).last() else { return outcome.to_owned() };
    let arrow = tree::tokens(&last, Kind::Arrow).next().map(|arrow| range(&arrow).start);
    let start = name_token(&last).map(|name| range(&name).start);
    let width = match (start, arrow) {
        (Some(start), Some(arrow)) if !text[start..arrow].contains('\n') => arrow - start - 1,
        _ => 0,
    };
    let body = tree::solid_range(component).unwrap_or_default();
    let wide = text[body].contains('\n') && edges(component).count() > 1;
    if wide { format!("{outcome:width$}") } else { outcome.to_owned() }
}

fn check_target(plan: &Node, component: &Node, to: &str) -> Result<(), Refused> {
    match to {
        "terminate" | "fail" => Ok(()),
        "ignore" if tree::has_events(component) => Ok(()),
        "resume" if tree::has_events(component) || tree::is_computation(component) => Ok(()),
        "resume" => Err(Refused::new("an element that has ended cannot be resumed")),
        "ignore" => Err(Refused::new("a state cannot lead to 'ignore'")),
        "return" => Ok(()),
        _ if to.strip_prefix("fail ").is_some_and(is_text) => Ok(()),
        _ if to.starts_with("suspend ") => check_suspend(plan, component, &to["suspend ".len()..]),
        _ if children(plan, Kind::Element).any(|element| tree::is_named(&element, to)) => Ok(()),
        _ => Err(Refused::new(format!("there is no element '{to}' in the plan"))),
    }
}

/// Events and computations may suspend; the handler is an element of the plan.
fn check_suspend(plan: &Node, component: &Node, handler: &str) -> Result<(), Refused> {
    if !tree::has_events(component) && !tree::is_computation(component) {
        return Err(Refused::new("an element that has ended cannot be suspended"));
    }
    match children(plan, Kind::Element).any(|element| tree::is_named(&element, handler)) {
        true => Ok(()),
        false => Err(Refused::new(format!("there is no element '{handler}' in the plan"))),
    }
}

/// Whether the text after `fail` is a string literal on one line.
fn is_text(text: &str) -> bool {
    let inner = text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    inner.is_some_and(|inner| {
        let mut letters = inner.chars();
        while let Some(letter) = letters.next() {
            let escape = letter == '\\';
            if matches!(letter, '"' | '\n') || escape && letters.next().is_none() {
                return false;
            }
        }
        true
    })
}

pub(super) fn disconnect(
    buffer: &mut TextBuffer,
    from: &Item,
    outcome: &str,
) -> Result<(), Refused> {
    let root = buffer.root();
    let component = tree::component(&root, from)?;
    let edge = edge(buffer, &component, outcome).ok_or_else(|| {
        Refused::new(format!("'{outcome}' of '{}' is not connected", from.name()))
    })?;
    let page = Page { text: buffer.text(), root };
    let splice = match tree::without_outcome(&edge, outcome) {
        Some(place) => (place, String::new()),
        None => braces::removal(&page, &edge),
    };
    buffer.splice(vec![splice]);
    Ok(())
}

pub(super) fn start(buffer: &mut TextBuffer, plan: &str, to: &str) -> Result<(), Refused> {
    let root = buffer.root();
    tree::element(&root, plan, to)?;
    let node = tree::plan(&root, plan)?;
    let Some(start) = children(&node, Kind::Start).next() else {
        return add::place(buffer, &node, &format!("start {to}"), Kind::Start, None);
    };
    match (name_token(&start), tree::keyword(&start)) {
        (Some(name), _) if name.text() == to => {}
        (Some(name), _) => buffer.splice(vec![(range(&name), to.to_owned())]),
        (None, Some(keyword)) => {
            let end = range(&keyword).end;
            buffer.splice(vec![(end..end, format!(" {to}"))]);
        }
        (None, None) => return Err(Refused::new("the 'start' of the plan is incomplete")),
    }
    Ok(())
}
