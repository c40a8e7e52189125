//! Values between plans and Python: quantities are floats in SI units.

use std::borrow::Cow;

use afp_core::trace::{EntryName, Names, TraceEntryId};
use afp_core::{EntryId, Fault, MAX_TEXT, Text, Value, ValueRef};
use afp_dsl::types::Type;
use afp_session::AnySession;
use afp_syntax::diagnostics::words::a;
use afp_syntax::units::Unit;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyException, PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt, PyString};

/// The most characters shown of a value.
const SHOWN: usize = 80;

/// The result of '__reduce__': a constructor and its arguments.
pub type Pickled<'py, A> = PyResult<(Bound<'py, PyAny>, A)>;

/// The exception for an object that cannot be pickled, with an alternative.
pub fn no_pickle(what: &str, instead: &str) -> PyErr {
    PyTypeError::new_err(format!("a {what} cannot be pickled; {instead}"))
}

/// Converts an entry's value to Python: enums by name, unset as `None`.
pub fn to_python<'py>(
    py: Python<'py>,
    value: ValueRef<'_>,
    choice: impl FnOnce(u16) -> String,
) -> PyResult<Bound<'py, PyAny>> {
    match value {
        ValueRef::Unset => Ok(py.None().into_bound(py)),
        ValueRef::Bool(value) => value.into_bound_py_any(py),
        ValueRef::Int(value) => value.into_bound_py_any(py),
        ValueRef::Float(value) => value.into_bound_py_any(py),
        ValueRef::Text(value) => value.into_bound_py_any(py),
        ValueRef::Choice(value) => choice(value).into_bound_py_any(py),
        ValueRef::Object(number) => format!("object#{number}").into_bound_py_any(py),
    }
}

/// The unit of a value (`afp.cm(30)` has `m`), `None` for plain numbers.
fn unit(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    match value.is_exact_instance_of::<PyFloat>() || value.is_exact_instance_of::<PyInt>() {
        true => Ok(None),
        false => value.getattr_opt("unit")?.map(|unit| unit.extract()).transpose(),
    }
}

/// A value from Python for an entry, before the entry is known.
pub enum Given {
    /// A string, parsed as by `--set` unless the entry is a string.
    Text(String),
    /// A number or boolean, possibly with a unit.
    Plain(Value, Option<String>),
    /// A value of another type.
    Other(String),
}

impl Given {
    /// Reads a value.
    ///
    /// # Errors
    /// The value's exception, or an integer of more than 64 bits.
    pub fn new(value: &Bound<'_, PyAny>) -> PyResult<Given> {
        if let Some(truth) = truth(value) {
            return Ok(Given::Plain(Value::Bool(truth), None));
        }
        if let Ok(string) = value.cast::<PyString>() {
            return Ok(Given::Text(text(string)?));
        }
        let unit = unit(value)?;
        if is_integer(value)? {
            return Ok(Given::Plain(Value::Int(integer(value)?), unit));
        }
        match number(value)? {
            Some(number) => Ok(Given::Plain(Value::Float(number), unit)),
            None => Ok(Given::Other(a(&value.get_type().name()?.to_string()))),
        }
    }

    /// Converts the value for an entry of a session's plan.
    ///
    /// # Errors
    /// It does not fit.
    pub fn for_entry(self, session: &dyn AnySession, entry: EntryId) -> PyResult<Value> {
        let id = TraceEntryId::from(entry);
        let about = session.names().entry(id);
        let wrong = |what: String| unfit(about, &what);
        match self {
            Given::Text(text) => session.read_text(entry, &text).map_err(|why| {
                if why == Fault::TOO_LONG {
                    PyValueError::new_err(format!("'{}': {}", about.path, too_long(&text)))
                } else {
                    let help = of_text(session.names(), id, &text);
                    unfit(about, &(short(format!("{text:?}")) + &help))
                }
            }),
            Given::Plain(_, Some(unit)) if unit != about.unit => {
                Err(wrong(format!("a quantity in {unit}")))
            }
            Given::Plain(Value::Float(number), _) if !number.is_finite() => {
                let text = format!("'{}' is {number}; give a finite number", about.path);
                Err(PyValueError::new_err(text.replace("NaN", "nan")))
            }
            Given::Plain(value, _) => {
                let is_number = about.ty == "float" || !about.unit.is_empty();
                let (fits, what) = match value {
                    Value::Bool(_) => (about.ty == "bool", "a bool".to_owned()),
                    Value::Int(number) => (about.ty == "int" || is_number, number.to_string()),
                    Value::Float(number) => (is_number, format!("{number:?}")),
                    _ => return Ok(value),
                };
                if fits { Ok(value) } else { Err(wrong(what)) }
            }
            Given::Other(name) => Err(wrong(name + &such(about.unit))),
        }
    }
}

