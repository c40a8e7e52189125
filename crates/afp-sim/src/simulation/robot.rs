//! The simulation as the robot of a session.

use afp_carbot::guard::CONTROLLER_RESTARTED;
use afp_carbot::table::{Carbot, Control, Fault, signal};
use afp_core::{Instant, Platform};
use afp_platform::VirtualClock;
use afp_session::frames::{BODY, WORLD};
use afp_session::{
    Active, Droppable, Figure, FigureValue, Measure, Pose2, Put, Refused, RequestError, Robot,
    SampleRef, Samples, Shape, Simulated, Span, Transform,
};

use super::wall::WallDistance;
use super::{Simulation, hand};
use crate::world::{World, WorldError, shape};

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

    fn broken(&self) -> Option<afp_core::Fault> {
        self.restarted.then_some(CONTROLLER_RESTARTED)
    }

    fn put(&mut self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.put_by_hand(what, at)
    }

    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.check_hand(what, at)
    }

    fn sample(&self, to: &mut Samples<'_, '_>) {
        self.sample_facts(to);
        self.sample_sensors(to);
        self.sample_localisation(to);
        let (speed, turn) = self.drive.asked();
        to.put(signal::NAVIGATOR_ASKED_SPEED, SampleRef::Float(speed));
        to.put(signal::NAVIGATOR_ASKED_TURN, SampleRef::Float(turn));
        let (light, tone) = self.shown;
        to.put(signal::SIGNALS_LIGHT, SampleRef::Bool(light));
        if let Some(tone) = tone {
            to.put(signal::SIGNALS_TONE, SampleRef::Float(tone.si()));
        }
        self.sample_camera(to);
    }

    fn keyframe(&self) -> Option<Self> {
        Some(Simulation { clock: self.clock.split(), ..self.clone() })
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
            let text = format!("at {at:.2} s; the space beyond its edge is empty");
            Figure { name: "left_map", value: FigureValue::Numbers(vec![("at_s", at)]), text }
        });
        [contacts].into_iter().chain(left_map).chain(self.located.figure()).collect()
    }
}

impl Simulation {
    /// Samples the facts that no device knows: pose, contacts and moving obstacles.
    pub fn sample_facts(&self, to: &mut Samples<'_, '_>) {
        self.sample_truth(to);
        if to.wants(signal::WORLD_OUTLINE) {
            for obstacle in self.movers() {
                if let Some(shape) = self.shape(obstacle) {
                    to.put(signal::WORLD_OUTLINE, SampleRef::Outline(&shape));
                }
            }
        }
    }

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

    /// The present shape of an obstacle, for a scene.
    fn shape(&self, index: usize) -> Option<Shape> {
        let obstacle = self.stage.obstacles.get(index)?;
        Some(Shape { outline: self.outline(index), ..shape(index, obstacle) })
    }
}

impl Simulated for Simulation {
    type World = World;
    type Error = WorldError;
    const DROPS: &'static [Droppable] = &hand::SHAPES;
    const FACTS: &'static [(&'static str, &'static str)] = &[("physics_step_ns", "5000000")];
    const MEASURES: &'static [&'static str] = &[WallDistance::NAME];

    fn new(world: &World, seed: u64) -> Result<Self, WorldError> {
        Simulation::new(world, seed)
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
