//! A single mistake gives one error at its place: mutations of the shipped plans and scenarios.
//!
//! `AFP_MUTANTS=5000` draws more of them, and shows all without exactly one error nearby;
//! `AFP_MUTANTS_SEED=7` draws others.

use std::collections::BTreeMap;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_syntax::diagnostics::{Diagnostic, Diagnostics, Edit, Severity};
use afp_syntax::source::Source;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use crate::support::{self, files, read};

/// Folders of shipped plans and scenarios, and their toolboxes.
const FOLDERS: [&str; 6] = [
    "../../plans",
    "../../plans/tests",
    "../../examples/vacuum/plans",
    "../../examples/vacuum/plans/tests",
    "../../examples/embed/plans",
    "../../examples/peers/plans",
];
const TOOLBOXES: [&str; 7] = [
    "../../examples/vacuum/vacuum.afp",
    "../../examples/embed/shop.afp",
    "../../examples/peers/toolboxes/air.afp",
    "../../examples/peers/toolboxes/bench.afp",
    "../../examples/peers/toolboxes/brick.afp",
    "../../examples/peers/toolboxes/house.afp",
    "../../examples/peers/toolboxes/nav.afp",
];

/// Number of invalid mutants per seed.
const MUTANTS: usize = 500;

/// The default seeds: the first by day, all with `AFP_BY_NIGHT`.
const SEEDS: [u8; 5] = [13, 1, 2, 3, 4];

fn seeds() -> &'static [u8] {
    let count = if std::env::var_os("AFP_BY_NIGHT").is_some() { SEEDS.len() } else { 1 };
    &SEEDS[..count]
}

/// A file of the corpus: path and text.
type File = (String, String);

/// A text with one mistake.
struct Mutant {
    path: String,
    text: String,
    /// The change.
    what: String,
    /// The first and the last changed line, from 0.
    lines: (usize, usize),
}

struct Dice(TestRunner);

impl Dice {
    fn below(&mut self, bound: usize) -> usize {
        (0..bound).new_tree(&mut self.0).unwrap().current()
    }

    fn one_of<'a, T>(&mut self, all: &'a [T]) -> &'a T {
        &all[self.below(all.len())]
    }
}

/// The places of a text's tokens.
fn tokens(text: &str) -> Vec<std::ops::Range<usize>> {
    let parse = afp_syntax::parse(text, 0, &mut Diagnostics::default());
    let elements = parse.root().descendants_with_tokens();
    let tokens = elements.filter_map(|element| element.into_token());
    let solid = tokens.filter(|token| !token.kind().is_trivia());
    solid.map(|token| token.text_range().into()).collect()
}

/// Changes one token of a text.
fn mutate((path, text): &File, dice: &mut Dice) -> Mutant {
    const SIGNS: [&str; 14] =
        ["{", "}", "(", ")", ",", ":", "=", "=>", "->", ";", ".", "#", "-", "x"];
    const UNITS: [&str; 6] = ["cm", "deg", "s", "m/s", "kg", "parsec"];
    let tokens = tokens(text);
    let at = dice.below(tokens.len() - 1);
    let (token, next) = (tokens[at].clone(), tokens[at + 1].clone());
    let old = &text[token.clone()];
    let is_word = old.starts_with(|letter: char| letter.is_ascii_alphabetic());
    let is_number = old.starts_with(|letter: char| letter.is_ascii_digit());
    let same_line = !text[token.end..next.start].contains('\n');
    let (range, new) = match dice.below(7) {
        0 | 1 if is_word => (token.clone(), misspelt(old, dice)),
        0 | 1 if is_number => {
            // The unit is the next token.
            (next, (*dice.one_of(&UNITS)).to_owned())
        }
        2 => (token.clone(), format!("{old} {old}")),
        3 => (token.start..token.start, format!("{} ", dice.one_of(&SIGNS))),
        4 if !is_word && !is_number => (token.clone(), (*dice.one_of(&SIGNS)).to_owned()),
        4 | 5 if same_line => {
            let between = &text[token.end..next.start];
            let swapped = format!("{}{between}{old}", &text[next.clone()]);
            (token.start..next.end, swapped)
        }
        _ => (token.clone(), String::new()),
    };
    let line = |at: usize| text[..at].matches('\n').count();
    let lines = (line(range.start), line(range.end));
    let what = format!("{:?} -> {new:?}", &text[range.clone()]);
    let text = format!("{}{new}{}", &text[..range.start], &text[range.end..]);
    Mutant { path: path.clone(), text, what, lines }
}

/// A word with an extra, missing or swapped letter.
fn misspelt(word: &str, dice: &mut Dice) -> String {
    let mut letters: Vec<char> = word.chars().collect();
    let at = dice.below(letters.len());
    match dice.below(3) {
        0 => letters.insert(at, letters[at]),
        1 if letters.len() > 1 => {
            letters.remove(at);
        }
        _ if at + 1 < letters.len() => letters.swap(at, at + 1),
        _ => letters.push('q'),
    }
    letters.into_iter().collect()
}

/// The shipped plans and scenarios, and their toolboxes.
fn corpus() -> (Vec<File>, Toolboxes) {
    let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    for path in TOOLBOXES {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
        toolboxes.add(Source::new(path.display().to_string(), read(&path)), "extra");
    }
    let paths = FOLDERS.iter().flat_map(|folder| files(folder));
    let texts: Vec<_> = paths.map(|path| (path.display().to_string(), read(&path))).collect();
    for (path, text) in &texts {
        let compiled = compile(path, text, &toolboxes);
        assert!(errors(&compiled).is_empty(), "{path}: {}", compiled.render(false));
    }
    (texts, toolboxes)
}

