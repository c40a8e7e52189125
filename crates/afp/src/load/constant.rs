//! What the compiler has computed, for the scheduler.

use afp_core::{Text, Value};
use afp_dsl::toolbox::Constant;

/// A constant of a checked plan or scenario as the scheduler has it. A text that the check lets pass fits.
pub fn value_of(constant: &Constant) -> Value {
    match constant {
        Constant::Bool(value) => Value::Bool(*value),
        Constant::Int(value) => Value::Int(*value),
        Constant::Float(value) => Value::Float(*value),
        Constant::Text(text) => Value::Text(Text::try_from(text.as_str()).unwrap_or_default()),
        Constant::Choice(value) => Value::Choice(*value),
    }
}
