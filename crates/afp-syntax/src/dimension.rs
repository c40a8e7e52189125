//! Dimensions of quantities, as exponents of base dimensions.

use afp_types::{Powers, SiUnit};

/// Exponents of the base dimensions; all are zero for a plain number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Metre.
    pub length: i8,
    /// Kilogram.
    pub mass: i8,
    /// Second.
    pub time: i8,
    /// Radian: a separate dimension, so that angles and lengths cannot be confused.
    pub angle: i8,
    /// Kelvin.
    pub temperature: i8,
    /// Volt: a base dimension here, because plans have no currents.
    pub voltage: i8,
}

impl Dimension {
    /// A plain number.
    pub const NONE: Dimension =
        Dimension { length: 0, mass: 0, time: 0, angle: 0, temperature: 0, voltage: 0 };
    pub const DURATION: Dimension = Dimension { time: 1, ..Dimension::NONE };
}

/// The dimensions with a name in the language, each with its common unit.
const NAMED: &[(&str, Dimension, &str)] = &[
    ("length", Dimension { length: 1, ..Dimension::NONE }, "cm"),
    ("angle", Dimension { angle: 1, ..Dimension::NONE }, "deg"),
    ("duration", Dimension::DURATION, "s"),
    ("speed", Dimension { length: 1, time: -1, ..Dimension::NONE }, "cm/s"),
    ("angular_speed", Dimension { angle: 1, time: -1, ..Dimension::NONE }, "deg/s"),
    ("acceleration", Dimension { length: 1, time: -2, ..Dimension::NONE }, "m/s^2"),
    ("mass", Dimension { mass: 1, ..Dimension::NONE }, "kg"),
    ("force", Dimension { length: 1, mass: 1, time: -2, ..Dimension::NONE }, "N"),
    ("voltage", Dimension { voltage: 1, ..Dimension::NONE }, "V"),
    ("temperature", Dimension { temperature: 1, ..Dimension::NONE }, "K"),
    ("frequency", Dimension { time: -1, ..Dimension::NONE }, "Hz"),
];

impl Dimension {
    pub fn names() -> impl Iterator<Item = &'static str> {
        NAMED.iter().map(|(name, ..)| *name)
    }

    /// The dimension of a name such as `length` or `force`.
    pub fn named(name: &str) -> Option<Dimension> {
        NAMED.iter().find(|(known, ..)| *known == name).map(|(_, dimension, _)| *dimension)
    }

    /// The dimension of a product; `None` if an exponent leaves -128..=127.
    pub fn times(self, other: Dimension) -> Option<Dimension> {
        self.zip(other, i8::checked_add)
    }

    /// The dimension of a quotient; `None` if an exponent leaves -128..=127.
    pub fn over(self, other: Dimension) -> Option<Dimension> {
        self.zip(other, i8::checked_sub)
    }

    /// The dimension of a power; `None` if an exponent leaves -128..=127.
    pub fn power(self, exponent: i8) -> Option<Dimension> {
        self.zip(self, |own, _| own.checked_mul(exponent))
    }

    /// The dimension of a square root; `None` if an exponent is odd.
    pub fn root(self) -> Option<Dimension> {
        self.zip(self, |exponent, _| (exponent % 2 == 0).then_some(exponent / 2))
    }

    /// A common unit of the dimension; empty for a plain number.
    pub fn usual_unit(self) -> String {
        match NAMED.iter().find(|(_, dimension, _)| *dimension == self) {
            Some((.., usual)) => (*usual).to_owned(),
            None => self.si_unit(),
        }
    }

    /// The SI unit as in literals; empty for a plain number.
    pub fn si_unit(self) -> String {
        SiUnit(self.exponents()).to_string()
    }

    /// The name, or a product of names such as `length/duration^2`, as in types.
    pub fn name(self) -> String {
        if self == Dimension::NONE {
            return "float".to_owned();
        }
        match NAMED.iter().find(|(_, dimension, _)| *dimension == self) {
            Some((name, ..)) => (*name).to_owned(),
            None => {
                let words = ["length", "mass", "duration", "angle", "temperature", "voltage"];
                Powers { words, exponents: self.exponents(), leading_one: true }.to_string()
            }
        }
    }

    fn exponents(self) -> [i8; 6] {
        [self.length, self.mass, self.time, self.angle, self.temperature, self.voltage]
    }

    fn zip(self, other: Dimension, with: impl Fn(i8, i8) -> Option<i8>) -> Option<Dimension> {
        Some(Dimension {
            length: with(self.length, other.length)?,
            mass: with(self.mass, other.mass)?,
            time: with(self.time, other.time)?,
            angle: with(self.angle, other.angle)?,
            temperature: with(self.temperature, other.temperature)?,
            voltage: with(self.voltage, other.voltage)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Dimension;
    use crate::units::Unit;

    #[test]
    fn products_with_a_name_use_it() {
        let length = Dimension::named("length").unwrap();
        let time = Dimension::named("duration").unwrap();
        let speed = length.over(time).unwrap();
        assert_eq!(speed.name(), "speed");
        assert_eq!(speed.over(time).unwrap().name(), "acceleration");
        assert_eq!(length.power(2).unwrap().over(time).unwrap().name(), "length^2/duration");
        assert_eq!(time.power(-2).unwrap().name(), "1/duration^2");
        assert_eq!(Dimension::NONE.name(), "float");
    }

    #[test]
    fn si_units_are_read_back_as_the_same_dimension() {
        for exponents in [[1, 0, 0], [2, -1, 0], [0, 0, -2], [-1, -1, 3], [0, -1, 0]] {
            let [length, time, angle] = exponents;
            let dimension = Dimension { length, time, angle, ..Dimension::NONE };
            let unit = Unit::parse(&dimension.si_unit()).unwrap();
            assert_eq!(unit.dimension, dimension);
        }
    }

    #[test]
    fn roots_halve_exponents() {
        let speed = Dimension::named("speed").unwrap();
        assert_eq!(speed.power(2).unwrap().root(), Some(speed));
        assert_eq!((speed.root(), Dimension::NONE.root()), (None, Some(Dimension::NONE)));
    }

    #[test]
    fn exponents_do_not_overflow() {
        let length = Dimension::named("length").unwrap();
        assert_eq!(length.power(127).unwrap().times(length), None);
    }
}
