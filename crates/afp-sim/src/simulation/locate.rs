//! Localisation and path planning of the robot, and a measure of the localisation error.

mod located;

pub(super) use located::Located;

use super::Simulation;
use super::robot::frame;
use super::sensors::Raw;
use crate::devices::sonar;
use crate::truth::Pose;
use crate::world::isometry;
use afp_carbot::devices::{Navigator, Ultrasonic};
use afp_carbot::table::signal;
use afp_core::Instant;
use afp_navigation::maps::{Filter, LocateJob, Locator, Planner, SearchJob};
use afp_platform::VirtualWorker;
use afp_session::frames::{BY_LOCALISATION, WORLD};
use afp_session::{SampleRef, Samples, Shape};
use std::f64::consts::TAU;

pub(super) type SimulatedLocator = Locator<VirtualWorker<LocateJob>>;

pub(super) type SimulatedPlanner = Planner<VirtualWorker<SearchJob>>;

/// Thickness of the discs that show beliefs, in metres, and their number of corners.
const THIN: f64 = 0.01;
const CORNERS: u32 = 16;

impl Simulation {
    /// The localisation, created on first use. It knows the map and the start, like a robot that a
    /// user puts down, and no other ground truth.
    pub(super) fn locator(&mut self) -> &mut SimulatedLocator {
        let beam = self.beam();
        let Simulation { locator, audible, stage, start, seed, .. } = self;
        locator.get_or_insert_with(|| {
            let field = audible.field(&stage.obstacles, &stage.chassis, &beam);
            let filter = Filter::new(field, &beam, *start, *seed);
            Box::new(Locator::new(VirtualWorker::new([LocateJob::new(filter)]), *start))
        })
    }

    /// The path planner, created on first use, on the same map.
    pub(super) fn planner(&mut self) -> &mut SimulatedPlanner {
        let (body, beam) = (self.body(), self.beam());
        let Simulation { planner, audible, stage, .. } = self;
        planner.get_or_insert_with(|| {
            let field = audible.field(&stage.obstacles, &stage.chassis, &beam);
            Box::new(Planner::new(field, &body, beam.forward, VirtualWorker::new))
        })
    }

    /// The distance and angle between the robot and its estimate, in metres and radians; `None`
    /// while the localisation is unused.
    pub fn localisation_error(&self) -> Option<[f64; 2]> {
        self.located.last()
    }

    /// Moves the robot to another place, as if a user carried it. The wheels do not turn.
    pub fn carry_to(&mut self, place: Pose) {
        self.set_down(self.stage.body, isometry(place));
    }

    pub(super) fn sample_localisation(&self, to: &mut Samples<'_, '_>) {
        let (Some(locator), Some([off, turned])) = (&self.locator, self.located.last()) else {
            return;
        };
        to.put(signal::LOCALISATION_OFF, SampleRef::Float(off));
        to.put(signal::LOCALISATION_HEADING_OFF, SampleRef::Float(turned));
        let belief = locator.latest(self.sensors.lines.odometry.read(Raw::odometry(self)));
        let Ok(belief) = belief.value else { return };
        let pose = Pose { x: belief.x.si(), y: belief.y.si(), heading: belief.heading.si() };
        to.put(signal::LOCALISATION_POSE, frame(WORLD, BY_LOCALISATION, pose, 0.0));
        if to.wants(signal::LOCALISATION_BELIEF) {
            let radius = belief.spread.si();
            let shape = Shape {
                id: "belief".to_owned(),
                frame: WORLD,
                outline: circle([pose.x, pose.y], radius),
                height: THIN,
                color: [0.55, 0.25, 0.65, 0.4],
            };
            to.put(signal::LOCALISATION_BELIEF, SampleRef::Outline(&shape));
        }
    }

    /// Adds the obstacle directly ahead of the estimated position to the planner's map.
    pub(super) fn plan_round(&mut self, now: Instant) {
        let motion = self.sensors.lines.odometry.read(Raw::odometry(self));
        if let (Some(planner), Some(locator)) = (&mut self.planner, &self.locator)
            && let Ok(place) = locator.latest(motion).value
        {
            planner.on_bump(&place, now);
        }
    }

    /// Passes the readings of range sensor and odometry to the filter, over lines that may have
    /// faults.
    pub(super) fn locate(&mut self) {
        let (now, truth) = (self.now, self.truth().pose());
        let echo = self.sensors.lines.ultrasonic.read(self.sensors.echo);
        let motion = self.sensors.lines.odometry.read(Raw::odometry(self));
        let touched = Raw::touch(self);
        let Some(locator) = &mut self.locator else { return };
        locator.on_echo(echo, motion, now);
        if let Some(planner) = &mut self.planner {
            let fresh = echo.value.ok().filter(|_| now.since(echo.time) <= sonar::PERIOD);
            if let Some((echo, place)) = fresh.zip(locator.belief_at(echo.time)) {
                planner.on_echo(&echo, &place, now);
            }
        }
        if self.sensors.lines.touch.read(touched).value == Ok(true) {
            self.plan_round(now);
        }
        let Some(locator) = &self.locator else { return };
        if let Ok(belief) = locator.latest(motion).value {
            let believed =
                Pose { x: belief.x.si(), y: belief.y.si(), heading: belief.heading.si() };
            self.located.note(truth, believed);
        }
    }
}

fn circle(middle: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let corner = |n| libm::sincos(f64::from(n) * TAU / f64::from(CORNERS));
    let corners = (0..CORNERS).map(corner);
    corners.map(|(sin, cos)| [middle[0] + radius * cos, middle[1] + radius * sin]).collect()
}
