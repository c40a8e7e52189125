use super::bind::bind;
use super::{
    Bind, Formula, Name, Type, child, doc, find_token, keyword_as, keyword_token, live, named,
    range, range_ends, span_of, token, tokens, views,
};
use crate::kind::Kind;
use crate::source::Span;

views! {
    /// The head of a toolbox.
    Toolbox
    Template
    InPort
    OutPort
    /// A state or an event.
    Outcome
    /// Two events that cannot both hold.
    Exclusive
    /// `a < b`
    Comparison
    /// `every 10 ms` or another time.
    Timing
}

named! { Toolbox Template InPort OutPort Outcome }

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TemplateKind {
    /// Acts over time, ends in a state.
    #[default]
    Actor,
    /// Watches, reports events.
    Supervisor,
    /// Computes at once, ends in a state.
    Computation,
}

/// A part of a template.
#[derive(Clone, Debug)]
pub enum Part {
    /// `icon "name"`: the name with its quotes.
    Icon(Option<Name>, Span),
    /// `uses navigator`
    Uses(Option<Name>, Span),
    /// `needs odometry`
    Needs(Option<Name>, Span),
    In(InPort),
    Out(OutPort),
    /// A state or an event.
    Outcome(Outcome),
    /// `states of port`: the port, the place of `states`, and the help above it.
    StatesOf(Option<Name>, Span, String),
    Exclusive(Exclusive),
    Timing(Timing),
}

impl Toolbox {
    /// Its version, quotes included.
    pub fn version(&self) -> Option<Name> {
        token(&self.node, Kind::Text, self.file)
    }
}

impl Template {
    pub fn kind(&self) -> TemplateKind {
        keyword_as(&self.node, |word| match word {
            "supervisor" => TemplateKind::Supervisor,
            "computation" => TemplateKind::Computation,
            _ => TemplateKind::Actor,
        })
    }

    /// The place of `resumable`, if written.
    pub fn resumable(&self) -> Option<Span> {
        let mut words = tokens(&self.node, Kind::Keyword, self.file).into_iter().skip(1);
        words.find(|word| word.text == "resumable").map(|word| word.span)
    }

    /// Whether it is a computation in formulas, not in Rust or Python.
    pub fn is_declared(&self) -> bool {
        let declared = |part: &Part| matches!(part, Part::Outcome(state) if state.is_declared());
        self.kind() == TemplateKind::Computation && self.parts().iter().any(declared)
    }

    pub fn parts(&self) -> Vec<Part> {
        let file = self.file;
        let part = |node: crate::Node| {
            let span = span_of(&node, Kind::Keyword, file).unwrap_or_else(|| self.span());
            let name = |kind| token(&node, kind, file);
            Some(match node.kind() {
                Kind::Icon => Part::Icon(name(Kind::Text), span),
                Kind::Uses => {
                    let word = keyword_token(&node, file);
                    match word.is_some_and(|word| word.text == "needs") {
                        true => Part::Needs(name(Kind::Name), span),
                        false => Part::Uses(name(Kind::Name), span),
                    }
                }
                Kind::InPort => Part::In(InPort::new(node, file)),
                Kind::OutPort => Part::Out(OutPort::new(node, file)),
                Kind::Outcome => Part::Outcome(Outcome::new(node, file)),
                Kind::Exclusive => Part::Exclusive(Exclusive::new(node, file)),
                Kind::StatesOf => Part::StatesOf(name(Kind::Name), span, doc(&node)),
                Kind::Timing => Part::Timing(Timing::new(node, file)),
                _ => return None,
            })
        };
        self.node.children().filter_map(part).collect()
    }
}

impl InPort {
    /// The place of `live`, if written.
    pub fn live(&self) -> Option<Span> {
        live(&self.node, self.file)
    }

    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }

    /// The value of an unbound port.
    pub fn default(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }

    /// The bounds, and the place of both.
    pub fn range(&self) -> Option<(Formula, Formula, Span)> {
        range(&self.node, self.file)
    }

    /// The bounds, as far as written.
    pub fn ends(&self) -> Vec<Formula> {
        range_ends(&self.node, self.file)
    }
}

impl OutPort {
    pub fn ty(&self) -> Option<Type> {
        child(&self.node, Kind::Type).map(|node| Type::new(node, self.file))
    }

    /// The states or events after `on`; `None` without one.
    pub fn on(&self) -> Option<Vec<Name>> {
        let on = child(&self.node, Kind::On)?;
        Some(tokens(&on, Kind::Name, self.file))
    }
}

impl Outcome {
    /// `state` or `event`, with its place.
    pub fn keyword(&self) -> Option<Name> {
        keyword_token(&self.node, self.file)
    }

    /// Whether the event is marked `once`: it occurs but does not last.
    pub fn once(&self) -> bool {
        let words = tokens(&self.node, Kind::Keyword, self.file);
        words.iter().skip(1).any(|word| word.text == "once")
    }
}

impl Outcome {
    /// Whether it has a condition, a time or a body.
    pub fn is_declared(&self) -> bool {
        self.body().is_some() || self.when().is_some() || self.after().is_some()
    }

    /// The place of `when`, and the comparisons after it.
    pub fn when(&self) -> Option<(Span, Vec<Comparison>)> {
        when(&self.node, self.file)
    }

    /// The place of `after`, and the time after it.
    pub fn after(&self) -> Option<(Span, Option<Formula>)> {
        let after = child(&self.node, Kind::After)?;
        Some((span_of(&after, Kind::Keyword, self.file)?, Formula::child_of(&after, self.file)))
    }

    /// The assignments in its body; `None` without braces.
    pub fn body(&self) -> Option<Vec<Bind>> {
        token(&self.node, Kind::OpenBrace, self.file)?;
        Some(self.node.children().filter_map(|node| bind(&node, self.file)).collect())
    }
}

impl Exclusive {
    /// The events: two, unless one is missing.
    pub fn events(&self) -> Vec<Name> {
        tokens(&self.node, Kind::Name, self.file)
    }

    /// The place of `when`, and the comparisons after it.
    pub fn when(&self) -> Option<(Span, Vec<Comparison>)> {
        when(&self.node, self.file)
    }
}

fn when(node: &crate::Node, file: u16) -> Option<(Span, Vec<Comparison>)> {
    let when = child(node, Kind::When)?;
    let compared = when.children().filter(|node| node.kind() == Kind::Comparison);
    let compared = compared.map(|node| Comparison::new(node, file)).collect();
    Some((span_of(&when, Kind::Keyword, file)?, compared))
}

impl Comparison {
    /// The left formula, the sign and the right formula.
    pub fn parts(&self) -> Option<(Formula, Name, Formula)> {
        let sign = find_token(&self.node, self.file, |kind, text, span| {
            kind.is_comparison().then(|| Name { text: text.to_owned(), span })
        });
        let mut operands = Formula::children_of(&self.node, self.file).into_iter();
        Some((operands.next()?, sign?, operands.next()?))
    }

    /// The written formulas, also of an incomplete comparison.
    pub fn operands(&self) -> Vec<Formula> {
        Formula::children_of(&self.node, self.file)
    }
}

impl Timing {
    /// `every`, `deadline`, `budget` or `stop`, with its place.
    pub fn keyword(&self) -> Option<Name> {
        keyword_token(&self.node, self.file)
    }

    pub fn value(&self) -> Option<Formula> {
        Formula::child_of(&self.node, self.file)
    }
}
