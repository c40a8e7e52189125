//! A plan whose names are the words that generated code uses itself: locals, functions, methods,
//! types and modules. The words are collected, so the test covers future words, too.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::io;

use afp_codegen::Options;
use afp_dsl::Toolboxes;
use afp_dsl::compile_unchecked;
use afp_dsl::files::Texts;
use afp_dsl::toolbox::Toolbox;
use afp_syntax::source::Source;

/// The words of generated code, by their normalized form without case and `_`.
#[derive(Default)]
pub struct Words {
    /// Names of values, including constants.
    values: BTreeMap<String, String>,
    types: BTreeMap<String, String>,
}

/// Keywords, which are not names.
const LANGUAGE: &[&str] = &[
    "actor",
    "computation",
    "const",
    "enum",
    "in",
    "live",
    "on",
    "out",
    "plan",
    "start",
    "subplan",
    "supervise",
    "table",
    "use",
    "var",
];

impl Words {
    /// Adds the words of a plan's code that are neither in its text nor in its own name.
    pub fn add(&mut self, name: &str, text: &str, code: &str) {
        let mut own: BTreeSet<_> = words(text).filter(|w| !LANGUAGE.contains(w)).map(key).collect();
        own.insert(key(name));
        let is_own = |word: &str| is_made_of(word, &own);
        let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
        // Every second part is a quoted string.
        let parts = lines.flat_map(|line| line.split('"').step_by(2));
        for word in parts.flat_map(words).filter(|word| !is_own(word)) {
            let is_type = word.starts_with(char::is_uppercase)
                && (word.len() == 1 || word.contains(char::is_lowercase));
            let (of, word) = match is_type {
                true => (&mut self.types, word.to_owned()),
                false => (&mut self.values, word.to_ascii_lowercase()),
            };
            of.entry(key(&word)).or_insert(word);
        }
    }
}

/// Whether a word is a name of the text, or is built from one or two of them for a component or its
/// number.
fn is_made_of(word: &str, own: &BTreeSet<String>) -> bool {
    let ends = ["_inputs", "_live", "_outputs", "_PLACE"].into_iter();
    let base = ends.filter_map(|end| word.strip_suffix(end)).next();
    let is_number = !word.contains(char::is_lowercase);
    let of_component = base.or(is_number.then_some(word)).is_some_and(|base| {
        let mut cuts = base.match_indices('_').map(|(at, _)| base.split_at(at));
        own.contains(&key(base))
            || cuts.any(|(a, b)| own.contains(&key(a)) && own.contains(&key(b)))
    });
    of_component || own.contains(&key(word))
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| word.starts_with(|first: char| first.is_ascii_alphabetic()))
}

fn key(word: &str) -> String {
    word.replace('_', "").to_ascii_lowercase()
}

/// The path of the code in the test.
const MODULE: &str = "crate::made::words";

/// The toolbox and the plan with their Rust.
pub fn code(words: &Words, toolboxes: &Toolboxes) -> io::Result<String> {
    let [mut names, types] = [&words.values, &words.types].map(|words| {
        let names = words.values().map(String::as_str);
        names.filter(|name| is_name(name, toolboxes)).collect::<Vec<_>>()
    });
    names.truncate(names.len() / TYPES.len() * TYPES.len());
    let (toolbox, plan) = (toolbox(&names), plan(&names, &types));
    let source = Source::new("words.afp", toolbox.clone());
    let mut all = toolboxes.clone();
    all.add(source.clone(), MODULE);
    let (declared, diags) = Toolbox::parse(&source, 0, MODULE);
    let declared = declared.ok_or_else(|| io::Error::other(format!("{diags:?}\n{toolbox}")))?;
    let templates = afp_codegen::toolbox(&declared, &Options::default());
    let templates = afp_codegen::file(templates);
    let plan_code = super::module("plan", "plan.afp".as_ref(), &plan, &all)?;
    let (gives, takes) = (given(&names), taken(&names));
    Ok(format!(
        "/// The text of the toolbox.
pub const TOOLBOX: &str = {toolbox:?};
pub const PLAN: &str = {plan:?};
pub {plan_code}
/// The toolbox.
pub mod words {{
pub mod templates {{
{templates}
}}
#[derive(Clone)]
pub struct Give;
impl ::afp_core::Computation<templates::Give> for Give {{
    fn compute(_: templates::give::Inputs) -> Result<templates::give::State, ::afp_core::Fault> {{
        Ok(templates::give::State::Done {{ {gives} }})
    }}
}}
#[derive(Clone)]
pub struct Take;
impl ::afp_core::Computation<templates::Take> for Take {{
    fn compute(inputs: templates::take::Inputs<'_>) -> Result<templates::take::State, ::afp_core::Fault> {{
        let sum: f64 = {takes};
        Ok(templates::take::State::Done {{ sum }})
    }}
}}
}}
"
    ))
}

