//! Messages to the debug adapter: each request is answered once, and no message makes the adapter
//! fail.

use std::sync::{Arc, LazyLock};
use std::time::Duration as Wall;

use afp_core::Instant;
use afp_core::trace::{ComponentId, Outcome};
use afp_debug::{Adapter, Host, Launch, LogTarget, Outgoing, Program, Target};
use afp_dsl::Toolboxes;
use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_output::frames::Frames;
use afp_session::{Datum, EventKind, NamedComponent, NamedOutcome, RunEvent};
use afp_syntax::source::Source;
use serde_json::Value;

use crate::text::text;

const PLAN: &str = "use std

plan P {
    in  pause: duration = 1 s
    var left: int = 0
    start a
    actor a: Wait(duration = pause) {
        Elapsed -> b
        supervise late: CheckTimeout(duration = 4 s) { TimedOut -> b }
    }
    actor b: Wait(duration = 2 * pause) { Elapsed -> a }
}
";

/// The plan as a program, made once.
static PROGRAM: LazyLock<Option<Arc<Program>>> = LazyLock::new(|| {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new("plan.afp", PLAN);
    let compiled = compile_plan(&source, &toolboxes, &Texts::default(), None);
    let program = Program::new(compiled.graph.as_ref()?, &compiled.sources, &str::to_owned);
    Some(Arc::new(program))
});

/// A log of the plan, in which its elements alternate.
struct Recorded;

impl Host<'static> for Recorded {
    fn launch(&mut self, _: &Launch) -> Result<Box<dyn Target>, String> {
        let program = PROGRAM.clone().ok_or("the plan is wrong")?;
        let units = (0..).map(ComponentId).zip(&program.units).skip(1);
        let events = units.cycle().take(60).zip(1_u64..).flat_map(|((id, unit), second)| {
            let (port, value, unit_of) = (String::new(), Datum::Unset, String::new());
            let input = EventKind::Input { port, value, unit: unit_of };
            let (name, target) = (String::new(), String::new());
            let finished =
                EventKind::Finished(NamedOutcome { name, outcome: Outcome::Declared(0), target });
            [EventKind::Started, input, finished].map(|kind| RunEvent {
                at: Instant::from_nanos(second * 1_000_000_000),
                component: NamedComponent { path: unit.path.clone(), id },
                kind,
            })
        });
        let events = events.collect();
        Ok(Box::new(LogTarget::new(program, events)?))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Each line that is a request is sent, by one client or, if it begins with a space, by another
/// one; the adapter must reject other lines. The bytes are also read as a stream.
///
/// # Panics
/// A request has no response or several.
pub fn debugger(data: &[u8]) {
    let mut frames = Frames::default();
    for piece in data.chunks(7) {
        frames.push(piece);
        while let Ok(Some(_)) = frames.next_message() {}
    }
    let mut adapter = Adapter::new(Box::new(Recorded));
    let clients = [adapter.join(), adapter.join()];
    let mut now = Wall::ZERO;
    for line in text(data).lines() {
        let from = clients[usize::from(line.starts_with(' '))];
        let message = serde_json::from_str::<Value>(line).unwrap_or_default();
        let is_answer = message["type"] == "response";
        let is_request = serde_json::from_value::<dapts::Request>(message).is_ok();
        let asked = usize::from(is_request && !is_answer);
        let said = adapter.handle(from, line, now);
        let is_response = |said: &&Outgoing| {
            let message = serde_json::from_str::<Value>(&said.message).unwrap_or_default();
            said.to == from && message["type"] == "response"
        };
        assert_eq!(said.iter().filter(is_response).count(), asked, "{line}");
        for _ in 0..3 {
            now += Wall::from_millis(50);
            adapter.tick(now);
        }
    }
}
