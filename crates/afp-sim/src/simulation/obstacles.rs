//! What stands and moves in the world of a simulation.

use super::Simulation;

impl Simulation {
    /// The corners of an obstacle, by its place in [`World::obstacles`](crate::World), where it is now: metres,
    /// counter-clockwise; none for an obstacle that is not there.
    pub fn outline(&self, obstacle: usize) -> Vec<[f64; 2]> {
        self.stage.outline(obstacle)
    }

    /// The obstacles that move, by their places in [`World::obstacles`](crate::World).
    pub fn movers(&self) -> impl Iterator<Item = usize> {
        self.stage.movers()
    }

    /// Notes where everything that moves was put.
    pub(super) fn note_obstacles(&mut self) {
        let Simulation { stage, scene, .. } = self;
        stage.note_movers(|n, at, direction| scene.place(n, at, direction));
    }
}
