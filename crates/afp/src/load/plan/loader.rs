//! Makes the instance of a plan from its graph, with all of its components.

use std::sync::Arc;

use afp_core::Environment;
use afp_core::rt::{Child, Machine, Tables};
use afp_dsl::graph::{self, Component, Graph, Moment, PlanId};
use afp_dsl::types::Type;
use afp_syntax::source::Span;

use super::element::{ElementSlot, Running};
use super::{EntryInfo, LoadedPlan, WatchSlot};
use crate::load::config::Config;
use crate::load::declared::DeclaredSlot;
use crate::load::error::LoadError;
use crate::load::formula::Formula;
use crate::load::names::PlanNames;
use crate::load::outputs::{Binding, Inputs};
use crate::load::registry::Registry;
use crate::load::row::RowSlot;
use crate::load::tables::LoadedTables;

pub(super) struct Loader<'a, E: ?Sized + 'static> {
    pub(super) graph: &'a Graph,
    pub(super) registry: &'a Registry<E>,
    pub(super) names: PlanNames,
}

impl<E: Environment + ?Sized + 'static> Loader<'_, E> {
    /// Loads a plan and its sub-plans.
    ///
    /// # Errors
    /// The registry lacks a template or object type.
    pub(super) fn plan(
        &self,
        id: PlanId,
        moment: Option<&Moment>,
    ) -> Result<LoadedPlan<E>, LoadError> {
        let plan = self.graph.plan(id);
        let tables = LoadedTables::new(self.graph.rows(id));
        self.check_objects(plan)?;
        let rows = tables.table();
        let inner = |at: usize| {
            let here = moment.filter(|it| it.element.is_some_and(|element| element.index() == at));
            here.and_then(|moment| moment.inner.as_deref())
        };
        let elements = plan.elements.iter().zip(rows.elements).enumerate();
        let supervisors = plan.supervisors.iter();
        let mut loaded = LoadedPlan {
            config: Config::new(&plan.entries, |ty| match ty {
                Type::Object(object) => self.registry.object_cell(&object.toolbox, &object.name),
                _ => None,
            }),
            entries: plan.entries.iter().map(EntryInfo::new).collect(),
            names: self.names.clone(),
            initial: initial(plan),
            carried: Vec::new(),
            begins_at: None,
            elements: elements
                .map(|(at, (element, row))| {
                    self.element(element, &plan.entries, (row.child, inner(at)))
                })
                .collect::<Result<_, _>>()?,
            supervisors: supervisors
                .map(|supervisor| self.supervisor(supervisor, &plan.entries))
                .collect::<Result<_, _>>()?,
            tables,
        };
        if let Some(moment) = moment {
            loaded.begin_at(moment);
        }
        Ok(loaded)
    }

    fn check_objects(&self, plan: &graph::Plan) -> Result<(), LoadError> {
        for entry in &plan.entries {
            let Type::Object(object) = &entry.ty else { continue };
            if self.registry.object_cell(&object.toolbox, &object.name).is_none() {
                let (toolbox, name) = (object.toolbox.clone(), object.name.clone());
                return Err(LoadError::NoObject { toolbox, name });
            }
        }
        Ok(())
    }

    fn element(
        &self,
        element: &graph::Element,
        entries: &[graph::Entry],
        (child, moment): (Child, Option<&Moment>),
    ) -> Result<ElementSlot<E>, LoadError> {
        let component = match element.component {
            Component::Actor(id) => {
                Running::Actor(self.find(id, element.span, Registry::new_actor)?)
            }
            Component::Computation(id) => {
                let template = self.graph.template(id);
                Running::Computation(match (template.table(), &template.cases) {
                    (Some((_, table)), _) => Box::new(RowSlot::new(table)),
                    (_, Some(cases)) => Box::new(DeclaredSlot::new(template, cases)),
                    _ => self.find(id, element.span, Registry::new_computation)?,
                })
            }
            Component::SubPlan(id) => {
                Running::SubPlan { child, machine: Box::new(Machine::new(self.plan(id, moment)?)) }
            }
        };
        Ok(ElementSlot::new(element, entries, component))
    }

    fn supervisor(
        &self,
        supervisor: &graph::Supervisor,
        entries: &[graph::Entry],
    ) -> Result<WatchSlot<E>, LoadError> {
        Ok(WatchSlot {
            inputs: Inputs::new(&supervisor.inputs),
            outputs: Binding::all(&supervisor.outputs, entries),
            injected: None,
            slot: self.find(supervisor.template, supervisor.span, Registry::new_supervisor)?,
            resumable: self.graph.template(supervisor.template).resumable,
        })
    }

    fn find<T>(
        &self,
        id: graph::TemplateId,
        used: Span,
        new: impl FnOnce(&Registry<E>, &str, &str) -> Option<T>,
    ) -> Result<T, LoadError> {
        let toolbox = &self.graph.toolboxes[id.toolbox.index()].name;
        let template = &self.graph.template(id).name;
        new(self.registry, toolbox, template).ok_or_else(|| {
            let missing = self.registry.missing(toolbox, template).map(<[_]>::to_vec);
            let (toolbox, template) = (toolbox.clone(), template.clone());
            match missing {
                Some(missing) => {
                    let place = self.names.place(used);
                    let at = place.map(|it| format!("{}:{}:{}", it.file, it.line, it.column));
                    LoadError::Unsupported {
                        toolbox,
                        template,
                        missing,
                        at: at.unwrap_or_default(),
                    }
                }
                None => LoadError::NoComponent { toolbox, template },
            }
        })
    }
}

/// Initial values in the order of their references.
fn initial(plan: &graph::Plan) -> Arc<[(u16, Formula)]> {
    plan.initial().map(|(id, _, init)| (id.0, Formula::new(init))).collect()
}
