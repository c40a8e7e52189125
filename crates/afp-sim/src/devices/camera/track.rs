//! Where what a pixel shows is in the next picture: the truth by which optical flow is judged.

use super::{COLUMNS, Exposure, FORWARD, HEIGHT, ROWS, lens, render};
use crate::scene::Scene;
use crate::vehicle::Place;

/// What is nearer than this share of its distance to what hides it is not hidden.
const SLACK: f64 = 0.02;

/// What a pixel shows.
struct Spot {
    /// The solid, by its place in the scene; none for the floor.
    solid: Option<usize>,
    /// How far ahead it is, metres.
    depth: f64,
}

/// Where what the pixel in column `x` of row `y` shows is in a later picture, as column and row; none for
/// the sky and for what is hidden or out of the picture by then.
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

/// How far to the left and up a pixel looks, for each metre ahead.
fn slopes(x: f64, y: f64) -> (f64, f64) {
    let focus = lens().focus();
    ((middle(COLUMNS) - x) / focus, (middle(ROWS) - y) / focus)
}

fn middle(size: usize) -> f64 {
    size as f64 / 2.0 - 0.5
}

/// The nearest thing that a pixel shows.
fn look(exposure: &Exposure, x: f64, y: f64) -> Option<Spot> {
    let Exposure { scene, robot, .. } = exposure;
    let (left, up) = slopes(x, y);
    let floor = (up < 0.0).then(|| Spot { solid: None, depth: -HEIGHT / up });
    let solids = on_solids(scene, robot, left, up);
    solids.chain(floor).min_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// Where the line of sight meets the sides and tops of solids.
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
