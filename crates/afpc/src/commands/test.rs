//! `afpc test`: runs scenarios on all cores and reports the results.

mod cover;
mod find;
mod generate;
mod mutate;
mod reporter;

use std::path::{Path, PathBuf};
use std::time::Instant as Wall;

use afp_dsl::scenario::{InvalidScenario, Scenario};
use afp_run::options::whole;
use afp_run::{EXIT_FAILED, EXIT_OK, EXIT_PLAN_ERROR, RunError, StopFlag, say};
use afp_session::Loader;
use afp_syntax::source::Span;
use afp_test::{Coverage, Hits, Recording, Setting, Verdict};
use clap::Args;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};

use crate::commands::EXIT_STOPPED;
#[cfg(all(feature = "pi", unix))]
use crate::in_the_loop;
use crate::no_plan::NoPlan;
use crate::plan_file::PlanFile;
use crate::{Linked, runner};

use reporter::Reporter;

/// Arguments of `afpc test`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Files or folders with scenarios, and words in the names of scenarios [default: the project's
    /// folder, its plans, tests and scenarios]
    #[arg(value_name = "FILTER|FILE")]
    what: Vec<String>,

    /// Print a JSON object for each scenario
    #[arg(long)]
    json: bool,

    /// Report unused elements, states, events, errors and entries
    #[arg(long, group = "told")]
    coverage: bool,

    /// Also count logged runs of the same plans
    #[arg(long, value_name = "LOG", requires = "coverage")]
    add_log: Vec<PathBuf>,

    /// File for the drawing of '--coverage' (SVG or PNG) or the scenarios of '--generate'; a folder
    /// for several plans
    #[arg(short, long, value_name = "FILE|FOLDER", requires = "told")]
    output: Option<PathBuf>,

    /// Write scenarios for plans: every event at five points of each actor's run
    #[arg(long, group = "told")]
    generate: bool,

    /// Mutate plans (signs, targets, constants, swapped branches) and report which scenarios notice
    /// it
    #[arg(long, group = "told", conflicts_with = "output")]
    mutate: bool,

    /// Run scenarios with the driver of the real robot, in real time: the simulator is behind the
    /// protocol of its controller
    #[cfg(all(feature = "pi", unix))]
    #[arg(long, conflicts_with_all = ["generate", "mutate"])]
    in_the_loop: bool,

    /// Seed for the mutations of '--mutate'
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0,
        value_parser = whole,
        allow_hyphen_values = true,
        requires = "mutate"
    )]
    seed: u64,

    /// Minimum percentage of noticed mutants for '--mutate'
    #[arg(
        long,
        value_name = "PERCENT",
        value_parser = percent,
        allow_hyphen_values = true,
        requires = "mutate"
    )]
    at_least: Option<f64>,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc test                       all scenarios of the project
  afpc test bump                  scenarios with 'bump' in their names
  afpc test plans/tests/room.afp  scenarios of a file
  afpc test --coverage            and all unused parts of the plans
  afpc test --coverage -o cover   the coverage as drawings, one per plan
  afpc test --generate plans/wall_following.afp
  afpc test --mutate --at-least 95
  afpc test --in-the-loop         the driver of the real robot, with a simulated controller

A failed scenario is run again with a log: target/afp/tests/<file>.<name>.<hash>.mcap.
Exit codes: 0 all passed, 1 a file is invalid, 2 nothing to run, 3 a scenario failed or too few mutants are noticed,
130 stopped";

/// A scenario to run.
struct Case<'a> {
    /// The file with the scenario and the plan that it is for.
    plan_file: &'a PlanFile,
    /// The file name from the command line.
    file: &'a Path,
    /// The line of the scenario's name.
    line: usize,
    /// The scenario or its error.
    scenario: Result<&'a Scenario, &'a InvalidScenario>,
}

/// The result of a case.
struct Done {
    verdict: Result<Verdict, Failure>,
    /// The log of a failed case.
    log: Option<PathBuf>,
}

/// The reasons for not running a case.
enum Failure {
    /// The scenario is invalid or its plan has changed: the compiler's message.
    Invalid(String),
    /// The world is missing, for example.
    Run(RunError),
}

/// The usage of a plan by its scenarios.
struct Used<'a> {
    plan_file: &'a PlanFile,
    /// One of the scenarios.
    scenario: &'a Scenario,
    coverage: Coverage,
}

