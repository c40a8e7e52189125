//! Every event at five points of each actor's run, for the plans that are shipped.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use afp_dsl::Compiled;
use afp_dsl::files::Texts;
use afp_dsl::scenario::{DEFAULT_UNTIL, Scenario};
use afp_dsl::source::Source;
use afp_dsl::toolbox::Toolboxes;
use afp_test::{Setting, Verdict};

fn compiled(name: &str, text: &str) -> Compiled {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = afp_dsl::compile(&Source::new(name, text), &toolboxes, &Texts::default());
    assert!(compiled.graph.is_some(), "{}", compiled.render(false));
    compiled
}

fn run(scenario: &Scenario, setting: &Setting) -> Verdict {
    afp_test::run(scenario, setting, &|_| {}, None).unwrap()
}

#[test]
fn every_event_leads_where_the_plan_says() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../plans");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files: Vec<_> = files.filter(|path| path.extension().is_some_and(|e| e == "afp")).collect();
    assert!(!files.is_empty());
    for file in files {
        let (name, text) = (file.display().to_string(), fs::read_to_string(&file).unwrap());
        let graph = Arc::new(compiled(&name, &text).graph.unwrap());
        let base = Scenario::quiet("as it goes", graph.clone(), &*name, DEFAULT_UNTIL);
        let setting = Setting::find(&base, &file).unwrap();
        let made = afp_test::generate(&graph, "same file", &run(&base, &setting).activations);
        // The scenarios stand below the plan itself, so nothing is used.
        let (_, scenarios) = made.text.split_once('\n').unwrap();
        let all = compiled(&name, &format!("{text}\n{scenarios}"));
        assert_eq!(all.scenarios.len(), made.scenarios);
        assert!(made.scenarios >= 5, "{name}");
        for scenario in &all.scenarios {
            let verdict = run(scenario, &setting);
            assert!(verdict.passed(), "{name}: {}\n{}", scenario.name, verdict.report());
        }
    }
}
