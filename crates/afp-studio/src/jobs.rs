//! Runs jobs: this program again, in another process, so that what it does there can be ended and can end nothing here.

mod group;

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::mpsc::Sender;
use std::thread;

use crate::room::{JobId, Order};
use crate::sockets::Event;
use group::Group;

/// Processes that go on.
pub(crate) struct Runner {
    program: PathBuf,
    folder: PathBuf,
    events: Sender<Event>,
    running: BTreeMap<JobId, Group>,
}

impl Runner {
    /// Runs a program in a folder; what it says are events.
    pub fn new(program: PathBuf, folder: PathBuf, events: Sender<Event>) -> Runner {
        Runner { program, folder, events, running: BTreeMap::new() }
    }

    pub fn take(&mut self, order: Order) {
        match order {
            Order::Begin(id, arguments) => self.begin(id, &arguments),
            Order::End(id) => {
                if let Some(group) = self.running.get_mut(&id) {
                    group.end();
                }
            }
        }
    }

    fn begin(&mut self, id: JobId, arguments: &[String]) {
        let mut command = Command::new(&self.program);
        command.args(arguments).current_dir(&self.folder).stdin(Stdio::null());
        match Group::start(command.stdout(Stdio::piped()).stderr(Stdio::piped())) {
            Ok(mut group) => {
                let first = group.first();
                let (out, err) = (first.stdout.take(), first.stderr.take());
                self.running.insert(id, group);
                self.listen(id, out, err);
            }
            Err(why) => {
                let said = format!("cannot start '{}': {why}", self.program.display());
                let _ = self.events.send(Event::JobSaid(id, said));
                let _ = self.events.send(Event::JobEnded(id));
            }
        }
    }

    /// Carries what a process prints to the room, and that it has ended.
    fn listen(
        &self,
        id: JobId,
        out: Option<impl Read + Send + 'static>,
        err: Option<impl Read + Send + 'static>,
    ) {
        let (events, errors) = (self.events.clone(), self.events.clone());
        thread::spawn(move || {
            let told = err.map(|err| thread::spawn(move || carry(err, id, &errors)));
            out.into_iter().for_each(|out| carry(out, id, &events));
            // Whoever reads the other stream ends with it.
            let _ = told.map(thread::JoinHandle::join);
            let _ = events.send(Event::JobEnded(id));
        });
    }

    /// The exit code of a process that has closed its streams.
    pub fn ended(&mut self, id: JobId) -> Option<i32> {
        self.running.remove(&id)?.wait().ok()?.code()
    }
}

impl Drop for Runner {
    fn drop(&mut self) {
        for group in self.running.values_mut() {
            group.kill();
            let _ = group.wait();
        }
    }
}

fn carry(from: impl Read, id: JobId, to: &Sender<Event>) {
    for line in BufReader::new(from).lines() {
        // What is no text ends the stream.
        let Ok(line) = line else { return };
        if to.send(Event::JobSaid(id, line)).is_err() {
            return;
        }
    }
}
