//! The functions that formulas can call.

use crate::Error;

macro_rules! functions {
    ($($(#[$doc:meta])* $function:ident $name:literal $least:literal $($most:literal)?;)*) => {
        /// A function of formulas.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Function {
            $($(#[$doc])* $function,)*
        }

        impl Function {
            /// All of them.
            pub const ALL: &'static [Function] = &[$(Function::$function),*];

            /// How formulas call it.
            pub fn name(self) -> &'static str {
                match self {
                    $(Function::$function => $name,)*
                }
            }

            /// How many operands it takes: at least and at most, `None` for any number.
            pub fn operands(self) -> (usize, Option<usize>) {
                match self {
                    $(Function::$function => ($least, [$($most)?].first().copied()),)*
                }
            }
        }
    };
}

functions! {
    /// The value without its sign.
    Abs "abs" 1 1;
    /// The least of two or more.
    Min "min" 2;
    /// The greatest of two or more.
    Max "max" 2;
    /// The first operand, but at least the second one and at most the third one.
    Clamp "clamp" 3 3;
    /// The square root.
    Sqrt "sqrt" 1 1;
    /// The sine of an angle.
    Sin "sin" 1 1;
    /// The cosine of an angle.
    Cos "cos" 1 1;
    /// The angle of a point, of which `y` comes first.
    Atan2 "atan2" 2 2;
    /// The hypotenuse of two sides.
    Hypot "hypot" 2 2;
}

impl Function {
    /// The function of a name.
    pub fn named(name: &str) -> Option<Function> {
        Function::ALL.iter().copied().find(|function| function.name() == name)
    }

    /// Its value for numbers; operands that it does not have are not looked at, and of several only
    /// two are compared.
    ///
    /// # Errors
    /// As [`clamp`]. A result that is no number is one.
    #[inline]
    pub fn of_floats(self, [a, b, c]: [f64; 3]) -> Result<f64, Error> {
        Ok(match self {
            Function::Abs => abs(a),
            Function::Min => min(a, b),
            Function::Max => max(a, b),
            Function::Clamp => clamp(a, b, c)?,
            Function::Sqrt => sqrt(a),
            Function::Sin => sin(a),
            Function::Cos => cos(a),
            Function::Atan2 => atan2(a, b),
            Function::Hypot => hypot(a, b),
        })
    }

    /// Its value for integers, for those that have one.
    ///
    /// # Errors
    /// As [`int_abs`] and [`int_clamp`]; [`Error::NotAValue`] for functions of floats alone.
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

/// `a` without its sign.
///
/// # Errors
/// [`Error::Overflow`] for the least integer.
#[inline]
pub fn int_abs(a: i64) -> Result<i64, Error> {
    a.checked_abs().ok_or(Error::Overflow)
}

/// The smaller one.
#[inline]
pub fn int_min(a: i64, b: i64) -> i64 {
    a.min(b)
}

/// The greater one.
#[inline]
pub fn int_max(a: i64, b: i64) -> i64 {
    a.max(b)
}

/// `value`, but at least `low` and at most `high`.
///
/// # Errors
/// [`Error::NoRange`] when `low` is above `high`.
#[inline]
pub fn int_clamp(value: i64, low: i64, high: i64) -> Result<i64, Error> {
    if low > high { Err(Error::NoRange) } else { Ok(value.max(low).min(high)) }
}

/// `a` without its sign.
#[inline]
pub fn abs(a: f64) -> f64 {
    libm::fabs(a)
}

/// The smaller one; no number when one of them is none, so that a fault does not disappear.
#[inline]
pub fn min(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b { a } else { b }
}

/// The greater one; no number when one of them is none.
#[inline]
pub fn max(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// `value`, but at least `low` and at most `high`; no number when one of them is none.
///
/// # Errors
/// [`Error::NoRange`] when `low` is above `high`.
#[inline]
pub fn clamp(value: f64, low: f64, high: f64) -> Result<f64, Error> {
    if low > high { Err(Error::NoRange) } else { Ok(min(max(value, low), high)) }
}

/// The square root; no number for what is negative.
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
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
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
    fn what_is_no_number_stays_none() {
        let nan = f64::NAN;
        for function in [Function::Min, Function::Max, Function::Clamp] {
            for operands in [[nan, 1.0, 2.0], [1.0, nan, 2.0]] {
                assert!(function.of_floats(operands).is_ok_and(f64::is_nan), "{function:?}");
            }
        }
        assert!(Function::Clamp.of_floats([1.0, 0.0, nan]).is_ok_and(f64::is_nan));
    }

    #[test]
    fn bounds_the_wrong_way_round_are_an_error() {
        assert_eq!(Function::Clamp.of_floats([1.0, 2.0, 1.0]), Err(Error::NoRange));
        assert_eq!(Function::Clamp.of_ints([1, 2, 1]), Err(Error::NoRange));
        assert_eq!(Function::Clamp.of_ints([7, 2, 5]), Ok(5));
        assert_eq!(Function::Clamp.of_floats([-7.0, 2.0, 5.0]), Ok(2.0));
    }

    #[test]
    fn values_of_functions() {
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
