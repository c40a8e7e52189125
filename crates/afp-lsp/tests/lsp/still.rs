//! Drawings are stable: a change moves only the boxes that a growing box would cover.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::client::{Client, Files};

const URI: &str = "file:///w/plan.afp";
const PLAN: &str = include_str!("../../../../plans/wall_following.afp");

/// A box's area, left, top, right and bottom, and the corner with its position.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shown {
    outer: [f64; 4],
    corner: [f64; 2],
}

impl Shown {
    /// Whether another box is closer than the length of an arrow's tip.
    fn covers(&self, other: &Shown) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.outer, other.outer);
        a < g + 13.0 && e < c + 13.0 && b < h + 37.0 && f < d + 37.0
    }
}

/// A page with a plan, which applies its edits and can undo them.
struct Page {
    client: Client,
    texts: BTreeMap<String, String>,
    version: i32,
}

impl Page {
    fn new() -> Page {
        let mut client = Client::ready(Files::default());
        client.open(URI, PLAN);
        client.open(&format!("{URI}.layout"), "");
        let texts = [(URI.to_owned(), PLAN.to_owned()), (format!("{URI}.layout"), String::new())];
        Page { client, texts: texts.into(), version: 1 }
    }

    fn boxes(&mut self) -> BTreeMap<String, Shown> {
        let params = json!({ "textDocument": { "uri": URI } });
        let answer = self.client.request("afp/drawing", params).swap_remove(0);
        let number = |value: &Value| value.as_f64().unwrap();
        let shown = |one: &Value| {
            let [x, y, width, height] = [0, 1, 2, 3].map(|at| number(&one["outer"][at]));
            let corner = [0, 1].map(|at| number(&one["rect"][at]));
            let outer = [x, y, x + width, y + height];
            (one["item"].as_str().unwrap().to_owned(), Shown { outer, corner })
        };
        answer["result"]["elements"].as_array().unwrap().iter().map(shown).collect()
    }

    /// Makes a change; returns false if the server rejects it.
    fn edit(&mut self, change: &Value) -> bool {
        let params = json!({ "textDocument": { "uri": URI }, "changes": [change] });
        let answer = self.client.request("afp/edit", params).swap_remove(0);
        let Some(files) = answer["result"]["edit"]["changes"].as_object() else { return false };
        for (uri, edits) in files {
            let mut text = self.texts[uri].clone();
            for edit in edits.as_array().unwrap().iter().rev() {
                let at = |end: &str| offset(&text, &edit["range"][end]);
                let range = at("start")..at("end");
                text.replace_range(range, edit["newText"].as_str().unwrap());
            }
            self.put(uri, text);
        }
        true
    }

    fn put(&mut self, uri: &str, text: String) {
        self.version += 1;
        let document = json!({ "uri": uri, "version": self.version });
        let changes = json!([{ "text": text }]);
        let params = json!({ "textDocument": document, "contentChanges": changes });
        self.client.notify("textDocument/didChange", params);
        self.texts.insert(uri.to_owned(), text);
    }
}

/// The byte of a position; the plan is ASCII.
fn offset(text: &str, position: &Value) -> usize {
    let line = position["line"].as_u64().unwrap() as usize;
    let before: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    before + position["character"].as_u64().unwrap() as usize
}

fn change(next: &mut impl FnMut(usize) -> usize, names: &[String]) -> Value {
    let mut one = || names[next(names.len())].clone();
    let (item, to) = (one(), one());
    let name = to.split('.').nth(1).unwrap_or_default().to_owned();
    let add = |owner: Option<&str>, text: &str| json!({ "add": { "plan": "WallFollowing", "owner": owner, "text": text } });
    match next(8) {
        0 => add(None, "actor fresh: Turn(angle = 5 deg) {}"),
        1 => add(Some(&name), "supervise fresh: CheckTouchSensor {}"),
        2 => add(None, "var fresh: length = 3 cm"),
        3 => json!({ "remove": { "item": item } }),
        4 => json!({ "rename": { "item": item, "to": format!("aNameThatIsLong{}", next(1000)) } }),
        5 => json!({ "connect": { "from": item, "outcome": "Error", "to": name } }),
        6 => json!({ "bind": { "component": item, "port": "speed", "to": { "in": "2 cm/s" } } }),
        _ => json!({ "disconnect": { "from": item, "outcome": "ForwardSuccessful" } }),
    }
}

#[test]
fn only_boxes_under_a_grown_one_move() {
    let mut page = Page::new();
    let (first, start) = (page.texts.clone(), page.boxes());
    let mut state = 7_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 33) as usize % below
    };
    let rounds = if std::env::var_os("AFP_BY_NIGHT").is_some() { 2000 } else { 120 };
    let (mut before, mut made) = (start.clone(), Vec::new());
    for _ in 0..rounds {
        let names: Vec<_> = before.keys().cloned().collect();
        let (texts, change) = (page.texts.clone(), change(&mut next, &names));
        if !page.edit(&change) {
            continue;
        }
        made.push((texts, before.clone()));
        let after = page.boxes();
        let has_moved = |was: &Shown, is: &Shown| was.corner != is.corner;
        let moved = after
            .iter()
            .filter(|(item, is)| before.get(*item).is_some_and(|was| has_moved(was, is)));
        for (item, is) in moved {
            let was = before[item];
            assert_eq!(was.corner[0], is.corner[0], "'{item}' moved to a side: {change}");
            let mut others = after.iter().filter(|(other, _)| *other != item);
            let covered = others.any(|(other, now)| {
                now.covers(&was) && !before.get(other).is_some_and(|old| old == now)
            });
            assert!(covered, "'{item}' moved for nothing: {change}");
        }
        before = after;
    }
    assert!(made.len() > rounds / 3, "{} of {rounds} were made", made.len());
    // The changes are undone one after the other.
    for (texts, boxes) in made.into_iter().rev() {
        texts.into_iter().for_each(|(uri, text)| page.put(&uri, text));
        assert_eq!(page.boxes(), boxes);
    }
    assert_eq!((page.texts.clone(), page.boxes()), (first, start));
}
