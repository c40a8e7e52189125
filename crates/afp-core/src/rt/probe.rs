//! Compile-time check whether a platform has the traits that a template needs.
//!
//! A method call selects [`ActorSupported`] or [`SupervisorSupported`] if their bounds hold, and
//! [`Unsupported`] one automatic reference later. The platform must be concrete, so the macro
//! `afp_macros::register!` makes the calls.

use core::marker::PhantomData;

use crate::component::{Actor, ActorTemplate, Resumable, Supervisor, SupervisorTemplate};
use crate::rt::ports::{FromArgs, Outcome, Registry};

/// A template `T`, its implementation `A`, and a platform `E`.
pub struct Probe<T, A, E: ?Sized>(PhantomData<T>, PhantomData<A>, PhantomData<E>);

impl<T, A, E: ?Sized> Probe<T, A, E> {
    pub const NEW: Self = Probe(PhantomData, PhantomData, PhantomData);
}

/// The platform supports the actor.
pub trait ActorSupported<E: ?Sized> {
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

/// The platform supports the resumable actor.
pub trait ResumableSupported<E: ?Sized> {
    fn resumable(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

/// The platform supports the supervisor.
pub trait SupervisorSupported<E: ?Sized> {
    fn supervisor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );
}

/// The platform lacks a trait that the template needs.
pub trait Unsupported<E: ?Sized> {
    fn actor(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );

    fn resumable(
        &self,
        registry: &mut impl Registry<E>,
        names: (&'static str, &'static str),
        missing: &[&'static str],
    );

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

impl<T, A, E: ?Sized> ResumableSupported<E> for Probe<T, A, E>
where
    T: ActorTemplate + 'static,
    A: Resumable<T, E> + Clone + Send + 'static,
    for<'a> T::Inputs<'a>: FromArgs<'a>,
    for<'a> T::Live<'a>: FromArgs<'a>,
    T::State: Outcome,
{
    fn resumable(
        &self,
        registry: &mut impl Registry<E>,
        (toolbox, template): (&'static str, &'static str),
        _: &[&'static str],
    ) {
        registry.resumable::<T, A>(toolbox, template);
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

    fn resumable(
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
