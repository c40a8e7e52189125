//! What a robot's own Rust does wrong: nothing that it says or does can be trusted then, and the run ends in `Error`.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use afp_core::devices::{DeviceRow, SignalId, SignalType, signals};
use afp_core::rt::{NamedPlan, Plan};
use afp_core::{Fault, Instant, Reason};

use super::Session;
use crate::observer::Observer;
use crate::record::Keep;
use crate::robot::Robot;
use crate::sample::SampleRef;

/// So often in a row the time of a simulated robot may stand still.
const PATIENCE: u32 = 1_000;

/// The time of a simulated robot does not go on.
const STUCK: Fault = Fault::new(&Reason {
    code: "robot-stuck",
    text: "the robot's time does not go on: 'advance' must bring 'now' up to the instant",
});
/// A signal is given as another type than its toolbox declares.
const SIGNAL_TYPE: &str = "signal-type";

impl<P, R, S> Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep,
{
    /// Time was to pass up to an instant and has not.
    #[cold]
    pub(super) fn stood_still(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        self.still = self.still.saturating_add(1);
        // That of a robot that is there passes by itself.
        if self.still >= PATIENCE && !self.is_there {
            self.distrust(STUCK, to);
            // A robot that never comes to rest is not waited for.
            self.last = now;
        }
    }

    /// Ends the plan, if it has not ended, because of what the robot's own Rust did.
    pub(super) fn distrust(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        if self.ending().is_none() {
            self.abort(fault, to);
        }
    }
}

/// What is wrong with a sample: it is of another type than the table declares.
pub(crate) fn wrong_type(
    table: &[DeviceRow],
    signal: SignalId,
    value: &SampleRef<'_>,
) -> Option<Fault> {
    let (_, device, row) = signals(table).nth(signal.0.into())?;
    match value.is(row.ty) {
        true => None,
        false => Some(signal_type(format!(
            "the robot gives its signal '{}.{}' as {}, but it is declared as {}",
            device.name,
            row.name,
            given(value),
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
    let word = match ty {
        SignalType::Bool => "bool",
        SignalType::Int => "int",
        SignalType::Float("") => "float",
        SignalType::Float(unit) => return format!("a quantity in {unit}"),
        SignalType::Text => "string",
        SignalType::Pose => "pose",
        SignalType::Range => "range",
        SignalType::Image => "image",
        SignalType::Outline => "outline",
    };
    word.to_owned()
}

fn given(value: &SampleRef<'_>) -> &'static str {
    match value {
        SampleRef::Bool(_) => "bool",
        SampleRef::Int(_) => "int",
        SampleRef::Float(_) => "float",
        SampleRef::Text(_) => "string",
        SampleRef::Pose(_) => "pose",
        SampleRef::Range(_) => "range",
        SampleRef::Image(_) => "image",
        SampleRef::Outline(_) => "outline",
    }
}
