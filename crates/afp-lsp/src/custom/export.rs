//! What is known of time, and pictures of plans.

use afp_draw::{Options, Theme};
use afp_dsl::toolbox::Toolbox;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Document;
use crate::answer::{Answer, Failure, ok};
use crate::server::Server;

/// A document.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Timing {
    text_document: Document,
}

/// The bounds of the first plan and of all that it uses, as `afpc check --timing --json` has them; while there are
/// errors, of what is without.
pub(crate) fn timing(server: &mut Server, params: Timing) -> Answer {
    let Some(analysis) = server.analysis(&params.text_document.uri) else { return Ok(Value::Null) };
    ok(analysis.compiled.timing().map(|timing| timing.json()))
}

/// A picture of a plan.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Export {
    text_document: Document,
    format: String,
    /// Without one, that of the reader's system.
    #[serde(default)]
    theme: Colours,
}

/// On what a picture stands.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
enum Colours {
    #[default]
    Auto,
    Light,
    Dark,
}

/// The first plan of a document as a picture or for another program; as `css` the style sheet of what `afp/drawing`
/// answers.
pub(crate) fn export(server: &mut Server, params: Export) -> Answer {
    let Some(analysis) = server.analysis(&params.text_document.uri) else { return Ok(Value::Null) };
    let icons = |toolbox: &Toolbox, name: &str| server.workspace.icon(&analysis.set, toolbox, name);
    let positions = server.workspace.positions(&analysis);
    let theme = match params.theme {
        Colours::Auto => Theme::Auto,
        Colours::Light => Theme::Light,
        Colours::Dark => Theme::Dark,
    };
    let options = Options {
        sources: Some(&analysis.compiled.sources),
        icons: Some(&icons),
        positions: &positions,
        theme,
        ..Options::default()
    };
    let outline = &analysis.compiled.outline;
    let text = match params.format.as_str() {
        "svg" => afp_draw::svg(outline, &options),
        "css" => afp_draw::sheet(theme, false),
        "dot" => afp_draw::dot(outline, &options),
        "json" => afp_draw::json(outline, &options),
        "scxml" => {
            let graph = analysis.compiled.graph.as_ref();
            let graph = graph.ok_or_else(|| Failure::Refused("the plan has errors".to_owned()))?;
            afp_draw::scxml(graph, &options)
        }
        other => {
            let known = "write 'svg', 'css', 'dot', 'json' or 'scxml'; 'afpc graph' makes pixels";
            return Err(Failure::Refused(format!("there is no format '{other}': {known}")));
        }
    };
    ok(json!({ "text": text }))
}
