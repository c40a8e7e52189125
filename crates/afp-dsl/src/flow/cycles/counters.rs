//! Bounds of cycles within one step, by counters.
//!
//! A counter is a declared computation such as `Count` whose first state adds one to an entry while
//! it is less than a known limit. The entry has known initial values. If only the first state
//! writes that entry on a cycle, the number of rounds is at most the limit minus the least value.
//! Inner cycles have their own counters.

use std::collections::{BTreeMap, BTreeSet};

use afp_types::MAX_TRANSITIONS_PER_STEP;

use super::decided;
use super::is_quick;
use crate::flow::strong;
use crate::flow::view::{Cause, Counter, Counters, Edge, Node, View};
use crate::graph::{Element, ElementId, EntryId, EntryKind, Op, Output};
use crate::toolbox::case::{Counting, counting};
use crate::types::Constant;

/// The state in which a counter continues.
const AGAIN: u16 = 0;
/// A cycle with this many rounds does not end within one step.
pub(super) const MOST_ROUNDS: u64 = MAX_TRANSITIONS_PER_STEP as u64;
/// Maximum nesting of cycles with counters.
const DEEPEST: u32 = 8;

impl Counter {
    /// Maximum number of `Again` before `Done`.
    fn most(&self) -> u64 {
        u64::try_from(self.limit.saturating_sub(self.least)).unwrap_or(0)
    }
}

impl View<'_> {
    pub fn counters(&self) -> &Counters {
        self.counters.get_or_init(|| Counters::of(self))
    }
}

impl Counters {
    /// Finds the counters among reachable elements.
    pub fn of(view: &View<'_>) -> Counters {
        let elements = (0..).map(ElementId).zip(&view.plan.elements);
        let reached = elements.filter(|(id, _)| view.reached[id.index()]);
        let found = reached
            .filter_map(|(id, element)| Some((id, counted(view, element)?, limit(view, element)?)));
        let found: Vec<_> = found.collect();
        if found.is_empty() {
            return Counters::default();
        }
        let begins = begins(view, found.iter().map(|(_, entry, _)| *entry).collect());
        let known = found.into_iter().filter_map(|(id, entry, limit)| {
            Some((id, Counter { entry, limit, least: *begins.get(&entry)? }))
        });
        Counters(known.collect())
    }

    pub(super) fn has(&self, id: ElementId) -> bool {
        self.0.contains_key(&id)
    }

    /// The counters by which a cycle continues.
    pub(super) fn on<'e>(
        &self,
        cycle: impl Iterator<Item = &'e Edge>,
    ) -> Vec<(ElementId, Counter)> {
        let goes_on = |edge: &Edge| match edge.cause {
            Cause::State(id, AGAIN) => Some((id, *self.0.get(&id)?)),
            _ => None,
        };
        cycle.filter_map(goes_on).collect()
    }

    /// The counters that bound a cycle: only the `Again` of counters writes their entries on it.
    pub(super) fn bounding<'e>(
        &self,
        view: &View<'_>,
        cycle: impl Iterator<Item = &'e Edge> + Clone,
    ) -> Vec<(ElementId, Counter)> {
        let mut found = self.on(cycle.clone());
        if !found.is_empty() {
            let mut others: BTreeMap<EntryId, usize> = BTreeMap::new();
            for output in cycle.flat_map(|edge| view.may_write(edge.cause)) {
                *others.entry(output.entry).or_default() += 1;
            }
            for (_, counter) in &found {
                others.entry(counter.entry).and_modify(|count| *count -= 1);
            }
            found.retain(|(_, counter)| others.get(&counter.entry) == Some(&0));
        }
        found
    }

    /// Whether a counter bounds a cycle below the edges of a step.
    pub(super) fn end<'e>(
        &self,
        view: &View<'_>,
        cycle: impl Iterator<Item = &'e Edge> + Clone,
    ) -> bool {
        self.bounding(view, cycle).iter().any(|(_, counter)| counter.most() < MOST_ROUNDS)
    }
}

fn count_of(view: &View<'_>, element: &Element) -> Option<(EntryId, Counting)> {
    let counting = counting(view.cases(element)?)?;
    match element.inputs.get(usize::from(counting.value))?.op() {
        Op::Entry(entry) => Some((*entry, counting)),
        _ => None,
    }
}

/// The entry that a counter reads and writes.
fn counted(view: &View<'_>, element: &Element) -> Option<EntryId> {
    let (entry, Counting { next, .. }) = count_of(view, element)?;
    let is_next = |output: &Output| {
        (output.port, output.entry) == (next, entry) && output.conversion.is_none()
    };
    element.outputs.iter().any(is_next).then_some(entry)
}

