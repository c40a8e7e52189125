use super::{Name, Operator, Ref, find_token, token, tokens, views};
use crate::Node;
use crate::kind::{Afp, Kind};
use crate::source::Span;
use rowan::Language;

views! {
    Formula
}

#[derive(Clone, Debug)]
pub enum FormulaKind {
    /// Operands with operators between them, from left to right. `None` is a hole.
    Chain(Option<Formula>, Vec<(Sign, Option<Formula>)>),
    /// `-operand`
    Negation(Option<Formula>),
    /// `(operand)`
    Brackets(Option<Formula>),
    /// `function(operand, operand)`
    Call {
        name: Name,
        /// From left to right.
        operands: Vec<Formula>,
        /// Whether an operand is missing; already reported.
        broken: bool,
    },
    /// A number with its unit, if any.
    Number {
        number: Name,
        unit: Option<Name>,
        /// Whether it lacks a point and an exponent.
        whole: bool,
        /// Whether an invalid unit follows.
        broken: bool,
    },
    /// A string with its quotes.
    Text(Name),
    /// `true` or `false`
    Bool(bool),
    /// An entry or a value of an enum.
    Ref(Ref),
    /// A formula that cannot be read; already reported.
    Hole,
}

/// An operator between two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    pub operator: Operator,
    pub span: Span,
}

impl Formula {
    pub(super) fn child_of(node: &Node, file: u16) -> Option<Formula> {
        node.children().by_kind(is_formula).next().map(|node| Formula::new(node, file))
    }

    pub(super) fn children_of(node: &Node, file: u16) -> Vec<Formula> {
        node.children().by_kind(is_formula).map(|node| Formula::new(node, file)).collect()
    }

    /// Whether it is only a name: an entry or a value of an enum.
    pub fn is_name(&self) -> bool {
        self.node.kind() == Kind::Ref
    }

    /// Joins two formulas into one number if the comma between them may be a decimal comma: `1,5
    /// m`.
    pub fn with_decimal_point(&self, next: &Formula) -> Option<String> {
        let (FormulaKind::Number { number: whole, unit: None, whole: true, .. }, true) =
            (self.unsigned().kind(), next.span().start == self.span().end + 1)
        else {
            return None;
        };
        let FormulaKind::Number { number: fraction, unit, whole: true, .. } = next.kind() else {
            return None;
        };
        let unit = unit.map_or_else(String::new, |unit| format!(" {}", unit.text));
        Some(format!("{}.{}{unit}", whole.text, fraction.text))
    }

    /// The formula without its sign.
    fn unsigned(&self) -> Formula {
        match self.kind() {
            FormulaKind::Negation(Some(inner)) => inner,
            _ => self.clone(),
        }
    }

    /// Whether it begins at or before a byte; comments before it count as its begin.
    pub(super) fn starts_by(&self, byte: u32) -> bool {
        u32::from(self.node.text_range().start()) <= byte
    }

    pub fn kind(&self) -> FormulaKind {
        let only = || Formula::child_of(&self.node, self.file);
        match self.node.kind() {
            Kind::Sum | Kind::Product => self.chain(),
            Kind::Negation => FormulaKind::Negation(only()),
            Kind::Brackets => FormulaKind::Brackets(only()),
            Kind::Ref => FormulaKind::Ref(Ref::new(self.node.clone(), self.file)),
            Kind::Literal => self.literal(),
            Kind::Call => self.call(),
            _ => FormulaKind::Hole,
        }
    }

    fn chain(&self) -> FormulaKind {
        let mut first = None;
        let mut rest: Vec<(Sign, Option<Formula>)> = Vec::new();
        let mut nodes = self.node.children();
        let mut end = u32::from(self.node.text_range().start());
        for element in self.node.green().children() {
            let start = end;
            end += u32::from(element.text_len());
            if let Some(token) = element.into_token() {
                let span = Span { file: self.file, start, end };
                let operator = operator(Afp::kind_from_raw(token.kind()));
                rest.extend(operator.map(|operator| (Sign { operator, span }, None)));
            } else if let Some(node) = nodes.next().filter(|node| is_formula(node.kind())) {
                let operand = Formula::new(node, self.file);
                match rest.last_mut() {
                    Some((_, place)) => *place = Some(operand),
                    None => first = Some(operand),
                }
            }
        }
        FormulaKind::Chain(first, rest)
    }

    fn call(&self) -> FormulaKind {
        let Some(name) = token(&self.node, Kind::Name, self.file) else { return FormulaKind::Hole };
        let operands = Formula::children_of(&self.node, self.file);
        let commas = tokens(&self.node, Kind::Comma, self.file).len();
        let broken = commas > 0 && operands.len() != commas + 1;
        FormulaKind::Call { name, operands, broken }
    }

    fn literal(&self) -> FormulaKind {
        let first = find_token(&self.node, self.file, |kind, text, span| {
            (!kind.is_trivia()).then(|| (kind, Name { text: text.to_owned(), span }))
        });
        let Some((kind, name)) = first else { return FormulaKind::Hole };
        match kind {
            Kind::Int | Kind::Float => FormulaKind::Number {
                number: name,
                unit: token(&self.node, Kind::Unit, self.file),
                whole: kind == Kind::Int,
                broken: self.node.children().next().is_some(),
            },
            Kind::Text => FormulaKind::Text(name),
            Kind::Name => FormulaKind::Bool(name.text == "true"),
            _ => FormulaKind::Hole,
        }
    }
}

fn is_formula(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Sum
            | Kind::Product
            | Kind::Negation
            | Kind::Brackets
            | Kind::Call
            | Kind::Ref
            | Kind::Literal
    )
}

fn operator(kind: Kind) -> Option<Operator> {
    Some(match kind {
        Kind::Plus => Operator::Add,
        Kind::Minus => Operator::Sub,
        Kind::Star => Operator::Mul,
        Kind::Slash => Operator::Div,
        Kind::Percent => Operator::Rem,
        _ => return None,
    })
}
