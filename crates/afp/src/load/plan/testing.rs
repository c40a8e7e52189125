//! Test support: injected outcomes and idle actors.

use afp_core::rt::Tables;
use afp_core::trace::ComponentId;
use afp_core::{ElementId, Environment};

use super::LoadedPlan;
use super::element::ElementSlot;
use crate::load::inject::{Injection, NotInjected};

impl<E: Environment + ?Sized + 'static> LoadedPlan<E> {
    /// Makes a component of the running plan report an outcome at its next poll, for tests. An
    /// actor is interrupted after its outputs are staged, so that it leaves the robot at rest.
    ///
    /// `active` is the active element of the plan, from its scheduler.
    ///
    /// # Errors
    /// The component is not being polled, or an earlier outcome is pending; nothing changes then.
    pub fn inject(
        &mut self,
        active: Option<ElementId>,
        injection: &Injection,
    ) -> Result<(), NotInjected> {
        let part = injection.component.0.checked_sub(1).ok_or(NotInjected::NotActive)?;
        self.inject_at(active, part, injection)
    }

    /// As [`LoadedPlan::inject`]; `part` counts from this plan's first element.
    pub(in crate::load) fn inject_at(
        &mut self,
        active: Option<ElementId>,
        part: u32,
        injection: &Injection,
    ) -> Result<(), NotInjected> {
        let active = active.ok_or(NotInjected::NotActive)?;
        let (elements, supervisors) = (self.elements.len() as u32, self.supervisors.len() as u32);
        if part < elements {
            let slot = self.elements.get_mut(part as usize).ok_or(NotInjected::NotActive)?;
            return match u32::from(active.0) == part {
                true => slot.inject(injection),
                false => Err(NotInjected::NotActive),
            };
        }
        if let Some(number) = part.checked_sub(elements).filter(|number| *number < supervisors) {
            let table = self.tables.table();
            let locals =
                table.element(active).map(|row| row.locals).ok_or(NotInjected::NotActive)?;
            let is_local = locals.supervisors().any(|local| u32::from(local.0) == number);
            if number >= u32::from(table.globals) && !is_local {
                return Err(NotInjected::NotActive);
            }
            let watch = self.supervisors.get_mut(number as usize).ok_or(NotInjected::NotActive)?;
            return injection.put(&mut watch.injected);
        }
        self.elements
            .get_mut(active.index())
            .ok_or(NotInjected::NotActive)?
            .inject_inside(part, injection)
    }

    /// Makes an actor, or all actors of a sub-plan, idle from their next start on, for tests. They
    /// are active until they are interrupted or made to report a state. `None` means all actors.
    ///
    /// Returns whether the element exists.
    pub fn idle(&mut self, element: Option<ComponentId>) -> bool {
        let Some(element) = element else {
            self.idle_all();
            return true;
        };
        element.0.checked_sub(1).is_some_and(|part| self.idle_at(part))
    }

    pub(in crate::load) fn idle_all(&mut self) {
        self.elements.iter_mut().for_each(ElementSlot::idle);
    }

    /// As [`LoadedPlan::idle`]; `part` counts from this plan's first element.
    pub(in crate::load) fn idle_at(&mut self, part: u32) -> bool {
        match self.elements.get_mut(part as usize) {
            Some(element) => {
                element.idle();
                true
            }
            // The parts of a sub-plan are consecutive, so at most one sub-plan has it.
            None => self.elements.iter_mut().any(|element| element.idle_inside(part)),
        }
    }
}
