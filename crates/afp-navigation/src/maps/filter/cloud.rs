use super::sonar::likelihood;
use super::{Ping, wrap};
use crate::maps::field::EchoField;
use afp_platform::Noise;
use afp_session::Pose2;
use nalgebra::{Vector2, Vector3};
use std::mem;

const COUNT: usize = 400;
/// The uncertainty of the start: standard deviations, in metres and radians.
const START: [f64; 2] = [0.05, 0.04];
/// The spread of particles around a candidate place.
const TRIED: [f64; 2] = [0.08, 0.08];
/// The number of particles at a candidate place.
const ADDED: usize = COUNT / 10;
/// The odometry's errors over a metre and a turn of one radian: standard deviations in metres and
/// radians, growing with the root of the distance.
const WAY: f64 = 0.02;
const TURN: f64 = 0.03;
const TURN_OF_WAY: f64 = 0.025;
/// Particles are resampled if fewer than this are effective.
const FEWEST: f64 = COUNT as f64 / 2.0;
/// Particles within this distance and angle are of one place, in metres and radians.
const NEAR: f64 = 0.4;
const ALIKE: f64 = 0.5;
/// The number of compared places.
const PLACES: usize = 10;
/// The relative weight that another place needs to replace the believed one.
const MORE: f64 = 1.3;

#[derive(Clone, Copy, Debug)]
struct Particle {
    pose: Pose2,
    /// Cosine and sine of the heading.
    towards: [f64; 2],
    weight: f64,
}

impl Particle {
    fn new(pose: Pose2, weight: f64) -> Self {
        let (sin, cos) = libm::sincos(pose.heading);
        Particle { pose, towards: [cos, sin], weight }
    }

    /// The place at this distance ahead and to its left, in metres.
    fn beyond(&self, ahead: f64, left: f64) -> [f64; 2] {
        let ([cos, sin], Pose2 { x, y, .. }) = (self.towards, self.pose);
        [x + ahead * cos - left * sin, y + ahead * sin + left * cos]
    }
}

#[derive(Clone, Debug)]
pub(super) struct Cloud {
    particles: Vec<Particle>,
    /// Buffer for resampling.
    drawn: Vec<Particle>,
}

impl Cloud {
    pub(super) fn around(place: Pose2, noise: &mut Noise) -> Self {
        let particle = |_| Particle::new(near(place, START, noise), 1.0 / COUNT as f64);
        Cloud { particles: (0..COUNT).map(particle).collect(), drawn: Vec::with_capacity(COUNT) }
    }

    /// Moves all particles by the odometry's motion, each with its own noise.
    pub(super) fn drive(&mut self, moved: Pose2, noise: &mut Noise) {
        let way = libm::hypot(moved.x, moved.y);
        let turn = moved.heading.abs();
        if way == 0.0 && turn == 0.0 {
            return;
        }
        let off = WAY * libm::sqrt(way);
        let turned_off = libm::sqrt(TURN * TURN * turn + TURN_OF_WAY * TURN_OF_WAY * way);
        for particle in &mut self.particles {
            let (ahead, left) = (moved.x + off * noise.normal(), moved.y + off * noise.normal());
            let turned = moved.heading + turned_off * noise.normal();
            let ([x, y], heading) = (particle.beyond(ahead, left), particle.pose.heading + turned);
            *particle = Particle::new(Pose2 { x, y, heading }, particle.weight);
        }
    }

    /// Weights all particles by a ping.
    pub(super) fn weigh(&mut self, field: &EchoField, forward: f64, ping: &Ping) {
        let mut sum = 0.0;
        for particle in &mut self.particles {
            let sensor = particle.beyond(forward, 0.0);
            let expected = field.expected(sensor, particle.pose.heading + ping.bearing);
            particle.weight *= likelihood(expected, ping.distance);
            sum += particle.weight;
        }
        // The minimum likelihood is a fiftieth, so that a sum never vanishes between two
        // resamplings.
        self.particles.iter_mut().for_each(|particle| particle.weight /= sum);
    }

