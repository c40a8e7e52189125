//! Trace records for timelines: in pieces during a run, or complete for a recorded run.

use afp_core::Instant;
use afp_dsl::unfold::ComponentKind;
use afp_session::EventKind;
use serde_json::{Value, json};

use super::{Adapter, Run};
use crate::program::Program;
use crate::target::{Advance, Happened, Position};

/// The most records in a message.
const PIECE: usize = 2_000;

impl Adapter<'_> {
    /// Starts or ends the asking client's trace. For a recorded run it sends all records.
    pub(super) fn trace(&mut self, wanted: bool) -> Result<(), String> {
        let Some(mut run) = self.run.take() else { return Ok(()) };
        // Earlier events go to the earlier subscribers.
        self.send_trace(&mut run);
        if let Some(client) = self.clients.get_mut(&self.asker) {
            client.trace = wanted;
        }
        let told = if wanted && run.target.is_recorded() {
            recorded(&mut run)
        } else {
            let anybody = self.clients.values().any(|client| client.attached && client.trace);
            run.traced = (anybody && !run.target.is_recorded()).then(Vec::new);
            Ok(Vec::new())
        };
        self.run = Some(run);
        let pieces = told?;
        for piece in pieces.chunks(PIECE) {
            self.send_event(self.asker, "afp/trace", json!({"records": piece}));
        }
        Ok(())
    }

    /// Sends the records since the last message.
    pub(super) fn send_trace(&mut self, run: &mut Run<'_>) {
        let Some(records) = run.traced.as_mut().filter(|records| !records.is_empty()) else {
            return;
        };
        let records = std::mem::take(records);
        let body = json!({"records": records});
        self.send_event_where(|client| client.attached && client.trace, "afp/trace", &body);
    }
}

impl Run<'_> {
    /// Records the events of a step, if a client subscribed to the trace.
    pub(super) fn keep_trace(&mut self, happened: &[Happened]) {
        let step = self.target.steps();
        let program = self.target.program();
        if let Some(records) = &mut self.traced {
            records.extend(happened.iter().filter_map(|what| record(what, step, program)));
        }
    }
}

/// Returns all records of a recorded run, and restores its position.
fn recorded(run: &mut Run<'_>) -> Result<Vec<Value>, String> {
    let here = run.target.steps();
    let program = &run.target.program().clone();
    let mut all = Vec::new();
    run.target.seek(Position::Step(0))?;
    loop {
        let step = run.target.steps() + 1;
        let advance = run
            .target
            .advance(Instant::MAX, &mut |what, _| all.extend(record(what, step, program)))?;
        if advance != Advance::On {
            break;
        }
    }
    run.target.seek(Position::Step(here))?;
    Ok(all)
}

/// Returns a record; `None` for inputs and polls of components.
fn record(what: &Happened, step: u64, program: &Program) -> Option<Value> {
    let event = &what.event;
    let kind = match event.kind {
        EventKind::Started => "started",
        EventKind::Finished(_) => "finished",
        EventKind::Interrupted => "interrupted",
        EventKind::Diverted { .. } => "diverted",
        EventKind::Suspended { .. } => "suspended",
        EventKind::Returned { .. } => "returned",
        EventKind::Abandoned { .. } => "abandoned",
        EventKind::Held { .. } => "held",
        EventKind::Released => "released",
        EventKind::Event(_) => "event",
        EventKind::Committed { .. } => "committed",
        EventKind::Missed(_) => "missed",
        EventKind::Faulted(_) => "faulted",
        EventKind::Ended { .. } => "ended",
        EventKind::Requested(_) => "requested",
        _ => return None,
    };
    let mut record = json!({
        "at": event.at.as_secs_f64(), "step": step, "kind": kind, "path": event.component.path, "text": what.text,
    });
    if program.unit(event.component.id).is_some_and(|unit| unit.kind == ComponentKind::Supervisor) {
        record["supervisor"] = json!(true);
    }
    if let Some(request) = event.facts().request {
        record["text"] = json!(request.what.to_string());
    }
    if let EventKind::Committed { entry, new, unit, .. } = &event.kind {
        record["entry"] = json!(entry);
        record["value"] = json!(new.in_unit(unit).to_string());
    }
    Some(record)
}
