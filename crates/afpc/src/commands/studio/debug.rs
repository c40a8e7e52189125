//! Runs and debugs plans for a client: in this program, or in a program with the robot of the
//! project.

mod relay;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use afp_build::Parts;
use afp_debug::{Adapter, Launch};
use afp_studio::{Debugging, Trusted};
use afp_toolboxes::project::OwnToolboxes;
use serde_json::{Value, json};

use super::super::dap::{Arrived, Simulator, converse, wait};
#[cfg(unix)]
use super::super::dap::{Elsewhere, Tell};
use crate::no_plan::NoPlan;
use crate::{Linked, runner};
use relay::{Conversation, relay};

/// The client gets a notice for longer operations.
const SOON: Duration = Duration::from_millis(500);

/// The state that the clients of one studio share.
pub(super) struct DebugService<'a> {
    pub(super) linked: &'a Linked<'a>,
    /// Only plans in this folder run.
    pub(super) folder: &'a Path,
    /// Whether the folder's code may be built and run.
    pub(super) trusted: Trusted,
}

/// The state that another program needs to continue the conversation.
struct Another {
    program: PathBuf,
    /// The earlier messages.
    said: Conversation,
}

impl DebugService<'_> {
    /// Runs and debugs plans for a client until it disconnects.
    pub(super) fn serve(&self, client: Debugging) {
        let Debugging { said, told } = client;
        // The run waits for its client. A client that does not read loses the connection.
        let tell = |message: String| told.blocking_send(message).is_ok();
        let mut before = Conversation::default();
        let mut another = None;
        #[cfg(unix)]
        let mut attached = Elsewhere::without_commands();
        let next = |due: Option<Duration>| {
            let arrived = arrival(&said, due);
            #[cfg(unix)]
            let arrived = attached.look(arrived);
            let Arrived::Messages(mut messages) = arrived else { return Ok(arrived) };
            let message = messages.pop().unwrap_or_default();
            let request: Value = serde_json::from_str(&message).unwrap_or_default();
            if !begins(&request) {
                before.note(&request, &message);
                return Ok(Arrived::Messages(vec![message]));
            }
            Ok(match self.other(&request, &tell) {
                Ok(None) => Arrived::Messages(vec![message]),
                Ok(Some(program)) => {
                    let mut said = std::mem::take(&mut before);
                    said.then(message);
                    another = Some(Another { program, said });
                    Arrived::End
                }
                Err(why) => {
                    tell(refused(&request, &why));
                    Arrived::Messages(Vec::new())
                }
            })
        };
        let send = |out: &[String]| out.iter().all(|message| tell(message.clone()));
        let simulator = Simulator::inside(self.linked, self.folder);
        // An invalid message is impossible: frames are complete.
        let _ = converse(Adapter::new(Box::new(simulator)), next, send);
        if let Some(Another { program, said: missed }) = another {
            return relay(&program, self.folder, missed, &said, &tell);
        }
        #[cfg(unix)]
        {
            let told = told.clone();
            let tell: Tell =
                std::sync::Arc::new(move |text| told.blocking_send(text.to_owned()).is_ok());
            let _ = attached.go_on(|due| Ok(arrival(&said, due)), &tell);
        }
    }

    /// The program that a request needs; `None` if this program is enough. Building the program can
    /// take minutes.
    fn other(
        &self,
        request: &Value,
        tell: &(impl Fn(String) -> bool + Sync),
    ) -> Result<Option<PathBuf>, String> {
        // The debugger reports invalid requests.
        let launch: Launch =
            serde_json::from_value(request["arguments"].clone()).unwrap_or_default();
        let file = Simulator::inside(self.linked, self.folder).files(&launch)?.plan().ok();
        let of_folder = OwnToolboxes::of_plan(&self.folder.join("plan.afp"));
        let of_folder = of_folder.map_err(|why| why.to_string())?;
        let own = file.as_ref().map_or(&of_folder, |file| &file.own);
        let graph = file.as_ref().and_then(|file| file.compiled.graph.as_ref());
        let has_robot = own.project.robot().map_err(|why| why.to_string())?.is_some();
        let parts = match graph {
            // Toolboxes do not change a world.
            _ if !has_robot && request["command"] == "afp/world" => return Ok(None),
            Some(graph) => Parts::of_plans([(own, graph)]),
            // If there is no valid plan yet, the robot already has a world: the default world of
            // new plans.
            None if has_robot => {
                Parts::of_project(own).or_else(|_| Parts::of_robot(&own.project)).map(Some)
            }
            None => return Ok(None),
        };
        let Some(parts) = parts.map_err(|why| why.to_string())? else { return Ok(None) };
        if self.linked.has(&parts) {
            return Ok(None);
        }
        let names = parts.names();
        if !self.trusted.is_given() {
            return Err(format!("this would build and run {names}: trust the folder first"));
        }
        let what = format!("building {names}: the first build takes minutes");
        match with_notice(&what, tell, || runner::built(parts, self.linked)) {
            Ok(program) => Ok(Some(program)),
            Err(NoPlan::File(why)) => Err(why.to_string()),
            Err(why) => {
                Err(format!("{names} cannot be built: {why} (more in the terminal of the studio)"))
            }
        }
    }
}

/// Waits for a message of the client.
fn arrival(said: &Receiver<String>, due: Option<Duration>) -> Arrived {
    match wait(said, due) {
        Ok(message) => Arrived::Messages(vec![message]),
        Err(RecvTimeoutError::Timeout) => Arrived::Nothing,
        Err(RecvTimeoutError::Disconnected) => Arrived::End,
    }
}

/// Whether a request starts a robot.
fn begins(request: &Value) -> bool {
    request["command"] == "launch" || request["command"] == "afp/world"
}

fn refused(request: &Value, why: &str) -> String {
    json!({
        "seq": 0, "type": "response", "request_seq": request["seq"], "command": request["command"],
        "success": false, "message": why,
        "body": { "error": { "id": 1, "format": why, "showUser": true } },
    })
    .to_string()
}

/// Does a long operation and notifies the client about the wait.
fn with_notice<T>(
    what: &str,
    tell: &(impl Fn(String) -> bool + Sync),
    work: impl FnOnce() -> T,
) -> T {
    thread::scope(|scope| {
        let (done, waits) = channel::<()>();
        scope.spawn(move || {
            if waits.recv_timeout(SOON) == Err(RecvTimeoutError::Timeout) {
                tell(output("console", what));
            }
        });
        let made = work();
        drop(done);
        made
    })
}

/// An event that shows a text.
fn output(category: &str, text: &str) -> String {
    let body = json!({ "category": category, "output": format!("{text}\n") });
    json!({ "seq": 0, "type": "event", "event": "output", "body": body }).to_string()
}
