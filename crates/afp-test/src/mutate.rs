//! Mutation tests for scenarios: small changes of the plan should break them.
//!
//! [`mutants`] creates the changed files. A [`Bench`] holds the scenarios of a plan and judges each
//! mutant. Nothing here prints or starts a thread; callers can judge several mutants at once.

mod bench;
mod edits;
mod site;

use afp_syntax::source::Source;

pub use bench::{Bench, Judged, MutantStatus, Suite, Tally};
pub use site::MutantKind;

/// A plan's text with one small change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The kind of the change.
    pub kind: MutantKind,
    /// The line of the change, from 1.
    pub line: usize,
    /// The first changed character, from 1; it distinguishes equal changes in a line.
    pub column: usize,
    /// The original text.
    pub was: String,
    /// The new text.
    pub is: String,
    /// The whole text with the change.
    pub text: String,
}

/// The mutants of all plans in a text, in source order: signs, targets, constants, swapped edges.
/// The seed chooses among several possible changes.
///
/// Some may not compile; [`Bench::judge`] detects that.
pub fn mutants(text: &str, seed: u64) -> Vec<Mutant> {
    let source = Source::new("", text);
    let mut found = Vec::new();
    for site in edits::sites(text, seed) {
        let Some(first) = site.edits.first() else { continue };
        let (mut changed, mut at) = (String::with_capacity(text.len() + 16), 0);
        for (place, new) in &site.edits {
            changed.push_str(text.get(at..place.start).unwrap_or_default());
            changed.push_str(new);
            at = place.end;
        }
        changed.push_str(text.get(at..).unwrap_or_default());
        let (line, column) = source.line_column(first.0.start as u32);
        let (kind, was, is) = (site.kind, site.was, site.is);
        found.push(Mutant { kind, line, column, was, is, text: changed });
    }
    found.sort_by_key(|mutant| (mutant.line, mutant.column));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = "use carbot

plan P {
    in way: length = 1 m
    start go
    supervise escape: CheckEscapeButton every 20 ms { EscapeButtonPressed -> terminate }
    actor go: Forward(distance = -way + 20 cm) {
        ForwardSuccessful -> back
        Error -> terminate
    }
    actor back: Turn(angle = 60 deg) { TurnSuccessful -> go }
}

scenario \"x\" for P { expect end within 3 s }
";

    fn told(seed: u64) -> Vec<String> {
        let told = mutants(PLAN, seed);
        told.iter().map(|it| format!("{}: {} => {}", it.line, it.was, it.is)).collect()
    }

    #[test]
    fn signs_targets_constants_and_branches_are_changed() {
        let told = told(0).join("\n");
        for wanted in [
            "4: 1 m => -1 m",
            "5: start go => start back",
            "7: -way => way",
            "7: + => -",
            "7: 20 cm => -20 cm",
            "8: -> back => -> ",
            "8: -> back, -> terminate => -> terminate, -> back",
            "11: 60 deg => -60 deg",
        ] {
            assert!(told.contains(wanted), "no {wanted:?} in\n{told}");
        }
        let number = |one: &str, other: &str| told.contains(one) || told.contains(other);
        assert!(number("11: 60 deg => 120 deg", "11: 60 deg => 30 deg"), "{told}");
        assert!(number("6: 20 ms => 40 ms", "6: 20 ms => 10 ms"), "{told}");
        assert!(!told.contains("3 s"), "scenarios do not change\n{told}");
    }

    #[test]
    fn a_seed_makes_the_same_mutants_and_others_make_others() {
        assert_eq!(told(3), told(3));
        assert!((1..9).any(|seed| told(seed) != told(0)));
    }

    #[test]
    fn each_mutant_differs_from_the_plan_and_from_the_others() {
        let all = mutants(PLAN, 0);
        let texts: std::collections::BTreeSet<_> = all.iter().map(|each| &each.text).collect();
        assert_eq!(texts.len(), all.len());
        assert!(all.iter().all(|each| each.text != PLAN && each.was != each.is));
    }

    #[test]
    fn equal_mutants_in_a_line_have_different_columns() {
        let text = PLAN.replace("-way + 20 cm", "20 cm + 20 cm");
        let all = mutants(&text, 0);
        let signs = all.iter().filter(|each| each.was == "20 cm" && each.is == "-20 cm");
        let places: Vec<_> = signs.map(|each| (each.line, each.column)).collect();
        assert_eq!(places, [(7, 34), (7, 42)]);
    }
}
