//! Calls between plans.

use afp_dsl::outline::{Component, Plan};
use gen_lsp_types as lsp;

use crate::answer::{Answer, ok};
use crate::server::Server;
use crate::workspace::Analysis;

/// Returns the plan that a name means, or that contains the position.
pub(crate) fn prepare(server: &mut Server, params: lsp::CallHierarchyPrepareParams) -> Answer {
    let (analysis, offset) = server.at(&params.text_document_position_params)?;
    let outline = &analysis.compiled.outline;
    let named = analysis.compiled.index.at(analysis.file, offset);
    let named = named.and_then(|name| name.meaning.definition());
    let name = named.map(|id| analysis.compiled.index.definition(id).name);
    let is_named = |plan: &&Plan| name.is_some() && plan.name.as_ref().map(|it| it.span) == name;
    let around = |plan: &&Plan| {
        plan.file() == analysis.file && plan.span.start <= offset && offset <= plan.span.end
    };
    let found = outline.plans.iter().find(is_named).or_else(|| outline.plans.iter().find(around));
    ok(found.and_then(|plan| item(server, &analysis, plan)).map(|item| vec![item]))
}

fn item(server: &Server, analysis: &Analysis, plan: &Plan) -> Option<lsp::CallHierarchyItem> {
    let name = plan.name.as_ref()?;
    let whole = server.workspace.location(&analysis.compiled, plan.span)?;
    let own = server.workspace.location(&analysis.compiled, name.span)?;
    Some(lsp::CallHierarchyItem {
        name: name.text.clone(),
        kind: lsp::SymbolKind::Class,
        tags: None,
        detail: None,
        uri: whole.uri,
        range: whole.range,
        selection_range: own.range,
        data: None,
    })
}

/// Returns the plans that use a plan, with the positions of these uses.
pub(crate) fn incoming(
    server: &mut Server,
    params: lsp::CallHierarchyIncomingCallsParams,
) -> Answer {
    let mut calls: Vec<lsp::CallHierarchyIncomingCall> = Vec::new();
    for path in server.workspace.plan_files() {
        let Some(analysis) = server.workspace.analysis(&path) else { continue };
        for (from, at, used) in uses(server, &analysis) {
            let own = from.uri == server.workspace.uri(&path);
            if !own || !is_same(&used, &params.item) {
                continue;
            }
            match calls.iter_mut().find(|call| is_same(&call.from, &from)) {
                Some(call) => call.from_ranges.push(at),
                None => calls.push(lsp::CallHierarchyIncomingCall { from, from_ranges: vec![at] }),
            }
        }
    }
    ok(calls)
}

/// Returns the plans that a plan uses.
pub(crate) fn outgoing(
    server: &mut Server,
    params: lsp::CallHierarchyOutgoingCallsParams,
) -> Answer {
    let analysis = server.analysis(&params.item.uri)?;
    let mut calls: Vec<lsp::CallHierarchyOutgoingCall> = Vec::new();
    for (from, at, to) in uses(server, &analysis) {
        if !is_same(&from, &params.item) {
            continue;
        }
        match calls.iter_mut().find(|call| is_same(&call.to, &to)) {
            Some(call) => call.from_ranges.push(at),
            None => calls.push(lsp::CallHierarchyOutgoingCall { to, from_ranges: vec![at] }),
        }
    }
    ok(calls)
}

fn is_same(a: &lsp::CallHierarchyItem, b: &lsp::CallHierarchyItem) -> bool {
    (&a.uri, &a.name) == (&b.uri, &b.name)
}

/// Each use of a plan as a sub-plan: the using plan, the position and the used plan.
fn uses(
    server: &Server,
    analysis: &Analysis,
) -> Vec<(lsp::CallHierarchyItem, lsp::Range, lsp::CallHierarchyItem)> {
    let outline = &analysis.compiled.outline;
    let pairs =
        outline.plans.iter().flat_map(|plan| plan.elements.iter().map(move |it| (plan, it)));
    let one = |(plan, element): (&Plan, &Component)| {
        let used = outline.plan(element.sub_plan()?);
        let at = element.template.as_ref()?.span;
        let at = server.workspace.location(&analysis.compiled, at)?.range;
        Some((item(server, analysis, plan)?, at, item(server, analysis, used)?))
    };
    pairs.filter_map(one).collect()
}
