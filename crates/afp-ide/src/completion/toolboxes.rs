//! Items of toolboxes and their parts.

use super::List;
use super::bodies::with_holes;
use crate::view::token;
use afp_dsl::index::DefinitionKind;
use afp_syntax::Node;
use afp_syntax::kind::Kind;

pub(super) fn of_file(list: &mut List) {
    list.keyword("toolbox", with_holes("toolbox ‹name› version \"‹1.0›\""), 1);
    list.keyword("actor", with_holes("actor ‹Name› {\n    state ‹Done›\n}"), 0);
    list.keyword("computation", with_holes("computation ‹Name› {\n    state ‹Done›\n}"), 0);
    list.keyword("supervisor", with_holes("supervisor ‹Name› {\n    event ‹Happened›\n}"), 0);
    list.keyword("enum", with_holes("enum ‹Name› { ‹first second› }"), 1);
    list.keyword("object", with_holes("object ‹Name›"), 1);
    list.keyword("sensor", with_holes("sensor ‹name› {\n    signal ‹value: float›\n}"), 1);
    list.keyword("device", with_holes("device ‹name› {\n    signal ‹value: float›\n}"), 1);
    list.keyword("robot", with_holes("robot {\n    truth ‹pose: pose›\n}"), 1);
}

pub(super) fn parts(list: &mut List, within: Kind) {
    if within == Kind::Device {
        return list.keywords(&["press", "stop", "fault", "signal", "truth"], 0);
    }
    list.keyword("in", with_holes("in ‹port›: ‹float›"), 0);
    if list.view.is_plan_file() {
        list.keyword("out", with_holes("out ‹port›: ‹float›"), 0);
        return list.keywords(&["state"], 0);
    }
    list.keyword("in live", with_holes("in live ‹port›: ‹float›"), 0);
    list.keyword("out", with_holes("out ‹port›: ‹float›"), 0);
    list.keywords(&["state", "event"], 0);
    list.keyword("exclusive", with_holes("exclusive ‹First› ‹Second›"), 1);
    list.keywords(&["every", "deadline", "budget", "stop", "uses", "needs"], 1);
    list.keyword("icon", with_holes("icon \"‹name›\""), 1);
}

/// Outputs that the body of a computation's state does not assign yet.
pub(super) fn assigned(list: &mut List, state: &Node) {
    let Some(template) = state.parent() else { return };
    let word = list.replaces;
    let binds = state.children().filter(|node| node.kind() == Kind::BindIn);
    let names = binds.filter_map(|bind| token(&bind, Kind::Name));
    let names = names.filter(|name| list.view.token_span(name).start != word.start);
    let taken: Vec<_> = names.map(|name| name.text().to_owned()).collect();
    for (id, _) in list.view.ports(&template, DefinitionKind::Output) {
        let name = list.view.name_of(id).to_owned();
        if !taken.contains(&name) {
            list.definition_as(id, &name, with_holes(&format!("{name} = ‹›")), 0);
        }
    }
}
