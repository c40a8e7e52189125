//! Axes of stimuli: presses and faults that differ between runs.
//!
//! The axis `press.touch` has points such as `@2s`, and the axis `fail.wheels.slip` has points such
//! as `=0.3@2s..4s`. The axes `press.*` and `fail.*` have lists of complete stimuli, which may be
//! empty.

use afp_core::Instant;
use afp_run::options::{self, Failure, Press};

/// The stimuli of a run or of a point.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Stimuli {
    pub presses: Vec<Press>,
    pub failures: Vec<Failure>,
}

/// Whether an axis with this name varies stimuli. No entry has such a name.
pub fn varies_stimuli(axis: &str) -> bool {
    parts(axis).is_some()
}

/// The kind of stimulus, and the name of the control or fault.
fn parts(axis: &str) -> Option<(bool, &str)> {
    let press = axis.strip_prefix("press.").map(|name| (true, name));
    press.or_else(|| axis.strip_prefix("fail.").map(|name| (false, name)))
}

impl Stimuli {
    /// Reads a point of an axis, and adds its stimuli.
    ///
    /// # Errors
    /// A syntax error.
    pub fn add(&mut self, axis: &str, point: &str) -> Result<(), String> {
        let Some((is_press, name)) = parts(axis) else { return Ok(()) };
        let mut add = |text: &str| {
            let said = |why| format!("'{text}': {why}");
            match is_press {
                true => self.presses.push(options::press(text).map_err(said)?),
                false => self.failures.push(options::failure(text).map_err(said)?),
            }
            Ok(())
        };
        match name {
            "*" => point.split_whitespace().try_for_each(add),
            name => add(&format!("{name}{point}")),
        }
    }

    /// The stimuli of axes and their points. Invalid points were rejected before.
    pub fn of<'a>(values: impl IntoIterator<Item = (&'a str, &'a str)>) -> Stimuli {
        let mut all = Stimuli::default();
        for (name, point) in values {
            let _ = all.add(name, point);
        }
        all
    }

    /// The instant of a single stimulus, in seconds.
    pub fn instant(&self) -> Option<f64> {
        let presses = self.presses.iter().map(|press| press.at);
        let mut all = presses.chain(self.failures.iter().map(|failure| failure.from));
        let first: Option<Instant> = all.next();
        first.filter(|_| all.next().is_none()).map(Instant::as_secs_f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(axis: &str, point: &str) -> Result<Stimuli, String> {
        let mut stimuli = Stimuli::default();
        stimuli.add(axis, point).map(|()| stimuli)
    }

    #[test]
    fn a_point_completes_the_name_of_its_axis() {
        let slip = read("fail.wheels.slip", "=0.3@2s..4s").unwrap();
        assert_eq!(slip.failures, [options::failure("wheels.slip=0.3@2s..4s").unwrap()]);
        assert_eq!(slip.instant(), Some(2.0));
        assert!(read("press.touch", "soon").is_err());
    }

    #[test]
    fn a_list_may_be_empty() {
        assert_eq!(read("press.*", "").unwrap(), Stimuli::default());
        let two = read("press.*", "touch@1s escape@2s").unwrap();
        assert_eq!((two.presses.len(), two.instant()), (2, None));
    }
}
