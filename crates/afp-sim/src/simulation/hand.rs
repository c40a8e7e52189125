//! Changes to the world from outside: moving the robot and other objects, and dropping new objects.

use super::Simulation;
use crate::stage::{Mover, collider};
use crate::truth::Pose;
use crate::world::{
    FARTHEST, Look, Mobility, Obstacle, Outline, Texture, is_beyond, isometry, shape,
};
use afp_session::{Droppable, Put, RequestError};
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::query;
use rapier2d::parry::shape::{Shape, SharedShape};
use rapier2d::prelude::RigidBodyHandle;

pub(super) const SHAPES: [Droppable; 3] = [
    Droppable {
        shape: "crate",
        outline: &[[0.15, 0.15], [-0.15, 0.15], [-0.15, -0.15], [0.15, -0.15]],
    },
    Droppable {
        shape: "can",
        outline: &[[0.04, 0.04], [-0.04, 0.04], [-0.04, -0.04], [0.04, -0.04]],
    },
    Droppable { shape: "wall", outline: &[[0.03, 0.5], [-0.03, 0.5], [-0.03, -0.5], [0.03, -0.5]] },
];

/// Their heights, in metres, and masses, in kilograms.
const BODIES: [(f64, f64); SHAPES.len()] = [(0.3, 2.0), (0.12, 0.3), (0.4, 30.0)];

/// The maximum number of dropped objects, of all shapes: each costs time in every step.
const MOST: usize = 64;

enum Placed {
    Robot,
    Thing { body: RigidBodyHandle, to: Isometry },
    New { obstacle: Obstacle, start: Isometry, shape: SharedShape },
}

impl Simulation {
    pub(super) fn put_by_hand(&mut self, what: &Put, at: Pose) -> Result<(), RequestError> {
        match self.placed(what, at)? {
            Placed::Robot => self.carry_to(at),
            Placed::Thing { body, to } => self.set_down(body, to),
            Placed::New { obstacle, start, shape } => self.drop_new(obstacle, start, shape)?,
        }
        // Rays and pictures of this instant see the new position.
        self.stage.physics.detect_collisions(&(), &());
        self.note_obstacles();
        Ok(())
    }

    /// Checks whether an object can be placed somewhere now.
    pub(super) fn check_hand(&self, what: &Put, at: Pose) -> Result<(), RequestError> {
        self.placed(what, at).map(|_| ())
    }

    fn placed(&self, what: &Put, at: Pose) -> Result<Placed, RequestError> {
        let far = at.x.abs().max(at.y.abs()) > FARTHEST;
        if far || is_beyond(&self.map, [at.x, at.y]) {
            return Err(RequestError::Nowhere);
        }
        match what {
            Put::Robot => {
                self.look_for_room(&*self.robot(), &isometry(at), None)?;
                Ok(Placed::Robot)
            }
            Put::Thing(name) => self.carried(name, at),
            Put::New(shape) => self.dropped(shape, at),
        }
    }

    /// Moves a movable object, by its name or its name in scenes. The pose is that of its middle,
    /// turned relative to the start.
    fn carried(&self, name: &str, at: Pose) -> Result<Placed, RequestError> {
        let unknown = || RequestError::NoThing(name.to_owned());
        let is_it = |index: usize, it: &Obstacle| {
            let named = it.name == name || shape(index, it).id == name;
            named && matches!(it.mobility, Mobility::Movable { .. })
        };
        let found = self.stage.movers.iter().find(|mover| {
            let obstacle = self.stage.obstacles.get(mover.obstacle());
            obstacle.is_some_and(|it| is_it(mover.obstacle(), it))
        });
        let mover = found.ok_or_else(unknown)?;
        let (index, body) = (mover.obstacle(), mover.handle());
        let (_, shape) = self.stage.shapes.get(index).ok_or_else(unknown)?;
        let to = isometry(at) * isometry(self.middle(index)).inverse() * mover.start();
        self.look_for_room(&**shape, &to, Some(index))?;
        self.look_for_robot(&**shape, &to)?;
        Ok(Placed::Thing { body, to })
    }

