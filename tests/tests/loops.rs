//! The limit in the help for counting loops within one step is exact: one more round is a livelock.

use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_syntax::diagnostics::Code;
use afp_syntax::source::Source;
use afp_tests::interpret::{interpret, toolboxes};
use afp_tests::script::Script;

/// Plans with `LIMIT` as the end of a loop.
const PLANS: &[&str] = &[
    "plan P { start count var i: int = 0
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> count, Done -> terminate } }",
    "plan P { start rest var i: int = 0
    actor rest: Wait(duration = 10 ms) { Elapsed -> count }
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> count, Done -> terminate } }",
    "plan P { start rest var i: int = 0
    actor rest: Wait(duration = 10 ms) { Elapsed -> count }
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> note, Done -> last }
    computation note: Assign(value = 1, result => j) { Done -> more } var j: int = 0
    computation more: Assign(value = 2, result => j) { Done -> count }
    computation last: Assign(value = 3, result => j) { Done -> pause }
    actor pause: Wait(duration = 10 ms) { Elapsed -> terminate } }",
    "plan P { start rest var i: int = 0 var j: int = 0
    actor rest: Wait(duration = 10 ms) { Elapsed -> note }
    computation note: Assign(value = 1, result => j) { Done -> count }
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> note, Done -> terminate } }",
    "plan P { start rest
    actor rest: Wait(duration = 10 ms) { Elapsed -> counting }
    subplan counting: Counting { OK -> terminate } }
    plan Counting { start count var i: int = 0
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> count, Done -> terminate } }",
    "plan P { start rest var i: int = 0
    actor rest: Wait(duration = 1 s) {
        supervise often: CheckTimeout(duration = 5 ms) { TimedOut -> count } Elapsed -> terminate
    }
    computation count: Count(value = i, limit = LIMIT, next => i) { Again -> count, Done -> terminate } }",
];

/// The diagnostics of the plan, and whether it ends in a livelock.
fn run(plan: &str, limit: u64) -> (Vec<String>, bool) {
    let text = format!("use std\n{}", plan.replace("LIMIT", &limit.to_string()));
    let compiled = compile(&Source::new("loops.afp", text), &toolboxes(), &Texts::default());
    let told = compiled.diags.iter().filter(|each| each.code == Code::E0312);
    let told = told.map(|each| each.help_text()).collect();
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let trace = interpret(graph, &"until 100 ms".parse::<Script>().unwrap());
    (told, trace.iter().any(|line| line.contains("livelock")))
}

#[test]
fn a_loop_counts_as_far_as_the_help_says() {
    for plan in PLANS {
        let (told, livelock) = run(plan, 5000);
        assert!(livelock, "{plan}");
        let [help] = told.as_slice() else { panic!("{plan}: {told:?}") };
        let most = help.split_once("count at most to ").and_then(|(_, rest)| rest.split_once(','));
        let most: u64 = most.unwrap_or_else(|| panic!("{help}")).0.parse().unwrap();
        assert_eq!(run(plan, most), (Vec::new(), false), "{plan}: {most}");
        let (told, livelock) = run(plan, most + 1);
        assert!(livelock && !told.is_empty(), "{plan}: {most} and one");
    }
}
