//! The position of a pixel's object in the next picture: the ground truth for optical flow.

use super::{COLUMNS, Exposure, FORWARD, HEIGHT, ROWS, lens, render};
use crate::scene::Scene;
use crate::vehicle::Place;

/// An object is not hidden if it is nearer to the hiding object than this share of its distance.
const SLACK: f64 = 0.02;

struct Spot {
    /// The solid's index in the scene; `None` for the floor.
    solid: Option<usize>,
    /// The distance ahead, in metres.
    depth: f64,
}

/// The column and row of a pixel's object in a later picture. `None` for the sky, and for an object
/// that is hidden or outside of the later picture.
pub(crate) fn track(before: &Exposure, after: &Exposure, x: f64, y: f64) -> Option<[f64; 2]> {
    let spot = look(before, x, y)?;
    let (left, up) = slopes(x, y);
    let eye = before.robot.beyond(FORWARD, 0.0);
    let direction = before.robot.turned([1.0, left]);
    let at = [0, 1].map(|i| eye[i] + direction[i] * spot.depth);
    let moved = match spot.solid {
        Some(solid) => before.scene.carried(&after.scene, solid, at)?,
        None => at,
    };
    let eye = after.robot.beyond(FORWARD, 0.0);
    let [depth, left] = after.robot.towards([0, 1].map(|i| moved[i] - eye[i]));
    let focus = lens().focus();
    let column = middle(COLUMNS) - left / depth * focus;
    let row = middle(ROWS) - up * spot.depth / depth * focus;
    let inside = |at: f64, size: usize| at >= 0.0 && at <= size as f64 - 1.0;
    let seen = depth > 0.0 && inside(column, COLUMNS) && inside(row, ROWS);
    let nearest = look(after, column, row).filter(|_| seen)?.depth;
    (nearest > depth * (1.0 - SLACK)).then_some([column, row])
}

fn slopes(x: f64, y: f64) -> (f64, f64) {
    let focus = lens().focus();
    ((middle(COLUMNS) - x) / focus, (middle(ROWS) - y) / focus)
}

fn middle(size: usize) -> f64 {
    size as f64 / 2.0 - 0.5
}

fn look(exposure: &Exposure, x: f64, y: f64) -> Option<Spot> {
    let Exposure { scene, robot, .. } = exposure;
    let (left, up) = slopes(x, y);
    let floor = (up < 0.0).then(|| Spot { solid: None, depth: -HEIGHT / up });
    let solids = on_solids(scene, robot, left, up);
    solids.chain(floor).min_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// The intersection of the line of sight with the sides and tops of solids.
fn on_solids(scene: &Scene, robot: &Place, left: f64, up: f64) -> impl Iterator<Item = Spot> {
    let eye = robot.beyond(FORWARD, 0.0);
    let direction = robot.turned([1.0, left]);
    scene.solids().enumerate().filter_map(move |(n, solid)| {
        let met = solid.cross(eye, direction).filter(|met| met.enter > render::NEAR)?;
        let side = HEIGHT + up * met.enter;
        let top = (solid.height - HEIGHT) / up;
        let on_side = (0.0..=solid.height).contains(&side).then_some(met.enter);
        let on_top = (up < 0.0 && (met.enter..=met.leave).contains(&top)).then_some(top);
        Some(Spot { solid: Some(n), depth: on_side.or(on_top)? })
    })
}
