//! A toolbox file, checked by itself.

use std::path::PathBuf;

use afp_dsl::Toolboxes;
use afp_syntax::ast::Item;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Source;

use crate::plan_file::PlanText;

pub(super) struct ToolboxFile {
    pub path: PathBuf,
    pub toolboxes: Toolboxes,
}

impl ToolboxFile {
    /// Checks a file that declares a toolbox and has no plan; returns `None` for other files.
    pub fn of(PlanText { path, text, plan }: &PlanText<'_>) -> Option<ToolboxFile> {
        // Most files are plans, which need not be read for this.
        if !text.contains("toolbox") {
            return None;
        }
        let items = afp_syntax::parse(text, 0, &mut Diagnostics::default()).file().items();
        let declares = items.iter().any(|item| matches!(item, Item::Toolbox(_)));
        let plans = items.iter().any(|item| matches!(item, Item::Plan(_)));
        if !declares || plans || plan.is_some() {
            return None;
        }
        let mut toolboxes = Toolboxes::default();
        // The implementing crate does not matter for the file's check.
        toolboxes.add(Source::new(path.display().to_string(), text), "crate");
        Some(ToolboxFile { path: path.clone(), toolboxes })
    }
}
