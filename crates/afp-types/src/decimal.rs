//! Number literals.

use crate::exact::{Scale, exact};

/// A number literal without a unit: `12`, `2.5`, `1e-3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimal<'a> {
    whole: &'a str,
    fraction: &'a str,
    power: i32,
}

/// Larger exponents mean zero or infinity.
const MAX_POWER: i32 = 1_000_000;

/// Length of the number literal at the start: digits, an optional fraction, an optional exponent;
/// zero without a literal.
pub fn number_length(text: &str) -> usize {
    let digits =
        |from: usize| text.bytes().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let byte = |at: usize| text.as_bytes().get(at).copied();
    let mut length = digits(0);
    if length > 0 && byte(length) == Some(b'.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    }
    if length > 0 && matches!(byte(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(byte(length + 1), Some(b'+' | b'-')));
        let power = digits(length + 1 + sign);
        if power > 0 {
            length += 1 + sign + power;
        }
    }
    length
}

impl<'a> Decimal<'a> {
    /// Parses a whole string.
    pub fn parse(text: &'a str) -> Option<Self> {
        if text.is_empty() || number_length(text) < text.len() {
            return None;
        }
        let (mantissa, power) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let beyond = if power.starts_with('-') { -MAX_POWER } else { MAX_POWER };
        let power = power.parse::<i32>().map_or(beyond, |power| power.clamp(-MAX_POWER, MAX_POWER));
        Some(Decimal { whole, fraction, power })
    }

    /// The digits as numbers, most significant first.
    pub fn digits(&self) -> impl Iterator<Item = u8> + use<'a> {
        self.whole.bytes().chain(self.fraction.bytes()).map(|byte| byte.wrapping_sub(b'0'))
    }

    /// The power of ten of the last digit.
    pub fn exponent(&self) -> i32 {
        let behind = i32::try_from(self.fraction.len()).unwrap_or(i32::MAX);
        self.power.saturating_sub(behind)
    }

    /// The value in SI units with a sign and a unit; `None` if it is not finite.
    pub fn value(&self, negative: bool, scale: Scale) -> Option<f64> {
        exact(self.digits(), self.exponent(), negative, scale)
    }
}
