//! Ports between AFP and Python: inputs become keyword dictionaries, return values become outcomes
//! with outputs.

use std::sync::Arc;

use afp::load::See;
use afp_core::rt::{Args, BadValue, Outputs, input};
use afp_core::{Fault, Value, ValueRef};
use afp_dsl::toolbox::{InPort, Template, TemplateKind, Toolbox};
use afp_dsl::types::Type;
use afp_session::Simulated;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};

use super::{Host, Object, PyHandle};
use crate::callout::{self, Arguments};
use crate::robot::Caller;
use crate::value::{short, to_port, to_python};

/// A template with its implementation.
#[derive(Clone)]
pub struct PyTemplate {
    pub host: Arc<Host>,
    toolbox: Arc<Toolbox>,
    index: usize,
    pub caller: Arc<Caller>,
    maker: Arc<PyHandle>,
    has_live: bool,
}

/// The value of a port.
enum Pulled {
    Value(Value),
    Object(Object),
}

/// A state or event with its outputs, by port.
pub struct Outcome {
    outcome: u16,
    outputs: Vec<(u16, Pulled)>,
}

impl PyTemplate {
    pub fn new(host: &Arc<Host>, toolbox: &Arc<Toolbox>, index: usize, maker: Py<PyAny>) -> Self {
        let live = |template: &Template| template.inputs.iter().any(|port| port.live);
        let declared = toolbox.templates.get(index);
        let caller = Caller {
            name: declared.map(|template| template.name.clone()).unwrap_or_default(),
            uses: declared.map(|template| template.uses.clone()).unwrap_or_default(),
        };
        PyTemplate {
            host: Arc::clone(host),
            toolbox: Arc::clone(toolbox),
            index,
            caller: Arc::new(caller),
            maker: Arc::new(host.handles.put(maker)),
            has_live: declared.is_some_and(live),
        }
    }

    /// The toolbox's declaration of the template.
    ///
    /// # Errors
    /// Never: the index was found in the toolbox.
    pub fn declared(&self) -> Result<&Template, Fault> {
        self.toolbox.templates.get(self.index).ok_or(Fault::INTERNAL)
    }

