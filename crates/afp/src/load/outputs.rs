//! Between ports and the configuration: evaluates inputs, stages outputs.

use std::any::Any;
use std::sync::Arc;

use afp_core::rt::{Args, BadValue, Outputs, finite, limited};
use afp_core::{Fault, Text, Value};
use afp_dsl::graph;
use afp_dsl::types::converter::Converter;

use super::config::{ObjectCell, Staged, Values};
use super::formula::Formula;
use super::numbered;

/// The bound formulas of a component, and storage for their strings.
#[derive(Clone)]
pub struct Inputs {
    formulas: Arc<[Formula]>,
    texts: Vec<(u16, Result<Text, Fault>)>,
}

/// Formulas with their configuration.
pub struct Pull<'a> {
    inputs: &'a Inputs,
    values: &'a Values,
}

/// An output port bound to an entry.
pub struct Binding {
    port: u16,
    entry: u16,
    /// Minimum and maximum of the entry.
    range: Option<(f64, f64)>,
    converter: Option<Converter>,
}

/// Stages outputs by the bindings of a component.
pub struct Stage<'a> {
    bindings: &'a [Binding],
    staged: &'a mut Staged,
    /// The first fault of a conversion or range.
    fault: Option<BadValue>,
    /// The source of copies for objects from ports of type `any`.
    pub passed: Option<&'a Pull<'a>>,
}

impl Binding {
    /// The bindings of a component to entries of its plan.
    pub fn all(outputs: &[graph::Output], entries: &[graph::Entry]) -> Arc<[Binding]> {
        let bindings = outputs.iter().map(|output| Binding {
            port: output.port,
            entry: output.entry.0,
            range: entries.get(output.entry.index()).and_then(|entry| entry.range),
            converter: output.conversion.as_ref().map(Converter::new),
        });
        bindings.collect()
    }
}

/// Checks a value against an entry's range, if any.
///
/// # Errors
/// [`Fault::RANGE`].
pub fn limit(range: Option<(f64, f64)>, value: Value) -> Result<Value, BadValue> {
    match range {
        Some((least, greatest)) => limited(value, least, greatest),
        None => Ok(value),
    }
}

impl Inputs {
    pub fn new(formulas: &[graph::Formula]) -> Self {
        let formulas: Arc<[_]> = formulas.iter().map(Formula::new).collect();
        let makers = numbered(&*formulas).filter(|(_, formula)| formula.makes_text());
        let texts = makers.map(|(port, _)| (port, Ok(Text::new()))).collect();
        Inputs { formulas, texts }
    }

    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// Computes the strings that are not stored elsewhere, then lends the formulas.
    #[inline]
    pub fn pull<'a>(&'a mut self, values: &'a Values) -> Pull<'a> {
        if !self.texts.is_empty() {
            self.make_texts(values);
        }
        Pull { inputs: self, values }
    }

    /// Separate from the hot path: few formulas compute strings.
    #[inline(never)]
    fn make_texts(&mut self, values: &Values) {
        for (port, text) in &mut self.texts {
            if let Some(formula) = self.formulas.get(usize::from(*port)) {
                *text = formula.part().text(values).map_err(Fault::from);
            }
        }
    }
}

impl Pull<'_> {
    #[inline]
    fn formula(&self, port: u16) -> Result<&Formula, Fault> {
        self.inputs.formulas.get(usize::from(port)).ok_or(Fault::INTERNAL)
    }
}

impl Pull<'_> {
    /// The input object that a commit wrote.
    fn numbered(&self, commit: u32) -> Option<&dyn ObjectCell> {
        let mut entries = self.inputs.formulas.iter().filter_map(Formula::entry);
        let entry = entries.find(|entry| *self.values.get(*entry) == Value::Object(commit))?;
        self.values.cell(entry)
    }
}

impl Args for Pull<'_> {
    fn bool(&self, port: u16) -> Result<bool, Fault> {
        Ok(self.formula(port)?.part().bool(self.values)?)
    }

    fn int(&self, port: u16) -> Result<i64, Fault> {
        Ok(self.formula(port)?.part().int(self.values)?)
    }

    #[inline]
    fn float(&self, port: u16) -> Result<f64, Fault> {
        Ok(self.formula(port)?.part().float(self.values)?)
    }

    fn text(&self, port: u16) -> Result<&str, Fault> {
        if let Some(text) = self.formula(port)?.borrow_text(self.values) {
            return Ok(text);
        }
        let made = self.inputs.texts.iter().find(|(maker, _)| *maker == port);
        match made {
            Some((_, Ok(text))) => Ok(text.as_str()),
            Some((_, Err(fault))) => Err(*fault),
            None => Err(Fault::INTERNAL),
        }
    }

    fn choice(&self, port: u16) -> Result<u16, Fault> {
        Ok(self.formula(port)?.part().choice(self.values)?)
    }

    fn object(&self, port: u16) -> Result<&dyn Any, Fault> {
        let entry = self.formula(port)?.entry().ok_or(Fault::INTERNAL)?;
        self.values.object(entry)
    }

    fn value(&self, port: u16) -> Result<Value, Fault> {
        Ok(self.formula(port)?.part().value(self.values)?)
    }
}

impl<'a> Stage<'a> {
    pub fn new(bindings: &'a [Binding], staged: &'a mut Staged) -> Self {
        Stage { bindings, staged, fault: None, passed: None }
    }

    /// Stages one output, converted for its entry and checked against its range.
    pub fn put(&mut self, port: u16, value: Value) {
        let Some(binding) = self.binding(port) else { return };
        let converted = match &binding.converter {
            None => Ok(value),
            Some(converter) => converter.convert(value).map_err(BadValue::from),
        };
        let fitting = converted.and_then(finite).and_then(|value| limit(binding.range, value));
        match fitting {
            Ok(value) => self.staged.put(binding.entry, value),
            Err(why) => self.fault = self.fault.or(Some(why.for_output(port))),
        }
    }

    /// Stages one object output: `fill` puts it into the shadow cell.
    pub fn put_object(&mut self, port: u16, fill: impl FnOnce(&mut dyn ObjectCell)) {
        if let Some(binding) = self.binding(port) {
            self.staged.put_object(binding.entry, fill);
        }
    }

    fn binding(&self, port: u16) -> Option<&'a Binding> {
        self.bindings.iter().find(|binding| binding.port == port)
    }

    /// The first error, if any.
    pub fn result(self) -> Result<(), BadValue> {
        self.fault.map_or(Ok(()), Err)
    }
}

impl Outputs for Stage<'_> {
    fn bool(&mut self, port: u16, value: bool) {
        self.put(port, Value::Bool(value));
    }

    fn int(&mut self, port: u16, value: i64) {
        self.put(port, Value::Int(value));
    }

    fn float(&mut self, port: u16, value: f64) {
        self.put(port, Value::Float(value));
    }

    fn text(&mut self, port: u16, value: &Text) {
        self.put(port, Value::Text(value.clone()));
    }

    fn choice(&mut self, port: u16, value: u16) {
        self.put(port, Value::Choice(value));
    }

    fn object(&mut self, port: u16, value: &mut dyn Any) {
        self.put_object(port, |cell| cell.take(value));
    }

    fn value(&mut self, port: u16, value: Value) {
        let Value::Object(number) = value else { return self.put(port, value) };
        match self.passed.and_then(|passed| passed.numbered(number)) {
            Some(cell) => self.put_object(port, |to| to.copy(cell)),
            None => self.fault = self.fault.or(Some(Fault::INTERNAL.into())),
        }
    }
}
