//! The timeline for people: active components, their causes, written entries.

use std::fmt::Write;

use afp_core::Duration;
use afp_core::trace::{Cause, ComponentId, ComponentKind, Names, declared};
use afp_session::{
    Done, EndingKind, EventAt, EventKind, FaultText, Miss, NameWithUnit, NamedComponent,
    NamedOutcome, Requested, RunEvent, Stimulus,
};
use anstyle::{AnsiColor, Style};

const QUIET: Style = Style::new().dimmed();
const ACTIVE: Style = AnsiColor::Green.on_default().bold();
const EVENT: Style = AnsiColor::Yellow.on_default();
const DATA: Style = AnsiColor::Cyan.on_default();
const BAD: Style = AnsiColor::BrightRed.on_default().bold();
const STRONG: Style = Style::new().bold();

/// Whether a computation has one state and no bound output, so that its inputs are its purpose.
pub(super) fn logs(names: &(impl Names + ?Sized), id: ComponentId) -> bool {
    names.component(id).kind == ComponentKind::Computation
        && declared(names, id).count() == 1
        && names.outputs(id) == 0
}

/// The first lines, which name the plan and its robot.
pub(super) fn head(what: &[(&str, String)]) -> String {
    let mut text = String::new();
    for (key, value) in what {
        let _ = writeln!(text, "{QUIET}{key:>8}{QUIET:#}  {value}");
    }
    text
}

/// An event as a line without its end; `None` if it needs no line. `template` is the template of
/// the event's component.
pub(super) fn line(event: &RunEvent, template: &str, logs: bool) -> Option<String> {
    use EventKind as Kind;
    let component = &event.component.path;
    let text = match &event.kind {
        Kind::Input { port, value, unit } if logs => {
            format!("{DATA}✎ {component}: {port} = {}{DATA:#}", value.in_unit(unit))
        }
        Kind::Unknown | Kind::Polled(_) | Kind::Input { .. } | Kind::Interrupted => return None,
        Kind::ClockWentBack { asked } => {
            format!("{BAD}! the clock went back to {:.6} s{BAD:#}", asked.as_secs_f64())
        }
        Kind::Requested(request) => requested(request),
        Kind::StopRequested => format!("{EVENT}■ stop requested{EVENT:#}"),
        Kind::Injected(it) => format!("{EVENT}◇ {} (injected){EVENT:#}", outcome(component, it)),
        Kind::Missed(miss) => missed(component, miss),
        Kind::Event(EventAt { event, element, on }) => {
            let answered = match on {
                true => format!("  {QUIET}by 'on' of {}{QUIET:#}", element.path),
                false => String::new(),
            };
            format!("{EVENT}⚡ {}{EVENT:#}{answered}", outcome(component, event))
        }
        Kind::AlreadyThere(EventAt { event, .. }) => {
            format!("{QUIET}· {} (already there){QUIET:#}", outcome(component, event))
        }
        Kind::Finished(state) => format!("{QUIET}✓ {}{QUIET:#}", outcome(component, state)),
        Kind::Committed { entry, old, new, unit, .. } => {
            let (old, new) = (old.in_unit(unit), new.in_unit(unit));
            format!("{DATA}◆ {entry}: {old} → {new}{DATA:#}  {QUIET}by {component}{QUIET:#}")
        }
        Kind::Started => format!("{ACTIVE}▶ {component}{ACTIVE:#}  {QUIET}{template}{QUIET:#}"),
        Kind::Diverted { supervisor, .. } => {
            let why = &supervisor.path;
            format!("{EVENT}↪ {component} does not start, {why} looked first{EVENT:#}")
        }
        Kind::Resumed { supervisor } => {
            format!("{QUIET}↩ {component} continues after {}{QUIET:#}", supervisor.path)
        }
        Kind::Suspended { supervisor, started } => {
            let (by, early) = (&supervisor.path, if *started { "" } else { " before its start" });
            format!("{EVENT}⏸ {component} is set aside{early}{EVENT:#}  {QUIET}by {by}{QUIET:#}")
        }
        Kind::Returned { away } => {
            let away = away.as_secs_f64();
            format!("{ACTIVE}▶ {component}{ACTIVE:#}  {QUIET}again after {away:.3} s{QUIET:#}")
        }
        Kind::Abandoned { .. } => {
            format!("{QUIET}· {component} does not return{QUIET:#}")
        }
        Kind::Held { started: true } => format!("{EVENT}⏸ {component} is held{EVENT:#}"),
        Kind::Held { started: false } => {
            format!("{EVENT}⏸ held before {component}{EVENT:#}")
        }
        Kind::Released => format!("{QUIET}· the plan continues{QUIET:#}"),
        Kind::Faulted(fault) => format!("{BAD}✗ {component} failed: {}{BAD:#}", fault.text),
        Kind::Ended { ending, fault } => ended(&event.component, *ending, fault),
        Kind::Lost(count) => format!("{BAD}! {count} records lost{BAD:#}"),
    };
    let at = event.at.as_secs_f64();
    Some(format!("{at:>10.3}  {text}"))
}

fn outcome(path: &str, outcome: &NamedOutcome) -> String {
    match &*outcome.target {
        "" => format!("{path}.{}", outcome.name),
        target => format!("{path}.{} → {target}", outcome.name),
    }
}

/// A request from outside, in the words of scenarios.
fn requested(request: &Requested) -> String {
    let what = stimulus(&request.what);
    match &request.done {
        Done::Done => format!("{EVENT}● {what}{EVENT:#}  {QUIET}from outside{QUIET:#}"),
        Done::Refused(why) => format!("{BAD}! {what}: {why}{BAD:#}"),
        Done::NotReached => {
            let at = request.at.as_secs_f64();
            format!("{BAD}! not reached: {what} at {at} s{BAD:#}")
        }
    }
}

/// A stimulus with readable quantities.
pub(super) fn stimulus(what: &Stimulus) -> String {
    match what {
        Stimulus::Write(NameWithUnit { name, unit }, value) => {
            format!("set {name} = {}", value.in_unit(unit))
        }
        other => other.to_string(),
    }
}

fn missed(component: &str, miss: &Miss) -> String {
    let cause = match miss.cause {
        Some(Cause::LateRelease) => "late release",
        Some(Cause::LongPoll) => "long poll",
        None => "unknown cause",
    };
    let skipped = match miss.skipped {
        0 => String::new(),
        1 => "1 release skipped".to_owned(),
        many => format!("{many} releases skipped"),
    };
    // The lateness is zero if only releases were skipped and the poll itself was in time.
    if miss.lateness == Duration::ZERO {
        return format!("{BAD}! {component}: {skipped}{BAD:#}");
    }
    let late = miss.lateness.as_secs_f64() * 1e3;
    let comma = if skipped.is_empty() { "" } else { ", " };
    format!(
        "{BAD}! {component} missed its deadline by {late:.3} ms{BAD:#}  \
         {QUIET}({cause}{comma}{skipped}){QUIET:#}"
    )
}

fn ended(plan: &NamedComponent, ending: EndingKind, fault: &FaultText) -> String {
    let style = match (plan.id.0, ending) {
        (_, EndingKind::Error) => BAD,
        (0, _) => STRONG,
        _ => QUIET,
    };
    let how = match ending {
        EndingKind::Ok => "OK".to_owned(),
        EndingKind::Interrupted => "Interrupted".to_owned(),
        EndingKind::Error => format!("Error: {} ({})", fault.text, fault.code),
    };
    format!("{style}■ {} ended: {how}{style:#}", plan.path)
}
