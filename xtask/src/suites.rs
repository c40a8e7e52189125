//! The suites of each task. They run one after the other; a summary is printed at the end.

use std::time::{Duration, Instant};

use crate::install::Profile;
use crate::needs::Need::{Chromium, Cyclictest, Node, Python};
use crate::needs::{self, Need};
use crate::shell::{Failure, cargo, output, run as run_command};
use crate::{
    arm, bench, dap, deploy, editors, engine, fuzz, gate, install, live, opencv, pi, python, scxml,
    studio, systems, vacuum, wasm, wheels,
};

/// A suite: its name, its requirements in addition to Rust, and its function.
type Suite = (&'static str, &'static [Need], fn() -> Result<(), Failure>);

pub const TEST: &[Suite] = &[
    ("workspace", &[], workspace),
    ("xtask", &[], || run_command(cargo().args(["test", "--package", "xtask"]))),
    ("python", &[Python], python::run),
    ("scxml", &[Node], || scxml::run(50)),
    ("dap", &[Node], dap::run),
    ("vscode", &[Node], editors::extension),
    ("studio", &[Node, Chromium], studio::test),
    ("live", &[Node], live::run),
];

pub const GATE: &[Suite] = &[
    ("firmware", &[], gate::run),
    ("web", &[], wasm::run),
    ("install", &[], || install::run(Profile::Debug)),
    ("vacuum", &[], vacuum::test),
    ("python robot", &[Python], python::robot),
    ("pi", &[], pi::short),
    ("rust alone", &[], rust_alone),
];

pub const NIGHTLY: &[Suite] = &[
    ("workspace", &[], workspace),
    ("random plans", &[], random_plans),
    ("random worlds", &[], random_worlds),
    ("single faults", &[], single_faults),
    ("every event", &[], every_event),
    ("mutants", &[], || by_night("afp-test", "mutants")),
    ("slips", &[], slips),
    ("messages", &[], messages),
    ("goals", &[], goals),
    ("maps", &[], maps),
    ("objects", &[], objects),
    ("arm", &[], arm::run),
    ("pi", &[], pi::run),
    ("deploy", &[], deploy::run),
    ("ways out", &[Cyclictest], ways_out),
    ("guard", &[], guard),
    ("other systems", &[Python], systems::run),
    ("engine", &[], engine::run),
    ("python", &[Python], python::run),
    ("python robot", &[Python], python::robot),
    ("python long", &[Python], python::long),
    ("wheels", &[Python], || wheels::run(&[])),
    ("scxml", &[Node], || scxml::run(2000)),
    ("dap", &[Node], dap::run),
    ("vscode", &[Node], editors::extension),
    ("tree-sitter", &[], editors::grammar),
    ("studio", &[Node, Chromium], studio::long),
    ("live", &[Node], live::run),
    ("firmware", &[], gate::run),
    ("web", &[], wasm::run),
    ("install", &[], || install::run(Profile::Release)),
    ("vacuum", &[], vacuum::all),
    ("rust alone", &[], rust_alone_whole),
    ("long run", &[], long_run),
    ("opencv", &[], opencv::run),
    ("fuzz", &[], || fuzz::run(&[], FUZZED)),
    ("benchmarks", &[], || bench(&["--check".to_owned()])),
];

pub const LINT: &[Suite] = &[
    ("format", &[], || run_command(cargo().args(["fmt", "--all", "--check"]))),
    ("clippy", &[], clippy),
    ("docs", &[], docs),
];

/// Seeds of the nightly random plans, each compiled to Rust, in parts that fit into memory. Nine in
/// ten of them have `suspend`.
const RANDOM_PLANS: &[&str] = &["0..450", "450..900", "900..1350", "1350..1800", "1800..2250"];

/// Random plans of the scheduler's tests, each without and with faults.
const SCHEDULES: &str = "50000";

const RANDOM_WORLDS: &str = "10000";

/// Seeds of the nightly runs with pauses.
const PAUSES: &str = "50";

/// First room and number of rooms in which the nightly run counts reached goals.
const GOALS: &str = "1000..100";
/// Views in which the nightly run searches objects.
const VIEWS: &str = "1000";
/// Rooms in which the nightly run injects every fault of every device.
const FAULTY_ROOMS: &str = "20";

/// Steps of the nightly test without an allocation.
const STEPS: &str = "10000000";

/// Duration of the nightly fuzzing per reader, seconds.
const FUZZED: u32 = 600;

/// Runs of each way out of a run on a real robot.
const WAYS_OUT: &str = "100";

/// Kills of a run and of its guard.
const GUARD: &str = "100";

