//! The verdicts of scenarios about mutants.

use std::path::PathBuf;

use afp_dsl::Compiled;
use afp_dsl::Toolboxes;
use afp_dsl::files::{Files, normalised};
use afp_dsl::graph::EntryKind;
use afp_dsl::scenario::{DEFAULT_UNTIL, Scenario};
use afp_run::RunError;
use afp_session::Loader;
use afp_syntax::source::Source;

use super::Mutant;
use crate::run_while;
use crate::setting::Setting;
use crate::verdict::Verdict;

/// A file with scenarios.
#[derive(Clone, Debug)]
pub struct Suite {
    /// The file; its worlds are looked up next to it.
    pub file: PathBuf,
    /// Its text, with the name from which its imports are resolved.
    pub source: Source,
}

/// The scenarios of a plan file, each with its verdict on the original plan.
pub struct Bench<'a> {
    plan_file: String,
    suites: Vec<(Suite, Vec<Case>)>,
    toolboxes: &'a Toolboxes,
    files: &'a (dyn Files + Sync),
    robot: &'a dyn Loader,
    /// The names of scenarios that fail on the original plan.
    pub failing: Vec<String>,
}

/// A run of the original plan.
struct Case {
    name: String,
    setting: Setting,
    trace: u64,
    /// Whether it has no stimuli and no expectations, and only shows whether a mutant changes
    /// anything.
    quiet: bool,
}

/// The result of the scenarios for a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MutantStatus {
    /// It does not compile.
    Refused,
    /// These scenarios failed, or could not run.
    Noticed(Vec<String>),
    /// All scenarios passed.
    Missed {
        /// Whether the trace of a run differed.
        changed: bool,
    },
}

/// A mutant with its result.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The judged mutant.
    pub mutant: Mutant,
    /// The result of the scenarios.
    pub status: MutantStatus,
}

/// The numbers of mutants by result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// A scenario failed.
    pub noticed: usize,
    /// All scenarios passed, although a trace changed.
    pub missed: usize,
    /// All compared traces are equal.
    pub unchanged: usize,
    /// The mutant does not compile.
    pub refused: usize,
}

impl Tally {
    /// Counts the results of mutants.
    pub fn of<'j>(judged: impl IntoIterator<Item = &'j Judged>) -> Tally {
        let mut tally = Tally::default();
        for each in judged {
            *match &each.status {
                MutantStatus::Refused => &mut tally.refused,
                MutantStatus::Noticed(_) => &mut tally.noticed,
                MutantStatus::Missed { changed: true } => &mut tally.missed,
                MutantStatus::Missed { changed: false } => &mut tally.unchanged,
            } += 1;
        }
        tally
    }

    /// The share of noticed mutants among those that change a trace, 0 to 1; 1 without such
    /// mutants.
    pub fn share(&self) -> f64 {
        match self.noticed + self.missed {
            0 => 1.0,
            all => self.noticed as f64 / all as f64,
        }
    }
}

impl<'a> Bench<'a> {
    /// Runs the scenarios in these files for plans of `plan_file`, as named by the compiler. `None`
    /// if `go_on` cancels it.
    ///
    /// # Errors
    /// A scenario cannot run: a missing world, or a template without Rust.
    pub fn new(
        plan_file: &str,
        suites: Vec<Suite>,
        (toolboxes, files): (&'a Toolboxes, &'a (dyn Files + Sync)),
        robot: &'a dyn Loader,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Option<Self>, RunError> {
        let plan_file = plan_file.to_owned();
        let (suites_in, suites, failing) = (suites, Vec::new(), Vec::new());
        let mut bench = Bench { plan_file, suites, toolboxes, files, robot, failing };
        for suite in suites_in {
            let compiled = bench.compile(&suite, None);
            let mut cases = Vec::new();
            for scenario in bench.scenarios(&compiled) {
                let setting = Setting::find(&scenario, &suite.file, robot.kind())?;
                let Some(verdict) = run_while(&scenario, &setting, robot, None, go_on)? else {
                    return Ok(None);
                };
                let quiet = scenario.expectations.is_empty();
                match verdict.passed() || quiet {
                    true => cases.push(Case {
                        name: scenario.name,
                        setting,
                        trace: verdict.trace,
                        quiet,
                    }),
                    false => bench.failing.push(scenario.name),
                }
            }
            bench.suites.push((suite, cases));
        }
        Ok(Some(bench))
    }

