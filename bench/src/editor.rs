//! The delays of the language server for typing and dragging: from a client message to the last
//! response.

use std::time::{Duration, Instant};

use afp_counting::held;
use afp_lsp::{Message, NoFiles, Server};
use lsp_server::{Notification, Request};
use serde_json::{Value, json};

use crate::big_plan;
use crate::report::{Report, Row};

const URI: &str = "file:///big.afp";

/// The number of actors, and the limits of each answer in milliseconds: diagnostics after a change,
/// completion, an edit, the drawing after a drop.
const CASES: [(usize, [f64; 4]); 2] =
    [(60, [20.0, 10.0, 10.0, 30.0]), (1_000, [150.0, 30.0, 50.0, 50.0])];

/// The number of measurements after some warm-up turns; the median counts.
const TURNS: usize = 30;
const WARM: usize = 5;

/// The two numbers of edits between which a server's memory must not grow.
const EDITS: [usize; 2] = [1_000, 100_000];
const GROWTH: f64 = 1.1;

/// Ten errors from every stage of the compiler.
const WRONG: &str = "
plan Wrong {
    in  far: lenght = 3
    var far: int = 2 m
    start nowhere
    actor a: Forwad { ForwardSuccessful -> b }
    actor c: Forward(distance = 30, sped = 2) { ForwardSuccesful -> c }
    actor d: Turn(angle = unknown + 1) { }
    subplan e: Wrong { OK -> e }
    supervise g: CheckTouchSensor every 1 m { Pressed -> h }
}
";

/// The time of an answer, in milliseconds.
#[derive(Clone, Copy)]
struct Took {
    median: f64,
    /// The 95th percentile.
    most: f64,
}

/// A client that types, sends requests and drags.
struct Client {
    server: Server,
    asked: i32,
    version: i32,
}

/// Measures every answer in plans of both sizes, and the server's final memory.
pub fn run(_: u32, report: &mut Report) {
    for (actors, limits) in CASES {
        answers(report, &format!("{actors} actors"), big_plan::text(actors), limits);
        let wrong = big_plan::text(actors) + WRONG;
        answers(report, &format!("{actors} actors and ten errors"), wrong, limits);
    }
    held_after_edits(report);
}

fn answers(report: &mut Report, case: &str, text: String, limits: [f64; 4]) {
    let mut client = Client::new(text);
    let measured = [
        ("diagnostics after a change", client.took(Client::type_a_letter)),
        ("completion after a change", client.took(Client::complete)),
        ("edit", client.took(Client::connect)),
        ("drawing after a drop", client.took(Client::drop_a_box)),
    ];
    for ((name, Took { median, most }), limit) in measured.into_iter().zip(limits) {
        let row = Row::new(format!("editor/{case}, {name}"), median, "ms");
        let holds = median <= limit && most <= 2.0 * limit;
        report.add(row.limit(format!("<= {limit} ms, 95 % <= twice ({most:.2} ms)"), holds));
    }
}

/// The server's memory must not grow with the number of edits.
fn held_after_edits(report: &mut Report) {
    let before = held();
    let mut client = Client::new(big_plan::text(3));
    let mut after = [0.0; 2];
    let mut turn = 0;
    for (held_then, edits) in after.iter_mut().zip(EDITS) {
        while turn < edits {
            client.type_a_letter(turn);
            turn += 1;
        }
        *held_then = (held() - before) as f64;
    }
    let [few, many] = after;
    let name = format!("editor/held after {} edits", EDITS[0]);
    report.add(Row::new(name.clone(), few / 1024.0, "KiB"));
    let row = Row::new(format!("editor/held after {} edits", EDITS[1]), many / 1024.0, "KiB");
    let ratio = many / few;
    report.add(row.against(name, ratio).limit(format!("<= {GROWTH}"), ratio <= GROWTH));
}

impl Client {
    fn new(text: String) -> Client {
        let mut client = Client { server: Server::new(Box::new(NoFiles)), asked: 0, version: 1 };
        client.ask("initialize", json!({ "capabilities": {} }));
        for (uri, text) in [(URI.to_owned(), text), (format!("{URI}.layout"), String::new())] {
            let document = json!({ "uri": uri, "languageId": "afp", "version": 1, "text": text });
            client.tell("textDocument/didOpen", json!({ "textDocument": document }));
        }
        client.ask("afp/drawing", json!({ "textDocument": { "uri": URI }, "subscribe": true }));
        client
    }

