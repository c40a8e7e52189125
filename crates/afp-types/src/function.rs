//! The functions of formulas: one table, and their values.
//!
//! The names of the values are those in generated code. An operand that is not finite is an error
//! if the result could hide it: the minimum of 5 and infinity is 5.

use crate::{Error, finite};

/// The types of operands and result. All operands are numbers of one dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signature {
    /// Returns one of its operands. Ints stay ints.
    Choice,
    /// Returns a value of its operand's type. Ints stay ints.
    Same,
    /// Returns a quantity of its operands' dimension.
    Quantity,
    /// Returns the square root of its operand's dimension.
    Root,
    /// Takes an angle and returns a plain number.
    OfAngle,
    /// Returns an angle.
    Angle,
}

/// Whether a function takes exactly the named operands, or also more.
const EXACTLY: bool = false;
const AT_LEAST: bool = true;

/// For which numbers a function can fail: ints, floats.
const NEVER: [bool; 2] = [false, false];
const INTS: [bool; 2] = [true, false];
const FLOATS: [bool; 2] = [false, true];
const BOTH: [bool; 2] = [true, true];

macro_rules! functions {
    ($($(#[$doc:meta])* $function:ident $name:literal $count:ident [$($operand:literal),*] $signature:ident $fails:ident;)*) => {
        /// A function of formulas.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function {
            $($(#[$doc])* $function,)*
        }

        impl Function {
            /// Every function.
            pub const ALL: &'static [Function] = &[$(Function::$function),*];

            /// The name in formulas.
            pub fn name(self) -> &'static str {
                match self {
                    $(Function::$function => $name,)*
                }
            }

            /// The name of its value in this module, for ints or for floats.
            pub fn rust_name(self, ints: bool) -> &'static str {
                match (self, ints) {
                    $(
                        (Function::$function, true) => concat!("int_", $name),
                        (Function::$function, false) => $name,
                    )*
                }
            }

            /// The names of its operands, and whether it accepts more.
            pub fn operands(self) -> (&'static [&'static str], bool) {
                match self {
                    $(Function::$function => (&[$($operand),*], $count),)*
                }
            }

            /// The types of operands and result.
            pub fn signature(self) -> Signature {
                match self {
                    $(Function::$function => Signature::$signature,)*
                }
            }

            /// Whether its value for ints or for floats is a `Result`.
            pub fn fails(self, ints: bool) -> bool {
                let [of_ints, of_floats] = match self {
                    $(Function::$function => $fails,)*
                };
                if ints { of_ints } else { of_floats }
            }
        }
    };
}

functions! {
    /// The absolute value.
    Abs "abs" EXACTLY ["a"] Same INTS;
    /// The minimum of two or more.
    Min "min" AT_LEAST ["a", "b"] Choice FLOATS;
    /// The maximum of two or more.
    Max "max" AT_LEAST ["a", "b"] Choice FLOATS;
    /// The first operand, clamped to the range from the second to the third.
    Clamp "clamp" EXACTLY ["value", "low", "high"] Choice BOTH;
    /// The square root.
    Sqrt "sqrt" EXACTLY ["a"] Root NEVER;
    /// The sine of an angle.
    Sin "sin" EXACTLY ["angle"] OfAngle NEVER;
    /// The cosine of an angle.
    Cos "cos" EXACTLY ["angle"] OfAngle NEVER;
    /// The angle of a point; `y` comes first.
    Atan2 "atan2" EXACTLY ["y", "x"] Angle FLOATS;
    /// The hypotenuse of two sides.
    Hypot "hypot" EXACTLY ["a", "b"] Quantity NEVER;
}

impl Function {
    /// The function with this name.
    pub fn named(name: &str) -> Option<Function> {
        Function::ALL.iter().copied().find(|function| function.name() == name)
    }

    /// Whether it accepts ints.
    pub fn takes_ints(self) -> bool {
        matches!(self.signature(), Signature::Choice | Signature::Same)
    }

    /// The value for floats; extra operands are ignored, and only two are compared.
    ///
    /// # Errors
    /// Those of the value's function. A result that is not finite is not an error here.
    #[inline]
    pub fn of_floats(self, [a, b, c]: [f64; 3]) -> Result<f64, Error> {
        Ok(match self {
            Function::Abs => abs(a),
            Function::Min => min(a, b)?,
            Function::Max => max(a, b)?,
            Function::Clamp => clamp(a, b, c)?,
            Function::Sqrt => sqrt(a),
            Function::Sin => sin(a),
            Function::Cos => cos(a),
            Function::Atan2 => atan2(a, b)?,
            Function::Hypot => hypot(a, b),
        })
    }

    /// The value for ints.
    ///
    /// # Errors
    /// As [`int_abs`] and [`int_clamp`]; [`Error::NotAValue`] for functions that accept only
    /// floats.
    #[inline]
    pub fn of_ints(self, [a, b, c]: [i64; 3]) -> Result<i64, Error> {
        match self {
            Function::Abs => int_abs(a),
            Function::Min => Ok(int_min(a, b)),
            Function::Max => Ok(int_max(a, b)),
            Function::Clamp => int_clamp(a, b, c),
            _ => Err(Error::NotAValue),
        }
    }
}

/// The absolute value.
///
/// # Errors
/// [`Error::Overflow`] for the least integer.
#[inline]
pub fn int_abs(a: i64) -> Result<i64, Error> {
    a.checked_abs().ok_or(Error::Overflow)
}

/// The minimum.
#[inline]
pub fn int_min(a: i64, b: i64) -> i64 {
    a.min(b)
}

