//! Builds a world and the robot in the engine.

use super::DT;
use super::movers::Mover;
use crate::chassis::Chassis;
use crate::world::{Mobility, Obstacle, World, WorldError, isometry};
use rapier2d::geometry::{Group, InteractionGroups, InteractionTestMode};
use rapier2d::math::{Pose as Isometry, Vector};
use rapier2d::parry::shape::SharedShape;
use rapier2d::prelude::{
    ColliderBuilder, ColliderHandle, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle,
};

/// Obstacles that the range sensor detects.
pub(crate) const HIGH: Group = Group::GROUP_1;
/// Obstacles below the range sensor.
const LOW: Group = Group::GROUP_2;
pub(crate) const ROBOT: Group = Group::GROUP_3;

pub(crate) struct Built {
    pub(crate) physics: PhysicsWorld,
    pub(crate) body: RigidBodyHandle,
    pub(crate) collider: ColliderHandle,
    pub(crate) shapes: Vec<(Isometry, SharedShape)>,
    pub(crate) movers: Vec<Mover>,
}

pub(crate) fn build(world: &World, chassis: &Chassis) -> Result<Built, WorldError> {
    let mut physics = PhysicsWorld::new();
    physics.gravity = Vector::ZERO;
    physics.integration_parameters.dt = DT as f32;
    let mut movers = Vec::new();
    let mut shapes = Vec::with_capacity(world.obstacles.len());
    for (i, obstacle) in world.obstacles.iter().enumerate() {
        let (at, shape) = obstacle
            .outline
            .shape()
            .ok_or_else(|| WorldError::new(None, format!("'{}' has no area", obstacle.name)))?;
        let collider = collider(obstacle, shape.clone(), i, chassis);
        match Mover::body(obstacle, at) {
            None => drop(physics.insert_collider(collider.position(at), None)),
            Some(body) => {
                let (body, _) = physics.insert(body, collider);
                movers.push(Mover::new(i, body, (at, &shape), obstacle));
            }
        }
        shapes.push((at, shape));
    }
    let body = RigidBodyBuilder::dynamic().pose(isometry(world.start)).can_sleep(false);
    let (body, collider) = physics.insert(body, robot(chassis));
    // Rays hit nothing before the first update of the search tree.
    physics.detect_collisions(&(), &());
    Ok(Built { physics, body, collider, shapes, movers })
}

/// An obstacle's collider; its user data is the obstacle's index in the world.
pub(crate) fn collider(
    obstacle: &Obstacle,
    shape: SharedShape,
    i: usize,
    chassis: &Chassis,
) -> ColliderBuilder {
    let group = if chassis.hears(obstacle.height) { HIGH } else { LOW };
    let builder = match obstacle.mobility {
        Mobility::Movable { mass } => ColliderBuilder::new(shape).mass(mass as f32),
        Mobility::Fixed | Mobility::Scripted(_) => ColliderBuilder::new(shape),
    };
    builder
        .friction(0.3)
        .restitution(0.0)
        .collision_groups(InteractionGroups::new(
            group,
            ROBOT | HIGH | LOW,
            InteractionTestMode::And,
        ))
        .user_data(i as u128)
}

fn robot(chassis: &Chassis) -> ColliderBuilder {
    ColliderBuilder::new(chassis.shared())
        .mass(chassis.mass as f32)
        .friction(0.3)
        .restitution(0.0)
        .collision_groups(InteractionGroups::new(ROBOT, HIGH | LOW, InteractionTestMode::And))
}
