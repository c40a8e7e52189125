//! The entry point of the compiler: from the text of a plan to its graph, or to all its errors.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::check::partial::Partial;
use crate::check::{self, Checked, Flow};
use crate::files::{Files, below_all, normalised};
use crate::gather::{self, PlanFile, Toolboxes};
use crate::graph::Graph;
use crate::index::Index;
use crate::outline::Outline;
use crate::scenario::{InvalidScenario, Scenario};
use crate::timing::{self, Timing};
use afp_syntax::diagnostics::{Diagnostics, Severity};
use afp_syntax::source::{Source, Sources};
use afp_syntax::{Parse, unquote};

/// The result of a compilation.
#[derive(Clone, Debug, Default)]
pub struct Compiled {
    /// The static graph; `None` if and only if there are errors.
    pub graph: Option<Graph>,
    /// The runnable scenarios of the file; empty if anything but scenarios has errors.
    pub scenarios: Vec<Scenario>,
    /// The scenarios with errors; also empty if anything else has errors.
    pub invalid: Vec<InvalidScenario>,
    /// The content of the plan files, with or without errors.
    pub outline: Outline,
    /// The meaning of every name, with or without errors.
    pub index: Index,
    /// All diagnostics, ordered by place.
    pub diags: Diagnostics,
    /// The files of spans: first the toolboxes, then the plan files.
    pub sources: Sources,
    /// The range of the plan files in [`Compiled::sources`]: first the compiled file, then the
    /// files that it uses, directly or indirectly.
    pub plan_files: Range<usize>,
    /// The tree of each plan file.
    trees: Vec<Parse>,
    /// The further paths of each plan file.
    further: Vec<Vec<String>>,
    /// The absolute path of the base folder of all paths, if they lead out of it and it is known.
    folder: Option<String>,
    /// The known parts of the plan if there are errors.
    partial: Option<Partial>,
}

impl Compiled {
    /// The rendered diagnostics, see [`Diagnostics::render`].
    pub fn render(&self, colour: bool) -> String {
        self.diags.render(&self.sources, colour)
    }

    /// The plan files: first the compiled file, then the files that it uses, directly or
    /// indirectly.
    pub fn plan_sources(&self) -> impl Iterator<Item = &Source> {
        self.sources.iter().skip(self.plan_files.start).take(self.plan_files.len())
    }

    /// The known timing of the plan and of all its sub-plans, with declared budgets.
    ///
    /// In a plan with errors only valid parts count; invalid parts take no time. `None` without a
    /// plan.
    pub fn timing(&self) -> Option<Timing> {
        if let Some(graph) = &self.graph {
            return Some(timing::timing(graph, None));
        }
        let Partial { graph, wrong } = self.partial.as_ref()?;
        let mut timing = timing::timing(graph, None);
        timing.supervisors.retain(|row| !wrong.contains(&row.span));
        Some(timing)
    }

    /// The syntax tree of a plan file; `None` for other files.
    pub fn tree(&self, file: u16) -> Option<&Parse> {
        self.trees.get(usize::from(file).checked_sub(self.plan_files.start)?)
    }

    /// Path and text of each plan file, in the order of [`Compiled::plan_sources`]. Paths are
    /// relative to the deepest common folder, so that the files find each other in another place.
    /// Files with several paths follow once more under each further path.
    pub fn plan_texts(&self) -> Vec<(String, String)> {
        self.texts_of((0..self.plan_files.len()).collect())
    }

    /// Path and text of the plan files of a scenario, its own file first.
    pub fn scenario_texts(&self, scenario: &Scenario) -> Vec<(String, String)> {
        let names: Vec<_> = self.plan_sources().map(|source| source.name.as_str()).collect();
        let is_first = |place: &usize| names[*place] == scenario.plan_file;
        let mut places: Vec<_> = (0..names.len()).collect();
        // A file of scenarios is not used by its plans.
        if !places.first().is_some_and(is_first) && places.iter().any(is_first) {
            places.remove(0);
        }
        places.sort_by_key(|place| !is_first(place));
        self.texts_of(places)
    }

    /// Path and text of some plan files, then again of each file with further paths.
    fn texts_of(&self, places: Vec<usize>) -> Vec<(String, String)> {
        let sources: Vec<&Source> = self.plan_sources().collect();
        let first = places.iter().map(|place| (normalised(&sources[*place].name), *place));
        let further = places.iter().flat_map(|place| {
            let paths = self.further.get(*place).into_iter().flatten();
            paths.map(|path| (path.clone(), *place))
        });
        let (paths, places): (Vec<String>, Vec<usize>) = first.chain(further).unzip();
        let paths = below_all(&paths, self.folder.as_deref()).into_iter();
        let mut known = BTreeSet::new();
        let texts = paths.zip(places).filter(|(path, _)| known.insert(path.clone()));
        texts.map(|(path, place)| (path, sources[place].text.clone())).collect()
    }