    /// Puts particles of mean weight around a place, instead of some others.
    pub(super) fn add(&mut self, place: Pose2, noise: &mut Noise) {
        let from = noise.below((COUNT - ADDED) as u32) as usize;
        for particle in self.particles.iter_mut().skip(from).take(ADDED) {
            *particle = Particle::new(near(place, TRIED, noise), 1.0 / COUNT as f64);
        }
    }

    /// Resamples the particles in proportion to their weights if too few are effective: the low
    /// variance sampler of *Probabilistic Robotics*, table 4.4.
    pub(super) fn resample(&mut self, noise: &mut Noise) {
        let [sum, squares] = self.particles.iter().fold([0.0; 2], |[sum, squares], particle| {
            [sum + particle.weight, squares + particle.weight * particle.weight]
        });
        if sum * sum > FEWEST * squares {
            return;
        }
        let step = sum / COUNT as f64;
        let (mut target, mut reached) = (step * noise.uniform(), 0.0);
        self.drawn.clear();
        for particle in &self.particles {
            reached += particle.weight;
            while target < reached && self.drawn.len() < COUNT {
                self.drawn.push(Particle { weight: 1.0 / COUNT as f64, ..*particle });
                target += step;
            }
        }
        // Rounding may omit the last one.
        let last = self.particles.last().copied();
        while let Some(last) = last.filter(|_| self.drawn.len() < COUNT) {
            self.drawn.push(Particle { weight: 1.0 / COUNT as f64, ..last });
        }
        mem::swap(&mut self.particles, &mut self.drawn);
    }

    /// The middle of the place with the most weight; `believed` has an advantage.
    pub(super) fn densest(&self, believed: Pose2) -> Pose2 {
        let mut best = (believed, self.weight_near(believed) * MORE);
        let all: f64 = self.particles.iter().map(|particle| particle.weight).sum();
        if best.1 >= all {
            return self.middle_near(believed);
        }
        for particle in self.particles.iter().step_by(COUNT / PLACES) {
            let weight = self.weight_near(particle.pose);
            if weight > best.1 {
                best = (particle.pose, weight);
            }
        }
        self.middle_near(best.0)
    }

    fn weight_near(&self, place: Pose2) -> f64 {
        self.near(place).map(|particle| particle.weight).sum()
    }

    fn near(&self, place: Pose2) -> impl Iterator<Item = &Particle> {
        self.particles.iter().filter(move |particle| is_near(particle.pose, place))
    }

    fn middle_near(&self, place: Pose2) -> Pose2 {
        let mut sum = Vector3::zeros();
        let mut weights = 0.0;
        for Particle { pose, weight, .. } in self.near(place) {
            let turned = wrap(pose.heading - place.heading);
            sum += Vector3::new(pose.x - place.x, pose.y - place.y, turned) * *weight;
            weights += weight;
        }
        if weights <= 0.0 {
            return place;
        }
        let off = sum / weights;
        let heading = wrap(place.heading + off.z);
        Pose2 { x: place.x + off.x, y: place.y + off.y, heading }
    }

    /// The root mean square distance of particles from a place, in metres and radians.
    pub(super) fn spread(&self, place: Pose2) -> [f64; 2] {
        let [mut off, mut turned, mut weights] = [0.0; 3];
        for Particle { pose, weight, .. } in &self.particles {
            let (x, y) = (pose.x - place.x, pose.y - place.y);
            let turn = wrap(pose.heading - place.heading);
            off += weight * (x * x + y * y);
            turned += weight * turn * turn;
            weights += weight;
        }
        [off, turned].map(|sum| libm::sqrt(sum / weights))
    }
}

/// Whether two places are nearly the same.
pub(super) fn is_near(one: Pose2, other: Pose2) -> bool {
    let off = Vector2::new(one.x - other.x, one.y - other.y);
    off.norm_squared() < NEAR * NEAR && wrap(one.heading - other.heading).abs() < ALIKE
}

/// A place near another.
fn near(place: Pose2, [off, turned]: [f64; 2], noise: &mut Noise) -> Pose2 {
    let [x, y] = [place.x, place.y].map(|at| at + off * noise.normal());
    Pose2 { x, y, heading: place.heading + turned * noise.normal() }
}
