//! The book's page of an error code.

use afp_syntax::diagnostics::Code;
use serde::Deserialize;
use serde_json::json;

use crate::answer::{Answer, Failure, ok};
use crate::server::Server;

/// A code of a diagnostic.
#[derive(Deserialize)]
pub(crate) struct Explain {
    code: String,
}

/// Returns the page of a code, as `afpc explain` prints it.
pub(crate) fn explain(_: &mut Server, params: Explain) -> Answer {
    let none = || Failure::Refused(format!("there is no error code '{}'", params.code));
    let code = Code::parse(&params.code).ok_or_else(none)?;
    ok(json!({ "text": code.explanation() }))
}