    /// Calls the maker of components, or the function of a computation.
    ///
    /// # Errors
    /// Its exception.
    pub fn make<'py>(
        &self,
        py: Python<'py>,
        with: impl Arguments<'py>,
    ) -> PyResult<Bound<'py, PyAny>> {
        callout::call(&self.maker.get(py)?, with)
    }

    /// Pulls, records and checks the inputs that are read once.
    ///
    /// # Errors
    /// The fault of a formula, or a number that is infinite or out of range.
    pub fn inputs(&self, args: &dyn Args, see: See<'_>) -> Result<Inputs<'_>, BadValue> {
        let inputs = self.pull(args, false)?;
        if let Some(see) = see {
            for (port, _, value) in &inputs.0 {
                if let Pulled::Value(value) = value {
                    see(*port, value.as_deref());
                }
            }
        }
        inputs.check()?;
        Ok(inputs)
    }

    /// Pulls and checks the live inputs.
    ///
    /// # Errors
    /// As [`PyTemplate::inputs`].
    pub fn live(&self, args: &dyn Args) -> Result<Inputs<'_>, BadValue> {
        if !self.has_live {
            return Ok(Inputs(Vec::new()));
        }
        let inputs = self.pull(args, true)?;
        inputs.check()?;
        Ok(inputs)
    }

    fn pull(&self, args: &dyn Args, live: bool) -> Result<Inputs<'_>, BadValue> {
        let ports = (0..).zip(&self.declared()?.inputs).filter(|(_, port)| port.live == live);
        let pulled = ports.map(|(number, port)| {
            Ok((number, port, input(number, || Ok(pull(args, number, port)?))?))
        });
        pulled.collect::<Result<_, _>>().map(Inputs)
    }

    /// Polls an actor or supervisor with its live inputs, hands over the outputs, and returns the
    /// state or event.
    ///
    /// # Errors
    /// As [`PyTemplate::live`], or the component's exception.
    pub fn poll<R: Simulated>(
        &self,
        method: &PyHandle,
        args: &dyn Args,
        to: &mut dyn Outputs,
        env: &mut R,
    ) -> Result<Option<u16>, BadValue> {
        let live = self.live(args)?;
        let outcome = self.host.call_with_robot(env, &self.caller, |py| {
            let method = method.get(py)?;
            let said = match live.is_empty() {
                true => callout::call(&method, ()),
                false => callout::call(&method, (live.dict(py)?,)),
            };
            self.outcome(&said?)
        })?;
        Ok(outcome.map(|outcome| outcome.give(to)))
    }

    /// Converts a component's return value: `None`, `"State"` or `("State", {"output": value})`.
    ///
    /// # Errors
    /// An unknown state, or invalid outputs.
    pub fn outcome(&self, said: &Bound<'_, PyAny>) -> PyResult<Option<Outcome>> {
        if said.is_none() {
            return Ok(None);
        }
        let template = self.declared().map_err(|why| PyTypeError::new_err(why.to_string()))?;
        let none = PyDict::new(said.py());
        let (name, outputs) = match said.cast::<PyTuple>() {
            Ok(pair) => pair
                .extract::<(Bound<'_, PyString>, Bound<'_, PyDict>)>()
                .map_err(|_| self.unknown(template, said))?,
            Err(_) => {
                let name = said.cast::<PyString>().map_err(|_| self.unknown(template, said))?;
                (name.clone(), none)
            }
        };
        let name = name.to_cow()?;
        let outcome = (0..).zip(&template.outcomes).find(|(_, outcome)| outcome.name == *name);
        let (outcome, _) = outcome.ok_or_else(|| self.unknown(template, said))?;
        let outputs = outputs_of(&self.host, template, outcome, &outputs)?;
        Ok(Some(Outcome { outcome, outputs }))
    }

    /// The error for an invalid outcome.
    fn unknown(&self, template: &Template, said: &Bound<'_, PyAny>) -> PyErr {
        let known: Vec<_> = template.outcomes.iter().map(|outcome| &*outcome.name).collect();
        let said_so = said.repr().map_or_else(|_| "?".to_owned(), |text| short(text.to_string()));
        let none = if self.may_go_on(said.py(), template.kind) { "None, " } else { "" };
        PyTypeError::new_err(format!(
            "'{}' returned {said_so}; return {none}one of {}, or a pair of it and its outputs",
            template.name,
            known.join(", ")
        ))
    }

    /// Whether it may return nothing; for a computation and an 'async def' that would be the end.
    fn may_go_on(&self, py: Python<'_>, kind: TemplateKind) -> bool {
        let ends = |maker: Bound<'_, PyAny>| maker.hasattr("ends").unwrap_or(false);
        kind != TemplateKind::Computation && !self.maker.get(py).is_ok_and(ends)
    }
}

/// The values of ports.
pub struct Inputs<'a>(Vec<(u16, &'a InPort, Pulled)>);

impl Inputs<'_> {
    fn check(&self) -> Result<(), BadValue> {
        for (position, port, value) in &self.0 {
            let wrong = |fault, value| BadValue::number(fault, value).for_input(*position);
            let Pulled::Value(value) = value else { continue };
            let number = match value {
                Value::Int(int) => *int as f64,
                Value::Float(float) if !float.is_finite() => {
                    return Err(wrong(Fault::ARITHMETIC, *float));
                }
                Value::Float(float) => *float,
                _ => continue,
            };
            if port.range.is_some_and(|(least, most)| number < least || number > most) {
                return Err(wrong(Fault::RANGE, number));
            }
        }
        Ok(())
    }

    /// The values by name.
    pub fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for (_, port, value) in &self.0 {
            let value = match value {
                Pulled::Value(value) => shown(py, &port.ty, value.as_deref())?,
                Pulled::Object(object) => object.get(py)?,
            };
            dict.set_item(&port.name, value)?;
        }
        Ok(dict)
    }

    /// Whether there are no values.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Outcome {
    /// Hands over the outputs and returns the state or event.
    pub fn give(self, to: &mut dyn Outputs) -> u16 {
        for (port, value) in self.outputs {
            match value {
                Pulled::Value(Value::Bool(value)) => to.bool(port, value),
                Pulled::Value(Value::Int(value)) => to.int(port, value),
                Pulled::Value(Value::Float(value)) => to.float(port, value),
                Pulled::Value(Value::Text(value)) => to.text(port, &value),
                Pulled::Value(Value::Choice(value)) => to.choice(port, value),
                Pulled::Value(other) => to.value(port, other),
                Pulled::Object(object) => to.object(port, &mut Some(object)),
            }
        }
        self.outcome
    }
}

