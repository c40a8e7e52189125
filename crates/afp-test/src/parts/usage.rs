//! The use counts of each part of each plan.

use afp_draw::{Count, PlanUsage, Reaction, Usage};
use afp_dsl::graph::Element;

use super::{Parts, What};
use crate::watch::hits::Hits;

impl Parts<'_> {
    /// Adds up use counts by plan, over all uses of the plan.
    pub(crate) fn usage(&self, hits: &Hits) -> Usage {
        let plans = self.graph.plans.iter().map(|plan| PlanUsage {
            plan: plan.span,
            elements: plan.elements.iter().map(none_of_element).collect(),
            supervisors: plan.supervisors.iter().map(|each| none(each.events.len())).collect(),
            entries: vec![0; plan.entries.len()],
        });
        let mut usage = Usage { plans: plans.collect() };
        for (part, touched) in self.parts.iter().zip(hits.components()) {
            let Some(plan) = usage.plans.get_mut(part.plan.index()) else { continue };
            let count = match part.what {
                What::Element(id) => plan.elements.get_mut(id.index()),
                What::Supervisor(id) => plan.supervisors.get_mut(id.index()),
                What::Plan => None,
            };
            if let Some(count) = count {
                count.starts += touched.starts;
                count.special += touched.special;
                let outcomes = count.outcomes.iter_mut().zip(&touched.outcomes);
                outcomes.for_each(|(sum, count)| *sum += count);
                let reactions = count.reactions.iter_mut().zip(&touched.reactions);
                reactions.for_each(|(sum, count)| sum.count += count);
            }
        }
        for home in &self.homes {
            let Some(plan) = usage.plans.get_mut(home.plan.index()) else { continue };
            let written = hits.entries.iter().skip(home.entries as usize);
            plan.entries.iter_mut().zip(written).for_each(|(sum, count)| *sum += count);
        }
        usage
    }
}

fn none(outcomes: usize) -> Count {
    Count { outcomes: vec![0; outcomes], ..Count::default() }
}

/// The order of reactions is that of the trace.
fn none_of_element(element: &Element) -> Count {
    let tables = element.reactions.iter().flat_map(|table| {
        let events = (0..).map(Some).take(table.events.len()).chain([None]);
        let edges = events.filter(|event| table.target(*event).is_some());
        edges.map(|event| Reaction { supervisor: table.supervisor.index(), event, count: 0 })
    });
    Count { reactions: tables.collect(), ..none(element.states.len()) }
}
