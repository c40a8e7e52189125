//! Quantities: numbers with a dimension.
//!
//! One type covers all of them. Its parameters are the exponents of the base dimensions, and its
//! value is in SI units. Quantities of one dimension add and compare; across dimensions, compute
//! with [`Quantity::si`].

use core::fmt;
use core::ops::{Add, Div, Mul, Neg, Sub};

use afp_types::SiUnit;

/// A value in SI units; parameters are the exponents of metre, kilogram, second, radian, kelvin
/// and volt.
#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
pub struct Quantity<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8>(
    f64,
);

/// Metres.
pub type Length = Quantity<1, 0, 0, 0, 0, 0>;
/// Radians, counter-clockwise.
pub type Angle = Quantity<0, 0, 0, 1, 0, 0>;
/// Seconds, as an entry or a port; the scheduler uses [`crate::Duration`].
pub type Time = Quantity<0, 0, 1, 0, 0, 0>;
/// Metres a second.
pub type Speed = Quantity<1, 0, -1, 0, 0, 0>;
/// Radians a second.
pub type AngularSpeed = Quantity<0, 0, -1, 1, 0, 0>;
/// Metres a second squared.
pub type Acceleration = Quantity<1, 0, -2, 0, 0, 0>;
/// Kilograms.
pub type Mass = Quantity<0, 1, 0, 0, 0, 0>;
/// Newtons.
pub type Force = Quantity<1, 1, -2, 0, 0, 0>;
/// Volts.
pub type Voltage = Quantity<0, 0, 0, 0, 0, 1>;
/// Kelvins.
pub type Temperature = Quantity<0, 0, 0, 0, 1, 0>;
/// Hertz.
pub type Frequency = Quantity<0, 0, -1, 0, 0, 0>;

macro_rules! impls {
    ($($trait:ident $(<$rhs:ty>)? :: $method:ident ($self:ident $(, $other:ident)?) -> $out:ty = $body:expr;)*) => {$(
        impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8>
            $trait$(<$rhs>)? for Quantity<M, KG, S, RAD, K, V>
        {
            type Output = $out;
            fn $method($self $(, $other: $rhs)?) -> $out {
                $body
            }
        }
    )*};
}

impls! {
    Neg::neg(self) -> Self = Self(-self.0);
    Add<Self>::add(self, other) -> Self = Self(self.0 + other.0);
    Sub<Self>::sub(self, other) -> Self = Self(self.0 - other.0);
    Mul<f64>::mul(self, other) -> Self = Self(self.0 * other);
    Div<f64>::div(self, other) -> Self = Self(self.0 / other);
    Div<Self>::div(self, other) -> f64 = self.0 / other.0;
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8>
    Quantity<M, KG, S, RAD, K, V>
{
    /// Makes a quantity from its SI value.
    pub const fn from_si(value: f64) -> Self {
        Quantity(value)
    }

    /// The value in SI units.
    pub const fn si(self) -> f64 {
        self.0
    }

    /// The absolute value.
    pub const fn abs(self) -> Self {
        Quantity(self.0.abs())
    }
}

impl Angle {
    /// Converts degrees: the double product with pi / 180.
    pub const fn from_deg(degrees: f64) -> Self {
        Quantity(degrees * (core::f64::consts::PI / 180.0))
    }
}

impl AngularSpeed {
    /// Converts degrees a second: the double product with pi / 180.
    pub const fn from_deg(degrees: f64) -> Self {
        Quantity(degrees * (core::f64::consts::PI / 180.0))
    }
}

impl Time {
    /// The duration in whole nanoseconds; negative counts as zero.
    pub fn duration(self) -> crate::Duration {
        crate::Duration::from_secs_f64(self.0)
    }
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> fmt::Debug
    for Quantity<M, KG, S, RAD, K, V>
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<const M: i8, const KG: i8, const S: i8, const RAD: i8, const K: i8, const V: i8> fmt::Display
    for Quantity<M, KG, S, RAD, K, V>
{
    /// The value and its SI unit: `0.3 m/s`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)?;
        match SiUnit([M, KG, S, RAD, K, V]) {
            SiUnit([0, 0, 0, 0, 0, 0]) => Ok(()),
            unit => write!(f, " {unit}"),
        }
    }
}
