//! One scenario over several seeds and worlds: `over seeds 0..20`, `over worlds "a.toml",
//! "b.toml"`.
//!
//! Each run is a separate scenario with its seed and world in the name.

use std::ops::Range;

use crate::scenario::Scenario;
use afp_syntax::ast::{Line, LineKind, Name};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::unquote;

/// Maximum number of runs per scenario.
const MOST: u64 = 1000;

/// Seeds and worlds of a scenario.
#[derive(Default)]
pub(super) struct Over {
    seeds: Option<(Range<u64>, Span)>,
    worlds: Option<(Vec<String>, Span)>,
}

impl Over {
    pub fn of(lines: &[Line], diags: &mut Diagnostics) -> Over {
        let mut over = Over::default();
        for line in lines {
            match line.kind() {
                LineKind::OverSeeds(Some(first), Some(behind)) if over.seeds.is_none() => {
                    let seeds = range(&first, &behind, diags);
                    over.seeds = seeds.map(|seeds| (seeds, line.span()));
                }
                LineKind::OverWorlds(files) if over.worlds.is_none() && !files.is_empty() => {
                    let worlds = files.iter().fold(Vec::new(), |mut worlds, file| {
                        let room = (MOST as usize + 1).saturating_sub(worlds.len());
                        worlds.extend(expanded(file, room, diags));
                        worlds
                    });
                    // An empty list of worlds has been reported.
                    over.worlds = Some((worlds, line.span())).filter(|(it, _)| !it.is_empty());
                }
                _ => {}
            }
        }
        // Too many runs become one, since the error is reported.
        if over.check_number(diags) { over } else { Over::default() }
    }

    /// Checks the number of runs.
    fn check_number(&self, diags: &mut Diagnostics) -> bool {
        let (seeds, worlds) = (self.seeds.as_ref(), self.worlds.as_ref());
        let count = |(range, _): &(Range<u64>, Span)| range.end - range.start;
        let runs = seeds.map_or(1, count);
        let runs = runs.saturating_mul(worlds.map_or(1, |(worlds, _)| worlds.len() as u64));
        let span = seeds.map(|(_, span)| *span).or(worlds.map(|(_, span)| *span));
        let fits = runs <= MOST;
        if let (Some(span), false) = (span, fits) {
            let message = message!("the scenario would be run more than {} times", MOST);
            diags.push(
                Diagnostic::new(Code::E0224, span, message)
                    .help("take fewer seeds or worlds; 'afpc sweep' makes more runs"),
            );
        }
        fits
    }

    /// The runs of a scenario; unchanged without `over`.
    pub fn runs(self, scenario: Scenario) -> Vec<Scenario> {
        let seeds = match &self.seeds {
            Some((seeds, _)) => seeds.clone().map(Some).collect(),
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

/// Reports an empty range; `before` is the text before a number.
fn empty(what: &str, range: &Range<u64>, before: &str, place: Span) -> Diagnostic {
    let message = message!("no {} is in '{}{}..{}'", Words(what), before, range.start, range.end);
    Diagnostic::new(Code::E0224, place, message).help(message!(
        "write the first {} and the number after the last, such as '{}0..20'",
        Words(what),
        before
    ))
}

/// The worlds of a text, at most `most`: `random:7..9` is `random:7` and `random:8`.
fn expanded(file: &Name, most: usize, diags: &mut Diagnostics) -> Vec<String> {
    let text = unquote(file, diags);
    let range = text.split_once(':').and_then(|(kind, range)| {
        let (from, to) = range.split_once("..")?;
        Some((kind, from.parse::<u64>().ok()?..to.parse::<u64>().ok()?))
    });
    let Some((kind, range)) = range else { return Vec::from_iter((most > 0).then_some(text)) };
    if range.is_empty() {
        diags.push(empty("world", &range, &format!("{kind}:"), file.span));
    }
    range.take(most).map(|number| format!("{kind}:{number}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_syntax::ast::Item;

    /// Numbers of seeds, worlds and diagnostics.
    fn over(lines: &str) -> (usize, usize, usize) {
        let mut diags = Diagnostics::default();
        let tree =
            afp_syntax::parse(&format!("scenario \"s\" for P {{\n{lines}\n}}\n"), 0, &mut diags);
        let items = tree.file().items();
        let Some(Item::Scenario(scenario)) = items.first() else { panic!("{lines}") };
        let over = Over::of(&scenario.lines(), &mut diags);
        let seeds = over.seeds.map_or(0, |(seeds, _)| seeds.count());
        (seeds, over.worlds.map_or(0, |(worlds, _)| worlds.len()), diags.iter().count())
    }

    #[test]
    fn a_range_that_is_reported_as_too_large_is_not_generated() {
        assert_eq!(over("over seeds 0..20\nover worlds \"random:0..50\""), (20, 50, 0));
        assert_eq!(over("over seeds 0..1000\nover worlds \"random:0..1000\""), (0, 0, 1));
        assert_eq!(over("over worlds \"random:0..1000\""), (0, 1000, 0));
        assert_eq!(over("over worlds \"random:0..900\", \"random:0..101\""), (0, 0, 1));
        assert_eq!(
            over("over worlds \"random:0..900\", \"random:0..99\", \"a.toml\""),
            (0, 1000, 0)
        );
    }
}
