//! The text in the field of a value, and the controls next to the field.
//!
//! A client needs no grammar and no units: it shows the reading of a text, and asks for the text
//! after each use of a control.

use afp_dsl::types::text::{number, number_in, si_value, worth};
use afp_syntax::literal::Literal;
use afp_syntax::units::Unit;
use serde::{Deserialize, Serialize};

/// The most steps of a slider.
const MOST_STEPS: f64 = 1000.0;

/// The signs of the operations of formulas.
const OPERATIONS: [&str; 4] = ["+", "-", "*", "/"];

/// The meaning of a text in the field of a value.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Reading {
    pub text: String,
    /// The number, if the text is a number with or without a unit.
    pub number: Option<f64>,
    pub unit: String,
    /// A step with a visible effect: a round number in this unit.
    pub step: Option<f64>,
    /// The ends of a slider in this unit; `None` without limits, or if they are too far apart.
    pub slider: Option<[f64; 2]>,
    /// Whether an operation waits for its right operand.
    pub pending: bool,
}

/// A control next to the field. It changes the text.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Control {
    /// Goes to the next number of the step's grid.
    More,
    /// Goes to the previous number of the step's grid.
    Less,
    /// Changes the sign.
    Negate,
    /// Sets the number and keeps the unit.
    Number(f64),
    /// Converts the number to another unit.
    Unit(String),
    /// Adds an operation, which then waits for its right operand.
    Operation(String),
    /// Adds the right operand of an operation.
    Operand(String),
}

/// The units of a value, its step and its limits.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scale {
    pub units: Vec<String>,
    /// The step in SI units before rounding.
    pub step: Option<f64>,
    /// The limits in SI units.
    pub range: Option<(f64, f64)>,
}

impl Scale {
    /// Reads a text.
    pub fn read(&self, text: &str) -> Reading {
        let pending = OPERATIONS.iter().any(|sign| text.trim_end().ends_with(sign));
        let reading = Reading { text: text.to_owned(), pending, ..Reading::default() };
        let Some((number, unit)) = quantity(text) else { return reading };
        let step = self.step.map(|step| self.step_in(step, unit));
        let slider = step.and_then(|step| self.slider(step, unit));
        Reading { number: Some(number), unit: unit.to_owned(), step, slider, ..reading }
    }

    /// Returns the text after a use of a control; a control that does not fit changes nothing.
    pub fn after(&self, text: &str, control: &Control) -> String {
        let text = text.trim();
        let Reading { number, unit, step, pending, .. } = self.read(text);
        let known = number.zip(step);
        match (control, known) {
            (Control::More, Some((number, step))) => {
                spelled(step * ((number / step + 1e-9).floor() + 1.0), &unit)
            }
            (Control::Less, Some((number, step))) => {
                spelled(step * ((number / step - 1e-9).ceil() - 1.0), &unit)
            }
            (Control::Number(number), _) => spelled(*number, &unit),
            (Control::Unit(to), Some((number, _))) => {
                spelled(self.converted(number, &unit, to), to)
            }
            (Control::Negate, Some((number, _))) => spelled(-number, &unit),
            (Control::Negate, None) if !pending => negated(text),
            (Control::Operation(sign), _) if !pending && !text.is_empty() => {
                format!("{text} {sign} ")
            }
            (Control::Operand(operand), _) => match pending {
                true => format!("{text} {operand}"),
                false => operand.clone(),
            },
            _ => text.to_owned(),
        }
    }

    fn knows(&self, unit: &str) -> bool {
        self.units.iter().any(|known| known == unit) || (self.units.is_empty() && unit.is_empty())
    }

    /// The step in a unit. In an unusual unit, a step is one.
    fn step_in(&self, step: f64, unit: &str) -> f64 {
        let one = worth(unit).filter(|_| self.knows(unit));
        one.map_or(1.0, |one| round(step / one))
    }

    fn slider(&self, step: f64, unit: &str) -> Option<[f64; 2]> {
        let (least, most) = self.range.filter(|_| self.knows(unit))?;
        let (least, most) = (number_in(least, unit)?, number_in(most, unit)?);
        (least < most && (most - least) / step <= MOST_STEPS).then_some([least, most])
    }

