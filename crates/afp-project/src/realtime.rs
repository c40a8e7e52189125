//! How the control loop of a real robot runs: `[robot.realtime]` of a project, and `--set robot.realtime.NAME`.

use afp_core::Duration;

use crate::time::duration;

/// How the control loop of a real robot runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Realtime {
    /// The run ends if the control loop is later than this.
    pub stall: Option<Duration>,
    /// The FIFO priority of the control loop, 1 to 99.
    pub priority: Option<u8>,
    /// The number of the processor that the control loop runs on.
    pub cpu: Option<usize>,
}

impl Realtime {
    /// The first part of the settings' names, apart from those of the robot's driver.
    pub const PREFIX: &str = "realtime.";
    /// The names of the settings, without the prefix.
    pub const NAMES: [&str; 3] = ["stall", "priority", "cpu"];

    /// Sets the value of a name from its text.
    ///
    /// # Errors
    /// Says which values the name takes.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), &'static str> {
        match name {
            "stall" => {
                let limits = Duration::from_millis(1)..=Duration::from_secs(10);
                let stall = duration(text).ok().filter(|stall| limits.contains(stall));
                self.stall = Some(stall.ok_or("a time from 1 ms to 10 s, such as \"100 ms\"")?);
            }
            "priority" => {
                let priority = text.parse().ok().filter(|number| (1..=99).contains(number));
                self.priority = Some(priority.ok_or("a whole number from 1 to 99, such as 50")?);
            }
            _ => {
                let cpu = text.parse().ok().filter(|number| *number < 1024);
                self.cpu = Some(cpu.ok_or("the number of a processor, such as 3")?);
            }
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
        for (name, good, bad) in [
            ("stall", ["1ms", "100 ms", "10 s"], ["0 ms", "11 s", "100"]),
            ("priority", ["1", "50", "99"], ["0", "100", "high"]),
            ("cpu", ["0", "3", "1023"], ["-1", "1024", "all"]),
        ] {
            assert!(Realtime::NAMES.contains(&name));
            assert!(good.iter().all(|text| read.set(name, text).is_ok()), "{name}");
            assert!(bad.iter().all(|text| read.set(name, text).is_err()), "{name}");
        }
        let stall = Some(Duration::from_secs(10));
        assert_eq!(read, Realtime { stall, priority: Some(99), cpu: Some(1023) });
    }
}
