//! What can be done with a plan or scenario, offered above it.

use crate::View;
use afp_syntax::source::Span;

/// Something that can be done.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lens {
    /// The name of the plan or scenario.
    pub span: Span,
    /// What can be done with it.
    pub action: LensAction,
    /// The plan's name, or the scenario's without quotes.
    pub name: String,
}

/// What can be done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LensAction {
    Run,
    /// Running a plan step by step.
    Debug,
    /// Showing the drawing of a plan.
    Draw,
    Test,
}

/// All of it in the order of the text.
pub fn lenses(view: &View) -> Vec<Lens> {
    let mut lenses = Vec::new();
    for plan in view.plans() {
        let Some(name) = &plan.name else { continue };
        for action in [LensAction::Run, LensAction::Debug, LensAction::Draw] {
            lenses.push(Lens { span: name.span, action, name: name.text.clone() });
        }
    }
    let files = view.outline().files.iter().filter(|file| file.file == view.file);
    for scenario in files.flat_map(|file| &file.scenarios) {
        let Some(name) = &scenario.name else { continue };
        let text = name.text.trim_matches('"').to_owned();
        lenses.push(Lens { span: name.span, action: LensAction::Test, name: text });
    }
    lenses.sort_by_key(|lens| lens.span);
    lenses
}
