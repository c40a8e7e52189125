//! State Chart XML: the W3C's rules for a document, and every edge of a plan.

use std::collections::BTreeSet;

use afp_draw::scxml;
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_syntax::source::Source;
use roxmltree::{Document, Node};

const WALL_FOLLOWING: &str = include_str!("../../../plans/wall_following.afp");
const PAUSED: &str = include_str!("draw/paused.afp");
const EVERY_PART: &str = include_str!("draw/every_part.afp");

fn chart(text: &str, data: bool) -> String {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", text), &toolboxes, &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    scxml(&compiled.graph.unwrap(), Some(&compiled.sources), data)
}

/// The parts of the recommendation that a plan needs: an element's attributes and children.
const GRAMMAR: &[(&str, &[&str], &[&str])] = &[
    ("scxml", &["version", "datamodel", "name", "initial"], &["state", "final"]),
    ("state", &["id", "initial"], &["transition", "state", "final"]),
    ("final", &["id"], &[]),
    ("transition", &["event", "cond", "target", "type"], &[]),
];

fn is_valid(text: &str) {
    let document = Document::parse(text).unwrap();
    let root = document.root_element();
    assert_eq!(root.tag_name().name(), "scxml");
    assert_eq!(root.attribute("version"), Some("1.0"));
    let elements: Vec<_> = root.descendants().filter(Node::is_element).collect();
    let ids: Vec<_> = elements.iter().filter_map(|each| each.attribute("id")).collect();
    let known: BTreeSet<_> = ids.iter().copied().collect();
    assert_eq!(ids.len(), known.len(), "an id stands twice");
    assert!(ids.iter().all(|id| is_nc_name(id)), "{ids:?}");
    for element in elements {
        fits_the_grammar(&element);
        for reference in ["target", "initial"].iter().filter_map(|name| element.attribute(*name)) {
            assert!(known.contains(reference), "unknown reference '{reference}'");
        }
        match element.tag_name().name() {
            "transition" => is_valid_transition(&element, &known),
            "state" => starts_inside(&element),
            _ => {}
        }
    }
}

fn fits_the_grammar(element: &Node) {
    let name = element.tag_name().name();
    assert_eq!(element.tag_name().namespace(), Some("http://www.w3.org/2005/07/scxml"));
    let (_, attributes, children) = GRAMMAR.iter().find(|rule| rule.0 == name).unwrap();
    assert!(element.attributes().all(|each| attributes.contains(&each.name())), "{element:?}");
    let mut inside = element.children().filter(Node::is_element);
    assert!(inside.all(|each| children.contains(&each.tag_name().name())), "{element:?}");
}

fn is_nc_name(id: &str) -> bool {
    id.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && id.chars().all(|each| each.is_ascii_alphanumeric() || "_-.".contains(each))
}

/// `event` has descriptors; the null data model has no condition except `In`.
fn is_valid_transition(transition: &Node, known: &BTreeSet<&str>) {
    let events = transition.attribute("event").unwrap();
    let word = |word: &str| {
        !word.is_empty()
            && word.chars().all(|each| each.is_ascii_alphanumeric() || "_:-".contains(each))
    };
    assert!(events.split(' ').all(|event| event.split('.').all(word)), "{events}");
    if let Some(condition) = transition.attribute("cond") {
        let id = condition.strip_prefix("In('").and_then(|rest| rest.strip_suffix("')"));
        assert!(known.contains(id.unwrap()), "{condition}");
    }
}

fn starts_inside(state: &Node) {
    let inside = state.children().any(|each| each.has_tag_name((SCXML, "state")));
    assert_eq!(inside, state.attribute("initial").is_some(), "{state:?}");
    if let Some(initial) = state.attribute("initial") {
        assert!(state.descendants().skip(1).any(|each| each.attribute("id") == Some(initial)));
    }
}

const SCXML: &str = "http://www.w3.org/2005/07/scxml";

#[test]
fn charts_follow_the_recommendation() {
    for text in [WALL_FOLLOWING, EVERY_PART] {
        is_valid(&chart(text, true));
        is_valid(&chart(text, false));
    }
}

