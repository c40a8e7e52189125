//! What a plan shall run on: how fine its time is, and how much of the processor plans may use.

/// Share of the processor that plans may use where none is given.
const DEFAULT_CAPACITY: f64 = 0.7;

/// A machine that runs plans.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name.
    pub name: String,
    /// The grain of its time in nanoseconds: nothing happens more often, and what is due may be
    /// noticed so much later. `None` where it is not known.
    pub tick: Option<u64>,
    /// The share of the processor that a plan may ask for, more than 0 and at most 1.
    pub capacity: f64,
}

/// The targets that are known everywhere: name, tick in nanoseconds, capacity.
///
/// On Linux the tick is what a timer of a thread without slack is late by on a machine that is not
/// overloaded; the microcontroller has a timer of its own.
pub const BUILT_IN: &[(&str, u64, f64)] = &[
    ("host", 50_000, DEFAULT_CAPACITY),
    ("pi", 100_000, DEFAULT_CAPACITY),
    ("pi32", 100_000, DEFAULT_CAPACITY),
    ("mcu", 10_000, DEFAULT_CAPACITY),
];

impl Target {
    /// The built-in target of that name.
    pub fn built_in(name: &str) -> Option<Target> {
        let (name, tick, capacity) = BUILT_IN.iter().find(|(known, ..)| *known == name)?;
        Some(Target { name: (*name).to_owned(), tick: Some(*tick), capacity: *capacity })
    }

    /// The target of that name with what is known of it otherwise: tick in nanoseconds, capacity.
    /// What is not given is as in the built-in one of that name.
    pub fn new(name: &str, tick: Option<u64>, capacity: Option<f64>) -> Target {
        let known = Target::built_in(name);
        let usual = known.as_ref().map_or(DEFAULT_CAPACITY, |known| known.capacity);
        Target {
            name: name.to_owned(),
            tick: tick.or(known.and_then(|known| known.tick)),
            capacity: capacity.unwrap_or(usual),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Target;

    #[test]
    fn a_target_of_a_built_in_name_changes_what_it_says() {
        let pi = Target { capacity: 0.5, ..Target::built_in("pi").unwrap() };
        assert_eq!(Target::new("pi", None, Some(0.5)), pi);
        let toy = Target { name: "toy".to_owned(), tick: None, capacity: 0.7 };
        assert_eq!(Target::new("toy", None, None), toy);
    }
}
