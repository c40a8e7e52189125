//! Units of one word: the only list of them. Compiler and run time make composed ones of these.

use crate::{Scale, Unit};

/// A unit of one word, such as `cm`, and how many SI units it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SingleUnit {
    /// How it is written.
    pub symbol: &'static str,
    /// What it measures, as the language calls it.
    pub quantity: &'static str,
    /// The factor to SI, before the power of ten.
    pub numerator: u64,
    /// The power of ten of the factor to SI.
    pub exponent: i32,
}

const fn single(
    symbol: &'static str,
    quantity: &'static str,
    numerator: u64,
    exponent: i32,
) -> SingleUnit {
    SingleUnit { symbol, quantity, numerator, exponent }
}

impl SingleUnit {
    /// All of them.
    pub const ALL: &'static [SingleUnit] = &[
        single("m", "length", 1, 0),
        single("km", "length", 1, 3),
        single("cm", "length", 1, -2),
        single("mm", "length", 1, -3),
        single("um", "length", 1, -6),
        single("rad", "angle", 1, 0),
        single("mrad", "angle", 1, -3),
        single("deg", "angle", 1, 0),
        single("s", "duration", 1, 0),
        single("ms", "duration", 1, -3),
        single("us", "duration", 1, -6),
        single("ns", "duration", 1, -9),
        single("min", "duration", 60, 0),
        single("h", "duration", 3600, 0),
        single("kg", "mass", 1, 0),
        single("g", "mass", 1, -3),
        single("N", "force", 1, 0),
        single("mN", "force", 1, -3),
        single("kN", "force", 1, 3),
        single("V", "voltage", 1, 0),
        single("mV", "voltage", 1, -3),
        single("K", "temperature", 1, 0),
        single("degC", "temperature", 1, 0),
        single("Hz", "frequency", 1, 0),
        single("kHz", "frequency", 1, 3),
        single("MHz", "frequency", 1, 6),
    ];

    /// Those of a quantity.
    pub fn of(quantity: &str) -> impl Iterator<Item = &'static SingleUnit> {
        SingleUnit::ALL.iter().filter(move |single| single.quantity == quantity)
    }

    /// The exponent of the degree in it, each worth [`crate::RADIANS_PER_DEGREE`].
    pub fn degrees(&self) -> i32 {
        i32::from(self.symbol == "deg")
    }

    /// Whether it is `degC`, which has an offset.
    pub fn is_celsius(&self) -> bool {
        self.symbol == "degC"
    }

    /// The unit, for numbers that become SI; not for `degC`.
    pub fn unit(&self) -> Unit<'static> {
        let si = SingleUnit { numerator: 1, exponent: 0, symbol: "", ..*self };
        Unit { name: self.symbol, scale: self.over(&si) }
    }

    /// How often another unit goes into this one: what makes numbers of this unit such of the other one. Of a length over a
    /// time it makes metres a second.
    pub fn over(&self, other: &SingleUnit) -> Scale {
        let (shift, degrees) = (self.exponent - other.exponent, self.degrees() - other.degrees());
        Scale::factor(self.numerator, other.numerator, shift, degrees)
    }
}

#[cfg(test)]
mod tests {
    use super::SingleUnit;
    use crate::parse_quantity;

    fn single(symbol: &str) -> &'static SingleUnit {
        SingleUnit::ALL.iter().find(|single| single.symbol == symbol).unwrap()
    }

    #[test]
    fn numbers_of_a_unit_become_those_of_another() {
        for (unit, other, number) in
            [("deg", "deg", 1.0), ("mrad", "rad", 0.001), ("km", "h", 1000.0 / 3600.0)]
        {
            let scale = single(unit).over(single(other));
            let read = parse_quantity("1x", [crate::Unit { name: "x", scale }]);
            assert_eq!(read, Ok(number), "{unit} over {other}");
        }
        let turn = single("rad").over(single("deg"));
        let read = parse_quantity("2x", [crate::Unit { name: "x", scale: turn }]).unwrap();
        assert!((read.to_radians() - 2.0).abs() < 1e-15);
        let times = || SingleUnit::of("duration").map(SingleUnit::unit);
        assert_eq!(parse_quantity("1.5 min", times()), Ok(90.0));
        assert_eq!(parse_quantity("180deg", [single("deg").unit()]), Ok(core::f64::consts::PI));
    }
}
