//! What the scenarios of a plan say of its mutants.

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
    /// The file, beside which its worlds are looked for.
    pub file: PathBuf,
    /// Its text, under the name from which what it uses is found.
    pub source: Source,
}

/// The scenarios of a plan file, each with how it goes while the plan is as it is.
pub struct Bench<'a> {
    plan_file: String,
    suites: Vec<(Suite, Vec<Case>)>,
    toolboxes: &'a Toolboxes,
    files: &'a (dyn Files + Sync),
    robot: &'a dyn Loader,
    /// The names of scenarios that fail anyway.
    pub failing: Vec<String>,
}

/// A run of the plan as it is.
struct Case {
    name: String,
    setting: Setting,
    trace: u64,
    /// Whether nothing happens in it and nothing is expected: it only tells whether a mutant changes anything.
    quiet: bool,
}

/// What became of a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MutantStatus {
    /// It does not compile.
    Refused,
    /// These scenarios broke, or could not be run on it.
    Noticed(Vec<String>),
    /// No scenario broke.
    Missed {
        /// Whether the trace of a run differed.
        changed: bool,
    },
}

/// A mutant and what became of it.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The mutant.
    pub mutant: Mutant,
    /// What became of it.
    pub status: MutantStatus,
}

/// How many mutants there were of each status.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// A scenario noticed them.
    pub noticed: usize,
    /// No scenario noticed them, although they change a trace.
    pub missed: usize,
    /// They change no trace that was looked at.
    pub unchanged: usize,
    /// They do not compile.
    pub refused: usize,
}

impl Tally {
    /// The sum over mutants.
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

    /// The share of those that change a trace that are noticed, 0 to 1; 1 where there are none.
    pub fn share(&self) -> f64 {
        match self.noticed + self.missed {
            0 => 1.0,
            all => self.noticed as f64 / all as f64,
        }
    }
}

impl<'a> Bench<'a> {
    /// Runs the scenarios of these files that are for plans of `plan_file`, as the compiler names that file. `None`
    /// when `go_on` called it off.
    ///
    /// # Errors
    /// A scenario cannot be run: no world, a template without Rust.
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

    /// How many scenarios judge.
    pub fn judges(&self) -> usize {
        let cases = self.suites.iter().flat_map(|(_, cases)| cases);
        cases.filter(|case| !case.quiet).count()
    }

    /// What becomes of a mutant; `None` when `go_on` called it off.
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
                    // The mutant cannot do any more what it names.
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

    /// The scenarios for plans of the file, and for each of these plans a run in which nothing happens.
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
            let name = format!("{} as it goes", plan.name);
            let graph = scenario.graph.clone();
            all.push(Scenario::quiet(name, graph, &*self.plan_file, DEFAULT_UNTIL));
        }
        all
    }

    /// A suite, with another text of the plan.
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

/// What a run of a mutant came to.
struct Compared {
    broke: bool,
    changed: bool,
}

impl Compared {
    fn new(verdict: &Verdict, case: &Case) -> Compared {
        Compared { broke: !verdict.passed(), changed: verdict.trace != case.trace }
    }
}
