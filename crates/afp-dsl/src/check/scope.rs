//! Visible names: in all files, and in one file.

use std::sync::Arc;

use crate::check::PlanHead;
use crate::check::imports::Import;
use crate::check::signature::Signatures;
use crate::check::types::Types;
use crate::files::relative;
use crate::gather::Toolboxes;
use crate::index::Recorder;
use crate::table::Table;
use crate::toolbox::Toolbox;
use afp_syntax::source::{Source, Span};
use rustc_hash::FxHashMap;

/// Everything that a compilation has read.
pub(crate) struct Program<'a> {
    /// All available toolboxes.
    pub toolboxes: &'a Toolboxes,
    /// The used toolboxes; [`crate::graph::ToolboxId`] is an index.
    pub linked: Vec<Arc<Toolbox>>,
    pub files: Vec<FileScope<'a>>,
    /// The plans of all files, file by file.
    pub plans: Vec<PlanHead>,
    /// The sub-plans of each plan, with the places of their uses.
    pub sub_plans: Vec<Vec<(usize, Span)>>,
    /// Ports and outcomes of everything that plans can use.
    pub signatures: Signatures,
    pub record: &'a Recorder,
}

/// A compilation as seen by one file.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub program: &'a Program<'a>,
    pub file: &'a FileScope<'a>,
}

impl Context<'_> {
    /// The file, relative to the main file's folder; `None` for the main file.
    pub fn file_from_main(&self) -> Option<String> {
        let (main, own) = (self.program.files.first()?.path, self.file.path);
        (own != main).then(|| relative(main, own).unwrap_or_else(|| own.to_owned()))
    }
}

/// The visible names of one file.
pub(crate) struct FileScope<'a> {
    /// Its normalised path.
    pub path: &'a str,
    pub text: &'a str,
    /// The file with its index among the sources.
    pub source: (u16, &'a Arc<Source>),
    /// Used toolboxes.
    pub imports: Vec<Import>,
    /// Computations from plan files, as nameless toolboxes: its own first.
    pub computations: Vec<Import>,
    pub types: Types,
    /// Visible tables: its own first.
    pub tables: Vec<Arc<Table>>,
    /// Whether a used file is missing.
    pub incomplete: bool,
    /// Visible plans by name, as indices in [`Program::plans`]: its own first, the first one of
    /// each file.
    pub plans: FxHashMap<String, Vec<usize>>,
    /// The place for a new `use` line.
    pub top: Span,
}
