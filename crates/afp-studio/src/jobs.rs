//! Runs jobs as separate processes of this program, so that they can be ended and cannot crash the
//! studio.

mod group;

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::mpsc::Sender;
use std::thread;

use crate::event::Event;
use crate::room::{JobId, Order};
use group::Group;

/// Running processes.
pub(crate) struct Runner {
    program: PathBuf,
    folder: PathBuf,
    events: Sender<Event>,
    running: BTreeMap<JobId, Group>,
}

impl Runner {
    /// Runs a program in a folder, with its output as events.
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
        // Cargo and the command line then write no colours.
        command.env("CARGO_TERM_COLOR", "never").env("NO_COLOR", "1");
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

    /// Sends the output of a process, and its end, to the room.
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
            // The reader of the other stream ends with it.
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

/// The longest forwarded line, in bytes, enough for a result. The rest of a longer line is dropped.
const LONGEST: u64 = 1 << 20;

/// Forwards lines until the stream ends. Invalid text is forwarded lossily, because a job with an
/// unread stream cannot report its results.
fn carry(from: impl Read, id: JobId, to: &Sender<Event>) {
    let mut from = BufReader::new(from);
    let mut line = Vec::new();
    loop {
        line.clear();
        let read = from.by_ref().take(LONGEST).read_until(b'\n', &mut line);
        // An unreadable stream has ended.
        if read.unwrap_or(0) == 0 {
            return;
        }
        let is_whole = line.last() == Some(&b'\n') || !skip_line(&mut from);
        let text = String::from_utf8_lossy(&line);
        let text = text.trim_end_matches(['\n', '\r']);
        let text = if is_whole { text.to_owned() } else { format!("{text} ...") };
        if to.send(Event::JobSaid(id, text)).is_err() {
            return;
        }
    }
}

/// Skips the rest of a line; returns whether there was any.
fn skip_line(from: &mut impl BufRead) -> bool {
    let mut skipped = false;
    loop {
        let (length, ends) = match from.fill_buf() {
            Ok([]) | Err(_) => return skipped,
            Ok(bytes) => match bytes.iter().position(|byte| *byte == b'\n') {
                Some(at) => (at + 1, true),
                None => (bytes.len(), false),
            },
        };
        from.consume(length);
        skipped |= !ends || length > 1;
        if ends {
            return skipped;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_any_content_are_forwarded() {
        let long = "x".repeat(LONGEST as usize);
        for (stream, expected) in [
            (b"one\ntwo\r\nthree".to_vec(), vec!["one".to_owned(), "two".into(), "three".into()]),
            (b"a\xffb\nlast\n".to_vec(), vec!["a\u{fffd}b".into(), "last".into()]),
            (b"\n\n".to_vec(), vec![String::new(), String::new()]),
            (format!("{long}\nlast").into_bytes(), vec![long.clone(), "last".into()]),
            (
                format!("{long}y{long}\nlast").into_bytes(),
                vec![format!("{long} ..."), "last".into()],
            ),
        ] {
            let (to, said) = std::sync::mpsc::channel();
            carry(&stream[..], 1, &to);
            drop(to);
            let said: Vec<_> = said
                .iter()
                .map(|event| match event {
                    Event::JobSaid(1, line) => line,
                    _ => panic!("one line"),
                })
                .collect();
            assert!(said == expected, "{} lines", said.len());
        }
    }
}
