//! The sensors: their readings, their lines to the plan, and their signals in logs.
//!
//! A new sensor needs a field of [`Sensors`] with its device, a line in the list `lines!`, its
//! trait, and its signals in `sample_sensors`.

use super::robot::frame;
use super::{Simulation, Snapshot};
use crate::devices::battery::Battery as Cells;
use crate::devices::bumper::Switch;
use crate::devices::camera::{self, Exposure};
use crate::devices::color::ColorSensor as ColorEye;
use crate::devices::infrared::{self, Infrared};
use crate::devices::odometer::Odometer;
use crate::devices::rotator::Rotator;
use crate::devices::sonar::{self, RangeSensor};
use crate::noise::Source;
use crate::stage::DT;
use crate::vehicle::wheel::Wheel;
use crate::world::World;
use afp_carbot::devices::{
    Battery, Beam, Bump, Button, Buttons, Camera, Charge, Color, ColorSensor, Echo, Flow,
    FlowCamera, Frame, Glow, InfraredSensor, Invalid, Lens, Motion, Odometry, Reading,
    RotatingTelemetry, TouchSensor, Ultrasonic,
};
use afp_carbot::table::{Defect, Fault, signal};
use afp_carbot::trail::Trail;
use afp_core::quantity::Angle;
use afp_core::{Fault as PlanFault, Instant};
use afp_platform::Line;
use afp_session::frames::{BODY, BY_ODOMETRY, WORLD};
use afp_session::{Active, Image, Pose2, Ranging, SampleRef, Samples};
use std::sync::Arc;

/// The frames of range sensor and camera.
const SONAR: &str = "sonar";
const CAMERA: &str = "camera";

/// The measuring devices, with their latest readings.
#[derive(Clone)]
pub(super) struct Sensors {
    pub(super) odometer: Odometer,
    pub(super) rotator: Rotator,
    pub(super) sonar: RangeSensor,
    /// The ping in flight: the time and the content of its echo.
    pub(super) ping: Option<(Instant, Reading<Echo>)>,
    pub(super) echo: Reading<Echo>,
    pub(super) switch: Switch,
    /// Whether a hand holds the bumper pressed.
    pub(super) held: bool,
    pub(super) escape: bool,
    pub(super) battery: Cells,
    pub(super) infrared: Infrared,
    pub(super) glow: Reading<Option<Glow>>,
    pub(super) color_sensor: ColorEye,
    pub(super) color: Reading<Color>,
    pub(super) exposure: Reading<Arc<Exposure>>,
    /// The previous picture, for the ground truth of optical flow.
    pub(super) exposed_before: Option<Arc<Exposure>>,
    pub(super) lines: Lines,
    /// Whether a line has a delay.
    delayed: bool,
}

impl Sensors {
    pub(super) fn new(world: &World, seed: u64) -> Self {
        let mut differences = Source::Build.of(seed);
        let odometer = Odometer::new(seed, &mut differences, world.measures.encoders);
        let noise = Source::Ultrasonic.of(seed);
        Sensors {
            odometer,
            rotator: Rotator::new(),
            sonar: RangeSensor::new(sonar::CARBOT, noise, &mut differences),
            ping: None,
            echo: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            switch: Switch::new(Source::Bumper.of(seed)),
            held: false,
            escape: false,
            battery: Cells::new(world.charge),
            infrared: Infrared::new(seed),
            glow: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            color_sensor: ColorEye::new(seed),
            color: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            exposure: Reading { time: Instant::ZERO, value: Err(Invalid::NotYet) },
            exposed_before: None,
            lines: Lines::default(),
            delayed: false,
        }
    }

    /// Steps the devices that measure continuously; [`Simulation::see`] steps the devices with
    /// their own rates.
    pub(super) fn step(&mut self, wheels: &[Wheel; 2]) {
        self.odometer.step(wheels, DT);
        self.rotator.step(DT);
        let [left, right] = wheels;
        self.battery.step([left.speed(), right.speed()], DT);
    }
}

