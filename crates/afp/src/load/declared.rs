//! Computations declared by formulas, which are not in a registry.

use std::cell::RefCell;
use std::sync::Arc;

use afp_core::rt::{Args, BadValue, Outputs, input, within, within_int, within_value};
use afp_core::{Fault, Value};
use afp_dsl::toolbox::{Case, InPort, Template};
use afp_dsl::types::Type;
use afp_dsl::types::converter::Converter;
use afp_types::{Comparison, EntryId, Error, Shape, Source};

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
    /// The ports whose values can be invalid: in a range, or perhaps not finite.
    checked: Vec<(u16, InPort)>,
    /// Whether each input is an integer, which is read without a copy of a whole value.
    is_int: Vec<bool>,
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
        let is_valid = |port: &InPort| port.range.is_none() && port.ty == Type::Int;
        let checked = numbered(&template.inputs).filter(|(_, port)| !is_valid(port));
        let checked = checked.map(|(number, port)| (number, port.clone())).collect();
        let is_int: Vec<_> = template.inputs.iter().map(|port| port.ty == Type::Int).collect();
        let values = RefCell::new(vec![Value::default(); is_int.len()]);
        DeclaredSlot { declared: Arc::new(Declared { checked, is_int, cases }), values }
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
        let Declared { checked, is_int, cases } = &*self.declared;
        let mut values = self.values.try_borrow_mut().map_err(|_| Fault::INTERNAL)?;
        for ((port, value), is_int) in (0..).zip(&mut *values).zip(is_int) {
            *value = match is_int {
                true => Value::Int(input(port, || Ok(args.int(port)?))?),
                false => input(port, || Ok(args.value(port)?))?,
            };
        }
        if let Some(see) = see {
            numbered(&*values).for_each(|(port, value)| see(port, value.as_deref()));
        }
        for (number, port) in checked {
            let value = values.get(usize::from(*number)).ok_or(Fault::INTERNAL)?;
            check(*number, port, value)?;
        }
        let given = Given(&values);
        for (state, case) in (0..).zip(cases) {
            let failed = |why: Error| BadValue::from(why).for_state(state);
            if case.holds(&given).map_err(failed)? {
                for (port, formula) in &case.writes {
                    let part = formula.part();
                    match part.root.shape {
                        Shape::Int => to.int(*port, part.int(&given).map_err(failed)?),
                        _ => to.value(*port, part.value(&given).map_err(failed)?),
                    }
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
