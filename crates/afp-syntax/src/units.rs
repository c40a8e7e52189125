//! Units composed of single units ([`SingleUnit`]), such as `cm/s^2`.
//!
//! Lexer, checks and conversions from text read all units here. Values on a command line without a
//! plan (times, worlds) use the list of single units directly.

use afp_types::{Scale, SingleUnit};

use crate::dimension::Dimension;

/// The greatest exponent of a part of a composed unit, either sign.
const MAX_EXPONENT: i8 = 9;

/// A unit, single or composed, with its factor to SI as an exact fraction and a power of ten.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    pub dimension: Dimension,
    /// The numerator of the factor to SI.
    pub numerator: u64,
    /// The denominator of the factor to SI.
    pub denominator: u64,
    /// The power of ten of the factor to SI.
    pub exponent: i32,
    /// The exponent of the degree in it, each worth [`afp_types::RADIANS_PER_DEGREE`].
    pub degrees: i32,
    /// Whether it is `degC`, which has an offset.
    pub celsius: bool,
}

/// Common spellings that the language lacks, each with the correct one.
pub(crate) const FOREIGN: &[(&str, &str)] = &[
    ("°C", "degC"),
    ("°", "deg"),
    ("\u{b5}s", "us"),
    ("\u{3bc}s", "us"),
    ("\u{b5}m", "um"),
    ("\u{3bc}m", "um"),
];

/// Composed units as words (also with a final 's'), each with its symbol.
const WORDS: &[(&str, &str)] = &[("mps", "m/s"), ("kmh", "km/h"), ("kph", "km/h")];

impl Unit {
    /// The unit that an invalid word means: `degrees`, `CM`.
    pub fn meant(word: &str) -> Option<&'static str> {
        let small = word.to_ascii_lowercase();
        let one = small.strip_suffix('s').unwrap_or(&small);
        let changes_prefix = |symbol: &str| {
            let first = |text: &str| text.bytes().next().filter(|each| matches!(each, b'm' | b'M'));
            let rest = word.get(1..).unwrap_or_default();
            let alike = |base: &str| base.eq_ignore_ascii_case(rest);
            // `MM` is `mm` in capitals.
            let is_prefix = bases().any(|base| base.symbol == rest)
                || rest.len() > 1 && bases().any(|base| alike(base.symbol));
            is_prefix && first(symbol) != first(word)
        };
        let spells = |word: &&str| *word == one || *word == small;
        let single = SingleUnit::ALL.iter().find(|single| single.words.iter().any(spells));
        let composed = || WORDS.iter().find(|(word, _)| spells(word)).map(|(_, symbol)| *symbol);
        single.map(|single| single.symbol).or_else(composed).or_else(|| {
            let mut alike = Unit::symbols().filter(|symbol| symbol.eq_ignore_ascii_case(word));
            let plural = || Unit::symbols().find(|symbol| word.len() > 2 && *symbol == one);
            alike.find(|symbol| !changes_prefix(symbol)).or_else(plural)
        })
    }

    /// The meaning of a unit with an invalid prefix: its full name, the unit without the prefix,
    /// and the power of ten. `mHz` means a millihertz; it is not read as `MHz`, which is 10^9 times
    /// as much.
    pub fn strange_prefix(word: &str) -> Option<(String, &'static str, i32)> {
        let (prefix, exponent) = match word.bytes().next()? {
            b'm' => ("milli", -3),
            b'M' => ("mega", 6),
            _ => return None,
        };
        let is_small = exponent < 0;
        let fits = |base: &&SingleUnit| match is_small {
            true => base.symbol.eq_ignore_ascii_case(&word[1..]),
            false => base.symbol == &word[1..],
        };
        let base = bases().find(fits)?;
        let name = base.words.first()?;
        Unit::parse(word).is_none().then(|| (format!("{prefix}{name}"), base.symbol, exponent))
    }

    /// The power of a unit that an invalid word means: `s2`, `m3`.
    pub fn power_meant(word: &str) -> Option<String> {
        let unit = word.trim_end_matches(|each: char| each.is_ascii_digit());
        let power = format!("{unit}^{}", &word[unit.len()..]);
        Unit::parse(&power).map(|_| power)
    }

    /// The symbols of all single units.
    pub fn symbols() -> impl Iterator<Item = &'static str> {
        SingleUnit::ALL.iter().map(|single| single.symbol)
    }

    /// The unit of the whole text; `None` if it is not a unit.
    pub fn parse(text: &str) -> Option<Unit> {
        let (unit, length) = Unit::scan(text)?;
        (length == text.len()).then_some(unit)
    }

    /// The unit of a token of the tree, including foreign spellings, which the lexer has reported.
    pub fn of_token(text: &str) -> Option<Unit> {
        match FOREIGN.iter().find(|(sign, _)| text.starts_with(sign)) {
            Some((foreign, ours)) => Unit::parse(&format!("{ours}{}", &text[foreign.len()..])),
            None => Unit::parse(text),
        }
    }

    /// The longest unit at the start of `text` and its length in bytes.
    ///
    /// Parts are joined by `*` and `/` without white space; a joining sign without a unit after it
    /// is left alone.
    pub fn scan(text: &str) -> Option<(Unit, usize)> {
        let (mut unit, mut length) = part(text)?;
        while let Some(sign @ (b'*' | b'/')) = text.as_bytes().get(length) {
            let Some((next, more)) = part(&text[length + 1..]) else { break };
            let next = if *sign == b'/' { next.power(-1) } else { Some(next) };
            let Some(joined) = next.and_then(|next| unit.times(next)) else { break };
            unit = joined;
            length += 1 + more;
        }
        Some((unit, length))
    }

    /// The conversion of its numbers to SI.
    pub fn scale(self) -> Scale {
        if self.celsius {
            return Scale::Celsius;
        }
        Scale::factor(self.numerator, self.denominator, self.exponent, self.degrees)
    }

    fn times(self, other: Unit) -> Option<Unit> {
        if self.celsius || other.celsius {
            return None;
        }
        Some(Unit {
            dimension: self.dimension.times(other.dimension)?,
            numerator: self.numerator.checked_mul(other.numerator)?,
            denominator: self.denominator.checked_mul(other.denominator)?,
            exponent: self.exponent + other.exponent,
            degrees: self.degrees + other.degrees,
            celsius: false,
        })
    }

    fn power(self, exponent: i8) -> Option<Unit> {
        if self.celsius && exponent != 1 {
            return None;
        }
        let times = u32::from(exponent.unsigned_abs());
        let numerator = self.numerator.checked_pow(times)?;
        let denominator = self.denominator.checked_pow(times)?;
        let swap = exponent < 0;
        Some(Unit {
            dimension: self.dimension.power(exponent)?,
            numerator: if swap { denominator } else { numerator },
            denominator: if swap { numerator } else { denominator },
            exponent: self.exponent * i32::from(exponent),
            degrees: self.degrees * i32::from(exponent),
            celsius: self.celsius,
        })
    }
}

