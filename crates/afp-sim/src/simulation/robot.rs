//! The simulation as a robot that sessions drive.

use afp_carbot::devices::{Color, Ultrasonic};
use afp_carbot::table::{Carbot, Control, Fault, signal};
use afp_core::{Instant, Platform};
use afp_platform::VirtualClock;
use afp_session::frames::{BODY, BY_ODOMETRY, WORLD};
use afp_session::{
    Active, Droppable, Figure, FigureValue, Image, Measure, Pose2, Put, Ranging, Refused,
    RequestError, Robot, SampleRef, Samples, Shape, Simulated, Span, Transform,
};

use super::{Simulation, Snapshot, hand};
use crate::devices::camera;
use crate::wall::WallDistance;
use crate::world::{World, shape};

const SONAR: &str = "sonar";
const CAMERA: &str = "camera";

impl Platform for Simulation {
    type Clock = VirtualClock;

    fn clock(&self) -> VirtualClock {
        self.clock()
    }

    fn now(&self) -> Instant {
        self.now()
    }

    fn advance(&mut self, to: Instant) {
        self.advance_to(to);
    }

    fn ready(&self) -> Instant {
        self.clock.free()
    }
}

impl Robot for Simulation {
    type Devices = Carbot;

    fn press(&mut self, control: Control, held: bool) -> Result<(), Refused> {
        match (control, held) {
            (Control::ButtonsEscape, true) => self.press_escape(),
            (Control::ButtonsEscape, false) => self.release_escape(),
            (Control::Touch, true) => self.press_bumper(),
            (Control::Touch, false) => self.release_bumper(),
        }
        Ok(())
    }

    fn set_faults(&mut self, active: &Active<'_, Fault>) -> Result<(), Refused> {
        self.apply_faults(active);
        Ok(())
    }

    fn put(&mut self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.put_by_hand(what, at)
    }

    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.check_hand(what, at)
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        self.sample_truth(to);
        self.sample_ranging(to);
        let Snapshot { odometry, rotator, touched, .. } = self.snapshot();
        if to.wants(signal::ODOMETRY_POSE) {
            let moved =
                Pose2 { x: odometry.x.si(), y: odometry.y.si(), heading: odometry.heading.si() };
            let pose = self.start.beyond(moved);
            to.put(signal::ODOMETRY_POSE, frame(WORLD, BY_ODOMETRY, pose, 0.0));
        }
        to.put(signal::ROTATOR_BEARING, SampleRef::Float(rotator));
        to.put(signal::TOUCH_TOUCHED, SampleRef::Bool(touched));
        to.put(signal::BUTTONS_ESCAPE, SampleRef::Bool(self.escape));
        to.put(signal::BATTERY_LEFT, SampleRef::Float(self.battery.charge().left));
        self.sample_light(to);
        self.sample_localisation(to);
        let (speed, turn) = self.drive.asked();
        to.put(signal::NAVIGATOR_ASKED_SPEED, SampleRef::Float(speed));
        to.put(signal::NAVIGATOR_ASKED_TURN, SampleRef::Float(turn));
        let (light, tone) = self.shown;
        to.put(signal::SIGNALS_LIGHT, SampleRef::Bool(light));
        if let Some(tone) = tone {
            to.put(signal::SIGNALS_TONE, SampleRef::Float(tone.si()));
        }
        let eye = Pose2 { x: camera::FORWARD, ..Pose2::default() };
        to.put(signal::CAMERA_FRAME, frame(BODY, CAMERA, eye, camera::HEIGHT));
        if to.wants(signal::CAMERA_PICTURE)
            && let Some((time, picture)) = self.view()
        {
            let (width, height) = (picture.width as u32, picture.height as u32);
            let image = Image { time, frame: CAMERA, width, height, rgb: picture.rgb };
            to.put(signal::CAMERA_PICTURE, SampleRef::Image(image));
        }
        if to.wants(signal::WORLD_OUTLINE) {
            for obstacle in self.movers() {
                if let Some(shape) = self.shape(obstacle) {
                    to.put(signal::WORLD_OUTLINE, SampleRef::Outline(&shape));
                }
            }
        }
    }

    fn keyframe(&self) -> Option<Self> {
        Some(self.split())
    }

    fn figures(&self) -> Vec<Figure> {
        let spans = self.truth().collisions().iter().map(|collision| Span {
            name: self.stage.obstacles.get(collision.obstacle).map_or("", |it| &it.name).to_owned(),
            begin: collision.begin,
            end: collision.end,
        });
        let value = FigureValue::Spans { of: "obstacle", spans: spans.collect() };
        let contacts = Figure { name: "contacts", value, text: String::new() };
        let left_map = self.truth().left_map().map(|at| {
            let at = at.as_secs_f64();
            let text = format!("at {at:.2} s; nothing stands beyond its edge");
            Figure { name: "left_map", value: FigureValue::Numbers(vec![("at_s", at)]), text }
        });
        [contacts].into_iter().chain(left_map).chain(self.located.figure()).collect()
    }
}

