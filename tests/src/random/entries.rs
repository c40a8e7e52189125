//! The entries of a random plan.

use std::fmt::Write;

use super::dice::Dice;

/// The types that random plans use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Bool,
    Int,
    Float,
    Length,
    Text,
    Side,
    Map,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    In,
    Out,
    Var,
    Const,
}

#[derive(Clone, Debug)]
pub struct Entry {
    pub name: String,
    pub kind: Kind,
    pub ty: Type,
    pub ranged: bool,
}

/// The entries of one plan; all have initial values except maps and some results.
#[derive(Clone, Debug)]
pub struct Entries {
    pub list: Vec<Entry>,
    pub text: String,
}

/// The types with literals.
pub const TYPES: [Type; 6] =
    [Type::Bool, Type::Int, Type::Float, Type::Length, Type::Text, Type::Side];

impl Type {
    pub fn name(self) -> &'static str {
        match self {
            Type::Bool => "bool",
            Type::Int => "int",
            Type::Float => "float",
            Type::Length => "length",
            Type::Text => "string",
            Type::Side => "Side",
            Type::Map => "Map",
        }
    }

    /// A range that contains all constants of tables and literals, for both kinds of number; sums
    /// and products can leave it.
    pub fn range(self) -> Option<&'static str> {
        match self {
            Type::Int => Some(" from -5 to 300"),
            Type::Float => Some(" from -3.5 to 3e2"),
            Type::Length => Some(" from -1 m to 3 m"),
            _ => None,
        }
    }

    /// A literal of the type; numbers are not zero.
    pub fn literal(self, dice: &mut Dice) -> String {
        match self {
            Type::Bool => dice.pick(&["true", "false"]).to_owned(),
            Type::Int => dice.pick(&["1", "2", "3", "7", "100"]).to_owned(),
            Type::Float => dice.pick(&["0.1", "1.5", "2.0", "3e2", "0.7"]).to_owned(),
            Type::Length => dice.pick(&["35 cm", "2 m", "70 mm", "1.5 m"]).to_owned(),
            Type::Text => dice.pick(&["\"abc\"", "\"42\"", "\"35 cm\"", "\"0.5\""]).to_owned(),
            Type::Side | Type::Map => dice.pick(&["Side.left", "Side.right"]).to_owned(),
        }
    }
}

impl Entries {
    /// Entries for the plan with that number: at least one of each type, and two maps.
    pub fn new(plan: u64, dice: &mut Dice) -> Self {
        let mut entries = Entries { list: Vec::new(), text: String::new() };
        for (index, ty) in (0..).zip(TYPES.iter().chain(&TYPES)) {
            // Every component can write the first of each type.
            let kind = match index < TYPES.len() {
                true => Kind::Var,
                false => dice.pick(&[Kind::In, Kind::In, Kind::Out, Kind::Out, Kind::Const]),
            };
            entries.add(format!("x{plan}_{index}"), kind, *ty, dice);
        }
        for map in ["m", "n"] {
            entries.add(format!("{map}{plan}"), Kind::Var, Type::Map, dice);
        }
        entries
    }

    fn add(&mut self, name: String, kind: Kind, ty: Type, dice: &mut Dice) {
        let word = match kind {
            Kind::In if dice.percent(30) => "in live",
            Kind::In => "in",
            Kind::Out => "out",
            Kind::Var => "var",
            Kind::Const => "const",
        };
        let _ = write!(self.text, "    {word} {name}: {}", ty.name());
        let open = ty == Type::Map || kind == Kind::Out && dice.percent(50);
        let long = ty == Type::Text && kind != Kind::Const && dice.percent(40);
        if long {
            // Two of these exceed the length of a string.
            self.text.push_str(" = \"thirty-three letters of plain text\"");
        } else if !open {
            let _ = write!(self.text, " = {}", ty.literal(dice));
        }
        let range = ty.range().filter(|_| kind != Kind::Const && dice.percent(20));
        let _ = writeln!(self.text, "{}", range.unwrap_or_default());
        self.list.push(Entry { name, kind, ty, ranged: range.is_some() });
    }

    /// The entries for formulas, without results that have no initial value.
    pub fn readable(&self, ty: Type) -> Vec<String> {
        let fits = |entry: &&Entry| entry.ty == ty && entry.kind != Kind::Out;
        self.list.iter().filter(fits).map(|entry| entry.name.clone()).collect()
    }

    /// The entries that change, so that the compiler cannot evaluate a formula over them.
    pub fn changing(&self, ty: Type) -> Vec<String> {
        let changes = |entry: &&Entry| entry.ty == ty && matches!(entry.kind, Kind::Var);
        self.list.iter().filter(changes).map(|entry| entry.name.clone()).collect()
    }

    /// The entries that components can write.
    pub fn writable(&self, types: &[Type]) -> Vec<String> {
        let fits = |entry: &&Entry| {
            types.contains(&entry.ty) && matches!(entry.kind, Kind::Var | Kind::Out)
        };
        self.list.iter().filter(fits).map(|entry| entry.name.clone()).collect()
    }

    pub fn of_kind(&self, kind: Kind) -> impl Iterator<Item = &Entry> {
        self.list.iter().filter(move |entry| entry.kind == kind)
    }
}
