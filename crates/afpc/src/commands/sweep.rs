//! `afpc sweep`: many runs of a plan on all cores, and their results.

mod reporter;

use std::num::NonZero;
use std::path::PathBuf;
use std::thread;

use afp_core::Duration;
use afp_run::options::{Failure, Press, failure, press};
use afp_run::{EXIT_OK, EXIT_PLAN_ERROR, RunError, StopFlag, hash};
use afp_session::Build;
use afp_sweep::{
    Axis, Engine, Findings, Header, Journal, Outcome, OutputFiles, Seeds, Setting, Sweep,
    WorldChoice,
};
use clap::Args;

use crate::commands::EXIT_STOPPED;
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanArgument, PlanFile};
use crate::{Linked, runner};

use reporter::Reporter;

/// Arguments of `afpc sweep`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// Seeds of the runs, such as 1,5,20..30; 0..1000 ends with 999
    #[arg(long, value_name = "FROM..TO", default_value = "0", value_parser = afp_sweep::seeds, allow_hyphen_values = true)]
    seeds: Seeds,

    /// Vary an entry or a value of the world: walldist=20cm..60cm, walldist=20cm..60cm:5cm,
    /// gain=1,2,5; one value sets it, like '--set'
    #[arg(long, alias = "set", value_name = "NAME=VALUES", value_parser = afp_sweep::axis)]
    vary: Vec<Axis>,

    /// World file, map (.yaml), random:SEED or random:7..99; repeat for several worlds
    #[arg(long, value_name = "WORLD", value_parser = worlds)]
    world: Vec<Worlds>,

    /// Press a control of the robot in each run, as in 'afpc run'
    #[arg(long, value_name = "CONTROL@TIME", value_parser = press)]
    press: Vec<Press>,

    /// Inject a fault in each run, as in 'afpc run'
    #[arg(long, value_name = "DEVICE.FAULT[=AMOUNT]@TIME[..TIME]", value_parser = failure)]
    fail: Vec<Failure>,

    /// Stop each run at this time
    #[arg(long, value_name = "TIME", default_value = "60s", value_parser = afp_project::duration, allow_hyphen_values = true)]
    until: Duration,

    /// Table of outcomes: .csv, .parquet (if afpc has that feature), or a folder [default:
    /// target/afp/sweeps/<plan>-<grid>.csv]
    #[arg(short, long, value_name = "FILE|FOLDER")]
    output: Option<PathBuf>,

    /// Restart instead of continuing an earlier sweep
    #[arg(long)]
    restart: bool,

    /// Print a JSON object for each run, then the summary
    #[arg(long)]
    json: bool,

    /// Number of parallel runs [default: one per core]
    #[arg(long, value_name = "N", value_parser = jobs, allow_hyphen_values = true)]
    jobs: Option<NonZero<usize>>,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc sweep plan.afp --seeds 0..1000
  afpc sweep plan.afp --seeds 0..20 --vary walldist=20cm..60cm:5cm -o walldist.csv
  afpc sweep plan.afp --world random:0..100 --until 30s -o rooms.csv
  afpc sweep plan.afp --vary world.robot.charge=0.2..1

To continue a stopped or killed sweep, repeat its command.
Exit codes: 0 done, 1 a file is invalid, 2 wrong usage, 3 a run ended in Error or could not begin,
130 stopped before all runs were done";

/// The worlds of one `--world`.
#[derive(Clone, Debug)]
struct Worlds(Vec<String>);

fn jobs(text: &str) -> Result<NonZero<usize>, String> {
    text.parse().map_err(|_| "expected a whole number of at least 1".to_owned())
}

fn worlds(text: &str) -> Result<Worlds, String> {
    afp_sweep::worlds(text).map(Worlds)
}

