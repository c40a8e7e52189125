//! Sample runs in which the elements of a plan become active.

use afp_core::Instant;
use afp_dsl::graph::Component;
use afp_dsl::scenario::{Action, Outcome, Scenario, Stimulus};
use afp_dsl::unfold::Goal;
use afp_run::RunError;

use crate::parts::Parts;
use crate::verdict::Verdict;
use crate::watch::Activation;

/// The seeds tried if a run does not reach every element.
const SEEDS: u64 = 4;
/// The most runs to reach the remaining elements.
const RUNS: usize = 120;
/// Stimuli are at whole milliseconds if possible.
const GRAIN: u64 = 1_000_000;

#[derive(Clone)]
pub(super) struct SampleRun {
    pub seed: u64,
    /// Its actions.
    pub steps: Vec<Step>,
    activations: Vec<Activation>,
}

/// An action during the first activation of an element.
#[derive(Clone)]
pub(super) struct Step {
    /// The first activation of the element.
    pub active: Activation,
    /// The action without its time.
    pub text: String,
    stimulus: Stimulus,
}

/// The runs, and the first activation of each element.
pub(super) struct Reach {
    runs: Vec<SampleRun>,
    /// The run and the time span for each component.
    found: Vec<Option<(usize, Activation)>>,
}

/// A state, event or error with an edge to try.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Edge {
    component: u32,
    outcome: Outcome,
    /// The element with a reaction, if the edge belongs to one.
    during: Option<u32>,
}

type Run<'a> = &'a mut dyn FnMut(&Scenario) -> Result<Verdict, RunError>;

impl Reach {
    /// Runs the plan until every element has been active, or all options are used.
    pub fn explore(parts: &Parts<'_>, quiet: &Scenario, run: Run<'_>) -> Result<Reach, RunError> {
        let mut reach = Reach { runs: Vec::new(), found: Vec::new() };
        for seed in 0..SEEDS {
            if seed == 0 || !reach.is_whole(parts) {
                reach.run(quiet, seed, Vec::new(), run)?;
            }
        }
        let mut tried = Vec::new();
        while reach.runs.len() < RUNS && !reach.is_whole(parts) {
            let Some(edge) = reach.next(parts, &tried) else { break };
            tried.push(edge);
            if let Some((seed, steps)) = reach.steps_behind(parts, quiet, edge) {
                reach.run(quiet, seed, steps, run)?;
            }
        }
        Ok(reach)
    }

    /// The first run that activates an element, and the first activation in it.
    pub fn of(&self, element: u32) -> Option<(&SampleRun, Activation)> {
        let (number, active) = self.found.get(element as usize).copied().flatten()?;
        Some((self.runs.get(number)?, active))
    }

    fn is_whole(&self, parts: &Parts<'_>) -> bool {
        let lasts = |element: &u32| {
            !matches!(parts.component(*element), Some(Component::Computation(_)) | None)
        };
        parts.elements().filter(lasts).all(|element| self.of(element).is_some())
    }

    fn run(
        &mut self,
        quiet: &Scenario,
        seed: u64,
        steps: Vec<Step>,
        run: Run<'_>,
    ) -> Result<(), RunError> {
        let stimuli = steps.iter().map(|step| step.stimulus.clone()).collect();
        let scenario = Scenario { seed, stimuli, ..quiet.clone() };
        let mut activations = run(&scenario)?.activations;
        activations.sort_by_key(|active| active.from);
        for active in activations.iter().filter(|active| active.to > active.from) {
            let index = active.element as usize;
            if self.found.len() <= index {
                self.found.resize(index + 1, None);
            }
            // The first run that reaches an element has the fewest stimuli.
            self.found[index].get_or_insert((self.runs.len(), *active));
        }
        self.runs.push(SampleRun { seed, steps, activations });
        Ok(())
    }

    /// An untried outcome of a reached component, whose edge leads to an unreached one.
    fn next(&self, parts: &Parts<'_>, tried: &[Edge]) -> Option<Edge> {
        let edges = self.declared(parts).chain(self.errors(parts));
        let mut untried = edges.filter(|edge| !tried.contains(edge));
        untried.find(|edge| self.leads_on(parts, *edge))
    }