/// Whether the language accepts a word as a name of every kind here.
fn is_name(word: &str, toolboxes: &Toolboxes) -> bool {
    let plan = format!(
        "use std\ntable t({word}: int) {{ (1) }}\nenum {word} {{ a }}\n\
         plan P {{ start log var {word}: int = 0 computation log: Log(value = {word}) {{ Done -> terminate }} }}\n\
         plan Q {{ start {word} computation {word}: Log(value = 1) {{ Done -> terminate }} }}"
    );
    let toolbox = format!(
        "toolbox t\ncomputation A {{ in {word}: int state Done }}\n\
         computation B {{ out {word}: int state Done }}"
    );
    let compiled = compile_unchecked(&Source::new("p.afp", plan), toolboxes, &Texts::default());
    compiled.graph.is_some() && Toolbox::parse(&Source::new("t.afp", toolbox), 0, "t").0.is_some()
}

/// The types of ports and entries, in turn.
const TYPES: [&str; 4] = ["int", "float", "length", "string"];

/// Names with the indices of their types.
fn ports<'n>(names: &'n [&'n str]) -> impl Iterator<Item = (&'n str, usize)> {
    names.iter().enumerate().map(|(i, name)| (*name, i % TYPES.len()))
}

/// A toolbox whose computations have an input and an output for each name.
fn toolbox(names: &[&str]) -> String {
    let mut text = "/// Ports of all names.\ntoolbox words version \"1.0\"\n".to_owned();
    text += "/// Gives values.\ncomputation Give {\n";
    for (name, ty) in ports(names) {
        // A plan's int or string becomes a float here.
        let ty = if ty == 2 { "length" } else { "float" };
        let _ = writeln!(text, "    /// A value.\n    out {name}: {ty}");
    }
    text += "    /// Always reached.\n    state Done\n}\n/// Takes values.\ncomputation Take {\n";
    for (name, ty) in ports(names) {
        let _ = writeln!(text, "    /// A value.\n    in {name}: {}", TYPES[ty]);
    }
    text + "    /// What they make together.\n    out sum: float\n    /// Always reached.\n    state Done\n}\n"
}

/// The fields of the outputs.
fn given(names: &[&str]) -> String {
    let fields = ports(names).map(|(name, ty)| match ty {
        2 => format!("r#{name}: ::afp_core::quantity::Length::from_si(2.0)"),
        _ => format!("r#{name}: 2.0"),
    });
    fields.collect::<Vec<_>>().join(", ")
}

/// The sum of the inputs.
fn taken(names: &[&str]) -> String {
    let terms = ports(names).map(|(name, ty)| match ty {
        0 => format!("inputs.r#{name} as f64"),
        1 => format!("inputs.r#{name}"),
        2 => format!("inputs.r#{name}.si()"),
        _ => format!("inputs.r#{name}.len() as f64"),
    });
    terms.collect::<Vec<_>>().join(" + ")
}

