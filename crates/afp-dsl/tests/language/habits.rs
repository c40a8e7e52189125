//! Habits of other languages: one error at the right place, and a help that fixes it.

use crate::support;

use std::collections::BTreeMap;

use afp_dsl::{Compiled, Toolboxes};
use afp_syntax::diagnostics::{Diagnostic, Severity};

/// A valid plan. A case replaces the text at one or several '@PART'.
const PLAN: &str = "use carbot
use std

enum Side { left right }

table legs(far: length) { (1 m) }

plan Main {
    in goal: length = 1 m
    var side: Side = @side<Side.left>
    var pressed: bool = false
    var n: int = 0
    var way: length = 20 cm
    @start<start go>
    supervise escape: CheckEscapeButton { EscapeButtonPressed -> terminate }
    actor go: Forward(@args<distance = goal>) @head<> {
        supervise touch: CheckTouchSensor { @event<TouchSensorPressed -> back> }
        @body<>
        @state<ForwardSuccessful -> turn>
    }
    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> add }
    computation add: Assign(value = @value<n + 1>, result => n) { Done -> measure }
    computation measure: Assign(value = @way<20 cm>, result => way) { Done -> back }
    @item<>
    actor back: Forward(distance = -way, speed = 10 cm/s) { ForwardSuccessful -> split }
    computation split: Switch(value = side) { left -> hold, right -> terminate }
    computation hold: Is(value = pressed, equals = true) { Yes -> inner, No -> terminate }
    subplan inner: Other(driven => way) { OK -> terminate }
}

plan Other {
    out driven: length = 0 m
    start wait
    actor wait: Wait { Elapsed -> terminate }
}
@top<>
";

/// The names of its parts.
const PARTS: [&str; 11] =
    ["args", "head", "event", "body", "state", "start", "value", "way", "side", "item", "top"];

/// The plan with some of its parts replaced.
fn plan(parts: &BTreeMap<&'static str, String>) -> String {
    let mut text = String::new();
    for (index, piece) in PLAN.split('@').enumerate() {
        if index == 0 {
            text += piece;
            continue;
        }
        let (part, rest) = piece.split_once('<').unwrap();
        let end = rest.find(['>', '\n']).map(|_| {
            // The '>' of an arrow does not end the default text.
            let mut at = 0;
            loop {
                at += rest[at..].find('>').unwrap();
                if !rest[..at].ends_with('-') && !rest[..at].ends_with('=') {
                    return at;
                }
                at += 1;
            }
        });
        let end = end.unwrap();
        text += parts.get(part).map_or(&rest[..end], String::as_str);
        text += &rest[end + 1..];
    }
    text
}

fn errors(compiled: &Compiled) -> Vec<&Diagnostic> {
    compiled.diags.iter().filter(|each| each.severity == Severity::Error).collect()
}

/// Texts in single quotes.
fn quoted(help: &str) -> Vec<&str> {
    help.split('\'').skip(1).step_by(2).collect()
}

/// The plan text of a help, inserted into its parts instead of the errors.
fn followed(part: &'static str, help: &str) -> BTreeMap<&'static str, String> {
    let mut parts: BTreeMap<&str, String> = BTreeMap::new();
    for text in quoted(help) {
        let word = text.split([' ', '(']).next().unwrap_or_default();
        let part = match word {
            "plan" | "table" if text.contains('{') => "top",
            "supervise" if text.contains('{') => "body",
            "actor" | "computation" | "subplan" if text.contains('{') => "item",
            "var" | "in" | "const" if text.contains(' ') => "item",
            // An edge of another component stays.
            _ if help.contains(&format!("'{text}' in the braces of")) => continue,
            _ if matches!(part, "event" | "state") && text.contains(" -> ") => part,
            _ => continue,
        };
        parts.entry(part).or_default().push_str(&format!("{text}\n"));
    }
    parts
}

/// The errors of a case, and the messages about it.
fn judge(line: &str, toolboxes: &Toolboxes) -> (Option<&'static str>, String) {
    let fields: Vec<_> = line.split(" | ").map(str::trim).collect();
    let part = PARTS.into_iter().find(|part| *part == fields[1]).unwrap();
    let written = fields[2].replace('⏎', "\n");
    let of = |text: String| plan(&BTreeMap::from([(part, text)]));
    let marked = of(written.clone());
    let begin = marked.find('«').unwrap();
    let end = marked.rfind('»').unwrap() - '«'.len_utf8();
    let plain = of(written.replace(['«', '»'], ""));
    let compiled = support::compile(&plain, toolboxes);
    let found = errors(&compiled);
    let said: Vec<_> = found
        .iter()
        .map(|each| {
            let at = compiled.sources.text(each.span);
            let fix = each.fix.as_ref().map_or("", |fix| &fix.text);
            format!(
                "{} `{at}` {} / {} / {fix:?}",
                each.code.as_str(),
                each.message_text(),
                each.help_text()
            )
        })
        .collect();
    let said = said.join("\n        ");
    let [error] = &*found else { return (Some("count"), said) };
    let (first, last) = (error.span.start as usize, error.span.end as usize);
    if first > end || last < begin {
        return (Some("place"), said);
    }
    let help = error.help_text();
    let is_list = error.message_text().starts_with("expected") && quoted(&help).len() > 4;
    if is_list || help.starts_with("write an edge such as") {
        return (Some("says nothing of it"), said);
    }
    let mended = match &error.fix {
        Some(fix) => {
            let mut mended = plain.clone();
            mended.replace_range(fix.span.start as usize..fix.span.end as usize, &fix.text);
            mended
        }
        None => plan(&followed(part, &help)),
    };
    let after = support::compile(&mended, toolboxes);
    let left = errors(&after).iter().map(|each| each.message_text()).collect::<Vec<_>>();
    match left.is_empty() {
        true => (None, said),
        false => (Some("does not mend"), format!("{said}\n        then: {}", left.join(", "))),
    }
}

#[test]
fn habits_have_one_error_and_a_help_that_fixes_it() {
    let toolboxes = support::toolboxes();
    let base = plan(&BTreeMap::new());
    assert!(errors(&support::compile(&base, &toolboxes)).is_empty(), "{base}");
    let (mut wrong, mut all) = (Vec::new(), 0);
    for line in include_str!("../habits/cases.txt").lines() {
        if line.is_empty() || line.starts_with("//") {
            continue;
        }
        all += 1;
        let (fault, said) = judge(line, &toolboxes);
        if std::env::var_os("SHOW").is_some() || fault.is_some() {
            wrong.push(format!("{}: {line}\n        {said}", fault.unwrap_or("ok")));
        }
    }
    assert!(wrong.is_empty(), "{} of {all} cases:\n{}", wrong.len(), wrong.join("\n"));
}
