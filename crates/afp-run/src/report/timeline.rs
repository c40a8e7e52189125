//! The timeline for people: what became active, why, and what was written.

use std::fmt::Write;

use afp_core::Duration;
use afp_core::trace::Cause;
use afp_session::{Datum, Done, EndingKind, EventKind, Requested, RunEvent, Stimulus};
use afp_types::Meaning;
use anstyle::{AnsiColor, Style};

const QUIET: Style = Style::new().dimmed();
const ACTIVE: Style = AnsiColor::Green.on_default().bold();
const EVENT: Style = AnsiColor::Yellow.on_default();
const DATA: Style = AnsiColor::Cyan.on_default();
const BAD: Style = AnsiColor::BrightRed.on_default().bold();
const STRONG: Style = Style::new().bold();

/// Whether a template is there so that people see its input.
pub(super) fn logs(template: &str) -> bool {
    Meaning::of("std", template) == Some(Meaning::Logs)
}

/// The lines that say what runs.
pub(super) fn head(what: &[(&str, String)]) -> String {
    let mut text = String::new();
    for (key, value) in what {
        let _ = writeln!(text, "{QUIET}{key:>8}{QUIET:#}  {value}");
    }
    text
}

/// An event as a line without its end; `None` for what is not worth a line. The template is that
/// of the event's component.
pub(super) fn line(event: &RunEvent, template: &str) -> Option<String> {
    use EventKind as Kind;
    let component = &event.component;
    let text = match event.kind {
        Kind::Input if logs(template) => logged(event),
        Kind::Unknown | Kind::Polled | Kind::Input | Kind::Interrupted => return None,
        Kind::ClockWentBack => {
            let asked = event.asked.unwrap_or_default().as_secs_f64();
            format!("{BAD}! the clock went back to {asked:.6} s{BAD:#}")
        }
        Kind::Requested => requested(event.request.as_ref()?),
        Kind::StopRequested => format!("{EVENT}■ stop requested{EVENT:#}"),
        Kind::Injected => format!("{EVENT}◇ {} (injected){EVENT:#}", outcome(component, event)),
        Kind::Missed => missed(event),
        Kind::Event => {
            let answered = answered(event);
            format!("{EVENT}⚡ {}{EVENT:#}{answered}", outcome(component, event))
        }
        Kind::AlreadyThere => {
            format!("{QUIET}· {} (already there){QUIET:#}", outcome(component, event))
        }
        Kind::Finished => format!("{QUIET}✓ {}{QUIET:#}", outcome(component, event)),
        Kind::Committed => commit(event),
        Kind::Started => format!("{ACTIVE}▶ {component}{ACTIVE:#}  {QUIET}{template}{QUIET:#}"),
        Kind::Diverted => {
            let why = &event.supervisor;
            format!("{EVENT}↪ {component} does not start, {why} looked first{EVENT:#}")
        }
        Kind::Resumed => {
            let why = &event.supervisor;
            format!("{QUIET}↩ {component} goes on after {why}{QUIET:#}")
        }
        Kind::Faulted => format!("{BAD}✗ {component} failed: {}{BAD:#}", event.fault_text),
        Kind::Ended => ended(event),
        Kind::Lost => format!("{BAD}! {} records lost{BAD:#}", event.lost),
    };
    let at = event.at.as_secs_f64();
    Some(format!("{at:>10.3}  {text}"))
}

fn outcome(path: &str, event: &RunEvent) -> String {
    match &*event.target {
        "" => format!("{path}.{}", event.outcome),
        target => format!("{path}.{} → {target}", event.outcome),
    }
}

/// Which element led an event of a global supervisor elsewhere.
fn answered(event: &RunEvent) -> String {
    match event.on {
        true => format!("  {QUIET}by 'on' of {}{QUIET:#}", event.element),
        false => String::new(),
    }
}

/// What came from outside, in the words of scenarios.
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

/// A stimulus with its quantities as people write them.
pub(super) fn stimulus(what: &Stimulus) -> String {
    match what {
        Stimulus::Write { entry, value, unit } => format!("set {entry} = {}", value.in_unit(unit)),
        other => other.to_string(),
    }
}

fn missed(event: &RunEvent) -> String {
    let Some(miss) = event.missed else { return String::new() };
    let cause = match miss.cause {
        Some(Cause::LateRelease) => "late release",
        Some(Cause::LongPoll) => "long poll",
        None => "unknown cause",
    };
    let component = &event.component;
    let skipped = match miss.skipped {
        0 => String::new(),
        1 => "1 release skipped".to_owned(),
        many => format!("{many} releases skipped"),
    };
    // The poll after skipped releases may be in time itself.
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

/// What a plan writes to its log.
fn logged(event: &RunEvent) -> String {
    let (component, port) = (&event.component, &event.port);
    let value = event.value.as_ref().unwrap_or(&Datum::Unset).in_unit(&event.unit);
    format!("{DATA}✎ {component}: {port} = {value}{DATA:#}")
}

fn commit(event: &RunEvent) -> String {
    let show = |value: &Option<Datum>| value.as_ref().unwrap_or(&Datum::Unset).in_unit(&event.unit);
    let (entry, old, new) = (&event.entry, show(&event.old), show(&event.value));
    let author = &event.component;
    format!("{DATA}◆ {entry}: {old} → {new}{DATA:#}  {QUIET}by {author}{QUIET:#}")
}

fn ended(event: &RunEvent) -> String {
    let RunEvent { component, fault, fault_text, .. } = event;
    let style = match (event.component_id.0, event.ending) {
        (_, Some(EndingKind::Error)) => BAD,
        (0, _) => STRONG,
        _ => QUIET,
    };
    let how = match event.ending {
        Some(EndingKind::Ok) => "OK".to_owned(),
        Some(EndingKind::Interrupted) => "Interrupted".to_owned(),
        Some(EndingKind::Error) => format!("Error: {fault_text} ({fault})"),
        None => "somehow".to_owned(),
    };
    format!("{style}■ {component} ended: {how}{style:#}")
}
