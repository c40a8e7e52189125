//! Durations outside of plans: in `afp.toml` and on the command line.

use afp_core::Duration;
use afp_types::{SingleUnit, parse_quantity};

/// Parses a duration such as `20s` or `1.5 ms`, to the nearest nanosecond.
///
/// # Errors
/// The expected format.
pub fn duration(text: &str) -> Result<Duration, String> {
    match parse_quantity(text, SingleUnit::of("duration").map(SingleUnit::unit)) {
        Ok(secs) if secs >= 0.0 => Ok(Duration::from_secs_f64(secs)),
        Ok(_) => Err("a time cannot be negative".to_owned()),
        Err(_) => Err("expected a number with its unit, such as 20s or 500ms".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_exact() {
        assert_eq!(duration("20s"), Ok(Duration::from_secs(20)));
        assert_eq!(duration("0.29 s"), Ok(Duration::from_millis(290)));
        assert_eq!(duration("1.5 min"), Ok(Duration::from_secs(90)));
        assert_eq!(duration("3us"), Ok(Duration::from_micros(3)));
        assert!(duration("20").is_err());
        assert!(duration("-1s").is_err());
        assert!(duration("20 m").is_err());
    }
}