fn pull(args: &dyn Args, number: u16, port: &InPort) -> Result<Pulled, Fault> {
    Ok(Pulled::Value(match port.ty {
        Type::Bool => Value::Bool(args.bool(number)?),
        Type::Int => Value::Int(args.int(number)?),
        Type::Quantity(_) => Value::Float(args.float(number)?),
        Type::Text => Value::try_from(args.text(number)?)?,
        Type::Enum(_) => Value::Choice(args.choice(number)?),
        Type::Any | Type::Number | Type::Discrete => args.value(number)?,
        Type::Object(_) => {
            let object = args.object(number)?.downcast_ref::<Object>();
            return object.cloned().map(Pulled::Object).ok_or(Fault::INTERNAL);
        }
    }))
}

fn shown<'py>(py: Python<'py>, ty: &Type, value: ValueRef<'_>) -> PyResult<Bound<'py, PyAny>> {
    to_python(py, value, |choice| match ty {
        Type::Enum(choices) => {
            choices.variants.get(usize::from(choice)).cloned().unwrap_or_default()
        }
        _ => format!("#{choice}"),
    })
}

/// The outputs of an outcome, which must be complete, without additional ones.
fn outputs_of(
    host: &Host,
    template: &Template,
    outcome: u16,
    given: &Bound<'_, PyDict>,
) -> PyResult<Vec<(u16, Pulled)>> {
    let carried = || (0..).zip(&template.outputs).filter(|(_, port)| port.on.contains(&outcome));
    let mut outputs = Vec::new();
    for (number, port) in carried() {
        let value = given.get_item(&port.name)?.ok_or_else(|| {
            let state = &template.outcomes[usize::from(outcome)].name;
            let name = &port.name;
            PyValueError::new_err(format!(
                "'{}' ends in '{state}' without its output '{name}': return (\"{state}\", {{\"{name}\": ...}})",
                template.name
            ))
        })?;
        let value = match &port.ty {
            Type::Object(_) => Pulled::Object(Arc::new(host.handles.put(value.unbind()))),
            ty => {
                let read = to_port(ty, &value);
                let read = read.map_err(|why| of_output(given.py(), &why, template, &port.name));
                Pulled::Value(finite(read?, template, &port.name)?)
            }
        };
        outputs.push((number, value));
    }
    for key in given.keys() {
        let key: String = key.extract()?;
        if !carried().any(|(_, port)| port.name == key) {
            let (name, state) = (&template.name, &template.outcomes[usize::from(outcome)].name);
            return Err(PyValueError::new_err(format!(
                "'{state}' of '{name}' has no output '{key}'"
            )));
        }
    }
    Ok(outputs)
}

/// Adds the output's name to an error.
fn of_output(py: Python<'_>, why: &PyErr, template: &Template, output: &str) -> PyErr {
    let text = format!("the output '{output}' of '{}': {}", template.name, why.value(py));
    PyErr::from_type(why.get_type(py), text)
}

/// A value that is finite.
fn finite(value: Value, template: &Template, output: &str) -> PyResult<Value> {
    match value {
        Value::Float(number) if !number.is_finite() => Err(PyValueError::new_err(format!(
            "the output '{output}' of '{}' is {number}; outputs are finite numbers",
            template.name
        ))),
        value => Ok(value),
    }
}
