//! Finds the places of a plan that a mutant can change.

use std::ops::Range;

use afp_platform::Noise;
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::{Kind, Node, node_span, parse};

use super::site::{MutantKind, Site};

/// All places of every plan and every declared computation in a text.
pub(super) fn sites(text: &str, seed: u64) -> Vec<Site> {
    let tree = parse(text, 0, &mut Diagnostics::default());
    let mut finder = Finder { text, noise: Noise::new(seed, "mutants"), sites: Vec::new() };
    let mutated = [Kind::Plan, Kind::Template];
    for plan in tree.root().children().filter(|node| mutated.contains(&node.kind())) {
        finder.plan(&plan);
    }
    finder.sites
}

struct Finder<'a> {
    text: &'a str,
    /// Chooses among several possible changes.
    noise: Noise,
    sites: Vec<Site>,
}

impl Finder<'_> {
    fn plan(&mut self, plan: &Node) {
        let elements = plan.children().filter(|node| node.kind() == Kind::Element);
        let elements: Vec<_> = elements.filter_map(|node| self.name(&node)).collect();
        for node in plan.descendants() {
            match node.kind() {
                Kind::Start => self.start(&node, &elements),
                Kind::Element | Kind::Guard => self.edges(&node, &elements),
                Kind::Literal => self.literal(&node),
                Kind::Negation => self.positive(&node),
                Kind::Sum => self.sum(&node),
                Kind::Comparison => self.comparison(&node),
                Kind::Ref if token(&node, Kind::Dot).is_some() => self.choice(&node),
                Kind::Ref if is_operand(&node) => self.negative(&node),
                _ => {}
            }
        }
    }

    /// One of the names, except the given one.
    fn other(&mut self, names: &[String], than: &str) -> Option<String> {
        let others: Vec<_> = names.iter().filter(|name| *name != than).collect();
        let index = self.noise.below(u32::try_from(others.len()).ok()?);
        others.get(index as usize).map(|name| (*name).clone())
    }

    fn start(&mut self, node: &Node, elements: &[String]) {
        let Some(place) = token(node, Kind::Name) else { return };
        let was = self.at(&place).to_owned();
        if let Some(is) = self.other(elements, &was) {
            self.add(MutantKind::Target, place, is, |text| format!("start {text}"));
        }
    }

    /// Edges of an element or supervisor: each gets a different target, and each two are swapped.
    fn edges(&mut self, owner: &Node, elements: &[String]) {
        let words: &[&str] = match owner.kind() {
            Kind::Guard => &["terminate", "ignore"],
            _ => &["terminate"],
        };
        let goals = elements.iter().map(String::as_str).chain(words.iter().copied());
        let goals: Vec<_> = goals.map(str::to_owned).collect();
        let edges = owner.children().filter(|node| node.kind() == Kind::Edge);
        let targets = edges.filter_map(|edge| edge.children().find(|it| it.kind() == Kind::Target));
        let targets: Vec<_> = targets.map(|target| place(&target)).collect();
        for target in &targets {
            let was = self.at(target).to_owned();
            let is = match &*was {
                "return" => Some("terminate".to_owned()),
                suspends if suspends.starts_with("suspend ") && words.contains(&"ignore") => {
                    Some("ignore".to_owned())
                }
                _ => self.other(&goals, &was),
            };
            if let Some(is) = is {
                self.add(MutantKind::Target, target.clone(), is, |text| format!("-> {text}"));
            }
        }
        for (first, second) in targets.iter().zip(targets.iter().skip(1)) {
            let (one, other) = (self.at(first).to_owned(), self.at(second).to_owned());
            if one != other {
                self.sites.push(Site {
                    kind: MutantKind::Swap,
                    was: format!("-> {one}, -> {other}"),
                    is: format!("-> {other}, -> {one}"),
                    edits: vec![(first.clone(), other), (second.clone(), one)],
                });
            }
        }
    }

    /// A number gets another value, and the opposite sign; a boolean is negated.
    fn literal(&mut self, node: &Node) {
        let whole = place(node);
        let shown = self.at(&whole).to_owned();
        let opposite = match shown.as_str() {
            "true" => Some("false"),
            "false" => Some("true"),
            _ => None,
        };
        if let Some(is) = opposite {
            return self.add(MutantKind::Constant, whole, is.to_owned(), str::to_owned);
        }
        let number = token(node, Kind::Int).or_else(|| token(node, Kind::Float));
        let Some(number) = number else { return };
        let Ok(value) = self.at(&number).parse::<f64>() else { return };
        let with_unit = number.end < whole.end;
        let is = match (value == 0.0, with_unit, self.noise.below(2)) {
            (true, ..) => 1.0,
            (false, false, _) if token(node, Kind::Int).is_some() => value + 1.0,
            (false, _, 0) => value * 2.0,
            (false, ..) => value / 2.0,
        };
        let changed = format!("{is}{}", &shown[number.len()..]);
        self.add(MutantKind::Constant, whole.clone(), changed, str::to_owned);
        let parent = node.parent().map(|parent| parent.kind());
        if value != 0.0 && !matches!(parent, Some(Kind::Negation | Kind::Timing)) {
            self.add(MutantKind::Sign, whole, format!("-{shown}"), str::to_owned);
        }
    }

    /// A value of an enum of the file becomes another value.
    fn choice(&mut self, node: &Node) {
        let whole = place(node);
        let shown = self.at(&whole).to_owned();
        let Some((home, value)) = shown.split_once('.') else { return };
        let Some(file) = node.ancestors().last() else { return };
        let mut enums = file.children().filter(|node| node.kind() == Kind::Enum);
        let Some(home) = enums.find(|it| self.name(it).as_deref() == Some(home)) else { return };
        let values: Vec<_> = home.children().filter_map(|node| self.name(&node)).collect();
        if let Some(other) = self.other(&values, value) {
            let is = format!("{}{other}", &shown[..shown.len() - value.len()]);
            self.add(MutantKind::Constant, whole, is, str::to_owned);
        }
    }

    /// `-way` becomes `way`.
    fn positive(&mut self, node: &Node) {
        let whole = place(node);
        let is = self.at(&whole).trim_start_matches('-').trim_start().to_owned();
        self.add(MutantKind::Sign, whole, is, str::to_owned);
    }

    /// `way` becomes `-way`.
    fn negative(&mut self, node: &Node) {
        let whole = place(node);
        let is = format!("-{}", self.at(&whole));
        self.add(MutantKind::Sign, whole, is, str::to_owned);
    }

    /// A comparison becomes the opposite one.
    fn comparison(&mut self, node: &Node) {
        let opposites = [
            (Kind::Less, ">="),
            (Kind::LessEqual, ">"),
            (Kind::Greater, "<="),
            (Kind::GreaterEqual, "<"),
            (Kind::EqualEqual, "!="),
            (Kind::NotEqual, "=="),
        ];
        for (kind, is) in opposites {
            if let Some(place) = token(node, kind) {
                self.add(MutantKind::Sign, place, is.to_owned(), str::to_owned);
            }
        }
    }

    /// `+` becomes `-`, and `-` becomes `+`.
    fn sum(&mut self, node: &Node) {
        for (kind, is) in [(Kind::Plus, "-"), (Kind::Minus, "+")] {
            let signs = node.children_with_tokens().filter(|each| each.kind() == kind);
            for sign in signs {
                let range = sign.text_range();
                let place = usize::from(range.start())..usize::from(range.end());
                self.add(MutantKind::Sign, place, is.to_owned(), str::to_owned);
            }
        }
    }

    fn add(&mut self, kind: MutantKind, at: Range<usize>, new: String, shown: fn(&str) -> String) {
        let (was, is) = (shown(self.at(&at)), shown(&new));
        if was != is {
            self.sites.push(Site { kind, edits: vec![(at, new)], was, is });
        }
    }

    fn at(&self, place: &Range<usize>) -> &str {
        self.text.get(place.clone()).unwrap_or_default()
    }

    fn name(&self, node: &Node) -> Option<String> {
        token(node, Kind::Name).map(|place| self.at(&place).to_owned())
    }
}

/// Whether a reference is in a component's input formula or a comparison, without a sign.
fn is_operand(node: &Node) -> bool {
    let formula = [Kind::BindIn, Kind::Sum, Kind::Product, Kind::Brackets, Kind::Comparison];
    node.parent().is_some_and(|parent| formula.contains(&parent.kind()))
}

fn place(node: &Node) -> Range<usize> {
    let span = node_span(node, 0);
    span.start as usize..span.end as usize
}

/// The place of the first token of a kind.
fn token(node: &Node, kind: Kind) -> Option<Range<usize>> {
    let mut tokens = node.children_with_tokens().filter(|each| each.kind() == kind);
    let range = tokens.find_map(|each| each.into_token())?.text_range();
    Some(usize::from(range.start())..usize::from(range.end()))
}
