//! A drawing with a subscribed client.

use std::sync::Arc;

use afp_draw::Scene;
use afp_syntax::item::Item;
use afp_syntax::source::Span;
use serde_json::{Value, json};

use super::scene::{Facts, Shown};
use crate::workspace::{Analysis, Reads, Workspace};

/// A drawing that a client has subscribed to.
#[derive(Debug)]
pub(crate) struct Subscription {
    /// The requested plan; the default is the first one.
    pub(super) plan: Option<String>,
    pub(super) folded: Vec<Item>,
    pub(super) drawn: Drawn,
}

/// The last drawing sent.
#[derive(Debug)]
pub(super) struct Drawn {
    /// The scene, the base of the next one.
    pub(super) scene: Arc<Scene>,
    pub(super) facts: Facts,
    pub(super) plan: Option<String>,
    pub(super) plans: Vec<String>,
    /// The texts that it shows.
    pub(super) analysis: Arc<Analysis>,
    /// The positions and icons that it shows.
    pub(super) reads: Reads,
}

impl Drawn {
    pub(super) fn shown(&self) -> Shown<'_> {
        Shown { scene: self.scene.plans.first(), facts: &self.facts }
    }

    /// Adds the version, the plans and the symbols to a message.
    pub(super) fn tell(&self, message: &mut Value, version: Option<i32>) {
        let symbols = self.scene.symbols.iter().map(|it| json!({ "id": it.id, "svg": it.svg }));
        message["version"] = json!(version);
        message["plan"] = json!(self.plan);
        message["plans"] = json!(self.plans);
        message["symbols"] = symbols.collect();
    }

    /// Whether a new drawing of the document would be the same.
    pub(super) fn is_current(&self, workspace: &mut Workspace, path: &str) -> bool {
        let analysis = workspace.analysis(path);
        analysis.is_some_and(|now| Arc::ptr_eq(&now, &self.analysis)) && self.reads.hold(workspace)
    }
}

/// The names of a file's plans, in source order.
pub(super) fn plans(analysis: &Analysis) -> Vec<String> {
    let own = analysis.compiled.outline.plans.iter().filter(|plan| plan.file() == analysis.file);
    own.map(|plan| plan.item.name().to_owned()).collect()
}

impl Subscription {
    /// Continues with the plan that replaced a missing one: a renamed plan at the same place, or
    /// the first one. If the text is unreadable or the name is taken, the plan may return.
    pub(super) fn follow(&mut self, analysis: &Analysis) {
        let Some(gone) = &self.plan else { return };
        let now = plans(analysis);
        // Equal names get numbers, and these do not tell which plan was which.
        if now.contains(gone) || now.iter().any(|name| name.contains('#')) {
            return;
        }
        let place = self.drawn.plans.iter().position(|name| name == gone);
        let there =
            place.filter(|_| now.len() == self.drawn.plans.len()).and_then(|at| now.get(at));
        let file = Span { file: analysis.file, start: 0, end: u32::MAX };
        let is_readable = || analysis.compiled.diags.syntax_errors_within(file).next().is_none();
        match there {
            Some(name) if !self.drawn.plans.contains(name) => self.plan = Some(name.clone()),
            _ if is_readable() => self.plan = None,
            _ => {}
        }
    }
}