impl Simulation {
    fn sample_truth(&self, to: &mut Samples<'_, '_>) {
        let truth = self.truth();
        if to.wants(signal::POSE) {
            to.put(signal::POSE, frame(WORLD, BODY, truth.pose(), 0.0));
        }
        to.put(signal::HALTED, SampleRef::Bool(truth.is_halted()));
        to.put(signal::STANDING, SampleRef::Bool(truth.is_standing()));
        let touched = truth.touching().last();
        to.put(signal::COLLISION, SampleRef::Bool(touched.is_some()));
        let contact = touched.and_then(|last| self.stage.obstacles.get(last.obstacle));
        to.put(signal::CONTACT, SampleRef::Text(contact.map_or("", |it| &it.name)));
    }

    /// What the sensors for light said last, before their lines make anything of it.
    fn sample_light(&self, to: &mut Samples<'_, '_>) {
        if let Ok(Some(glow)) = self.glow.value {
            to.put(signal::INFRARED_DIRECTION, SampleRef::Float(glow.bearing.si()));
            to.put(signal::INFRARED_STRENGTH, SampleRef::Float(glow.strength));
        }
        if let Ok(Color { red, green, blue }) = self.color.value {
            to.put(signal::COLOR_RED, SampleRef::Float(red));
            to.put(signal::COLOR_GREEN, SampleRef::Float(green));
            to.put(signal::COLOR_BLUE, SampleRef::Float(blue));
        }
    }

    fn sample_ranging(&self, to: &mut Samples<'_, '_>) {
        if !to.wants(signal::ULTRASONIC_ECHO) && !to.wants(signal::ULTRASONIC_FRAME) {
            return;
        }
        let (beam, Snapshot { rotator, sonar, .. }) = (self.beam(), self.snapshot());
        let height = self.stage.chassis.ranging_height;
        let sensor = Pose2 { x: beam.forward.si(), y: 0.0, heading: rotator };
        to.put(signal::ULTRASONIC_FRAME, frame(BODY, SONAR, sensor, height));
        if let Some(sonar) = sonar {
            let pose = Pose2 { heading: sonar.bearing, ..sensor };
            let (half_angle, range) = (beam.opening.si() / 2.0, sonar.distance);
            let ranging = Ranging { time: sonar.time, frame: BODY, pose, half_angle, range };
            to.put(signal::ULTRASONIC_ECHO, SampleRef::Range(ranging));
        }
    }

    /// An obstacle where it is now, as a scene shows it.
    fn shape(&self, index: usize) -> Option<Shape> {
        let obstacle = self.stage.obstacles.get(index)?;
        Some(Shape { outline: self.outline(index), ..shape(index, obstacle) })
    }
}

impl Simulated for Simulation {
    type World = World;
    const DROPS: &'static [Droppable] = &hand::SHAPES;
    const FACTS: &'static [(&'static str, &'static str)] = &[("physics_step_ns", "5000000")];
    const MEASURES: &'static [&'static str] = &[WallDistance::NAME];

    fn new(world: &World, seed: u64) -> Result<Self, String> {
        Simulation::new(world, seed).map_err(|error| error.message)
    }

    fn measure(name: &str) -> Option<Box<dyn Measure<Self>>> {
        match name {
            WallDistance::NAME => Some(Box::new(WallDistance::default())),
            _ => None,
        }
    }
}

pub(super) fn frame(
    parent: &'static str,
    child: &'static str,
    pose: Pose2,
    height: f64,
) -> SampleRef<'static> {
    SampleRef::Pose(Transform { parent, child, pose, height })
}
