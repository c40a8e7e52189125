//! Checks of single values, reported at their keys.

use crate::truth::Pose;
use crate::world::error::at_key;
use crate::world::limits::{FARTHEST, SMALLEST};
use afp_session::WorldError;

/// Nearer corners count as one, in metres; the edges of a corner turn by at least this, in square
/// metres.
const SAME: f64 = 1e-6;
const FLAT: f64 = 1e-9;

#[derive(Clone)]
pub(super) struct Key(Vec<String>);

impl Key {
    pub(super) fn root() -> Self {
        Key(Vec::new())
    }

    pub(super) fn at(&self, name: &str) -> Self {
        let mut path = self.0.clone();
        path.push(name.to_owned());
        Key(path)
    }

    pub(super) fn nth(&self, name: &str, i: usize) -> Self {
        self.at(name).at(&i.to_string())
    }
}

pub(super) struct Check<'a> {
    text: &'a str,
}

impl<'a> Check<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Check { text }
    }

    pub(super) fn pose(&self, key: &Key, [x, y, degrees]: [f64; 3]) -> Result<Pose, WorldError> {
        self.near(key, &[x, y])?;
        self.near(key, &[degrees])?;
        Ok(Pose { x, y, heading: degrees * (std::f64::consts::PI / 180.0) })
    }

    /// A share above 0 up to 1; 1 if absent.
    pub(super) fn share(&self, key: &Key, share: Option<f64>) -> Result<f64, WorldError> {
        let share = share.unwrap_or(1.0);
        if share > 0.0 && share <= 1.0 {
            return Ok(share);
        }
        Err(self.error(
            key,
            &format!("{} is not above 0 and at most 1", number(share)),
            "write a share, such as 0.5",
        ))
    }

    /// The corners of a convex polygon, counter-clockwise. They are also convex in single
    /// precision.
    pub(super) fn convex(
        &self,
        key: &Key,
        mut points: Vec<[f64; 2]>,
    ) -> Result<Vec<[f64; 2]>, WorldError> {
        self.near(key, points.as_flattened())?;
        if points.len() < 3 {
            let message = format!("a polygon has three corners or more, not {}", points.len());
            return Err(self.error(key, &message, "add the other corners"));
        }
        let single = points.iter().map(|corner| corner.map(|at| f64::from(at as f32)));
        let single: Vec<_> = single.collect();
        let flat = straight(&points).or_else(|| straight(&single));
        if let Some([x, y]) = flat.map(|at| points[at]) {
            let [x, y] = [x, y].map(number);
            let message = format!("the corner [{x}, {y}] is on the line between its neighbours");
            return Err(self.error(key, &message, "remove it"));
        }
        let turning = turning(&points).filter(|_| turning(&single).is_some());
        match turning {
            Some(true) => {}
            Some(false) => points.reverse(),
            None => {
                return Err(self.error(
                    key,
                    "the polygon is not convex",
                    "split it into convex polygons",
                ));
            }
        }
        Ok(points)
    }

    /// Sizes, masses and similar values, at least [`SMALLEST`].
    pub(super) fn positive(&self, key: &Key, values: &[f64]) -> Result<(), WorldError> {
        self.near(key, values)?;
        match values.iter().find(|value| **value < SMALLEST) {
            Some(value) => {
                let help = format!("write {SMALLEST} or more");
                Err(self.error(key, &format!("{} is less than {SMALLEST}", number(*value)), help))
            }
            None => Ok(()),
        }
    }

    pub(super) fn not_negative(&self, key: &Key, value: f64) -> Result<(), WorldError> {
        self.near(key, &[value])?;
        match value < 0.0 {
            true => {
                Err(self.error(key, &format!("{} is negative", number(value)), "write 0 or more"))
            }
            false => Ok(()),
        }
    }

    pub(super) fn near(&self, key: &Key, values: &[f64]) -> Result<(), WorldError> {
        match values.iter().find(|value| !value.is_finite() || value.abs() > FARTHEST) {
            Some(value) => {
                let help = format!("write a number from -{FARTHEST} to {FARTHEST}");
                let message = format!("{} is not within {FARTHEST} of zero", number(*value));
                Err(self.error(key, &message, help))
            }
            None => Ok(()),
        }
    }

    /// The error at a key, with a fix.
    pub(super) fn error(&self, key: &Key, message: &str, help: impl Into<String>) -> WorldError {
        let keys: Vec<&str> = key.0.iter().map(String::as_str).collect();
        let name = keys.last().copied().unwrap_or_default();
        at_key(self.text, &keys, format!("{name}: {message}")).with_help(help)
    }
}

/// A readable number, even if it is very small or large.
pub(super) fn number(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").unwrap_or(&text).to_owned()
}

fn corners(points: &[[f64; 2]]) -> impl Iterator<Item = (usize, [f64; 2], [f64; 2])> {
    let n = points.len();
    (1..=n).map(move |i| {
        let [a, b, c] = [points[i - 1], points[i % n], points[(i + 1) % n]];
        (i % n, [b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]])
    })
}

fn cross([ux, uy]: [f64; 2], [vx, vy]: [f64; 2]) -> f64 {
    ux * vy - uy * vx
}

/// A corner without a turn: its edges are in one line or go back, or it equals the previous corner.
fn straight(points: &[[f64; 2]]) -> Option<usize> {
    let none = |edge: [f64; 2], next| {
        cross(edge, next).abs() < FLAT || libm::hypot(edge[0], edge[1]) < SAME
    };
    corners(points).find(|(_, edge, next)| none(*edge, *next)).map(|(corner, ..)| corner)
}

/// Whether a convex polygon's corners are counter-clockwise; `None` if it is not convex.
fn turning(points: &[[f64; 2]]) -> Option<bool> {
    let mut left = None;
    // The edges of a convex polygon make one full turn; the edges of a star make more.
    let mut turned = 0.0;
    for (_, edge, next) in corners(points) {
        let (across, along) = (cross(edge, next), edge[0] * next[0] + edge[1] * next[1]);
        if *left.get_or_insert(across > 0.0) != (across > 0.0) {
            return None;
        }
        turned += libm::atan2(across, along);
    }
    left.filter(|_| turned.abs() < 7.0)
}