/// A counter that never ends, since it does not write its entry, and that entry.
pub(super) fn forgotten<'v>(view: &View<'v>, cause: Cause) -> Option<(&'v str, &'v str)> {
    let Cause::State(id, AGAIN) = cause else { return None };
    let element = &view.plan.elements[id.index()];
    let entry = &view.plan.entries[count_of(view, element)?.0.index()];
    let is_written = counted(view, element).is_some();
    let writable = matches!(entry.kind, EntryKind::Var | EntryKind::Out);
    (writable && !is_written).then_some((&element.name, &entry.name))
}

/// The limit of a counter, if known.
fn limit(view: &View<'_>, element: &Element) -> Option<i64> {
    let (_, counting) = count_of(view, element)?;
    whole(view.constant(element.inputs.get(usize::from(counting.limit))?)?)
}

fn whole(value: Constant) -> Option<i64> {
    match value {
        Constant::Int(value) => Some(value),
        _ => None,
    }
}

/// Least initial values of counted entries, if all their writes are known: values at the plan's
/// start, and writes of declared computations.
fn begins(view: &View<'_>, mut counted_in: BTreeSet<EntryId>) -> BTreeMap<EntryId, i64> {
    let at_start = decided::at_start(view);
    let mut values: BTreeMap<EntryId, Vec<i64>> = BTreeMap::new();
    for entry in counted_in.clone() {
        let declared = &view.plan.entries[entry.index()];
        let value = declared.value.clone().or_else(|| at_start.get(&entry).cloned());
        match (&declared.init, value.and_then(whole)) {
            (Some(_), None) => _ = counted_in.remove(&entry),
            (_, value) => values.entry(entry).or_default().extend(value),
        }
    }
    for (_, element) in view.elements() {
        for output in element.outputs.iter().filter(|it| counted_in.contains(&it.entry)) {
            let all = assigned(view, element, output).map(|(_, value)| value);
            let all: Option<Vec<_>> = all.collect();
            match all {
                Some(all) if view.cases(element).is_some() => {
                    values.get_mut(&output.entry).into_iter().for_each(|it| it.extend(&all));
                }
                _ => _ = values.remove(&output.entry),
            }
        }
    }
    for output in view.supervisors().flat_map(|supervisor| &supervisor.outputs) {
        values.remove(&output.entry);
    }
    let least = |values: Vec<i64>| values.into_iter().fold(0, i64::min);
    values.into_iter().map(|(entry, values)| (entry, least(values))).collect()
}

/// Least value at which the flow can enter a `Count` from outside of its loop: a known write,
/// without other writes on the path.
pub(super) fn entered(view: &View<'_>, id: ElementId, entry: EntryId) -> i64 {
    let comes = |from: Vec<Node>| comes_unwritten(view, from, id.index(), entry);
    let declared = &view.plan.entries[entry.index()];
    let at_start = declared.value.clone().or_else(|| decided::at_start(view).remove(&entry));
    let at_start = at_start.and_then(whole).filter(|_| comes(vec![view.start()]));
    let written = view.elements().filter(|(node, _)| view.reached[*node]);
    let written = written.flat_map(|(node, element)| {
        let outputs = element.outputs.iter().filter(|output| output.entry == entry);
        outputs.flat_map(|output| assigned(view, element, output)).filter_map(move |(of, value)| {
            let edges = view.from(node).iter();
            let to = edges.filter(|edge| matches!(edge.cause, Cause::State(_, it) if it == of));
            let to = to.map(|edge| edge.to).collect();
            value.filter(|_| comes_unwritten(view, to, id.index(), entry))
        })
    });
    at_start.into_iter().chain(written).min().unwrap_or(0)
}

/// Whether the flow can reach a node from others without a write of an entry, except by continuing
/// counters.
fn comes_unwritten(view: &View<'_>, from: Vec<Node>, to: Node, entry: EntryId) -> bool {
    let mut known = vec![false; view.nodes()];
    let mut waiting = from;
    while let Some(node) = waiting.pop() {
        if node == to {
            return true;
        }
        if std::mem::replace(&mut known[node], true) {
            continue;
        }
        let writes = |edge: &&Edge| {
            let all = view.may_write(edge.cause);
            all.iter().any(|output| output.entry == entry)
                && !matches!(edge.cause, Cause::State(id, AGAIN) if view.counters().has(id))
        };
        waiting.extend(view.from(node).iter().filter(|edge| !writes(edge)).map(|edge| edge.to));
    }
    false
}

