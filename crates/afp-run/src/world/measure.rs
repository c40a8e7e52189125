//! The measures of numbers in a world's file, and their units on a command line, which are those of
//! plans.

use afp_core::rt::{Scale, Unit, parse_quantity};
use afp_session::some_units;
use afp_types::SingleUnit;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    Length,
    Angle,
    Speed,
    Mass,
    Time,
}

impl Measure {
    /// The measure of a key, from the end of its name, or of a position in its list; `None` for
    /// plain numbers.
    pub(super) fn of(key: &str, place: Option<usize>) -> Option<Measure> {
        let ends = |end: &str| key.ends_with(end);
        match place {
            Some(2) if ends("_m_deg") => Some(Measure::Angle),
            None if ends("_deg") && !ends("_m_deg") => Some(Measure::Angle),
            _ if ends("_m") || ends("_m_deg") => Some(Measure::Length),
            _ if ends("_m_s") => Some(Measure::Speed),
            _ if ends("_kg") => Some(Measure::Mass),
            _ if ends("_s") => Some(Measure::Time),
            _ => None,
        }
    }

    /// Reads a number with a unit and converts it to the unit of files: SI units, but degrees.
    ///
    /// # Errors
    /// The expected form.
    pub(crate) fn read(self, text: &str) -> Result<f64, String> {
        let units = self.units();
        let all = units.iter().map(|(name, scale)| Unit { name, scale: *scale });
        parse_quantity(text, all).map_err(|_| {
            let names = units.iter().map(|(name, _)| name.as_str());
            format!("expected a number with a unit: {}", some_units(names))
        })
    }

    /// The units, as multiples of the unit of files.
    fn units(self) -> Vec<(String, Scale)> {
        let (quantity, base) = match self {
            Measure::Length => ("length", "m"),
            Measure::Angle => ("angle", "deg"),
            Measure::Speed => return speeds(),
            Measure::Mass => ("mass", "kg"),
            Measure::Time => ("duration", "s"),
        };
        let base = SingleUnit::of(quantity).find(|unit| unit.symbol == base);
        let one = |unit: &SingleUnit| (unit.symbol.to_owned(), unit.over(base.unwrap_or(unit)));
        SingleUnit::of(quantity).map(one).collect()
    }
}

/// All lengths over all times.
fn speeds() -> Vec<(String, Scale)> {
    let per = |time: &'static SingleUnit| {
        SingleUnit::of("length")
            .map(move |length| (format!("{}/{}", length.symbol, time.symbol), length.over(time)))
    };
    SingleUnit::of("duration").flat_map(per).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_all_units_of_plans() {
        for (measure, text, value) in [
            (Measure::Length, "100um", 0.0001),
            (Measure::Length, "1.5 km", 1500.0),
            (Measure::Angle, "90deg", 90.0),
            (Measure::Angle, "1000mrad", 1.0_f64.to_degrees()),
            (Measure::Speed, "36km/h", 10.0),
            (Measure::Speed, "30cm/s", 0.3),
            (Measure::Mass, "500g", 0.5),
            (Measure::Time, "1min", 60.0),
            (Measure::Time, "5us", 5e-6),
        ] {
            assert_eq!(measure.read(text), Ok(value), "{text}");
        }
        let expected = "expected a number with a unit: deg, rad, mrad";
        assert_eq!(Measure::Angle.read("1m").unwrap_err(), expected);
        assert!(Measure::Speed.read("1").unwrap_err().contains(": m/s, cm/s, mm/s, km/h, "));
    }
}
