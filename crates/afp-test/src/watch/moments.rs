//! The moments of a scenario: instants that the run determines.

use afp_core::Instant;
use afp_dsl::scenario::{Moment, MomentId};

use super::claims::{happens, holds};
use super::{Broken, Occurrence, State};

/// The moments so far.
pub(crate) struct Moments<'a> {
    moments: &'a [Moment],
    /// The instant of each, in nanoseconds.
    came: Vec<Option<u64>>,
    /// The unreported ones.
    unreported: Vec<MomentId>,
}

impl<'a> Moments<'a> {
    pub(super) fn new(moments: &'a [Moment]) -> Moments<'a> {
        Moments { moments, came: vec![None; moments.len()], unreported: Vec::new() }
    }

    /// The start of a window, in nanoseconds: zero without a moment, `None` before the moment.
    pub(super) fn begin(&self, from: Option<MomentId>) -> Option<u64> {
        from.map_or(Some(0), |from| self.came.get(from.index()).copied().flatten())
    }

    /// Whether there are new moments since [`Moments::take`].
    pub(crate) fn has_unreported(&self) -> bool {
        !self.unreported.is_empty()
    }

    pub(crate) fn take(&mut self) -> Vec<(MomentId, &'a Moment, Instant)> {
        let all = std::mem::take(&mut self.unreported).into_iter();
        let told = all.filter_map(|id| {
            let at = self.begin(Some(id))?;
            Some((id, self.moments.get(id.index())?, Instant::from_nanos(at)))
        });
        told.collect()
    }

    pub(super) fn on_occurrence(&mut self, at: u64, occurrence: &Occurrence) {
        self.come(at, |moment| happens(&moment.claim, occurrence));
    }

    pub(super) fn after_step(&mut self, at: u64, state: &State) {
        self.come(at, |moment| holds(&moment.claim, state) == Some(true));
    }

    fn come(&mut self, at: u64, is_now: impl Fn(&Moment) -> bool) {
        // A moment comes before the moments relative to it.
        for (number, moment) in (0..).zip(self.moments) {
            let is_open = self.came[usize::from(number)].is_none();
            if is_open && self.begin(moment.from).is_some() && is_now(moment) {
                self.came[usize::from(number)] = Some(at);
                self.unreported.push(MomentId(number));
            }
        }
    }

    /// Moments that did not occur by the end of the run, although they could have.
    pub(super) fn missed(&self, end: u64) -> impl Iterator<Item = Broken> {
        let could = |moment: &Moment| self.begin(moment.from).is_some();
        let all = self.moments.iter().zip(&self.came);
        let missed = all.filter(move |(moment, came)| came.is_none() && could(moment));
        missed.map(move |(moment, _)| Broken {
            text: moment.text.clone(),
            span: moment.span,
            at: Instant::from_nanos(end),
            why: format!("that never came: the run was over at {:.3} s", end as f64 / 1e9),
        })
    }
}
