//! The lines of a scenario, and lines relative to its moments.

use std::cell::OnceCell;
use std::collections::BTreeSet;

use super::times::Stretch;
use super::{Checker, seed};
use crate::check::convert;
use crate::graph::EntryKind;
use crate::scenario::{Moment, MomentId, Scenario, Stimulus};
use crate::types::Dimension;
use afp_syntax::ast::{self, FormulaKind, Line, LineKind};
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;
use afp_syntax::source::Span;
use afp_syntax::unquote;

impl Checker<'_> {
    pub(super) fn lines(
        &self,
        lines: &[Line],
        stretch: &Stretch,
        scenario: &mut Scenario,
        diags: &mut Diagnostics,
    ) {
        let mut once: Vec<(String, Span)> = Vec::new();
        for line in lines {
            let key = match line.kind() {
                LineKind::Stimulus(..) | LineKind::Expect { .. } | LineKind::Moment(..) => None,
                LineKind::Set(path, _) => path.map(|path| format!("set {}", path.text())),
                LineKind::OverSeeds(..) => Some("over seeds".to_owned()),
                LineKind::OverWorlds(_) => Some("over worlds".to_owned()),
                _ => Some(line.keyword()),
            };
            if let Some(key) = key {
                if let Some((known, first)) = once.iter().find(|(known, _)| excludes(known, &key)) {
                    let message = match *known == key {
                        true => message!("'{}' is repeated", key),
                        false => message!("'{}' does not go with '{}'", key, known),
                    };
                    diags.push(
                        Diagnostic::new(Code::E0601, line.span(), message)
                            .note(*first, "first written here")
                            .help("remove one of the lines"),
                    );
                    continue;
                }
                once.push((key, line.span()));
            }
            match line.kind() {
                LineKind::Moment(claim, lines) => {
                    self.moment(claim.as_ref(), lines, stretch, scenario, diags);
                }
                _ if stretch.from.is_some() && !counts(line) => diags.push(not_here(line)),
                _ => self.line(line, stretch, scenario, diags),
            }
        }
    }

    /// A moment of the run, and its relative lines.
    fn moment(
        &self,
        node: Option<&ast::Claim>,
        lines: Vec<Line>,
        outer: &Stretch,
        scenario: &mut Scenario,
        diags: &mut Diagnostics,
    ) {
        let Some(node) = node else { return };
        let is_readable = diags.syntax_errors_within(node.span()).next().is_none();
        let claim = self.claim(node, diags).filter(|_| is_readable);
        let from = u16::try_from(scenario.moments.len()).ok().map(MomentId);
        let lines = readable(lines, diags);
        let stretch = Stretch::of(&lines, from, diags);
        // Errors in the lines are also reported if the claim has one.
        let mut rest = Scenario::quiet("", scenario.graph.clone(), "", stretch.until);
        let into = if claim.is_some() { &mut *scenario } else { &mut rest };
        into.moments.extend(claim.map(|claim| Moment {
            claim,
            from: outer.from,
            until: stretch.written_end(),
            text: format!("from {}", node.in_one_line()),
            span: node.span(),
        }));
        self.lines(&lines, &stretch, into, diags);
    }

    fn line(
        &self,
        line: &Line,
        stretch: &Stretch,
        scenario: &mut Scenario,
        diags: &mut Diagnostics,
    ) {
        match line.kind() {
            LineKind::World(file) => scenario.world = file.map(|file| unquote(&file, diags)),
            LineKind::Seed(number) => {
                scenario.seed = number.and_then(|number| seed(&number, diags)).unwrap_or_default();
            }
            LineKind::Set(Some(path), Some(value)) => {
                scenario.set.extend(self.set(&path, &value, &[EntryKind::In], diags));
            }
            LineKind::Robot(formulas) => {
                let bare = self.places_without_a_unit(&formulas);
                scenario.robot = match bare.is_empty() {
                    true => self.robot(&formulas, diags),
                    false => None,
                };
                bare.into_iter().for_each(|error| diags.push(error));
            }
            LineKind::Stimulus(Some(at), Some(action)) => {
                let at = stretch.instant(&at, diags);
                let action = self.action(&action, diags);
                if let (Some(at), Some(action)) = (at, action) {
                    let (from, text, span) = (stretch.from, line.in_one_line(), line.span());
                    scenario.stimuli.push(Stimulus { from, at, action, text, span });
                }
            }
            LineKind::Expect { never, claim: Some(claim), bounds } => {
                let written = (never, &claim, &bounds[..]);
                scenario.expectations.extend(self.expectation(line, written, stretch, diags));
            }
            LineKind::OverSeeds(..) | LineKind::OverWorlds(_) | LineKind::Until(_) => {}
            LineKind::Moment(..) => {}
            LineKind::Set(..) | LineKind::Stimulus(..) => {}
            LineKind::Expect { claim: None, .. } => {}
        }
    }

    /// Reports bare numbers of a place in a world, likely in metres, together with its heading.
    fn places_without_a_unit(&self, formulas: &[ast::Formula]) -> Vec<Diagnostic> {
        let dimension = |name: &str| Dimension::named(name).unwrap_or_default();
        let bare = |(at, formula): (usize, &ast::Formula)| {
            let number = match formula.kind() {
                FormulaKind::Negation(inner) => inner?.kind(),
                kind => kind,
            };
            if !matches!(number, FormulaKind::Number { unit: None, broken: false, .. }) {
                return None;
            }
            let span = formula.span();
            let text = self.context.file.text.get(span.start as usize..span.end as usize)?;
            if at < 2 {
                let metres = [format!("{text} m")];
                return Some((at, convert::bare(span, dimension("length"), &metres)));
            }
            let units = convert::likely(text, dimension("angle"), None).into_iter();
            let better: Vec<_> = units.map(|unit| format!("{text} {unit}")).collect();
            Some((at, convert::bare(span, dimension("angle"), &better)))
        };
        let found: Vec<_> = formulas.iter().enumerate().filter_map(bare).collect();
        // A bare heading is checked separately.
        let of_place = found.iter().any(|(at, _)| *at < 2);
        found.into_iter().filter(|_| of_place).map(|(_, error)| error).collect()
    }
}

/// The parsed lines; relative lines are checked one by one. If only a closing brace is missing, the
/// line is complete; its edit is withdrawn if there are other errors.
pub(super) fn readable(mut lines: Vec<Line>, diags: &Diagnostics) -> Vec<Line> {
    let brackets = OnceCell::new();
    let is_bracket = |place: &Span| {
        let missing = || diags.iter().filter(|each| each.code == Code::E0103);
        brackets
            .get_or_init(|| missing().map(|each| each.span).collect::<BTreeSet<_>>())
            .contains(place)
    };
    lines.retain(|line| {
        matches!(line.kind(), LineKind::Moment(..))
            || diags.syntax_errors_within(line.span()).all(|place| is_bracket(&place))
    });
    lines
}

/// Whether a line has a time.
fn counts(line: &Line) -> bool {
    matches!(line.kind(), LineKind::Stimulus(..) | LineKind::Expect { .. } | LineKind::Until(_))
}

fn not_here(line: &Line) -> Diagnostic {
    let message =
        message!("'{}' is about the whole run, not about what comes after", line.keyword());
    Diagnostic::new(Code::E0601, line.span(), message)
        .help("write it in the scenario's own braces, outside of those of 'from'")
}

fn excludes(one: &str, other: &str) -> bool {
    let both = |a, b| [(a, b), (b, a)].contains(&(one, other));
    one == other || both("seed", "over seeds") || both("world", "over worlds")
}
