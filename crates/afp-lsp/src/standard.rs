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

use gen_lsp_types::{TextDocumentPositionParams, Uri};

use crate::answer::Failure;
use crate::convert::Places;
use crate::server::Server;
use crate::uri;
use crate::workspace::Analysis;

impl Server {
    /// Returns the analysis of a document.
    ///
    /// # Errors
    /// [`Failure::Nothing`] if it is neither a plan file nor a toolbox, or does not exist.
    pub(crate) fn analysis(&mut self, uri: &Uri) -> Result<Arc<Analysis>, Failure> {
        let path = uri::path(uri);
        let may_be = !path.ends_with(".toml") && !path.ends_with(".layout");
        may_be.then(|| self.workspace.analysis(&path)).flatten().ok_or(Failure::Nothing)
    }

    /// Returns the analysis of a document and a byte offset.
    ///
    /// # Errors
    /// Those of [`Server::analysis`].
    pub(crate) fn at(
        &mut self,
        place: &TextDocumentPositionParams,
    ) -> Result<(Arc<Analysis>, u32), Failure> {
        let analysis = self.analysis(&place.text_document.uri)?;
        let offset = self.places(&analysis).offset(place.position);
        Ok((analysis, offset))
    }

    /// The lines of the file of an analysis.
    pub(crate) fn places<'a>(&self, analysis: &'a Analysis) -> Places<'a> {
        Places::new(analysis.view().text(), self.workspace.encoding)
    }
}
