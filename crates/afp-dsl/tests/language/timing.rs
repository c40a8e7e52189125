//! Timing results as tables after the plans.
//!
//! `AFP_BLESS=1` rewrites the tables; check the sums by hand.

use crate::support;

use afp_dsl::timing::{Target, Trust, check_target, timing};
use afp_syntax::diagnostics::Code;

const MARK: &str = "\n// Timing:\n";

#[test]
fn every_case_has_its_timing() {
    let toolboxes = support::toolboxes();
    let mut wrong = Vec::new();
    for path in support::files("tests/timing") {
        let case = support::read(&path);
        let text = case.split(MARK).next().unwrap();
        let compiled = support::compile(text, &toolboxes);
        let Some(graph) = &compiled.graph else {
            panic!("{}:\n{}", path.display(), compiled.render(false));
        };
        let target = text.lines().next().and_then(|line| line.strip_prefix("// target: "));
        let target = target.map(|name| Target::built_in(name).unwrap());
        let table = timing(graph, target.as_ref()).text();
        let table: String =
            table.lines().map(|line| format!("//  {line}").trim_end().to_owned() + "\n").collect();
        wrong.extend(support::compare(&path, &case, &format!("{text}{MARK}{table}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_timing_of_the_papers_plan_is_proved_if_it_has_slack() {
    let text = include_str!("../../../../plans/wall_following.afp");
    let compiled = support::compile(text, &support::toolboxes());
    let graph = compiled.graph.unwrap();
    for &name in &["host", "pi", "pi32"] {
        let target = Target::built_in(name).unwrap();
        let found = check_target(&graph, &target);
        assert!(found.is_empty(), "{name}: {}", found.render(&compiled.sources, false));
        for row in timing(&graph, Some(&target)).supervisors {
            let bound = row.interruption.unwrap();
            // A poll each millisecond leaves no slack on a Pi, which is late by a tenth of that.
            let no_slack = row.response.unwrap().total() == row.timing.deadline.as_nanos();
            assert_eq!(no_slack, name.starts_with("pi") && row.path == "searchFirstWall.touch");
            let trust = if no_slack { Trust::Assumed } else { Trust::Proved };
            assert_eq!(bound.trust, trust, "{name}: {}", row.path);
        }
    }
}

/// A microcontroller takes ten times as long, unless its budgets are given.
#[test]
fn a_slower_target_is_not_proved_before_its_budgets_are_known() {
    let text = include_str!("../../../../plans/wall_following.afp");
    let compiled = support::compile(text, &support::toolboxes());
    let graph = compiled.graph.unwrap();
    let mut target = Target::built_in("mcu").unwrap();
    let found = check_target(&graph, &target);
    assert!(!found.is_empty());
    assert!(
        found.iter().all(|one| one.code == Code::E0405),
        "{}",
        found.render(&compiled.sources, false)
    );
    let templates = graph.toolboxes.iter().flat_map(|toolbox| {
        toolbox.templates.iter().map(|template| (toolbox.name.clone(), template.name.clone()))
    });
    for (toolbox, template) in templates {
        target.budgets.entry(toolbox).or_default().insert(template, 20_000);
    }
    let found = check_target(&graph, &target);
    assert!(found.is_empty(), "{}", found.render(&compiled.sources, false));
    let text = timing(&graph, Some(&target)).text();
    assert!(text.contains("budgets come from '[target.mcu]', the others"), "{text}");
}