/// Runs the named suites and prints the summary. Without a name it runs all suites whose
/// requirements are met. With `all`, or with `CI` set, an unmet requirement is a failure.
///
/// # Errors
/// Unknown names, or the failed suites.
pub fn run(suites: &[Suite], names: &[String], all: bool) -> Result<(), Failure> {
    for name in names {
        if !suites.iter().any(|(known, ..)| known == name) {
            let known: Vec<_> = suites.iter().map(|(known, ..)| *known).collect();
            return Err(format!("no suite '{name}'; there are: {}", known.join(", ")).into());
        }
    }
    let wanted = suites
        .iter()
        .filter(|(name, ..)| names.is_empty() || names.iter().any(|wanted| wanted == name));
    let all = all || !names.is_empty() || std::env::var_os("CI").is_some();
    let (mut account, mut left_out) = (Vec::new(), Vec::new());
    for (name, needs, suite) in wanted {
        let missing: Vec<_> = needs.iter().copied().filter(|need| !need.is_met()).collect();
        if !missing.is_empty() && !all {
            left_out.push((*name, missing));
            continue;
        }
        eprintln!("\n== {name}");
        let (start, cpu_before) = (Instant::now(), cpu_seconds());
        let done = if missing.is_empty() { suite() } else { Err(not_there(&missing)) };
        if let Err(Failure(why)) = &done {
            eprintln!("{why}");
        }
        let cpu = cpu_seconds().zip(cpu_before).map(|(after, before)| after - before);
        account.push(Account { name, took: start.elapsed(), cpu, passed: done.is_ok() });
    }
    let done = conclude(&account);
    print!("{}", said_of(&left_out));
    done
}

/// The failure of a suite that cannot run.
fn not_there(missing: &[Need]) -> Failure {
    let names: Vec<_> = missing.iter().map(|need| need.name()).collect();
    let install = needs::install(missing);
    Failure(format!("error: there is no {}\nhelp: run '{install}'", names.join(" and no ")))
}

/// The skipped suites, their requirements, and the command that installs them; empty if none.
fn said_of(left_out: &[(&str, Vec<Need>)]) -> String {
    let mut all: Vec<Need> = Vec::new();
    let mut lines = String::new();
    for (name, missing) in left_out {
        let names: Vec<_> = missing.iter().map(|need| need.name()).collect();
        lines += &format!("{name:<14} left out: it needs {}\n", names.join(" and "));
        all.extend(missing.iter().filter(|need| !all.contains(need)).copied().collect::<Vec<_>>());
    }
    if !all.is_empty() {
        lines += &format!("to run them as well:\n    {}\n", needs::install(&all));
    }
    lines
}

/// The result of a suite.
struct Account {
    name: &'static str,
    took: Duration,
    /// Processor seconds of the suite and its children, if the system counts them.
    cpu: Option<f64>,
    passed: bool,
}

/// Processor seconds of all ended child processes; `None` outside Linux.
fn cpu_seconds() -> Option<f64> {
    const TICKS_PER_SECOND: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The program's name is in parentheses and may have spaces; `cutime` and `cstime` are fields 13
    // and 14 after it.
    let fields: Vec<&str> = stat.rsplit(") ").next()?.split(' ').collect();
    let ticks = |field: usize| fields.get(field)?.parse::<f64>().ok();
    Some((ticks(13)? + ticks(14)?) / TICKS_PER_SECOND)
}

fn conclude(account: &[Account]) -> Result<(), Failure> {
    println!();
    for Account { name, took, cpu, passed } in account {
        let verdict = if *passed { "ok" } else { "FAILED" };
        let cpu = cpu.map_or_else(String::new, |cpu| format!("{cpu:>8.1} s of CPU"));
        println!("{name:<14} {:>7.1} s {cpu}  {verdict}", took.as_secs_f64());
    }
    let failed: Vec<&str> =
        account.iter().filter(|suite| !suite.passed).map(|suite| suite.name).collect();
    if failed.is_empty() {
        return Ok(());
    }
    let again: Vec<String> = failed.iter().map(|name| again(name)).collect();
    Err(Failure(format!(
        "\nfailed: {}\nto repeat only these:\n{}",
        failed.join(", "),
        again.join("\n")
    )))
}

