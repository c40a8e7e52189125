//! `Toolbox`: a toolbox file with templates implemented in Python.

use std::mem;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_dsl::Toolboxes;
use afp_dsl::toolbox::{Template, TemplateKind, Toolbox as Declared};
use afp_excerpt::words::nearest;
use afp_syntax::source::Source;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyTraverseError, PyVisit};

use crate::errors::error;
use crate::link::devices;

/// A toolbox file and the Python classes that implement its templates.
#[pyclass(module = "afp", frozen, subclass)]
pub struct Toolbox {
    inner: Mutex<Inner>,
}

struct Inner {
    file: String,
    /// The original text of the toolbox.
    text: String,
    /// Templates declared later, by name.
    declared: Vec<(String, String)>,
    makers: Vec<(String, Py<PyAny>)>,
    /// The number of changes of its text.
    revision: u64,
}

/// A snapshot of a toolbox: its text, its declarations, and its implementations by template.
pub struct Ready {
    pub text: String,
    pub declared: Arc<Declared>,
    pub makers: Vec<(String, Py<PyAny>)>,
}

#[pymethods]
impl Toolbox {
    #[new]
    #[pyo3(signature = (text, path=None))]
    fn new(text: String, path: Option<PathBuf>) -> PyResult<Self> {
        let file = path.map_or("toolbox".to_owned(), |path| path.display().to_string());
        parse(&file, &text)?;
        let inner = Inner { file, text, declared: Vec::new(), makers: Vec::new(), revision: 0 };
        Ok(Toolbox { inner: Mutex::new(inner) })
    }

    /// The text of the toolbox file.
    #[getter]
    fn text(&self) -> String {
        self.lock().whole()
    }

    /// The name after `use`.
    #[getter]
    fn name(&self) -> PyResult<String> {
        Ok(self.declared()?.name.clone())
    }

    /// The names of the templates.
    #[getter]
    fn templates(&self) -> PyResult<Vec<String>> {
        Ok(self.declared()?.templates.iter().map(|template| template.name.clone()).collect())
    }

    /// The names of the implemented templates.
    #[getter]
    fn implemented(&self) -> Vec<String> {
        self.lock().makers.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Add the text of a template. It replaces an earlier declaration, for example if you run a
    /// notebook cell again.
    fn _declare(&self, name: &str, text: String) -> PyResult<()> {
        let mut inner = self.lock();
        let mut declared = inner.declared.clone();
        match declared.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known = text,
            None => declared.push((name.to_owned(), text)),
        }
        let toolbox = parse(&inner.file, &whole(&inner.text, &declared))?;
        let template = toolbox.templates.iter().find(|template| template.name == name);
        template.map_or(Ok(()), |template| known_devices(template, &toolbox))?;
        if inner.declared != declared {
            inner.declared = declared;
            inner.revision += 1;
        }
        Ok(())
    }

    /// Set the implementation of a template; a later one replaces an earlier one.
    fn _implement(&self, template: String, maker: Py<PyAny>) -> PyResult<()> {
        let declared = self.declared()?;
        let found = declared.templates.iter().find(|known| known.name == template);
        if found.is_some_and(Template::is_declared) {
            let text =
                format!("the states of '{template}' have bodies, so Python cannot implement it");
            return Err(PyValueError::new_err(text));
        }
        if found.is_none() {
            let known: Vec<_> = declared.templates.iter().map(|known| &*known.name).collect();
            let text = format!(
                "the toolbox '{}' has no template '{template}'; there are: {}",
                declared.name,
                known.join(", ")
            );
            return Err(PyValueError::new_err(text));
        }
        let mut inner = self.lock();
        let earlier = inner.makers.iter().position(|(name, _)| *name == template);
        let earlier = earlier.map(|place| inner.makers.remove(place));
        inner.makers.push((template, maker));
        drop(inner);
        // As below, after the lock is released.
        drop(earlier);
        Ok(())
    }

