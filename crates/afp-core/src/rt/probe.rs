//! Whether a platform has what the Rust of a template asks for, decided while a program is compiled.
//!
//! A method call finds the methods of [`ActorSupported`] and [`SupervisorSupported`] where their bounds hold, else, one
//! automatic reference later, those of [`Unsupported`]. That needs a concrete platform, so a macro makes the calls
//! where the platform is named: `afp_macros::register!`.

use core::marker::PhantomData;

use crate::component::{Actor, ActorTemplate, Supervisor, SupervisorTemplate};
use crate::rt::ports::{FromArgs, Outcome, Registry};

/// A template `T`, the type `A` that implements it, and a platform `E`.
pub struct Probe<T, A, E: ?Sized>(PhantomData<T>, PhantomData<A>, PhantomData<E>);

impl<T, A, E: ?Sized> Probe<T, A, E> {
    /// The only value.
    pub const NEW: Self = Probe(PhantomData, PhantomData, PhantomData);
}

/// The platform has what the actor asks for.
pub trait ActorSupported<E: ?Sized> {
    /// Registers it.
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

/// The platform has what the supervisor asks for.
pub trait SupervisorSupported<E: ?Sized> {
    /// Registers it.
    fn supervisor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

/// The platform lacks something that the template asks for.
pub trait Unsupported<E: ?Sized> {
    /// Notes that the platform does not support the actor.
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );

    /// Notes that the platform does not support the supervisor.
    fn supervisor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

impl<T, A, E: ?Sized> ActorSupported<E> for Probe<T, A, E>
where
    T: ActorTemplate + 'static,
    A: Actor<T, E> + Clone + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    for<'a> T::Live<'a>: FromArgs<'a>,
    T::State: Outcome,
{
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        (toolbox, template): (&'static str, &'static str),
        _: &[&'static str],
    ) {
        registry.actor::<T, A>(toolbox, template);
    }
}

impl<T, A, E: ?Sized> SupervisorSupported<E> for Probe<T, A, E>
where
    T: SupervisorTemplate + 'static,
    A: Supervisor<T, E> + Clone + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    for<'a> T::Live<'a>: FromArgs<'a>,
    T::Event: Outcome,
{
    fn supervisor(
        &self,
        registry: &mut impl Registry<E>,
        (toolbox, template): (&'static str, &'static str),
        _: &[&'static str],
    ) {
        registry.supervisor::<T, A>(toolbox, template);
    }
}

impl<T, A, E: ?Sized> Unsupported<E> for &Probe<T, A, E> {
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        (toolbox, template): (&'static str, &'static str),
        missing: &[&'static str],
    ) {
        registry.unsupported(toolbox, template, missing);
    }

    fn supervisor(
        &self,
        registry: &mut impl Registry<E>,
        (toolbox, template): (&'static str, &'static str),
        missing: &[&'static str],
    ) {
        registry.unsupported(toolbox, template, missing);
    }
}