fn percent(text: &str) -> Result<f64, String> {
    let percent = text.parse::<f64>().ok().filter(|percent| (0.0..=100.0).contains(percent));
    percent.ok_or_else(|| "expected a number from 0 to 100".to_owned())
}

/// Runs scenarios and returns the exit code.
///
/// # Errors
/// There is nothing to run, a file cannot be read.
pub fn run(arguments: &Arguments, linked: &Linked<'_>) -> Result<u8, NoPlan> {
    if arguments.generate {
        let files: Vec<_> = arguments.what.iter().map(PathBuf::from).collect();
        let output = arguments.output.as_deref();
        return generate::run(&files, output, linked);
    }
    let find::Wanted { files, filters } = find::wanted(&arguments.what)?;
    let (read, code) = read(&files)?;
    if arguments.mutate {
        if let Some(word) = filters.first() {
            let message = format!("'--mutate' takes files, and there is no file '{word}'");
            return Err(RunError::usage(message, "name the files of the scenarios").into());
        }
        link(&read, linked)?;
        return mutate::run(&read, code, arguments, linked);
    }
    let cases: Vec<_> =
        read.iter().flat_map(cases).filter(|case| matches(case, &filters)).collect();
    if cases.is_empty() && code == EXIT_OK {
        return Err(find::nothing(&filters, &files).into());
    }
    #[cfg(all(feature = "pi", unix))]
    if arguments.in_the_loop {
        // The driver of a profile needs no other program.
        let mut profiles = read.iter().map(|file| file.own.project.project.profile());
        let robot = in_the_loop::loader(profiles.next().flatten())?;
        return run_all(&cases, code, arguments, &robot);
    }
    // Building takes minutes. All other errors are reported first.
    link(&read, linked)?;
    run_all(&cases, code, arguments, linked.robot)
}

/// Reads the files and returns the exit code of the invalid files.
///
/// # Errors
/// The only file cannot be read. With several files, an invalid file does not hide the others.
fn read(files: &[PathBuf]) -> Result<(Vec<PlanFile>, u8), NoPlan> {
    let (mut read, mut code) = (Vec::new(), EXIT_OK);
    for file in files {
        let file = match PlanFile::read(&file.display().to_string()) {
            Ok(file) => file,
            Err(error) if files.len() > 1 => {
                say(error.styled());
                code = EXIT_FAILED;
                continue;
            }
            Err(error) => return Err(error.into()),
        };
        // An invalid scenario does not fail the others.
        if file.compiled.diags.has_errors() && file.compiled.invalid.is_empty() {
            say(file.compiled.render(true));
            code = EXIT_FAILED;
        }
        read.push(file);
    }
    Ok((read, code))
}

/// Becomes a program with the toolboxes of all scenarios' plans, if some are not linked in.
fn link(files: &[PlanFile], linked: &Linked<'_>) -> Result<(), NoPlan> {
    let plans = files.iter().flat_map(|file| {
        file.compiled.scenarios.iter().map(|scenario| (&file.own, &*scenario.graph))
    });
    runner::become_one_for(plans, linked)
}

fn cases(file: &PlanFile) -> impl Iterator<Item = Case<'_>> {
    let line = |span: Span| {
        let source = file.compiled.sources.get(span.file);
        source.map_or(0, |source| source.line_column(span.start).0)
    };
    let case = move |scenario, span| Case {
        plan_file: file,
        file: &file.path,
        line: line(span),
        scenario,
    };
    let invalid = file.compiled.invalid.iter().map(move |each| case(Err(each), each.span));
    let valid = file.compiled.scenarios.iter().map(move |each| case(Ok(each), each.span));
    valid.chain(invalid)
}

impl<'a> Case<'a> {
    /// The scenario's name.
    fn name(&self) -> &'a str {
        self.scenario.map_or_else(|invalid| &*invalid.name, |scenario| &scenario.name)
    }

    /// The name of its plan.
    fn plan(&self) -> &'a str {
        self.scenario.map_or_else(|invalid| &*invalid.plan, |it| &it.graph.main().name)
    }
}

fn matches(case: &Case<'_>, filters: &[String]) -> bool {
    let name = case.name().to_lowercase();
    filters.is_empty() || filters.iter().any(|filter| name.contains(&filter.to_lowercase()))
}

