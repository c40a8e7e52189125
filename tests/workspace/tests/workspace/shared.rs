//! Shared builds: macros and programs, the tests, the command line and the Python package use the
//! same units.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};

use afp_workspace::{built_from, cargo, output, packages};
use serde_json::Value;

/// The cargo arguments of the workspace's tests.
const TESTS: &str = "test --workspace --features afpc/full --exclude afp-bench --exclude afp-py \
                     --exclude afp-py-wheel --exclude afp-language-server --exclude afp-wasm --exclude xtask";

/// A library in one build variant.
struct Unit {
    name: String,
    /// Identifies the build variant, with all its dependencies.
    way: u64,
}

/// The libraries that cargo would build.
fn libraries(command: &str) -> Vec<Unit> {
    let (command, options) = command.split_once(' ').unwrap();
    let mut plan = cargo(command);
    plan.args(options.split_whitespace()).arg("--unit-graph");
    // Cargo's build plan is an unstable option.
    plan.args(["-Z", "unstable-options"]).env("RUSTC_BOOTSTRAP", "1");
    // The settings of Cargo.toml apply, not those of the environment.
    for wish in ["CARGO_PROFILE_DEV_DEBUG", "CARGO_PROFILE_DEV_BUILD_OVERRIDE_DEBUG"] {
        plan.env_remove(wish);
    }
    let graph: Value = serde_json::from_str(&output(&mut plan)).unwrap();
    let units = graph["units"].as_array().unwrap();
    let mut ways = vec![None; units.len()];
    let is_library = |unit: &Value| {
        let kinds = unit["target"]["kind"].as_array();
        unit["mode"] == "build"
            && kinds.is_some_and(|all| all.iter().any(|kind| kind == "lib" || kind == "proc-macro"))
    };
    let all = (0..units.len()).map(|index| {
        let name = units[index]["target"]["name"].as_str().unwrap().replace('_', "-");
        (index, Unit { name, way: way(units, index, &mut ways) })
    });
    all.filter(|(index, _)| is_library(&units[*index])).map(|(_, unit)| unit).collect()
}

/// The build variant of a unit.
fn way(units: &[Value], index: usize, known: &mut [Option<u64>]) -> u64 {
    if let Some(way) = known[index] {
        return way;
    }
    let unit = &units[index];
    let mut hasher = DefaultHasher::new();
    for part in ["pkg_id", "target", "features", "mode", "platform"] {
        unit[part].to_string().hash(&mut hasher);
    }
    // The name of the profile does not matter.
    for part in ["opt_level", "lto", "debuginfo", "debug_assertions", "overflow_checks", "panic"] {
        unit["profile"][part].to_string().hash(&mut hasher);
    }
    let below = unit["dependencies"].as_array().unwrap().iter();
    let below: BTreeSet<_> = below
        .map(|dependency| way(units, dependency["index"].as_u64().unwrap() as usize, known))
        .collect();
    below.hash(&mut hasher);
    *known[index].insert(hasher.finish())
}

#[test]
fn shared_libraries_of_macros_and_programs_are_built_once() {
    let shared = built_from(&packages(), "afp-codegen");
    for features in ["default", "full"] {
        let mut builds = BTreeMap::new();
        for unit in libraries(&format!("build --package afpc --features {features}")) {
            *builds.entry(unit.name).or_insert(0) += 1;
        }
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

#[test]
fn libraries_of_the_tests_serve_all_other_builds() {
    let tests: BTreeSet<_> = libraries(TESTS).into_iter().map(|unit| unit.way).collect();
    // Libraries with fewer features than in tests, and all their dependents.
    let of_first =
        ["afpc", "afp-build", "afp-log", "afp-run", "afp-sweep", "afp-test", "itertools"];
    // Those, and the libraries of the Python package.
    let of_python = [
        "afp-log",
        "afp-run",
        "afp-sweep",
        "afp-test",
        "afp-build",
        "afp-py",
        "ndarray",
        "numpy",
        "target-lexicon",
    ];
    for (command, apart) in [
        ("build --package afpc", &of_first[..]),
        ("build --package afpc --features full", &[]),
        ("build --package afp-tests --bin state_charts", &[]),
        ("build --package afp-py-wheel", &of_python),
    ] {
        let again: BTreeSet<_> = libraries(command)
            .into_iter()
            .filter(|unit| {
                !tests.contains(&unit.way)
                    && !apart.contains(&&*unit.name)
                    && !unit.name.starts_with("pyo3")
            })
            .map(|unit| unit.name)
            .collect();
        assert!(
            again.is_empty(),
            "'cargo {command}' builds {again:?} anew: somewhere below them a crate has other features than in tests; \
             name it with the same ones, as Cargo.toml does"
        );
    }
}