/// The command that repeats one suite.
fn again(name: &str) -> String {
    match name {
        "format" => "    cargo fmt --all".to_owned(),
        "clippy" | "docs" => format!("    cargo xtask lint {name}"),
        "random plans" => {
            let each = RANDOM_PLANS.iter();
            let run =
                |part| format!("    AFP_RANDOM_PLANS={part} cargo test -p afp-tests --test random");
            each.map(run).collect::<Vec<_>>().join("\n")
        }
        "random worlds" => {
            format!("    AFP_WORLDS={RANDOM_WORLDS} cargo test --release -p afp-worlds")
        }
        "messages" | "mutants" => format!("    cargo xtask nightly {name}"),
        "firmware" | "web" | "install" | "vacuum" => format!("    cargo xtask gate {name}"),
        "python robot" | "rust alone" => format!("    cargo xtask gate '{name}'"),
        "single faults" => format!(
            "    AFP_ROOMS={FAULTY_ROOMS} cargo test --release -p afp-worlds --test single_faults"
        ),
        "goals" => format!("    AFP_GOALS={GOALS} cargo test --release -p afp-worlds --test goals"),
        "maps" => {
            "    AFP_MAPS=FOLDER cargo test --release -p afp-worlds --test maps -- --nocapture"
                .to_owned()
        }
        "objects" => format!("    AFP_VIEWS={VIEWS} cargo test --release -p afp-sim objects"),
        "ways out" | "python long" | "other systems" => format!("    cargo xtask nightly '{name}'"),
        "wheels" => "    cargo xtask wheels".to_owned(),
        "arm" | "pi" | "deploy" | "engine" | "guard" | "opencv" => {
            format!("    cargo xtask nightly {name}")
        }
        "long run" => {
            format!("    AFP_STEPS={STEPS} cargo test --release -p afp-tests --test no_allocation")
        }
        "fuzz" => format!("    cargo xtask fuzz --seconds {FUZZED}"),
        "benchmarks" => "    cargo xtask bench --check".to_owned(),
        other => format!("    cargo xtask test {other}"),
    }
}

/// All tests of the crates and of the examples.
fn workspace() -> Result<(), Failure> {
    let all = ["test", "--workspace", "--features", "afpc/full", "--no-fail-fast"];
    // They have separate suites.
    let but = ["afp-bench", "afp-py", "afp-py-wheel", "afp-language-server", "afp-wasm", "xtask"]
        .map(|name| ["--exclude", name]);
    // Property tests use other cases in each manual run; here the same commit gives the same
    // result.
    let mut tests = cargo();
    tests.args(all).args(but.as_flattened()).env("PROPTEST_RNG_SEED", "20");
    // These tests need only Rust, so all other programs are hidden.
    run_command(needs::hidden_from(&mut tests)?)
}

/// Measures the ways out of a run on a real robot in series, and the punctuality of its control loop.
/// It needs the permission for priorities.
fn ways_out() -> Result<(), Failure> {
    let loops = ["test", "--package", "afp-run", "--test", "ways_out", "ways_out_"];
    let full = ["test", "--package", "afpc", "--features", "afpc/full", "--test", "afpc"];
    let driver = [&full[..], &["ways_out::"]].concat();
    for test in [&loops[..], &driver[..]] {
        let one = ["--", "--nocapture", "--test-threads=1"];
        run_command(cargo().args(test).args(one).env("AFP_WAYS_OUT", WAYS_OUT))?;
    }
    Ok(())
}

/// The times from a killed run to motors without power, and from a killed guard to the end of the
/// run, in series.
fn guard() -> Result<(), Failure> {
    let test =
        ["test", "--package", "afpc", "--features", "full", "--test", "afpc", "wired::after"];
    run_command(cargo().args(test).args(["--", "--nocapture"]).env("AFP_GUARD", GUARD))
}

/// The README's first command, on a machine with only Rust and a C linker.
fn rust_alone() -> Result<(), Failure> {
    let mut first = cargo();
    first.args(["run", "--package", "afpc", "--", "run", "plans/wall_following.afp"]);
    run_command(needs::hidden_from(&mut first)?)
}

/// Both commands of the README on such a machine: the second one names the skipped suites.
fn rust_alone_whole() -> Result<(), Failure> {
    rust_alone()?;
    let mut second = cargo();
    second.args(["xtask", "test"]).env_remove("CI");
    let said = output(needs::hidden_from(&mut second)?)?;
    println!("{said}");
    let left_out = TEST.iter().filter(|(_, needs, _)| !needs.is_empty());
    let named =
        |name: &str| said.lines().any(|line| line.starts_with(name) && line.contains("left out"));
    match left_out.map(|(name, ..)| *name).find(|name| !named(name)) {
        None => Ok(()),
        Some(name) => Err(format!("'{name}' was not skipped").into()),
    }
}

/// Every event at five points of each element's run, for every shipped plan.
fn every_event() -> Result<(), Failure> {
    by_night("afp-test", "generated")
}

/// Many mistakes in plans, each one error that its fix corrects; every prefix of every plan is
/// outlined, drawn and queried.
fn slips() -> Result<(), Failure> {
    by_night("afp-dsl", "language")?;
    by_night("afp-ide", "features")?;
    let drawn = ["test", "--release", "--package", "afp-draw", "--lib", "scene"];
    run_command(cargo().args(drawn).env("AFP_BY_NIGHT", "1"))
}

