//! The debug adapter next to a run: clients attach over a Unix socket.

use std::fs;
use std::io;
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use afp_debug::{Adapter, Host, Launch, LiveTarget, Target};
use afp_dsl::graph::Graph;
use afp_run::{Beside, Debugger, RunError, say};
use afp_session::{AnySession, remote};

use super::listen::{Arrival, Peers, Stream, arrivals};
use super::simulator::{absolute, program};
use super::sockets::{listen, new_path};
use crate::plan_file::PlanFile;

impl Stream for UnixStream {
    fn copy(&self) -> io::Result<Self> {
        self.try_clone()
    }

    fn close(&self, how: Shutdown) {
        let _ = self.shutdown(how);
    }
}

/// Serves debuggers of a run on a Unix socket.
pub struct Socket<'a> {
    pub graph: &'a Graph,
    pub file: &'a PlanFile,
}

impl Beside for Socket<'_> {
    fn start(&self, session: &dyn AnySession) -> Result<Debugger, RunError> {
        let path = new_path(&self.graph.main().name);
        let failed = |why| RunError::file("cannot listen on", &path)(why);
        let listener = listen(&path).map_err(failed)?;
        let program = Arc::new(program(self.graph, self.file, &absolute));
        let (remote, steering, wire) = remote();
        let host = Here { files: program.files.clone() };
        let (target, relay) = LiveTarget::new(program, session, remote);
        let (sender, arrived) = arrivals();
        let connected = sender.clone();
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                if connected.send(Arrival::Client(stream)).is_err() {
                    return;
                }
            }
        });
        let to_peers = sender.clone();
        let serving = thread::Builder::new().name("afp-debugger".into());
        let serving = serving.spawn(move || {
            let adapter = Adapter::beside(Box::new(host), Box::new(target));
            Peers::new(adapter, to_peers, Duration::ZERO).serve(&arrived);
        });
        let serving = serving.map_err(failed)?;
        say(format!("debuggers: afpc attach {}", path.display()));
        let end = move || {
            let _ = fs::remove_file(&path);
            if sender.send(Arrival::End).is_ok() {
                // A panic of the debugger is not one of the run.
                let _ = serving.join();
            }
        };
        Ok(Debugger { relay: Box::new(relay), wire, steering, end: Box::new(end) })
    }
}

/// Files of clients, which may be on another machine.
struct Here {
    files: Vec<String>,
}

impl Host<'static> for Here {
    fn launch(&mut self, _: &Launch) -> Result<Box<dyn Target + 'static>, String> {
        Err("the robot runs its own plan: 'attach' joins it".to_owned())
    }

    /// The plan's file whose path ends like the client's.
    fn path(&self, path: &str) -> String {
        let path = absolute(path);
        if self.files.contains(&path) {
            return path;
        }
        let alike = |file: &String| {
            let (file, path) = (Path::new(file).components().rev(), Path::new(&path));
            file.zip(path.components().rev()).take_while(|(a, b)| a == b).count()
        };
        let best = self.files.iter().max_by_key(|file| alike(file));
        best.filter(|file| alike(file) > 0).cloned().unwrap_or(path)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_another_machine_are_found_by_the_ends_of_their_paths() {
        let files = ["/var/lib/afp/1/plans/a.afp", "/var/lib/afp/1/plans/parts/a.afp"];
        let here = Here { files: files.map(str::to_owned).to_vec() };
        assert_eq!(here.path("/home/me/plans/a.afp"), files[0]);
        assert_eq!(here.path("/home/me/parts/a.afp"), files[1]);
        assert_eq!(here.path("/home/me/b.afp"), "/home/me/b.afp");
    }
}
