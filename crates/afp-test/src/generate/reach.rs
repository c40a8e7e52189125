//! Runs of a plan in which its elements become active.

use afp_core::{Duration, Instant};
use afp_dsl::graph::Component;
use afp_dsl::scenario::{Action, Scenario, Stimulus};
use afp_dsl::unfold::Goal;
use afp_run::RunError;

use crate::parts::Parts;
use crate::verdict::Verdict;
use crate::watch::Activation;
use afp_dsl::types::text::duration;

/// Seeds that are tried where a run does not reach everything.
const SEEDS: u64 = 4;
/// Runs that are made to reach what no quiet one does.
const RUNS: usize = 60;
/// Stimuli are at whole milliseconds where nothing else matters.
const GRAIN: u64 = 1_000_000;

/// A run and how it is made.
#[derive(Clone)]
pub(super) struct Way {
    /// Its seed.
    pub seed: u64,
    /// What somebody does in it.
    pub stimuli: Vec<Stimulus>,
    activations: Vec<Activation>,
}

/// The runs, and where each element is active longest.
pub(super) struct Reach {
    ways: Vec<Way>,
    /// For each component the run and the stretch of time.
    found: Vec<Option<(usize, Activation)>>,
}

type Run<'a> = &'a mut dyn FnMut(&Scenario) -> Result<Verdict, RunError>;

impl Reach {
    /// Runs the plan until every element has been active, or there is nothing more to try.
    pub fn explore(parts: &Parts<'_>, quiet: &Scenario, run: Run<'_>) -> Result<Reach, RunError> {
        let mut reach = Reach { ways: Vec::new(), found: Vec::new() };
        for seed in 0..SEEDS {
            if seed == 0 || !reach.is_whole(parts) {
                reach.run(quiet, seed, Vec::new(), run)?;
            }
        }
        let mut tried = Vec::new();
        while reach.ways.len() < RUNS && !reach.is_whole(parts) {
            let Some((component, outcome)) = reach.next(parts, &tried) else { break };
            tried.push((component, outcome));
            if let Some((seed, stimuli)) = reach.way_behind(parts, quiet, component, outcome) {
                reach.run(quiet, seed, stimuli, run)?;
            }
        }
        Ok(reach)
    }

    /// The run in which an element is active longest, and when.
    pub fn of(&self, element: u32) -> Option<(&Way, Activation)> {
        let (way, active) = self.found.get(element as usize).copied().flatten()?;
        Some((self.ways.get(way)?, active))
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
        stimuli: Vec<Stimulus>,
        run: Run<'_>,
    ) -> Result<(), RunError> {
        let scenario = Scenario { seed, stimuli: stimuli.clone(), ..quiet.clone() };
        let activations = run(&scenario)?.activations;
        let before = self.found.clone();
        for active in &activations {
            let place = active.element as usize;
            if self.found.len() <= place {
                self.found.resize(place + 1, None);
            }
            // The first run that reaches something is the one with the fewest stimuli.
            let known = before.get(place).copied().flatten().is_some();
            let longer = self.found[place].is_none_or(|(_, found)| length(active) > length(&found));
            if !known && longer && length(active) > Duration::ZERO {
                self.found[place] = Some((self.ways.len(), *active));
            }
        }
        self.ways.push(Way { seed, stimuli, activations });
        Ok(())
    }

    /// An outcome of something that is reached, whose edge leads to what is not; not tried yet.
    fn next(&self, parts: &Parts<'_>, tried: &[(u32, u16)]) -> Option<(u32, u16)> {
        let reached = |number: u32| self.of(number).is_some();
        let actors = parts.elements().filter(|number| {
            reached(*number) && matches!(parts.component(*number), Some(Component::Actor(_)))
        });
        let all =
            actors.flat_map(|actor| std::iter::once(actor).chain(parts.supervisors_over(actor)));
        let mut edges = all.flat_map(|number| {
            let count = parts.place(number).map_or(0, |place| place.outcomes.len());
            (0..count as u16).map(move |outcome| (number, outcome))
        });
        edges.find(|(number, outcome)| {
            let goal = parts.goal(*number, *outcome);
            let onwards = match goal {
                Some(Goal::Element(to)) => !reached(to),
                // It ends a sub-plan, which may lead on.
                Some(Goal::Terminate) => parts.place(*number).is_some_and(|place| place.plan != 0),
                Some(Goal::Fail | Goal::Ignore | Goal::Resume) | None => false,
            };
            onwards && !tried.contains(&(*number, *outcome))
        })
    }

    /// Seed and stimuli of a run in which a component reports an outcome.
    fn way_behind(
        &self,
        parts: &Parts<'_>,
        quiet: &Scenario,
        component: u32,
        outcome: u16,
    ) -> Option<(u64, Vec<Stimulus>)> {
        let owner = parts.place(component)?.owner;
        let element = match parts.supervisor(component) {
            Some(_) => owner.or_else(|| self.reached_beside(parts, component)),
            None => Some(component),
        };
        let (way, active) = self.of(element?)?;
        let (from, to) = (active.from.as_nanos(), active.to.as_nanos());
        let at = ((from + to) / 2 / GRAIN * GRAIN).max(from);
        let (injection, text) = parts.injection(component, outcome)?;
        let stimulus = Stimulus {
            at,
            action: Action::Inject(injection),
            text: format!("at {}: {text}", duration(at)),
            span: quiet.span,
        };
        // What would happen later belongs to the run of before.
        let mut stimuli: Vec<_> = way.stimuli.iter().filter(|old| old.at < at).cloned().collect();
        stimuli.push(stimulus);
        Some((way.seed, stimuli))
    }

    /// An element of the same plan as a global supervisor that some run reaches.
    fn reached_beside(&self, parts: &Parts<'_>, supervisor: u32) -> Option<u32> {
        let home = parts.place(supervisor)?.plan;
        let beside = |number: &u32| parts.place(*number).is_some_and(|place| place.plan == home);
        parts.elements().filter(beside).find(|number| self.of(*number).is_some())
    }
}

impl Way {
    /// Since when a component is that is active at `at`.
    pub fn since(&self, component: u32, at: Instant) -> Option<Instant> {
        let mut active = self.activations.iter();
        let active = active.rfind(|a| a.element == component && a.from <= at && at <= a.to);
        active.map(|active| active.from)
    }

    /// What is active when a step begins at an instant, supervisors too.
    pub fn active(&self, at: Instant) -> impl Iterator<Item = u32> {
        let active = self.activations.iter().filter(move |a| a.from < at && at <= a.to);
        active.map(|active| active.element)
    }

    /// What has been active, up to an instant.
    pub fn before(&self, at: Instant) -> impl Iterator<Item = &Activation> {
        self.activations.iter().filter(move |active| active.from < at)
    }
}

fn length(active: &Activation) -> Duration {
    active.to.since(active.from)
}
