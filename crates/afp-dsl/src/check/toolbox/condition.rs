//! Comparisons in the conditions of states and events.

use crate::check::convert::compared_as;
use crate::check::formula::Scope;
use crate::graph::{Formula, Op};
use crate::toolbox::Condition;
use crate::types::text::{a_type, a_value};
use crate::types::{Conversion, Type};
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics, Words};
use afp_syntax::message;
use afp_types::Comparison;

/// Reads a comparison of a condition.
pub(super) fn condition(
    scope: &Scope<'_>,
    node: &ast::Comparison,
    diags: &mut Diagnostics,
) -> Option<Condition> {
    let Some((left, sign, right)) = node.parts() else {
        node.operands().iter().for_each(|operand| scope.names_only(operand));
        return None;
    };
    let comparison = Comparison::parse(&sign.text)?;
    let (left, right) = (scope.infer(&left, diags), scope.infer(&right, diags));
    let (left, right) = (left?, right?);
    let ty = compared_as(&left.ty, &right.ty);
    let mut operand = |formula| scope.finish(formula, Some(&ty), None, diags);
    let (left, right) = (operand(left), operand(right));
    let (left, right) = (left?.0, right?.0);
    let error = |message| Diagnostic::new(Code::E0519, sign.span, message);
    if matches!(ty, Type::Any | Type::Object(_)) {
        let message = message!("{} cannot be compared", Words(a_value(&ty)));
        diags.push(error(message).help("give the ports the type 'number' or 'discrete'"));
    } else if comparison.is_order() && !ty.is_numeric() {
        let message = message!("{} has no order", Words(a_value(&ty)));
        diags.push(error(message).help("write '==' or '!='"));
    }
    let is_sound = [&left, &right].into_iter().all(|formula| reads_no_text(formula, diags));
    is_sound.then_some(Condition { left, comparison, right })
}

/// Whether a formula converts no string to another type; else reports an error.
pub(super) fn reads_no_text(formula: &Formula, diags: &mut Diagnostics) -> bool {
    let is_read = |op: &Op<Conversion>| matches!(op, Op::Convert(Conversion::FromText(_)));
    let Some(node) = formula.nodes().find(|node| is_read(&node.op)) else { return true };
    let ty = &node.note.ty;
    let message = message!("a formula here cannot convert a string to {}", Words(a_type(ty)));
    let error = Diagnostic::new(Code::E0519, node.note.span, message);
    diags.push(error.help(message!("declare the input as '{}'; the plan converts the text", ty)));
    false
}
