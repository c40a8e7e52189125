//! `afpc test`: runs scenarios, all cores at once, and says what they came to.

mod cover;
mod find;
mod generate;
mod tell;

use std::path::{Path, PathBuf};
use std::time::Instant as Wall;

use afp_dsl::scenario::Scenario;
use afp_run::{EXIT_FAILED, EXIT_OK, EXIT_PLAN_ERROR, RunError, say};
use afp_session::Loader;
use afp_test::{Coverage, Hits, Setting, Verdict};
use clap::Args;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::plan_file::{NoPlan, PlanFile};
use crate::{Linked, runner};

use tell::Teller;

/// Arguments of `afpc test`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Files or folders with scenarios, and words that the names of those to run contain [default:
    /// the project's folder, its plans, tests and scenarios]
    #[arg(value_name = "FILTER|FILE")]
    what: Vec<String>,

    /// Prints one JSON object for each scenario
    #[arg(long)]
    json: bool,

    /// Tells which elements, states, events, errors and entries no scenario made use of
    #[arg(long, group = "told")]
    coverage: bool,

    /// Counts logged runs of the same plans too
    #[arg(long, value_name = "LOG", requires = "coverage")]
    add_log: Vec<PathBuf>,

    /// With '--coverage' draws the plan with what was used into this file, an SVG or a PNG; with '--generate' writes
    /// the scenarios into it; several plans into this folder
    #[arg(short, long, value_name = "FILE|FOLDER", requires = "told")]
    output: Option<PathBuf>,

    /// Writes scenarios for plans: every event at five points of each actor's run
    #[arg(long, group = "told")]
    generate: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc test                       all scenarios of the project
  afpc test bump                  those with 'bump' in their names
  afpc test plans/tests/room.afp  those of a file
  afpc test --coverage            and what none of them made use of
  afpc test --coverage -o cover   the same as drawings, one for each plan
  afpc test --generate plans/wall_following.afp

A failed scenario is run again with a log: target/afp/tests/<name>.mcap.
Exit codes: 0 all passed, 1 a file is wrong, 2 nothing to run, 3 a scenario failed";

/// A scenario to run.
struct Case<'a> {
    /// The file with the scenario and the plan that it is for.
    plan_file: &'a PlanFile,
    /// The file as it was named.
    file: &'a Path,
    /// The line of its name.
    line: usize,
    scenario: &'a Scenario,
}

/// What became of a case.
struct Done {
    verdict: Result<Verdict, RunError>,
    /// The log of a failed one.
    log: Option<PathBuf>,
}

/// Runs scenarios; gives the exit code.
///
/// # Errors
/// Nothing to run, a file that cannot be read.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    if arguments.generate {
        let files: Vec<_> = arguments.what.iter().map(PathBuf::from).collect();
        let output = arguments.output.as_deref();
        return generate::run(&files, output, linked);
    }
    let find::Wanted { files, filters } = find::wanted(&arguments.what)?;
    let mut code = EXIT_OK;
    let mut read = Vec::new();
    for file in &files {
        let file = PlanFile::read(&file.display().to_string())?;
        if file.compiled.diags.has_errors() {
            say(file.compiled.render(true));
            code = EXIT_FAILED;
        }
        read.push(file);
    }
    link(&read, linked)?;
    let cases: Vec<_> =
        read.iter().flat_map(cases).filter(|case| matches(case, &filters)).collect();
    if cases.is_empty() && code == EXIT_OK {
        return Err(find::nothing(&filters, &files).into());
    }
    let failed = run_all(&cases, arguments, linked)?;
    Ok(if failed { EXIT_PLAN_ERROR } else { code })
}

/// Becomes a program with the toolboxes that the plans of all scenarios use, if some are not linked in.
fn link(files: &[PlanFile], linked: &Linked<'_>) -> Result<(), NoPlan> {
    let plans = files.iter().flat_map(|file| {
        file.compiled.scenarios.iter().map(|scenario| (&file.own, &*scenario.graph))
    });
    runner::become_one_for(plans, linked)
}