/// Random messages to the language server and the debug adapter.
fn messages() -> Result<(), Failure> {
    by_night("afp-lsp", "lsp")?;
    by_night("afp-debug", "messages")
}

/// A test with more cases at night.
fn by_night(package: &str, test: &str) -> Result<(), Failure> {
    let test = ["test", "--release", "--package", package, "--test", test];
    run_command(cargo().args(test).env("AFP_BY_NIGHT", "1"))
}

/// The interpreter against generated code on many random plans.
fn random_plans() -> Result<(), Failure> {
    let test = ["test", "--package", "afp-tests", "--test", "random", "--", "--nocapture"];
    let rules = ["test", "--release", "--package", "afp-core", "--test", "rules", "--", "random"];
    run_command(cargo().args(rules).env("AFP_SCHEDULES", SCHEDULES))?;
    for part in RANDOM_PLANS {
        run_command(cargo().args(test).env("AFP_RANDOM_PLANS", part))?;
    }
    Ok(())
}

/// Plans in random rooms with random faults, runs with pauses, and the recorded traces, optimised.
fn random_worlds() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-worlds", "--", "--nocapture"];
    run_command(cargo().args(test).env("AFP_WORLDS", RANDOM_WORLDS).env("AFP_PAUSES", PAUSES))
}

fn single_faults() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-worlds", "--test", "single_faults"];
    run_command(cargo().args(test).args(["--", "--nocapture"]).env("AFP_ROOMS", FAULTY_ROOMS))
}

/// How often plans reach their goal in random rooms.
fn goals() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-worlds", "--test", "goals"];
    run_command(cargo().args(test).args(["--", "--nocapture"]).env("AFP_GOALS", GOALS))
}

/// How often plans reach places on public maps in the folder `AFP_MAPS`.
fn maps() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-worlds", "--test", "maps"];
    run_command(cargo().args(test).args(["--", "--nocapture"]))
}

fn objects() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-sim", "--test", "sim", "objects"];
    run_command(cargo().args(test).args(["--", "--nocapture"]).env("AFP_VIEWS", VIEWS))
}

/// Ten million steps of a plan without an allocation, equal in both back ends.
fn long_run() -> Result<(), Failure> {
    let test = ["test", "--release", "--package", "afp-tests", "--test", "no_allocation"];
    run_command(cargo().args(test).env("AFP_STEPS", STEPS))
}

/// Links and tags of doc comments. Crates that need Python or the web to build are skipped.
fn docs() -> Result<(), Failure> {
    let left_out = ["afp-py", "afp-py-wheel", "afp-wasm"];
    let mut doc = cargo();
    doc.args(["doc", "--quiet", "--workspace", "--no-deps", "--keep-going"]);
    doc.args(left_out.iter().flat_map(|name| ["--exclude", name]));
    run_command(doc.env("RUSTDOCFLAGS", "--deny warnings"))
}

fn clippy() -> Result<(), Failure> {
    let deny = ["--", "--deny", "warnings"];
    run_command(cargo().args(["clippy", "--workspace", "--all-targets"]).args(deny))?;
    // With all optional features of the command line.
    let whole = ["clippy", "--package", "afpc", "--all-targets", "--features", "full,studio"];
    run_command(cargo().args(whole).args(deny))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_suite_is_reported_with_the_known_suites() {
        let Err(Failure(text)) = run(LINT, &["clipy".to_owned()], false) else {
            panic!("it passed")
        };
        assert_eq!(text, "error: no suite 'clipy'; there are: format, clippy, docs");
    }

    #[test]
    fn a_skipped_suite_is_named_with_its_needs() {
        let text = said_of(&[("studio", vec![Node, Chromium]), ("dap", vec![Node])]);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[0], "studio         left out: it needs Node.js with npm and Chromium");
        assert_eq!(lines[1], "dap            left out: it needs Node.js with npm");
        assert_eq!(lines[2], "to run them as well:");
        assert_eq!(lines[3], format!("    {}", needs::install(&[Node, Chromium])));
        assert_eq!(said_of(&[]), "");
    }

    #[test]
    fn a_missing_program_fails_a_run_of_all_suites() {
        let Failure(text) = not_there(&[Python]);
        assert!(text.starts_with("error: there is no Python 3 with venv\nhelp: run '"), "{text}");
    }

    #[test]
    fn a_failed_suite_is_named_with_the_command_that_repeats_it() {
        let account = [("dap", false), ("python", true)].map(|(name, passed)| Account {
            name,
            took: Duration::ZERO,
            cpu: None,
            passed,
        });
        let Err(Failure(text)) = conclude(&account) else { panic!("it passed") };
        assert!(text.contains("failed: dap") && text.contains("cargo xtask test dap"), "{text}");
        assert!(!text.contains("python"), "{text}");
    }
}