    /// Name and text of each toolbox that a plan of these files, or of the files that they use,
    /// names.
    pub fn toolbox_texts<'a>(
        &'a self,
        graph: &'a Graph,
    ) -> impl Iterator<Item = (&'a str, &'a str)> {
        graph.toolboxes.iter().filter(|toolbox| toolbox.is_named()).filter_map(|toolbox| {
            let source = self.sources.get(toolbox.span.file)?;
            Some((toolbox.name.as_str(), source.text.as_str()))
        })
    }
}

/// Compiles the first plan of a file. `files` reads the files that it uses; `&Texts::default()` has
/// none.
///
/// All errors are reported, also those of unused plans, other files and toolboxes.
pub fn compile(source: &Source, toolboxes: &Toolboxes, files: &dyn Files) -> Compiled {
    compile_plan(source, toolboxes, files, None)
}

/// Compiles the plan of that name in a file; without a name, the first one.
pub fn compile_plan(
    source: &Source,
    toolboxes: &Toolboxes,
    files: &dyn Files,
    plan: Option<&str>,
) -> Compiled {
    compile_with(source, toolboxes, files, plan, Flow::Checked)
}

/// Compiles the first plan of a file without the flow checks, for tests of the run time with plans
/// that these checks refuse.
#[doc(hidden)]
pub fn compile_unchecked(source: &Source, toolboxes: &Toolboxes, files: &dyn Files) -> Compiled {
    compile_with(source, toolboxes, files, None, Flow::Unchecked)
}

/// The meanings of the names in plan files. After [`Toolboxes::sources`], [`Span::file`] is the
/// index of a file among them.
///
/// [`Span::file`]: afp_syntax::source::Span::file
pub fn index_files(files: &[Source], toolboxes: &Toolboxes) -> Index {
    let mut sources = toolboxes.sources().clone();
    let mut diags = Diagnostics::default();
    let gathered = gather::gather_all(files, toolboxes, &mut sources, &mut diags);
    check::check(&gathered, toolboxes, None, Flow::Unchecked, &mut diags).index
}

fn compile_with(
    source: &Source,
    toolboxes: &Toolboxes,
    files: &dyn Files,
    plan: Option<&str>,
    flow: Flow,
) -> Compiled {
    let mut diags = toolboxes.diagnostics().clone();
    let mut sources = toolboxes.sources().clone();
    let first = sources.len();
    let gathered = gather::gather(source, files, toolboxes, &mut sources, &mut diags);
    let Checked { graph, partial, scenarios, mut outline, index } =
        check::check(&gathered, toolboxes, plan, flow, &mut diags);
    if let Some(graph) = graph.as_ref().filter(|_| flow == Flow::Checked) {
        timing::check_everywhere(graph, &mut diags);
    }
    diags.sort();
    outline.attach(&diags);
    let plan_files = first..sources.len();
    let (scenarios, invalid) = match graph.is_some() && outline.excuses(&diags) {
        true => sorted_out(scenarios, &outline, &diags),
        false => (Vec::new(), Vec::new()),
    };
    let (graph, partial) = match diags.has_errors() {
        false => (graph, None),
        true => (None, partial.or(graph.map(|graph| Partial { graph, wrong: Vec::new() }))),
    };
    let folder = gathered.iter().any(PlanFile::leads_out).then(|| files.folder()).flatten();
    let (trees, further) = gathered.into_iter().map(|file| (file.parse, file.further)).unzip();
    Compiled {
        graph,
        scenarios,
        invalid,
        outline,
        index,
        diags,
        sources,
        plan_files,
        trees,
        further,
        folder,
        partial,
    }
}

/// The scenarios of the first file: the valid ones, and those with errors.
fn sorted_out(
    mut scenarios: Vec<Scenario>,
    outline: &Outline,
    diags: &Diagnostics,
) -> (Vec<Scenario>, Vec<InvalidScenario>) {
    let heads = outline.files.first().map_or(&[][..], |file| &file.scenarios);
    let wrong: Vec<_> = heads.iter().filter(|head| diags.error_within(head.span)).collect();
    scenarios.retain(|scenario| {
        let next = wrong.partition_point(|head| head.span.start <= scenario.span.start);
        let head = next.checked_sub(1).and_then(|at| wrong.get(at));
        head.is_none_or(|head| !head.span.contains(scenario.span))
    });
    let mut invalid = Vec::new();
    for head in wrong {
        let mut errors = Diagnostics::default();
        let inside = diags.within(head.span).filter(|each| each.severity == Severity::Error);
        inside.for_each(|each| errors.push(each.clone()));
        let name = head.name.as_ref();
        invalid.push(InvalidScenario {
            name: name.map_or(String::new(), |name| unquote(name, &mut Diagnostics::default())),
            span: name.map_or(head.span, |name| name.span),
            plan: head
                .plan
                .and_then(|plan| outline.plan(plan).name.as_ref())
                .map_or(String::new(), |name| name.text.clone()),
            errors,
        });
    }
    (scenarios, invalid)
}
