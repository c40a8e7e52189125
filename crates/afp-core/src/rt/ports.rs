//! How ports cross the border between typed templates and plans loaded at run time.
//!
//! `toolbox!` implements these traits for every template; only loaded plans need them, apart
//! from [`Ports`], which checks ranges for all.

use core::any::Any as Dynamic;

use afp_types::{Text, Value, ValueRef};

use crate::component::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Supervisor, SupervisorTemplate,
};
use crate::fault::{BadValue, Fault};

/// The inputs of a component, or those read anew at each poll.
pub trait Ports {
    /// Checks that numbers are finite and within their ports' ranges.
    ///
    /// # Errors
    /// [`Fault::ARITHMETIC`] or [`Fault::RANGE`].
    fn check(&self) -> Result<(), BadValue>;

    /// Shows each port with its position among the template's inputs.
    fn each(&self, see: &mut dyn FnMut(u16, ValueRef<'_>));
}

/// The formulas of a component, pulled by port.
pub trait Args {
    /// The value of a `bool` port.
    ///
    /// # Errors
    /// The fault of the formula; so for all methods.
    fn bool(&self, port: u16) -> Result<bool, Fault>;
    /// The value of an `int` port.
    fn int(&self, port: u16) -> Result<i64, Fault>;
    /// The value of a `float` or quantity port, in SI units.
    fn float(&self, port: u16) -> Result<f64, Fault>;
    /// The value of a `string` port.
    fn text(&self, port: u16) -> Result<&str, Fault>;
    /// The value of an enum port.
    fn choice(&self, port: u16) -> Result<u16, Fault>;
    /// The value of an object port, of the template's own Rust type.
    fn object(&self, port: u16) -> Result<&dyn Dynamic, Fault>;
    /// The value of an `any` or `number` port.
    fn value(&self, port: u16) -> Result<Value, Fault>;
}

/// Inputs that can be pulled from formulas.
pub trait FromArgs<'a>: Ports + Sized {
    /// Pulls each port.
    ///
    /// # Errors
    /// The first fault of a formula.
    fn from_args(args: &'a dyn Args) -> Result<Self, BadValue>;
}

/// Takes the outputs of a component, port by port.
pub trait Outputs {
    /// Takes a `bool`.
    fn bool(&mut self, port: u16, value: bool);
    /// Takes an `int`.
    fn int(&mut self, port: u16, value: i64);
    /// Takes a `float` or a quantity in SI units.
    fn float(&mut self, port: u16, value: f64);
    /// Takes a text.
    fn text(&mut self, port: u16, value: &Text);
    /// Takes a value of an enum.
    fn choice(&mut self, port: u16, value: u16);
    /// Takes an object: an `Option<T>` of the template's own Rust type, to be swapped out.
    fn object(&mut self, port: u16, value: &mut dyn Dynamic);
    /// Takes the value of an `any` or `number` port.
    fn value(&mut self, port: u16, value: Value);
}

/// A state or event with its outputs.
pub trait Outcome {
    /// Its position in the template.
    fn index(&self) -> u16;

    /// Hands over its outputs, each with its position among the template's output ports.
    fn give(self, to: &mut dyn Outputs);
}

/// Collects the components that implement a toolbox on platform `E`.
///
/// Components and objects can be sent to another thread, since a loaded plan may be driven from any, and
/// copied, so that a run can be gone back in.
///
/// `toolbox!` makes a function `register` that names all of them.
pub trait Registry<E: ?Sized> {
    /// Adds an actor.
    fn actor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ActorTemplate + 'static,
        A: Actor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome;

    /// Adds a supervisor.
    fn supervisor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: SupervisorTemplate + 'static,
        A: Supervisor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::Event: Outcome;

    /// Adds a computation.
    fn computation<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ComputationTemplate + 'static,
        A: Computation<T> + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        T::State: Outcome;

    /// Adds an object type.
    fn object<T: Clone + Send + 'static>(&mut self, toolbox: &'static str, name: &'static str);

    /// Notes that the platform does not support a template: of the traits that the toolbox asks for it does not
    /// implement those that are `missing`; empty names are skipped.
    fn unsupported(
        &mut self,
        toolbox: &'static str,
        template: &'static str,
        missing: &[&'static str],
    );
}
