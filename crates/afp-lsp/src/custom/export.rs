//! Timing bounds, and pictures of plans.

use std::cell::RefCell;

use afp_draw::{Options, Theme};
use afp_dsl::toolbox::Toolbox;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use serde_json::json;

use super::drawing::find;
use super::{Document, WholeDocument};
use crate::answer::{Answer, Failure, ok};
use crate::server::Server;
use crate::workspace::Reads;

/// Returns the bounds of the first plan and its sub-plans, like `afpc check --timing --json`. If
/// the file has errors, the bounds cover the valid part.
pub(crate) fn timing(server: &mut Server, params: WholeDocument) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    ok(analysis.compiled.timing().map(|timing| timing.json()))
}

/// A request for a picture of a plan; the default is the first one.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Export {
    text_document: Document,
    plan: Option<String>,
    format: String,
    /// Default: the colour scheme of the reader's system.
    #[serde(default)]
    theme: Colours,
}

/// The background of a picture.
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "camelCase")]
enum Colours {
    #[default]
    Auto,
    Light,
    Dark,
}

/// Returns a plan as a picture or for another program. The format `css` returns the style sheet of
/// `afp/drawing`.
pub(crate) fn export(server: &mut Server, params: Export) -> Answer {
    let analysis = server.analysis(&params.text_document.uri)?;
    let reads = RefCell::new(Reads::default());
    let icons = |toolbox: &Toolbox, name: &str| {
        server.workspace.icon(&analysis.set, toolbox, name, &mut reads.borrow_mut())
    };
    let positions = server.workspace.positions(&analysis, &mut Reads::default());
    let theme = match params.theme {
        Colours::Auto => Theme::Auto,
        Colours::Light => Theme::Light,
        Colours::Dark => Theme::Dark,
    };
    let outline = &analysis.compiled.outline;
    let plan = params.plan.as_deref();
    let options = Options {
        plan: match plan {
            Some(_) => find(outline, analysis.file, plan)?,
            None => None,
        },
        icons: Some(&icons),
        positions: &positions,
        theme,
        ..Options::default()
    };
    let text = match params.format.as_str() {
        "svg" => afp_draw::svg(outline, &options),
        "png" => {
            // A bitmap cannot adapt to the reader's colour scheme.
            let theme = if theme == Theme::Auto { Theme::Light } else { theme };
            let svg = afp_draw::svg(outline, &Options { theme, ..options });
            let bytes = server.workspace.host.png(&svg).map_err(Failure::Refused)?;
            return ok(json!({ "base64": STANDARD.encode(bytes) }));
        }
        "css" => afp_draw::sheet(theme, false),
        "dot" => afp_draw::dot(outline, &options),
        "json" => afp_draw::json(outline, &options),
        "scxml" => {
            let graph = analysis.compiled.graph.as_ref();
            let graph = graph.ok_or_else(|| Failure::Refused("the plan has errors".to_owned()))?;
            afp_draw::scxml(graph, Some(&analysis.compiled.sources), options.data)
        }
        other => {
            let known = "write 'svg', 'png', 'css', 'dot', 'json' or 'scxml'";
            return Err(Failure::Refused(format!("there is no format '{other}': {known}")));
        }
    };
    ok(json!({ "text": text }))
}