/// The maximum.
#[inline]
pub fn int_max(a: i64, b: i64) -> i64 {
    a.max(b)
}

/// Clamps `value` to the range from `low` to `high`.
///
/// # Errors
/// [`Error::NoRange`] if `low` is above `high`.
#[inline]
pub fn int_clamp(value: i64, low: i64, high: i64) -> Result<i64, Error> {
    if low > high { Err(Error::NoRange) } else { Ok(value.max(low).min(high)) }
}

/// The absolute value.
#[inline]
pub fn abs(a: f64) -> f64 {
    libm::fabs(a)
}

/// The minimum.
///
/// # Errors
/// [`Error::NotFinite`] if an operand is not finite.
#[inline]
pub fn min(a: f64, b: f64) -> Result<f64, Error> {
    let (a, b) = (finite(a)?, finite(b)?);
    Ok(if a < b { a } else { b })
}

/// The maximum.
///
/// # Errors
/// [`Error::NotFinite`] if an operand is not finite.
#[inline]
pub fn max(a: f64, b: f64) -> Result<f64, Error> {
    let (a, b) = (finite(a)?, finite(b)?);
    Ok(if a > b { a } else { b })
}

/// Clamps `value` to the range from `low` to `high`.
///
/// # Errors
/// [`Error::NoRange`] if `low` is above `high`, [`Error::NotFinite`] if an operand is not finite.
#[inline]
pub fn clamp(value: f64, low: f64, high: f64) -> Result<f64, Error> {
    if low > high { Err(Error::NoRange) } else { min(max(value, low)?, high) }
}

/// The square root; NaN for negative numbers.
#[inline]
pub fn sqrt(a: f64) -> f64 {
    libm::sqrt(a)
}

/// The sine of an angle in radians.
#[inline]
pub fn sin(a: f64) -> f64 {
    libm::sin(a)
}

/// The cosine of an angle in radians.
#[inline]
pub fn cos(a: f64) -> f64 {
    libm::cos(a)
}

/// The angle of the point (x, y), from -pi to pi; zero for (0, 0).
///
/// # Errors
/// [`Error::NotFinite`] if an operand is not finite.
#[inline]
pub fn atan2(y: f64, x: f64) -> Result<f64, Error> {
    Ok(libm::atan2(finite(y)?, finite(x)?))
}

/// The hypotenuse of two sides.
#[inline]
pub fn hypot(a: f64, b: f64) -> f64 {
    libm::hypot(a, b)
}

#[cfg(test)]
mod tests {
    use super::Function;
    use crate::Error;

    #[test]
    fn an_operand_that_is_not_finite_never_gives_a_finite_value() {
        let operands = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        for function in Function::ALL {
            for place in 0..function.operands().0.len() {
                for operand in operands {
                    let mut all = [1.0, 1.0, 2.0];
                    all[place] = operand;
                    let value = function.of_floats(all);
                    assert!(!value.is_ok_and(f64::is_finite), "{function:?} of {all:?}: {value:?}");
                }
            }
        }
    }

    #[test]
    fn functions_fail_only_if_the_table_has_it() {
        for function in Function::ALL {
            let floats = [[f64::NAN, 1.0, 2.0], [1.0, 2.0, 1.0], [-1.0, f64::INFINITY, 2.0]];
            let fails = floats.into_iter().any(|floats| function.of_floats(floats).is_err());
            assert_eq!(function.fails(false), fails, "{function:?}");
            let ints = [[i64::MIN, 1, 2], [1, 2, 1]];
            let fails = ints.into_iter().any(|ints| function.of_ints(ints).is_err());
            assert!(!function.takes_ints() || function.fails(true) == fails, "{function:?}");
        }
    }

    #[test]
    fn bounds_in_the_wrong_order_are_an_error() {
        assert_eq!(Function::Clamp.of_floats([1.0, 2.0, 1.0]), Err(Error::NoRange));
        assert_eq!(Function::Clamp.of_ints([1, 2, 1]), Err(Error::NoRange));
        assert_eq!(Function::Clamp.of_ints([7, 2, 5]), Ok(5));
        assert_eq!(Function::Clamp.of_floats([-7.0, 2.0, 5.0]), Ok(2.0));
    }

    #[test]
    fn functions_have_their_values() {
        let float = |function: Function, a, b| function.of_floats([a, b, 0.0]).unwrap_or(f64::NAN);
        assert_eq!(float(Function::Abs, -2.5, 0.0), 2.5);
        assert_eq!((float(Function::Min, 1.0, -2.0), float(Function::Max, 1.0, -2.0)), (-2.0, 1.0));
        assert_eq!((float(Function::Sqrt, 9.0, 0.0), float(Function::Hypot, 3.0, 4.0)), (3.0, 5.0));
        assert_eq!(float(Function::Atan2, 1.0, 0.0), core::f64::consts::FRAC_PI_2);
        assert_eq!((float(Function::Sin, 0.0, 0.0), float(Function::Cos, 0.0, 0.0)), (0.0, 1.0));
        assert_eq!(Function::Abs.of_ints([i64::MIN, 0, 0]), Err(Error::Overflow));
        assert_eq!(
            (Function::Min.of_ints([3, 2, 9]), Function::Max.of_ints([3, 2, 9])),
            (Ok(2), Ok(3))
        );
        assert_eq!(Function::Sin.of_ints([1, 0, 0]), Err(Error::NotAValue));
    }

    #[test]
    fn names_are_found() {
        for function in Function::ALL {
            assert_eq!(Function::named(function.name()), Some(*function));
        }
        assert_eq!(Function::named("tan"), None);
    }
}