    /// States of reached actors, and events of supervisors of reached actors and sub-plans.
    fn declared(&self, parts: &Parts<'_>) -> impl Iterator<Item = Edge> {
        self.reached(parts).flat_map(move |(element, component)| {
            let own = matches!(component, Component::Actor(_)).then_some(element);
            let all = own.into_iter().chain(parts.supervisors_over(element));
            all.flat_map(move |component| {
                let count = parts.place(component).map_or(0, |place| place.outcomes.len());
                (0..count as u16).map(move |outcome| {
                    let own = parts.place(element);
                    let own = own.and_then(|place| place.reaction(component, Some(outcome)));
                    let during = own.map(|_| element);
                    Edge { component, outcome: Outcome::Declared(outcome), during }
                })
            })
        })
    }

    fn errors(&self, parts: &Parts<'_>) -> impl Iterator<Item = Edge> {
        let actors = self.reached(parts).filter(|(_, it)| matches!(it, Component::Actor(_)));
        actors.map(|(component, _)| Edge { component, outcome: Outcome::Special, during: None })
    }

    /// The reached elements that take time.
    fn reached(&self, parts: &Parts<'_>) -> impl Iterator<Item = (u32, Component)> {
        let reached = parts.elements().filter(|number| self.of(*number).is_some());
        reached.filter_map(|number| Some((number, parts.component(number)?)))
    }

    /// Whether an edge may lead to an unreached element.
    fn leads_on(&self, parts: &Parts<'_>, edge: Edge) -> bool {
        let goal = match (edge.outcome, edge.during) {
            (Outcome::Special, _) => parts.goal_of_error(edge.component),
            (Outcome::Declared(event), Some(actor)) => parts.goal_at(actor, edge.component, event),
            (Outcome::Declared(outcome), None) => parts.goal(edge.component, outcome),
        };
        match goal {
            Some(Goal::Element(to) | Goal::Suspend(to)) => self.of(to).is_none(),
            // The end of a sub-plan may lead to other elements.
            Some(Goal::Terminate) => {
                parts.place(edge.component).is_some_and(|place| place.plan != 0)
            }
            Some(Goal::Fail(_) | Goal::Ignore | Goal::Resume | Goal::Return) | None => false,
        }
    }

    /// The seed and the actions of a run in which a component reports an outcome.
    fn steps_behind(
        &self,
        parts: &Parts<'_>,
        quiet: &Scenario,
        Edge { component, outcome, during }: Edge,
    ) -> Option<(u64, Vec<Step>)> {
        let owner = parts.place(component)?.owner.or(during);
        let element = match parts.supervisor(component) {
            Some(_) => owner.or_else(|| self.reached_beside(parts, component)),
            None => Some(component),
        };
        let (before, active) = self.of(element?)?;
        let (from, to) = (active.from.as_nanos(), active.to.as_nanos());
        let at = ((from + to) / 2 / GRAIN * GRAIN).max(from);
        let (injection, text) = match outcome {
            Outcome::Declared(outcome) => parts.injection(component, outcome)?,
            Outcome::Special => parts.failure(component),
        };
        let stimulus = Stimulus {
            from: None,
            at,
            action: Action::Inject(injection),
            text: text.clone(),
            span: quiet.span,
        };
        // Later actions belong only to the earlier run.
        let mut steps: Vec<_> = before.steps_before(at).cloned().collect();
        steps.push(Step { active, text, stimulus });
        Some((before.seed, steps))
    }

    /// A reached element in the plan of a global supervisor.
    fn reached_beside(&self, parts: &Parts<'_>, supervisor: u32) -> Option<u32> {
        let home = parts.place(supervisor)?.plan;
        let beside = |number: &u32| parts.place(*number).is_some_and(|place| place.plan == home);
        parts.elements().filter(beside).find(|number| self.of(*number).is_some())
    }
}

impl Step {
    /// The time after the element's start, in nanoseconds.
    pub fn after(&self) -> u64 {
        self.stimulus.at - self.active.from.as_nanos()
    }
}

impl SampleRun {
    /// The start of a component that is active at `at`.
    pub fn since(&self, component: u32, at: Instant) -> Option<Instant> {
        let mut active = self.activations.iter();
        let active = active.rfind(|a| a.element == component && a.from <= at && at <= a.to);
        active.map(|active| active.from)
    }

    /// The components active at the beginning of a step, including supervisors.
    pub fn active(&self, at: Instant) -> impl Iterator<Item = u32> {
        let active = self.activations.iter().filter(move |a| a.from < at && at <= a.to);
        active.map(|active| active.element)
    }

    /// The actions up to an instant, in nanoseconds.
    pub fn steps_before(&self, at: u64) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(move |step| step.stimulus.at < at)
    }

    pub fn before(&self, at: Instant) -> impl Iterator<Item = &Activation> {
        self.activations.iter().filter(move |active| active.from < at)
    }
}
