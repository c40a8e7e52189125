//! Code lenses above plans and scenarios.

use crate::View;
use afp_syntax::source::Span;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lens {
    /// The name of the plan or scenario.
    pub span: Span,
    pub action: LensAction,
    /// The plan's name, or the scenario's without quotes.
    pub name: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LensAction {
    Run,
    Debug,
    /// Shows the drawing of a plan.
    Draw,
    Test,
}

/// Returns all lenses in source order.
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
