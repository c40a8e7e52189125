//! `Plan`: a text, its diagnostics, drawings and changes.

mod change;
mod compile;
mod diagnostic;

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_draw::{Options, Theme};
use afp_dsl::Compiled;
use afp_dsl::outline::PlanId;
use afp_dsl::toolbox::Toolbox as Declared;
use afp_ide::edit::{self, Change};
use afp_syntax::diagnostics::Severity;
use afp_syntax::source::{Source, Span};
use afp_test::Coverage;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use crate::errors::{error, plan_error, run_error};
use crate::scenario::{self, Scenario};
use crate::toolbox::Toolbox;

use crate::attach::in_background;
use compile::Workspace;
pub use diagnostic::{Diagnostic, diagnostics};

/// A plan: its text, diagnostics, drawings and changes.
#[pyclass(module = "afp", frozen, subclass)]
pub struct Plan {
    workspace: Mutex<Workspace>,
    toolboxes: Vec<Py<Toolbox>>,
}

#[pymethods]
impl Plan {
    #[new]
    #[pyo3(signature = (text, path=None, *, name=None, toolboxes=Vec::new()))]
    fn new(
        text: String,
        path: Option<PathBuf>,
        name: Option<String>,
        toolboxes: Vec<Py<Toolbox>>,
    ) -> PyResult<Self> {
        let workspace =
            Workspace::new(text, path, name, &toolboxes).map_err(|why| run_error(&why))?;
        Ok(Plan { workspace: Mutex::new(workspace), toolboxes })
    }

    /// The text.
    #[getter]
    fn text(&self) -> String {
        self.lock().text().to_owned()
    }

    /// The file that it was read from and is saved to.
    #[getter]
    fn path(&self) -> Option<PathBuf> {
        self.lock().path().cloned()
    }

    /// The name of the plan that runs.
    #[getter]
    fn name(&self, py: Python<'_>) -> PyResult<String> {
        let compiled = self.compiled(py)?;
        let graph = compiled.graph.as_ref().ok_or_else(|| plan_error(py, &compiled))?;
        Ok(graph.main().name.clone())
    }

    /// The toolboxes given with it.
    #[getter]
    fn toolboxes(&self, py: Python<'_>) -> Vec<Py<Toolbox>> {
        self.python_toolboxes(py)
    }

    /// All diagnostics, in source order.
    #[getter]
    fn diagnostics(&self, py: Python<'_>) -> PyResult<Vec<Diagnostic>> {
        Ok(diagnostics(&*self.compiled(py)?))
    }

