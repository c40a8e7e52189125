//! Random worlds, two hundred by default; `AFP_WORLDS` sets the number, `AFP_WORLD_SEED` selects
//! one.

use std::env;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use afp_worlds::{Case, Outcome, run};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// The default number of worlds.
const WORLDS: u64 = 200;
/// The fewest steps of a world on average: ten million by night and a hundred thousand by day.
const STEPS: u64 = 1000;
/// The interval of progress messages.
const NEWS: Duration = Duration::from_secs(10);

fn asked(name: &str) -> Option<u64> {
    let text = env::var(name).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{name}={text}: not a number")))
}

/// The command that repeats a world.
fn again(number: u64) -> String {
    let profile = if cfg!(debug_assertions) { "" } else { " --release" };
    format!("AFP_WORLD_SEED={number} cargo test{profile} -p afp-worlds -- --nocapture")
}

/// Drives through a world and returns violated rules or a panic in words.
fn verdict(number: u64) -> (Option<Outcome>, Vec<String>) {
    match catch_unwind(AssertUnwindSafe(|| run(&Case::random(number)))) {
        Ok(outcome) => {
            let broken = outcome.broken.iter().map(|(at, why)| format!("{at}: {why}")).collect();
            (Some(outcome), broken)
        }
        Err(_) => (None, vec!["it panicked".to_owned()]),
    }
}

/// Drives through one world and prints the details.
fn tell(number: u64) {
    print!("{}", Case::random(number));
    let (outcome, broken) = verdict(number);
    if let Some(outcome) = outcome {
        print!("{}", outcome.timeline);
        println!("trace {}, {:?}", outcome.trace, outcome.ending);
    }
    assert!(broken.is_empty(), "world {number}:\n{}", broken.join("\n"));
}

#[test]
fn all_rules_hold_in_any_world() {
    if let Some(number) = asked("AFP_WORLD_SEED") {
        return tell(number);
    }
    let worlds = asked("AFP_WORLDS").unwrap_or(WORLDS);
    let (done, steps) = (AtomicU64::new(0), AtomicU64::new(0));
    let findings = Mutex::new(Vec::new());
    let (begin, told) = (Instant::now(), Mutex::new(Instant::now()));
    (0..worlds).into_par_iter().for_each(|number| {
        let (outcome, broken) = verdict(number);
        steps.fetch_add(outcome.map_or(0, |it| it.steps), Ordering::Relaxed);
        if let Some(first) = broken.first() {
            let finding = format!("world {number}: {first}\n    {}", again(number));
            eprintln!("{finding}");
            findings.lock().expect("nobody panics here").push(finding);
        }
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        let mut told = told.lock().expect("nobody panics here");
        if told.elapsed() > NEWS {
            *told = Instant::now();
            eprintln!("{done} of {worlds} worlds, {:.0} s", begin.elapsed().as_secs_f64());
        }
    });
    let findings = findings.into_inner().expect("nobody panics here");
    let steps = steps.into_inner();
    println!("{worlds} worlds, {steps} steps in {:.1} s", begin.elapsed().as_secs_f64());
    assert!(findings.is_empty(), "{} of {worlds}:\n{}", findings.len(), findings.join("\n"));
    assert!(steps >= worlds * STEPS, "only {steps} steps");
}
