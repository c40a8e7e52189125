//! A reader of the grammar's notation, and a generator of random sentences.

use std::collections::{BTreeMap, BTreeSet};

/// The prefix of names in sentences, which is not a prefix of any keyword.
pub const NAME: &str = "zz";

/// The nesting depth after which only the shortest alternatives are used.
const DEPTH: usize = 14;

pub struct Grammar(BTreeMap<String, Rule>);

enum Rule {
    /// A keyword or an operator.
    Text(String),
    Name(String),
    One(Vec<Rule>),
    All(Vec<Rule>),
    Maybe(Box<Rule>),
    Many(Box<Rule>),
}

impl Grammar {
    /// Reads rules such as `a = "b" {c} ;`.
    pub fn parse(text: &str) -> Grammar {
        let tokens = tokens(text);
        let mut rest = tokens.as_slice();
        let mut rules = BTreeMap::new();
        while let [name, equal, behind @ ..] = rest {
            assert_eq!(equal, "=", "behind {name}");
            rest = behind;
            let rule = one(&mut rest);
            assert_eq!(rest.first().map(String::as_str), Some(";"), "at the end of {name}");
            rest = &rest[1..];
            rules.insert(name.clone(), rule);
        }
        assert!(rest.is_empty(), "{rest:?}");
        Grammar(rules)
    }

    pub fn words(&self) -> BTreeSet<String> {
        let mut words = BTreeSet::new();
        for rule in self.0.values() {
            collect(rule, &mut words);
        }
        words
    }

    /// A random sentence of a rule, determined by the seed.
    pub fn sentence(&self, rule: &str, seed: u64) -> String {
        let mut maker = Maker { grammar: self, state: seed, text: String::new() };
        maker.named(rule, 0);
        maker.text
    }
}

fn collect(rule: &Rule, words: &mut BTreeSet<String>) {
    match rule {
        Rule::Text(text) if text.bytes().all(|byte| byte.is_ascii_lowercase()) => {
            words.insert(text.clone());
        }
        Rule::Text(_) | Rule::Name(_) => {}
        Rule::One(rules) | Rule::All(rules) => rules.iter().for_each(|each| collect(each, words)),
        Rule::Maybe(rule) | Rule::Many(rule) => collect(rule, words),
    }
}

fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => rest[1..].find('"').expect("the quote is closed") + 2,
            _ if first.is_ascii_alphabetic() => {
                rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len())
            }
            _ => 1,
        };
        tokens.push(rest[..length].to_owned());
        rest = rest[length..].trim_start();
    }
    tokens
}

/// Alternatives up to a closing bracket.
fn one(rest: &mut &[String]) -> Rule {
    let mut choices = vec![all(rest)];
    while rest.first().is_some_and(|token| token == "|") {
        *rest = &rest[1..];
        choices.push(all(rest));
    }
    if choices.len() == 1 { choices.remove(0) } else { Rule::One(choices) }
}

fn all(rest: &mut &[String]) -> Rule {
    let mut parts = Vec::new();
    while let Some((first, behind)) = rest.split_first() {
        let close = match first.as_str() {
            "|" | ")" | "]" | "}" | ";" => break,
            "(" => ")",
            "[" => "]",
            "{" => "}",
            _ => "",
        };
        *rest = behind;
        if close.is_empty() {
            let text = first.trim_matches('"');
            let quoted = first.starts_with('"');
            parts.push(if quoted { Rule::Text(text.into()) } else { Rule::Name(text.into()) });
            continue;
        }
        let inner = one(rest);
        assert_eq!(rest.first().map(String::as_str), Some(close), "behind {first}");
        *rest = &rest[1..];
        parts.push(match close {
            "]" => Rule::Maybe(Box::new(inner)),
            "}" => Rule::Many(Box::new(inner)),
            _ => inner,
        });
    }
    Rule::All(parts)
}

struct Maker<'g> {
    grammar: &'g Grammar,
    state: u64,
    text: String,
}

impl Maker<'_> {
    /// A number below `end`: a step of a linear congruential generator (Knuth, MMIX).
    fn below(&mut self, end: usize) -> usize {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 33) as usize % end
    }

    fn make(&mut self, rule: &Rule, depth: usize) {
        match rule {
            Rule::Text(text) => self.write(text),
            Rule::Name(name) => self.named(name, depth + 1),
            Rule::All(rules) => rules.iter().for_each(|each| self.make(each, depth)),
            Rule::One(rules) if depth > DEPTH => self.make(&rules[rules.len() - 1], depth),
            Rule::One(rules) => {
                let choice = self.below(rules.len());
                self.make(&rules[choice], depth);
            }
            Rule::Maybe(rule) => (0..self.below(2)).for_each(|_| self.make(rule, depth)),
            Rule::Many(_) if depth > DEPTH => {}
            Rule::Many(rule) => (0..self.below(4)).for_each(|_| self.make(rule, depth)),
        }
    }

    fn named(&mut self, name: &str, depth: usize) {
        let number = self.below(9);
        match name {
            "NAME" => self.write(&format!("{NAME}{number}")),
            "INT" => self.write(&number.to_string()),
            "FLOAT" => self.write(&format!("{number}.5")),
            "QUANTITY" => self.write(&format!("{number} cm/s")),
            "TIME" => self.write(&format!("{number} ms")),
            "FUNCTION" => self.write("clamp"),
            "STRING" => self.write("\"text\""),
            rule => {
                let grammar = self.grammar;
                let rule = grammar.0.get(rule).unwrap_or_else(|| panic!("no rule '{rule}'"));
                self.make(rule, depth);
            }
        }
    }

    fn write(&mut self, text: &str) {
        // A space between all tokens except dots; sometimes a line break where it is allowed.
        if text != "." && !self.text.is_empty() && !self.text.ends_with('.') {
            self.text.push(' ');
        }
        self.text += text;
        if matches!(text, "{" | "}" | "," | "(" | "=") && self.below(3) == 0 {
            self.text.push('\n');
        }
    }
}
