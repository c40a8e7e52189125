//! A map: the faces of known obstacles.

use nalgebra::Vector2;

/// One side of an obstacle, seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Face {
    /// The obstacle is to the left of the direction from `from` to `to`.
    pub(crate) from: Vector2<f64>,
    pub(crate) to: Vector2<f64>,
    /// The outward unit normal.
    pub(crate) normal: Vector2<f64>,
}

/// A map: the outlines of permanent obstacles that are high enough for the range sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    outlines: Vec<Vec<Vector2<f64>>>,
    faces: Vec<Face>,
    low: Vector2<f64>,
    high: Vector2<f64>,
}

impl Map {
    /// A map of convex outlines: metres, counter-clockwise. Outlines with less than three corners
    /// are left out.
    pub fn new(outlines: impl IntoIterator<Item = Vec<[f64; 2]>>) -> Self {
        let solid = outlines.into_iter().filter(|corners| corners.len() > 2);
        let outlines: Vec<Vec<_>> =
            solid.map(|corners| corners.into_iter().map(Vector2::from).collect()).collect();
        let corners = || outlines.iter().flatten();
        let low = corners().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
        let high = corners().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
        let faces = outlines.iter().flat_map(|outline| faces(outline)).collect();
        Map { outlines, faces, low, high }
    }

    /// The lower left and the upper right corner of all obstacles, in metres; the origin for an
    /// empty map.
    pub fn bounds(&self) -> [[f64; 2]; 2] {
        [self.low.into(), self.high.into()]
    }

    /// Whether a place is inside of an obstacle.
    pub fn is_solid(&self, place: [f64; 2]) -> bool {
        let place = Vector2::from(place);
        let left_of =
            |from: &Vector2<f64>, to: &Vector2<f64>| (to - from).perp(&(place - from)) > 0.0;
        let inside = |outline: &Vec<Vector2<f64>>| {
            let next = outline.iter().cycle().skip(1);
            outline.iter().zip(next).all(|(from, to)| left_of(from, to))
        };
        self.outlines.iter().any(inside)
    }

    pub(crate) fn outlines(&self) -> &[Vec<Vector2<f64>>] {
        &self.outlines
    }

    pub(crate) fn faces(&self) -> &[Face] {
        &self.faces
    }
}

fn faces(outline: &[Vector2<f64>]) -> impl Iterator<Item = Face> {
    let next = outline.iter().cycle().skip(1);
    outline.iter().zip(next).filter_map(|(&from, &to)| {
        let along = (to - from).try_normalize(1e-9)?;
        Some(Face { from, to, normal: Vector2::new(along.y, -along.x) })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_only_solid_inside_of_an_outline() {
        let map =
            Map::new([vec![[1.0, 1.0], [2.0, 1.0], [2.0, 3.0], [1.0, 3.0]], vec![[0.0, 0.0]]]);
        assert!(map.is_solid([1.5, 2.9]));
        assert!(!map.is_solid([0.9, 2.0]) && !map.is_solid([1.5, 3.1]));
        assert_eq!(map.bounds(), [[1.0, 1.0], [2.0, 3.0]]);
        assert_eq!(map.faces().len(), 4);
        assert!(Map::new([]).faces().is_empty());
    }
}
