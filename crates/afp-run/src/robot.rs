//! The simulated robot and its room as a log has them.

use afp_core::{Duration, Instant};
use afp_log::Recorder;
use afp_log::robot::{BELIEVED, Image, Pose2, Ranging, Shape, Transform};
use afp_sim::world::{Mobility, Obstacle};
use afp_sim::{Pose, Simulation, Snapshot, World};

use afp_carbot::devices::Ultrasonic;

const WORLD: &str = "world";
const BASE: &str = "base_link";
const SONAR: &str = "sonar";
const CAMERA: &str = "camera";

/// How often a log gets what the camera sees.
const FILM: Duration = Duration::from_millis(500);

/// How high the parts of the robot are, metres.
const BODY_HEIGHT: f64 = 0.22;
const SONAR_HEIGHT: f64 = 0.15;

/// Keeps a log up to date with the simulation.
pub struct RobotLog {
    start: Pose2,
    last_ping: Option<Instant>,
    /// When the camera is looked at next; never where it is not to be logged.
    camera: Instant,
    /// What moves, as it was last written.
    movers: Vec<(usize, Shape)>,
}

impl RobotLog {
    /// Writes what stands in the room, and the robot's body.
    ///
    /// With `camera` the log gets what the camera sees, twice a second.
    pub fn begin(log: &mut Recorder, world: &World, camera: bool) -> Self {
        let obstacles = || world.obstacles.iter().enumerate();
        let movers = obstacles().filter(|(_, obstacle)| obstacle.mobility != Mobility::Fixed);
        let movers = movers.map(|(index, obstacle)| (index, shape(index, obstacle))).collect();
        let obstacles = obstacles().map(|(index, obstacle)| shape(index, obstacle));
        let body = Shape {
            id: "robot".to_owned(),
            frame: BASE,
            outline: World::robot_outline(Pose::default()).to_vec(),
            height: BODY_HEIGHT,
            color: [0.15, 0.45, 0.75, 0.9],
        };
        log.scene(Instant::ZERO, obstacles.chain([body]).collect());
        let camera = if camera { Instant::ZERO } else { Instant::MAX };
        RobotLog { start: plane(world.start), last_ping: None, camera, movers }
    }

    /// Writes where the robot is and what it has heard since.
    pub fn look(&mut self, log: &mut Recorder, sim: &Simulation) {
        let Snapshot { time, pose, odometry, rotator, sonar, .. } = sim.snapshot();
        let beam = sim.beam();
        log.pose(time, WORLD, plane(pose));
        let moved =
            Pose2 { x: odometry.x.si(), y: odometry.y.si(), heading: odometry.heading.si() };
        let sensor = Pose2 { x: beam.forward.si(), y: 0.0, heading: rotator };
        let of = |parent, child, pose, height| Transform { parent, child, pose, height };
        log.transforms(
            time,
            [
                of(WORLD, BASE, plane(pose), 0.0),
                of(BASE, SONAR, sensor, SONAR_HEIGHT),
                of(WORLD, BELIEVED, beyond(self.start, moved), 0.0),
            ],
        );
        if let Some(sonar) = sonar
            && self.last_ping != Some(sonar.time)
        {
            self.last_ping = Some(sonar.time);
            let pose = Pose2 { heading: sonar.bearing, ..sensor };
            let (half_angle, range) = (beam.opening.si() / 2.0, sonar.distance);
            log.ranging(time, Ranging { time: sonar.time, frame: BASE, pose, half_angle, range });
        }
        if time >= self.camera
            && let Some((taken, frame)) = sim.view()
        {
            self.camera = time + FILM;
            log.image(
                time,
                Image {
                    time: taken,
                    frame: CAMERA,
                    width: frame.width as u32,
                    height: frame.height as u32,
                    rgb: frame.rgb.into(),
                },
            );
        }
        self.look_at_movers(log, sim, time);
    }

    /// Writes where everything is that has moved since.
    fn look_at_movers(&mut self, log: &mut Recorder, sim: &Simulation, time: Instant) {
        let mut moved = Vec::new();
        for (obstacle, shape) in &mut self.movers {
            let outline = sim.outline(*obstacle);
            if outline != shape.outline {
                shape.outline = outline;
                moved.push(shape.clone());
            }
        }
        if !moved.is_empty() {
            log.scene(time, moved);
        }
    }
}

/// An obstacle as it stands at the start.
fn shape(index: usize, obstacle: &Obstacle) -> Shape {
    let [red, green, blue] = obstacle.look.color.map(|part| f64::from(part) / 255.0);
    Shape {
        id: format!("{index} {}", obstacle.name),
        frame: WORLD,
        outline: obstacle.outline.corners(),
        height: obstacle.height,
        color: [red, green, blue, 0.9],
    }
}

fn plane(pose: Pose) -> Pose2 {
    Pose2 { x: pose.x, y: pose.y, heading: pose.heading }
}

/// What is given against a pose (a motion begun there, a sensor on the robot), in the frame of the pose itself.
pub(crate) fn beyond(start: Pose2, moved: Pose2) -> Pose2 {
    let (sin, cos) = libm::sincos(start.heading);
    Pose2 {
        x: start.x + moved.x * cos - moved.y * sin,
        y: start.y + moved.x * sin + moved.y * cos,
        heading: start.heading + moved.heading,
    }
}