/// The error for a value that does not fit an entry.
pub fn unfit(about: EntryName<'_>, what: &str) -> PyErr {
    let (path, ty, unit) = (about.path, about.ty, about.unit);
    let link = if unit.is_empty() { "" } else { " in " };
    PyTypeError::new_err(format!("'{path}' is {}{link}{unit}, not {what}", a(ty)))
}

/// The help for a string that an entry cannot take.
fn of_text(names: &dyn Names, id: TraceEntryId, text: &str) -> String {
    let choices = (0..u16::MAX).map(|value| names.choice(id, value));
    let choices: Vec<_> = choices.take_while(|choice| !choice.is_empty()).collect();
    let unit = names.entry(id).unit;
    match unit {
        _ if !choices.is_empty() => format!("; there are: {}", choices.join(", ")),
        "" => String::new(),
        _ if text.trim().parse::<f64>().is_ok() => {
            let handy = match unit {
                "m" => "cm",
                "rad" => "deg",
                "rad/s" => "deg/s",
                unit => unit,
            };
            format!("; write its unit, as in \"{} {handy}\"", text.trim())
        }
        unit => such(unit),
    }
}

/// The example of a quantity in a unit.
fn such(unit: &str) -> String {
    match unit {
        "" => String::new(),
        "m" => "; give one such as afp.cm(30)".to_owned(),
        "rad" => "; give one such as afp.deg(90)".to_owned(),
        "s" => "; give one such as afp.s(3)".to_owned(),
        "m/s" => "; give one such as afp.m_per_s(0.2)".to_owned(),
        "rad/s" => "; give one such as afp.deg_per_s(30)".to_owned(),
        unit => format!("; give a plain number, which is in {unit}"),
    }
}

/// The SI value of a string with a unit of that kind: `30 cm` is 0.3 in metres.
#[pyfunction]
pub fn number_of(text: &str, unit: &str) -> Option<f64> {
    let of_kind = |name| {
        let known = Unit::parse(name).filter(|known| known.dimension.si_unit() == unit)?;
        Some(afp_types::Unit { name, scale: known.scale() })
    };
    match unit {
        "" => afp_types::parse_float(text).ok(),
        _ => afp_types::parse_quantity(text, Unit::symbols().filter_map(of_kind)).ok(),
    }
}

/// Reads a seed, with the package's common error.
///
/// # Errors
/// It is not a seed.
pub fn seed_of(seed: &Bound<'_, PyAny>) -> PyResult<u64> {
    seed.py().import("afp.seeds")?.call_method1("seed_of", (seed,))?.extract()
}

/// A boolean of Python or numpy.
fn truth(value: &Bound<'_, PyAny>) -> Option<bool> {
    value.extract().ok()
}

/// Whether a value is an integer, of Python or numpy.
fn is_integer(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    // Arrays have the method, but only those of one integer support it.
    let is_index = value.hasattr("__index__")?;
    let is_array = is_index && value.hasattr("__array_interface__")?;
    let is_none = is_array && value.call_method0("__index__").is_err();
    Ok(value.is_instance_of::<PyInt>() || is_index && !is_none)
}

fn integer(value: &Bound<'_, PyAny>) -> PyResult<i64> {
    value.extract().map_err(|_| PyOverflowError::new_err("an integer of more than 64 bits"))
}

