//! The requests of the Language Server Protocol.

pub(crate) mod actions;
pub(crate) mod completion;
pub(crate) mod edits;
pub(crate) mod hierarchy;
mod initialize;
pub(crate) mod looks;
pub(crate) mod navigation;
mod project;
pub(crate) mod sync;

pub(crate) use initialize::initialize;

use std::sync::Arc;

use gen_lsp_types::{Position, TextDocumentPositionParams, Uri};

use crate::convert::Places;
use crate::server::Server;
use crate::uri;
use crate::workspace::Analysis;

impl Server {
    /// What a document means; `None` for what is neither plan file nor toolbox, or not there.
    pub(crate) fn analysis(&mut self, uri: &Uri) -> Option<Arc<Analysis>> {
        let path = uri::path(uri);
        if path.ends_with(".toml") || path.ends_with(".layout") {
            return None;
        }
        self.workspace.analysis(&path)
    }

    /// A document and a byte of it.
    pub(crate) fn at(
        &mut self,
        place: &TextDocumentPositionParams,
    ) -> Option<(Arc<Analysis>, u32)> {
        let analysis = self.analysis(&place.text_document.uri)?;
        let offset = self.offset(&analysis, place.position);
        Some((analysis, offset))
    }

    /// The byte of a position in the file of an analysis.
    pub(crate) fn offset(&self, analysis: &Analysis, position: Position) -> u32 {
        self.places(analysis).offset(position)
    }

    /// The lines of the file of an analysis.
    pub(crate) fn places<'a>(&self, analysis: &'a Analysis) -> Places<'a> {
        Places::new(analysis.view().text(), self.workspace.encoding)
    }
}