/// A plan with these names, which uses plans with the names of types and visits all of its elements
/// once.
fn plan(names: &[&str], types: &[&str]) -> String {
    let cells = |of: fn(&str, usize) -> String| {
        ports(names).map(|(name, ty)| of(name, ty)).collect::<Vec<_>>().join(", ")
    };
    let (columns, row) = (
        cells(|name, ty| format!("{name}: {}", TYPES[ty])),
        cells(|_, ty| ["3", "3.5", "3 m", "\"three\""][ty].to_owned()),
    );
    let (written, read) =
        (cells(|name, _| format!("{name} => {name}")), cells(|name, _| format!("{name} = {name}")));
    let variants = types.iter().map(|name| format!("{name} ")).collect::<String>();
    let mut text = format!(
        "use std\nuse testing\nuse words\n\ntable allCells({columns}) {{\n    ({row})\n}}\n\
         enum AllWords {{ First {variants}}}\nplan Main {{\n    start giveAll\n    var allWords: AllWords = AllWords.First\n"
    );
    for (i, name) in names.iter().enumerate() {
        let value = ["1 from 0 to 9", "1.5 from 0 to 9", "1 m from 0 m to 9 m", "\"one\""][i % 4];
        let _ = writeln!(text, "    var {name}: {} = {value}", TYPES[i % 4]);
    }
    let _ = write!(
        text,
        "    computation giveAll: Give({written}) {{ Done -> takeAll }}\n    \
             computation takeAll: Take({read}) {{ Done -> readAll }}\n    \
             computation readAll: Row(table = allCells, index = 0, {written}) {{ Row -> read0  End -> read0 }}\n"
    );
    for (i, group) in names.chunks(TYPES.len()).enumerate() {
        let sum = group.join(" + \" \" + ");
        let next = if (i + 1) * TYPES.len() >= names.len() { 0 } else { i + 1 };
        let next = if next == 0 { "goElements".to_owned() } else { format!("read{next}") };
        let _ = writeln!(text, "    computation read{i}: Log(value = {sum}) {{ Done -> {next} }}");
    }
    text += "    subplan goElements: AllElements() { OK -> goPlan0 }\n";
    for (i, name) in types.iter().enumerate() {
        let last = i + 1 == types.len();
        let next = if last { "terminate".to_owned() } else { format!("goPlan{}", i + 1) };
        let _ = writeln!(text, "    subplan goPlan{i}: {name}(given = 1.5) {{ OK -> {next} }}");
    }
    text += "}\n";
    for name in types {
        let _ = writeln!(
            text,
            "plan {name} {{ start log in given: float computation log: Log(value = given) {{ Done -> terminate }} }}"
        );
    }
    text + &elements(names)
}

/// A plan whose elements and supervisors have these names.
fn elements(names: &[&str]) -> String {
    let first = names.first().map_or("lastOfAll", |name| name);
    let mut text = format!(
        "plan AllElements {{\n    start {first}\n    var sumInt: int = 1\n    var sumFloat: float = 1.5 from 0 to 9\n    \
             var sumText: string = \"a\"\n"
    );
    for (i, name) in names.iter().enumerate() {
        let next = names.get(i + 1).map_or("lastOfAll", |next| next);
        text += &element(i, name, next);
    }
    text + "    computation lastOfAll: Log(value = sumInt) { Done -> terminate }\n}\n"
}

fn element(i: usize, name: &str, next: &str) -> String {
    match i % 3 {
        0 => format!(
            "    computation {name}: Assign(value = sumInt + 1, result => sumInt) {{ Done -> {next} }}\n"
        ),
        1 => {
            format!("    computation {name}: Log(value = sumText + sumInt) {{ Done -> {next} }}\n")
        }
        _ => format!(
            "    actor {name}: Work(name = \"x\", value = sumFloat, label = \"l\" + sumInt, text => sumText, result => sumFloat) {{\n        \
                 supervise {name}: Watch(name = \"g\", limit = sumFloat, result => sumFloat) {{ First -> {next}  Second -> ignore  Third -> ignore }}\n        \
                 Done -> {next}\n        Other -> {next}\n    }}\n"
        ),
    }
}
