//! A time that may be unknown because of a missing declaration.

use std::sync::Arc;

use crate::toolbox::Template;

/// A bound in nanoseconds, or the reason why it is unknown.
#[derive(Clone, Debug, Default)]
pub(super) struct Cost {
    time: u64,
    unknown: Option<Arc<str>>,
}

impl Cost {
    pub const ZERO: Cost = Cost { time: 0, unknown: None };

    pub fn unknown(reason: impl Into<Arc<str>>) -> Cost {
        Cost { time: 0, unknown: Some(reason.into()) }
    }

    /// The bound of one poll, start or interruption of a template.
    pub fn budget(template: &Template) -> Cost {
        match template.budget {
            Some(time) => Cost { time, unknown: None },
            None => Cost::unknown(format!("'{}' declares no budget", template.name)),
        }
    }

    /// The time from interruption to standstill of a template.
    pub fn stop(template: &Template) -> Cost {
        match template.stop {
            Some(time) => Cost { time, unknown: None },
            None => Cost::unknown(format!("'{}' declares no stop", template.name)),
        }
    }

    /// The sum.
    pub fn and(&self, other: &Cost) -> Cost {
        Cost {
            time: self.time.saturating_add(other.time),
            unknown: self.unknown.as_ref().or(other.unknown.as_ref()).cloned(),
        }
    }

    pub fn or(&self, other: &Cost) -> Cost {
        Cost {
            time: self.time.max(other.time),
            unknown: self.unknown.as_ref().or(other.unknown.as_ref()).cloned(),
        }
    }

    pub fn times(&self, count: u64) -> Cost {
        Cost { time: self.time.saturating_mul(count), unknown: self.unknown.clone() }
    }

    /// The known part of the bound.
    pub fn time(&self) -> u64 {
        self.time
    }

    /// Whether it exceeds another, as far as both are known.
    pub fn exceeds(&self, other: &Cost) -> bool {
        self.time > other.time
    }

    pub fn is_same(&self, other: &Cost) -> bool {
        self.time == other.time
    }

    pub fn known(&self) -> Result<u64, String> {
        match &self.unknown {
            None => Ok(self.time),
            Some(reason) => Err(reason.to_string()),
        }
    }
}
