//! A plan as a plain graph of nodes and edges, for searches.
//!
//! In addition to the elements there are four nodes: "anywhere", which stands for all actors and
//! sub-plans and is the origin of global events, the two endings, and `fail`. An event that some
//! element replaces (`on`) has its own node, for the other elements. Edges to `ignore`, `resume`
//! and `return` are omitted, since the flow stays or is where it was before.

mod aside;
mod counter;

use std::cell::OnceCell;
use std::collections::BTreeSet;

use crate::flow::{FAILED, INTERRUPTED, Model, OK, Summary};
use crate::graph::{
    Component, Element, ElementId, Formula, Output, Plan, Supervisor, SupervisorId, Target,
};
use crate::toolbox::Template;
use crate::types::Constant;
use afp_syntax::source::Span;

pub(crate) use aside::Aside;
pub(crate) use counter::{Counter, Counters};

pub(crate) type Node = usize;

/// The cause of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cause {
    State(ElementId, u16),
    Error(ElementId),
    Event(SupervisorId, u16),
    Miss(SupervisorId),
    /// An element's own reaction to an event or missed deadline of a global supervisor.
    On(ElementId, SupervisorId, Option<u16>),
    /// An actor or sub-plan is active, so global supervisors are polled.
    Active(ElementId),
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub cause: Cause,
    pub from: Node,
    pub to: Node,
    /// Whether it can be taken: a sub-plan's ending may be impossible.
    pub possible: bool,
    /// Whether the active element is set aside.
    pub suspends: bool,
}

pub(crate) struct View<'a> {
    pub plan: &'a Plan,
    pub model: &'a Model<'a>,
    /// All edges, grouped by origin.
    pub edges: Vec<Edge>,
    /// Reachable nodes, by node.
    pub reached: Vec<bool>,
    /// Events, or missed deadlines, that some element replaces.
    replaced: Vec<(SupervisorId, Option<u16>)>,
    /// The edges to `return`, with their origins.
    returns: Vec<(Cause, Node)>,
    /// The reachable elements that `suspend` names.
    pub handlers: BTreeSet<Node>,
    /// The elements that can be set aside, each with its edge.
    pub asides: Vec<Aside>,
    /// Edges to `return`, to each element that may continue there.
    pub back: Vec<Edge>,
    summaries: &'a [Option<Summary>],
    first: Vec<u32>,
    /// The counters of the plan, computed on demand.
    pub counters: OnceCell<Counters>,
}

