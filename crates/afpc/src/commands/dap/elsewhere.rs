//! Clients of `afpc dap` and of the studio that attach to a run elsewhere: on a robot or a socket.

use std::time::Duration;

use afp_output::frames::WireError;
use serde_json::{Value, json};

use super::incoming::Arrived;
use super::link::{Begun, Link, Tell};

/// The messages for a run elsewhere.
#[derive(Default)]
pub struct Elsewhere {
    /// The client's first request, which is answered here.
    initialize: Option<String>,
    /// Its request to attach.
    attach: Option<Value>,
    begun: Begun,
    /// Whether a host cannot be a local command.
    no_commands: bool,
}

impl Elsewhere {
    /// For a client that must not start programs of this machine.
    #[cfg(feature = "studio")]
    pub fn without_commands() -> Elsewhere {
        Elsewhere { no_commands: true, ..Elsewhere::default() }
    }

    /// Ends the conversation here with a message that attaches to a run elsewhere.
    pub fn look(&mut self, arrived: Arrived) -> Arrived {
        let Arrived::Messages(all) = arrived else { return arrived };
        let parsed: Vec<Value> =
            all.iter().map(|message| serde_json::from_str(message).unwrap_or_default()).collect();
        let allowed = |place: &str| !(self.no_commands && place.starts_with("exec:"));
        let attaches = |it: &&Value| it["command"] == "attach" && place(it).is_some_and(allowed);
        self.attach = parsed.iter().find(attaches).cloned();
        let Some(attach) = &self.attach else {
            let greeted = parsed.iter().position(|it| it["command"] == "initialize");
            if let Some(at) = greeted {
                self.initialize = all.get(at).cloned();
                self.begun.answered = parsed.get(at).and_then(|it| it["seq"].as_i64());
            }
            return Arrived::Messages(all);
        };
        self.begun.leases = attach["arguments"]["lease"] == true;
        self.begun.first = self.initialize.take().into_iter().chain(all).collect();
        Arrived::End
    }

    /// Continues the conversation with that run.
    ///
    /// # Errors
    /// The client's input is not a sequence of messages.
    pub fn go_on(
        self,
        next: impl FnMut(Option<Duration>) -> Result<Arrived, WireError>,
        tell: &Tell,
    ) -> Result<(), WireError> {
        let Some(attach) = self.attach else { return Ok(()) };
        let unreached = match Link::to(place(&attach).unwrap_or_default()) {
            Ok(link) => link.relay(self.begun, next, tell)?,
            Err(why) => Some(why),
        };
        if let Some(why) = unreached {
            let response = json!({
                "type": "response", "request_seq": attach["seq"], "command": "attach", "seq": 0,
                "success": false, "message": why.to_string(),
            });
            // If the client is gone, nobody needs the reason.
            tell(&response.to_string());
        }
        Ok(())
    }
}

/// The host or the socket of a request to attach.
fn place(attach: &Value) -> Option<&str> {
    let arguments = &attach["arguments"];
    let named = |key: &str| arguments[key].as_str().filter(|place| !place.is_empty());
    named("host").or_else(|| named("socket"))
}
