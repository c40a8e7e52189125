//! Fixed and moving obstacles in a simulation.

use super::Simulation;

impl Simulation {
    /// The present corners of an obstacle, by its index in [`World::obstacles`](crate::World):
    /// metres, counter-clockwise; empty for an unknown index.
    pub fn outline(&self, obstacle: usize) -> Vec<[f64; 2]> {
        self.stage.outline(obstacle)
    }

    /// The moving obstacles, by their indices in [`World::obstacles`](crate::World).
    pub fn movers(&self) -> impl Iterator<Item = usize> {
        self.stage.movers()
    }

    /// Records the positions of all moving obstacles.
    pub(super) fn note_obstacles(&mut self) {
        let Simulation { stage, scene, .. } = self;
        stage.note_movers(|n, at, direction| scene.place(n, at, direction));
    }
}