impl<'a> View<'a> {
    /// The view of a plan; `summaries` has those of its sub-plans, as far as known.
    pub fn new(model: &'a Model<'a>, plan: &'a Plan, summaries: &'a [Option<Summary>]) -> View<'a> {
        let replaced = replaced(plan);
        let count = plan.elements.len() + 4 + replaced.len();
        let mut view = View {
            plan,
            model,
            edges: Vec::new(),
            reached: vec![false; count],
            replaced,
            returns: Vec::new(),
            handlers: BTreeSet::new(),
            asides: Vec::new(),
            back: Vec::new(),
            summaries,
            first: Vec::with_capacity(count + 1),
            counters: OnceCell::new(),
        };
        for (index, element) in plan.elements.iter().enumerate() {
            view.first.push(view.edges.len() as u32);
            view.add_element(index, element);
        }
        view.first.push(view.edges.len() as u32);
        for index in 0..plan.globals {
            view.add_supervisor(view.anywhere(), SupervisorId(index));
        }
        view.first.resize(view.kept_by_some(0) + 1, view.edges.len() as u32);
        for at in 0..view.replaced.len() {
            let (id, event) = view.replaced[at];
            view.add_outcome(view.kept_by_some(at), id, event);
            view.first.push(view.edges.len() as u32);
        }
        view.reach();
        let suspends = view.edges.iter().filter(|edge| edge.suspends && view.reached[edge.from]);
        view.handlers = suspends.map(|edge| edge.to).collect();
        view.asides = aside::asides(&view);
        view.back = aside::back(&view);
        view
    }

    fn add_element(&mut self, node: Node, element: &'a Element) {
        let Ok(id) = u16::try_from(node).map(ElementId) else { return };
        for (state, target) in element.states.iter().enumerate() {
            let possible = self.summary(element).is_none_or(|inner| inner.ends[state]);
            if let Some(target) = target {
                self.add(Cause::State(id, state as u16), node, *target, OK, possible);
            }
        }
        if let Some(target) = element.on_error {
            self.add(Cause::Error(id), node, target, OK, true);
        }
        for supervisor in &element.supervisors {
            self.add_supervisor(node, *supervisor);
        }
        if element.takes_time() {
            self.activate(node, self.anywhere(), id);
            for at in 0..self.replaced.len() {
                let (supervisor, event) = self.replaced[at];
                let table = element.reactions_to(supervisor);
                match table.and_then(|table| table.target(event)) {
                    Some(target) => {
                        let cause = Cause::On(id, supervisor, event);
                        self.add(cause, node, target, INTERRUPTED, true);
                    }
                    None => self.activate(node, self.kept_by_some(at), id),
                }
            }
        }
    }

    fn activate(&mut self, from: Node, to: Node, id: ElementId) {
        let cause = Cause::Active(id);
        self.edges.push(Edge { cause, from, to, possible: true, suspends: false });
    }

    fn add_supervisor(&mut self, from: Node, id: SupervisorId) {
        let events = 0..self.plan.supervisors[id.index()].events.len();
        let events = events.map(|event| Some(event as u16)).chain([None]);
        for event in events {
            if !self.replaced.contains(&(id, event)) {
                self.add_outcome(from, id, event);
            }
        }
    }

    /// Adds the edge of an event or missed deadline.
    fn add_outcome(&mut self, from: Node, id: SupervisorId, event: Option<u16>) {
        let supervisor = &self.plan.supervisors[id.index()];
        let (cause, target) = match event {
            Some(event) => {
                let target = supervisor.events.get(usize::from(event)).copied();
                (Cause::Event(id, event), target)
            }
            None => (Cause::Miss(id), supervisor.on_miss),
        };
        if let Some(target) = target {
            self.add(cause, from, target, INTERRUPTED, true);
        }
    }

    fn add(&mut self, cause: Cause, from: Node, target: Target, ending: usize, possible: bool) {
        let to = match target {
            Target::Element(id) | Target::Suspend(id) => id.index(),
            Target::Terminate => self.end(ending),
            Target::Fail(_) => self.end(FAILED),
            Target::Return if possible => return self.returns.push((cause, from)),
            Target::Ignore | Target::Resume | Target::Return => return,
        };
        let suspends = matches!(target, Target::Suspend(_));
        self.edges.push(Edge { cause, from, to, possible, suspends });
    }

    fn reach(&mut self) {
        let mut open = vec![self.start()];
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut self.reached[node], true) {
                open.extend(self.from(node).iter().map(|edge| edge.to));
            }
        }
    }

    pub fn nodes(&self) -> usize {
        self.reached.len()
    }

    pub fn start(&self) -> Node {
        self.plan.start.index()
    }

    pub fn anywhere(&self) -> Node {
        self.plan.elements.len()
    }

    /// The node of a replaced event, for elements that keep the supervisor's edge.
    fn kept_by_some(&self, at: usize) -> Node {
        self.plan.elements.len() + 4 + at
    }

    /// Whether a node stands for several actors and sub-plans, so that global edges begin there.
    pub fn is_shared(&self, node: Node) -> bool {
        node == self.anywhere() || node >= self.kept_by_some(0)
    }

    /// The global edges that are effective while an element is active.
    pub fn of_globals(&self, node: Node) -> impl Iterator<Item = &Edge> {
        let own = self.from(node).iter();
        own.flat_map(move |edge| match edge.cause {
            Cause::On(..) => std::slice::from_ref(edge),
            Cause::Active(_) => self.from(edge.to),
            _ => &[],
        })
    }

    /// All global edges that are taken from somewhere.
    pub fn of_all_globals(&self) -> impl Iterator<Item = &Edge> {
        let reached = self.edges.iter().filter(|edge| self.reached[edge.from]);
        reached.filter(|edge| self.is_shared(edge.from) || matches!(edge.cause, Cause::On(..)))
    }

    /// The node of an ending: [`OK`], [`INTERRUPTED`] or [`FAILED`].
    pub fn end(&self, ending: usize) -> Node {
        self.plan.elements.len() + 1 + ending
    }

    pub fn from(&self, node: Node) -> &[Edge] {
        &self.edges[self.range(node)]
    }

    pub fn range(&self, node: Node) -> std::ops::Range<usize> {
        self.first[node] as usize..self.first[node + 1] as usize
    }

    /// Whether a node is a computation with an edge to `resume`.
    pub fn resumes(&self, node: Node) -> bool {
        self.has_edge_to(node, Target::Resume)
    }

    /// Whether a state or `Error` of an element leads to a target.
    pub fn has_edge_to(&self, node: Node, target: Target) -> bool {
        self.element(node).is_some_and(|element| {
            element.states.iter().flatten().chain(&element.on_error).any(|to| *to == target)
        })
    }

    /// The nodes at which a flow through a node rests: elements that take time, and endings.
    pub fn rests(&self, node: Node) -> BTreeSet<Node> {
        let (mut open, mut seen, mut rests) = (vec![node], BTreeSet::new(), BTreeSet::new());
        while let Some(node) = open.pop() {
            if self.element(node).is_none_or(Element::takes_time) {
                rests.insert(node);
            } else if seen.insert(node) {
                let edges = self.from(node).iter().filter(|edge| edge.possible);
                open.extend(edges.map(|edge| edge.to));
            }
        }
        rests
    }

    /// The element of a node, if it has one.
    pub fn element(&self, node: Node) -> Option<&'a Element> {
        self.plan.elements.get(node)
    }

    pub fn supervisor(&self, id: SupervisorId) -> &'a Supervisor {
        &self.plan.supervisors[id.index()]
    }

    pub fn template(&self, supervisor: &Supervisor) -> &'a Template {
        self.model.template(supervisor.template)
    }

    /// The supervisors that are ever started: global ones, and those of reached elements.
    pub fn supervisors(&self) -> impl Iterator<Item = &'a Supervisor> {
        self.numbered_supervisors().map(|(_, supervisor)| supervisor)
    }

    pub fn numbered_supervisors(&self) -> impl Iterator<Item = (SupervisorId, &'a Supervisor)> {
        let all = (0..).map(SupervisorId).zip(&self.plan.supervisors);
        all.filter(|(_, supervisor)| match supervisor.owner {
            Some(owner) => self.reached[owner.index()],
            None => true,
        })
    }

    /// Reachable elements with their nodes.
    pub fn elements(&self) -> impl Iterator<Item = (Node, &'a Element)> {
        let plan = self.plan;
        plan.elements.iter().enumerate().filter(|(node, _)| self.reached[*node])
    }

    pub fn constant(&self, formula: &Formula) -> Option<Constant> {
        self.plan.constant(formula)
    }

    pub fn summary(&self, element: &Element) -> Option<&'a Summary> {
        match element.component {
            Component::SubPlan(id) => self.summaries.get(id.index())?.as_ref(),
            _ => None,
        }
    }

    /// Whether an event is momentary.
    pub fn is_once(&self, id: SupervisorId, event: u16) -> bool {
        let template = self.template(self.supervisor(id));
        template.outcomes.get(usize::from(event)).is_some_and(|event| event.once)
    }

    /// The outputs that an edge may commit.
    pub fn may_write(&self, cause: Cause) -> &'a [Output] {
        match cause {
            Cause::State(id, _) => &self.plan.elements[id.index()].outputs,
            Cause::Event(id, _) | Cause::On(_, id, Some(_)) => &self.supervisor(id).outputs,
            Cause::Error(_) | Cause::Miss(_) | Cause::On(..) | Cause::Active(_) => &[],
        }
    }

    /// The outputs that an edge certainly commits.
    pub fn writes(&self, cause: Cause) -> impl Iterator<Item = &'a Output> {
        let carried = match cause {
            Cause::State(id, state) => self.carried(&self.plan.elements[id.index()], state),
            Cause::Event(id, event) | Cause::On(_, id, Some(event)) => {
                let template = self.template(self.supervisor(id));
                template.outputs.iter().map(|port| port.on.contains(&event)).collect()
            }
            Cause::Error(_) | Cause::Miss(_) | Cause::On(..) | Cause::Active(_) => Vec::new(),
        };
        let is_carried =
            move |output: &&Output| carried.get(usize::from(output.port)).copied().unwrap_or(true);
        self.may_write(cause).iter().filter(is_carried)
    }

    /// The output ports of an element that certainly have a value in a state.
    fn carried(&self, element: &Element, state: u16) -> Vec<bool> {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                let ports = &self.model.template(id).outputs;
                ports.iter().map(|port| port.on.contains(&state)).collect()
            }
            Component::SubPlan(_) => self.summary(element).map_or(Vec::new(), |inner| {
                inner.unset[usize::from(state)].iter().map(Option::is_none).collect()
            }),
        }
    }

    /// The source of an edge.
    pub fn span(&self, cause: Cause) -> Span {
        let (edges, own) = match cause {
            Cause::State(id, _) | Cause::Error(id) | Cause::Active(id) => {
                let element = &self.plan.elements[id.index()];
                (&element.edges, element.span)
            }
            Cause::Event(id, _) | Cause::Miss(id) => {
                let supervisor = self.supervisor(id);
                (&supervisor.edges, supervisor.span)
            }
            Cause::On(element, id, _) => {
                let element = &self.plan.elements[element.index()];
                let Some(table) = element.reactions_to(id) else { return element.span };
                (&table.edges, table.span)
            }
        };
        let written = match cause {
            Cause::State(_, index) | Cause::Event(_, index) | Cause::On(_, _, Some(index)) => {
                edges.outcomes.get(usize::from(index)).copied().flatten()
            }
            Cause::Error(_) | Cause::Miss(_) | Cause::On(_, _, None) => edges.extra,
            Cause::Active(_) => None,
        };
        written.unwrap_or(own)
    }

    /// The cause of an edge, as a path such as `searchFirstWall.touch.TouchSensorPressed`.
    pub fn label(&self, cause: Cause) -> String {
        match cause {
            Cause::State(id, state) => {
                let element = &self.plan.elements[id.index()];
                format!("{}.{}", element.name, self.state_name(element, state))
            }
            Cause::Error(id) => format!("{}.Error", self.plan.elements[id.index()].name),
            Cause::Event(id, event) | Cause::On(_, id, Some(event)) => {
                let template = self.template(self.supervisor(id));
                let name = template.outcomes.get(usize::from(event)).map_or("", |e| &e.name);
                format!("{}.{name}", self.supervisor_path(id))
            }
            Cause::Miss(id) | Cause::On(_, id, None) => {
                format!("{}.DeadlineMissed", self.supervisor_path(id))
            }
            Cause::Active(id) => self.plan.elements[id.index()].name.clone(),
        }
    }

    fn state_name(&self, element: &Element, state: u16) -> &str {
        match element.component {
            Component::Actor(id) | Component::Computation(id) => {
                let outcomes = &self.model.template(id).outcomes;
                outcomes.get(usize::from(state)).map_or("", |outcome| &outcome.name)
            }
            Component::SubPlan(_) if usize::from(state) == OK => "OK",
            Component::SubPlan(_) => "Interrupted",
        }
    }

    /// `touch` for a global supervisor, `searchFirstWall.touch` for a local one.
    pub fn supervisor_path(&self, id: SupervisorId) -> String {
        let supervisor = self.supervisor(id);
        match supervisor.owner {
            Some(owner) => {
                format!("{}.{}", self.plan.elements[owner.index()].name, supervisor.name)
            }
            None => supervisor.name.clone(),
        }
    }

    pub fn node_name(&self, node: Node) -> &str {
        let end = if node == self.end(FAILED) { "fail" } else { "terminate" };
        self.element(node).map_or(end, |element| &element.name)
    }
}

/// Global events and missed deadlines that some element replaces.
fn replaced(plan: &Plan) -> Vec<(SupervisorId, Option<u16>)> {
    let mut replaced = Vec::new();
    for table in plan.elements.iter().flat_map(|element| &element.reactions) {
        let events = (0..).zip(&table.events).filter(|(_, target)| target.is_some());
        replaced.extend(events.map(|(event, _)| (table.supervisor, Some(event))));
        replaced.extend(table.on_miss.map(|_| (table.supervisor, None)));
    }
    replaced.sort_unstable();
    replaced.dedup();
    replaced
}
