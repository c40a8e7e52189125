//! `afpc explain`: the meaning of an error code.

use afp_run::RunError;
use afp_syntax::diagnostics::Code;
use clap::Args;

use super::print;
use crate::no_plan::NoPlan;

/// Arguments of `afpc explain`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The code, such as E0203
    code: String,
}

/// Prints the page of a code.
///
/// # Errors
/// There is no such code.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let text = arguments.code.trim().to_uppercase();
    let Some(code) = Code::parse(&text) else {
        let message = format!("there is no error code '{}'", arguments.code);
        let help = "codes look like E0203; they follow 'error' or 'warning' in brackets";
        return Err(RunError::usage(message, help).into());
    };
    print(code.explanation())
}