/// Generates the sensors' lines from a list: the device in the toolbox, the type of its readings,
/// the reading before the line, and the defect of each fault.
macro_rules! lines {
    ($($device:ident: $value:ty = $raw:expr, $defect:expr;)+) => {
        /// The lines from the sensors to the plan.
        #[derive(Clone, Debug, Default)]
        pub(super) struct Lines {
            $(pub(super) $device: Line<$value>,)+
        }

        pub(super) struct Raw;

        impl Raw {
            $(pub(super) fn $device(sim: &Simulation) -> Reading<$value> {
                let raw: fn(&Simulation) -> Reading<$value> = $raw;
                raw(sim)
            })+
        }

        impl Simulation {
            /// Sets exactly these defects on the lines.
            pub(super) fn set_lines(&mut self, active: &Active<'_, Fault>) {
                self.sensors.delayed = false;
                $({
                    // If there are two defects, the later one counts.
                    let (defect, raw) = (active.find($defect), Raw::$device(self));
                    self.sensors.delayed |= matches!(defect, Some(Defect::Delayed(_)));
                    self.sensors.lines.$device.set(defect, raw);
                })+
            }

            pub(super) fn note(&mut self) {
                if self.sensors.delayed {
                    let now = self.now;
                    $({
                        let raw = Raw::$device(self);
                        self.sensors.lines.$device.note(raw, now);
                    })+
                }
            }
        }
    };
}

lines! {
    ultrasonic: Echo = |sim| sim.sensors.echo, read_by_controller(Fault::ultrasonic);
    rotator: Angle = |sim| sim.measured(sim.sensors.rotator.telemetry()), read_by_controller(Fault::rotator);
    odometry: Motion = |sim| sim.measured(sim.sensors.odometer.motion()), read_by_controller(wheel_counters);
    touch: bool = |sim| sim.measured(sim.is_touched()), read_by_controller(Fault::touch);
    buttons: bool = |sim| Reading::valid(sim.sensors.escape, sim.now), read_by_controller(Fault::buttons);
    infrared: Option<Glow> = |sim| sim.sensors.glow, Fault::infrared;
    color: Color = |sim| sim.sensors.color, Fault::color;
    camera: Arc<Exposure> = |sim| sim.sensors.exposure.clone(), Fault::camera;
    battery: Charge = |sim| sim.measured(sim.sensors.battery.charge()), Fault::battery;
}

/// The defect of a sensor that the controller reads.
fn read_by_controller(own: fn(Fault) -> Option<Defect>) -> impl Fn(Fault) -> Option<Defect> {
    move |fault| match fault {
        Fault::ControllerRestarted | Fault::ControllerStalled => Some(Defect::Lost),
        fault => own(fault),
    }
}

/// The defect of the odometry for a fault of the controller, which counts the wheels.
fn wheel_counters(fault: Fault) -> Option<Defect> {
    match fault {
        Fault::ControllerDead => Some(Defect::Lost),
        fault => fault.odometry(),
    }
}

impl Simulation {
    /// The plan's reading, after the line.
    fn deliver<T: Clone>(&self, line: &Line<T>, raw: Reading<T>) -> Reading<T> {
        line.sense(raw, self.now, &self.clock)
    }

    /// Charges the time for one use of a sensor.
    fn charge_for<T: Clone>(&self, line: &Line<T>) {
        if let Some(cost) = line.cost() {
            self.clock.spend(self.now, cost);
        }
    }

    fn measured<T>(&self, value: T) -> Reading<T> {
        Reading { time: self.grid(self.steps), value: Ok(value) }
    }
}

impl Odometry for Simulation {
    fn motion(&self) -> Reading<Motion> {
        self.deliver(&self.sensors.lines.odometry, Raw::odometry(self))
    }

    fn last_bump(&self) -> Option<Bump> {
        self.bump
    }

    fn trail(&self) -> Trail {
        self.trail
    }
}

