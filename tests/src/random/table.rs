//! Random tables of constants, and the computations that read them.

use std::fmt::Write;

use super::dice::Dice;
use super::element::{Bindings, Made, NUMBERS, TEXTS};
use super::entries::{Entries, TYPES, Type};

#[derive(Clone, Debug)]
pub struct Table {
    name: String,
    columns: Vec<(&'static str, Type)>,
    /// The declaration.
    pub text: String,
}

/// Names of columns, some of which have a meaning in Rust, or elsewhere in the language.
const NAMES: [&str; 8] = ["x", "type", "value", "loop", "row", "next", "state", "fn"];

impl Table {
    /// The table of that number, of up to four rows.
    pub fn new(number: u64, dice: &mut Dice) -> Self {
        let first = dice.between(0, NAMES.len() as u64) as usize;
        let names = NAMES.iter().cycle().skip(first);
        let count = dice.between(1, 6) as usize;
        let columns: Vec<_> = names.take(count).map(|name| (*name, dice.pick(&TYPES))).collect();
        let declared: Vec<String> =
            columns.iter().map(|(name, ty)| format!("{name}: {}", ty.name())).collect();
        let name = format!("table{number}");
        let mut text = format!("table {name}({}) {{", declared.join(", "));
        for _ in 0..dice.between(1, 5) {
            let row: Vec<String> = columns.iter().map(|(_, ty)| constant(*ty, dice)).collect();
            let _ = write!(text, " ({})", row.join(", "));
        }
        text.push_str(" }\n");
        Table { name, columns, text }
    }

    /// A `Row` of this table; `kept` is an entry that it must not write.
    pub fn reader(
        &self,
        index: &str,
        kept: Option<&str>,
        entries: &Entries,
        dice: &mut Dice,
    ) -> Made {
        let mut bindings = Bindings::new(entries);
        bindings.bind("table", &self.name);
        bindings.bind("index", index);
        kept.into_iter().for_each(|entry| bindings.keep(entry));
        for (column, ty) in &self.columns {
            let types = match ty {
                Type::Int | Type::Float => NUMBERS,
                Type::Text => TEXTS,
                ty => &[*ty],
            };
            bindings.output(column, types, dice);
        }
        Made { word: "computation", call: bindings.call("Row"), outcomes: vec!["Row", "End"] }
    }
}

/// A constant formula, within the range of its type.
fn constant(ty: Type, dice: &mut Dice) -> String {
    let literal = ty.literal(dice);
    if dice.percent(60) {
        return literal;
    }
    match ty {
        Type::Int => dice.pick(&["-3", "2 * 7", "17 % 5", "abs(-4)", "max(3, 5)"]).to_owned(),
        Type::Float => dice.pick(&["-0.5", "1 / 3", "sqrt(2)", "7 % 2.5", "-(1.5)"]).to_owned(),
        Type::Length => {
            dice.pick(&["-20 cm", "2 * 35 cm", "1 m - 1 mm", "hypot(3 cm, 4 cm)"]).into()
        }
        Type::Text => format!("{literal} + \" \" + {}", dice.pick(&["2 m", "Side.left", "1 / 8"])),
        Type::Bool | Type::Side | Type::Map => literal,
    }
}

/// An index that is known only at run time: of a row, past the last one, or far outside.
pub fn index(entries: &Entries, dice: &mut Dice) -> String {
    let (int, float) = (entries.changing(Type::Int), entries.changing(Type::Float));
    match dice.between(0, 6) {
        0 => dice.pick(&["0", "1", "3"]).to_owned(),
        1 => dice.pick(&int),
        2 => format!("{} - 2", dice.pick(&int)),
        3 => dice.pick(&float),
        _ => format!("abs({}) % {}", dice.pick(&int), dice.pick(&["2", "3", "5"])),
    }
}
