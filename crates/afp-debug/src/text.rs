//! What happened as a line of the trace, from a run or from its log.

use std::fmt;

use afp_core::trace::Cause;
use afp_session::{Datum, EndingKind, EventKind, Miss, RunEvent};

/// An event as in the trace, without its time; nothing for what comes from outside, which no trace has.
pub(crate) struct Line<'a>(pub &'a RunEvent);

impl Line<'_> {
    /// The state or event, and where it leads.
    fn outcome(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.outcome)?;
        match &*self.0.target {
            "" => Ok(()),
            target => write!(f, " -> {target}"),
        }
    }

    fn value(&self, value: &Option<Datum>) -> String {
        match (value, &*self.0.unit) {
            (None, _) => Datum::Unset.to_string(),
            (Some(Datum::Number(number)), unit) if !unit.is_empty() => format!("{number} {unit}"),
            (Some(other), _) => other.to_string(),
        }
    }

    fn ended(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RunEvent { component, fault, fault_text, ending, .. } = self.0;
        match ending {
            Some(EndingKind::Ok) => write!(f, "{component} ended OK"),
            Some(EndingKind::Interrupted) => write!(f, "{component} ended Interrupted"),
            Some(EndingKind::Error) if fault == afp_core::Fault::FAILED => {
                write!(f, "{component} ended Error({fault}: {fault_text})")
            }
            Some(EndingKind::Error) => write!(f, "{component} ended Error({fault})"),
            None => write!(f, "{component} ended"),
        }
    }

    fn missed(&self, f: &mut fmt::Formatter<'_>, miss: Miss) -> fmt::Result {
        let Miss { lateness, skipped, cause } = miss;
        let cause = match cause {
            Some(Cause::LateRelease) => "late release",
            Some(Cause::LongPoll) => "long poll",
            None => "unknown cause",
        };
        let path = &self.0.component;
        write!(f, "{path} missed its deadline by {lateness} ({cause}, {skipped} skipped)")
    }
}

impl fmt::Display for Line<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use EventKind as Kind;
        let RunEvent { component, entry, fault, fault_text, outcome, .. } = self.0;
        match self.0.kind {
            Kind::Unknown | Kind::Requested => Ok(()),
            Kind::ClockWentBack => {
                write!(f, "clock went back to {}", self.0.asked.unwrap_or_default())
            }
            Kind::StopRequested => f.write_str("stop requested"),
            Kind::Injected => write!(f, "{component} is made to report {outcome}"),
            Kind::Polled if !fault.is_empty() => write!(f, "{component} polled: fault {fault}"),
            Kind::Polled if outcome.is_empty() => write!(f, "{component} polled: clear"),
            Kind::Polled => write!(f, "{component} polled: {outcome}"),
            Kind::Missed => self.0.missed.map_or(Ok(()), |miss| self.missed(f, miss)),
            Kind::Event => {
                write!(f, "{component} event ")?;
                self.outcome(f)
            }
            Kind::AlreadyThere => {
                write!(f, "{component} already there: ")?;
                self.outcome(f)
            }
            Kind::Interrupted => write!(f, "{component} interrupted"),
            Kind::Finished => {
                write!(f, "{component} finished ")?;
                self.outcome(f)
            }
            Kind::Committed => {
                let (old, new) = (self.value(&self.0.old), self.value(&self.0.value));
                write!(f, "{component} commits {entry}: {old} -> {new}")
            }
            Kind::Input => {
                let (port, value) = (&self.0.port, self.value(&self.0.value));
                write!(f, "{component} reads {port} = {value}")
            }
            Kind::Started => write!(f, "{component} started"),
            Kind::Diverted => write!(f, "{component} diverted by {}", self.0.supervisor),
            Kind::Resumed => write!(f, "{component} resumed by {}", self.0.supervisor),
            Kind::Faulted => write!(f, "{component} fault {fault}: {fault_text}"),
            Kind::Ended => self.ended(f),
            Kind::Lost => write!(f, "{} records lost", self.0.lost),
        }
    }
}