/// Converts a Python string to Rust.
fn text(value: &Bound<'_, PyString>) -> PyResult<String> {
    let text = value.to_cow().map(Cow::into_owned);
    text.map_err(|_| PyValueError::new_err("a string with half of a surrogate pair"))
}

/// The error for a string that is too long for an entry.
fn too_long(text: &str) -> String {
    format!("a string has at most {MAX_TEXT} bytes of UTF-8, not {}", text.len())
}

/// The beginning of a long text.
pub fn short(text: String) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}...", text.get(..end).unwrap_or_default()),
        None => text,
    }
}

/// A number, if the value is one. An exception that ends the program is passed on.
fn number(value: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    match value.extract() {
        Ok(number) => Ok(Some(number)),
        Err(why) if why.is_instance_of::<PyOverflowError>(value.py()) => {
            Err(PyOverflowError::new_err("an integer that is too large for a float"))
        }
        Err(why) if why.is_instance_of::<PyException>(value.py()) => Ok(None),
        Err(why) => Err(why),
    }
}

/// A number in that unit; an empty unit means plain numbers.
///
/// # Errors
/// It is not a number, or it has a different unit.
pub fn measured(what: &str, value: &Bound<'_, PyAny>, wanted: &str) -> PyResult<f64> {
    let wrong = |given: String| {
        let kind = match wanted {
            "" => "a plain number".to_owned(),
            wanted => format!("a number in {wanted}"),
        };
        PyTypeError::new_err(format!("{what} is {kind}, not {given}"))
    };
    match unit(value)? {
        Some(given) if given != wanted => Err(wrong(format!("a quantity in {given}"))),
        _ => number(value)?.ok_or_else(|| {
            wrong(value.get_type().name().map_or_else(|_| "?".to_owned(), |it| a(&it.to_string())))
        }),
    }
}

/// Converts a value from Python for a port of that type.
pub fn to_port(ty: &Type, value: &Bound<'_, PyAny>) -> PyResult<Value> {
    let wrong = || {
        let name = value.get_type().name().map(|name| name.to_string()).unwrap_or_default();
        PyTypeError::new_err(format!("expected {}, not {}", a(&ty.to_string()), a(&name)))
    };
    match ty {
        Type::Bool => value.extract().map(Value::Bool).map_err(|_| wrong()),
        Type::Int if is_integer(value)? => integer(value).map(Value::Int),
        Type::Int => Err(wrong()),
        Type::Quantity(dimension) => {
            if let Some(given) = unit(value)?
                && given != dimension.si_unit()
            {
                return Err(PyTypeError::new_err(format!(
                    "expected {}, not a quantity in {given}",
                    a(&ty.to_string())
                )));
            }
            number(value)?.map(Value::Float).ok_or_else(wrong)
        }
        Type::Text => {
            let text = text(value.cast().map_err(|_| wrong())?)?;
            held(&text)
        }
        Type::Enum(choices) => {
            let name = text(value.cast().map_err(|_| wrong())?)?;
            let index = choices.variants.iter().position(|variant| *variant == name);
            let index = index.and_then(|index| u16::try_from(index).ok());
            index.map(Value::Choice).ok_or_else(|| {
                let known = choices.variants.join(", ");
                let name = short(name);
                PyValueError::new_err(format!("no {ty} '{name}'; there are: {known}"))
            })
        }
        Type::Any | Type::Number | Type::Discrete => any(value)?.ok_or_else(wrong),
        Type::Object(_) => Err(wrong()),
    }
}

/// Converts a string for an entry.
fn held(text: &str) -> PyResult<Value> {
    let held = Text::try_from(text).map(Value::Text);
    held.map_err(|_| PyValueError::new_err(too_long(text)))
}

/// Converts a value by its Python type.
fn any(value: &Bound<'_, PyAny>) -> PyResult<Option<Value>> {
    if let Some(truth) = truth(value) {
        return Ok(Some(Value::Bool(truth)));
    }
    if is_integer(value)? {
        return integer(value).map(|number| Some(Value::Int(number)));
    }
    if let Ok(string) = value.cast::<PyString>() {
        return held(&text(string)?).map(Some);
    }
    Ok(number(value)?.map(Value::Float))
}