/// Runs a sweep and returns the exit code.
///
/// # Errors
/// The plan is invalid, a file cannot be used, a varied value does not exist.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    let file = PlanFile::read(&arguments.plan.plan)?;
    runner::become_one_for(file.compiled.graph.iter().map(|graph| (&file.own, graph)), linked)?;
    let (file, graph) = file.checked()?;
    let mut sweep = arguments.sweep()?;
    let setting = Setting::new(&mut sweep, &graph, &file.path, linked.robot)?;
    let header = Header::new(program(linked)?, (&file.compiled, &graph), &setting, &sweep);
    let output = OutputFiles::new(arguments.output.as_deref(), &file.path, &header)?;
    let journal = Journal::open(&output.journal, &header, arguments.restart);
    let (mut journal, mut outcomes) = journal.map_err(RunError::from)?;
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let engine = Engine {
        sweep: &sweep,
        maker: &|row| setting.make(row),
        jobs: arguments
            .jobs
            .or_else(|| thread::available_parallelism().ok())
            .map_or(1, NonZero::get),
        stop: stop.flag(),
        watch: None,
    };
    let reporter = Reporter::new(&sweep, arguments.json);
    reporter.head(&output, outcomes.len());
    go_on(&engine, &reporter, &mut journal, &mut outcomes)?;
    let kept = journal.close();
    outcomes.sort_by_key(|outcome| outcome.run);
    // The results are printed even if their table cannot be written.
    let written = output.write(&sweep, &outcomes);
    let findings = Findings::new(&outcomes);
    reporter.end(&outcomes, &findings, written.is_ok().then_some(&output))?;
    written.and(kept)?;
    Ok(match (outcomes.len() as u64 == sweep.len(), findings.has_failures()) {
        (false, _) => EXIT_STOPPED,
        (true, true) => EXIT_PLAN_ERROR,
        (true, false) => EXIT_OK,
    })
}

impl Arguments {
    fn sweep(&self) -> Result<Sweep, RunError> {
        let worlds: Vec<_> = self
            .world
            .iter()
            .flat_map(|worlds| worlds.0.iter().cloned().map(WorldChoice::Named))
            .collect();
        let sweep = Sweep {
            plan: self.plan.plan.clone(),
            worlds: if worlds.is_empty() { vec![WorldChoice::OfPlan] } else { worlds },
            worlds_by_seed: false,
            axes: self.vary.clone(),
            seeds: self.seeds.clone(),
            caveat: None,
            presses: self.press.clone(),
            failures: self.fail.clone(),
            until: self.until,
        };
        Ok(sweep)
    }
}

/// Does the remaining runs, and records each run before the next one starts.
fn go_on(
    engine: &Engine<'_>,
    reporter: &Reporter<'_>,
    journal: &mut Journal,
    outcomes: &mut Vec<Outcome>,
) -> Result<(), RunError> {
    let mut done: Vec<u64> = outcomes.iter().map(|outcome| outcome.run).collect();
    done.sort_unstable();
    let left: Vec<u64> =
        (0..engine.sweep.len()).filter(|run| done.binary_search(run).is_err()).collect();
    let bar = reporter.bar(left.len() as u64);
    let mut broken = None;
    engine.run(&left, |outcome| {
        bar.done(&outcome);
        match journal.keep(&outcome) {
            Ok(()) => outcomes.push(outcome),
            Err(error) => broken = Some(error),
        }
        broken.is_none()
    });
    broken.map_or(Ok(()), Err)
}

/// The program that runs the plans. With the project's toolboxes, their sources count too. Python
/// computes the same text for plans without such toolboxes and can continue their sweeps.
fn program(linked: &Linked<'_>) -> Result<String, RunError> {
    let build = Build::this().to_string();
    if !linked.is_runner() {
        return Ok(build);
    }
    let me = std::env::current_exe().map_err(RunError::file("cannot find", "afpc".as_ref()))?;
    let bytes = std::fs::read(&me).map_err(RunError::file("cannot read", &me))?;
    Ok(format!("{build} {}", hash(&String::from_utf8_lossy(&bytes))))
}
