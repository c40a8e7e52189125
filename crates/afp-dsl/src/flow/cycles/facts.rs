//! The declared facts of events: some events come after a time, and some never hold together.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use afp_types::Comparison;

use crate::flow::strong;
use crate::flow::view::{Cause, Edge, View};
use crate::graph::{EntryId, Formula, Op, Part, Supervisor, SupervisorId};
use crate::toolbox::case::value;
use crate::toolbox::{Condition, Fact};
use crate::types::{Constant, Conversion};

/// The limit of events of a cycle that are compared in pairs.
const MAX_EVENTS: usize = 64;

/// The time from a supervisor's start before which an event never occurs, seconds, if the toolbox declares one.
/// `unknown` stands for a time that is not constant.
pub(in crate::flow) fn earliest(
    view: &View<'_>,
    (id, event): (SupervisorId, u16),
    unknown: f64,
) -> Option<f64> {
    let supervisor = view.supervisor(id);
    let input = |port: u16| view.constant(supervisor.inputs.get(usize::from(port))?);
    view.template(supervisor).facts.iter().find_map(|fact| match fact {
        Fact::After(of, time) if *of == event => match value(time, &input) {
            Some(Constant::Float(time)) => Some(time),
            _ => Some(unknown),
        },
        _ => None,
    })
}

/// Whether the conditions of a cycle never hold together.
pub(in crate::flow) fn contradict(view: &View<'_>, cycle: &[Edge]) -> bool {
    let outputs = cycle.iter().flat_map(|edge| view.may_write(edge.cause));
    let written = outputs.map(|output| output.entry).collect();
    let events = cycle.iter().filter_map(|edge| match edge.cause {
        Cause::Event(id, event) | Cause::On(_, id, Some(event)) => {
            Some((view.supervisor(id), event))
        }
        _ => None,
    });
    let events: Vec<_> = events.collect();
    let terms = Terms { view, written };
    let orders: Vec<_> = events.iter().flat_map(|event| terms.order(*event)).collect();
    let declared = |event: &&Event| !view.template(event.0).facts.is_empty();
    let pairs: Vec<_> = events.iter().filter(declared).take(MAX_EVENTS).collect();
    impossible(&orders)
        || pairs.iter().any(|one| pairs.iter().any(|other| terms.exclude(**one, **other)))
}

type Event<'a> = (&'a Supervisor, u16);

/// A value that conditions compare.
#[derive(Clone)]
enum Term {
    Known(Constant),
    Entry(EntryId),
}

/// The relation of two values.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Relation {
    Less,
    LessOrEqual,
    Different,
}

/// Two values and their relation.
type Order = (Relation, [Term; 2]);

/// The values that the conditions of a cycle compare.
struct Terms<'a> {
    view: &'a View<'a>,
    /// Entries that the cycle writes.
    written: BTreeSet<EntryId>,
}

impl Terms<'_> {
    /// The order of the values while an event holds.
    fn order(&self, (supervisor, event): Event<'_>) -> Vec<Order> {
        let facts = self.view.template(supervisor).facts.iter();
        let conditions = facts.flat_map(|fact| match fact {
            Fact::When(of, conditions) if *of == event => conditions.as_slice(),
            _ => &[],
        });
        let orders = conditions
            .filter_map(|one| Some(orders(one.comparison, self.values(one, &[supervisor])?)));
        orders.flatten().collect()
    }

    /// Whether two events are declared as exclusive.
    fn exclude(&self, one: Event<'_>, other: Event<'_>) -> bool {
        let is_own = one.0.template == other.0.template;
        is_own
            && self.view.template(one.0).facts.iter().any(|fact| match fact {
                Fact::Exclusive(events, conditions) if *events == [one.1, other.1] => {
                    conditions.iter().all(|condition| self.surely(condition, &[one.0, other.0]))
                }
                _ => false,
            })
    }

    /// Whether a condition always holds: its opposite is impossible.
    fn surely(&self, condition: &Condition, of: &[&Supervisor]) -> bool {
        let opposite = match condition.comparison {
            Comparison::Equal => Comparison::NotEqual,
            Comparison::NotEqual => Comparison::Equal,
            Comparison::Less => Comparison::GreaterEqual,
            Comparison::LessEqual => Comparison::Greater,
            Comparison::Greater => Comparison::LessEqual,
            Comparison::GreaterEqual => Comparison::Less,
        };
        self.values(condition, of).is_some_and(|values| impossible(&orders(opposite, values)))
    }

    /// The compared values, if both are known.
    fn values(&self, condition: &Condition, of: &[&Supervisor]) -> Option<[Term; 2]> {
        Some([self.term(&condition.left, of)?, self.term(&condition.right, of)?])
    }

    /// A known value, or an entry that keeps its value.
    fn term(&self, formula: &Formula, of: &[&Supervisor]) -> Option<Term> {
        let bound = |port: usize| {
            let ports = self.view.template(of.first()?).inputs.len();
            let supervisor = of.get(port.checked_div(ports)?)?;
            let (view, port) = (self.view, port % ports);
            let is_now = view.template(supervisor).inputs.get(port)?.live;
            Some((supervisor.inputs.get(port)?, is_now || supervisor.owner.is_some()))
        };
        let known = |port: u16| self.view.constant(bound(usize::from(port))?.0);
        if let Some(value) = value(formula, &known) {
            return Some(Term::Known(value));
        }
        let (input, is_now) = bound(entry(formula.part())?.index())?;
        let entry = entry(input.part()).filter(|entry| is_now && !self.written.contains(entry))?;
        Some(Term::Entry(entry))
    }
}