impl Ultrasonic for Simulation {
    fn echo(&self) -> Reading<Echo> {
        self.deliver(&self.sensors.lines.ultrasonic, Raw::ultrasonic(self))
    }

    fn beam(&self) -> Beam {
        sonar::beam(self.measures.sonar)
    }
}

impl RotatingTelemetry for Simulation {
    fn bearing(&self) -> Reading<Angle> {
        self.deliver(&self.sensors.lines.rotator, Raw::rotator(self))
    }
}

impl TouchSensor for Simulation {
    fn touched(&self) -> Reading<bool> {
        self.deliver(&self.sensors.lines.touch, Raw::touch(self))
    }
}

impl Buttons for Simulation {
    fn pressed(&self, button: Button) -> Reading<bool> {
        match button {
            Button::Escape => self.deliver(&self.sensors.lines.buttons, Raw::buttons(self)),
        }
    }
}

impl InfraredSensor for Simulation {
    fn glow(&self) -> Reading<Option<Glow>> {
        self.deliver(&self.sensors.lines.infrared, Raw::infrared(self))
    }

    fn field_of_view(&self) -> Angle {
        Angle::from_si(infrared::FIELD)
    }
}

impl ColorSensor for Simulation {
    fn color(&self) -> Reading<Color> {
        self.deliver(&self.sensors.lines.color, Raw::color(self))
    }
}

impl Camera for Simulation {
    fn frame(&self) -> Reading<Frame<'_>> {
        self.charge_for(&self.sensors.lines.camera);
        let Reading { time, value } = self.sensors.lines.camera.look(&self.sensors.exposure);
        Reading { time, value: value.map(|exposure| exposure.frame()) }
    }

    fn lens(&self) -> Lens {
        camera::lens()
    }
}

impl FlowCamera for Simulation {
    fn flow(&mut self, now: Instant) -> Result<Reading<Flow<'_>>, PlanFault> {
        self.charge_for(&self.sensors.lines.camera);
        let Reading { time, value } = self.sensors.lines.camera.look(&self.sensors.exposure);
        let frame = Reading { time, value: value.map(|exposure| exposure.frame()) };
        let sensor = self.flow.get_or_insert_with(|| Box::new(camera::flow_sensor()));
        sensor.look(frame, now)
    }
}

impl Battery for Simulation {
    fn charge(&self) -> Reading<Charge> {
        self.deliver(&self.sensors.lines.battery, Raw::battery(self))
    }
}

impl Simulation {
    pub(super) fn sample_sensors(&self, to: &mut Samples<'_, '_>) {
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
        to.put(signal::BUTTONS_ESCAPE, SampleRef::Bool(self.sensors.escape));
        to.put(signal::BATTERY_LEFT, SampleRef::Float(self.sensors.battery.charge().left));
        self.sample_light(to);
    }

    pub(super) fn sample_camera(&self, to: &mut Samples<'_, '_>) {
        let eye = Pose2 { x: camera::FORWARD, ..Pose2::default() };
        to.put(signal::CAMERA_FRAME, frame(BODY, CAMERA, eye, camera::HEIGHT));
        if to.wants(signal::CAMERA_PICTURE)
            && let Some((time, picture)) = self.view()
        {
            let (width, height) = (picture.width as u32, picture.height as u32);
            let image = Image { time, frame: CAMERA, width, height, rgb: picture.rgb };
            to.put(signal::CAMERA_PICTURE, SampleRef::Image(image));
        }
    }

    /// The latest readings of the light sensors, before their lines.
    fn sample_light(&self, to: &mut Samples<'_, '_>) {
        if let Ok(Some(glow)) = self.sensors.glow.value {
            to.put(signal::INFRARED_DIRECTION, SampleRef::Float(glow.bearing.si()));
            to.put(signal::INFRARED_STRENGTH, SampleRef::Float(glow.strength));
        }
        if let Ok(Color { red, green, blue }) = self.sensors.color.value {
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
}
