//! The supported messages of the protocol.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Value, json};

/// The protocol's name in a handshake: today's and the earlier one.
pub(crate) const NAMES: [&str; 2] = ["foxglove.sdk.v1", "foxglove.websocket.v1"];

/// A client's JSON message. Unknown messages are not part of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub(crate) enum ClientMessage {
    Subscribe {
        subscriptions: Vec<Subscription>,
    },
    Unsubscribe {
        subscription_ids: Vec<u32>,
    },
    GetParameters {
        parameter_names: Vec<String>,
        id: Option<String>,
    },
    SetParameters {
        parameters: Vec<Parameter>,
        id: Option<String>,
    },
    SubscribeParameterUpdates {
        parameter_names: Vec<String>,
    },
    UnsubscribeParameterUpdates {
        parameter_names: Vec<String>,
    },
    #[serde(other)]
    Unknown,
}

/// A channel for a client, and the client's number for its messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Subscription {
    pub id: u32,
    pub channel_id: u32,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(crate) struct Parameter {
    pub name: String,
    #[serde(default)]
    pub value: Value,
}

impl Parameter {
    /// Its name, and its value as text.
    pub fn into_text(self) -> (String, String) {
        match self.value {
            Value::String(text) => (self.name, text),
            other => (self.name, other.to_string()),
        }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Call<'a> {
    pub service: u32,
    pub call: u32,
    pub encoding: &'a str,
    pub payload: &'a [u8],
}

impl Call<'_> {
    /// The call in some bytes; `None` for other bytes.
    pub fn read(bytes: &[u8]) -> Option<Call<'_>> {
        let (&[2], rest) = bytes.split_first_chunk()? else { return None };
        let (service, rest) = number(rest)?;
        let (call, rest) = number(rest)?;
        let (length, rest) = number(rest)?;
        let (encoding, payload) = rest.split_at_checked(length as usize)?;
        let encoding = std::str::from_utf8(encoding).ok()?;
        Some(Call { service, call, encoding, payload })
    }
}

fn number(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u32::from_le_bytes(*number), rest))
}

/// The response to a call: an empty object, as JSON.
pub(crate) fn called(service: u32, call: u32) -> Vec<u8> {
    let mut bytes = vec![3];
    let encoding = "json";
    for number in [service, call, encoding.len() as u32] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(encoding.as_bytes());
    bytes.extend(b"{}");
    bytes
}

/// The response to a failed call.
pub(crate) fn call_failed(service: u32, call: u32, why: &str) -> String {
    let message = json!({
        "op": "serviceCallFailure", "serviceId": service, "callId": call, "message": why,
    });
    message.to_string()
}

/// A message of a channel, with the client's number of the subscription.
pub(crate) fn message(subscription: u32, at: u64, payload: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(13 + payload.len());
    bytes.push(1);
    bytes.extend(subscription.to_le_bytes());
    bytes.extend(at.to_le_bytes());
    bytes.extend(payload);
    bytes
}

/// A message for a person: 0 information, 1 a warning, 2 an error.
pub(crate) fn status(level: u8, text: &str) -> String {
    json!({"op": "status", "level": level, "message": text}).to_string()
}

/// Values of parameters, in response to the request with this name.
pub(crate) fn values(parameters: &BTreeMap<String, Value>, id: Option<&str>) -> String {
    let shown = parameters.iter().map(|(name, value)| match value {
        Value::Null => json!({"name": name}),
        value => json!({"name": name, "value": value}),
    });
    let mut message = json!({"op": "parameterValues", "parameters": shown.collect::<Vec<_>>()});
    if let Some(id) = id {
        message["id"] = json!(id);
    }
    message.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calls_are_read_and_truncated_calls_are_not() {
        let mut bytes = vec![2];
        for number in [7_u32, 9, 4] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(b"json{\"held\":true}");
        let call = Call::read(&bytes).expect("a call");
        assert_eq!((call.service, call.call, call.encoding), (7, 9, "json"));
        assert_eq!(call.payload, b"{\"held\":true}");
        for length in 0..17 {
            assert_eq!(Call::read(&bytes[..length]), None, "{length} bytes");
        }
        bytes[0] = 1;
        assert_eq!(Call::read(&bytes), None);
    }

    #[test]
    fn unknown_requests_are_not_errors() {
        let said = |text| serde_json::from_str::<ClientMessage>(text).ok();
        assert_eq!(
            said(r#"{"op":"fetchAsset","uri":"x","requestId":1}"#),
            Some(ClientMessage::Unknown)
        );
        assert_eq!(said(r#"{"op":"subscribe"}"#), None);
        let subscription = Subscription { id: 1, channel_id: 2 };
        assert_eq!(
            said(r#"{"op":"subscribe","subscriptions":[{"id":1,"channelId":2}]}"#),
            Some(ClientMessage::Subscribe { subscriptions: vec![subscription] })
        );
    }
}
