//! Where the drawings of several plans stand in one picture: in rows, in the order in which the plans are met.

use super::polyline::Point;

/// Width by height that a picture should have: that of a screen or a slide.
pub(super) const WANTED: f64 = 4.0 / 3.0;

/// A picture that was arranged before stays so as long as neither side is more than so many times the other.
const MOST: f64 = 2.0;

/// Distance between the drawings of two plans.
const BETWEEN: f64 = 64.0;

/// Of so many drawings all runs are tried as the widest row, of more only those from the first one on.
const FEW: usize = 24;

/// Drawings in rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Arranged {
    /// The upper left corner of each drawing.
    pub(super) corners: Vec<Point>,
    /// Width and height of all together.
    pub(super) size: Point,
}

/// Arranges drawings of these sizes so that the whole comes nearest to the wanted ratio. Which of them began a row before is
/// kept while that does.
pub(super) fn arrange(sizes: &[Point], before: Option<&[bool]>) -> Arranged {
    let kept = before.map(|starts| in_rows(sizes, |at, _| starts.get(at) == Some(&true)));
    if let Some(kept) = kept.filter(|kept| kept.ratio().ln().abs() <= MOST.ln()) {
        return kept;
    }
    let row = |sizes: &[Point]| sizes.iter().map(|size| size.0 + BETWEEN).sum::<f64>() - BETWEEN;
    let least = sizes.iter().map(|size| size.0).fold(0.0, f64::max);
    let mut widths = vec![least];
    let firsts = if sizes.len() > FEW { 1 } else { sizes.len() };
    for first in 0..firsts {
        widths.extend((first + 1..=sizes.len()).map(|end| row(&sizes[first..end])));
    }
    let all = widths
        .into_iter()
        .filter(|width| *width >= least)
        .map(|most| in_rows(sizes, |_, width| width > most + 0.01));
    let far = |one: &Arranged| (one.ratio() / WANTED).ln().abs();
    // Among equals the narrowest is the first.
    all.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
}

/// Drawings one after the other; one begins a row if `begins` says so of its place and the width that the row would have.
fn in_rows(sizes: &[Point], begins: impl Fn(usize, f64) -> bool) -> Arranged {
    let mut all = Arranged::default();
    let (mut x, mut y) = (0.0, 0.0);
    for (at, (width, height)) in sizes.iter().enumerate() {
        if at > 0 && begins(at, x + width) {
            (x, y) = (0.0, all.size.1 + BETWEEN);
        }
        all.corners.push((x, y));
        all.size = (all.size.0.max(x + width), all.size.1.max(y + height));
        x += width + BETWEEN;
    }
    all
}

impl Arranged {
    /// Width by height.
    fn ratio(&self) -> f64 {
        self.size.0.max(1.0) / self.size.1.max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{BETWEEN, Point, arrange};

    /// The place of each drawing: its row and its place in that.
    fn places(sizes: &[Point], before: Option<&[bool]>) -> Vec<(usize, usize)> {
        let mut places: Vec<(usize, usize)> = Vec::new();
        for (x, _) in arrange(sizes, before).corners {
            let next = match places.last() {
                Some((row, place)) if x > 0.0 => (*row, place + 1),
                Some((row, _)) => (row + 1, 0),
                None => (0, 0),
            };
            places.push(next);
        }
        places
    }

    #[test]
    fn the_whole_comes_near_the_ratio_of_a_screen() {
        let (tall, wide, small) = ((500.0, 1000.0), (1000.0, 300.0), (200.0, 150.0));
        assert_eq!(places(&[tall, tall], None), [(0, 0), (0, 1)]);
        assert_eq!(places(&[wide, wide], None), [(0, 0), (1, 0)]);
        assert_eq!(places(&[small; 6], None)[3..], [(1, 0), (1, 1), (1, 2)]);
        assert_eq!(places(&[wide, small, small, small], None), [(0, 0), (1, 0), (1, 1), (1, 2)]);
        assert!(arrange(&[], None).corners.is_empty());
    }

    #[test]
    fn drawings_of_a_row_begin_at_one_height_and_keep_their_distance() {
        let found = arrange(&[(500.0, 900.0), (400.0, 1000.0)], None);
        assert_eq!(found.corners, [(0.0, 0.0), (500.0 + BETWEEN, 0.0)]);
        assert_eq!(found.size, (900.0 + BETWEEN, 1000.0));
    }

    #[test]
    fn what_was_arranged_stays_so_while_it_is_neither_too_wide_nor_too_high() {
        let before = [true, true];
        let grown = |height| places(&[(600.0, 400.0), (500.0, height)], Some(&before))[1];
        assert_eq!(places(&[(600.0, 400.0), (500.0, 500.0)], None)[1], (0, 1));
        assert_eq!(grown(500.0), (1, 0));
        assert_eq!(grown(1200.0), (0, 1), "too high");
    }

    #[test]
    fn many_drawings_are_arranged_too() {
        let sizes: Vec<Point> =
            (0..300).map(|at| (100.0 + f64::from(at % 7) * 30.0, 90.0)).collect();
        let (width, height) = arrange(&sizes, None).size;
        assert!((0.5..2.0).contains(&(width / height)), "{width} x {height}");
    }
}
