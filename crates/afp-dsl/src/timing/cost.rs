//! A time that may not be known because a template does not declare it.

use std::sync::Arc;

use crate::toolbox::Template;

/// A bound in nanoseconds, or the reason why there is none.
#[derive(Clone, Debug, Default)]
pub(super) struct Cost {
    time: u64,
    unknown: Option<Arc<str>>,
}

impl Cost {
    /// Nothing at all.
    pub const ZERO: Cost = Cost { time: 0, unknown: None };

    /// No bound, for this reason.
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

    /// One after the other.
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

    /// So many times.
    pub fn times(&self, count: u64) -> Cost {
        Cost { time: self.time.saturating_mul(count), unknown: self.unknown.clone() }
    }

    /// The bound as far as it is known.
    pub fn time(&self) -> u64 {
        self.time
    }

    /// Whether it is more than another one, as far as both are known.
    pub fn exceeds(&self, other: &Cost) -> bool {
        self.time > other.time
    }

    /// Whether both are as much.
    pub fn is_same(&self, other: &Cost) -> bool {
        self.time == other.time
    }

    /// The bound, or the reason why there is none.
    pub fn known(&self) -> Result<u64, String> {
        match &self.unknown {
            None => Ok(self.time),
            Some(reason) => Err(reason.to_string()),
        }
    }
}
