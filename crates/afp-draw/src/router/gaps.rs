//! The gaps between boxes, and how many edges fit into each.

use super::{Axis, Bounds, PITCH};

/// All gaps that lines of one axis go through: the plane in bands between the borders of boxes,
/// each band in the intervals that are free.
#[derive(Debug)]
pub(super) struct Gaps {
    axis: Axis,
    /// The borders between bands.
    borders: Vec<f64>,
    /// The first gap of each band; one more at the end.
    starts: Vec<usize>,
    /// The free intervals across.
    free: Vec<(f64, f64)>,
    /// How many edges take each gap, and how many fit into it.
    taken: Vec<(u32, u32)>,
}

impl Gaps {
    pub(super) fn new(boxes: &[Bounds], axis: Axis) -> Gaps {
        let ranges: Vec<_> = boxes.iter().map(|each| each.ranges(axis)).collect();
        let mut borders: Vec<f64> =
            ranges.iter().flat_map(|(_, (start, end))| [*start, *end]).collect();
        borders.sort_by(f64::total_cmp);
        borders.dedup();
        let mut sorted = ranges;
        sorted.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let mut gaps =
            Gaps { axis, borders, starts: Vec::new(), free: Vec::new(), taken: Vec::new() };
        for band in 0..=gaps.borders.len() {
            gaps.starts.push(gaps.free.len());
            let start = band.checked_sub(1).map_or(f64::NEG_INFINITY, |index| gaps.borders[index]);
            let end = gaps.borders.get(band).copied().unwrap_or(f64::INFINITY);
            let mut free_from = f64::NEG_INFINITY;
            for ((left, right), along) in &sorted {
                if along.0 < end && start < along.1 {
                    if free_from <= *left {
                        gaps.free.push((free_from, *left));
                    }
                    free_from = free_from.max(*right);
                }
            }
            gaps.free.push((free_from, f64::INFINITY));
        }
        gaps.starts.push(gaps.free.len());
        gaps.taken = gaps.free.iter().map(|gap| (0, fits(*gap))).collect();
        gaps
    }

    /// The gap around a place, given along and across the axis.
    pub(super) fn at(&self, along: f64, across: f64) -> usize {
        self.within(self.borders.partition_point(|border| *border <= along), across)
    }

    /// The gap of a band around a place across.
    fn within(&self, band: usize, across: f64) -> usize {
        let (first, end) = (self.starts[band], self.starts[band + 1]);
        let free = &self.free[first..end];
        let index = free.partition_point(|(_, right)| *right < across);
        first + index.min(free.len() - 1)
    }

    /// How many more edges a gap has than fit into it, if it gets another one.
    pub(super) fn excess(&self, gap: usize) -> u32 {
        let (taken, fits) = self.taken[gap];
        (taken + 1).saturating_sub(fits)
    }

    /// Takes the gaps from one end of a line to the other for so many edges.
    pub(super) fn take(&mut self, at: f64, (from, to): (f64, f64), edges: u32) {
        let first = self.borders.partition_point(|border| *border <= from);
        let last = self.borders.partition_point(|border| *border < to);
        for band in first..=last.max(first) {
            let gap = self.within(band, at);
            self.taken[gap].0 += edges;
        }
    }

    pub(super) fn axis(&self) -> Axis {
        self.axis
    }
}

/// How many edges fit into a gap side by side.
fn fits((left, right): (f64, f64)) -> u32 {
    let room = ((right - left) / PITCH).floor();
    if room < f64::from(u32::MAX) { room as u32 + 1 } else { u32::MAX }
}
