//! The templates for a plan, and the candidates for an exit or a port.

use afp_ide::candidates::{Control, of_entry, of_exit, of_port};
use afp_ide::edit::item;
use afp_ide::palette::Offer;
use afp_ide::parts;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Document;
use super::items::{OfItem, no_item};
use crate::answer::{Answer, Failure, ok};
use crate::server::Server;
use crate::standard::completion::snippet;
use crate::workspace::Reads;

/// A search among templates.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Palette {
    text_document: Document,
    #[serde(default)]
    query: String,
}

/// Returns templates and plans, best match first.
pub(crate) fn palette(server: &mut Server, params: Palette) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let offers = afp_ide::palette::palette(&analysis.view(), &params.query);
    let shown = |offer: &Offer| {
        let toolbox = offer.toolbox.as_ref().and_then(|name| analysis.set.toolboxes.get(name));
        let icon = offer.icon.as_ref().zip(toolbox);
        let icon = icon.and_then(|(name, toolbox)| {
            server.workspace.icon(&analysis.set, toolbox, name, &mut Reads::default())
        });
        // A picture outside of a drawing needs its namespace.
        let whole = || {
            let icon = afp_draw::default_icon(offer.kind);
            icon.replacen("<svg ", "<svg xmlns=\"http://www.w3.org/2000/svg\" ", 1)
        };
        let icon = icon.unwrap_or_else(whole);
        json!({
            "template": offer.name,
            "name": offer.instance,
            "kind": offer.kind.keyword(),
            "toolbox": offer.toolbox,
            "icon": icon,
            "help": offer.help,
            "ports": offer.ports,
            "exits": offer.exits,
            "snippet": snippet(&offer.insert),
            "missingUse": offer.missing_use,
        })
    };
    ok(offers.iter().map(shown).collect::<Vec<_>>())
}

/// An exit or port of an element or supervisor, or an entry.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Candidates {
    text_document: Document,
    item: String,
    outcome: Option<String>,
    port: Option<String>,
    /// The text in the field of the value; the default is the value.
    text: Option<String>,
    /// The control to use on the text.
    control: Option<Control>,
}

/// Returns candidates, best first, followed by the others with a reason.
pub(crate) fn candidates(server: &mut Server, params: Candidates) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let view = analysis.view();
    let item = item(&params.item).ok_or_else(|| no_item(&params.item))?;
    let none = |what: &str| Failure::Refused(format!("'{}' has no '{what}'", params.item));
    match (&params.outcome, &params.port) {
        (Some(outcome), None) => {
            let list = of_exit(&view, &item, outcome).ok_or_else(|| none(outcome))?;
            ok(json!({ "candidates": list }))
        }
        (None, port) => {
            let found = match port {
                Some(port) => of_port(&view, &item, port).ok_or_else(|| none(port)),
                None => of_entry(&view, &item).ok_or_else(|| no_item(&params.item)),
            };
            ok(found?.with_text(params.text.as_deref(), params.control.as_ref()))
        }
        _ => Err(Failure::Malformed("name either 'outcome' or 'port'".to_owned())),
    }
}

/// Returns the parts of an item; `null` if it does not exist.
pub(crate) fn parts(server: &mut Server, params: OfItem) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let item = item(&params.item).ok_or_else(|| no_item(&params.item))?;
    let Some(found) = parts::parts(&analysis.view(), &item) else { return ok(Value::Null) };
    let mut answer = json!(found);
    answer["templateAt"] =
        json!(found.template_span.map(|span| server.places(&analysis).range(span).start));
    ok(answer)
}
