//! Random plans under random scripts: both back ends must print the same bytes.
//!
//! `AFP_RANDOM_PLANS` selects plans by their seeds (`400..800`); the build script compiles them.

#[path = "random/rules.rs"]
mod rules;

use afp_tests::interpret::{graph, interpret};
use afp_tests::platform::WRONG_CALL;
use afp_tests::random::RandomPlan;
use afp_tests::random_script::script;
use afp_tests::script::Script;
use afp_tests::{compare, random};

use rules::Exercised;

/// The random plans as Rust.
mod plans {
    include!(concat!(env!("OUT_DIR"), "/random.rs"));
}

const SCRIPTS: u64 = 20;

/// While a plan is held, no component starts and no actor is polled.
fn nothing_acts_in_a_hold(trace: &[String], plan: &RandomPlan, script: u64) {
    let actors: Vec<_> = plan.channels.iter().filter(|channel| channel.actor).collect();
    let polls =
        |line: &str| actors.iter().any(|actor| line.ends_with(&format!(" [poll {}]", actor.name)));
    let mut held = false;
    for line in trace {
        let acts = line.ends_with(" started") || line.contains(" reads ") || polls(line);
        assert!(!held || !acts, "script {script}: {line} in\n{}", plan.text);
        if line.ends_with(" held") || line.ends_with(" held before its start") {
            held = true;
        } else if line.ends_with(" released") || line.contains(" ended ") {
            held = false;
        }
    }
}

#[test]
fn interpreter_and_generated_code_agree() {
    let (mut exercised, mut suspending) = (Exercised::default(), 0);
    for (seed, generated) in plans::PLANS {
        let plan = random::plan(*seed);
        let graph =
            graph(&format!("seed{seed}"), &plan.text).unwrap_or_else(|errors| panic!("{errors}"));
        suspending += usize::from(plan.text.contains(" -> suspend "));
        for script_seed in 0..SCRIPTS {
            let text = script(&plan, script_seed);
            let script: Script = text.parse().expect("a script that can be read");
            let interpreted = interpret(&graph, &script);
            if let Some(parted) = compare::part(&interpreted, &generated(&script)) {
                panic!("seed {seed}, script {script_seed}: {parted}\n\n{text}\n{}", plan.text);
            }
            nothing_acts_in_a_hold(&interpreted, &plan, script_seed);
            let wrong = interpreted.iter().find(|line| line.starts_with(WRONG_CALL));
            assert_eq!(wrong, None, "seed {seed}, script {script_seed}\n\n{text}\n{}", plan.text);
            exercised.count(&interpreted);
        }
    }
    exercised.print();
    println!("{suspending} of {} plans suspend", plans::PLANS.len());
    assert_eq!(exercised.missing(), [""; 0], "rules that no run exercised");
}