/// The states of a declared computation that write an output, with the written integer if known;
/// without the counter's continuing state.
fn assigned<'v>(
    view: &'v View<'_>,
    element: &'v Element,
    output: &'v Output,
) -> impl Iterator<Item = (u16, Option<i64>)> + 'v {
    let is_counted = counted(view, element) == Some(output.entry);
    let cases = (0..).zip(view.cases(element).unwrap_or_default());
    let writing = cases.filter(move |(state, case)| {
        let writes = case.writes.iter().any(|(port, _)| *port == output.port);
        writes && !(is_counted && *state == AGAIN)
    });
    writing.map(move |(state, case)| {
        let input = |port: u16| view.constant(element.inputs.get(usize::from(port))?);
        let value = case.written(output.port, &input).filter(|_| output.conversion.is_none());
        (state, value.and_then(whole))
    })
}

/// Removes the edges by which counters continue, cycle by cycle, including inner ones, unless a
/// node may be entered more than `most` times. Returns how often each node may be entered in one
/// step; `None` if a cycle remains.
///
/// `edges` take no time and are sorted by their nodes, which are less than the length of
/// `component`, the strongly connected components.
pub(crate) fn unwind(
    view: &View<'_>,
    component: Vec<u32>,
    edges: &mut Vec<Edge>,
    most: u64,
) -> Vec<Option<u64>> {
    unwound(view, component, edges, most).0
}

/// A counted entry that an external write can set below its initial value: an entry of the running
/// plan without a sufficient range.
pub(crate) fn open_to_writes<'v>(view: &View<'v>) -> Option<&'v str> {
    let reached = view.edges.iter().filter(|edge| view.reached[edge.from]);
    let mut quick: Vec<Edge> = reached.filter(|edge| is_quick(view, edge)).copied().collect();
    let component = components(view.nodes(), &quick);
    let (_, counters) = unwound(view, component, &mut quick, u64::MAX);
    let open = counters.iter().filter_map(|id| view.counters().0.get(id)).find_map(|counter| {
        let entry = &view.plan.entries[counter.entry.index()];
        let is_kept = entry.range.is_some_and(|(least, _)| least >= counter.least as f64);
        (entry.kind == EntryKind::Var && !is_kept).then_some(entry)
    });
    open.map(|entry| entry.name.as_str())
}

/// Like [`unwind`], and returns the counters.
fn unwound(
    view: &View<'_>,
    mut component: Vec<u32>,
    edges: &mut Vec<Edge>,
    most: u64,
) -> (Vec<Option<u64>>, BTreeSet<ElementId>) {
    let mut times = vec![1_u64; component.len()];
    let mut counters = BTreeSet::new();
    for _ in 0..DEEPEST {
        let (factors, again) = bounded(view, &component, edges, |node| most / times[node]);
        if again.is_empty() {
            break;
        }
        for (node, times) in times.iter_mut().enumerate() {
            let factor = factors.get(&component[node]).copied().unwrap_or(1);
            *times = times.saturating_mul(factor);
        }
        edges.retain(|edge| !matches!(edge.cause, Cause::State(id, AGAIN) if again.contains(&id)));
        component = components(component.len(), edges);
        counters.extend(again);
    }
    let mut times: Vec<_> = times.into_iter().map(Some).collect();
    let cycles = edges.iter().filter(|edge| component[edge.from] == component[edge.to]);
    let endless: BTreeSet<u32> = cycles.map(|edge| component[edge.from]).collect();
    let unknown = component.iter().zip(&mut times).filter(|(of, _)| endless.contains(of));
    unknown.for_each(|(_, times)| *times = None);
    (times, counters)
}

/// Strongly connected components of a graph with sorted edges.
pub(crate) fn components(nodes: usize, edges: &[Edge]) -> Vec<u32> {
    let first = strong::first(nodes, edges.iter().map(|edge| edge.from));
    let targets: Vec<u32> = edges.iter().map(|edge| edge.to as u32).collect();
    strong::components(&first, &targets)
}

/// For each component with counters, the maximum number of entries of its nodes before it is left,
/// and the counters; `room` is the limit.
fn bounded(
    view: &View<'_>,
    component: &[u32],
    edges: &[Edge],
    room: impl Fn(usize) -> u64,
) -> (BTreeMap<u32, u64>, BTreeSet<ElementId>) {
    let (mut factors, mut again) = (BTreeMap::new(), BTreeSet::new());
    if view.counters().0.is_empty() {
        return (factors, again);
    }
    let mut cycles: BTreeMap<u32, Vec<&Edge>> = BTreeMap::new();
    for edge in edges.iter().filter(|edge| component[edge.from] == component[edge.to]) {
        cycles.entry(component[edge.from]).or_default().push(edge);
    }
    for (number, cycle) in cycles {
        let counters = view.counters().bounding(view, cycle.iter().copied());
        let rounds = counters.iter().map(|(_, counter)| counter.most());
        let factor = rounds.fold(1, u64::saturating_add);
        if !counters.is_empty() && factor <= room(cycle[0].from) {
            factors.insert(number, factor);
            again.extend(counters.into_iter().map(|(id, _)| id));
        }
    }
    (factors, again)
}
