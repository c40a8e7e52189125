//! Clients of `afpc dap` that attach to a run elsewhere: on a robot, or on a socket.

use std::io::Write;
use std::sync::mpsc::Receiver;

use afp_output::frames::{Frames, WireError, frame};
use serde_json::{Value, json};

use super::link::{Begun, Link};

/// The messages for a run elsewhere.
#[derive(Default)]
pub struct Elsewhere {
    /// The client's first request.
    initialize: Option<String>,
    /// Its request to attach.
    attach: Option<String>,
}

impl Elsewhere {
    /// Whether the message attaches to a run elsewhere, so that the conversation here ends.
    pub fn takes(&mut self, message: &str) -> bool {
        let parsed: Value = serde_json::from_str(message).unwrap_or_default();
        match parsed["command"].as_str() {
            Some("initialize") => self.initialize = Some(message.to_owned()),
            Some("attach") if place(&parsed).is_some() => {
                self.attach = Some(message.to_owned());
                return true;
            }
            _ => {}
        }
        false
    }

    /// Continues the conversation with that run.
    ///
    /// # Errors
    /// The client's input is not a sequence of messages.
    pub fn go_on(
        self,
        frames: Frames,
        arrived: &Receiver<Vec<u8>>,
        mut to: impl Write + Send + 'static,
    ) -> Result<(), WireError> {
        let Some(attach) = self.attach else { return Ok(()) };
        let parsed: Value = serde_json::from_str(&attach).unwrap_or_default();
        match Link::to(place(&parsed).unwrap_or_default()) {
            Ok(link) => {
                let initialize: Option<Value> =
                    self.initialize.as_ref().and_then(|it| serde_json::from_str(it).ok());
                let answered = initialize.and_then(|it| it["seq"].as_i64());
                let first = self.initialize.into_iter().chain([attach]).collect();
                let leases = parsed["arguments"]["lease"] == true;
                link.relay(Begun { first, answered, leases, frames }, arrived, to)
            }
            Err(why) => {
                let response = json!({
                    "type": "response", "request_seq": parsed["seq"], "command": "attach", "seq": 0,
                    "success": false, "message": why.to_string(),
                });
                // If the client is gone, nobody needs the reason.
                let _ = to.write_all(&frame(&response.to_string())).and_then(|()| to.flush());
                Ok(())
            }
        }
    }
}

/// The host or the socket of a request to attach.
fn place(attach: &Value) -> Option<&str> {
    let arguments = &attach["arguments"];
    let named = |key: &str| arguments[key].as_str().filter(|place| !place.is_empty());
    named("host").or_else(|| named("socket"))
}
