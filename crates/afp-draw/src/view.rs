//! The outline for drawings: ports with their texts, exits with their names.
//!
//! All drawings use it, so that they agree on the contents of an element. It includes all parsed
//! parts of plans with errors.

use std::borrow::Cow;

use super::usage::{Count, PlanUsage, Reaction, times};
use super::{Options, formula};
use crate::layout_file::Position;
use afp_dsl::graph::Target;
use afp_dsl::outline::{
    self, Component, ComponentKind, ElementId, Entry, ExitKind, Outline, Plan, PlanId,
};
use afp_dsl::toolbox::Toolbox;
use afp_dsl::types::text::duration;
use afp_syntax::diagnostics::Severity;
use afp_syntax::item::Item;

/// A plan in its outline, with the options of the drawing.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) outline: &'a Outline,
    pub(super) plan: &'a Plan,
    pub(super) options: &'a Options<'a>,
    pub(super) folded: &'a [Item],
    usage: Option<&'a PlanUsage>,
}

/// An input port and its source.
pub(super) struct Input<'a> {
    pub(super) port: &'a str,
    pub(super) nth: u16,
    /// The text of its binding; empty if it is unbound or incomplete.
    pub(super) text: &'a str,
    /// Whether the plan binds it.
    pub(super) bound: bool,
    /// Whether its source is only an entry.
    pub(super) plain: bool,
    /// Whether a required binding is missing.
    pub(super) missing: bool,
    pub(super) severity: Option<Severity>,
    declared: &'a outline::Input,
}

/// An output port that is bound.
pub(super) struct Output<'a> {
    pub(super) port: &'a str,
    pub(super) nth: u16,
    pub(super) entry: &'a str,
    pub(super) severity: Option<Severity>,
}

/// An exit of an element or a supervisor.
#[derive(Clone, Copy)]
pub(super) struct Exit<'a> {
    pub(super) name: &'a str,
    pub(super) nth: u16,
    pub(super) kind: ExitKind,
    pub(super) to: To<'a>,
    /// How often it was taken, in a drawing by use.
    pub(super) count: Option<u64>,
    pub(super) severity: Option<Severity>,
}

/// The target of an exit: an element, an unknown name, or another target. `fail` has its reason, in
/// quotes, if there is one. `None` is a missing target.
pub(super) type To<'a> = Option<Target<Result<ElementId, &'a str>, &'a str>>;

impl Input<'_> {
    /// The text of its binding, or else its default.
    pub(super) fn value(&self) -> Cow<'_, str> {
        let default = self.declared.default.as_ref().filter(|_| !self.bound);
        match default {
            Some(value) => formula::constant(value, self.declared.ty.as_ref()).into(),
            None => self.text.into(),
        }
    }
}

impl Exit<'_> {
    /// Its name, in a drawing by use with its count.
    pub(super) fn text(&self) -> Cow<'_, str> {
        match self.count {
            None => self.name.into(),
            Some(count) => format!("{}  {}", self.name, times(count)).into(),
        }
    }
}

/// The end of a target.
pub(super) fn to(target: Option<&outline::Target>) -> To<'_> {
    let target = target?;
    let (to, text) = (target.to, target.text.as_str());
    let text = text.strip_prefix("suspend ").unwrap_or(text);
    let is_known = !matches!(to, Target::Element(None) | Target::Suspend(None));
    (is_known || !text.is_empty())
        .then(|| to.map(|id| id.ok_or(text), |()| target.reason().unwrap_or("")))
}

impl<'a> View<'a> {
    /// The plans to draw: the main plan first, then the used plans if wanted, in the order of use.
    pub(super) fn all(outline: &'a Outline, options: &'a Options<'a>) -> Vec<View<'a>> {
        let Some(main) = options.plan.or(outline.main) else { return Vec::new() };
        let mut order = vec![main];
        let mut index = 0;
        while let Some(plan) = order.get(index).filter(|_| options.sub_plans) {
            for element in &outline.plan(*plan).elements {
                if let Some(used) = element.sub_plan().filter(|used| !order.contains(used)) {
                    order.push(used);
                }
            }
            index += 1;
        }
        order.into_iter().map(|plan| View::new(outline, plan, options)).collect()
    }

    pub(super) fn new(outline: &'a Outline, plan: PlanId, options: &'a Options<'a>) -> View<'a> {
        let plan = outline.plan(plan);
        let is_own = |usage: &&PlanUsage| plan.span.contains(usage.plan);
        let usage = options.usage.and_then(|usage| usage.plans.iter().find(is_own));
        View { outline, plan, options, folded: options.folded, usage }
    }

    /// The view with nothing folded.
    pub(super) fn unfolded(self) -> View<'a> {
        View { folded: &[], ..self }
    }

    pub(super) fn name(&self) -> &'a str {
        self.plan.name.as_ref().map_or(self.plan.item.name(), |name| &name.text)
    }

