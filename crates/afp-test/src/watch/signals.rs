//! The robot's signals in expectations.

use afp_core::devices::{DeviceRow, SignalId, SignalType, find_signal, signals};
use afp_dsl::scenario::{Claim, Field, Operand, Part, Scenario, Subject};
use afp_session::SampleRef;

use super::{Held, apart};

/// The signals in expectations and moments, with their values.
#[derive(Default)]
pub(crate) struct Signals(Vec<Followed>);

struct Followed {
    signal: Part,
    field: Option<Field>,
    id: SignalId,
    /// The SI unit, empty for other types.
    unit: &'static str,
    said: Said,
    /// Whether it sent a value at this instant.
    is_heard: bool,
}

/// The last value of a signal.
enum Said {
    /// No value yet.
    Nothing,
    /// Nothing was measured, for example without an echo, or the signal has stopped.
    Empty,
    Value(Held),
}

impl Signals {
    /// Collects the signals in a scenario's expectations and moments.
    ///
    /// # Errors
    /// The first signal that the robot does not have.
    pub(crate) fn new(scenario: &Scenario, table: &'static [DeviceRow]) -> Result<Signals, Part> {
        let mut all: Vec<Followed> = Vec::new();
        let expected = scenario.expectations.iter().map(|each| &each.claim);
        let claims = expected.chain(scenario.moments.iter().map(|each| &each.claim));
        for (signal, field) in claims.flat_map(signals_of) {
            let known = |each: &Followed| each.signal == *signal && each.field == field;
            if all.iter().any(known) {
                continue;
            }
            let id = find_signal(table, &signal.device, &signal.name);
            let id = id.ok_or_else(|| signal.clone())?;
            let unit = unit(table, id, field);
            let (signal, said, is_heard) = (signal.clone(), Said::Nothing, false);
            all.push(Followed { signal, field, id, unit, said, is_heard });
        }
        Ok(Signals(all))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether an expectation uses a signal.
    pub(crate) fn wants(&self, id: SignalId) -> bool {
        self.0.iter().any(|each| each.id == id)
    }

    pub(crate) fn set(&mut self, id: SignalId, value: SampleRef<'_>) {
        for each in self.0.iter_mut().filter(|each| each.id == id) {
            each.said = said(value, each.field);
            each.is_heard = true;
        }
    }

    /// Ends the signals of an instant: a silent signal has no value any longer.
    pub(crate) fn after_samples(&mut self) {
        for each in &mut self.0 {
            let is_heard = std::mem::take(&mut each.is_heard);
            if !is_heard && matches!(each.said, Said::Value(_)) {
                each.said = Said::Empty;
            }
        }
    }

    /// The value of a signal: the inner `None` means no measurement, the outer one that it has not
    /// sent anything yet.
    pub(super) fn said(&self, signal: &Part, field: Option<Field>) -> Option<Option<Held>> {
        match &self.find(signal, field)?.said {
            Said::Nothing => None,
            Said::Empty => Some(None),
            Said::Value(value) => Some(Some(value.clone())),
        }
    }

    /// The final value of a signal for a message, distinguishable from another value; `None` if it
    /// has never sent one.
    pub(super) fn shown(
        &self,
        signal: &Part,
        field: Option<Field>,
        other: Option<&Held>,
    ) -> Option<String> {
        let each = self.find(signal, field)?;
        Some(match &each.said {
            Said::Nothing => return None,
            Said::Empty => "nothing".to_owned(),
            Said::Value(Held::Text(text)) => format!("\"{text}\""),
            Said::Value(Held::Float(number)) => apart(*number, each.unit, other),
            Said::Value(value) => value.to_string(),
        })
    }

    fn find(&self, signal: &Part, field: Option<Field>) -> Option<&Followed> {
        self.0.iter().find(|each| each.signal == *signal && each.field == field)
    }
}

fn signals_of(claim: &Claim) -> impl Iterator<Item = (&Part, Option<Field>)> {
    let both = match claim {
        Claim::Compare { left, right: Operand::Subject(right), .. } => [Some(left), Some(right)],
        Claim::Compare { left, .. } => [Some(left), None],
        _ => [None, None],
    };
    both.into_iter().flatten().filter_map(|subject| match subject {
        Subject::Signal(signal, field) => Some((signal, *field)),
        Subject::Entry(_) => None,
    })
}

fn said(value: SampleRef<'_>, field: Option<Field>) -> Said {
    Said::Value(match (value, field) {
        (SampleRef::Pose(frame), Some(Field::X)) => Held::Float(frame.pose.x),
        (SampleRef::Pose(frame), Some(Field::Y)) => Held::Float(frame.pose.y),
        (SampleRef::Pose(frame), Some(Field::Heading)) => Held::Float(frame.pose.heading),
        (SampleRef::Range(reading), Some(Field::Distance)) => match reading.range {
            Some(range) => Held::Float(range),
            None => return Said::Empty,
        },
        // The compiler checks that the type has the part.
        (value, _) => match value.value() {
            // Signals never hold enum values or objects.
            Some(value) => value.map(|text| text, |_| 0, |_| 0),
            None => return Said::Empty,
        },
    })
}

fn unit(table: &'static [DeviceRow], id: SignalId, field: Option<Field>) -> &'static str {
    let row = signals(table).find(|(known, ..)| *known == id);
    match (row.map(|(_, _, row)| row.ty), field) {
        (Some(SignalType::Float(unit)), _) => unit,
        (_, Some(Field::Heading)) => "rad",
        (_, Some(_)) => "m",
        _ => "",
    }
}
