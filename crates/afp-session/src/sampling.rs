//! Who gets the samples of an instant.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use afp_core::devices::{DeviceRow, SignalId, SignalType, signals};
use afp_core::{Fault, Instant, Reason};

use crate::observer::{Observer, Sampling};
use crate::sample::SampleRef;
use crate::session::grid::Stretch;

/// A signal is given as another type than its toolbox declares.
const SIGNAL_TYPE: &str = "signal-type";

/// Takes the samples of an instant from a robot and gives each to whoever wants it.
pub struct Samples<'a, 'o> {
    at: Instant,
    /// What the robot declares.
    table: &'static [DeviceRow],
    to: To<'a, 'o>,
    /// What was wrong with the first sample that is of another type than is declared.
    wrong: Option<Fault>,
}

enum To<'a, 'o> {
    /// Those observers whose turn it is.
    Observers(&'a mut [&'o mut dyn Observer], Turn),
    /// Somebody who asks for one signal.
    One(SignalId, &'a mut dyn FnMut(SampleRef<'_>)),
}

/// Whose turn it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// Those of whose grid an instant has come; those that sample at each step have their turn after it, where
    /// there is one.
    Grid {
        /// Whether a step is about to be made.
        before_step: bool,
        /// What has come since the last time.
        stretch: Stretch,
    },
    /// A step is over: those that sample at each step.
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

    /// Whether anybody wants a signal: to be asked before what is dear to compute.
    pub fn wants(&self, signal: SignalId) -> bool {
        match &self.to {
            To::Observers(all, turn) => {
                all.iter().any(|each| turn.includes(each.sampling()) && each.wants(self.at, signal))
            }
            To::One(wanted, _) => *wanted == signal,
        }
    }

    /// Gives a sample to whoever wants it. One of another type than the robot's toolbox declares ends the run in `Error`.
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

    /// The samples of this instant are complete; what was wrong with one of them, if something was.
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
    /// Whether it is the turn of an observer of that sampling.
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

/// What is wrong with a sample: it is of another type than the table declares.
fn wrong_type(table: &[DeviceRow], signal: SignalId, value: &SampleRef<'_>) -> Option<Fault> {
    let (_, device, row) = signals(table).nth(signal.0.into())?;
    match value.is(row.ty) {
        true => None,
        false => Some(signal_type(format!(
            "the robot gives its signal '{}.{}' as {}, but it is declared as {}",
            device.name,
            row.name,
            value.ty().word(),
            declared(row.ty)
        ))),
    }
}

/// A fault points to its words: those of each signal are kept once, as long as the program runs.
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
