//! `Scenario`: a test of a plan, run by the engine of `afpc test`.

mod verdict;

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

use afp_dsl::Compiled;
use afp_dsl::scenario::{InvalidScenario, Scenario as Checked};
use afp_excerpt::words::{shell_file, shell_word};
use afp_run::check_apart;
use afp_syntax::source::Span;
use afp_test::{Recording, Setting};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use crate::component::{AnyRegistry, Components, interruption, may_run};
use crate::errors::{error, run_error};
use crate::leave::Call;
use crate::link::{fits, link};
use crate::pause::{Halt, Pause};
use crate::simulation::read_of;
use crate::toolbox::Toolbox;
use crate::value::Pickled;

use verdict::verdict;
pub use verdict::{Broken, Verdict};

/// A scenario of a file: a world, actions and expectations.
#[pyclass(module = "afp", frozen)]
pub struct Scenario {
    pub compiled: Arc<Compiled>,
    pub index: usize,
    pub file: PathBuf,
    pub toolboxes: Vec<Py<Toolbox>>,
    /// The reason why `afpc test` would behave differently.
    pub caveat: Option<&'static str>,
    /// The pickled plan, with the text of this scenario.
    pub source: Py<PyAny>,
}

#[pymethods]
impl Scenario {
    /// The name.
    #[getter]
    fn name(&self) -> PyResult<&str> {
        Ok(&self.checked()?.name)
    }

    /// The name of its plan.
    #[getter]
    fn plan(&self) -> PyResult<&str> {
        Ok(&self.checked()?.graph.main().name)
    }

    /// Its file.
    #[getter]
    fn path(&self) -> PathBuf {
        self.file.clone()
    }

    /// The line of its name, from 1.
    #[getter]
    fn line(&self) -> PyResult<usize> {
        Ok(place(&self.compiled, self.checked()?.span).1)
    }

    /// The seed of all noise.
    #[getter]
    fn seed(&self) -> PyResult<u64> {
        Ok(self.checked()?.seed)
    }

    /// Its time limit, in seconds.
    #[getter]
    fn until(&self) -> PyResult<f64> {
        Ok(self.checked()?.until as f64 / 1e9)
    }

    /// Run it; with `log`, record it there. Ctrl-C interrupts it.
    #[pyo3(signature = (*, log=None))]
    fn run(&self, py: Python<'_>, log: Option<PathBuf>) -> PyResult<Verdict> {
        may_run()?;
        let checked = self.checked()?;
        fits(&self.file)?;
        let setting = Setting::find(checked, &self.file, link().kind());
        let setting = setting.map_err(|why| run_error(&why))?;
        if let Some(log) = &log {
            let read =
                read_of(&self.compiled).chain([&*self.file]).chain(setting.world.path.as_deref());
            check_apart([&**log], read).map_err(|why| run_error(&why))?;
        }
        let components = Arc::new(Components::new(py, &self.toolboxes, &self.compiled)?);
        let more = |registry: &mut dyn AnyRegistry| components.register(registry);
        let robot = link().loader(&more);
        let stop = Arc::default();
        let call = Call::new(py, &stop, interruption(&components));
        let (mut pause, mut halt) = (Pause::new(None, stop), None);
        let mut go_on = || {
            halt = pause.look();
            halt.is_none() && !components.is_over()
        };
        let log = log.as_deref().map(|path| Recording { path, compiled: &self.compiled });
        let run = || afp_test::run_while(checked, &setting, &*robot, log, &mut go_on);
        let came = py.detach(|| call.run(run));
        components.raised(py)?;
        if let Some(Halt::Raised(why)) = halt {
            return Err(why);
        }
        let came = came.map_err(|why| run_error(&why))?;
        let came = came.ok_or_else(|| error("the scenario was cancelled"))?;
        Ok(verdict(&self.compiled, came, self.command()?))
    }

    /// Whether it is the same scenario of the same text.
    fn __eq__(&self, py: Python<'_>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        let Ok(other) = other.cast::<Scenario>() else { return Ok(false) };
        let other = other.get();
        Ok(self.index == other.index && self.source.bind(py).eq(&other.source)?)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (&self.file, self.index).hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("<Scenario '{}' for {}>", self.name()?, self.plan()?))
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        visit.call(&self.source)?;
        self.toolboxes.iter().try_for_each(|toolbox| visit.call(toolbox))
    }

    /// Pickled as its plan, and its index among the plan's scenarios.
    fn __reduce__<'py>(&self, py: Python<'py>) -> Pickled<'py, (Py<PyAny>, usize)> {
        let again = py.import("afp.plan")?.getattr("_scenario")?;
        Ok((again, (self.source.clone_ref(py), self.index)))
    }
}

impl Scenario {
    fn checked(&self) -> PyResult<&Checked> {
        let found = self.compiled.scenarios.get(self.index);
        found.ok_or_else(|| PyIndexError::new_err("there is no such scenario"))
    }

    /// The command that repeats it, with differences in a comment.
    fn command(&self) -> PyResult<String> {
        let file = shell_file(&self.file.display().to_string());
        let command = format!("afpc test {file} {}", shell_word(&self.checked()?.name));
        Ok(self.caveat.map_or_else(|| command.clone(), |why| format!("{command}  # {why}")))
    }
}

/// Invalid scenarios: name, line and error.
pub fn invalid(compiled: &Compiled) -> Vec<(String, usize, String)> {
    let one = |each: &InvalidScenario| {
        let said = each.errors.render(&compiled.sources, false);
        (each.name.clone(), place(compiled, each.span).1, said.trim_end().to_owned())
    };
    compiled.invalid.iter().map(one).collect()
}

fn place(compiled: &Compiled, span: Span) -> (String, usize, usize) {
    let source = compiled.sources.get(span.file);
    let (line, column) = source.map_or((1, 1), |source| source.line_column(span.start));
    (source.map_or(String::new(), |source| source.name.clone()), line, column)
}
