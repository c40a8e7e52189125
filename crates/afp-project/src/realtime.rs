//! Settings of a real robot's control loop: `[robot.realtime]` of a project, and `--set
//! robot.realtime.NAME`.

use afp_core::Duration;

use crate::time::duration;

/// Settings of a real robot's control loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Realtime {
    /// The run ends if the control loop is later than this.
    pub stall: Option<Duration>,
}

impl Realtime {
    /// The prefix of the settings' names, which separates them from the driver's.
    pub const PREFIX: &str = "realtime.";
    /// The names of the settings, without the prefix.
    pub const NAMES: [&str; 1] = ["stall"];

    /// Sets a value from its text.
    ///
    /// # Errors
    /// The valid values.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), &'static str> {
        if Realtime::NAMES.contains(&name) {
            let limits = Duration::from_millis(1)..=Duration::from_secs(10);
            let stall = duration(text).ok().filter(|stall| limits.contains(stall));
            self.stall = Some(stall.ok_or("a time from 1 ms to 10 s, such as \"100 ms\"")?);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_limits() {
        let mut read = Realtime::default();
        assert!(["0 ms", "11 s", "100"].iter().all(|text| read.set("stall", text).is_err()));
        assert!(["1ms", "100 ms", "10 s"].iter().all(|text| read.set("stall", text).is_ok()));
        assert_eq!(read, Realtime { stall: Some(Duration::from_secs(10)) });
    }
}
