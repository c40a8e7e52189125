//! The scenarios of the shipped plans notice nearly every mutant: every second one by day, all with
//! `AFP_BY_NIGHT`.

use std::path::PathBuf;
use std::sync::Mutex;
use std::{env, fs};

use afp_dsl::Toolboxes;
use afp_syntax::source::Source;
use afp_test::mutate::{Bench, Judged, MutantStatus, Suite, Tally, mutants};

/// The required share of noticed mutants among those that change a run.
const SHARE: f64 = 0.95;
/// The share for half of them, in which a missed one counts twice.
const SHARE_OF_HALF: f64 = 0.9;

fn by_night() -> bool {
    env::var_os("AFP_BY_NIGHT").is_some()
}

fn read(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|error| error.to_string())
}

/// Judges the mutants of a plan file by the scenarios of these files.
fn judged(plan: &str, tests: &[&str]) -> Vec<Judged> {
    let robot = afp_sim::carbot(|_| {});
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    // The working directory of tests is the crate's folder.
    let path = format!("../../plans/{plan}.afp");
    let suites = tests.iter().map(|name| {
        let tests = format!("../../plans/tests/{name}.afp");
        let source = Source::new(&*tests, read(&tests).unwrap());
        Suite { file: PathBuf::from(&tests), source }
    });
    let bench = Bench::new(&path, suites.collect(), (&toolboxes, &read), &robot, &mut || true);
    let bench = bench.unwrap().unwrap();
    assert_eq!(bench.failing, [""; 0]);
    let step = if by_night() { 1 } else { 2 };
    let mutants = mutants(&read(&path).unwrap(), 0).into_iter().step_by(step);
    let mutants = Mutex::new(mutants.collect::<Vec<_>>());
    let judged = Mutex::new(Vec::new());
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    std::thread::scope(|threads| {
        for _ in 0..cores {
            threads.spawn(|| {
                loop {
                    let Some(mutant) = mutants.lock().unwrap().pop() else { return };
                    let one = bench.judge(mutant, &mut || true).unwrap();
                    judged.lock().unwrap().push(one);
                }
            });
        }
    });
    judged.into_inner().unwrap()
}

fn is_noticed(plan: &str, tests: &[&str]) {
    let judged = judged(plan, tests);
    let tally = Tally::of(&judged);
    let missed =
        judged.iter().filter(|each| matches!(each.status, MutantStatus::Missed { changed: true }));
    let missed: Vec<_> = missed
        .map(|each| format!("{}: {} => {}", each.mutant.line, each.mutant.was, each.mutant.is))
        .collect();
    assert!(tally.noticed > 5, "{tally:?}");
    let share = if by_night() { SHARE } else { SHARE_OF_HALF };
    assert!(tally.share() >= share, "{plan}: {tally:?}, nobody noticed {missed:#?}");
}

#[test]
fn mutants_of_wall_following_are_noticed() {
    is_noticed("wall_following", &["wall_following"]);
}

#[test]
fn mutants_of_find_infrared_are_noticed() {
    is_noticed("find_infrared", &["find_infrared"]);
}

#[test]
fn mutants_of_patterns_are_noticed() {
    is_noticed("patterns", &["patterns"]);
}

#[test]
fn mutants_of_following_a_boundary_are_noticed() {
    is_noticed("parts/boundary", &["boundary", "avoid_obstacle"]);
}

#[test]
fn mutants_of_exploring_are_noticed() {
    is_noticed("parts/explore", &["explore", "find_infrared"]);
}

#[test]
fn mutants_of_going_to_a_place_are_noticed() {
    is_noticed("parts/go_to", &["go_to", "navigate_room"]);
}

/// Steers to a side by an error, and counts.
const DECLARED: &str = "use std
enum Side { ahead left right }
computation Steer {
    in  error: float
    in  count: int
    out side:  Side
    out next:  int
    state Far when error < 3 and count < 2 { side = Side.left, next = count + 1 }
    state Near { side = Side.right, next = 0 }
}
plan P {
    in error: float = 2
    var n: int = 0
    out side: Side = Side.ahead
    out seen: int = 0
    start steer
    computation steer: Steer(error, count = n, next => n, side => side) { Far -> note, Near -> terminate }
    computation note: Assign(value = n, result => seen) { Done -> pause }
    actor pause: Wait(duration = 1 s) { Elapsed -> steer }
}
";

#[test]
fn conditions_and_values_of_declared_computations_have_mutants() {
    let found = mutants(DECLARED, 0).into_iter().filter(|it| it.line == 8);
    let found: Vec<_> = found.map(|it| format!("{}: {} for {}", it.kind, it.is, it.was)).collect();
    assert_eq!(
        found,
        [
            "sign: -error for error",
            "sign: >= for <",
            "constant: 4 for 3",
            "sign: -3 for 3",
            "sign: -count for count",
            "sign: >= for <",
            "constant: 3 for 2",
            "sign: -2 for 2",
            "constant: Side.ahead for Side.left",
            "sign: -count for count",
            "sign: - for +",
            "constant: 2 for 1",
            "sign: -1 for 1",
        ]
    );
}

#[test]
fn scenarios_notice_mutants_of_declared_computations() {
    let text = format!(
        "{DECLARED}
        scenario \"two are far\" for P {{
            expect steer.Far 2 times, expect seen == 2, expect side == Side.left
        }}
        scenario \"none is far\" for P {{
            set error = 3.0, never steer.Far, expect side == Side.right, never n == 1
        }}"
    );
    let robot = afp_sim::carbot(|_| {});
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let suite = Suite { file: PathBuf::from("plan.afp"), source: Source::new("plan.afp", &*text) };
    let bench = Bench::new("plan.afp", vec![suite], (&toolboxes, &read), &robot, &mut || true);
    let bench = bench.unwrap().unwrap();
    assert_eq!(bench.failing, [""; 0]);
    let ours = mutants(&text, 0).into_iter().filter(|it| (8..10).contains(&it.line));
    let judged: Vec<_> = ours.map(|it| bench.judge(it, &mut || true).unwrap()).collect();
    let missed = judged.iter().filter(|it| !matches!(it.status, MutantStatus::Noticed(_)));
    let missed: Vec<_> = missed.map(|it| (&it.mutant.is, it.mutant.column, &it.status)).collect();
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn a_suspension_is_ignored_and_a_return_ends_the_plan() {
    let text = "use std
plan P {
    start work
    supervise tick: Every(period = 1 s) { Due -> suspend rest }
    actor work: Wait { Elapsed -> terminate }
    actor rest: Wait { Elapsed -> return }
}
";
    let changes: Vec<_> = mutants(text, 0).into_iter().map(|it| (it.line, it.was, it.is)).collect();
    let has = |line, was: &str, is: &str| {
        let wanted = (line, format!("-> {was}"), format!("-> {is}"));
        assert!(changes.contains(&wanted), "{wanted:?}: {changes:?}");
    };
    has(4, "suspend rest", "ignore");
    has(6, "return", "terminate");
}
