//! Elements that are set aside.

use afp_core::Instant;
use afp_core::trace::ComponentId;

use super::{Occurrence, State, Watch};

impl Watch<'_> {
    /// A set-aside element and everything inside it is not active.
    pub(super) fn set_aside(&mut self, at: Instant, element: ComponentId) {
        for id in 0..self.since.len() as u32 {
            let owner = |id: &u32| {
                let place = self.places.get(*id as usize)?;
                Some(place.owner.unwrap_or(place.plan)).filter(|owner| owner != id)
            };
            if std::iter::successors(Some(id), owner).any(|id| id == element.0) {
                self.set_active(at, ComponentId(id), false);
            }
        }
        self.state.set_suspended(element, true);
    }

    /// An element that was set aside is given up.
    pub(super) fn abandoned(&mut self, at: Instant, element: ComponentId, started: bool) {
        self.state.set_suspended(element, false);
        if started {
            self.on_occurrence(at, &Occurrence::Interrupt(element.0));
        }
    }
}

impl State {
    pub(super) fn set_suspended(&mut self, element: ComponentId, suspended: bool) {
        if let Some(known) = self.suspended.get_mut(element.0 as usize) {
            *known = suspended;
        }
    }
}