/// Units that people combine with prefixes.
fn bases() -> impl Iterator<Item = &'static SingleUnit> {
    SingleUnit::ALL.iter().filter(|single| single.takes_prefix())
}

/// A single unit with its exponent, and its length in bytes.
fn part(text: &str) -> Option<(Unit, usize)> {
    let word =
        text.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
    let single = SingleUnit::ALL.iter().find(|single| single.symbol == &text[..word])?;
    let unit = Unit {
        dimension: Dimension::named(single.quantity)?,
        numerator: single.numerator,
        denominator: 1,
        exponent: single.exponent,
        degrees: single.degrees(),
        celsius: single.is_celsius(),
    };
    match exponent(&text[word..]) {
        Some((exponent, more)) => unit.power(exponent).map(|unit| (unit, word + more)),
        None => Some((unit, word)),
    }
}

/// `^` and an exponent, and their length.
fn exponent(text: &str) -> Option<(i8, usize)> {
    let rest = text.strip_prefix('^')?;
    let sign = usize::from(rest.starts_with('-'));
    let digits = rest[sign..].bytes().take_while(u8::is_ascii_digit).count();
    let exponent: i8 = rest[..sign + digits].parse().ok()?;
    (exponent.unsigned_abs() <= MAX_EXPONENT.unsigned_abs())
        .then_some((exponent, 1 + sign + digits))
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[test]
    fn a_unit_is_greedy_but_takes_only_units() {
        assert_eq!(Unit::scan("cm/s)").unwrap().1, 4);
        assert_eq!(Unit::scan("cm/n").unwrap().1, 2);
        assert_eq!(Unit::scan("cm / s").unwrap().1, 2);
        assert_eq!(Unit::scan("m/s^2 + x").unwrap().1, 5);
        assert_eq!(Unit::scan("metre"), None);
    }

    #[test]
    fn composed_units_have_composed_dimensions() {
        assert_eq!(Unit::parse("km/h").unwrap().dimension.name(), "speed");
        assert_eq!(Unit::parse("deg/s").unwrap().dimension.name(), "angular_speed");
        assert_eq!(Unit::parse("kg*m/s^2").unwrap().dimension.name(), "force");
        assert_eq!(Unit::parse("s^-1").unwrap().dimension.name(), "frequency");
    }

    #[test]
    fn celsius_is_not_combined() {
        assert!(Unit::parse("degC").is_some());
        assert_eq!(Unit::parse("degC/s"), None);
        assert_eq!(Unit::parse("V/degC"), None);
    }

    #[test]
    fn absurd_units_are_rejected() {
        assert_eq!(Unit::parse("h^9*h^9"), None);
        assert_eq!(Unit::parse("m^99"), Unit::parse("m^100"));
    }
}
