//! The localisation error over a run.

use crate::truth::Pose;
use afp_session::{Figure, FigureValue};
use std::f64::consts::TAU;

/// The bins of the errors: half a centimetre up to 2 m, and half a degree up to 180.
const METRES: f64 = 0.005;
const DEGREES: f64 = 0.5;
const BINS: usize = 400;

#[derive(Clone, Debug)]
pub(crate) struct Located {
    off: [u32; BINS],
    turned: [u32; BINS],
    count: u32,
    /// Metres and radians.
    last: [f64; 2],
    worst: f64,
}

impl Default for Located {
    fn default() -> Self {
        Located { off: [0; BINS], turned: [0; BINS], count: 0, last: [0.0; 2], worst: 0.0 }
    }
}

impl Located {
    pub(super) fn note(&mut self, truth: Pose, believed: Pose) {
        let off = libm::hypot(believed.x - truth.x, believed.y - truth.y);
        let turn = believed.heading - truth.heading;
        let turned = (turn - TAU * libm::round(turn / TAU)).abs();
        let degrees = turned.to_degrees();
        for (bins, at) in [(&mut self.off, off / METRES), (&mut self.turned, degrees / DEGREES)] {
            if let Some(bin) = bins.get_mut((at as usize).min(BINS - 1)) {
                *bin += 1;
            }
        }
        self.count += 1;
        self.worst = self.worst.max(off);
        self.last = [off, turned];
    }

    /// The latest error, in metres and radians; `None` while the localisation is unused.
    pub(crate) fn last(&self) -> Option<[f64; 2]> {
        (self.count > 0).then_some(self.last)
    }

    /// The results of the run; `None` if the localisation was unused.
    pub(crate) fn figure(&self) -> Option<Figure> {
        self.last()?;
        let (metres, degrees) = (self.p95(&self.off) * METRES, self.p95(&self.turned) * DEGREES);
        let (last_m, last_deg) = (self.last[0], self.last[1].to_degrees());
        let text = format!(
            "95 % within {:.1} cm and {degrees:.1} deg, {:.0} cm at most; {:.1} cm and {last_deg:.1} deg at the end",
            metres * 100.0,
            self.worst * 100.0,
            last_m * 100.0
        );
        let numbers = vec![
            ("p95_m", metres),
            ("p95_deg", degrees),
            ("max_m", self.worst),
            ("last_m", last_m),
            ("last_deg", last_deg),
        ];
        let value = FigureValue::Numbers(numbers);
        Some(Figure { name: "localisation_error", value, text })
    }

    /// The upper end of the bin with the 95th percentile.
    fn p95(&self, bins: &[u32]) -> f64 {
        let mut below = 0;
        let most = bins.iter().position(|bin| {
            below += bin;
            f64::from(below) >= 0.95 * f64::from(self.count)
        });
        most.map_or(BINS, |bin| bin + 1) as f64
    }
}