    /// The name of the template or of the sub-plan.
    pub(super) fn template_name(&self, component: &'a Component) -> &'a str {
        let plan = component.sub_plan().and_then(|id| self.outline.plan(id).name.as_ref());
        let known = component.template().map(|template| template.name.as_str());
        let written = component.template.as_ref().map(|template| template.text.as_str());
        known.or(plan.map(|name| name.text.as_str())).or(written).unwrap_or("?")
    }

    /// The given position of an element, or of the start tag under the name `start`.
    pub(super) fn position(&self, item: &Item) -> Option<Position> {
        self.options.positions.get(usize::from(self.plan.span.file))?.get(item)
    }

    /// The item of the start tag's position.
    pub(super) fn start_item(&self) -> Item {
        Item::inner(self.plan.item.name(), "start")
    }

    /// The entries of the plan, if data is shown.
    pub(super) fn entries(&self) -> &'a [Entry] {
        self.shown_of(&self.start_item(), &self.plan.entries)
    }

    pub(super) fn inputs(&self, component: &'a Component) -> Vec<Input<'a>> {
        let inputs = self.shown_of(&component.item, &component.inputs).iter().map(|input| {
            let value = input.binding.as_ref().and_then(|binding| binding.value.as_ref());
            let bound = input.binding.is_some();
            let is_fed = if bound { value.is_some() } else { input.default.is_some() };
            Input {
                port: &input.name,
                nth: input.nth,
                text: value.map_or("", |value| &value.text),
                bound,
                plain: value.is_some_and(|value| value.entry.is_some()),
                missing: !is_fed && (input.required || bound),
                severity: self.severity(input.findings.worst()),
                declared: input,
            }
        });
        inputs.collect()
    }

    /// The bound output ports.
    pub(super) fn outputs(&self, component: &'a Component) -> Vec<Output<'a>> {
        let outputs =
            self.shown_of(&component.item, &component.outputs).iter().filter_map(|output| {
                let value = output.binding.as_ref()?.value.as_ref();
                Some(Output {
                    port: &output.name,
                    nth: output.nth,
                    entry: value.map_or("", |value| &value.text),
                    severity: self.severity(output.findings.worst()),
                })
            });
        outputs.collect()
    }

    /// The states of a declared computation that have a condition, in order, with the condition.
    pub(super) fn conditions(&self, component: &'a Component) -> Vec<(&'a str, String)> {
        let Some(template) = component.template() else { return Vec::new() };
        let cases = self.shown_of(&component.item, template.cases.as_deref().unwrap_or_default());
        let conditional =
            template.outcomes.iter().zip(cases).filter(|(_, case)| !case.when.is_empty());
        let conditions =
            conditional.map(|(state, case)| (&*state.name, formula::condition(case, template)));
        conditions.collect()
    }

    /// The data, or nothing if the options leave it out.
    fn shown_of<'d, T>(&self, item: &Item, data: &'d [T]) -> &'d [T] {
        if self.options.data && !self.is_folded(item) { data } else { &[] }
    }

    /// Whether an element, or the start tag, is folded.
    pub(super) fn is_folded(&self, item: &Item) -> bool {
        self.folded.contains(item)
    }

    /// The marked diagnostic: errors always, the rest on request.
    pub(super) fn severity(&self, worst: Option<Severity>) -> Option<Severity> {
        worst.filter(|severity| self.options.warnings || *severity == Severity::Error)
    }