    /// Whether there are no errors; warnings do not count.
    #[getter]
    fn ok(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.compiled(py)?.graph.is_some())
    }

    /// The scenarios of the file; empty if it has errors.
    #[getter]
    fn scenarios(&self, py: Python<'_>) -> PyResult<Vec<Scenario>> {
        let compiled = self.compiled(py)?;
        let source = self.state(py).into_py_any(py)?;
        let one = |index| Scenario {
            compiled: Arc::clone(&compiled),
            index,
            file: self.file(),
            toolboxes: self.python_toolboxes(py),
            caveat: self.caveat(),
            source: source.clone_ref(py),
        };
        Ok((0..compiled.scenarios.len()).map(one).collect())
    }

    /// Invalid scenarios of an otherwise valid file: name, line and error.
    fn _invalid(&self, py: Python<'_>) -> PyResult<Vec<(String, usize, String)>> {
        Ok(scenario::invalid(&*self.compiled(py)?))
    }

    /// Raise `PlanError` if the plan has errors.
    fn check(&self, py: Python<'_>) -> PyResult<()> {
        let compiled = self.compiled(py)?;
        match compiled.graph {
            Some(_) => Ok(()),
            None => Err(plan_error(py, &compiled)),
        }
    }

    /// The diagnostics as printed by `afpc check`.
    #[pyo3(signature = (*, color=false))]
    fn report(&self, py: Python<'_>, color: bool) -> PyResult<String> {
        Ok(self.compiled(py)?.render(color))
    }

    /// The text in canonical form; the plan does not change.
    fn formatted(&self, py: Python<'_>) -> PyResult<String> {
        let text = self.text();
        let compiled = self.compiled(py)?;
        afp_format::format(&text).map_err(|_| plan_error(py, &compiled))
    }

    /// Format the text.
    fn format(&self, py: Python<'_>) -> PyResult<()> {
        let text = self.formatted(py)?;
        self.lock().set_text(text);
        Ok(())
    }

    /// Write the text to its file, and texts of other changed files to theirs.
    #[pyo3(signature = (path=None))]
    fn save(&self, path: Option<PathBuf>) -> PyResult<()> {
        self.lock().save(path)
    }

    /// The drawing in the paper's notation as SVG, with errors marked.
    #[pyo3(signature = (*, theme="auto", fold=false, data=true))]
    fn svg(&self, py: Python<'_>, theme: &str, fold: bool, data: bool) -> PyResult<String> {
        let theme = match theme {
            "auto" => Theme::Auto,
            "light" => Theme::Light,
            "dark" => Theme::Dark,
            other => {
                let text = format!("no theme '{other}'; there are: auto, light, dark");
                return Err(PyValueError::new_err(text));
            }
        };
        let (compiled, icon) = (self.compiled(py)?, self.icons());
        in_background(py, move || {
            let options =
                Options { theme, sub_plans: !fold, data, icons: Some(&icon), ..Options::default() };
            afp_draw::svg(&compiled.outline, &options)
        })
    }

    /// The drawing with the coverage of a logged run, as SVG.
    fn _coverage(&self, py: Python<'_>, log: PathBuf) -> PyResult<String> {
        let compiled = self.checked(py)?;
        let read = in_background(py, move || afp_log::read(&log))?;
        let log = read.map_err(|why| crate::errors::log_error(&why))?;
        let graph = compiled.graph.as_ref().ok_or_else(|| plan_error(py, &compiled))?;
        let texts = compiled.plan_texts();
        let known = |text: &str| texts.iter().any(|(_, known)| known == text);
        // The numbers of a different plan may match by chance.
        let same = log.recipe().texts.iter().all(|text| known(&text.text));
        let used = Some(graph).filter(|_| same).and_then(|graph| Coverage::of_log(graph, &log));
        let used = used.ok_or_else(|| {
            error("the log is from another version of this plan; run the plan again")
        })?;
        let plans = (0..).map(PlanId).zip(&compiled.outline.plans);
        let main = graph.main().span;
        let own = plans.into_iter().find(|(_, plan)| plan.span.contains(main)).map(|(id, _)| id);
        let (outline, icon) = (Arc::clone(&compiled), self.icons());
        in_background(py, move || {
            let usage = Some(&used.usage);
            let options = Options { plan: own, usage, icons: Some(&icon), ..Options::default() };
            afp_draw::svg(&outline.outline, &options)
        })
    }

    /// The drawing for GraphViz.
    fn dot(&self, py: Python<'_>) -> PyResult<String> {
        let (compiled, icon) = (self.checked(py)?, self.icons());
        in_background(py, move || {
            afp_draw::dot(&compiled.outline, &Options { icons: Some(&icon), ..Options::default() })
        })
    }

    /// The checked graph as JSON.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let (compiled, icon) = (self.checked(py)?, self.icons());
        in_background(py, move || {
            afp_draw::json(&compiled.outline, &Options { icons: Some(&icon), ..Options::default() })
        })
    }

    /// The flow of action as State Chart XML.
    fn scxml(&self, py: Python<'_>) -> PyResult<String> {
        let compiled = self.compiled(py)?;
        let graph = compiled.graph.as_ref().ok_or_else(|| plan_error(py, &compiled))?;
        Ok(afp_draw::scxml(graph, Some(&compiled.sources), true))
    }

    /// The names of the plans in the file.
    #[getter]
    fn plans(&self) -> Vec<String> {
        change::plans(self.lock().text())
    }

    /// Make a change of meaning, given by kind and named parts; see the methods of `afp.Plan`. With
    /// `fits`, reject a change that writes an invalid value.
    #[pyo3(signature = (kind, parts, fits=false))]
    fn _change(
        &self,
        kind: &str,
        parts: &Bound<'_, pyo3::types::PyDict>,
        fits: bool,
    ) -> PyResult<()> {
        let change = change::read(kind, parts, self.lock().text())?;
        self.change(&change, fits)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> Option<String> {
        self.svg(py, "auto", false, true).ok()
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.toolboxes.iter().try_for_each(|toolbox| visit.call(toolbox))
    }

    /// Its parts: text, path, name of the plan that runs, toolboxes, texts of other changed files.
    fn _state(&self, py: Python<'_>) -> State {
        self.state(py)
    }

    /// Set texts of other files.
    fn _set_others(&self, others: BTreeMap<String, String>) {
        self.lock().set_others(others);
    }
}