    /// The number of judging scenarios.
    pub fn judges(&self) -> usize {
        let cases = self.suites.iter().flat_map(|(_, cases)| cases);
        cases.filter(|case| !case.quiet).count()
    }

    /// Judges a mutant; `None` if `go_on` cancels it.
    pub fn judge(&self, mutant: Mutant, go_on: &mut dyn FnMut() -> bool) -> Option<Judged> {
        let (mut noticed, mut changed) = (Vec::new(), false);
        for (suite, cases) in &self.suites {
            let compiled = self.compile(suite, Some(&mutant.text));
            if compiled.scenarios.is_empty() && compiled.invalid.is_empty() {
                return Some(Judged { mutant, status: MutantStatus::Refused });
            }
            let scenarios = self.scenarios(&compiled);
            for case in cases {
                let scenario = scenarios.iter().find(|scenario| scenario.name == case.name);
                let came = match scenario {
                    Some(scenario) => self.run(scenario, case, go_on)?,
                    // The mutant cannot perform a named action.
                    None if case.quiet => continue,
                    None => Compared { broke: true, changed: true },
                };
                changed |= came.changed;
                if came.broke && !case.quiet {
                    noticed.push(case.name.clone());
                }
            }
        }
        let status = match noticed.is_empty() {
            true => MutantStatus::Missed { changed },
            false => MutantStatus::Noticed(noticed),
        };
        Some(Judged { mutant, status })
    }

    fn run(
        &self,
        scenario: &Scenario,
        case: &Case,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Option<Compared> {
        let came = run_while(scenario, &case.setting, self.robot, None, go_on);
        Some(match came.transpose()? {
            Ok(verdict) => Compared::new(&verdict, case),
            Err(_) => Compared { broke: true, changed: true },
        })
    }

    /// The scenarios for plans of the file, and a run without stimuli for each of these plans.
    fn scenarios(&self, compiled: &Compiled) -> Vec<Scenario> {
        let own = compiled.scenarios.iter().filter(|each| each.plan_file == self.plan_file);
        let mut all: Vec<Scenario> = own.cloned().collect();
        let mut plans: Vec<String> = Vec::new();
        for index in 0..all.len() {
            let Some(scenario) = all.get(index) else { continue };
            let plan = scenario.graph.main();
            let open =
                |entry: &afp_dsl::graph::Entry| entry.kind == EntryKind::In && entry.init.is_none();
            if plans.contains(&plan.name) || plan.entries.iter().any(open) {
                continue;
            }
            plans.push(plan.name.clone());
            let name = format!("{} undisturbed", plan.name);
            let graph = scenario.graph.clone();
            all.push(Scenario::quiet(name, graph, &*self.plan_file, DEFAULT_UNTIL));
        }
        all
    }

    /// Compiles a suite, optionally with a changed plan.
    fn compile(&self, suite: &Suite, plan: Option<&str>) -> Compiled {
        let Some(text) = plan else {
            return afp_dsl::compile(&suite.source, self.toolboxes, self.files);
        };
        if suite.source.name == self.plan_file {
            let source = Source::new(&*self.plan_file, text);
            return afp_dsl::compile(&source, self.toolboxes, self.files);
        }
        let read = |path: &str| match normalised(path) == normalised(&self.plan_file) {
            true => Ok(text.to_owned()),
            false => self.files.read(path),
        };
        afp_dsl::compile(&suite.source, self.toolboxes, &read)
    }
}

/// The result of a mutant's run.
struct Compared {
    broke: bool,
    changed: bool,
}

impl Compared {
    fn new(verdict: &Verdict, case: &Case) -> Compared {
        Compared { broke: !verdict.passed(), changed: verdict.trace != case.trace }
    }
}
