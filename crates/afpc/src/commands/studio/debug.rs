//! Where a client runs and debugs: in this program, or in one that has the robot of its project.

mod relay;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use afp_build::Parts;
use afp_debug::{Adapter, Launch};
use afp_studio::{Debugging, Trusted};
use afp_toolboxes::project::OwnToolboxes;
use serde_json::{Value, json};

use super::super::dap::{Arrived, Simulator, converse, wait};
use crate::no_plan::NoPlan;
use crate::{Linked, runner};
use relay::{Conversation, relay};

/// What takes longer is explained.
const SOON: Duration = Duration::from_millis(500);

/// What the clients of one studio share.
pub(super) struct DebugService<'a> {
    pub(super) linked: &'a Linked<'a>,
    /// Nothing outside of it is run.
    pub(super) folder: &'a Path,
    /// Whether what lies in it may be built and run.
    pub(super) trusted: Trusted,
}

/// What another program has to go on with.
struct Elsewhere {
    program: PathBuf,
    /// What it has missed.
    said: Conversation,
}

impl DebugService<'_> {
    /// Runs and debugs plans for a client until it is gone.
    pub(super) fn serve(&self, client: Debugging) {
        let Debugging { said, told } = client;
        // A run goes no faster than its client reads; who reads nothing loses the connection.
        let tell = |message: String| told.blocking_send(message).is_ok();
        let mut before = Conversation::default();
        let mut elsewhere = None;
        let next = |due: Option<Duration>| {
            let message = match wait(&said, due) {
                Ok(message) => message,
                Err(RecvTimeoutError::Timeout) => return Ok(Arrived::Nothing),
                Err(RecvTimeoutError::Disconnected) => return Ok(Arrived::End),
            };
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
                    elsewhere = Some(Elsewhere { program, said });
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
        // It cannot say what is no message: frames are whole.
        let _ = converse(Adapter::new(Box::new(simulator)), next, send);
        if let Some(Elsewhere { program, said: missed }) = elsewhere {
            relay(&program, self.folder, missed, &said, &tell);
        }
    }

    /// The program that has what a request needs; none where this one has. Built if need be, so that it may take minutes.
    fn other(
        &self,
        request: &Value,
        tell: &(impl Fn(String) -> bool + Sync),
    ) -> Result<Option<PathBuf>, String> {
        // What makes no sense is refused by the debugger.
        let launch: Launch =
            serde_json::from_value(request["arguments"].clone()).unwrap_or_default();
        let file = Simulator::inside(self.linked, self.folder).files(&launch)?.plan().ok();
        let of_folder = OwnToolboxes::of_plan(&self.folder.join("plan.afp"));
        let of_folder = of_folder.map_err(|why| why.to_string())?;
        let own = file.as_ref().map_or(&of_folder, |file| &file.own);
        let graph = file.as_ref().and_then(|file| file.compiled.graph.as_ref());
        let has_robot = own.project.robot().map_err(|why| why.to_string())?.is_some();
        let parts = match graph {
            // Toolboxes make no difference to a world.
            _ if !has_robot && request["command"] == "afp/world" => return Ok(None),
            Some(graph) => Parts::of_plans([(own, graph)]),
            // Before there is a plan, or while it has mistakes, its robot has a world already: of what plans will need.
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
            return Err(format!(
                "{names} would be built and run: say first that you trust the folder"
            ));
        }
        let what = format!("building {names}: minutes, the first time");
        match with_notice(&what, tell, || runner::built(parts, self.linked)) {
            Ok(program) => Ok(Some(program)),
            Err(NoPlan::File(why)) => Err(why.to_string()),
            Err(why) => {
                Err(format!("{names} cannot be built: {why} (more in the terminal of the studio)"))
            }
        }
    }
}

/// Whether there is a robot after a request.
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

/// Does what may take long; then the client is told what it waits for.
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
