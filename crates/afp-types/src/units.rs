//! Units of one word: the only list. Compiler and run time compose other units from these.
//!
//! To add a unit, add a line to [`SingleUnit::ALL`]. Tests compare the editors' grammars and the
//! lists in `docs/` with it; `AFP_BLESS=1` rewrites them: `cargo test -p afp-syntax --test
//! editors`, `cargo test -p afp-book units`.

use core::fmt;

use crate::{Scale, Unit};

/// A unit of one word, such as `cm`, and its SI factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SingleUnit {
    /// The symbol.
    pub symbol: &'static str,
    /// The quantity's name in the language.
    pub quantity: &'static str,
    /// The factor to SI, without the power of ten.
    pub numerator: u64,
    /// The power of ten of the factor to SI.
    pub exponent: i32,
    /// Long names in the singular: the language does not accept them but suggests the symbol.
    pub words: &'static [&'static str],
}

const fn single(
    symbol: &'static str,
    quantity: &'static str,
    (numerator, exponent): (u64, i32),
    words: &'static [&'static str],
) -> SingleUnit {
    SingleUnit { symbol, quantity, numerator, exponent, words }
}

impl SingleUnit {
    /// Every unit.
    pub const ALL: &'static [SingleUnit] = &[
        single("m", "length", (1, 0), &["meter", "metre"]),
        single("km", "length", (1, 3), &["kilometer", "kilometre"]),
        single("cm", "length", (1, -2), &["centimeter", "centimetre", "zentimeter"]),
        single("mm", "length", (1, -3), &["millimeter", "millimetre"]),
        single("um", "length", (1, -6), &[]),
        single("rad", "angle", (1, 0), &["radian"]),
        single("mrad", "angle", (1, -3), &[]),
        single("deg", "angle", (1, 0), &["degree", "grad", "degre"]),
        single("s", "duration", (1, 0), &["second", "sec", "seconde", "sekunde", "sekunden"]),
        single(
            "ms",
            "duration",
            (1, -3),
            &["millisecond", "msec", "milliseconde", "millisekunde", "millisekunden"],
        ),
        single("us", "duration", (1, -6), &["microsecond", "usec"]),
        single("ns", "duration", (1, -9), &["nanosecond"]),
        single("min", "duration", (60, 0), &["minute", "minuten"]),
        single("h", "duration", (3600, 0), &["hour", "hr", "heure", "stunde", "stunden"]),
        single("kg", "mass", (1, 0), &["kilogram"]),
        single("g", "mass", (1, -3), &["gram"]),
        single("N", "force", (1, 0), &["newton"]),
        single("mN", "force", (1, -3), &[]),
        single("kN", "force", (1, 3), &[]),
        single("V", "voltage", (1, 0), &["volt"]),
        single("mV", "voltage", (1, -3), &["millivolt"]),
        single("K", "temperature", (1, 0), &["kelvin"]),
        single("degC", "temperature", (1, 0), &["celsius"]),
        single("Hz", "frequency", (1, 0), &["hertz"]),
        single("kHz", "frequency", (1, 3), &[]),
        single("MHz", "frequency", (1, 6), &[]),
    ];

    /// The units of a quantity.
    pub fn of(quantity: &str) -> impl Iterator<Item = &'static SingleUnit> {
        SingleUnit::ALL.iter().filter(move |single| single.quantity == quantity)
    }

    /// The exponent of the degree, each worth [`crate::RADIANS_PER_DEGREE`].
    pub fn degrees(&self) -> i32 {
        i32::from(self.symbol == "deg")
    }

    /// Whether users combine it with prefixes: its symbol has none.
    pub fn takes_prefix(&self) -> bool {
        let rest = self.symbol.get(1..);
        let is_prefixed = SingleUnit::ALL.iter().any(|other| Some(other.symbol) == rest);
        self.numerator == 1 && !self.is_celsius() && !is_prefixed
    }

    /// Whether it is `degC`, which has an offset.
    pub fn is_celsius(&self) -> bool {
        self.symbol == "degC"
    }

    /// The unit for conversion to SI; not for `degC`.
    pub fn unit(&self) -> Unit<'static> {
        let si = SingleUnit { numerator: 1, exponent: 0, symbol: "", ..*self };
        Unit { name: self.symbol, scale: self.over(&si) }
    }

    /// The ratio to another unit, which converts numbers of this unit to the other. For a length
    /// over a time, it converts to metres a second.
    pub fn over(&self, other: &SingleUnit) -> Scale {
        let (shift, degrees) = (self.exponent - other.exponent, self.degrees() - other.degrees());
        Scale::factor(self.numerator, other.numerator, shift, degrees)
    }
}

/// The SI unit of a dimension, spelled as in literals; empty for a plain number. The exponents are
/// of metre, kilogram, second, radian, kelvin and volt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SiUnit(pub [i8; 6]);

impl fmt::Display for SiUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = ["m", "kg", "s", "rad", "K", "V"];
        match self.0 {
            [1, 1, -2, 0, 0, 0] => f.write_str("N"),
            [0, 0, -1, 0, 0, 0] => f.write_str("Hz"),
            exponents => Powers { words, exponents, leading_one: false }.fmt(f),
        }
    }
}

/// A product of powers, such as `m/s^2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Powers {
    /// The names of the base dimensions, in the order of [`SiUnit`].
    pub words: [&'static str; 6],
    /// Their exponents.
    pub exponents: [i8; 6],
    /// Format without positive exponents: `1/` first, otherwise negative exponents.
    pub leading_one: bool,
}

impl fmt::Display for Powers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let powers = || self.words.iter().zip(self.exponents.map(i32::from));
        let mut is_empty = true;
        for (word, exponent) in powers().filter(|(_, exponent)| *exponent > 0) {
            f.write_str(if is_empty { "" } else { "*" })?;
            power(f, word, exponent)?;
            is_empty = false;
        }
        if is_empty && self.leading_one {
            f.write_str("1")?;
            is_empty = false;
        }
        for (word, exponent) in powers().filter(|(_, exponent)| *exponent < 0) {
            match is_empty {
                true => write!(f, "{word}^{exponent}")?,
                false => {
                    f.write_str("/")?;
                    power(f, word, -exponent)?;
                }
            }
            is_empty = false;
        }
        Ok(())
    }
}

fn power(f: &mut fmt::Formatter<'_>, word: &str, exponent: i32) -> fmt::Result {
    match exponent {
        1 => f.write_str(word),
        exponent => write!(f, "{word}^{exponent}"),
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
    fn numbers_convert_between_units() {
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
