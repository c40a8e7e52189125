//! Formulas as native expressions.
//!
//! Each expression has the Rust type of its formula. Operators are used if they have the same
//! meaning as in the interpreter. Operations that could panic, wrap or round differently are calls
//! into `afp_core::rt`.

use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};

use crate::names::{ident, units_name};
use crate::rust_type::{TypePaths, float, int, long, variant};
use afp_dsl::graph::{Formula, Function, Op, Operator, Part};
use afp_dsl::types::{Conversion, Dimension, Type};

/// How tightly an expression binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Bond {
    Sum,
    Product,
    Sign,
    Atom,
}

struct Expr(TokenStream, Bond);

impl Expr {
    /// The expression as an operand that needs at least this bond.
    fn at(self, bond: Bond) -> TokenStream {
        let tokens = self.0;
        if self.1 < bond { quote!((#tokens)) } else { tokens }
    }
}

fn atom(tokens: TokenStream) -> Expr {
    Expr(tokens, Bond::Atom)
}

/// Writes the formulas of one component.
pub struct Formulas<'a> {
    pub type_paths: &'a TypePaths<'a>,
    /// The getters of the plan's entries, or the fields of the input ports.
    pub entries: &'a [Ident],
    /// The holder of their values.
    pub reads: Reads,
    /// The names of the scratch strings, for values outside of entries, in the order of their use.
    pub scratch: Vec<Ident>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Reads {
    /// The configuration of a plan.
    Config,
    /// The inputs of a declared computation.
    Inputs,
}

impl<'a> Formulas<'a> {
    /// The formulas of one component of a plan.
    pub fn new(type_paths: &'a TypePaths<'a>, entries: &'a [Ident]) -> Self {
        Formulas { type_paths, entries, reads: Reads::Config, scratch: Vec::new() }
    }

    /// The value for an input port of the formula's type: strings and objects are borrowed.
    pub fn input(&mut self, formula: &Formula) -> TokenStream {
        match &formula.ty {
            Type::Text => match borrowed_text(self, formula.part()) {
                Some(text) => text,
                None => {
                    let text = self.value(formula);
                    let scratch = format_ident!("text_{}", self.scratch.len() + 1);
                    self.scratch.push(scratch.clone());
                    quote!(store_text(#scratch, #text))
                }
            },
            Type::Object(_) => {
                let object = self.entry(formula.part());
                quote!(config.#object()?)
            }
            _ => self.value(formula),
        }
    }

    /// A value of the formula's own Rust type.
    pub fn value(&self, formula: &Formula) -> TokenStream {
        self.plain(formula.part())
    }

    fn plain(&self, formula: Part<'_>) -> TokenStream {
        self.expr(formula).0
    }

    fn entry(&self, formula: Part<'_>) -> Option<&Ident> {
        match formula.op() {
            Op::Entry(entry) => self.entries.get(entry.index()),
            _ => None,
        }
    }

    fn expr(&self, formula: Part<'_>) -> Expr {
        let operands: Vec<_> = formula.operands().collect();
        match (formula.op(), &operands[..]) {
            (Op::Bool(value), _) => atom(quote!(#value)),
            (Op::Int(value), _) => signed(int(*value), *value < 0),
            (Op::Float(value), _) => {
                let tokens = self.type_paths.constant(dimension(&formula.ty), *value);
                signed(
                    tokens,
                    value.is_sign_negative() && dimension(&formula.ty) == Dimension::NONE,
                )
            }
            (Op::Text(text), _) => {
                let text = text.as_str();
                atom(quote!(Text::try_from(#text)?))
            }
            (Op::Choice(index), _) => match &formula.ty {
                Type::Enum(choices) => {
                    let (path, variant) =
                        (self.type_paths.value(&formula.ty), variant(choices, *index));
                    atom(quote!(#path::#variant))
                }
                _ => atom(quote!(#index)),
            },
            (Op::Entry(_), _) => {
                let entry = self.entry(formula);
                atom(match (self.reads, &formula.ty) {
                    (Reads::Config, Type::Text | Type::Object(_)) => {
                        quote!(config.#entry.get().clone())
                    }
                    (Reads::Config, _) => quote!(config.#entry()),
                    (Reads::Inputs, Type::Text) => quote!(Text::try_from(inputs.#entry)?),
                    (Reads::Inputs, Type::Any | Type::Number | Type::Discrete) => {
                        quote!(inputs.#entry.clone())
                    }
                    (Reads::Inputs, _) => quote!(inputs.#entry),
                })
            }
            (Op::Neg, &[inner]) => self.negated(inner),
            (Op::Binary(operator), &[a, b]) => match formula.ty {
                Type::Text => {
                    let (a, b) = (self.text(a), self.text(b));
                    atom(quote!(join(#a, #b)?))
                }
                Type::Int => self.on_ints(*operator, a, b),
                _ => self.on_quantities(*operator, a, b, dimension(&formula.ty)),
            },
            (Op::Call(function), operands) => {
                let value = self.called(*function, operands);
                atom(self.type_paths.quantity_from(dimension(&formula.ty), value))
            }
            (Op::Convert(conversion), &[inner]) => self.converted(conversion, inner),
            // Every other node has exactly these operands.
            (Op::Neg | Op::Binary(_) | Op::Convert(_), _) => atom(TokenStream::new()),
        }
    }

    /// A function, on ints or on SI values; it has its name in `afp_core::rt`.
    fn called(&self, function: Function, operands: &[Part<'_>]) -> TokenStream {
        let ints = operands.iter().all(|operand| operand.ty == Type::Int);
        let name = ident(function.rust_name(ints));
        let question = function.fails(ints).then(|| quote!(?));
        let operands = operands.iter().map(|&operand| match dimension(&operand.ty) {
            Dimension::NONE => self.plain(operand),
            _ => self.si(operand),
        });
        quote!(#name(#(#operands),*) #question)
    }

    /// A string for use within the expression: an `&str`.
    pub fn text(&self, formula: Part<'_>) -> TokenStream {
        borrowed_text(self, formula).unwrap_or_else(|| {
            let text = self.expr(formula).at(Bond::Atom);
            quote!(#text.as_str())
        })
    }

    fn negated(&self, inner: Part<'_>) -> Expr {
        if inner.ty == Type::Int {
            let value = self.plain(inner);
            return atom(quote!(int_neg(#value)?));
        }
        let value = self.expr(inner).at(Bond::Atom);
        Expr(quote!(-#value), Bond::Sign)
    }

    fn on_ints(&self, operator: Operator, a: Part<'_>, b: Part<'_>) -> Expr {
        let (a, b) = (self.plain(a), self.plain(b));
        atom(match operator {
            Operator::Add => quote!(int_add(#a, #b)?),
            Operator::Sub => quote!(int_sub(#a, #b)?),
            Operator::Mul => quote!(int_mul(#a, #b)?),
            // The checker converts both sides of `/` to floats.
            Operator::Rem | Operator::Div => quote!(int_rem(#a, #b)?),
        })
    }

    fn on_quantities(&self, operator: Operator, a: Part<'_>, b: Part<'_>, to: Dimension) -> Expr {
        let (of_a, of_b) = (dimension(&a.ty), dimension(&b.ty));
        let plain = Dimension::NONE;
        match operator {
            Operator::Add | Operator::Sub => {
                let (a, b) = (self.expr(a).at(Bond::Sum), self.expr(b).at(Bond::Product));
                let sign = if operator == Operator::Add { quote!(+) } else { quote!(-) };
                Expr(quote!(#a #sign #b), Bond::Sum)
            }
            Operator::Mul if of_b == plain => {
                let (a, b) = (self.expr(a).at(Bond::Product), self.expr(b).at(Bond::Sign));
                Expr(quote!(#a * #b), Bond::Product)
            }
            // A product is the same in either order, and a literal cannot fail first.
            Operator::Mul if of_a == plain && is_literal(a) => {
                let (a, b) = (self.expr(a).at(Bond::Sign), self.expr(b).at(Bond::Product));
                Expr(quote!(#b * #a), Bond::Product)
            }
            Operator::Div if of_b == plain || of_a == of_b => {
                let a = self.expr(a).at(Bond::Product);
                let b = checked(b, self.expr(b).at(Bond::Sign));
                Expr(quote!(#a / #b), Bond::Product)
            }
            Operator::Mul | Operator::Div => {
                let (a, si) = (self.si(a), self.si(b));
                let (sign, b) = match operator {
                    Operator::Mul => (quote!(*), si),
                    _ => (quote!(/), checked(b, si)),
                };
                let bond = if to == plain { Bond::Product } else { Bond::Atom };
                Expr(self.type_paths.quantity_from(to, quote!(#a #sign #b)), bond)
            }
            Operator::Rem => {
                let (a, b) = (self.si(a), self.si(b));
                atom(self.type_paths.quantity_from(to, quote!(rem(#a, #b)?)))
            }
        }
    }

    /// The SI value of a quantity, as an operand of a product.
    fn si(&self, formula: Part<'_>) -> TokenStream {
        if dimension(&formula.ty) == Dimension::NONE {
            return self.expr(formula).at(Bond::Sign);
        }
        if let Op::Call(function) = formula.op() {
            let operands: Vec<_> = formula.operands().collect();
            return self.called(*function, &operands);
        }
        let value = self.expr(formula).at(Bond::Atom);
        quote!(#value.si())
    }

    fn converted(&self, conversion: &Conversion, inner: Part<'_>) -> Expr {
        match conversion {
            Conversion::ToText(Type::Text) => self.expr(inner),
            Conversion::IntToFloat if exact(inner).is_some() => {
                signed(float(exact(inner).unwrap_or_default()), false)
            }
            Conversion::FromText(_) => {
                let text = self.text(inner);
                atom(convert(self.type_paths, conversion, text))
            }
            Conversion::ToText(_) => {
                let value = match inner.op() {
                    // Printed without a suffix, only the context shows that it is not an i32.
                    Op::Int(value) => long(*value),
                    _ => self.expr(inner).at(Bond::Atom),
                };
                atom(convert(self.type_paths, conversion, value))
            }
            _ => atom(convert(self.type_paths, conversion, self.plain(inner))),
        }
    }
}

/// A divisor: if it is computed, it may not be finite.
fn checked(divisor: Part<'_>, value: TokenStream) -> TokenStream {
    if is_computed(divisor) { quote!(divisor(#value)?) } else { value }
}

/// Whether a number is the result of an operation. Entries, literals and conversions are finite.
fn is_computed(number: Part<'_>) -> bool {
    match number.op() {
        Op::Neg => number.operand().is_some_and(is_computed),
        op => matches!(op, Op::Binary(_) | Op::Call(_)),
    }
}

/// An integer literal that is a float as well.
fn exact(formula: Part<'_>) -> Option<f64> {
    match formula.op() {
        Op::Int(value) if (0..1 << 53).contains(value) => Some(*value as f64),
        _ => None,
    }
}

/// A literal; a minus makes it bind less tightly.
fn signed(tokens: TokenStream, negative: bool) -> Expr {
    Expr(tokens, if negative { Bond::Sign } else { Bond::Atom })
}

/// A string from an entry or from the program itself: an `&str`.
fn borrowed_text(formulas: &Formulas<'_>, formula: Part<'_>) -> Option<TokenStream> {
    match formula.op() {
        Op::Text(text) => Some(text.as_str().to_token_stream()),
        Op::Entry(_) => {
            let entry = formulas.entry(formula);
            Some(match formulas.reads {
                Reads::Config => quote!(config.#entry()),
                Reads::Inputs => quote!(inputs.#entry),
            })
        }
        _ => None,
    }
}

/// The conversion of a value. A string is an `&str`, and a printed quantity is an operand of `.`.
pub fn convert(
    type_paths: &TypePaths<'_>,
    conversion: &Conversion,
    value: TokenStream,
) -> TokenStream {
    match conversion {
        Conversion::IntToFloat => quote!(int_to_float(#value)),
        Conversion::FloatToInt => quote!(float_to_int(#value)?),
        Conversion::BoolToInt => quote!(bool_to_int(#value)),
        Conversion::BoolToFloat => quote!(bool_to_float(#value)),
        Conversion::ToText(from) => match from {
            Type::Quantity(Dimension::NONE) => quote!(print_quantity(#value, "")?),
            Type::Quantity(dimension) => {
                let unit = dimension.si_unit();
                quote!(print_quantity(#value.si(), #unit)?)
            }
            Type::Enum(_) => quote!(print_choice(#value)?),
            _ => quote!(Text::print(#value)?),
        },
        Conversion::FromText(to) => match to {
            Type::Bool => quote!(parse_bool(#value)?),
            Type::Int => quote!(parse_int(#value)?),
            Type::Quantity(Dimension::NONE) => quote!(parse_float(#value)?),
            Type::Quantity(dimension) => {
                let units = units_name(*dimension);
                let units = quote!(super::units::#units.iter().copied());
                type_paths.quantity_from(*dimension, quote!(parse_quantity(#value, #units)?))
            }
            Type::Enum(_) => quote!(read_choice(#value)?),
            _ => quote!(Text::try_from(#value)?),
        },
    }
}

/// The dimension of a number's type; no dimension for everything else.
fn dimension(ty: &Type) -> Dimension {
    match ty {
        Type::Quantity(dimension) => *dimension,
        _ => Dimension::NONE,
    }
}

/// Whether a formula is a literal, perhaps with a sign: finite and constant.
pub fn is_literal(formula: Part<'_>) -> bool {
    match formula.op() {
        Op::Neg => formula.operand().is_some_and(is_literal),
        op => op.is_literal(),
    }
}
