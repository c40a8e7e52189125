//! Queries of an outline.

use std::sync::Arc;

use super::{Component, ComponentKind, MadeFrom, Outline, Plan, PlanId};
use crate::toolbox::{Template, Toolbox};
use afp_syntax::ast::ElementKind;
use afp_syntax::diagnostics::{Diagnostics, Severity};

impl Outline {
    pub fn plan(&self, id: PlanId) -> &Plan {
        &self.plans[id.index()]
    }

    /// Whether all errors are in scenarios, so that the plans are valid.
    pub(crate) fn excuses(&self, diags: &Diagnostics) -> bool {
        let scenarios = || self.files.iter().flat_map(|file| &file.scenarios);
        let mut errors = diags.iter().filter(|each| each.severity == Severity::Error);
        errors.all(|error| scenarios().any(|scenario| scenario.span.contains(error.span)))
    }
}

impl Plan {
    /// Its file, as in [`Span::file`](afp_syntax::source::Span::file).
    pub fn file(&self) -> u16 {
        self.span.file
    }

    /// Elements and supervisors: global supervisors, then each element with its own ones and its
    /// reactions.
    pub fn components(&self) -> impl Iterator<Item = &Component> {
        let elements = self.elements.iter();
        let elements = elements.flat_map(|one| std::iter::once(one).chain(one.inner()));
        self.supervisors.iter().chain(elements)
    }

    /// Global supervisors, then the local ones, element by element, as in a graph.
    pub fn all_supervisors(&self) -> impl Iterator<Item = &Component> {
        self.supervisors.iter().chain(self.elements.iter().flat_map(|one| &one.supervisors))
    }
}

impl Component {
    /// Its supervisors and reactions.
    pub fn inner(&self) -> impl Iterator<Item = &Component> {
        self.supervisors.iter().chain(&self.reactions)
    }

    /// Its template; `None` for a plan or an unknown template.
    pub fn template(&self) -> Option<&Template> {
        match self.template.as_ref()?.made_from.as_ref()? {
            MadeFrom::Template { toolbox, index } => toolbox.templates.get(*index),
            MadeFrom::Plan(_) => None,
        }
    }

    pub fn toolbox(&self) -> Option<&Arc<Toolbox>> {
        match self.template.as_ref()?.made_from.as_ref()? {
            MadeFrom::Template { toolbox, .. } => Some(toolbox),
            MadeFrom::Plan(_) => None,
        }
    }

    pub fn sub_plan(&self) -> Option<PlanId> {
        match self.template.as_ref()?.made_from.as_ref()? {
            MadeFrom::Template { .. } => None,
            MadeFrom::Plan(plan) => Some(*plan),
        }
    }
}

impl ComponentKind {
    pub(crate) fn of(kind: ElementKind) -> ComponentKind {
        match kind {
            ElementKind::Actor => ComponentKind::Actor,
            ElementKind::Computation => ComponentKind::Computation,
            ElementKind::SubPlan => ComponentKind::SubPlan,
        }
    }

    /// Its keyword in a plan.
    pub fn keyword(self) -> &'static str {
        match self {
            ComponentKind::Actor => "actor",
            ComponentKind::Computation => "computation",
            ComponentKind::SubPlan => "subplan",
            ComponentKind::Supervisor => "supervise",
            ComponentKind::Reactions => "on",
        }
    }
}
