//! The text of a sub-plan's elements in the outer plan.

use super::Call;
use super::data::Data;
use crate::edit::buffer::Splice;
use crate::edit::list::{Page, dedented};
use crate::edit::tree::{
    self, below, children, is_comment, name_of, name_token, own_range, range, target,
};
use crate::edit::{Refused, port, refer};
use afp_syntax::Node;
use afp_syntax::kind::Kind;

/// All elements one after the other, with the comments of the sub-plan before the first.
pub(super) fn elements(call: &Call, data: &Data, text: &str) -> Result<String, Refused> {
    let root = call.inner.ancestors().last().unwrap_or_else(|| call.inner.clone());
    let page = Page { text, root };
    let mut texts = Vec::new();
    for element in children(&call.inner, Kind::Element) {
        let own = own_range(&element);
        let mut part = text[own.clone()].to_owned();
        let mut splices = splices(call, data, &element)?;
        splices.sort_by_key(|(place, _)| place.start);
        for (place, new) in splices.into_iter().rev() {
            part.replace_range(place.start - own.start..place.end - own.start, &new);
        }
        texts.push(dedented(&part, page.indent(own.start)));
    }
    let gap = if texts.iter().any(|text| text.contains('\n')) { "\n\n" } else { "\n" };
    Ok(comments(&call.element) + &texts.join(gap))
}

/// The changes in an element's text.
fn splices(call: &Call, data: &Data, element: &Node) -> Result<Vec<Splice>, Refused> {
    let renamed = |name: &str| {
        let found = call.names.iter().find(|(old, _)| old == name);
        found.map(|(_, new)| new.clone())
    };
    let mut splices: Vec<Splice> = Vec::new();
    let name = name_token(element);
    splices.extend(name.and_then(|token| Some((range(&token), renamed(token.text())?))));
    for edge in below(element, Kind::Edge) {
        let Some(token) = target(&edge) else { continue };
        let event = edge.parent().is_some_and(|parent| tree::has_events(&parent));
        let new = match token.text() {
            "terminate" if event => interrupted(call)?,
            "terminate" => call.ok.clone(),
            "fail" => {
                splices.extend(failed(call, &edge, event)?);
                continue;
            }
            other => {
                let element = call.project.item(call.from, &token);
                let name = element.and_then(|(_, node)| name_of(&node));
                let new = name.and_then(|name| renamed(&name));
                new.unwrap_or_else(|| other.to_owned())
            }
        };
        splices.push((range(&token), new));
    }
    for bind in below(element, Kind::BindSame) {
        let entry = name_token(&bind).and_then(|name| call.project.entry(call.from, &name));
        let new = entry.and_then(|entry| match call.project.is_output(call.from, &bind) {
            true => data.written_to(&entry),
            false => data.read_as(&entry),
        });
        splices.extend(new.and_then(|new| call.project.spelled_out(call.from, &bind, new)));
    }
    for read in below(element, Kind::Args).chain(below(element, Kind::Timing)) {
        for token in port::reads(&read).into_iter().filter(|token| refer::alone(token).is_none()) {
            let entry = call.project.entry(call.from, &token);
            let new = entry.and_then(|entry| data.read_as(&entry));
            splices.extend(new.map(|new| (range(&token), new.to_owned())));
        }
    }
    for token in below(element, Kind::BindOut).filter_map(|bind| target(&bind)) {
        let entry = call.project.entry(call.from, &token);
        let new = entry.and_then(|entry| data.written_to(&entry));
        splices.extend(new.map(|new| (range(&token), new.to_owned())));
    }
    Ok(splices)
}

fn interrupted(call: &Call) -> Result<String, Refused> {
    match call.interrupted.as_deref() {
        None => Err(Refused::new("'Interrupted' of the sub-plan is not connected")),
        Some("terminate") => Err(Refused::new(
            "an event of the sub-plan would end the plan as Interrupted, which it now ends as OK",
        )),
        Some(target) => Ok(target.to_owned()),
    }
}

/// A `fail` of the sub-plan goes to the target of its `Error`, and stays if that is not connected.
fn failed(call: &Call, edge: &Node, event: bool) -> Result<Option<Splice>, Refused> {
    let Some(error) = &call.error else { return Ok(None) };
    if event && error == "terminate" {
        return Err(Refused::new(
            "an event of the sub-plan that fails would end the plan as Interrupted, which it now ends as OK",
        ));
    }
    let place = children(edge, Kind::Target).next().and_then(|to| tree::solid_range(&to));
    Ok(place.map(|place| (place, error.clone())))
}

/// The comments of the sub-plan with its help text, as lines.
fn comments(element: &Node) -> String {
    let own = own_range(element);
    let tokens = element.descendants_with_tokens().filter_map(|each| each.into_token());
    let own = tokens.filter(|token| is_comment(token) && own.contains(&tree::range(token).start));
    let line = |token: afp_syntax::Token| {
        let text = token.text().trim_end();
        let text = if token.kind() == Kind::Doc { &text[1..] } else { text };
        format!("{text}\n")
    };
    own.map(line).collect()
}