/// Runs the cases on all cores until the command is stopped. Returns the exit code, `code` if
/// all cases passed.
fn run_all(
    cases: &[Case<'_>],
    code: u8,
    arguments: &Arguments,
    robot: &dyn Loader,
) -> Result<u8, NoPlan> {
    let begun = Wall::now();
    let stop =
        StopFlag::on_signals().map_err(RunError::file("cannot handle", "signals".as_ref()))?;
    let reporter = Reporter::new(cases.len(), arguments.json);
    let done: Vec<(&Case<'_>, Done)> = cases
        .par_iter()
        .with_max_len(1)
        .filter_map(|case| {
            let done = run_one(case, robot, &stop)?;
            reporter.done(case, &done);
            Some((case, done))
        })
        .collect();
    reporter.end(&done, begun.elapsed().as_secs_f64())?;
    if done.len() < cases.len() {
        return Ok(stop.exit_code().unwrap_or(EXIT_STOPPED));
    }
    if arguments.coverage {
        let plans = coverage(&done, &arguments.add_log)?;
        reporter::coverage(&plans, arguments.json)?;
        if let Some(output) = &arguments.output {
            cover::draw_all(&plans, output)?;
        }
    }
    let failed = done.iter().any(|(_, done)| !done.passed());
    Ok(if failed { EXIT_PLAN_ERROR } else { code })
}

/// The usage of each plan that has a case.
fn coverage<'a>(
    done: &[(&'a Case<'a>, Done)],
    logs: &[PathBuf],
) -> Result<Vec<Used<'a>>, RunError> {
    let mut plans: Vec<(&PlanFile, &Scenario, Hits)> = Vec::new();
    for (case, done) in done {
        let (Ok(verdict), Ok(scenario)) = (&done.verdict, case.scenario) else { continue };
        let key = |scenario: &Scenario| {
            let plan = scenario.graph.main();
            (scenario.plan_file.clone(), plan.name.clone())
        };
        match plans.iter_mut().find(|(_, known, _)| key(known) == key(scenario)) {
            Some((.., hits)) => hits.add(&verdict.hits),
            None => plans.push((case.plan_file, scenario, verdict.hits.clone())),
        }
    }
    for path in logs {
        let log = afp_log::read(path)?;
        let name = log.facts.get("plan").map_or("", String::as_str);
        let known = plans.iter_mut().find(|(_, known, _)| known.graph.main().name == name);
        if !known.is_some_and(|(.., hits)| hits.add_log(&log)) {
            let message =
                format!("'{}' is not the log of a plan with scenarios here", path.display());
            return Err(RunError::usage(message, "leave it out, or run the present plan again"));
        }
    }
    let used = plans.into_iter().map(|(plan_file, scenario, hits)| {
        let coverage = Coverage::new(&scenario.graph, &hits);
        Used { plan_file, scenario, coverage }
    });
    Ok(used.collect())
}

impl Done {
    fn passed(&self) -> bool {
        self.verdict.as_ref().is_ok_and(Verdict::passed)
    }
}

/// Runs a case; `None` if it was stopped before it ended.
fn run_one(case: &Case<'_>, robot: &dyn Loader, stop: &StopFlag) -> Option<Done> {
    let mut go_on = || !stop.is_raised();
    if !go_on() {
        return None;
    }
    let failed = |failure| Some(Done { verdict: Err(failure), log: None });
    let scenario = match case.scenario {
        Ok(scenario) => scenario,
        Err(invalid) => {
            let said = invalid.errors.render(&case.plan_file.compiled.sources, true);
            return failed(Failure::Invalid(said));
        }
    };
    let setting = match Setting::find(scenario, case.file, robot.kind()) {
        Ok(setting) => setting,
        Err(error) => return failed(Failure::Run(error)),
    };
    let came = afp_test::run_while(scenario, &setting, robot, None, &mut go_on);
    let verdict = came.transpose()?.map_err(Failure::Run);
    let failed = verdict.as_ref().is_ok_and(|verdict| !verdict.passed());
    if !failed {
        return Some(Done { verdict, log: None });
    }
    // Passing scenarios need no log, so a failed scenario runs a second time.
    let path = find::log_of(case.file, &scenario.name);
    let log = path.and_then(|path| {
        let to = Recording { path: &path, compiled: &case.plan_file.compiled };
        let again = afp_test::run_while(scenario, &setting, robot, Some(to), &mut go_on);
        again.ok().flatten().map(|_| path)
    });
    Some(Done { verdict, log })
}
