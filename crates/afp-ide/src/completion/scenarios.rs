//! Lines of scenarios, names in them, and members after a `.`.

use super::List;
use super::bodies::{plain, with_holes};
use afp_dsl::VERBS;
use afp_dsl::graph::EntryKind;
use afp_dsl::index::{DefinitionId, DefinitionKind};
use afp_dsl::outline::ComponentKind;
use afp_syntax::Node;
use afp_syntax::ast::ENDS;
use afp_syntax::kind::Kind;

/// Lines of a scenario, all or only those relative to one of its moments.
pub(super) fn lines(list: &mut List, of_whole_run: bool) {
    list.keyword("at", with_holes("at ‹1 s›: "), 0);
    list.keywords(&["expect", "never"], 0);
    list.keywords(&["from"], 1);
    list.keyword("until", with_holes("until ‹60 s›"), 1);
    if !of_whole_run {
        return;
    }
    list.keyword("world", with_holes("world \"‹room.toml›\""), 1);
    list.keyword("seed", with_holes("seed ‹1›"), 1);
    list.keyword("over seeds", with_holes("over seeds ‹0..20›"), 1);
    list.keyword("over worlds", with_holes("over worlds \"‹room.toml›\""), 1);
    list.keywords(&["set"], 1);
    list.keyword("robot", with_holes("robot at (‹0 m, 0 m›) heading 0 deg"), 1);
}

/// Names after a keyword of a scenario.
pub(super) fn paths(list: &mut List, word: &str, offset: u32) {
    match word {
        ":" => list.keywords(VERBS, 0),
        "press" | "release" => devices(list, &[DefinitionKind::Control]),
        "fail" => devices(list, &[DefinitionKind::Device]),
        "expect" | "never" => {
            list.keyword("end", plain("end"), 1);
            list.keyword("running", plain("running"), 1);
            list.keywords(&["interrupt of", "commit of"], 2);
            of_plan(list, offset, |kind| {
                matches!(kind, DefinitionKind::Component(_) | DefinitionKind::Entry(_))
            });
            devices(list, &[DefinitionKind::Signal, DefinitionKind::Device]);
        }
        "->" => {
            list.keyword("terminate", plain("terminate"), 1);
            list.keyword("fail", plain("fail"), 1);
            list.keyword("resume", plain("resume"), 1);
            list.keyword("suspend", plain("suspend "), 1);
            list.keyword("return", plain("return"), 1);
            of_plan(list, offset, |kind| is_component(kind, false));
        }
        "end by" => {
            list.keywords_alone(&ENDS, 1);
            of_plan(list, offset, |kind| matches!(kind, DefinitionKind::Component(_)));
        }
        _ => of_plan(list, offset, |kind| matches!(kind, DefinitionKind::Component(_))),
    }
}

/// Entries to set: before the run, those that need a value from outside.
pub(super) fn entries(list: &mut List, later: bool, offset: u32) {
    match later {
        true => of_plan(list, offset, |kind| {
            matches!(kind, DefinitionKind::Entry(EntryKind::In | EntryKind::Var))
        }),
        false => of_plan(list, offset, |kind| kind == DefinitionKind::Entry(EntryKind::In)),
    }
}

/// Reasons for the end of a claim's first element: its states, its supervisors and those of its
/// plan.
pub(super) fn causes(list: &mut List, claim: &Node, offset: u32) {
    let view = list.view;
    let Some(element) = first_path(claim).and_then(|path| view.named_by(&path)) else {
        return of_plan(list, offset, |kind| is_component(kind, true));
    };
    let index = view.index();
    let definition = index.definition(element);
    for owner in [Some(element), definition.owner].into_iter().flatten() {
        let members = index.members(owner).filter(|(_, known)| is_component(known.kind, true));
        list.definitions(members.map(|(id, _)| id), 0);
    }
    let made = definition.made_from;
    let of_plan = made.is_some_and(|made| index.definition(made).kind == DefinitionKind::Plan);
    let states = made.into_iter().flat_map(|made| index.members(made));
    let states = states.filter(|(_, known)| known.kind == DefinitionKind::State);
    list.definitions(states.map(|(id, _)| id), 1);
    if of_plan {
        list.keywords_alone(&["OK", "Interrupted"], 1);
    }
    list.keywords_alone(&["Error"], 2);
}

fn first_path(claim: &Node) -> Option<Node> {
    claim.children().find(|child| child.kind() == Kind::Path)
}

/// Whether a definition is a supervisor, or else an element.
fn is_component(kind: DefinitionKind, watches: bool) -> bool {
    let supervisor = DefinitionKind::Component(ComponentKind::Supervisor);
    matches!(kind, DefinitionKind::Component(_)) && (kind == supervisor) == watches
}

/// The items in the plan of the scenario at a place.
fn of_plan(list: &mut List, offset: u32, fits: fn(DefinitionKind) -> bool) {
    let view = list.view;
    for id in view.index().visible(view.file, offset, fits) {
        if view.index().definition(id).owner.is_some() {
            list.definition(id, 0);
        }
    }
}

fn devices(list: &mut List, kinds: &[DefinitionKind]) {
    let all = list.view.index().definitions();
    let all = all.filter(|(_, known)| kinds.contains(&known.kind));
    list.definitions(all.map(|(id, _)| id), 3);
}

/// Members: the templates of a toolbox, the values of an enum, the supervisors and exits of an
/// element.
pub(super) fn members(list: &mut List, home: Option<DefinitionId>) {
    let Some(home) = home else { return };
    let index = list.view.index();
    list.definitions(index.members(home).map(|(id, _)| id), 0);
    let definition = index.definition(home);
    if let (DefinitionKind::Component(_), Some(made)) = (definition.kind, definition.made_from) {
        list.definitions(index.members(made).map(|(id, _)| id), 1);
    }
}
