//! One scenario over several seeds and worlds: `over seeds 0..20`, `over worlds "a.toml", "b.toml"`.
//!
//! Each run is a scenario of its own, whose name says which one it is.

use std::ops::Range;

use crate::scenario::Scenario;
use afp_syntax::ast::{Line, LineKind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::source::Span;
use afp_syntax::unquote;

/// So many runs are asked of one scenario at most.
const MOST: u64 = 1000;

/// What a scenario is over.
#[derive(Default)]
pub(super) struct Over {
    seeds: Option<(Range<u64>, Span)>,
    worlds: Option<(Vec<String>, Span)>,
}

impl Over {
    /// Reads the lines of a scenario.
    pub fn of(lines: &[Line], diags: &mut Diagnostics) -> Over {
        let mut over = Over::default();
        for line in lines {
            match line.kind() {
                LineKind::OverSeeds(Some(first), Some(behind)) if over.seeds.is_none() => {
                    let seeds = range(&first, &behind, diags);
                    over.seeds = seeds.map(|seeds| (seeds, line.span()));
                }
                LineKind::OverWorlds(files) if over.worlds.is_none() && !files.is_empty() => {
                    let worlds: Vec<_> =
                        files.iter().flat_map(|file| expanded(file, diags)).collect();
                    // What is over no worlds is told already.
                    over.worlds = Some((worlds, line.span())).filter(|(it, _)| !it.is_empty());
                }
                _ => {}
            }
        }
        over.check_number(diags);
        over
    }

    fn check_number(&self, diags: &mut Diagnostics) {
        let (seeds, worlds) = (self.seeds.as_ref(), self.worlds.as_ref());
        let count = |(range, _): &(Range<u64>, Span)| range.end - range.start;
        let runs = seeds.map_or(1, count);
        let runs = runs.saturating_mul(worlds.map_or(1, |(worlds, _)| worlds.len() as u64));
        let span = seeds.map(|(_, span)| *span).or(worlds.map(|(_, span)| *span));
        if let (Some(span), true) = (span, runs > MOST) {
            let message = format!("the scenario would be run more than {MOST} times");
            diags.push(
                Diagnostic::new(Code::E0224, span, message).help(
                    "take fewer seeds or worlds; 'afpc sweep' makes as many runs as you like",
                ),
            );
        }
    }

    /// The runs of a scenario; as it is where it is over nothing.
    pub fn runs(self, scenario: Scenario) -> Vec<Scenario> {
        let seeds = match &self.seeds {
            Some((seeds, _)) => seeds.clone().take(MOST as usize).map(Some).collect(),
            None => vec![None],
        };
        let worlds: Vec<_> = match self.worlds {
            Some((worlds, _)) => worlds.into_iter().map(Some).collect(),
            None => vec![None],
        };
        let mut runs = Vec::new();
        for world in worlds {
            runs.extend(seeds.iter().map(|seed| one(&scenario, world.clone(), *seed)));
        }
        runs
    }
}

/// One run of a scenario.
fn one(scenario: &Scenario, world: Option<String>, seed: Option<u64>) -> Scenario {
    let mut run = scenario.clone();
    let seed_text = seed.map(|seed| format!("seed {seed}"));
    let which: Vec<_> = world.clone().into_iter().chain(seed_text).collect();
    if !which.is_empty() {
        run.name = format!("{} ({})", scenario.name, which.join(", "));
    }
    run.seed = seed.unwrap_or(run.seed);
    run.world = world.or(run.world);
    run
}

fn range(first: &Name, behind: &Name, diags: &mut Diagnostics) -> Option<Range<u64>> {
    let range = super::seed(first, diags)?..super::seed(behind, diags)?;
    if range.is_empty() {
        diags.push(empty("seed", &range, "", first.span.to(behind.span)));
        return None;
    }
    Some(range)
}

/// What is told of a range without numbers; `before` stands before one.
fn empty(what: &str, range: &Range<u64>, before: &str, place: Span) -> Diagnostic {
    let message = format!("no {what} lies in '{before}{}..{}'", range.start, range.end);
    Diagnostic::new(Code::E0224, place, message).help(format!(
        "write the first {what} and the one behind the last, such as '{before}0..20'"
    ))
}

/// The worlds that a text stands for: `random:7..9` is `random:7` and `random:8`.
fn expanded(file: &Name, diags: &mut Diagnostics) -> Vec<String> {
    let text = unquote(file, diags);
    let range = text.split_once(':').and_then(|(kind, range)| {
        let (from, to) = range.split_once("..")?;
        Some((kind, from.parse::<u64>().ok()?..to.parse::<u64>().ok()?))
    });
    let Some((kind, range)) = range else { return vec![text] };
    if range.is_empty() {
        diags.push(empty("world", &range, &format!("{kind}:"), file.span));
    }
    range.take(MOST as usize + 1).map(|number| format!("{kind}:{number}")).collect()
}
