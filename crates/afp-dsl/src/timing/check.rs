//! Timing errors of a plan, alone and on a target.

use std::collections::BTreeSet;

use crate::flow::view::View;
use crate::graph::{Component, Graph};
use crate::types::text::duration;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use afp_syntax::message;

use super::contribution::Outside;
use super::level::Levels;
use super::{Response, SupervisorTiming, Target, Timing, model, timing};

/// Reports plans that no target can run: more than the whole processor, and supervisors whose
/// response may exceed their deadline.
pub(crate) fn check_everywhere(graph: &Graph, diags: &mut Diagnostics) {
    let known = timing(graph, None);
    if let Ok((share, path)) = known.demand.as_ref().map_err(drop)
        && *share > 1.0
    {
        diags.push(too_much(graph, *share, path, "no processor gives more than 100 %"));
    }
    late_responses(known, diags);
}

fn late_responses(known: Timing, diags: &mut Diagnostics) {
    for row in known.supervisors {
        if let Some(response) = late(&row) {
            let message = message!(
                "'{}' may take {} from its release to the end of its poll, longer than its deadline of {}",
                row.path,
                Words(duration(response.total())),
                Words(duration(row.timing.deadline.as_nanos()))
            );
            diags.push(parts(Diagnostic::new(Code::E0405, row.span, message), &response));
        }
    }
}

fn late(row: &SupervisorTiming) -> Option<Response> {
    row.response
        .as_ref()
        .ok()
        .filter(|response| response.total() > row.timing.deadline.as_nanos())
        .copied()
}

fn parts(diagnostic: Diagnostic, response: &Response) -> Diagnostic {
    let parts = [
        (response.tick, "of the target's tick"),
        (response.step, "of a step that is running"),
        (response.before, "of supervisors before it"),
        (response.entered, "of elements that their events start"),
        (response.own, "of its own"),
    ];
    let parts = parts.into_iter().filter(|(time, _)| *time > 0);
    let sum: Vec<_> = parts.map(|(time, text)| format!("{} {text}", duration(time))).collect();
    diagnostic.help(message!(
        "give it a longer period and deadline, or use templates with smaller budgets: it is {}",
        Words(sum.join(", "))
    ))
}

/// Checks a plan against a target: ticks, demand, and responses that are too long only on the
/// target.
///
/// Unknown properties of the target are not checked.
pub fn check_target(graph: &Graph, target: &Target) -> Diagnostics {
    let mut diags = Diagnostics::default();
    if let Some(tick) = target.tick {
        ticks(graph, target, tick, &mut diags);
    }
    responses(graph, target, &mut diags);
    demand(graph, target, &mut diags);
    diags.sort();
    diags
}

/// The plans that the main plan reaches, as views.
fn used<R>(graph: &Graph, look: impl FnOnce(&mut dyn Iterator<Item = &View<'_>>) -> R) -> R {
    let model = model(graph, None);
    let views: Vec<_> = graph.plans.iter().map(|plan| View::new(&model, plan, &[])).collect();
    let levels = Levels::of(&views);
    let outside = Outside::of(&views, &levels, graph.main.index());
    let reached = views.iter().zip(&outside.before).filter(|(_, before)| before.is_some());
    look(&mut reached.map(|(view, _)| view))
}

fn ticks(graph: &Graph, target: &Target, tick: u64, diags: &mut Diagnostics) {
    let mut report = |span, name: &str, every: u64, help: Message| {
        let message = message!(
            "'{}' is polled every {}, but '{}' ticks every {}",
            name,
            Words(duration(every)),
            target.name,
            Words(duration(tick))
        );
        diags.push(Diagnostic::new(Code::E0403, span, message).help(help));
    };
    used(graph, |views| {
        for view in views {
            for supervisor in view.supervisors() {
                let every = supervisor.timing.period.as_nanos();
                if every >= tick {
                    continue;
                }
                let span = supervisor.every_span.unwrap_or(supervisor.span);
                let help = message!("write at least 'every {}'", duration(tick));
                report(span, &supervisor.name, every, help);
            }
            for (_, element) in view.elements() {
                let Component::Actor(id) = element.component else { continue };
                let every = view.model.template(id).every;
                if every < tick {
                    let help = "use a template with a longer period, or a target with a finer tick";
                    report(element.span, &element.name, every, help.into());
                }
            }
        }
    });
}

fn responses(graph: &Graph, target: &Target, diags: &mut Diagnostics) {
    let known: BTreeSet<_> = {
        let mut anywhere = Diagnostics::default();
        late_responses(timing(graph, None), &mut anywhere);
        anywhere.iter().map(|diagnostic| diagnostic.span).collect()
    };
    for row in timing(graph, Some(target)).supervisors {
        let Some(response) = late(&row).filter(|_| !known.contains(&row.span)) else { continue };
        let message = message!(
            "'{}' may take {} on '{}' from its release to the end of its poll, longer than its deadline of {}",
            row.path,
            Words(duration(response.total())),
            target.name,
            Words(duration(row.timing.deadline.as_nanos()))
        );
        diags.push(parts(Diagnostic::new(Code::E0405, row.span, message), &response));
    }
}

fn demand(graph: &Graph, target: &Target, diags: &mut Diagnostics) {
    let declared = timing(graph, None).demand;
    let Ok((share, path)) = timing(graph, Some(target)).demand else { return };
    // More than the whole is an error on every target.
    if share > target.capacity && !declared.is_ok_and(|(share, _)| share > 1.0) {
        let gives = message!("'{}' gives {}", target.name, Words(percent(target.capacity)));
        diags.push(too_much(graph, share, &path, gives));
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

/// Reports that a plan exceeds its share of the processor.
fn too_much(graph: &Graph, share: f64, path: &str, gives: impl Into<Message>) -> Diagnostic {
    let message = message!(
        "while '{}' is active, the plan asks for {} of the processor; {}",
        path,
        Words(percent(share)),
        gives.into()
    );
    let first = path.split('.').next().unwrap_or("");
    let main = graph.main();
    let element = main.elements.iter().find(|element| element.name == first);
    let span = element.map_or(main.span, |element| element.span);
    Diagnostic::new(Code::E0404, span, message)
        .help("poll its supervisors less often, or use templates with smaller budgets")
}