    fn ask(&mut self, method: &str, params: Value) -> Vec<Message> {
        self.asked += 1;
        let request = Request { id: self.asked.into(), method: method.to_owned(), params };
        let said = self.server.handle(request.into());
        let failed = |message: &Message| matches!(message, Message::Response(it) if it.response_result.is_err());
        assert!(!said.iter().any(failed), "{said:?}");
        said
    }

    fn tell(&mut self, method: &str, params: Value) -> Vec<Message> {
        self.server.handle(Notification { method: method.to_owned(), params }.into());
        self.server.idle()
    }

    /// The times of many turns, as returned by the action.
    fn took(&mut self, action: fn(&mut Client, usize) -> Duration) -> Took {
        let mut times: Vec<_> =
            (0..WARM + TURNS).map(|turn| action(self, turn)).skip(WARM).collect();
        times.sort();
        let [median, most] = [times.len() / 2, times.len() * 19 / 20];
        let ms = |place: usize| times.get(place).map_or(f64::NAN, |it| it.as_secs_f64() * 1e3);
        Took { median: ms(median), most: ms(most) }
    }

    fn change(&mut self, uri: &str, line: u32, new: &str, width: u32) -> Vec<Message> {
        self.version += 1;
        let range = json!({ "start": { "line": line, "character": 0 }, "end": { "line": line, "character": width } });
        let document = json!({ "uri": uri, "version": self.version });
        let changes = json!([{ "range": range, "text": new }]);
        self.tell(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": changes }),
        )
    }

    /// Lengthens and shortens a comment at the top, and adds and removes an error.
    fn type_a_letter(&mut self, turn: usize) -> Duration {
        let begun = Instant::now();
        let said = match turn % 2 {
            0 => self.change(URI, 1, "use nothing", 0),
            _ => self.change(URI, 1, "", 11),
        };
        let time = begun.elapsed();
        assert!(!said.is_empty(), "a new or removed error is reported");
        time
    }

    fn complete(&mut self, turn: usize) -> Duration {
        self.version += 1;
        let text = if turn.is_multiple_of(2) { "// a" } else { "// b" };
        self.change(URI, 2, text, if turn == 0 { 0 } else { 4 });
        let at =
            json!({ "textDocument": { "uri": URI }, "position": { "line": 5, "character": 4 } });
        let begun = Instant::now();
        self.ask("textDocument/completion", at);
        begun.elapsed()
    }

    fn connect(&mut self, _: usize) -> Duration {
        let change = json!({ "setDoc": { "item": "Big", "text": "Somewhere else." } });
        let params = json!({ "textDocument": { "uri": URI }, "changes": [change] });
        let begun = Instant::now();
        self.ask("afp/edit", params);
        begun.elapsed()
    }

    /// Moves a box: requests the edit of its place, applies it, and waits for the new edges.
    fn drop_a_box(&mut self, turn: usize) -> Duration {
        let Some(name) = self.item() else { return Duration::MAX };
        let at = [40 + 12 * (turn as i32 % 2), 60];
        let begun = Instant::now();
        let places = json!({ name.as_str(): at });
        self.ask("afp/place", json!({ "textDocument": { "uri": URI }, "places": places }));
        let line = format!("{name} {} {}\n", at[0], at[1]);
        self.version += 1;
        let document = json!({ "uri": format!("{URI}.layout"), "version": self.version });
        let said = self.tell(
            "textDocument/didChange",
            json!({ "textDocument": document, "contentChanges": [{ "text": line }] }),
        );
        let time = begun.elapsed();
        assert!(!said.is_empty(), "the drawing has changed");
        time
    }

    /// The path of an actor in the middle of the plan.
    fn item(&mut self) -> Option<String> {
        let params = json!({ "textDocument": { "uri": URI } });
        let said = self.ask("textDocument/documentSymbol", params);
        let Message::Response(response) = said.first()? else { return None };
        let list = response.response_result.as_ref().ok()?.as_array()?;
        let actors: Vec<_> =
            list.iter().filter(|one| one["kind"] == 12 && one["containerName"] == "Big").collect();
        let name = actors.get(actors.len() / 2)?["name"].as_str()?;
        Some(format!("Big.{name}"))
    }
}