fn compile(path: &str, text: &str, toolboxes: &Toolboxes) -> Compiled {
    let files = |path: &str| std::fs::read_to_string(path).map_err(|error| error.to_string());
    afp_dsl::compile(&Source::new(path, text), toolboxes, &files)
}

fn errors(compiled: &Compiled) -> Vec<&Diagnostic> {
    compiled.diags.iter().filter(|each| each.severity == Severity::Error).collect()
}

/// Invalid mutants with their compilations.
fn mutants(
    seed: u8,
    count: usize,
    (files, toolboxes): &(Vec<File>, Toolboxes),
) -> Vec<(Mutant, Compiled)> {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
    let mut dice = Dice(TestRunner::new_with_rng(Config::default(), rng));
    let mut all = Vec::new();
    while all.len() < count {
        let mutant = mutate(&files[dice.below(files.len())], &mut dice);
        let compiled = compile(&mutant.path, &mutant.text, toolboxes);
        if !errors(&compiled).is_empty() {
            all.push((mutant, compiled));
        }
    }
    all
}

#[test]
fn one_slip_is_one_error_at_its_place() {
    let number = |name| std::env::var(name).ok().and_then(|number| number.parse::<usize>().ok());
    let (asked, seed) = (number("AFP_MUTANTS"), number("AFP_MUTANTS_SEED"));
    let corpus = corpus();
    let seeds = seed.map_or(seeds().to_vec(), |seed| vec![seed as u8]);
    for seed in seeds {
        let all = mutants(seed, asked.unwrap_or(MUTANTS), &corpus);
        judge(seed, &all, asked.is_some());
    }
}

/// Counts the kinds of answers.
fn judge(seed: u8, all: &[(Mutant, Compiled)], show: bool) {
    let (mut numbers, mut far, mut shown) = (BTreeMap::<_, usize>::new(), 0, String::new());
    for (mutant, compiled) in all {
        let errors = errors(compiled);
        *numbers.entry(errors.len()).or_default() += 1;
        let source = &compiled.sources.get(errors[0].span.file).unwrap().text;
        let line = source[..errors[0].span.start as usize].matches('\n').count();
        let is_far = line + 1 < mutant.lines.0 || line > mutant.lines.1 + 1;
        far += usize::from(is_far);
        if is_far || errors.len() > 1 {
            let what = if is_far { "far: " } else { "" };
            shown += &format!("\n==== {what}line {}: {}\n", mutant.lines.0 + 1, mutant.what);
            shown += &compiled.diags.render(&compiled.sources, false);
        }
    }
    let share = |count: usize| count as f64 / all.len() as f64 * 100.0;
    let one = numbers.get(&1).copied().unwrap_or(0);
    let many: usize = numbers.range(3..).map(|(_, count)| count).sum();
    let account = format!(
        "seed {seed}, {} mutants: {:.1} % one error, {:.1} % more than two, {:.1} % far; {numbers:?}",
        all.len(),
        share(one),
        share(many),
        share(far)
    );
    if show {
        println!("{shown}");
    }
    println!("{account}");
    assert!(share(one) >= 95.0 && share(many) <= 2.0 && share(far) <= 5.0, "{account}{shown}");
}

/// The compilation after a fix.
fn mended(path: &str, before: &Compiled, fix: &Edit, toolboxes: &Toolboxes) -> Compiled {
    let mut text = before.sources.get(fix.span.file).unwrap().text.clone();
    text.replace_range(fix.span.start as usize..fix.span.end as usize, &fix.text);
    compile(path, &text, toolboxes)
}

/// Number of diagnostics, without notes.
fn to_do(compiled: &Compiled) -> usize {
    compiled.diags.iter().filter(|each| each.severity != Severity::Note).count()
}

#[test]
fn an_applied_fix_leaves_fewer_errors() {
    let corpus = corpus();
    let (mut tried, mut wrong) = (0, String::new());
    let all = seeds().iter().flat_map(|seed| mutants(*seed, MUTANTS, &corpus));
    for (mutant, before) in all {
        for fix in before.diags.iter().filter_map(|each| each.fix.as_ref()) {
            let after = mended(&mutant.path, &before, fix, &corpus.1);
            tried += 1;
            if to_do(&after) >= to_do(&before) {
                let (before, after) = (before.render(false), after.render(false));
                let what = &mutant.what;
                wrong += &format!("\n==== {what}, mended by {fix:?}\n{before}---- then\n{after}");
            }
        }
    }
    assert!(tried > 100, "{tried} fixes");
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_fix_of_a_case_removes_its_error() {
    let toolboxes = support::toolboxes();
    let cases = files("tests/errors").into_iter().map(|path| (path.clone(), read(&path)));
    let one = |text: &str| !text.contains("// file: ") && !text.contains("\ntoolbox ");
    let (mut tried, mut wrong) = (0, String::new());
    for (path, text) in cases.filter(|(_, text)| one(text)) {
        let before = compile(support::CASE, &text, &toolboxes);
        for each in before.diags.iter() {
            let Some(fix) = &each.fix else { continue };
            let after = mended(support::CASE, &before, fix, &toolboxes);
            tried += 1;
            // The fix may reveal other errors.
            let same = |other: &Diagnostic| (other.code, other.span) == (each.code, each.span);
            if after.diags.iter().any(same) {
                wrong += &format!(
                    "\n==== {}: {each:?}\n---- then\n{}",
                    path.display(),
                    after.render(false)
                );
            }
        }
    }
    assert!(tried > 30, "{tried} fixes");
    assert!(wrong.is_empty(), "{wrong}");
}
