//! The gaps between boxes, and the number of edges that fit into each.

use std::ops::RangeInclusive;

use super::{Axis, Bounds, PITCH, Point};

/// All gaps for lines of one axis: the plane in bands between the borders of boxes, each band in
/// its free intervals.
#[derive(Debug)]
pub(super) struct Gaps {
    axis: Axis,
    /// The borders between bands.
    borders: Vec<f64>,
    /// The first gap of each band, and one more at the end.
    starts: Vec<usize>,
    gaps: Vec<Gap>,
    /// The parts of kept edges, by position.
    kept: Vec<Kept>,
}

/// A free interval of a band.
#[derive(Clone, Copy, Debug)]
struct Gap {
    band: usize,
    /// Its end across.
    right: f64,
    /// The number of edges in it, and the number that fits.
    taken: u32,
    fits: u32,
    /// Whether kept edges are counted. If most edges are kept, few gaps are needed.
    counted: bool,
}

/// A part of an edge that passes a gap in each of some bands.
#[derive(Clone, Debug)]
struct Kept {
    at: f64,
    bands: RangeInclusive<usize>,
}

impl Gaps {
    /// The gaps between boxes, with the parts of this axis in `kept`.
    pub(super) fn new(boxes: &[Bounds], axis: Axis, kept: &[Vec<Point>]) -> Gaps {
        let mut ranges: Vec<_> = boxes.iter().map(|each| each.ranges(axis)).collect();
        ranges.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        let ends = ranges.iter().flat_map(|(_, (start, end))| [*start, *end]);
        let mut borders: Vec<f64> = ends.collect();
        borders.sort_by(f64::total_cmp);
        borders.dedup();
        let mut beside = vec![Vec::new(); borders.len() + 1];
        for (across, along) in ranges {
            for band in bands(&borders, along) {
                beside[band].push(across);
            }
        }
        let (mut starts, mut gaps) = (Vec::new(), Vec::new());
        for (band, beside) in beside.into_iter().enumerate() {
            starts.push(gaps.len());
            let mut left = f64::NEG_INFINITY;
            for (begin, end) in beside {
                if left <= begin {
                    gaps.push(Gap::new(band, left, begin));
                }
                left = left.max(end);
            }
            gaps.push(Gap::new(band, left, f64::INFINITY));
        }
        starts.push(gaps.len());
        let pairs = kept.iter().flat_map(|points| points.windows(2));
        let parts = pairs.filter(|pair| Axis::of(pair[0], pair[1]) == axis).map(|pair| {
            let (at, span) = axis.part(pair[0], pair[1]);
            Kept { at, bands: bands(&borders, span) }
        });
        let mut kept: Vec<_> = parts.collect();
        kept.sort_by(|a, b| a.at.total_cmp(&b.at));
        Gaps { axis, borders, starts, gaps, kept }
    }

    /// The gap around a place, along and across the axis.
    pub(super) fn at(&self, along: f64, across: f64) -> usize {
        self.within(self.borders.partition_point(|border| *border <= along), across)
    }

    /// The gap of a band around a coordinate across.
    fn within(&self, band: usize, across: f64) -> usize {
        let (first, end) = (self.starts[band], self.starts[band + 1]);
        let gaps = &self.gaps[first..end];
        let index = gaps.partition_point(|gap| gap.right < across);
        first + index.min(gaps.len() - 1)
    }

    /// The excess of edges in a gap with one more edge.
    pub(super) fn excess(&mut self, gap: usize) -> u32 {
        if !self.gaps[gap].counted {
            self.gaps[gap].taken += self.kept_in(gap);
            self.gaps[gap].counted = true;
        }
        let Gap { taken, fits, .. } = self.gaps[gap];
        (taken + 1).saturating_sub(fits)
    }

    /// The number of kept edges in a gap: those up to its right border that are not in an earlier
    /// gap.
    fn kept_in(&self, gap: usize) -> u32 {
        let Gap { band, right, .. } = self.gaps[gap];
        let is_first = gap == self.starts[band];
        let is_last = gap + 1 == self.starts[band + 1];
        let first = match is_first {
            true => 0,
            false => self.kept.partition_point(|kept| kept.at <= self.gaps[gap - 1].right),
        };
        let near = self.kept[first..].iter().take_while(|kept| is_last || kept.at <= right);
        let count = near.filter(|kept| kept.bands.contains(&band)).count();
        u32::try_from(count).unwrap_or(u32::MAX)
    }

    /// Adds this number of edges to the gaps along a line.
    pub(super) fn take(&mut self, at: f64, span: (f64, f64), edges: u32) {
        for band in bands(&self.borders, span) {
            let gap = self.within(band, at);
            self.gaps[gap].taken += edges;
        }
    }

    #[cfg(test)]
    pub(super) fn len(&self) -> usize {
        self.gaps.len()
    }

    pub(super) fn axis(&self) -> Axis {
        self.axis
    }
}

impl Gap {
    fn new(band: usize, left: f64, right: f64) -> Gap {
        Gap { band, right, taken: 0, fits: fits(right - left), counted: false }
    }
}

/// The bands along a line.
fn bands(borders: &[f64], (from, to): (f64, f64)) -> RangeInclusive<usize> {
    let first = borders.partition_point(|border| *border <= from);
    let last = borders.partition_point(|border| *border < to);
    first..=last.max(first)
}

/// The number of parallel edges that fit into this space.
fn fits(room: f64) -> u32 {
    let room = (room / PITCH).floor();
    if room < f64::from(u32::MAX) { room as u32 + 1 } else { u32::MAX }
}
