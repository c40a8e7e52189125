//! Responses: a result or an error of the protocol.

use afp_ide::edit::Refused;
use lsp_server::{Message, RequestId, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

/// The reason why a request has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The server does not know the request.
    Unknown(String),
    /// The parameters are invalid.
    Malformed(String),
    /// The request came in the wrong state.
    OutOfTurn(&'static str),
    /// The request came before `initialize`.
    NotInitialized,
    /// The server cannot do it; the text says why.
    Refused(String),
    /// There is no result, so the response is `null`.
    Nothing,
}

pub(crate) type Answer = Result<Value, Failure>;

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Failure {
        Failure::Refused(refused.reason)
    }
}

/// Parses a message.
///
/// # Errors
/// The text of an error response if the message is invalid.
pub fn read_message(text: &str) -> Result<Message, String> {
    let refusal = |id: Value, code: i32, why: &str| {
        json!({"jsonrpc": "2.0", "id": id, "error": {"code": code, "message": why}}).to_string()
    };
    let value: Value = serde_json::from_str(text)
        .map_err(|why| refusal(Value::Null, -32700, &format!("invalid JSON: {why}")))?;
    let id = value.get("id").filter(|id| id.is_number() || id.is_string()).cloned();
    match serde_json::from_value(value) {
        Ok(Message::Notification(_)) if id.is_some() => {
            Err(refusal(id.into(), -32600, "an id must be a 32-bit integer or a string"))
        }
        Ok(message) => Ok(message),
        Err(_) => Err(refusal(
            id.into(),
            -32600,
            "the message is not a request, response or notification",
        )),
    }
}

/// Makes the response to a request, with the protocol's error code on failure.
pub(crate) fn response(id: RequestId, answer: Answer) -> Response {
    let (code, message) = match answer {
        Ok(value) => return Response::new_ok(id, value),
        Err(Failure::Nothing) => return Response::new_ok(id, Value::Null),
        Err(Failure::Unknown(method)) => (-32601, format!("unknown request '{method}'")),
        Err(Failure::Malformed(reason)) => {
            (-32602, format!("the parameters cannot be read: {reason}"))
        }
        Err(Failure::OutOfTurn(reason)) => (-32600, reason.to_owned()),
        Err(Failure::NotInitialized) => {
            (-32002, "the first request must be 'initialize'".to_owned())
        }
        Err(Failure::Refused(reason)) => (-32803, reason),
    };
    Response::new_err(id, code, message)
}

pub(crate) fn ok(result: impl Serialize) -> Answer {
    serde_json::to_value(result).map_err(|error| Failure::Refused(error.to_string()))
}

pub(crate) fn params<P: DeserializeOwned>(value: Value) -> Result<P, Failure> {
    serde_json::from_value(value).map_err(|error| Failure::Malformed(error.to_string()))
}