/// The entry, if a formula is only an entry.
fn entry(part: Part<'_>) -> Option<EntryId> {
    match part.op() {
        Op::Entry(id) => Some(*id),
        Op::Convert(Conversion::IntToFloat) => entry(part.operand()?),
        _ => None,
    }
}

/// The order of two values with a comparison.
fn orders(comparison: Comparison, [left, right]: [Term; 2]) -> Vec<Order> {
    use Relation::{Different, Less, LessOrEqual};
    match comparison {
        Comparison::Less => vec![(Less, [left, right])],
        Comparison::LessEqual => vec![(LessOrEqual, [left, right])],
        Comparison::Greater => vec![(Less, [right, left])],
        Comparison::GreaterEqual => vec![(LessOrEqual, [right, left])],
        Comparison::Equal => {
            let other = [right.clone(), left.clone()];
            vec![(LessOrEqual, [left, right]), (LessOrEqual, other)]
        }
        Comparison::NotEqual => vec![(Different, [left, right])],
    }
}

/// Whether a value would have to be less than itself, or different from itself.
fn impossible(orders: &[Order]) -> bool {
    let (mut known, mut entries) = (Vec::new(), Vec::new());
    for term in orders.iter().flat_map(|(_, values)| values) {
        match term {
            Term::Known(value) => known.push(value),
            Term::Entry(entry) => entries.push(*entry),
        }
    }
    known.sort_by(|a, b| order(a, b));
    known.dedup_by(|a, b| order(a, b).is_eq());
    entries.sort_unstable();
    entries.dedup();
    let place = |term: &Term| match term {
        Term::Known(value) => known.partition_point(|other| order(other, value).is_lt()),
        Term::Entry(entry) => known.len() + entries.partition_point(|other| other < entry),
    };
    let ordered = (1..known.len()).map(|at| (at - 1, at, Relation::Less));
    let pairs = orders.iter().map(|(relation, [a, b])| (place(a), place(b), *relation));
    let mut pairs: Vec<_> = pairs.chain(ordered).collect();
    pairs.sort_unstable();
    let edges = || pairs.iter().filter(|(.., relation)| *relation != Relation::Different);
    let nodes = known.len() + entries.len();
    let first = strong::first(nodes, edges().map(|(from, ..)| *from));
    let targets: Vec<u32> = edges().map(|(_, to, _)| *to as u32).collect();
    let component = strong::components(&first, &targets);
    let mut unequal = pairs.iter().filter(|(.., relation)| *relation != Relation::LessOrEqual);
    unequal.any(|(from, to, _)| component[*from] == component[*to])
}

/// The order of numbers, and an arbitrary order of all other values.
fn order(a: &Constant, b: &Constant) -> Ordering {
    match (a, b) {
        (Constant::Bool(a), Constant::Bool(b)) => a.cmp(b),
        (Constant::Text(a), Constant::Text(b)) => a.as_str().cmp(b.as_str()),
        (Constant::Choice(a), Constant::Choice(b)) => a.cmp(b),
        _ => match (number(a), number(b)) {
            (Some(a), Some(b)) => a.total_cmp(&b),
            _ => kind(a).cmp(&kind(b)),
        },
    }
}

fn number(value: &Constant) -> Option<f64> {
    match value {
        Constant::Int(number) => Some(*number as f64),
        // -0 equals 0.
        Constant::Float(number) => Some(*number + 0.0),
        _ => None,
    }
}

fn kind(value: &Constant) -> u8 {
    match value {
        Constant::Unset => 0,
        Constant::Bool(_) => 1,
        Constant::Int(_) | Constant::Float(_) => 2,
        Constant::Text(_) => 3,
        Constant::Choice(_) => 4,
        Constant::Object(_) => 5,
    }
}
