//! `afpc log FILE --budgets`: the measured times of a real robot's control loop next to the declared
//! budgets and the proved bounds.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use afp_core::Duration;
use afp_core::trace::{ComponentId, ComponentKind, Names};
use afp_dsl::graph::Graph;
use afp_dsl::timing::{SupervisorTiming, Timing, timing};
use afp_dsl::types::text::duration;
use afp_dsl::unfold::places;
use afp_log::svg::{TimesRow, draw_times};
use afp_log::{LogData, LogNames};
use afp_run::RunError;
use afp_session::{Histogram, LoopTimes};

use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;

/// The times of a log with the graph of its plan.
pub(super) struct Measured<'a> {
    names: &'a LogNames,
    times: LoopTimes,
    graph: Graph,
}

/// The calls of a template.
struct Calls {
    times: Histogram,
    /// The declared budget.
    budget: Option<Duration>,
}

/// The reactions of a supervisor.
struct Reaction<'a> {
    path: &'a str,
    times: &'a Histogram,
    /// The proved time from its condition to the interruption, and how far it is proved.
    bound: Option<(Duration, &'static str)>,
}

impl<'a> Measured<'a> {
    /// Reads the times of a log.
    ///
    /// # Errors
    /// The log is not that of a real robot, or its plan is not valid here.
    pub fn of(log: &'a LogData, at: &Path) -> Result<Self, NoPlan> {
        let names = &log.names;
        let times = LoopTimes::of_facts(&log.end, names).ok_or_else(|| {
            let help = "log a run that ends, with '--robot hardware'";
            RunError::usage("the log has no times of a real robot's control loop", help)
        })?;
        let (_, graph) = PlanFile::of_log(log, at)?.checked()?;
        Ok(Measured { names, times, graph })
    }

    /// The tables, and the lines for `afp.toml`.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let templates = self.templates();
        row(&mut text, ["template", "calls", "p50", "p99", "worst", "budget"].map(str::to_owned));
        for (name, Calls { times, budget }) in &templates {
            let over = budget.filter(|budget| times.worst > *budget).map_or("", |_| " exceeded");
            let budget = budget.map_or("none".to_owned(), |it| duration(it.as_nanos()) + over);
            row(&mut text, cells(name, times, budget));
        }
        text.push('\n');
        row(&mut text, ["supervisor", "events", "p50", "p99", "worst", "bound"].map(str::to_owned));
        for Reaction { path, times, bound } in self.reactions() {
            let bound = bound.map_or("unknown".to_owned(), |(bound, trust)| {
                format!("{} {trust}", duration(bound.as_nanos()))
            });
            row(&mut text, cells(path, times, bound));
        }
        text += "\nfor afp.toml, the longest calls rounded up:\n[target.robot]\n";
        for (name, Calls { times, .. }) in &templates {
            // Writing to a `String` cannot fail.
            let _ = writeln!(text, "budgets.{name} = \"{}\"", duration(rounded(times.worst)));
        }
        text
    }

    /// The picture.
    pub fn picture(&self) -> String {
        let of_loop = |name: &str, times| TimesRow { name: name.to_owned(), times, limit: None };
        let mut rows =
            vec![of_loop("late wake-ups", &self.times.late), of_loop("steps", &self.times.steps)];
        let templates = self.templates();
        rows.extend(templates.iter().map(|(name, Calls { times, budget })| TimesRow {
            name: format!("calls of {name}"),
            times,
            limit: *budget,
        }));
        rows.extend(self.reactions().into_iter().map(|Reaction { path, times, bound }| TimesRow {
            name: format!("event to command, {path}"),
            times,
            limit: bound.map(|(bound, _)| bound),
        }));
        let title = &self.graph.main().name;
        draw_times(&format!("{title}: times of the control loop"), &rows)
    }

    fn components(&self) -> impl Iterator<Item = (ComponentId, &str, ComponentKind, &str)> {
        (0..self.names.components()).map(ComponentId).map(|id| {
            let row = self.names.component(id);
            (id, row.path, row.kind, row.template)
        })
    }

    /// The calls of all components of a template, by `toolbox.Template`.
    fn templates(&self) -> BTreeMap<String, Calls> {
        let mut all: BTreeMap<String, Calls> = BTreeMap::new();
        for (id, _, kind, name) in self.components() {
            let times = self.times.calls.get(id.0 as usize).filter(|times| times.count() > 0);
            let times =
                times.filter(|_| !matches!(kind, ComponentKind::Plan | ComponentKind::SubPlan));
            let mut templates = self
                .graph
                .toolboxes
                .iter()
                .filter(|it| it.is_named())
                .flat_map(|it| it.templates.iter().map(move |template| (&it.name, template)));
            let found = templates.find(|(_, template)| template.name == name);
            if let (Some(times), Some((toolbox, template))) = (times, found) {
                let budget = template.budget.map(Duration::from_nanos);
                let known = all.entry(format!("{toolbox}.{name}"));
                known.or_insert(Calls { times: Histogram::default(), budget }).times.add(times);
            }
        }
        all
    }

    /// The reactions of all supervisors with events.
    fn reactions(&self) -> Vec<Reaction<'_>> {
        let proved = timing(&self.graph, None);
        let (mut all, places) = (Vec::new(), places(&self.graph));
        for (id, path, ..) in self.components() {
            let Some(times) = self.times.reactions.get(id.0 as usize) else { continue };
            if times.count() == 0 {
                continue;
            }
            // Its plan, and its path there.
            let around = places.get(id.0 as usize).map_or(0, |place| place.plan);
            let plan = self.names.component(ComponentId(around));
            let inside = path.strip_prefix(plan.path).and_then(|path| path.strip_prefix('.'));
            let inside = inside.filter(|_| around > 0).unwrap_or(path);
            all.push(Reaction { path, times, bound: bound(&proved, plan.template, inside) });
        }
        all
    }
}

