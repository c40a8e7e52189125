//! Arranges the drawings of several plans in one picture: in rows, in the order of the plans.

use super::polyline::Point;

/// The wanted width by height of a picture, for a screen or a slide.
pub(super) const WANTED: f64 = 4.0 / 3.0;

/// Distance between the drawings of two plans.
const BETWEEN: f64 = 64.0;

/// Up to this number of drawings, each run of drawings is tried as the widest row. For more
/// drawings, only the runs from the first drawing are tried.
const FEW: usize = 24;

/// Drawings in rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Arranged {
    /// The upper left corner of each drawing.
    pub(super) corners: Vec<Point>,
    /// Width and height of the whole.
    pub(super) size: Point,
}

/// Arranges drawings of these sizes so that the whole is nearest to the wanted ratio.
pub(super) fn arrange(sizes: &[Point]) -> Arranged {
    let row = |sizes: &[Point]| sizes.iter().map(|size| size.0 + BETWEEN).sum::<f64>() - BETWEEN;
    let least = sizes.iter().map(|size| size.0).fold(0.0, f64::max);
    let mut widths = vec![least];
    let firsts = if sizes.len() > FEW { 1 } else { sizes.len() };
    for first in 0..firsts {
        widths.extend((first + 1..=sizes.len()).map(|end| row(&sizes[first..end])));
    }
    let all =
        widths.into_iter().filter(|width| *width >= least).map(|most| in_rows(sizes, most + 0.01));
    let far = |one: &Arranged| (one.ratio() / WANTED).ln().abs();
    // Among equal widths, the narrowest comes first.
    all.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
}

/// Drawings in rows of at most this width.
fn in_rows(sizes: &[Point], most: f64) -> Arranged {
    let mut all = Arranged::default();
    let (mut x, mut y) = (0.0, 0.0);
    for (at, (width, height)) in sizes.iter().enumerate() {
        if at > 0 && x + width > most {
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

    /// The place of each drawing: its row and its position in the row.
    fn places(sizes: &[Point]) -> Vec<(usize, usize)> {
        let mut places: Vec<(usize, usize)> = Vec::new();
        for (x, _) in arrange(sizes).corners {
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
    fn the_whole_is_near_the_ratio_of_a_screen() {
        let (tall, wide, small) = ((500.0, 1000.0), (1000.0, 300.0), (200.0, 150.0));
        assert_eq!(places(&[tall, tall]), [(0, 0), (0, 1)]);
        assert_eq!(places(&[wide, wide]), [(0, 0), (1, 0)]);
        assert_eq!(places(&[small; 6])[3..], [(1, 0), (1, 1), (1, 2)]);
        assert_eq!(places(&[wide, small, small, small]), [(0, 0), (1, 0), (1, 1), (1, 2)]);
        assert!(arrange(&[]).corners.is_empty());
    }

    #[test]
    fn drawings_of_a_row_have_the_same_top_and_keep_their_distance() {
        let found = arrange(&[(500.0, 900.0), (400.0, 1000.0)]);
        assert_eq!(found.corners, [(0.0, 0.0), (500.0 + BETWEEN, 0.0)]);
        assert_eq!(found.size, (900.0 + BETWEEN, 1000.0));
    }

    #[test]
    fn many_drawings_are_arranged_too() {
        let sizes: Vec<Point> =
            (0..300).map(|at| (100.0 + f64::from(at % 7) * 30.0, 90.0)).collect();
        let (width, height) = arrange(&sizes).size;
        assert!((0.5..2.0).contains(&(width / height)), "{width} x {height}");
    }
}
