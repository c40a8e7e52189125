//! Items of toolboxes and their parts.

use super::List;
use super::bodies::with_holes;
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
    list.keyword("in live", with_holes("in live ‹port›: ‹float›"), 0);
    list.keyword("out", with_holes("out ‹port›: ‹float›"), 0);
    list.keywords(&["state", "event"], 0);
    list.keyword("exclusive", with_holes("exclusive ‹First› ‹Second›"), 1);
    list.keywords(&["every", "deadline", "budget", "stop", "uses"], 1);
    list.keyword("icon", with_holes("icon \"‹name›\""), 1);
}
