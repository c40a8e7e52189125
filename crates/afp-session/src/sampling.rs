//! Distributes the samples of an instant.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use afp_core::devices::{DeviceRow, SignalId, SignalType, signals};
use afp_core::{Fault, Instant, Reason};

use crate::observer::{Observer, Sampling};
use crate::sample::SampleRef;
use crate::session::grid::Stretch;

const SIGNAL_TYPE: &str = "signal-type";

/// Takes the samples of an instant from a robot and gives them to the observers that want them.
pub struct Samples<'a, 'o> {
    at: Instant,
    table: &'static [DeviceRow],
    to: To<'a, 'o>,
    /// The fault of the first sample with a wrong type.
    wrong: Option<Fault>,
}

enum To<'a, 'o> {
    /// The observers whose turn it is.
    Observers(&'a mut [&'o mut dyn Observer], Turn),
    /// A reader of one signal.
    One(SignalId, &'a mut dyn FnMut(SampleRef<'_>)),
}

/// The observers whose turn it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// Those with a grid point in `stretch`. If a step follows, those that sample after steps wait
    /// for it.
    Grid {
        /// Whether a step follows.
        before_step: bool,
        /// The time since the last turn.
        stretch: Stretch,
    },
    /// Those that sample after each step.
    Step,
}

impl<'a, 'o> Samples<'a, 'o> {
    pub(crate) fn of_turn(
        at: Instant,
        table: &'static [DeviceRow],
        to: &'a mut [&'o mut dyn Observer],
        turn: Turn,
    ) -> Self {
        Samples { at, table, to: To::Observers(to, turn), wrong: None }
    }

    pub(crate) fn of_one(
        at: Instant,
        table: &'static [DeviceRow],
        signal: SignalId,
        to: &'a mut dyn FnMut(SampleRef<'_>),
    ) -> Self {
        Samples { at, table, to: To::One(signal, to), wrong: None }
    }

    /// Whether an observer wants a signal; for signals that are expensive to compute.
    pub fn wants(&self, signal: SignalId) -> bool {
        match &self.to {
            To::Observers(all, turn) => {
                all.iter().any(|each| turn.includes(each.sampling()) && each.wants(self.at, signal))
            }
            To::One(wanted, _) => *wanted == signal,
        }
    }

    /// Gives a sample to the observers that want it. A type other than the declared one ends the
    /// run in `Error`.
    pub fn put(&mut self, signal: SignalId, value: SampleRef<'_>) {
        if let Some(wrong) = wrong_type(self.table, signal, &value) {
            self.wrong.get_or_insert(wrong);
            return;
        }
        match &mut self.to {
            To::Observers(all, turn) => {
                for each in all.iter_mut() {
                    if turn.includes(each.sampling()) && each.wants(self.at, signal) {
                        each.on_sample(self.at, signal, value);
                    }
                }
            }
            To::One(wanted, to) if *wanted == signal => to(value),
            To::One(..) => {}
        }
    }

    /// Ends the samples of this instant. Returns the fault of a sample, if there was one.
    pub(crate) fn finish(self) -> Option<Fault> {
        if let To::Observers(all, turn) = self.to {
            for each in all.iter_mut() {
                if turn.includes(each.sampling()) {
                    each.after_samples(self.at);
                }
            }
        }
        self.wrong
    }
}

impl Turn {
    fn includes(self, sampling: Sampling) -> bool {
        match (self, sampling) {
            (_, Sampling::Never) | (Turn::Step, Sampling::Every(_)) => false,
            (Turn::Grid { stretch, .. }, Sampling::Every(every)) => stretch.has_multiple_of(every),
            (Turn::Grid { before_step, stretch }, Sampling::Following(every)) => {
                !before_step && stretch.has_multiple_of(every)
            }
            (Turn::Step, Sampling::Following(_)) => true,
        }
    }
}

/// The fault of a sample whose type is not the declared one.
fn wrong_type(table: &[DeviceRow], signal: SignalId, value: &SampleRef<'_>) -> Option<Fault> {
    let (_, device, row) = signals(table).nth(signal.0.into())?;
    match value.is(row.ty) {
        true => None,
        false => Some(signal_type(format!(
            "the robot returns its signal '{}.{}' as {}, but the toolbox declares {}",
            device.name,
            row.name,
            value.ty().word(),
            declared(row.ty)
        ))),
    }
}

/// A fault refers to a static text; the texts are leaked, one for each signal.
#[cold]
fn signal_type(text: String) -> Fault {
    static KNOWN: Mutex<BTreeMap<String, &'static Reason>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let reason = known.entry(text).or_insert_with_key(|text| {
        let text = Box::leak(text.clone().into_boxed_str());
        Box::leak(Box::new(Reason { code: SIGNAL_TYPE, text }))
    });
    Fault::new(reason)
}

fn declared(ty: SignalType) -> String {
    match ty {
        SignalType::Float(unit) if !unit.is_empty() => format!("a quantity in {unit}"),
        ty => ty.word().to_owned(),
    }
}