fn cases(file: &PlanFile) -> impl Iterator<Item = Case<'_>> {
    let line = |scenario: &Scenario| {
        let source = file.compiled.sources.get(scenario.span.file);
        source.map_or(0, |source| source.line_column(scenario.span.start).0)
    };
    let scenarios = file.compiled.scenarios.iter();
    scenarios.map(move |scenario| Case {
        plan_file: file,
        file: &file.path,
        line: line(scenario),
        scenario,
    })
}

fn matches(case: &Case<'_>, filters: &[String]) -> bool {
    let name = case.scenario.name.to_lowercase();
    filters.is_empty() || filters.iter().any(|filter| name.contains(&filter.to_lowercase()))
}

/// Runs the cases on all cores; whether one of them failed.
fn run_all(cases: &[Case<'_>], arguments: &Arguments, linked: &Linked<'_>) -> Result<bool, NoPlan> {
    let begun = Wall::now();
    let teller = Teller::new(cases.len(), arguments.json);
    let done: Vec<Done> = cases
        .par_iter()
        .with_max_len(1)
        .map(|case| {
            let done = run_one(case, linked.robot);
            teller.done(case, &done);
            done
        })
        .collect();
    teller.end(cases, &done, begun.elapsed().as_secs_f64())?;
    if arguments.coverage {
        let plans = coverage(cases, &done, &arguments.add_log)?;
        tell::coverage(&plans.iter().map(|(_, used)| used).collect::<Vec<_>>(), arguments.json)?;
        if let Some(output) = &arguments.output {
            cover::draw_all(&plans, output)?;
        }
    }
    Ok(done.iter().any(|done| !done.passed()))
}

/// What the runs used, for each plan with a case that is for it.
fn coverage<'a>(
    cases: &'a [Case<'a>],
    done: &[Done],
    logs: &[PathBuf],
) -> Result<Vec<(&'a Case<'a>, Coverage)>, RunError> {
    let mut plans: Vec<(&Case<'_>, Hits)> = Vec::new();
    for (case, done) in cases.iter().zip(done) {
        let Ok(verdict) = &done.verdict else { continue };
        let key = |scenario: &Scenario| {
            let plan = scenario.graph.main();
            (scenario.plan_file.clone(), plan.name.clone())
        };
        match plans.iter_mut().find(|(known, _)| key(known.scenario) == key(case.scenario)) {
            Some((_, hits)) => hits.add(&verdict.hits),
            None => plans.push((case, verdict.hits.clone())),
        }
    }
    for path in logs {
        let log = afp_log::read(path)?;
        let name = log.facts.get("plan").map_or("", String::as_str);
        let known = plans.iter_mut().find(|(case, _)| case.scenario.graph.main().name == name);
        if !known.is_some_and(|(_, hits)| hits.add_log(&log)) {
            let message = format!("'{}' is no log of a plan with scenarios here", path.display());
            return Err(RunError::usage(
                message,
                "leave it out, or run it with the plan as it is now",
            ));
        }
    }
    let cover =
        |(case, hits): (&'a Case<'a>, Hits)| (case, Coverage::new(&case.scenario.graph, &hits));
    Ok(plans.into_iter().map(cover).collect())
}

impl Done {
    fn passed(&self) -> bool {
        self.verdict.as_ref().is_ok_and(Verdict::passed)
    }
}

fn run_one(case: &Case<'_>, robot: &dyn Loader) -> Done {
    let setting = match Setting::find(case.scenario, case.file, robot.kind()) {
        Ok(setting) => setting,
        Err(error) => return Done { verdict: Err(error), log: None },
    };
    let verdict = afp_test::run(case.scenario, &setting, robot, None);
    let failed = verdict.as_ref().is_ok_and(|verdict| !verdict.passed());
    if !failed {
        return Done { verdict, log: None };
    }
    // The same run once more, since passing ones need no log.
    let path = find::log_of(case.file, &case.scenario.name);
    let log = path.and_then(|path| {
        afp_test::run(case.scenario, &setting, robot, Some(&path)).ok().map(|_| path)
    });
    Done { verdict, log }
}
