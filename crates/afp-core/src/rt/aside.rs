//! The place of a plan's element that is set aside.

use afp_types::{ElementId, Instant, SupervisorId};

/// The element of a plan that is set aside while a handler is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetAside {
    pub element: ElementId,
    /// Whether it had started; otherwise the event came in its look.
    pub started: bool,
    /// The local supervisor whose event set it aside, if it was a local supervisor.
    pub by: Option<SupervisorId>,
    /// When it was suspended.
    pub since: Instant,
    /// Since when its supervisors are not polled.
    pub silent: Instant,
}

/// Storage for the element of a plan that is set aside. A plan without `suspend` stores nothing.
pub trait Aside: Default + Clone + Send {
    /// Whether the plan has a `suspend`.
    const USED: bool;

    fn get(&self) -> Option<SetAside>;

    fn set(&mut self, to: Option<SetAside>);
}

impl Aside for () {
    const USED: bool = false;

    #[inline(always)]
    fn get(&self) -> Option<SetAside> {
        None
    }

    #[inline(always)]
    fn set(&mut self, _: Option<SetAside>) {}
}

impl Aside for Option<SetAside> {
    const USED: bool = true;

    fn get(&self) -> Option<SetAside> {
        *self
    }

    fn set(&mut self, to: Option<SetAside>) {
        *self = to;
    }
}
