//! Which Rust types implement the templates of which toolbox.

use std::collections::BTreeMap;

use afp_core::rt::{self, FromArgs, Outcome};
use afp_core::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Supervisor, SupervisorTemplate,
};

use super::config::{NewCell, ObjectCell};
use super::slots::{ActorSlot, ComputationSlot, Home, SupervisorSlot};

type Key = (&'static str, &'static str);
type NewActor<E> = fn() -> Box<dyn ActorSlot<E>>;
type NewSupervisor<E> = fn() -> Box<dyn SupervisorSlot<E>>;
type NewComputation = fn() -> Box<dyn ComputationSlot>;

/// The components of some toolboxes on platform `E`, by toolbox and template.
///
/// `toolbox!` makes a function `register` that fills one:
///
/// ```ignore
/// let mut registry = Registry::new();
/// afp_std::templates::register(&mut registry);
/// afp_carbot::templates::register(&mut registry);
/// ```
pub struct Registry<E: ?Sized + 'static> {
    actors: BTreeMap<Key, NewActor<E>>,
    supervisors: BTreeMap<Key, NewSupervisor<E>>,
    computations: BTreeMap<Key, NewComputation>,
    objects: BTreeMap<Key, NewCell>,
}

impl<E: ?Sized> Registry<E> {
    /// An empty registry.
    pub fn new() -> Self {
        Registry {
            actors: BTreeMap::new(),
            supervisors: BTreeMap::new(),
            computations: BTreeMap::new(),
            objects: BTreeMap::new(),
        }
    }

    pub(super) fn new_actor(&self, toolbox: &str, name: &str) -> Option<Box<dyn ActorSlot<E>>> {
        find(&self.actors, toolbox, name).map(|new| new())
    }

    pub(super) fn new_supervisor(
        &self,
        toolbox: &str,
        name: &str,
    ) -> Option<Box<dyn SupervisorSlot<E>>> {
        find(&self.supervisors, toolbox, name).map(|new| new())
    }

    pub(super) fn new_computation(
        &self,
        toolbox: &str,
        name: &str,
    ) -> Option<Box<dyn ComputationSlot>> {
        find(&self.computations, toolbox, name).map(|new| new())
    }

    pub(super) fn object_cell(&self, toolbox: &str, name: &str) -> Option<NewCell> {
        find(&self.objects, toolbox, name)
    }
}

/// The keys are static, a graph's names are not: compare them as plain texts.
fn find<T: Copy>(map: &BTreeMap<Key, T>, toolbox: &str, name: &str) -> Option<T> {
    map.iter().find(|(key, _)| **key == (toolbox, name)).map(|(_, new)| *new)
}

impl<E: ?Sized> Default for Registry<E> {
    fn default() -> Self {
        Registry::new()
    }
}

impl<E: ?Sized + 'static> rt::Registry<E> for Registry<E> {
    fn actor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ActorTemplate + 'static,
        A: Actor<T, E> + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome,
    {
        self.actors.insert((toolbox, template), || Box::new(Home::<T, A>::new()));
    }

    fn supervisor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: SupervisorTemplate + 'static,
        A: Supervisor<T, E> + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::Event: Outcome,
    {
        self.supervisors.insert((toolbox, template), || Box::new(Home::<T, A>::new()));
    }

    fn computation<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ComputationTemplate + 'static,
        A: Computation<T> + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        T::State: Outcome,
    {
        self.computations.insert((toolbox, template), || Box::new(Home::<T, A>::new()));
    }

    fn object<T: Clone + 'static>(&mut self, toolbox: &'static str, name: &'static str) {
        self.objects.insert((toolbox, name), || Box::new(None::<T>) as Box<dyn ObjectCell>);
    }
}
