//! Attaches each diagnostic to the smallest enclosing part of a plan.

use super::{Component, Findings, Found, Outline};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Span;
use rustc_hash::FxHashMap;

impl Outline {
    /// Attaches diagnostics to items and parts. They must be sorted, as in a compilation; call this
    /// again after adding some.
    pub fn attach(&mut self, diags: &Diagnostics) {
        if diags.is_empty() || self.files.is_empty() {
            return;
        }
        // Most parts have no diagnostics.
        let mut spans: Vec<(Span, usize)> = Vec::new();
        let mut at = 0;
        self.visit(&mut |span, _| {
            if diags.any_begins_within(span) {
                spans.push((span, at));
            }
            at += 1;
        });
        // Outer parts before inner ones.
        spans.sort_by_key(|(span, at)| (span.file, span.start, u32::MAX - span.end, *at));
        let mut given: FxHashMap<usize, Vec<u32>> = FxHashMap::default();
        let mut loose: Vec<u32> = Vec::new();
        let mut next = spans.iter().peekable();
        let mut open: Vec<(Span, usize)> = Vec::new();
        for (number, diagnostic) in (0..).zip(diags.iter()) {
            let place = diagnostic.span;
            while let Some(part) = next.next_if(|(span, _)| begins_before(*span, place)) {
                open.retain(|(span, _)| span.contains(part.0.before()));
                open.push(*part);
            }
            match open.iter().rev().find(|(span, _)| span.contains(place)) {
                Some((_, at)) => given.entry(*at).or_default().push(number),
                None => loose.push(number),
            }
        }
        let mut at = 0;
        self.visit(&mut |_, findings| {
            give(findings, given.remove(&at).unwrap_or_default(), diags);
            at += 1;
        });
        for file in &mut self.files {
            let own = loose.iter().copied().filter(|number| {
                diags.get(*number).is_some_and(|each| each.span.file == file.file)
            });
            give(&mut file.findings, own.collect(), diags);
        }
    }

    /// Visits every item and part with its place.
    fn visit(&mut self, see: &mut dyn FnMut(Span, &mut Findings)) {
        for file in &mut self.files {
            for each in &mut file.enums {
                see(each.span, &mut each.findings);
            }
            for table in &mut file.tables {
                see(table.span, &mut table.findings);
            }
            for scenario in &mut file.scenarios {
                see(scenario.span, &mut scenario.findings);
            }
        }
        for plan in &mut self.plans {
            see(plan.span, &mut plan.findings);
            for entry in &mut plan.entries {
                see(entry.span, &mut entry.findings);
            }
            for start in &mut plan.starts {
                see(start.span, &mut start.findings);
            }
            for component in plan.supervisors.iter_mut().chain(&mut plan.elements) {
                visit(component, see);
            }
        }
    }
}

fn visit(component: &mut Component, see: &mut dyn FnMut(Span, &mut Findings)) {
    see(component.span, &mut component.findings);
    for input in &mut component.inputs {
        if let Some(binding) = &input.binding {
            see(binding.span, &mut input.findings);
        }
    }
    for output in &mut component.outputs {
        if let Some(binding) = &output.binding {
            see(binding.span, &mut output.findings);
        }
    }
    for exit in &mut component.exits {
        if let Some(edge) = &exit.edge {
            see(edge.span, &mut exit.findings);
        }
    }
    for inner in component.supervisors.iter_mut().chain(&mut component.reactions) {
        visit(inner, see);
    }
}

fn begins_before(span: Span, place: Span) -> bool {
    (span.file, span.start) <= (place.file, place.start)
}

fn give(findings: &mut Findings, list: Vec<u32>, diags: &Diagnostics) {
    let severities = list.iter().filter_map(|number| diags.get(*number));
    let worst = severities.map(|each| each.severity).min();
    findings.0 = worst.map(|worst| Box::new(Found { worst, list }));
}