#[test]
fn every_edge_of_wall_following_is_a_transition() {
    let text = chart(WALL_FOLLOWING, true);
    let edges = [
        "event=\"escape.EscapeButtonPressed\" target=\"WallFollowing-Interrupted\"",
        "event=\"searchFirstWall-touch.TouchSensorPressed\" target=\"WallFollowing.backupCollision\"",
        "event=\"searchFirstWall.ForwardSuccessful\" target=\"WallFollowing.searchFirstWall\"",
        "event=\"followWall.WallLost\" target=\"WallFollowing.turnAfterWallLost\"",
        "event=\"findWallAngle.Error\" target=\"WallFollowing-Error\"",
    ];
    for edge in edges {
        assert!(text.contains(edge), "no '{edge}' in\n{text}");
    }
    assert!(text.contains("<!-- Forward(distance = -walldist) -->"), "{text}");
    let flow = chart(WALL_FOLLOWING, false);
    assert!(!flow.contains("walldist"), "{flow}");
}

#[test]
fn components_are_written_with_their_inputs_and_outputs() {
    let text = "use std
        table stops(x: length, y: length) {
            (1 m, 2 m)
        }
        plan P {
            var n: int = 0 out x: length out y: length
            start read
            computation read: Row(table = stops, index = n, x, y) { Row -> wait, End -> terminate }
            actor wait: Wait(duration = 1 s) { Elapsed -> terminate }
        }";
    let chart = |data| chart(text, data);
    let (full, flow) = (chart(true), chart(false));
    assert!(full.contains("<!-- Row(table = stops, index = n, x => x, y => y) -->"), "{full}");
    assert!(full.contains("<!-- Wait(duration = 1 s) -->"), "{full}");
    assert!(flow.contains("<!-- Row -->") && flow.contains("<!-- Wait -->"), "{flow}");
}

#[test]
fn states_of_declared_computations_have_their_conditions_in_comments() {
    let full = chart(EVERY_PART, true);
    let state = "<!-- Again when value < limit { next = value + 1 } -->\n      \
                 <transition event=\"loop.Again\" target=\"Square.drive\"/>\n      \
                 <!-- Done { next = 0 } -->\n      <transition event=\"loop.Done\"";
    assert!(full.contains(state), "{full}");
    assert!(!chart(EVERY_PART, false).contains("Again when"));
}

#[test]
fn the_head_lists_the_omitted_parts() {
    let text = chart(WALL_FOLLOWING, true);
    for words in [
        "polling order of supervisors",
        "periods, deadlines",
        "entries and values",
        "declared computation",
    ] {
        assert!(text.split("-->").next().unwrap().contains(words), "no '{words}'");
    }
}

#[test]
fn formulas_cannot_break_a_comment() {
    let text = "use std\nplan P {\nin a: int = 1\nvar b: string = \"x\"\nstart one\n\
                computation one: Assign(value = 1 - --a, result => c) { Done -> two }\n\
                computation two: Assign(value = \"--><state>--\" + b, result => b) { Done -> terminate }\n\
                out c: int\n}\n";
    is_valid(&chart(text, true));
}

#[test]
fn a_thousand_nested_sub_plans_fit_on_the_stack() {
    let mut text = "use std\n".to_owned();
    for depth in 0..1000 {
        let inner = depth + 1;
        text += &format!("plan P{depth} {{ start s subplan s: P{inner} {{ OK -> terminate }} }}\n");
    }
    text += "plan P1000 { start w actor w: Wait(duration = 1 s) { Elapsed -> terminate } }\n";
    let text = chart(&text, true);
    assert_eq!(text.matches("<state ").count(), 1002);
}

#[test]
fn a_return_leads_to_the_history_of_the_suspended_state() {
    let text = chart(PAUSED, false);
    let document = Document::parse(&text).unwrap();
    let named = |id: &str| {
        let mut nodes = document.descendants();
        nodes.find(|node| node.attribute("id") == Some(id)).unwrap()
    };
    assert_eq!(named("P-suspended").attribute("type"), Some("deep"));
    let drives =
        named("P.drive").parent().and_then(|outer| outer.attribute("id").map(str::to_owned));
    assert_eq!(drives.as_deref(), Some("P-flowing"));
    let mut exits = named("P.pause").children().filter(Node::is_element);
    let clicked = exits.find(|node| node.attribute("event") == Some("button.TouchSensorClicked"));
    assert_eq!(clicked.unwrap().attribute("target"), Some("P-suspended"));
}
