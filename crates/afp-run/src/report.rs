//! The report of a run: a timeline for people, lines of JSON for programs, and a summary.

mod background;
mod json;
mod progress;
mod summary;
mod timeline;

use std::collections::BTreeSet;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_core::trace::{ComponentKind, Names, Record};
use afp_core::{Instant, Value};
use afp_log::LogData;
use afp_session::{Applied, EventKind, NamedRecord, Observer, RunEvent};

use crate::options::TimeKeeper;
use crate::stderr::warn;

use background::{BackgroundWriter, Out};
use progress::Progress;
pub(crate) use summary::{Ran, Requests, RunFigures, StoppedBy, Summary};

/// The timeline of a log, line by line.
pub fn timeline(log: &LogData) -> impl Iterator<Item = String> {
    let writes = log.events.iter().filter(|it| matches!(it.kind, EventKind::Committed { .. }));
    let writers: BTreeSet<_> = writes.map(|event| event.component.id).collect();
    log.events.iter().filter_map(move |event| {
        let id = event.component.id;
        let name = log.names.component(id);
        let watches = name.kind == ComponentKind::Supervisor;
        let starts = event.kind == EventKind::Started;
        // Logs have no bound outputs.
        let logs = timeline::logs(&log.names, id) && !writers.contains(&id);
        if watches && starts { None } else { timeline::line(event, name.template, logs) }
    })
}

/// A record as a line of the timeline. `None` if it needs no line.
pub fn line(at: Instant, record: &Record<'_>, names: &dyn Names) -> Option<String> {
    let template = match *record {
        Record::Polled { .. } => return None,
        Record::Input { component, .. } if timeline::logs(names, component) => "",
        Record::Input { .. } => return None,
        Record::Started { component } => match names.component(component) {
            name if name.kind == ComponentKind::Supervisor => return None,
            name => name.template,
        },
        _ => "",
    };
    timeline::line(&RunEvent::new(at, record, names), template, true)
}

/// An event other than a record, as a line of the timeline.
pub fn event_line(event: &RunEvent) -> Option<String> {
    timeline::line(event, "", false)
}

/// An observer that writes the report.
pub(crate) struct Shown<'a>(pub &'a Mutex<Report>);

/// The report, for one of its owners.
pub(crate) fn of(report: &Mutex<Report>) -> MutexGuard<'_, Report> {
    report.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Observer for Shown<'_> {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        of(self.0).tell(named.at, named.record, named.names);
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        of(self.0).tell_event(&applied.event());
    }

    fn on_loss(&mut self, at: Instant, count: u64, _: &[Value]) {
        let kind = EventKind::Lost(count);
        of(self.0).tell_event(&RunEvent { at, kind, ..RunEvent::default() });
    }
}

/// The report of a run, written to standard output during the run.
pub(crate) struct Report {
    out: Out,
    /// Whether standard output is a terminal.
    terminal: bool,
    json: bool,
    progress: Progress,
    /// The error that ended the output.
    failure: Option<io::Error>,
    /// Whether the output has ended.
    closed: Arc<AtomicBool>,
}

impl Report {
    /// # Errors
    /// The writing thread cannot be started.
    pub(crate) fn new(json: bool, end: Instant, keeper: TimeKeeper) -> io::Result<Self> {
        let terminal = io::stdout().is_terminal();
        let closed: Arc<AtomicBool> = Arc::default();
        let out = match (keeper, terminal) {
            (TimeKeeper::Robot, _) => Out::Background(BackgroundWriter::new(
                Box::new(anstream::stdout()),
                closed.clone(),
            )?),
            // Line by line for people, in blocks for pipes.
            (_, true) => Out::Here(Box::new(anstream::stdout())),
            (_, false) => Out::Here(Box::new(io::BufWriter::new(anstream::stdout()))),
        };
        let progress = Progress::new(end, keeper != TimeKeeper::Robot);
        Ok(Report { out, terminal, json, progress, failure: None, closed })
    }

    /// Whether the output has ended, as a flag for other threads.
    pub(crate) fn closed(&self) -> Arc<AtomicBool> {
        self.closed.clone()
    }

    /// The heading: plan, robot and world.
    pub(crate) fn head(&mut self, what: &[(&str, String)]) {
        if !self.json {
            let text = timeline::head(what);
            self.write(&text);
        }
    }

    /// Writes the line of a record, if it has one.
    pub(crate) fn tell(&mut self, at: Instant, record: &Record<'_>, names: &dyn Names) {
        if matches!(record, Record::Polled { .. }) {
            return;
        }
        let line = match self.json {
            true if matches!(record, Record::Input { .. }) => return,
            true => json::line(&RunEvent::new(at, record, names)),
            false => line(at, record, names),
        };
        self.tell_line(line);
    }

    /// Writes the line of a request from outside.
    fn tell_event(&mut self, event: &RunEvent) {
        let line = match self.json {
            true => json::line(event),
            false => timeline::line(event, "", false),
        };
        self.tell_line(line);
    }

    fn tell_line(&mut self, line: Option<String>) {
        if let Some(line) = line {
            self.progress.clear();
            self.write(&line);
        }
    }

    pub(crate) fn pass(&mut self, now: Instant) {
        if self.progress.pass(now) {
            // The reader of a pipe gets each line at once.
            let _ = self.out.flush();
        }
    }

    /// Writes the summary: for people, for programs, or both if the reader is unknown.
    ///
    /// # Errors
    /// The output could not be written. A reader that closed it is not an error.
    pub(crate) fn end(mut self, summary: &Summary) -> io::Result<()> {
        self.progress.clear();
        if !self.json {
            let text = summary.for_people();
            self.write(&text);
        }
        if self.json || !self.terminal {
            let line = summary.json(self.json);
            self.write(&line);
        }
        let written = self.out.finish();
        let written = written.map(|lost| match lost {
            0 => {}
            lost => warn(&format!(
                "{lost} lines are missing: the reader of standard output is too slow"
            )),
        });
        match self.failure.map_or(written, Err) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
            _ => Ok(()),
        }
    }

    fn write(&mut self, text: &str) {
        if self.failure.is_none() {
            self.failure = writeln!(self.out, "{text}").err();
            self.closed.fetch_or(self.failure.is_some(), Ordering::Relaxed);
        }
    }
}
