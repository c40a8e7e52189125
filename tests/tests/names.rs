//! A plan may use any names, and both back ends agree: its plans, entries, elements, supervisors,
//! ports, columns and choices have all names that occur in generated code.

use afp::load::{LoadedPlan, Registry};
use afp_dsl::compile_unchecked;
use afp_dsl::files::Texts;
use afp_syntax::source::Source;
use afp_tests::compare::part;
use afp_tests::drive::drive;
use afp_tests::interpret::toolboxes;
use afp_tests::script::Script;

/// The texts and the Rust of both.
#[allow(dead_code, reason = "nobody asks for the text behind `SOURCE`")]
mod made {
    include!(concat!(env!("OUT_DIR"), "/names.rs"));
}

use made::{PLAN, TOOLBOX, plan, words};

const SCRIPT: &str = "show names\nalways: x Other\nuntil 100000 ms";

#[test]
fn names_of_generated_code_are_free_for_plans_and_toolboxes() {
    let mut toolboxes = toolboxes();
    toolboxes.add(Source::new("words.afp", TOOLBOX), "crate::made::words");
    let compiled = compile_unchecked(&Source::new("plan.afp", PLAN), &toolboxes, &Texts::default());
    let errors = compiled.render(false);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{errors}"));
    let mut registry = Registry::new();
    afp_std::templates::register(&mut registry);
    afp_tests::templates::register(&mut registry);
    words::templates::register(&mut registry);
    let loaded = LoadedPlan::new(&graph, &registry).expect("all components are registered");
    let script: Script = SCRIPT.parse().expect("the script can be read");
    let interpreted = drive(loaded, &script);
    assert_eq!(
        interpreted.last().map(|line| line.ends_with("Main ended OK")),
        Some(true),
        "{:?}",
        interpreted.last()
    );
    if let Some(parted) = part(&interpreted, &drive(plan::new(), &script)) {
        panic!("{parted}");
    }
}