    /// The declaration of a template: kind, inputs (with `live`), outputs, outcomes.
    fn _template<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
        let declared = self.declared()?;
        let template = declared.templates.iter().find(|template| template.name == name);
        let template = template
            .ok_or_else(|| PyValueError::new_err(format!("no template '{name}' in the toolbox")))?;
        describe(py, template)
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        // No thread waits for the interpreter while holding this lock, and changes need the
        // interpreter.
        self.lock().makers.iter().try_for_each(|(_, maker)| visit.call(maker))
    }

    fn __clear__(&self) {
        let makers = mem::take(&mut self.lock().makers);
        // A destructor may call back here.
        drop(makers);
    }
}

impl Toolbox {
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Its text for the compiler.
    pub fn source(&self) -> Source {
        let inner = self.lock();
        Source::new(&*inner.file, inner.whole())
    }

    /// Its declarations.
    pub fn declared(&self) -> PyResult<Arc<Declared>> {
        let inner = self.lock();
        parse(&inner.file, &inner.whole())
    }

    /// The number of changes of its text, for example by a repeated notebook cell.
    pub fn revision(&self) -> u64 {
        self.lock().revision
    }

    /// A snapshot of the toolbox.
    ///
    /// # Errors
    /// Its text is invalid.
    pub fn ready(&self, py: Python<'_>) -> PyResult<Ready> {
        let inner = self.lock();
        let source = Source::new(&*inner.file, inner.whole());
        let text = source.text.clone();
        let declared = read(source)?;
        let makers = inner.makers.iter();
        let makers = makers.map(|(name, maker)| (name.clone(), maker.clone_ref(py))).collect();
        Ok(Ready { text, declared, makers })
    }
}

impl Inner {
    /// The text of the toolbox file.
    fn whole(&self) -> String {
        whole(&self.text, &self.declared)
    }
}

fn whole(text: &str, declared: &[(String, String)]) -> String {
    let mut whole = text.to_owned();
    for (_, template) in declared {
        whole.push('\n');
        whole.push_str(template);
    }
    whole
}

fn parse(file: &str, text: &str) -> PyResult<Arc<Declared>> {
    read(Source::new(file, text))
}

fn read(source: Source) -> PyResult<Arc<Declared>> {
    let mut set = Toolboxes::default();
    set.add(source, "python");
    if set.diagnostics().has_errors() {
        return Err(error(set.diagnostics().render(set.sources(), false).trim_end()));
    }
    let toolbox = set.iter().next().cloned();
    toolbox.ok_or_else(|| PyValueError::new_err("the text declares no toolbox"))
}

/// Rejects a device that is almost a device of the robot. A toolbox in Python has no devices of its
/// own, so that the compiler cannot find the error.
fn known_devices(template: &Template, toolbox: &Declared) -> PyResult<()> {
    for used in &template.uses {
        let names = || devices().iter().map(|device| device.name);
        if names().any(|name| name == used) || toolbox.devices.iter().any(|it| it.name == *used) {
            continue;
        }
        if let Some(meant) = nearest(used, names()) {
            let text = format!("the robot has no device '{used}'; did you mean '{meant}'?");
            return Err(PyValueError::new_err(text));
        }
    }
    Ok(())
}

fn describe<'py>(py: Python<'py>, template: &Template) -> PyResult<Bound<'py, PyDict>> {
    let about = PyDict::new(py);
    let kind = match template.kind {
        TemplateKind::Actor => "actor",
        TemplateKind::Supervisor => "supervisor",
        TemplateKind::Computation => "computation",
    };
    about.set_item("kind", kind)?;
    let names = |live: bool| -> Vec<&str> {
        let ports = template.inputs.iter().filter(|port| port.live == live);
        ports.map(|port| port.name.as_str()).collect()
    };
    about.set_item("resumable", template.resumable)?;
    about.set_item("inputs", names(false))?;
    about.set_item("live", names(true))?;
    let outputs: Vec<_> = template.outputs.iter().map(|port| port.name.as_str()).collect();
    about.set_item("outputs", outputs)?;
    let outcomes: Vec<_> = template.outcomes.iter().map(|each| each.name.as_str()).collect();
    about.set_item("outcomes", outcomes)?;
    Ok(about)
}
