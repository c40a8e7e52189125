//! Random formulas of a type, with the conversions that the language knows.

use super::dice::Dice;
use super::entries::{Entries, Type};

/// A formula for a port of type `ty`.
///
/// Divisors and rounded or parsed values are entries that change, because an invalid constant
/// formula is a compile error.
pub fn formula(ty: Type, entries: &Entries, depth: u64, dice: &mut Dice) -> String {
    if depth == 0 || dice.percent(40) {
        return leaf(ty, entries, dice);
    }
    let mut inner = |ty| formula(ty, entries, depth - 1, dice);
    let (a, b) = (inner(ty), inner(ty));
    match ty {
        Type::Float => float(&a, &b, entries, depth, dice),
        Type::Int => int(&a, &b, entries, dice),
        Type::Length => length(&a, &b, entries, dice),
        Type::Text => text(&a, entries, depth, dice),
        Type::Bool | Type::Side | Type::Map => a,
    }
}

/// A length for a port with a range: only entries that change can leave it.
pub fn ranged(entries: &Entries, dice: &mut Dice) -> String {
    let entry = dice.pick(&entries.changing(Type::Length));
    match dice.between(0, 4) {
        0 => "50 cm".to_owned(),
        1 => entry,
        2 => format!("3 * {entry}"),
        _ => format!("{entry} - 10 cm"),
    }
}

fn leaf(ty: Type, entries: &Entries, dice: &mut Dice) -> String {
    let readable = entries.readable(ty);
    if readable.is_empty() || dice.percent(30) { ty.literal(dice) } else { dice.pick(&readable) }
}

fn float(a: &str, b: &str, entries: &Entries, depth: u64, dice: &mut Dice) -> String {
    let changing = dice.pick(&entries.changing(Type::Float));
    match dice.between(0, 13) {
        0 => format!("{a} + {b}"),
        1 => format!("{a} - ({b})"),
        2 => format!("({a}) * ({b})"),
        3 => format!("({a}) / {changing}"),
        4 => format!("({a}) % {changing}"),
        5 => format!("-({a})"),
        6 => formula(Type::Int, entries, depth - 1, dice),
        7 => format!("{} / {}", leaf(Type::Int, entries, dice), dice.pick(&["2", "3", "7"])),
        8 => format!("{}({a}, {b})", dice.pick(&["min", "max", "hypot"])),
        9 => format!("clamp({a}, {}, {changing})", dice.pick(&["-3", "0", "1.5"])),
        10 => format!("{}(({a}) * 1 rad)", dice.pick(&["sin", "cos"])),
        11 => format!("abs({a}) + sqrt({changing})"),
        12 => format!("atan2({a}, {b}) / 1 rad"),
        _ => {
            let lengths = entries.changing(Type::Length);
            format!("{} / {}", leaf(Type::Length, entries, dice), dice.pick(&lengths))
        }
    }
}

fn int(a: &str, b: &str, entries: &Entries, dice: &mut Dice) -> String {
    let changing = dice.pick(&entries.changing(Type::Int));
    match dice.between(0, 10) {
        0 => format!("{a} + {b}"),
        1 => format!("{a} - ({b})"),
        2 => format!("({a}) * ({b})"),
        3 => format!("({a}) % {changing}"),
        4 => format!("-({a})"),
        5 => format!("{} + {a}", dice.pick(&entries.changing(Type::Int))),
        6 => format!("{}({a}, {b}, {changing})", dice.pick(&["min", "max"])),
        7 => format!("clamp({a}, {}, {changing})", dice.pick(&["-3", "0", "2"])),
        8 => format!("abs({a})"),
        _ => format!("{changing} * 3037000500"),
    }
}

fn length(a: &str, b: &str, entries: &Entries, dice: &mut Dice) -> String {
    match dice.between(0, 8) {
        0 => format!("{a} + {b}"),
        1 => format!("{a} - ({b})"),
        2 => format!("({a}) * {}", leaf(Type::Float, entries, dice)),
        3 => format!("({a}) / {}", dice.pick(&entries.changing(Type::Float))),
        4 => format!("{}({a}, {b})", dice.pick(&["min", "max", "hypot"])),
        5 => format!("sqrt({} * ({b}))", dice.pick(&entries.changing(Type::Length))),
        6 => format!("clamp({a}, {b}, {})", dice.pick(&entries.changing(Type::Length))),
        _ => format!("-({a})"),
    }
}

fn text(a: &str, entries: &Entries, depth: u64, dice: &mut Dice) -> String {
    if dice.percent(15) {
        // Twice a long one is too long.
        let changing = dice.pick(&entries.changing(Type::Text));
        return format!("{changing} + {changing}");
    }
    let ty = dice.pick(&[Type::Bool, Type::Int, Type::Float, Type::Length, Type::Text, Type::Side]);
    let other = match dice.percent(60) {
        true => leaf(ty, entries, dice),
        false => formula(ty, entries, depth - 1, dice),
    };
    match dice.percent(50) {
        true => format!("{a} + \" \" + ({other})"),
        false => format!("\"\" + ({other}) + ({a})"),
    }
}

/// Sometimes a formula of another type that converts to the port's type.
pub fn converted(ty: Type, entries: &Entries, dice: &mut Dice) -> String {
    if dice.percent(70) {
        return formula(ty, entries, 2, dice);
    }
    match ty {
        Type::Float => match dice.between(0, 3) {
            0 => leaf(Type::Bool, entries, dice),
            1 => formula(Type::Int, entries, 2, dice),
            _ => dice.pick(&entries.changing(Type::Text)),
        },
        Type::Int => match dice.between(0, 3) {
            0 => leaf(Type::Bool, entries, dice),
            1 => dice.pick(&entries.changing(Type::Float)),
            _ => dice.pick(&entries.changing(Type::Text)),
        },
        Type::Length => dice.pick(&entries.changing(Type::Text)),
        Type::Text => {
            let ty = dice.pick(&[Type::Bool, Type::Int, Type::Float, Type::Length, Type::Side]);
            formula(ty, entries, 1, dice)
        }
        Type::Bool | Type::Side | Type::Map => formula(ty, entries, 1, dice),
    }
}
