//! AFP's own requests: drawings, changes of meaning, candidates.

pub(crate) mod drawing;
mod drawings;
pub(crate) mod edit;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod items;
pub(crate) mod offers;
pub(crate) mod robot;
mod scene;
mod subscription;

pub use drawings::Drawings;
pub(crate) use subscription::Subscription;

use gen_lsp_types::TextDocumentIdentifier as Document;
use serde::Deserialize;

/// The names of these requests.
pub(crate) const METHODS: &[&str] = &[
    "afp/drawing",
    "afp/edit",
    "afp/place",
    "afp/copy",
    "afp/paste",
    "afp/itemAt",
    "afp/spanOf",
    "afp/uses",
    "afp/palette",
    "afp/candidates",
    "afp/parts",
    "afp/robot",
    "afp/timing",
    "afp/export",
    "afp/explain",
];

/// A request with a document and no other parameters.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct WholeDocument {
    text_document: Document,
}
