//! The flow between two pictures as a job.

use super::{OpticalFlow, Picture};
use afp_carbot::devices::{Grid, Shift};
use afp_core::{Duration, Fault, Job};

/// Two pictures, and after the run the flow between them.
#[derive(Clone)]
pub struct FlowJob<M> {
    pub(crate) before: Picture,
    pub(crate) after: Picture,
    pub(crate) grid: Grid,
    pub(crate) shifts: Vec<Option<Shift>>,
    method: M,
}

impl<M: OpticalFlow> FlowJob<M> {
    /// A job with buffers for pictures of this size.
    pub fn new(width: usize, height: usize, method: M) -> Self {
        let grid = super::grid(width, height);
        let picture = || Picture::new(width, height);
        let shifts = vec![None; grid.len()];
        FlowJob { before: picture(), after: picture(), grid, shifts, method }
    }

    /// Copies the pictures to compare.
    pub(crate) fn prepare(&mut self, before: &Picture, after: &Picture) {
        self.before.copy(before);
        self.after.copy(after);
        self.grid = super::grid(before.width(), before.height());
        self.shifts.clear();
        self.shifts.resize(self.grid.len(), None);
    }
}

impl<M: OpticalFlow> Job for FlowJob<M> {
    /// Several times the time of a desktop core for 160 x 120 pixels.
    const TAKES: Duration = Duration::from_millis(20);

    fn run(&mut self) -> Result<(), Fault> {
        self.method.flow(&self.before, &self.after, &self.grid, &mut self.shifts)
    }
}
