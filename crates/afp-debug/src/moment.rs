//! A moment of a recorded run, at which another run can begin.

use afp_core::trace::ComponentId;
use afp_dsl::graph::{Component, ElementId, EntryId, EntryKind, Graph, Moment, PlanId};
use afp_dsl::types::{Constant, Type};

use crate::program::{Program, Unit};
use crate::state::State;
use crate::watched::constant;

/// A moment of a run in a graph.
pub struct FoundMoment {
    pub moment: Moment,
    /// The path of the innermost element that starts again.
    pub active: String,
    /// The paths that the moment lacks: values of objects, and of entries that the graph no longer
    /// has.
    pub lost: Vec<String>,
}

/// Finds the active elements and the values of a state in a graph, by name.
///
/// An element that is set aside is active instead of its handler, because nothing can return to it.
///
/// # Errors
/// The plan is not running, or the graph lacks its active element.
pub fn moment(program: &Program, state: &State, graph: &Graph) -> Result<FoundMoment, String> {
    let mut finder = Finder { program, state, graph, active: String::new(), lost: Vec::new() };
    let moment = finder.level(ComponentId(0), graph.main)?;
    if moment.element.is_none() {
        return Err("the plan is not running at this moment: go to another one".to_owned());
    }
    Ok(FoundMoment { moment, active: finder.active, lost: finder.lost })
}

struct Finder<'a> {
    program: &'a Program,
    state: &'a State,
    graph: &'a Graph,
    active: String,
    lost: Vec<String>,
}

impl Finder<'_> {
    /// The moment of a plan, by the component that is this plan.
    fn level(&mut self, id: ComponentId, of: PlanId) -> Result<Moment, String> {
        let entries = self.entries(id, of);
        let program = self.program;
        let mut aside = self.state.suspended().filter_map(|(id, _)| Some((id, program.unit(id)?)));
        let aside = aside.find(|(_, unit)| unit.plan == id);
        let active = || self.state.active(id).and_then(|id| Some((id, program.unit(id)?)));
        let Some((active, unit)) = aside.or_else(active) else {
            return Ok(Moment { entries, ..Moment::default() });
        };
        let (element, component) = self.element(unit, of)?;
        self.active.clone_from(&unit.path);
        let inner = match component {
            Component::SubPlan(plan) => Some(Box::new(self.level(active, plan)?)),
            Component::Actor(_) | Component::Computation(_) => None,
        };
        Ok(Moment { entries, element: Some(element), inner })
    }

    fn element(&self, unit: &Unit, of: PlanId) -> Result<(ElementId, Component), String> {
        let mut elements = (0..).zip(&self.graph.plan(of).elements);
        let found = elements.find(|(_, element)| element.name == unit.name);
        let lacks = || format!("the plan no longer has the active element '{}'", unit.path);
        found.map(|(id, it)| (ElementId(id), it.component)).ok_or_else(lacks)
    }

    /// The known values of a plan's entries. Constants are computed again.
    fn entries(&mut self, id: ComponentId, of: PlanId) -> Vec<(EntryId, Constant)> {
        let mut entries = Vec::new();
        let known = (0..).map(afp_core::trace::TraceEntryId).zip(&self.program.entries);
        for (number, entry) in known.filter(|(_, entry)| entry.plan == id) {
            let Some(value) = self.state.entry(number) else { continue };
            if entry.kind == EntryKind::Const {
                continue;
            }
            let mut here = (0..).zip(&self.graph.plan(of).entries);
            let found = here.find(|(_, it)| it.name == entry.name && it.kind != EntryKind::Const);
            let value = found.and_then(|(id, it)| {
                Some((EntryId(id), fitting(constant(value, &it.ty)?, &it.ty)?))
            });
            match value {
                Some(value) => entries.push(value),
                None => self.lost.push(entry.path.clone()),
            }
        }
        entries
    }
}

/// The value, if it has a type.
fn fitting(value: Constant, ty: &Type) -> Option<Constant> {
    let fits = matches!(
        (&value, ty),
        (Constant::Bool(_), Type::Bool)
            | (Constant::Text(_), Type::Text)
            | (Constant::Int(_), Type::Int | Type::Quantity(_))
            | (Constant::Float(_), Type::Quantity(_))
            | (Constant::Choice(_), Type::Enum(_))
    );
    fits.then_some(value)
}
