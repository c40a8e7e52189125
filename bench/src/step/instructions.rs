//! Instructions of a step, without and with a `suspend` that no event takes, counted by valgrind.
//!
//! Unlike times, these counts do not depend on how busy the machine is.

use std::env;
use std::process::Command;

use afp_core::StillClock;
use afp_core::trace::NoTrace;

use crate::plans::{step::Step, suspending::Suspending};
use crate::report::{Report, Row};
use crate::steps::steps;

/// Largest ratio of the instructions with `suspend` to those without.
const MOST: f64 = 1.02;
/// Steps of two runs, whose difference has no start of the program in it.
const STEPS: [u64; 2] = [2_000, 12_000];

/// Repeats a step: the work that valgrind counts.
pub fn repeat(count: u64, suspending: bool) {
    match suspending {
        true => steps(Suspending::new(), NoTrace, StillClock)(count),
        false => steps(Step::new(), NoTrace, StillClock)(count),
    }
}

/// Compares both plans; without valgrind there is no result.
pub fn run(report: &mut Report) {
    let per_step = |suspending| {
        let [few, many] = STEPS.map(|steps| count(steps, suspending));
        Some((many?.saturating_sub(few?)) as f64 / (STEPS[1] - STEPS[0]) as f64)
    };
    let (Some(plain), Some(suspending)) = (per_step(false), per_step(true)) else {
        eprintln!("step/instructions: valgrind does not run");
        return;
    };
    let ratio = suspending / plain;
    report.add(Row::new("step/generated, instructions", plain, "instr"));
    report.add(
        Row::new("step/with an unused suspend, instructions", suspending, "instr")
            .against("step/generated, instructions", ratio)
            .limit(format!("<= {MOST}"), ratio <= MOST),
    );
}

fn count(steps: u64, suspending: bool) -> Option<u64> {
    let mut command = Command::new("valgrind");
    command.args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]);
    command.arg(env::current_exe().ok()?).arg(format!("--steps={steps}"));
    if suspending {
        command.arg("--suspending");
    }
    let output = command.output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    // `==123== I refs: 1,234`
    let (_, number) = text.lines().find(|line| line.contains(" refs:"))?.rsplit_once(':')?;
    number.trim().replace(',', "").parse().ok()
}
