//! `Diagnostic`: one message of the compiler.

use afp_dsl::Compiled;
use afp_syntax::diagnostics::Severity;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// One message of the compiler, as printed by `afpc check`.
#[pyclass(module = "afp", frozen, get_all, eq, hash)]
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Diagnostic {
    /// Its code: `E0203`.
    code: String,
    /// `error`, `warning` or `note`.
    severity: &'static str,
    /// The error.
    message: String,
    /// A suggestion, or an empty string.
    help: String,
    /// The file as named by the caller.
    file: String,
    /// The line, from 1.
    line: usize,
    /// The column, from 1.
    column: usize,
    /// The replacement that fixes the error, if there is one.
    fix: Option<String>,
}

#[pymethods]
impl Diagnostic {
    fn __str__(&self) -> String {
        let Diagnostic { code, severity, message, file, line, column, .. } = self;
        format!("{file}:{line}:{column}: {severity}[{code}]: {message}")
    }

    fn __repr__(&self) -> String {
        format!("<Diagnostic {self}>", self = self.__str__())
    }

    /// Restore from a pickle.
    #[staticmethod]
    fn _again(facts: Facts, place: Place) -> PyResult<Self> {
        let (code, severity, message, help, fix) = facts;
        let (file, line, column) = place;
        let known = [Severity::Error, Severity::Warning, Severity::Note].map(Severity::as_str);
        let severity = known.into_iter().find(|known| *known == severity);
        let severity = severity.ok_or_else(|| PyValueError::new_err("no such severity"))?;
        Ok(Diagnostic { code, severity, message, help, file, line, column, fix })
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, (Facts, Place))> {
        let again = py.get_type::<Diagnostic>().getattr("_again")?.unbind();
        let Diagnostic { code, severity, message, help, file, line, column, fix } = self.clone();
        Ok((again, ((code, severity.to_owned(), message, help, fix), (file, line, column))))
    }
}

/// Code, severity, message, help and fix.
type Facts = (String, String, String, String, Option<String>);

/// File, line and column.
type Place = (String, usize, usize);

pub fn diagnostics(compiled: &Compiled) -> Vec<Diagnostic> {
    let one = |each: &afp_syntax::diagnostics::Diagnostic| {
        let source = compiled.sources.get(each.span.file);
        let (line, column) = source.map_or((1, 1), |source| source.line_column(each.span.start));
        Diagnostic {
            code: each.code.as_str().to_owned(),
            severity: each.severity.as_str(),
            message: each.message_text(),
            help: each.help_text(),
            file: source.map_or(String::new(), |source| source.name.clone()),
            line,
            column,
            fix: each.fix.as_ref().map(|fix| fix.text.clone()),
        }
    };
    compiled.diags.iter().map(one).collect()
}