/// The proved time from a supervisor's condition to the end of the interruption, without the time
/// to standstill.
fn bound(proved: &Timing, plan: &str, path: &str) -> Option<(Duration, &'static str)> {
    let is_it = |row: &&SupervisorTiming| row.plan == plan && row.path == path;
    let bound = proved.supervisors.iter().find(is_it)?.interruption.as_ref()?;
    bound.total()?;
    let terms = bound.terms.iter().filter(|(name, _)| *name != "stop");
    let total = terms.fold(0_u64, |sum, (_, time)| sum.saturating_add(*time));
    Some((Duration::from_nanos(total), bound.trust.as_str()))
}

fn cells(name: &str, times: &Histogram, limit: String) -> [String; 6] {
    let [half, most, worst] = [times.quantile(0.5), times.quantile(0.99), times.worst]
        .map(|time| format!("{} us", time.as_nanos().div_ceil(1000)));
    [name.to_owned(), times.count().to_string(), half, most, worst, limit]
}

fn row(text: &mut String, [name, count, half, most, worst, limit]: [String; 6]) {
    // Writing to a `String` cannot fail.
    let _ = writeln!(text, "{name:<32} {count:>8} {half:>10} {most:>10} {worst:>10}  {limit}");
}

/// A duration rounded up to 1, 2 or 5 times a power of ten, at least a microsecond; nanoseconds.
fn rounded(duration: Duration) -> u64 {
    let mut decade = 1000_u64;
    loop {
        for step in [1, 2, 5] {
            let limit = decade.saturating_mul(step);
            if limit >= duration.as_nanos() {
                return limit;
            }
        }
        decade = decade.saturating_mul(10);
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, rounded};

    #[test]
    fn budgets_are_rounded_up() {
        for (nanos, limit) in [(0, 1_000), (1_001, 2_000), (4_999, 5_000), (5_001, 10_000)] {
            assert_eq!(rounded(Duration::from_nanos(nanos)), limit);
        }
        assert_eq!(rounded(Duration::from_nanos(u64::MAX)), u64::MAX);
    }
}
