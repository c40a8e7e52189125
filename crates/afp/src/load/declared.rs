//! Computations declared by formulas, which are not in a registry.

use std::cell::RefCell;
use std::sync::Arc;

use afp_core::rt::{Args, BadValue, Outputs, input, within, within_int, within_value};
use afp_core::{Fault, Value};
use afp_dsl::toolbox::{Case, InPort, Template};
use afp_dsl::types::Type;
use afp_dsl::types::converter::Converter;
use afp_types::{Comparison, EntryId, Error, Source};

use super::formula::Formula;
use super::numbered;
use super::slots::{ComputationSlot, See};

/// Evaluates the formulas of a declared computation.
pub struct DeclaredSlot {
    declared: Arc<Declared>,
    /// Storage for the values of the input ports.
    values: RefCell<Vec<Value>>,
}

struct Declared {
    inputs: Vec<InPort>,
    cases: Vec<Ready>,
}

/// A state with its prepared formulas.
struct Ready {
    when: Vec<(Formula, Comparison, Formula)>,
    writes: Vec<(u16, Formula)>,
}

struct Given<'a>(&'a [Value]);

impl DeclaredSlot {
    /// A computation of a template with these cases.
    pub fn new(template: &Template, cases: &[Case]) -> Self {
        let cases = cases.iter().map(Ready::new).collect();
        let inputs = template.inputs.clone();
        let values = RefCell::new(vec![Value::default(); inputs.len()]);
        DeclaredSlot { declared: Arc::new(Declared { inputs, cases }), values }
    }
}

impl Ready {
    fn new(case: &Case) -> Self {
        let when = case.when.iter();
        let when =
            when.map(|one| (Formula::new(&one.left), one.comparison, Formula::new(&one.right)));
        let writes = case.writes.iter().map(|(port, formula)| (*port, Formula::new(formula)));
        Ready { when: when.collect(), writes: writes.collect() }
    }

    fn holds(&self, given: &Given<'_>) -> Result<bool, Error> {
        for (left, comparison, right) in &self.when {
            if !comparison.of(left.part(), right.part(), given)? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

impl Source<Converter> for Given<'_> {
    fn entry<V>(&self, port: EntryId, read: impl FnOnce(&Value) -> Option<V>) -> Result<V, Error> {
        self.0.get(port.index()).and_then(read).ok_or(Error::Mistyped)
    }

    fn convert(&self, converter: &Converter, value: Value) -> Result<Value, Error> {
        converter.convert(value)
    }
}

/// Checks that the value of a port is finite and in its range.
fn check(number: u16, port: &InPort, value: &Value) -> Result<(), BadValue> {
    match (value, port.range) {
        (Value::Int(value), Some((least, greatest))) if port.ty == Type::Int => {
            within_int(number, *value, least.ceil() as i64, greatest.floor() as i64)
        }
        (Value::Float(value), Some((least, greatest))) => within(number, *value, least, greatest),
        (value, _) => within_value(number, value.as_deref()),
    }
}

impl ComputationSlot for DeclaredSlot {
    fn compute(
        &self,
        args: &dyn Args,
        see: See<'_>,
        to: &mut dyn Outputs,
    ) -> Result<u16, BadValue> {
        let Declared { inputs, cases } = &*self.declared;
        let mut values = self.values.try_borrow_mut().map_err(|_| Fault::INTERNAL)?;
        for (port, value) in numbered(&mut *values) {
            *value = input(port, || Ok(args.value(port)?))?;
        }
        if let Some(see) = see {
            numbered(&*values).for_each(|(port, value)| see(port, value.as_deref()));
        }
        for ((number, port), value) in numbered(inputs).zip(&*values) {
            check(number, port, value)?;
        }
        let given = Given(&values);
        for (state, case) in numbered(cases) {
            if case.holds(&given)? {
                for (port, formula) in &case.writes {
                    to.value(*port, formula.part().value(&given)?);
                }
                return Ok(state);
            }
        }
        Err(Fault::INTERNAL.into())
    }

    fn try_clone(&self) -> Option<Box<dyn ComputationSlot>> {
        let values = RefCell::new(self.values.borrow().clone());
        Some(Box::new(DeclaredSlot { declared: Arc::clone(&self.declared), values }))
    }
}
