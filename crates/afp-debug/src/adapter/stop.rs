//! Messages during a run and at a stop.

use std::collections::BTreeMap;

use afp_core::Instant;
use afp_session::{Datum, Done, EventKind, Requested};
use dapts::{StoppedEventReason as Reason, event};
use serde_json::json;

use super::clients::Client;
use super::mode::{By, Mode};
use super::{Adapter, Answer, Run};
use crate::breakpoints::Kind;
use crate::plotted::plotted;
use crate::program::{Entry, Program};
use crate::sensed::{Cone, Sensed};
use crate::target::Happened;

impl Kind {
    /// The reason for a stop at such a breakpoint.
    pub(super) fn reason(self) -> Reason {
        match self {
            Kind::Line => Reason::Breakpoint,
            Kind::Function => Reason::FunctionBreakpoint,
            Kind::Data => Reason::DataBreakpoint,
        }
    }
}

impl Adapter<'_> {
    /// Sends an event with its place; values that components read are shown in their scopes.
    pub(super) fn say(&mut self, run: &Run<'_>, what: &Happened) {
        if matches!(what.event.kind, EventKind::Input { .. } | EventKind::Polled(_)) {
            return;
        }
        let at = what.event.at.as_secs_f64();
        let text = match what.event.facts().request {
            Some(Requested { what, done: Done::Refused(why), .. }) => {
                format!("{at:>10.3}  {what} (from outside) is refused: {why}\n")
            }
            Some(request) => format!("{at:>10.3}  {} (from outside)\n", request.what),
            None => format!("{at:>10.3}  {}\n", what.text),
        };
        let program = run.target.program();
        let place = program.unit(what.event.component.id).map(|unit| unit.at);
        let refused =
            matches!(what.event.facts().request, Some(Requested { done: Done::Refused(_), .. }));
        let mut said = super::output(if refused { "stderr" } else { "console" }, &text);
        let place = place.filter(|_| !what.text.is_empty());
        said.source = place.and_then(|place| source(program, place.file));
        for client in self.attached().collect::<Vec<_>>() {
            let first = self.counting_of(client).first_line;
            said.line = place.map(|place| place.line + first);
            self.event_to::<event::Output>(client, &said);
        }
    }

    /// Sends the text of a log point.
    pub(super) fn log(&mut self, what: &Happened, text: &str) {
        let at = what.event.at.as_secs_f64();
        self.output("console", &format!("{at:>10.3}  {text}\n"));
    }

    /// Sends that the run has stopped.
    pub(super) fn stopped(&mut self, reason: Reason, why: &str, hits: Vec<u64>) {
        let Some(mut run) = self.run.take() else { return };
        self.stopped_at(&mut run, reason, why, hits);
        self.run = Some(run);
    }

    pub(super) fn stopped_at(
        &mut self,
        run: &mut Run<'_>,
        reason: Reason,
        why: &str,
        hits: Vec<u64>,
    ) {
        run.mode = Mode::Held;
        self.event::<event::Stopped>(&stopped_event(reason, why, run.target.now(), hits));
        self.send_trace(run);
        self.send_state_of(run);
    }

    /// The last fault.
    pub(super) fn exception_info(
        &mut self,
        _: dapts::ExceptionInfoArguments,
    ) -> Answer<dapts::ExceptionInfoResponse> {
        let (name, text) = self.run()?.exception.clone().ok_or("no fault happened here")?;
        Ok(dapts::ExceptionInfoResponse {
            break_mode: dapts::ExceptionBreakMode::Always,
            description: Some(text),
            details: None,
            exception_id: name.to_owned(),
        })
    }

    /// Ends a run that cannot start.
    pub(super) fn failed(&mut self, run: &mut Run<'_>, why: &str) {
        run.mode = Mode::Over;
        self.output("stderr", &format!("{why}\n"));
        self.event::<event::Exited>(&dapts::ExitedEvent { exit_code: 2 });
        self.event::<event::Terminated>(&dapts::TerminatedEvent::default());
    }

    /// Ends a run at its time limit.
    pub(super) fn time_up(&mut self, run: &mut Run<'_>) {
        let mut said = Vec::new();
        run.target.stop(&mut |happened, _| said.push(happened.clone()));
        said.iter().for_each(|happened| self.say(run, happened));
        run.keep_trace(&said);
        self.end(run, &By::Until);
    }

    pub(super) fn end(&mut self, run: &mut Run<'_>, by: &By) {
        run.mode = Mode::Over;
        self.send_trace(run);
        self.send_state_of(run);
        self.ended(run, by);
    }

    pub(super) fn send_state(&mut self) {
        let Some(run) = self.run.take() else { return };
        self.send_state_of(&run);
        self.run = Some(run);
    }

    /// Sends the state to its subscribers; returns the size of the messages to one of them.
    pub(super) fn send_state_of(&mut self, run: &Run<'_>) -> usize {
        let sensed = self.send_sensed_of(run);
        if !self.clients.values().any(|client| client.attached && client.state) {
            return sensed;
        }
        let (program, state) = (run.target.program(), run.target.state());
        let path = |id| program.unit(id).map_or("", |unit| &*unit.path);
        let numbered = (0..).map(afp_core::trace::TraceEntryId).zip(&program.entries);
        let values: Vec<_> = numbered.filter_map(|(id, it)| Some((it, state.entry(id)?))).collect();
        let text = |(entry, value): &(&Entry, &Datum)| {
            (entry.path.clone(), json!(value.in_unit(&entry.unit).to_string()))
        };
        let number = |(entry, value): &(&Entry, &Datum)| {
            Some((entry.path.clone(), json!(plotted(value, &entry.unit)?)))
        };
        let entries: serde_json::Map<_, _> = values.iter().map(text).collect();
        let numbers: serde_json::Map<_, _> = values.iter().filter_map(number).collect();
        let stack: Vec<_> = state.stack().into_iter().map(path).collect();
        let watching: Vec<_> = state.watching().map(path).collect();
        let suspended: serde_json::Map<_, _> = (state.suspended())
            .map(|(id, since)| (path(id).to_owned(), json!(since.as_secs_f64())))
            .collect();
        let held = matches!(run.mode, Mode::Held | Mode::Over);
        let at = run.target.now().as_secs_f64();
        let body = json!({
            "forced": run.forced(), "at": at, "stack": stack, "watching": watching, "entries": entries,
            "suspended": suspended,
            "numbers": numbers, "held": held,
            "sources": program.hashes().collect::<BTreeMap<_, _>>(),
            "moving": run.target.moving().into_iter().map(outline).collect::<Vec<_>>(),
            "pose": run.target.pose().map(|it| [it.x, it.y, it.heading].map(rounded)),
        });
        self.send_event_where(|client| client.attached && client.state, "afp/state", &body);
        sensed + body.to_string().len()
    }

    /// Sends the robot's signals to their subscribers.
    fn send_sensed_of(&mut self, run: &Run<'_>) -> usize {
        let wanted = |client: &Client| client.attached && client.sensed;
        if !self.clients.values().any(wanted) {
            return 0;
        }
        let sensed: Vec<_> = run.target.sensed().iter().map(in_json).collect();
        let body = json!({"at": run.target.now().as_secs_f64(), "sensed": sensed});
        self.send_event_where(wanted, "afp/sensed", &body);
        body.to_string().len()
    }
}