    /// The exits that are connected or must be.
    pub(super) fn exits(&self, component: &'a Component) -> Vec<Exit<'a>> {
        let counts = self.count(component);
        let reactions = self.reactions(component);
        let exits = component.exits.iter().enumerate().filter_map(|(index, exit)| {
            if exit.edge.is_none() && !exit.required {
                return None;
            }
            let to = to(exit.edge.as_ref().and_then(|edge| edge.target.as_ref()));
            let count = counts.and_then(|counts| match exit.kind {
                ExitKind::State | ExitKind::Event => counts.outcomes.get(index).copied(),
                ExitKind::Error | ExitKind::Missed => Some(counts.special),
            });
            let count = count.or_else(|| self.reacted(reactions?, component, exit));
            // Ignored events are never taken, so a count would be useless.
            let count = count.filter(|_| to != Some(Target::Ignore));
            let severity = self.severity(exit.findings.worst());
            Some(Exit { name: &exit.name, nth: exit.nth, kind: exit.kind, to, count, severity })
        });
        exits.collect()
    }

    /// The global supervisor of reactions; any other component itself.
    pub(super) fn watcher(&self, component: &'a Component) -> &'a Component {
        self.watcher_place(component).map_or(component, |index| &self.plan.supervisors[index])
    }

    fn watcher_place(&self, component: &Component) -> Option<usize> {
        let to = component.item.reacts_to()?;
        self.plan.supervisors.iter().position(|each| name(each) == to)
    }

    /// How often the reactions' edges of the element were taken, in a drawing by use.
    fn reactions(&self, component: &Component) -> Option<&'a [Reaction]> {
        let usage = self.usage?;
        let is_it = |each: &Component| each.item == component.item;
        let mut elements = self.plan.elements.iter();
        let owner = elements.position(|element| element.reactions.iter().any(is_it))?;
        usage.elements.get(owner).map(|count| &count.reactions[..])
    }

    fn reacted(
        &self,
        reactions: &[Reaction],
        component: &Component,
        exit: &outline::Exit,
    ) -> Option<u64> {
        let index = self.watcher_place(component)?;
        let exits = &self.plan.supervisors[index].exits;
        let event = match exit.kind {
            ExitKind::Missed => None,
            _ => Some(u16::try_from(exits.iter().position(|each| each.name == exit.name)?).ok()?),
        };
        let mut edges = reactions.iter();
        let edge = edges.find(|each| (each.supervisor, each.event) == (index, event));
        edge.map(|edge| edge.count)
    }

    /// How often an element or supervisor of the plan was used, in a drawing by use.
    pub(super) fn count(&self, component: &Component) -> Option<&'a Count> {
        let usage = self.usage?;
        let is_it = |each: &Component| each.item == component.item;
        if component.kind == ComponentKind::Supervisor {
            let index = self.plan.all_supervisors().position(is_it)?;
            return usage.supervisors.get(index);
        }
        usage.elements.get(self.plan.elements.iter().position(is_it)?)
    }

    pub(super) fn writes(&self, entry: usize) -> Option<u64> {
        self.usage?.entries.get(entry).copied()
    }

    /// Whether some edge suspends to an element.
    pub(super) fn is_handler(&self, element: &Component) -> bool {
        let of_elements =
            self.plan.elements.iter().flat_map(|each| {
                [each].into_iter().chain(&each.supervisors).chain(&each.reactions)
            });
        let components = self.plan.supervisors.iter().chain(of_elements);
        let mut exits = components.flat_map(|component| &component.exits);
        exits.any(|exit| {
            let target = exit.edge.as_ref().and_then(|edge| edge.target.as_ref());
            let to =
                target.filter(|target| target.suspends()).and_then(|it| it.to.element().copied());
            to.flatten().is_some_and(|id| self.plan.elements[id.index()].item == element.item)
        })
    }

    /// The target of an exit, in the language's words.
    pub(super) fn target_name(&self, to: To<'a>) -> String {
        let element = |id: &Result<ElementId, &'a str>| match id {
            Ok(id) => name(&self.plan.elements[id.index()]),
            Err(text) => *text,
        };
        to.map_or(String::new(), |to| to.text(element).to_string())
    }

    /// The template's toolbox and its icon's name.
    pub(super) fn icon(&self, component: &'a Component) -> Option<(&'a Toolbox, &'a str)> {
        Some((component.toolbox()?, component.template()?.icon.as_deref()?))
    }
}

/// The name of an element or supervisor.
pub(super) fn name(component: &Component) -> &str {
    component.name.as_ref().map_or(component.item.name(), |name| &name.text)
}

pub(super) fn entry_name(entry: &Entry) -> &str {
    entry.name.as_ref().map_or(entry.item.name(), |name| &name.text)
}

pub(super) fn entry_type(entry: &Entry) -> String {
    let written = || entry.written_type.as_ref().map(|name| name.text.clone());
    entry.ty.as_ref().map(ToString::to_string).or_else(written).unwrap_or_default()
}

/// The polling of a supervisor, for its tooltip.
pub(super) fn timing(component: &Component) -> String {
    component.times.map_or(String::new(), |times| {
        let times = [times.timing.period, times.timing.deadline];
        let [every, deadline] = times.map(|time| duration(time.as_nanos()));
        format!("every {every}, deadline {deadline}")
    })
}
