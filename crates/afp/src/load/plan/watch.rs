//! A supervisor of a loaded plan.

use std::sync::Arc;

use crate::load::inject::Injected;
use crate::load::outputs::{Binding, Inputs};
use crate::load::slots::SupervisorSlot;

pub(super) struct WatchSlot<E: ?Sized + 'static> {
    pub(super) inputs: Inputs,
    pub(super) outputs: Arc<[Binding]>,
    pub(super) slot: Box<dyn SupervisorSlot<E>>,
    pub(super) injected: Injected,
    /// Whether it may continue after a suspension.
    pub(super) resumable: bool,
}

impl<E: ?Sized + 'static> WatchSlot<E> {
    pub(super) fn clear(&mut self) {
        self.slot.clear();
        self.injected = None;
    }

    pub(super) fn try_clone(&self) -> Option<Self> {
        Some(WatchSlot {
            inputs: self.inputs.clone(),
            outputs: self.outputs.clone(),
            slot: self.slot.try_clone()?,
            injected: self.injected.clone(),
            resumable: self.resumable,
        })
    }
}
