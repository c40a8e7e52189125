//! A drawing that a client follows.

use std::sync::Arc;

use afp_draw::Scene;
use afp_syntax::item::Item;
use afp_syntax::source::Span;

use super::scene::Facts;
use crate::workspace::{Analysis, Reads, Workspace};

/// A drawing that a client has and hears the changes of.
#[derive(Debug)]
pub(crate) struct Subscription {
    /// The plan that is wanted: without one, the first of the file.
    pub(super) plan: Option<String>,
    /// The plans of the file, as the client was told.
    pub(super) plans: Vec<String>,
    pub(super) folded: Vec<Item>,
    /// The scene, from which the next one is made.
    pub(super) scene: Arc<Scene>,
    pub(super) facts: Facts,
    pub(super) made_from: MadeFrom,
}

/// What a drawing was made from.
#[derive(Debug)]
pub(super) struct MadeFrom {
    pub(super) analysis: Arc<Analysis>,
    /// Positions and icons.
    pub(super) reads: Reads,
}

impl MadeFrom {
    /// Whether a drawing of a document would be the same again.
    pub(super) fn is_current(&self, workspace: &mut Workspace, path: &str) -> bool {
        let analysis = workspace.analysis(path);
        analysis.is_some_and(|now| Arc::ptr_eq(&now, &self.analysis)) && self.reads.hold(workspace)
    }
}

/// The names of the plans of a file, as they stand in it.
pub(super) fn plans(analysis: &Analysis) -> Vec<String> {
    let own = analysis.compiled.outline.plans.iter().filter(|plan| plan.file() == analysis.file);
    own.map(|plan| plan.item.name().to_owned()).collect()
}

impl Subscription {
    /// Goes on with what has come in place of a plan that is gone: the one that stands where it did and has another name, or
    /// the first one. While the text cannot be read, or its name is another plan's, it may come back.
    pub(super) fn follow(&mut self, analysis: &Analysis) {
        let Some(gone) = &self.plan else { return };
        let now = plans(analysis);
        // Two of one name are told apart by numbers, which say nothing of which was which.
        if now.contains(gone) || now.iter().any(|name| name.contains('#')) {
            return;
        }
        let place = self.plans.iter().position(|name| name == gone);
        let there = place.filter(|_| now.len() == self.plans.len()).and_then(|at| now.get(at));
        let file = Span { file: analysis.file, start: 0, end: u32::MAX };
        let is_readable = || analysis.compiled.diags.syntax_errors_within(file).next().is_none();
        match there {
            Some(name) if !self.plans.contains(name) => self.plan = Some(name.clone()),
            _ if is_readable() => self.plan = None,
            _ => {}
        }
    }
}
