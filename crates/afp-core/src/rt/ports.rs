//! Ports between typed templates and plans loaded at run time.
//!
//! `toolbox!` implements these traits for every template. Only loaded plans need them, except
//! [`Ports`], which checks ranges for all.

use core::any::Any as Dynamic;

use afp_types::{Text, Value, ValueRef};

use crate::component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Resumable, Supervisor,
    SupervisorTemplate,
};
use crate::fault::{BadValue, Fault};

/// The inputs of a component, or its live inputs.
pub trait Ports {
    /// Checks that numbers are finite and in range.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] or [`Fault::RANGE`].
    fn check(&self) -> Result<(), BadValue>;

    /// Visits each port with its position among the template's inputs.
    fn each(&self, see: &mut dyn FnMut(u16, ValueRef<'_>));
}

/// The formulas of a component, evaluated by port.
pub trait Args {
    /// The value of a `bool` port.
    ///
    /// # Errors
    /// The fault of the formula, as for every method.
    fn bool(&self, port: u16) -> Result<bool, Fault>;
    fn int(&self, port: u16) -> Result<i64, Fault>;
    /// The value of a `float` or quantity port, in SI units.
    fn float(&self, port: u16) -> Result<f64, Fault>;
    fn text(&self, port: u16) -> Result<&str, Fault>;
    fn choice(&self, port: u16) -> Result<u16, Fault>;
    /// The value of an object port, of the template's Rust type.
    fn object(&self, port: u16) -> Result<&dyn Dynamic, Fault>;
    /// The value of an `any` or `number` port.
    fn value(&self, port: u16) -> Result<Value, Fault>;
}

/// Inputs that are evaluated from formulas.
pub trait FromArgs<'a>: Ports + Sized {
    /// Evaluates each port.
    ///
    /// # Errors
    /// The first fault of a formula.
    fn from_args(args: &'a dyn Args) -> Result<Self, BadValue>;
}

/// Takes the outputs of a component, by port.
pub trait Outputs {
    fn bool(&mut self, port: u16, value: bool);
    fn int(&mut self, port: u16, value: i64);
    /// Takes a `float` or a quantity in SI units.
    fn float(&mut self, port: u16, value: f64);
    fn text(&mut self, port: u16, value: &Text);
    fn choice(&mut self, port: u16, value: u16);
    /// Takes an object: an `Option<T>` of the template's Rust type, to be swapped out.
    fn object(&mut self, port: u16, value: &mut dyn Dynamic);
    /// Takes the value of an `any` or `number` port.
    fn value(&mut self, port: u16, value: Value);
}

/// A state or event with its outputs.
pub trait Outcome {
    /// The position in the template.
    fn index(&self) -> u16;

    /// Passes the outputs, each with its position among the template's output ports.
    fn give(self, to: &mut dyn Outputs);
}

/// Collects the components that implement a toolbox on platform `E`.
///
/// Components and objects are `Send`, since any thread may drive a loaded plan, and `Clone`, so
/// that a run can go back.
///
/// `toolbox!` generates a function `register` that adds all of them.
pub trait Registry<E: ?Sized> {
    fn actor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ActorTemplate + 'static,
        A: Actor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome;

    /// Adds an actor that its toolbox calls `resumable`.
    fn resumable<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ActorTemplate + 'static,
        A: Resumable<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome;

    fn supervisor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: SupervisorTemplate + 'static,
        A: Supervisor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::Event: Outcome;

    fn computation<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ComputationTemplate + 'static,
        A: Computation<T> + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        T::State: Outcome;

    fn object<T: Clone + Send + 'static>(&mut self, toolbox: &'static str, name: &'static str);

    /// Records that the platform does not support a template, with the missing traits; empty names
    /// are skipped.
    fn unsupported(
        &mut self,
        toolbox: &'static str,
        template: &'static str,
        missing: &[&'static str],
    );
}