/// The parts of a plan.
pub type State =
    (String, Option<PathBuf>, Option<String>, Vec<Py<Toolbox>>, BTreeMap<String, String>);

impl Plan {
    fn lock(&self) -> MutexGuard<'_, Workspace> {
        // A text is replaced as a whole, so a panic leaves no partial change.
        self.workspace.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Finds icons of templates in the project or among the built-in ones.
    fn icons(&self) -> impl Fn(&Declared, &str) -> Option<String> + Send + use<> {
        let own = self.lock().own();
        move |toolbox, name| match &own {
            Some(own) => own.icon(toolbox, name),
            None => afp_toolboxes::icon(name).map(str::to_owned),
        }
    }

    /// The compilation of the text, repeated only after a change of it or of a toolbox.
    ///
    /// # Errors
    /// As [`Workspace::compiled`].
    pub fn compiled(&self, py: Python<'_>) -> PyResult<Arc<Compiled>> {
        let compiled = py.detach(|| self.lock().compiled(&self.toolboxes));
        compiled.map_err(|why| run_error(&why))
    }

    /// Its parts for pickles and copies.
    pub fn state(&self, py: Python<'_>) -> State {
        let workspace = self.lock();
        let (text, path) = (workspace.text().to_owned(), workspace.path().cloned());
        (
            text,
            path,
            workspace.name().cloned(),
            self.python_toolboxes(py),
            workspace.others().clone(),
        )
    }

    /// The toolboxes given with it.
    pub fn python_toolboxes(&self, py: Python<'_>) -> Vec<Py<Toolbox>> {
        self.toolboxes.iter().map(|toolbox| toolbox.clone_ref(py)).collect()
    }

    /// The reason why 'afpc run' with the plan's file behaves differently; `None` if it does not.
    pub fn caveat(&self) -> Option<&'static str> {
        if !self.toolboxes.is_empty() {
            return Some("the plan has components in Python: run it in Python");
        }
        let workspace = self.lock();
        let Some(path) = workspace.path() else { return Some("the plan has no file") };
        let same = std::fs::read_to_string(path).is_ok_and(|text| text == workspace.text());
        let others = workspace.others();
        (!same || !others.is_empty()).then_some("the plan has unsaved changes")
    }

    /// The plan's file, for logs and for the world next to it.
    pub fn file(&self) -> PathBuf {
        self.lock().file()
    }

    /// The compilation.
    ///
    /// # Errors
    /// The plan has errors.
    fn checked(&self, py: Python<'_>) -> PyResult<Arc<Compiled>> {
        let compiled = self.compiled(py)?;
        match compiled.graph {
            Some(_) => Ok(compiled),
            None => Err(plan_error(py, &compiled)),
        }
    }

    fn compiled_in(&self, workspace: &mut Workspace) -> PyResult<Arc<Compiled>> {
        workspace.compiled(&self.toolboxes).map_err(|why| run_error(&why))
    }

    fn change(&self, change: &Change, fits: bool) -> PyResult<()> {
        let mut workspace = self.lock();
        let before = (workspace.text().to_owned(), workspace.others().clone());
        let files: Vec<Source> =
            self.compiled_in(&mut workspace)?.plan_sources().cloned().collect();
        let edits = edit::edit(&files, workspace.known(), 0, change).map_err(error)?;
        let mut written = Vec::new();
        for (number, source) in (0..=u16::MAX).zip(&files) {
            let own: Vec<_> =
                edits.iter().filter(|edit| edit.span.file == number).cloned().collect();
            if !own.is_empty() {
                workspace.replace(&source.name, edit::apply(&source.text, &own));
                written.push((&source.name, change::written(&own)));
            }
        }
        if !fits {
            return Ok(());
        }
        let compiled = self.compiled_in(&mut workspace)?;
        let mut errors = compiled.diags.iter().filter(|it| it.severity == Severity::Error);
        let is_new = |span: Span| {
            let name = compiled.sources.get(span.file).map(|source| &source.name);
            let mut own = written.iter().filter(|(file, _)| Some(*file) == name);
            own.any(|(_, news)| news.iter().any(|new| change::meet(*new, span)))
        };
        match errors.find(|error| is_new(error.span)) {
            None => Ok(()),
            Some(wrong) => {
                workspace.set_text(before.0);
                workspace.set_others(before.1);
                Err(change::misfit(wrong))
            }
        }
    }
}
