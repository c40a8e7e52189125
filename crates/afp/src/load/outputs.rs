//! Between ports and the configuration: formulas pulled in, outputs staged.

use std::any::Any;

use afp_core::rt::{Args, Outputs};
use afp_core::{Fault, Text, Value};
use afp_dsl::graph::{Formula, FormulaKind, Output};
use afp_dsl::types::Type;

use super::config::{ObjectCell, Staged, Values};
use super::formula;

/// The bound formulas of a component, and room for the texts that they compute.
pub struct Inputs {
    formulas: Vec<Formula>,
    texts: Vec<Option<Result<Text, Fault>>>,
}

/// Formulas with the configuration that they read.
pub struct Pull<'a> {
    inputs: &'a Inputs,
    values: &'a Values,
}

/// Stages outputs by the bindings of a component.
pub struct Stage<'a> {
    outputs: &'a [Output],
    staged: &'a mut Staged,
    /// The first fault of a conversion.
    fault: Option<Fault>,
}

impl Inputs {
    pub fn new(formulas: Vec<Formula>) -> Self {
        let texts = formulas.iter().map(|_| None).collect();
        Inputs { formulas, texts }
    }

    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// Computes the texts that no entry holds, then lends the formulas.
    #[inline]
    pub fn pull<'a>(&'a mut self, values: &'a Values) -> Pull<'a> {
        for (formula, text) in self.formulas.iter().zip(&mut self.texts) {
            let computed = matches!(
                (&formula.ty, &formula.kind),
                (Type::Text, FormulaKind::Binary(..) | FormulaKind::Convert(..))
            );
            if computed {
                *text = Some(formula::text(formula, values));
            }
        }
        Pull { inputs: self, values }
    }
}

impl Pull<'_> {
    #[inline]
    fn formula(&self, port: u16) -> Result<&Formula, Fault> {
        self.inputs.formulas.get(usize::from(port)).ok_or(Fault::INTERNAL)
    }
}

impl Args for Pull<'_> {
    fn bool(&self, port: u16) -> Result<bool, Fault> {
        formula::bool(self.formula(port)?, self.values)
    }

    fn int(&self, port: u16) -> Result<i64, Fault> {
        formula::int(self.formula(port)?, self.values)
    }

    #[inline]
    fn float(&self, port: u16) -> Result<f64, Fault> {
        formula::float(self.formula(port)?, self.values)
    }

    fn text(&self, port: u16) -> Result<&str, Fault> {
        match &self.formula(port)?.kind {
            FormulaKind::Text(text) => Ok(text),
            FormulaKind::Entry(entry) => match self.values.get(entry.0) {
                Value::Text(text) => Ok(text.as_str()),
                _ => Err(Fault::INTERNAL),
            },
            _ => match self.inputs.texts.get(usize::from(port)) {
                Some(Some(Ok(text))) => Ok(text.as_str()),
                Some(Some(Err(fault))) => Err(*fault),
                _ => Err(Fault::INTERNAL),
            },
        }
    }

    fn choice(&self, port: u16) -> Result<u16, Fault> {
        formula::choice(self.formula(port)?, self.values)
    }

    fn object(&self, port: u16) -> Result<&dyn Any, Fault> {
        match &self.formula(port)?.kind {
            FormulaKind::Entry(entry) => self.values.object(entry.0),
            _ => Err(Fault::INTERNAL),
        }
    }

    fn value(&self, port: u16) -> Result<Value, Fault> {
        formula::value(self.formula(port)?, self.values)
    }
}

impl<'a> Stage<'a> {
    pub fn new(outputs: &'a [Output], staged: &'a mut Staged) -> Self {
        Stage { outputs, staged, fault: None }
    }

    /// Stages one output, converted for its entry.
    pub fn put(&mut self, port: u16, value: Value) {
        let Some(output) = self.outputs.iter().find(|output| output.port == port) else { return };
        let converted = match &output.conversion {
            None => Ok(value),
            Some(conversion) => formula::convert(conversion, value),
        };
        match converted.and_then(formula::check_finite) {
            Ok(value) => self.staged.put(output.entry.0, value),
            Err(fault) => self.fault = self.fault.or(Some(fault)),
        }
    }

    /// Stages one object output: `fill` puts it into the shadow cell.
    pub fn put_object(&mut self, port: u16, fill: impl FnOnce(&mut dyn ObjectCell)) {
        if let Some(output) = self.outputs.iter().find(|output| output.port == port) {
            self.staged.put_object(output.entry.0, fill);
        }
    }

    /// How it went.
    pub fn result(self) -> Result<(), Fault> {
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
        self.put(port, value);
    }
}
