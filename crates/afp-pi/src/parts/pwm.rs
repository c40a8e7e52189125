//! A PWM channel of the kernel, in `/sys/class/pwm`: of the Raspberry Pi itself, or of a PCA9685
//! with the kernel's driver.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};

use embedded_hal::pwm::{ErrorKind, ErrorType, SetDutyCycle};

/// The system's rules give the files of a new channel to the user within this time.
const PATIENCE: Duration = Duration::from_secs(1);

#[derive(Debug)]
pub(crate) struct Pwm {
    duty: File,
    /// Nanoseconds of one step.
    step: u32,
    steps: u16,
}

/// The error of a PWM channel.
#[derive(Debug)]
pub(crate) struct Failed(io::Error);

impl Pwm {
    /// Opens a channel such as `pwmchip0/1` below `root`, without power. A period has `steps` steps
    /// of `step` nanoseconds.
    pub(crate) fn open(root: &Path, channel: &str, (step, steps): (u32, u16)) -> io::Result<Self> {
        let (chip, number) = channel.split_once('/').unwrap_or((channel, ""));
        let folder = root.join(chip).join(format!("pwm{number}"));
        let named = |path: &Path, error: io::Error| {
            io::Error::new(error.kind(), format!("{}: {error}", path.display()))
        };
        if !folder.is_dir() {
            let export = root.join(chip).join("export");
            fs::write(&export, number).map_err(|error| named(&export, error))?;
        }
        let since = Instant::now();
        let set = |name: &str, value: &str| loop {
            let path = folder.join(name);
            match File::options().write(true).open(&path).and_then(|mut file| {
                file.write_all(value.as_bytes())?;
                Ok(file)
            }) {
                Ok(file) => return Ok(file),
                Err(_) if since.elapsed() < PATIENCE => sleep(Duration::from_millis(20)),
                Err(error) => return Err(named(&path, error)),
            }
        };
        // A period shorter than the duty of an earlier program is refused.
        set("duty_cycle", "0").or_else(|_| set("enable", "0"))?;
        set("period", &(u64::from(step) * u64::from(steps)).to_string())?;
        let duty = set("duty_cycle", "0")?;
        set("enable", "1")?;
        Ok(Pwm { duty, step, steps })
    }

    fn write(&mut self, duty: u16) -> io::Result<()> {
        let mut text = [0; 24];
        let mut rest = &mut text[..];
        write!(rest, "{}", u64::from(self.step) * u64::from(duty))?;
        let length = 24 - rest.len();
        self.duty.write_all(text.get(..length).unwrap_or_default())
    }
}

impl ErrorType for Pwm {
    type Error = Failed;
}

impl embedded_hal::pwm::Error for Failed {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

impl std::fmt::Display for Failed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the PWM cannot be set: {}", self.0)
    }
}

impl std::error::Error for Failed {}

impl SetDutyCycle for Pwm {
    fn max_duty_cycle(&self) -> u16 {
        self.steps
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Failed> {
        self.write(duty).map_err(Failed)
    }
}

impl Drop for Pwm {
    fn drop(&mut self) {
        // Nothing can be done about an error here; the guard cuts the power, too.
        let _ = self.write(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_channel_starts_without_power_and_ends_without_power() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("pwmchip0/pwm1");
        fs::create_dir_all(&folder).unwrap();
        for name in ["period", "duty_cycle", "enable"] {
            fs::write(folder.join(name), "").unwrap();
        }
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        let mut pwm = Pwm::open(place.path(), "pwmchip0/1", (50, 1000)).unwrap();
        assert_eq!([read("period"), read("enable")], ["50000", "1"]);
        pwm.set_duty_cycle(pwm.max_duty_cycle()).unwrap();
        // A file of the kernel takes each write as a value; this one keeps them all.
        assert_eq!(read("duty_cycle"), "050000");
        drop(pwm);
        assert!(read("duty_cycle").ends_with("500000"));
        let missing = Pwm::open(place.path(), "pwmchip7/0", (50, 1000)).unwrap_err();
        assert!(missing.to_string().contains("pwmchip7/export"), "{missing}");
    }
}
