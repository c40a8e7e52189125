//! The scenarios of the shipped plans cover every edge.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::common::Place;

/// A plan that is only covered by the scenarios of another plan: it has a path input, and a
/// scenario cannot set it.
const INSIDE: (&str, &str) = ("FindInfrared", "elsewhere");

/// The names of the plan's own unused parts, `inside` one of its sub-plans or in the plan itself.
/// Deeper parts belong to the scenarios of the sub-plan.
fn unused(parts: &[Value], inside: &str) -> Vec<String> {
    let below =
        |part: &Value| part["name"].as_str().unwrap().strip_prefix(inside).map(str::to_owned);
    let elements = parts.iter().filter(|part| part["kind"] == "elements").filter_map(below);
    let sub_plans: BTreeSet<String> =
        elements.filter_map(|name| Some(name.split_once('.')?.0.to_owned())).collect();
    let is_own = |part: &Value, name: &str| {
        let itself = ["elements", "entries"].contains(&part["kind"].as_str().unwrap());
        // The parts of a component begin with its name.
        let component = if itself { name } else { name.rsplit_once('.').map_or(name, |it| it.0) };
        component.split_once('.').is_none_or(|(first, _)| !itself && !sub_plans.contains(first))
    };
    let never = parts.iter().filter(|part| part["count"] == 0);
    let own = never.filter_map(|part| below(part).filter(|name| is_own(part, name)));
    own.collect()
}

#[test]
fn every_edge_of_the_shipped_plans_is_taken_by_a_scenario() {
    let plans = concat!(env!("CARGO_MANIFEST_DIR"), "/../../plans/tests");
    let said = Place::new().afpc(&format!("test {plans} --coverage --json"));
    said.succeeds();
    let lines = said.out.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    let all: Vec<Value> = lines.filter(|line| !line["coverage"].is_null()).collect();
    assert!(all.len() > 10, "{}", said.out);
    let mut never = Vec::new();
    for of in &all {
        let (plan, parts) = (of["coverage"].as_str().unwrap(), of["parts"].as_array().unwrap());
        never.extend(unused(parts, "").into_iter().map(|name| format!("{plan}: {name}")));
        if plan == INSIDE.0 {
            let below = format!("{}.", INSIDE.1);
            assert!(parts.iter().any(|part| part["name"].as_str().unwrap().starts_with(&below)));
            never.extend(unused(parts, &below).into_iter().map(|name| format!("{below}{name}")));
        }
    }
    assert_eq!(never, [""; 0], "nothing took these");
}