    /// Converts a number between units of the value; another unit is replaced.
    fn converted(&self, number: f64, from: &str, to: &str) -> f64 {
        let value = si_value(number, from).filter(|_| self.knows(from));
        value.and_then(|value| number_in(value, to)).unwrap_or(number)
    }
}

/// Splits a text into number and unit; `None` for another formula.
fn quantity(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let plain = |text: &str| Literal::parse(text).filter(|it| it.unit.is_none())?.value();
    if let Some(number) = plain(text) {
        return Some((number, ""));
    }
    let mut parts = text.char_indices().map(|(at, _)| text.split_at(at));
    parts.find_map(|(number, unit)| {
        Unit::parse(unit.trim())?;
        Some((plain(number)?, unit.trim()))
    })
}

fn spelled(value: f64, unit: &str) -> String {
    // Ten digits; the sums of steps have more.
    let text = number(format!("{value:.9e}").parse().unwrap_or(value));
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// The negative of a formula that is not a number, or back.
fn negated(text: &str) -> String {
    let is_name = text.chars().all(|each| each.is_alphanumeric() || each == '_');
    match text.strip_prefix('-') {
        Some(rest) => rest.trim().to_owned(),
        None if text.is_empty() => String::new(),
        None if is_name => format!("-{text}"),
        None => format!("-({text})"),
    }
}

/// Rounds a positive number down to 1, 2 or 5 times a power of ten.
pub(super) fn round(value: f64) -> f64 {
    let mut power = 1.0;
    while power * 10.0 <= value {
        power *= 10.0;
    }
    while power > value && power > 1e-9 {
        power /= 10.0;
    }
    let least = [5.0, 2.0].into_iter().find(|digit| digit * power <= value);
    // A quotient of powers of ten adds no digits.
    let step = least.unwrap_or(1.0) * power;
    (step * 1e9).round() / 1e9
}

#[cfg(test)]
mod tests {
    use super::{Control, Reading, Scale};

    fn length() -> Scale {
        let units = ["cm", "m", "mm"].map(str::to_owned).to_vec();
        Scale { units, step: Some(0.1), range: Some((0.0, 2.0)) }
    }

    #[test]
    fn a_number_has_a_unit_a_step_and_a_slider_in_that_unit() {
        let reading = length().read("35 cm");
        let wanted = Reading {
            text: "35 cm".to_owned(),
            number: Some(35.0),
            unit: "cm".to_owned(),
            step: Some(10.0),
            slider: Some([0.0, 200.0]),
            pending: false,
        };
        assert_eq!(reading, wanted);
        assert_eq!(length().read("1.5 m").slider, Some([0.0, 2.0]));
        assert_eq!(length().read("2 s").slider, None);
        for (text, pending) in [("gap", false), ("gap +", true), ("", false), ("-", true)] {
            let reading = length().read(text);
            assert_eq!((reading.number, reading.pending), (None, pending), "{text}");
        }
    }

    #[test]
    fn each_control_changes_the_text() {
        let unit = |unit: &str| Control::Unit(unit.to_owned());
        let operation = Control::Operation("*".to_owned());
        let operand = Control::Operand("gap".to_owned());
        for (text, control, wanted) in [
            ("2 cm", &Control::Less, "0 cm"),
            ("2 cm", &Control::More, "10 cm"),
            ("0.3 m", &Control::More, "0.4 m"),
            ("2 m", &unit("cm"), "200 cm"),
            ("35", &unit("cm"), "35 cm"),
            ("35 cm", &Control::Number(40.125), "40.125 cm"),
            ("35 cm", &Control::Negate, "-35 cm"),
            ("gap", &Control::Negate, "-gap"),
            ("gap + 1 cm", &Control::Negate, "-(gap + 1 cm)"),
            ("-gap", &Control::Negate, "gap"),
            ("gap", &operation, "gap * "),
            ("gap *", &operation, "gap *"),
            ("gap * ", &operand, "gap * gap"),
            ("35 cm", &operand, "gap"),
            ("gap", &Control::More, "gap"),
        ] {
            assert_eq!(length().after(text, control), wanted, "{text} {control:?}");
        }
    }
}