    fn middle(&self, index: usize) -> Pose {
        let corners =
            self.stage.obstacles.get(index).map_or_else(Vec::new, |it| it.outline.corners());
        let count = corners.len().max(1) as f64;
        let sum = corners.iter().fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
        Pose { x: sum[0] / count, y: sum[1] / count, heading: 0.0 }
    }

    fn dropped(&self, shape: &str, at: Pose) -> Result<Placed, RequestError> {
        let unknown = || RequestError::NoShape(shape.to_owned());
        let (known, (height, mass)) = SHAPES
            .iter()
            .zip(BODIES)
            .find(|(known, _)| known.shape == shape)
            .ok_or_else(unknown)?;
        let half = known.outline.first().copied().ok_or_else(unknown)?;
        if self.dropped >= MOST {
            return Err(RequestError::Full(MOST));
        }
        let is_new = |name: &String| self.stage.obstacles.iter().all(|it| it.name != *name);
        let name = (1_usize..).map(|number| format!("{shape} {number}")).find(is_new);
        let obstacle = Obstacle {
            name: name.ok_or_else(unknown)?,
            outline: Outline::Box { pose: at, half },
            height,
            mobility: Mobility::Movable { mass },
            look: Look { color: [0xc8, 0x8a, 0x4a], texture: Texture::default() },
            echo: 1.0,
            mapped: false,
        };
        let (start, body) = obstacle.outline.shape().ok_or_else(unknown)?;
        self.look_for_room(&*body, &start, None)?;
        self.look_for_robot(&*body, &start)?;
        Ok(Placed::New { obstacle, start, shape: body })
    }

    fn drop_new(
        &mut self,
        obstacle: Obstacle,
        start: Isometry,
        body: SharedShape,
    ) -> Result<(), RequestError> {
        let unknown = || RequestError::NoShape(obstacle.name.clone());
        let index = self.stage.obstacles.len();
        let built = Mover::body(&obstacle, start).ok_or_else(unknown)?;
        let (handle, _) = self
            .stage
            .physics
            .insert(built, collider(&obstacle, body.clone(), index, &self.stage.chassis));
        self.stage.disturb();
        self.stage.movers.push(Mover::new(index, handle, (start, &body), &obstacle));
        self.scene.add(&obstacle);
        self.stage.shapes.push((start, body));
        self.stage.obstacles.push(obstacle);
        self.dropped += 1;
        Ok(())
    }

    /// Checks that no obstacle is in the place of a shape; `own` is the shape's own obstacle.
    fn look_for_room(
        &self,
        shape: &dyn Shape,
        at: &Isometry,
        own: Option<usize>,
    ) -> Result<(), RequestError> {
        let meets = |other: &Isometry, of: &dyn Shape| {
            query::intersection_test(at, shape, other, of).is_ok_and(|test| test.intersecting)
        };
        let others = self.stage.shapes.iter().zip(&self.stage.obstacles).enumerate();
        let mut others = others.filter(|(index, _)| Some(*index) != own);
        if let Some((_, (_, obstacle))) = others.find(|(_, ((other, of), _))| meets(other, &**of)) {
            return Err(RequestError::Occupied(obstacle.name.clone()));
        }
        Ok(())
    }

    /// Checks that the robot is not in the place of a shape.
    fn look_for_robot(&self, shape: &dyn Shape, at: &Isometry) -> Result<(), RequestError> {
        let meets = query::intersection_test(at, shape, self.position(), &*self.robot());
        match meets.is_ok_and(|test| test.intersecting) {
            true => Err(RequestError::Occupied("the robot".to_owned())),
            false => Ok(()),
        }
    }

    fn robot(&self) -> SharedShape {
        self.stage.chassis.shared()
    }

    pub(super) fn set_down(&mut self, body: RigidBodyHandle, at: Isometry) {
        self.stage.disturb();
        let physics = &mut self.stage.physics;
        // The call also wakes the bodies that rested against it: the engine does not expect an
        // active body among sleeping ones.
        physics.islands.wake_up(&mut physics.bodies, body, true);
        let body = &mut physics.bodies[body];
        body.set_position(at, true);
        body.set_linvel(Vector::ZERO, true);
        body.set_angvel(0.0, true);
    }
}

#[cfg(test)]
mod tests;
