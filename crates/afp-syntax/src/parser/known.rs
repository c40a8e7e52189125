//! The names of each plan, found before the plan is read, so that a help can use the plan's own names.

use std::collections::BTreeMap;

use crate::kind::Kind;
use crate::lexer::Token;

/// The names of one plan.
#[derive(Default)]
pub(super) struct Names<'t> {
    /// Each entry with the word that declares it.
    pub entries: BTreeMap<&'t str, &'t str>,
    pub supervisors: BTreeMap<&'t str, Watch<'t>>,
    /// Each event with its supervisor.
    pub events: BTreeMap<&'t str, &'t str>,
    /// Each element with its first state.
    pub elements: BTreeMap<&'t str, &'t str>,
}

/// A supervisor.
pub(super) struct Watch<'t> {
    pub template: &'t str,
    /// Its first event; empty without one.
    pub event: &'t str,
    /// Whether it watches during the whole plan.
    pub is_global: bool,
}

/// The names of every plan, by the place of its `plan` in `solid`.
pub(super) fn names<'t>(tokens: &[Token<'t>], solid: &[u32]) -> BTreeMap<usize, Names<'t>> {
    let token = |at: usize| solid.get(at).and_then(|index| tokens.get(*index as usize));
    let text = |at: usize| token(at).map_or("", |token| token.text);
    let kind = |at: usize| token(at).map_or(Kind::End, |token| token.kind);
    let mut found: BTreeMap<usize, Names<'t>> = BTreeMap::new();
    let mut plan: Option<(usize, Names<'t>)> = None;
    let mut depth = 0_usize;
    let (mut element, mut supervisor) = ("", None);
    for at in 0..solid.len() {
        match (kind(at), text(at)) {
            (Kind::OpenBrace, _) => depth += 1,
            (Kind::CloseBrace, _) => {
                depth = depth.saturating_sub(1);
                supervisor = supervisor.filter(|(_, around)| depth > *around);
            }
            (Kind::Name, "plan") if depth == 0 => {
                (element, supervisor) = ("", None);
                found.extend(plan.replace((at, Names::default())));
            }
            (sign, word) => {
                let Some((_, names)) = &mut plan else { continue };
                let name = at + 1 + usize::from(word == "in" && text(at + 1) == "live");
                let is_named = kind(name) == Kind::Name;
                let has_template = is_named && kind(at + 2) == Kind::Colon;
                match word {
                    "in" | "out" | "var" | "const" if depth == 1 && is_named => {
                        names.entries.entry(text(name)).or_insert(word);
                    }
                    "actor" | "computation" | "subplan" if depth == 1 && has_template => {
                        (element, supervisor) = (text(name), None);
                        names.elements.entry(element).or_default();
                    }
                    "supervise" if has_template => {
                        supervisor = Some((text(name), depth));
                        let (template, is_global) = (text(at + 3), depth == 1);
                        let watch = Watch { template, event: "", is_global };
                        names.supervisors.entry(text(name)).or_insert(watch);
                    }
                    _ if sign == Kind::Arrow && at > 1 && kind(at - 1) == Kind::Name => {
                        use Kind::{CloseBrace, Comma, OpenBrace, Text};
                        // A word before the name belongs to another language.
                        let begins = matches!(kind(at - 2), OpenBrace | CloseBrace | Comma | Text)
                            || at > 2 && kind(at - 3) == Kind::Arrow;
                        if begins {
                            names.edge(text(at - 1), element, supervisor, depth);
                        }
                    }
                    _ => {}
                }
            }
        }
    }
    found.extend(plan);
    found
}

impl<'t> Names<'t> {
    /// Whether a supervisor watches during the whole plan.
    pub fn is_global(&self, supervisor: &str) -> bool {
        self.supervisors.get(supervisor).is_some_and(|watch| watch.is_global)
    }

    /// Notes the state or event of an edge.
    fn edge(&mut self, name: &'t str, element: &str, of: Option<(&'t str, usize)>, depth: usize) {
        match of {
            Some((supervisor, around)) if depth > around => {
                self.events.entry(name).or_insert(supervisor);
                if let Some(watch) = self.supervisors.get_mut(supervisor) {
                    watch.event = if watch.event.is_empty() { name } else { watch.event };
                }
            }
            None if depth > 1 => {
                if let Some(state) = self.elements.get_mut(element).filter(|it| it.is_empty()) {
                    *state = name;
                }
            }
            _ => {}
        }
    }
}

pub(super) fn uses(tokens: &[Token<'_>], toolbox: &str) -> bool {
    let mut names = tokens.iter().filter(|token| !token.kind.is_trivia()).map(|token| token.text);
    let (mut before, mut uses) = ("", false);
    names.by_ref().take_while(|text| *text != "plan").for_each(|text| {
        uses |= before == "use" && text == toolbox;
        before = text;
    });
    uses
}
