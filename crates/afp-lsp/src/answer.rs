//! How requests end: a result, or an error of the protocol.

use lsp_server::{RequestId, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Why a request has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// Nothing is known of such a request.
    Unknown(String),
    /// Its parameters cannot be read.
    Malformed(String),
    /// It comes at the wrong time.
    OutOfTurn(&'static str),
    /// It comes before the first one.
    NotInitialized,
    /// What it asks for cannot be: the reason, for people.
    Refused(String),
}

/// What becomes of a request.
pub(crate) type Answer = Result<Value, Failure>;

impl Failure {
    /// Code and message, as the protocol has them.
    fn said(self) -> (i32, String) {
        match self {
            Failure::Unknown(method) => (-32601, format!("there is no request '{method}'")),
            Failure::Malformed(reason) => {
                (-32602, format!("the parameters cannot be read: {reason}"))
            }
            Failure::OutOfTurn(reason) => (-32600, reason.to_owned()),
            Failure::NotInitialized => (-32002, "the first request is 'initialize'".to_owned()),
            Failure::Refused(reason) => (-32803, reason),
        }
    }
}

/// The response to a request.
pub(crate) fn response(id: RequestId, answer: Answer) -> Response {
    match answer {
        Ok(value) => Response::new_ok(id, value),
        Err(failure) => {
            let (code, message) = failure.said();
            Response::new_err(id, code, message)
        }
    }
}

/// A result as JSON.
pub(crate) fn ok(result: impl Serialize) -> Answer {
    serde_json::to_value(result).map_err(|error| Failure::Refused(error.to_string()))
}

pub(crate) fn params<P: DeserializeOwned>(value: Value) -> Result<P, Failure> {
    serde_json::from_value(value).map_err(|error| Failure::Malformed(error.to_string()))
}