pub(super) fn stopped_event(
    reason: Reason,
    why: &str,
    at: Instant,
    hits: Vec<u64>,
) -> dapts::StoppedEvent {
    dapts::StoppedEvent {
        all_threads_stopped: Some(true),
        description: Some(format!("{why} at {:.3} s", at.as_secs_f64())),
        hit_breakpoint_ids: (!hits.is_empty()).then_some(hits),
        text: (reason == Reason::Exception).then(|| why.to_owned()),
        reason,
        thread_id: Some(1),
        ..dapts::StoppedEvent::default()
    }
}

fn outline((id, outline): (String, Vec<[f64; 2]>)) -> serde_json::Value {
    let outline: Vec<_> = outline.into_iter().map(|corner| corner.map(rounded)).collect();
    json!({"id": id, "outline": outline})
}

fn in_json(Sensed { signal, text, plotted, cone }: &Sensed) -> serde_json::Value {
    let cone = cone.map(|cone| {
        let Cone { pose, half_angle, range } = cone;
        let pose = [pose.x, pose.y, pose.heading].map(rounded);
        json!({"pose": pose, "half": rounded(half_angle), "range": range.map(rounded)})
    });
    json!({"signal": signal, "text": text, "plotted": plotted, "cone": cone})
}

/// Four decimals; a tenth of a millimetre is enough for pictures.
fn rounded(number: f64) -> f64 {
    (number * 1e4).round() / 1e4
}

/// A file in the protocol's format.
pub(super) fn source(program: &Program, file: usize) -> Option<dapts::Source> {
    let path = program.files.get(file)?;
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path).to_owned();
    // A text that differs from its file is requested by number.
    let source_reference = program.text_of(file).and(u32::try_from(file + 1).ok());
    let path = Some(path.clone());
    Some(dapts::Source { name: Some(name), path, source_reference, ..dapts::Source::default() })
}
