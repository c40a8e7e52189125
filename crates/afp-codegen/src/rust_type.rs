//! Types of the language as types of Rust, and numbers as literals.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use crate::names::{camel, ident};
use afp_dsl::types::{Dimension, Enum, Object, Type};
use afp_types::RADIANS_PER_DEGREE;

/// The paths of types, for the generated code.
pub struct TypePaths<'a> {
    /// The prefix of the names in `afp_core`: its path with `::`, or nothing for imports.
    pub core: TokenStream,
    /// The prefix of the names in `afp_core::quantity`.
    pub quantity: TokenStream,
    pub choice: &'a dyn Fn(&Enum) -> TokenStream,
    pub object: &'a dyn Fn(&Object) -> TokenStream,
}

impl TypePaths<'_> {
    /// The type of a single value; an object's own type; `V` for `any` and `number`.
    pub fn value(&self, ty: &Type) -> TokenStream {
        match ty {
            Type::Bool => quote!(bool),
            Type::Int => quote!(i64),
            Type::Quantity(dimension) => self.quantity(*dimension),
            Type::Text => {
                let core = &self.core;
                quote!(#core Text)
            }
            Type::Enum(choices) => (self.choice)(choices),
            Type::Object(object) => (self.object)(object),
            Type::Any | Type::Number | Type::Discrete => quote!(V),
        }
    }

    /// The type of a quantity, by its alias if there is one.
    pub fn quantity(&self, dimension: Dimension) -> TokenStream {
        let quantity = &self.quantity;
        if dimension == Dimension::NONE {
            return quote!(f64);
        }
        if let Some(alias) = alias(dimension) {
            let alias = ident(alias);
            return quote!(#quantity #alias);
        }
        let Dimension { length, mass, time, angle, temperature, voltage } = dimension;
        let exponents = [length, mass, time, angle, temperature, voltage].map(int);
        quote!(#quantity Quantity<#(#exponents),*>)
    }

    /// A quantity made from the tokens of its SI value.
    pub fn quantity_from(&self, dimension: Dimension, value: TokenStream) -> TokenStream {
        if dimension == Dimension::NONE {
            return value;
        }
        let path = self.quantity(dimension);
        match alias(dimension) {
            Some(_) => quote!(#path::from_si(#value)),
            None => quote!(<#path>::from_si(#value)),
        }
    }

    /// A constant quantity; a round number of degrees uses its constructor.
    pub fn constant(&self, dimension: Dimension, value: f64) -> TokenStream {
        if let Some(degrees) = degrees(dimension, value) {
            let (path, degrees) = (self.quantity(dimension), float(degrees));
            return quote!(#path::from_deg(#degrees));
        }
        self.quantity_from(dimension, float(value))
    }
}

/// The name of a dimension in `afp_core::quantity`.
fn alias(dimension: Dimension) -> Option<&'static str> {
    Some(match dimension.name().as_str() {
        "length" => "Length",
        "angle" => "Angle",
        "duration" => "Time",
        "speed" => "Speed",
        "angular_speed" => "AngularSpeed",
        "acceleration" => "Acceleration",
        "mass" => "Mass",
        "force" => "Force",
        "voltage" => "Voltage",
        "temperature" => "Temperature",
        "frequency" => "Frequency",
        _ => return None,
    })
}

/// The degrees, or degrees a second, that make exactly this quantity, if they are round.
pub fn degrees(dimension: Dimension, value: f64) -> Option<f64> {
    let turns = matches!(alias(dimension), Some("Angle" | "AngularSpeed"));
    if turns { round_degrees(value) } else { None }
}

/// The degrees that make exactly this many radians, if they are a whole number of thousandths.
fn round_degrees(radians: f64) -> Option<f64> {
    let degrees = (radians / RADIANS_PER_DEGREE * 1e3).round() / 1e3;
    (degrees * RADIANS_PER_DEGREE == radians).then_some(degrees)
}

/// A finite number as a literal.
pub fn float(value: f64) -> TokenStream {
    let magnitude = value.abs();
    // Long runs of zeros are hard to read.
    let literal = if magnitude != 0.0 && !(1e-6..1e15).contains(&magnitude) {
        format!("{magnitude:e}").parse::<Literal>().ok()
    } else {
        None
    };
    let literal = literal.unwrap_or_else(|| Literal::f64_unsuffixed(magnitude));
    if value.is_sign_negative() { quote!(-#literal) } else { quote!(#literal) }
}

/// An integer as a literal.
pub fn int(value: impl Into<i64>) -> TokenStream {
    let value = value.into();
    let literal = Literal::u64_unsuffixed(value.unsigned_abs());
    if value < 0 { quote!(-#literal) } else { quote!(#literal) }
}

/// An integer literal with its type, if the context does not determine it.
pub fn long(value: i64) -> TokenStream {
    // The smallest integer has no literal with a sign.
    let Some(magnitude) = value.checked_abs() else { return quote!(i64::MIN) };
    let literal = Literal::i64_suffixed(magnitude);
    if value < 0 { quote!(-#literal) } else { quote!(#literal) }
}

/// The Rust name of an enum's value.
pub fn variant(choices: &Enum, index: u16) -> proc_macro2::Ident {
    ident(&camel(choices.variants.get(usize::from(index)).map_or("", |name| name)))
}

#[cfg(test)]
mod tests {
    use super::{float, int, round_degrees};
    use afp_types::RADIANS_PER_DEGREE;

    #[test]
    fn literals_are_read_back_as_the_same_number() {
        for value in [0.0, -0.0, 0.35, -1.5e-9, 1e300, 123456789.0, f64::MIN_POSITIVE] {
            let text = float(value).to_string().replace(' ', "");
            let read: f64 = text.parse().unwrap();
            assert_eq!(read.to_bits(), value.to_bits(), "{text}");
        }
        assert_eq!(int(i64::MIN).to_string().replace(' ', ""), "-9223372036854775808");
    }

    #[test]
    fn degrees_are_used_only_if_they_are_exact() {
        assert_eq!(round_degrees(-60.0 * RADIANS_PER_DEGREE), Some(-60.0));
        assert_eq!(round_degrees(22.5 * RADIANS_PER_DEGREE), Some(22.5));
        assert_eq!(round_degrees(1.0), None);
    }
}
