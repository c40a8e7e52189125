//! Settings of a real robot's control loop: `[robot.realtime]` of a project, and `--set
//! robot.realtime.NAME`.

use afp_core::Duration;

use crate::time::duration;

/// Settings of a real robot's control loop.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Realtime {
    /// The largest permitted delay of the control loop; a longer delay ends the run.
    pub stall: Option<Duration>,
    /// The FIFO priority of the control thread, 1 to 98; the watchdog has the next higher one.
    pub priority: Option<u8>,
    /// The processor on which the control thread runs.
    pub cpu: Option<u16>,
}

impl Realtime {
    /// The prefix of the settings' names, which separates them from the driver's.
    pub const PREFIX: &str = "realtime.";
    /// The names of the settings, without the prefix.
    pub const NAMES: [&str; 3] = ["stall", "priority", "cpu"];

    /// Sets a value from its text.
    ///
    /// # Errors
    /// The valid values.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), &'static str> {
        match name {
            "stall" => {
                let limits = Duration::from_millis(1)..=Duration::from_secs(10);
                let stall = duration(text).ok().filter(|stall| limits.contains(stall));
                self.stall = Some(stall.ok_or("a time from 1 ms to 10 s, such as \"100 ms\"")?);
            }
            "priority" => {
                let priority = text.parse().ok().filter(|priority| (1..=98).contains(priority));
                self.priority = Some(priority.ok_or("a whole number from 1 to 98")?);
            }
            "cpu" => {
                let cpu = text.parse().ok().filter(|cpu| *cpu < 1024);
                self.cpu = Some(cpu.ok_or("the number of a processor, from 0 to 1023")?);
            }
            _ => {}
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
        let wrong = [("priority", "0"), ("priority", "99"), ("priority", "high"), ("cpu", "1024")];
        assert!(wrong.iter().all(|(name, text)| read.set(name, text).is_err()));
        assert_eq!((read.set("priority", "98"), read.set("cpu", "0")), (Ok(()), Ok(())));
        let stall = Some(Duration::from_secs(10));
        assert_eq!(read, Realtime { stall, priority: Some(98), cpu: Some(0) });
    }
}
