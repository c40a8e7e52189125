//! Macros and programs share the compiler, which is built once and not twice.

use std::collections::BTreeMap;

use afp_workspace::{built_from, cargo, output, packages};
use serde_json::Value;

/// How often each package of the workspace is built as a library where `afpc` is built with some features.
fn builds(features: &str) -> BTreeMap<String, usize> {
    let mut plan = cargo("build");
    plan.args(["--package", "afpc", "--features", features, "--unit-graph"]);
    // What cargo would do is told by an option that has no promise yet.
    plan.args(["-Z", "unstable-options"]).env("RUSTC_BOOTSTRAP", "1");
    let graph: Value = serde_json::from_str(&output(&mut plan)).unwrap();
    let libraries = graph["units"].as_array().unwrap().iter().filter(|unit| {
        let kinds = unit["target"]["kind"].as_array();
        unit["mode"] == "build" && kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind == "lib"))
    });
    let mut builds = BTreeMap::new();
    for unit in libraries {
        let name = unit["target"]["name"].as_str().unwrap().replace('_', "-");
        *builds.entry(name).or_insert(0) += 1;
    }
    builds
}

#[test]
fn what_macros_and_programs_share_is_built_once() {
    let shared = built_from(&packages(), "afp-codegen");
    for features in ["", "full"] {
        let builds = builds(features);
        for name in shared.iter().map(String::as_str).chain(["prettyplease", "toml-edit"]) {
            assert_eq!(
                builds.get(name),
                Some(&1),
                "'{name}' with '{features}': somewhere below it a crate has other features for \
                 macros than for programs; give afp-codegen those"
            );
        }
    }
}
