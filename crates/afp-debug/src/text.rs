//! Events as lines of the trace, from a run or its log.

use std::fmt;

use afp_core::trace::Cause;
use afp_session::{Datum, EndingKind, EventKind, FaultText, Miss, NamedOutcome, RunEvent};

/// An event in trace format, without its time; empty for a stimulus, which a trace does not
/// contain.
pub(crate) struct Line<'a>(pub &'a RunEvent);

/// The state or event, and its target.
fn outcome(outcome: &NamedOutcome) -> impl fmt::Display {
    fmt::from_fn(move |f| match &*outcome.target {
        "" => f.write_str(&outcome.name),
        target => write!(f, "{} -> {target}", outcome.name),
    })
}

fn value(value: &Datum, unit: &str) -> String {
    match value {
        Datum::Float(number) if !unit.is_empty() => format!("{number} {unit}"),
        other => other.to_string(),
    }
}

fn before(started: bool) -> &'static str {
    if started { "" } else { " before its start" }
}

impl Line<'_> {
    fn ended(
        &self,
        f: &mut fmt::Formatter<'_>,
        ending: EndingKind,
        fault: &FaultText,
    ) -> fmt::Result {
        let (component, FaultText { code, text }) = (&self.0.component.path, fault);
        match ending {
            EndingKind::Ok => write!(f, "{component} ended OK"),
            EndingKind::Interrupted => write!(f, "{component} ended Interrupted"),
            EndingKind::Error if code == afp_core::Fault::FAILED => {
                write!(f, "{component} ended Error({code}: {text})")
            }
            EndingKind::Error => write!(f, "{component} ended Error({code})"),
        }
    }

    fn missed(&self, f: &mut fmt::Formatter<'_>, miss: &Miss) -> fmt::Result {
        let Miss { lateness, skipped, cause } = miss;
        let cause = match cause {
            Some(Cause::LateRelease) => "late release",
            Some(Cause::LongPoll) => "long poll",
            None => "unknown cause",
        };
        let path = &self.0.component.path;
        write!(f, "{path} missed its deadline by {lateness} ({cause}, {skipped} skipped)")
    }
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use EventKind as Kind;
        let component = &self.0.component.path;
        match &self.0.kind {
            Kind::Unknown | Kind::Requested(_) => Ok(()),
            Kind::ClockWentBack { asked } => write!(f, "clock went back to {asked}"),
            Kind::StopRequested => f.write_str("stop requested"),
            Kind::Injected(outcome) => {
                write!(f, "{component} is made to report {}", outcome.name)
            }
            Kind::Polled(Err(fault)) => write!(f, "{component} polled: fault {}", fault.code),
            Kind::Polled(Ok(None)) => write!(f, "{component} polled: clear"),
            Kind::Polled(Ok(Some(event))) => write!(f, "{component} polled: {}", event.name),
            Kind::Missed(miss) => self.missed(f, miss),
            Kind::Event(at) => write!(f, "{component} event {}", outcome(&at.event)),
            Kind::AlreadyThere(at) => {
                write!(f, "{component} already there: {}", outcome(&at.event))
            }
            Kind::Interrupted => write!(f, "{component} interrupted"),
            Kind::Finished(state) => write!(f, "{component} finished {}", outcome(state)),
            Kind::Committed { entry, old, new, unit, .. } => {
                let [old, new] = [old, new].map(|it| value(it, unit));
                write!(f, "{component} commits {entry}: {old} -> {new}")
            }
            Kind::Input { port, value: read, unit } => {
                write!(f, "{component} reads {port} = {}", value(read, unit))
            }
            Kind::Started => write!(f, "{component} started"),
            Kind::Diverted { supervisor, .. } => {
                write!(f, "{component} diverted by {}", supervisor.path)
            }
            Kind::Resumed { supervisor } => write!(f, "{component} resumed by {}", supervisor.path),
            Kind::Suspended { supervisor, started } => {
                write!(f, "{component} suspended by {}{}", supervisor.path, before(*started))
            }
            Kind::Returned { away } => write!(f, "{component} returned after {away}"),
            Kind::Abandoned { started } => write!(f, "{component} abandoned{}", before(*started)),
            Kind::Held { started } => write!(f, "{component} held{}", before(*started)),
            Kind::Released => write!(f, "{component} released"),
            Kind::Faulted(FaultText { code, text }) => {
                write!(f, "{component} fault {code}: {text}")
            }
            Kind::Ended { ending, fault } => self.ended(f, *ending, fault),
            Kind::Lost(count) => write!(f, "{count} records lost"),
        }
    }
}
