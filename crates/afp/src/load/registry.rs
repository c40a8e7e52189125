//! The Rust types that implement the templates of toolboxes.

use std::collections::BTreeMap;

use afp_core::rt::{self, FromArgs, Outcome};
use afp_core::{
    Actor, ActorTemplate, Computation, ComputationTemplate, Resumable, Supervisor,
    SupervisorTemplate,
};

use super::config::{NewCell, ObjectCell};
use super::slots::{ActorSlot, Always, ComputationSlot, Never, Slot, SupervisorSlot};

type NewActor<E> = Box<dyn Fn() -> Box<dyn ActorSlot<E>> + Send + Sync>;
type NewSupervisor<E> = Box<dyn Fn() -> Box<dyn SupervisorSlot<E>> + Send + Sync>;
type NewComputation = Box<dyn Fn() -> Box<dyn ComputationSlot> + Send + Sync>;

/// Items of one kind, by toolbox and name.
type Map<T> = BTreeMap<String, BTreeMap<String, T>>;

/// The components of some toolboxes on platform `E`, by toolbox and template.
///
/// `toolbox!` generates a function `register` that fills one:
///
/// ```ignore
/// let mut registry = Registry::new();
/// afp_std::templates::register(&mut registry);
/// afp_carbot::templates::register(&mut registry);
/// ```
pub struct Registry<E: ?Sized + 'static> {
    actors: Map<NewActor<E>>,
    supervisors: Map<NewSupervisor<E>>,
    computations: Map<NewComputation>,
    objects: Map<NewCell>,
    /// Unsupported templates, with the traits that the platform lacks.
    unsupported: Map<Vec<&'static str>>,
}

impl<E: ?Sized> Registry<E> {
    /// An empty registry.
    pub fn new() -> Self {
        Registry {
            actors: BTreeMap::new(),
            supervisors: BTreeMap::new(),
            computations: BTreeMap::new(),
            objects: BTreeMap::new(),
            unsupported: BTreeMap::new(),
        }
    }

    /// Adds an actor of another language; `new` creates its slot.
    ///
    /// It replaces an earlier actor with the same names.
    pub fn add_actor(
        &mut self,
        toolbox: &str,
        template: &str,
        new: impl Fn() -> Box<dyn ActorSlot<E>> + Send + Sync + 'static,
    ) {
        add(&mut self.actors, toolbox, template, Box::new(new));
    }

    /// Adds a supervisor of another language, like [`Registry::add_actor`].
    pub fn add_supervisor(
        &mut self,
        toolbox: &str,
        template: &str,
        new: impl Fn() -> Box<dyn SupervisorSlot<E>> + Send + Sync + 'static,
    ) {
        add(&mut self.supervisors, toolbox, template, Box::new(new));
    }

    /// Adds a computation of another language, like [`Registry::add_actor`].
    pub fn add_computation(
        &mut self,
        toolbox: &str,
        template: &str,
        new: impl Fn() -> Box<dyn ComputationSlot> + Send + Sync + 'static,
    ) {
        add(&mut self.computations, toolbox, template, Box::new(new));
    }

    /// Adds an object type with values of the Rust type `T`.
    pub fn add_object<T: Clone + Send + 'static>(&mut self, toolbox: &str, name: &str) {
        let new: NewCell = || Box::new(None::<T>) as Box<dyn ObjectCell>;
        add(&mut self.objects, toolbox, name, new);
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

    /// The traits that the platform lacks for a template; `None` if the template is unknown for
    /// another reason.
    pub(super) fn missing(&self, toolbox: &str, template: &str) -> Option<&[&'static str]> {
        find(&self.unsupported, toolbox, template).map(Vec::as_slice)
    }

    pub(super) fn object_cell(&self, toolbox: &str, name: &str) -> Option<NewCell> {
        find(&self.objects, toolbox, name).copied()
    }
}

fn add<T>(map: &mut Map<T>, toolbox: &str, name: &str, new: T) {
    map.entry(toolbox.to_owned()).or_default().insert(name.to_owned(), new);
}

fn find<'a, T>(map: &'a Map<T>, toolbox: &str, name: &str) -> Option<&'a T> {
    map.get(toolbox)?.get(name)
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
        A: Actor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome,
    {
        self.add_actor(toolbox, template, || Box::new(Slot::<T, A, Never>::new()));
    }

    fn resumable<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ActorTemplate + 'static,
        A: Resumable<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::State: Outcome,
    {
        self.add_actor(toolbox, template, || Box::new(Slot::<T, A, Always>::new()));
    }

    fn supervisor<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: SupervisorTemplate + 'static,
        A: Supervisor<T, E> + Clone + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        for<'a> T::Live<'a>: FromArgs<'a>,
        T::Event: Outcome,
    {
        self.add_supervisor(toolbox, template, || Box::new(Slot::<T, A>::new()));
    }

    fn computation<T, A>(&mut self, toolbox: &'static str, template: &'static str)
    where
        T: ComputationTemplate + 'static,
        A: Computation<T> + Send + 'static,
        for<'a> T::Inputs<'a>: FromArgs<'a>,
        T::State: Outcome,
    {
        self.add_computation(toolbox, template, || Box::new(Slot::<T, A>::new()));
    }

    fn object<T: Clone + Send + 'static>(&mut self, toolbox: &'static str, name: &'static str) {
        self.add_object::<T>(toolbox, name);
    }

    fn unsupported(
        &mut self,
        toolbox: &'static str,
        template: &'static str,
        missing: &[&'static str],
    ) {
        let missing = missing.iter().copied().filter(|name| !name.is_empty()).collect();
        // Removes the template of an earlier toolbox with this name.
        self.actors.get_mut(toolbox).and_then(|of| of.remove(template));
        self.supervisors.get_mut(toolbox).and_then(|of| of.remove(template));
        add(&mut self.unsupported, toolbox, template, missing);
    }
}
