//! How requests end: a result, or an error of the protocol.

use afp_ide::edit::Refused;
use lsp_server::{Message, RequestId, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

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
    /// There is nothing to say, so the result is `null`.
    Nothing,
}

/// What becomes of a request.
pub(crate) type Answer = Result<Value, Failure>;

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Failure {
        Failure::Refused(refused.reason)
    }
}

/// The message of a text.
///
/// # Errors
/// It is none: the text of the response that says so.
pub fn read_message(text: &str) -> Result<Message, String> {
    let refusal = |id: Value, code: i32, why: &str| {
        json!({"jsonrpc": "2.0", "id": id, "error": {"code": code, "message": why}}).to_string()
    };
    let value: Value = serde_json::from_str(text)
        .map_err(|why| refusal(Value::Null, -32700, &format!("this is no JSON: {why}")))?;
    let id = value.get("id").filter(|id| id.is_number() || id.is_string()).cloned();
    match serde_json::from_value(value) {
        Ok(Message::Notification(_)) if id.is_some() => {
            Err(refusal(id.into(), -32600, "an id is a whole number of 32 bit, or a text"))
        }
        Ok(message) => Ok(message),
        Err(_) => Err(refusal(id.into(), -32600, "this is no request, response or notification")),
    }
}

/// The response to a request, with the protocol's code of a failure.
pub(crate) fn response(id: RequestId, answer: Answer) -> Response {
    let (code, message) = match answer {
        Ok(value) => return Response::new_ok(id, value),
        Err(Failure::Nothing) => return Response::new_ok(id, Value::Null),
        Err(Failure::Unknown(method)) => (-32601, format!("there is no request '{method}'")),
        Err(Failure::Malformed(reason)) => {
            (-32602, format!("the parameters cannot be read: {reason}"))
        }
        Err(Failure::OutOfTurn(reason)) => (-32600, reason.to_owned()),
        Err(Failure::NotInitialized) => (-32002, "the first request is 'initialize'".to_owned()),
        Err(Failure::Refused(reason)) => (-32803, reason),
    };
    Response::new_err(id, code, message)
}

/// A result as JSON.
pub(crate) fn ok(result: impl Serialize) -> Answer {
    serde_json::to_value(result).map_err(|error| Failure::Refused(error.to_string()))
}

pub(crate) fn params<P: DeserializeOwned>(value: Value) -> Result<P, Failure> {
    serde_json::from_value(value).map_err(|error| Failure::Malformed(error.to_string()))
}
