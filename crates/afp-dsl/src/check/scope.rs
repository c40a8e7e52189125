//! What plans can name: in all files, and in one file.

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
    /// All toolboxes that could be used.
    pub toolboxes: &'a Toolboxes,
    /// Those that some file uses; [`crate::graph::ToolboxId`] is an index into them.
    pub linked: Vec<Arc<Toolbox>>,
    /// What each plan file can name.
    pub files: Vec<FileScope<'a>>,
    /// The plans of all files, file by file.
    pub plans: Vec<PlanHead>,
    /// For each plan the plans that it uses, each with the place where it does.
    pub sub_plans: Vec<Vec<(usize, Span)>>,
    /// The ports and outcomes of all that plans can use.
    pub signatures: Signatures,
    /// What is found out about names.
    pub record: &'a Recorder,
}

/// A compilation as one of its files sees it.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub program: &'a Program<'a>,
    pub file: &'a FileScope<'a>,
}

impl Context<'_> {
    /// The file, seen from the folder of the compiled one; `None` when it is that one.
    pub fn file_from_main(&self) -> Option<String> {
        let (main, own) = (self.program.files.first()?.path, self.file.path);
        (own != main).then(|| relative(main, own).unwrap_or_else(|| own.to_owned()))
    }
}

/// What the plans of one file can name.
pub(crate) struct FileScope<'a> {
    /// Its normalised path.
    pub path: &'a str,
    pub text: &'a str,
    /// The file with its index among the sources.
    pub source: (u16, &'a Arc<Source>),
    /// The toolboxes that it uses.
    pub imports: Vec<Import>,
    /// The computations that plan files declare for it, as toolboxes without a name: its own first.
    pub computations: Vec<Import>,
    /// The types that it can name.
    pub types: Types,
    /// The tables that it can name: its own first.
    pub tables: Vec<Arc<Table>>,
    /// Whether a file that it wants to use is missing.
    pub incomplete: bool,
    /// The plans that it can name, by name and by place in [`Program::plans`]: its own first, of
    /// each file the first one.
    pub plans: FxHashMap<String, Vec<usize>>,
    /// Where a `use` line can be added.
    pub top: Span,
}
