//! The gain of a second core for a sweep, compared with its gain for plain arithmetic; and the time
//! of a long sweep, compared with its single runs.
//!
//! The arithmetic runs in separate processes, so only the machine limits it. All cases take turns,
//! and the best turn counts.

use std::hint::black_box;
use std::path::Path;
use std::process::{Child, Command};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use afp_core::Duration;
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_sweep::{Engine, Row, Seeds, Setting, Sweep};
use afp_syntax::source::Source;

use crate::report::{Report, Row as Figure};

/// The option that makes this program only do arithmetic.
pub const ARITHMETIC: &str = "--arithmetic";

const PLAN: &str = include_str!("../../plans/wall_following.afp");
/// The simulated seconds of a run.
const SECONDS: u64 = 60;
/// The runs of a turn; several turns make up a long sweep.
const RUNS: u64 = 20;
const LONG: u64 = 1000;
/// The single runs in each turn.
const SINGLE: u64 = 10;

/// The smallest share of the arithmetic's gain that a sweep must reach.
const OF_ARITHMETIC: f64 = 0.9;
/// The largest ratio of a long sweep to its single runs, divided by cores.
const OF_SINGLE: f64 = 1.3;

/// The best turn of each case, in seconds.
struct Best {
    one_process: f64,
    two_processes: f64,
    one_job: f64,
    two_jobs: f64,
    all_jobs: f64,
    single: f64,
}

/// Measures both.
pub fn run(rounds: u32, report: &mut Report) {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new("plans/wall_following.afp", PLAN);
    let compiled = afp_dsl::compile(&source, &toolboxes, &Texts::default());
    let Some(graph) = &compiled.graph else { panic!("{}", compiled.render(false)) };
    let mut sweep = Sweep {
        caveat: None,
        presses: Vec::new(),
        failures: Vec::new(),
        plan: source.name.clone(),
        worlds: vec![afp_sweep::WorldChoice::OfPlan],
        worlds_by_seed: false,
        axes: Vec::new(),
        seeds: Seeds::new(0..LONG),
        until: Duration::from_secs(SECONDS),
    };
    let file = Path::new("plans/wall_following.afp");
    let robot = afp_sim::carbot(|_| {});
    let setting = Setting::new(&mut sweep, graph, file, &robot);
    let setting = setting.unwrap_or_else(|why| panic!("{why}"));
    let stop = AtomicBool::new(false);
    let maker = |row: &Row<'_>| setting.make(row);
    let engine = Engine { sweep: &sweep, maker: &maker, jobs: 1, stop: &stop, watch: None };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let best = measure(u64::from(rounds.div_ceil(25)).min(LONG / RUNS), engine, cores);
    tell(&best, cores, report);
}

fn measure(turns: u64, engine: Engine<'_>, cores: usize) -> Best {
    let with = |jobs| Engine { jobs, ..engine };
    let mut best = Best {
        one_process: f64::INFINITY,
        two_processes: f64::INFINITY,
        one_job: f64::INFINITY,
        two_jobs: f64::INFINITY,
        all_jobs: f64::INFINITY,
        single: f64::INFINITY,
    };
    // The cost depends on the seed, so every turn and every case has the same seeds.
    let (runs, few): (Vec<u64>, Vec<u64>) = ((0..RUNS).collect(), (0..SINGLE).collect());
    let less = |best: &mut f64, seconds: f64| *best = best.min(seconds);
    for _ in 0..turns {
        less(&mut best.one_process, seconds(|| arithmetic(1)));
        less(&mut best.one_job, seconds(|| all(with(1), &runs)));
        less(&mut best.two_processes, seconds(|| arithmetic(2)));
        less(&mut best.two_jobs, seconds(|| all(with(2), &runs)));
        less(&mut best.all_jobs, seconds(|| all(with(cores), &runs)));
        less(&mut best.single, seconds(|| few.iter().for_each(|run| alone(engine, *run))));
    }
    best
}

fn tell(best: &Best, cores: usize, report: &mut Report) {
    let arithmetic = 2.0 * best.one_process / best.two_processes;
    let gained = best.one_job / best.two_jobs;
    let ratio = gained / arithmetic;
    report.add(Figure::new("sweep/gain of two processes, arithmetic", arithmetic, "x"));
    report.add(
        Figure::new("sweep/gain of two jobs", gained, "x")
            .against("sweep/gain of two processes, arithmetic", ratio)
            .limit(format!(">= {OF_ARITHMETIC}"), ratio >= OF_ARITHMETIC),
    );
    let single = best.single / SINGLE as f64;
    let long = best.all_jobs * (LONG / RUNS) as f64;
    let ideal = single * LONG as f64 / cores as f64;
    let ratio = long / ideal;
    report.add(Figure::new("sweep/one run of 60 s", single * 1e3, "ms"));
    report.add(
        Figure::new(format!("sweep/{LONG} runs of 60 s, {cores} cores"), long, "s")
            .against(format!("sweep/one run of 60 s x {LONG} / {cores}"), ratio)
            .limit(format!("<= {OF_SINGLE}"), ratio <= OF_SINGLE),
    );
}

fn seconds(what: impl FnOnce()) -> f64 {
    let begun = Instant::now();
    what();
    begun.elapsed().as_secs_f64()
}

fn all(engine: Engine<'_>, runs: &[u64]) {
    let mut done = 0;
    engine.run(runs, |outcome| {
        assert!(!outcome.ending.is_failure(), "{outcome:?}");
        done += 1;
        true
    });
    assert_eq!(done, runs.len());
}

/// Executes one run on this thread.
fn alone(engine: Engine<'_>, run: u64) {
    black_box(engine.one(run));
}

/// Does the same arithmetic in each of this number of processes.
fn arithmetic(processes: usize) {
    let me = std::env::current_exe().unwrap_or_else(|why| panic!("{why}"));
    let start = |_| Command::new(&me).arg(ARITHMETIC).spawn();
    let children: Result<Vec<Child>, _> = (0..processes).map(start).collect();
    for mut child in children.unwrap_or_else(|why| panic!("{why}")) {
        let ended = child.wait().unwrap_or_else(|why| panic!("{why}"));
        assert!(ended.success());
    }
}

/// The work of such a process: a quarter of a second of arithmetic in registers.
pub fn work() {
    let mut number = black_box(0.1_f64);
    for _ in 0..60_000_000_u32 {
        number = 3.7 * number * (1.0 - number);
    }
    black_box(number);
}
