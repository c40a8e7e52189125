//! Random computations that the file declares by formulas.

use std::fmt::Write;

use super::dice::Dice;
use super::element::{Bindings, Made, NUMBERS, TEXTS};
use super::entries::{Entries, Entry, Kind, TYPES, Type};
use super::formula::{converted, formula};

/// A computation of the file.
#[derive(Clone, Debug)]
pub struct Declared {
    name: String,
    inputs: Entries,
    outputs: Vec<(String, Type)>,
    outcomes: Vec<&'static str>,
    /// The declaration.
    pub text: String,
}

const STATES: [&str; 3] = ["One", "Two", "Three"];

impl Declared {
    /// The computation of that number: an input of each type, up to three outputs and states.
    pub fn new(number: u64, dice: &mut Dice) -> Self {
        let mut inputs = Entries { list: Vec::new(), text: String::new() };
        let name = format!("Declared{number}");
        let mut text = format!("computation {name} {{\n");
        for ty in TYPES {
            let name = format!("in_{}", ty.name().to_lowercase());
            let range = ty.range().filter(|_| dice.percent(20)).unwrap_or_default();
            let _ = writeln!(text, "    in {name}: {}{range}", ty.name());
            inputs.list.push(Entry { name, kind: Kind::Var, ty, ranged: !range.is_empty() });
        }
        let outputs: Vec<_> =
            (0..dice.between(0, 4)).map(|n| (format!("out{n}"), dice.pick(&TYPES))).collect();
        for (name, ty) in &outputs {
            let _ = writeln!(text, "    out {name}: {}", ty.name());
        }
        let outcomes = STATES[..dice.between(1, 4) as usize].to_vec();
        for (place, state) in outcomes.iter().enumerate() {
            let _ = write!(text, "    state {state}");
            if place + 1 < outcomes.len() {
                let when = condition(&inputs, dice);
                let and = if dice.percent(30) { condition(&inputs, dice) } else { String::new() };
                let and = if and.is_empty() { and } else { format!(" and {and}") };
                let _ = write!(text, " when {when}{and}");
            }
            text.push_str(" {");
            for (name, ty) in &outputs {
                // The first state writes all, so that some state writes each.
                if place == 0 || dice.percent(60) {
                    let _ = write!(text, " {name} = {}", formula(*ty, &inputs, 2, dice));
                }
            }
            text.push_str(" }\n");
        }
        text.push_str("}\n");
        Declared { name, inputs, outputs, outcomes, text }
    }

    /// A use of it.
    pub fn used(&self, entries: &Entries, dice: &mut Dice) -> Made {
        let mut bindings = Bindings::new(entries);
        for port in &self.inputs.list {
            match port.ranged {
                true => bindings.bind(&port.name, &dice.pick(&entries.changing(port.ty))),
                false => bindings.bind(&port.name, &converted(port.ty, entries, dice)),
            }
        }
        for (output, ty) in &self.outputs {
            let types = match ty {
                Type::Int | Type::Float => NUMBERS,
                Type::Text => TEXTS,
                ty => &[*ty],
            };
            bindings.output(output, types, dice);
        }
        let call = bindings.call(&self.name);
        Made { word: "computation", call, outcomes: self.outcomes.clone() }
    }
}

/// A comparison of two formulas of one type.
fn condition(inputs: &Entries, dice: &mut Dice) -> String {
    let ty = dice.pick(&TYPES);
    let signs: &[&str] = match ty {
        Type::Int | Type::Float | Type::Length => &["<", "<=", ">", ">=", "==", "!="],
        _ => &["==", "!="],
    };
    let (left, sign) = (formula(ty, inputs, 2, dice), dice.pick(signs));
    format!("{left} {sign} {}", formula(ty, inputs, 1, dice))
}
