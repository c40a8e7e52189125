//! A toolbox file, checked by itself.

use std::fs;
use std::path::PathBuf;

use afp_dsl::toolbox::Toolboxes;
use afp_syntax::ast::Item;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Source;

/// A toolbox file that has been read, with all that is wrong with it.
pub(super) struct ToolboxFile {
    pub path: PathBuf,
    pub toolboxes: Toolboxes,
}

impl ToolboxFile {
    /// Reads a file that declares a toolbox and has no plan; none of another file, and of one that cannot be read.
    pub fn read(name: &str) -> Option<ToolboxFile> {
        let text = fs::read_to_string(name).ok()?;
        let items = afp_syntax::parse(&text, 0, &mut Diagnostics::default()).file().items();
        let declares = items.iter().any(|item| matches!(item, Item::Toolbox(_)));
        let plans = items.iter().any(|item| matches!(item, Item::Plan(_)));
        if !declares || plans {
            return None;
        }
        let mut toolboxes = Toolboxes::default();
        // The crate that implements it says nothing of the file.
        toolboxes.add(Source::new(name, text), "crate");
        Some(ToolboxFile { path: name.into(), toolboxes })
    }
}
