//! Assembles the plans that one plan needs into a graph, sub-plans first.

use std::sync::Arc;

use crate::check::Program;
use crate::check::names::key;
use crate::graph::{self, Component, Graph, PlanId};
use crate::rows;

/// The graph of the plan `main`. `order` has sub-plans before their users; `plan` is called once
/// per needed plan.
pub(super) fn graph(
    program: &Program<'_>,
    mut plan: impl FnMut(usize) -> Option<graph::Plan>,
    order: &[usize],
    main: usize,
) -> Option<Graph> {
    let needed = needed(program, main);
    let chosen: Vec<_> = order.iter().copied().filter(|place| needed[*place]).collect();
    let mut ids = vec![None; program.plans.len()];
    for (id, place) in (0..=u16::MAX).zip(&chosen) {
        ids[*place] = Some(PlanId(id));
    }
    let mut drawn = Vec::with_capacity(chosen.len());
    for place in &chosen {
        let mut plan = plan(*place)?;
        for element in &mut plan.elements {
            if let Component::SubPlan(sub_plan) = &mut element.component {
                *sub_plan = ids[sub_plan.index()]?;
            }
        }
        drawn.push(plan);
    }
    let main = ids[main]?;
    tell_apart(&mut drawn, main);
    let toolboxes = program.linked.clone();
    let sources = program.files.iter().map(|file| (file.source.0, Arc::clone(file.source.1)));
    let mut graph = Graph {
        plans: drawn,
        main,
        toolboxes,
        rows: Vec::new(),
        sources: sources.collect(),
        moment: None,
    };
    graph.rows = rows::lower(&graph)?;
    Some(graph)
}

/// The plans that `main` contains, including itself.
pub(super) fn needed(program: &Program<'_>, main: usize) -> Vec<bool> {
    let mut needed = vec![false; program.plans.len()];
    let mut open = vec![main];
    while let Some(index) = open.pop() {
        if !std::mem::replace(&mut needed[index], true) {
            open.extend(program.sub_plans[index].iter().map(|(used, _)| *used));
        }
    }
    needed
}

/// Numbers plans with equal names from files that do not see each other; the main plan keeps its
/// name.
pub(super) fn tell_apart(plans: &mut [graph::Plan], main: PlanId) {
    let mut taken = std::collections::HashSet::from([key(&plans[main.index()].name)]);
    for (index, plan) in plans.iter_mut().enumerate() {
        if index == main.index() || taken.insert(key(&plan.name)) {
            continue;
        }
        let numbered = (2_u32..).map(|number| format!("{}_{number}", plan.name));
        if let Some(free) = numbered.into_iter().find(|name| taken.insert(key(name))) {
            plan.name = free;
        }
    }
}
