//! The promises of actors that can be suspended, for each template.
//!
//! - T1: `suspend` stops all that the actor commands.
//! - T2: it gives up its job, and begins a new one.
//! - T3: the suspension counts neither as time nor as distance, and sensors get a new timeout.
//! - T4: the goal stays in the room; a robot that cannot continue from elsewhere gets a fault.
//! - T5: `resume` commands nothing.

use crate::devices::Motion;
use crate::fake::pause::Pauses;
use crate::fake::{Fake, plane};
use crate::helpers::aside::MOVED_AWAY;
use crate::helpers::motion::wrap;
use crate::objects::{Appearance, Path};
use crate::templates as t;
use afp_core::Fault;
use afp_core::quantity::{Angle, AngularSpeed, Frequency, Length, Speed, Time};
use afp_dsl::toolbox::{TemplateKind, Toolbox};
use afp_syntax::source::Source;
use std::collections::BTreeSet;
use std::string::String;
use std::vec;
use std::vec::Vec;

struct Case {
    template: &'static str,
    robot: fn() -> Fake,
    run: fn(&mut Fake, &Pauses) -> Result<String, Fault>,
    /// Whether it continues from a place 30 cm to the left.
    from_elsewhere: bool,
    /// Largest difference of the end: metres and degrees. `None` if there is no goal.
    off: Option<(f64, f64)>,
}

/// The end of a run: its state, place and time.
type End = (Result<String, Fault>, Motion, u64);

impl Case {
    fn of(self, robot: fn() -> Fake) -> Self {
        Case { robot, ..self }
    }

    fn elsewhere(self) -> Self {
        Case { from_elsewhere: true, ..self }
    }

    fn within(self, off: Option<(f64, f64)>) -> Self {
        Case { off, ..self }
    }

    fn run(&self, pauses: &Pauses) -> End {
        let mut robot = (self.robot)();
        let begin = robot.millis();
        let state = (self.run)(&mut robot, pauses);
        (state, robot.motion, robot.millis() - begin)
    }

    /// The whole run without a pause, and times of five pauses in it.
    fn reference(&self) -> (End, Vec<u64>) {
        let end = self.run(&Pauses::default());
        let at = (1..6).map(|part| (end.2 * part / 6 / 10) * 10).collect();
        (end, at)
    }

    fn compare(&self, (state, at, _): &End, (paused, end, _): &End) {
        let name = self.template;
        assert_eq!(paused, state, "{name}");
        let Some((far, wide)) = self.off else { return };
        let (dx, dy) = ((end.x - at.x).si(), (end.y - at.y).si());
        assert!(dx.hypot(dy) < far, "{name}: {dx} {dy}");
        let turned = wrap((end.heading - at.heading).si()).to_degrees();
        assert!(turned.abs() < wide, "{name}: {turned} deg");
    }
}

/// A case of a template that drives or turns towards a goal in an empty room.
fn exact(template: &'static str, run: fn(&mut Fake, &Pauses) -> Result<String, Fault>) -> Case {
    let robot = || Fake::new(&[]);
    Case { template, robot, run, from_elsewhere: false, off: Some((0.02, 2.0)) }
}

/// The run of a template with these inputs.
macro_rules! run {
    ($template:ident, $module:ident, $inputs:expr) => {
        |robot: &mut Fake, pauses: &Pauses| {
            let live = || t::$module::Live {};
            robot.run_paused::<t::$template, crate::$template>($inputs, live, pauses)
        }
    };
}

fn cases() -> Vec<Case> {
    [standing(), by_odometry(), along_walls(), by_sensors(), by_map()]
        .into_iter()
        .flatten()
        .collect()
}

/// Actors that keep the robot in place, and one without a goal.
fn standing() -> Vec<Case> {
    let (hold, stop) = (run!(Hold, hold, t::hold::Inputs {}), run!(Stop, stop, t::stop::Inputs {}));
    let signal = run!(Signal, signal_, {
        let (tone, period) = (Frequency::from_si(880.0), Time::from_si(0.4));
        t::signal_::Inputs { light: true, sound: true, tone, times: 3, period }
    });
    let drive = |robot: &mut Fake, pauses: &Pauses| {
        let live = || t::drive::Live { speed: speed(), turn: AngularSpeed::from_si(0.3) };
        robot.run_paused::<t::Drive, crate::Drive>(t::drive::Inputs {}, live, pauses)
    };
    vec![
        exact("Hold", hold).elsewhere(),
        exact("Stop", stop).of(rolling).elsewhere().within(None),
        exact("Signal", signal).elsewhere(),
        exact("Drive", drive).elsewhere().within(None),
        exact(
            "LearnObject",
            run!(LearnObject, learn_object, t::learn_object::Inputs { share: 0.2 }),
        )
        .of(before_a_post),
    ]
}

fn by_odometry() -> Vec<Case> {
    let forward =
        run!(Forward, forward, t::forward::Inputs { distance: metres(1.0), speed: speed() });
    let retrace =
        run!(Retrace, retrace, t::retrace::Inputs { distance: metres(0.5), speed: speed() });
    let turn = run!(Turn, turn, t::turn::Inputs { angle: Angle::from_deg(150.0), speed: rate() });
    let curve = run!(Curve, curve, {
        t::curve::Inputs { radius: metres(0.5), angle: Angle::from_deg(120.0), speed: speed() }
    });
    vec![
        exact("Forward", forward),
        exact("Retrace", retrace).of(after_a_turn),
        exact("Turn", turn),
        exact("Curve", curve),
    ]
}

fn along_walls() -> Vec<Case> {
    let search = run!(SearchWall, search_wall, {
        t::search_wall::Inputs { sweep: Angle::from_deg(60.0), range: metres(1.5) }
    });
    let look =
        run!(LookAround, look_around, t::look_around::Inputs { sweep: Angle::from_deg(120.0) });
    let follow = run!(WallForward, wall_forward, {
        t::wall_forward::Inputs {
            walldist: metres(0.3),
            lanedist: metres(0.3),
            gain: 1.0,
            tolerance: metres(0.2),
            absent: metres(0.15),
            step: metres(2.0),
            speed: speed(),
        }
    });
    vec![
        exact("SearchWall", search).of(before_a_wall),
        exact("LookAround", look).of(before_a_wall),
        exact("WallForward", follow).of(beside_a_wall),
    ]
}

/// Actors that steer by a sensor, and may stop anywhere within their tolerance.
fn by_sensors() -> Vec<Case> {
    let face = run!(TurnToInfrared, turn_to_infrared, {
        t::turn_to_infrared::Inputs { tolerance: Angle::from_deg(5.0), speed: rate() }
    });
    let approach = run!(ApproachInfrared, approach_infrared, {
        t::approach_infrared::Inputs { strength: 4.0, speed: speed() }
    });
    let find = |robot: &mut Fake, pauses: &Pauses| {
        let (look, tolerance) = (red(), Angle::from_deg(5.0));
        let inputs = t::find_object::Inputs { look: &look, tolerance, speed: rate() };
        let live = || t::find_object::Live {};
        robot.run_paused::<t::FindObject, crate::FindObject>(inputs, live, pauses)
    };
    let follow = |robot: &mut Fake, pauses: &Pauses| {
        let (look, distance) = (red(), metres(0.5));
        let inputs = t::follow_object::Inputs { look: &look, distance, speed: speed() };
        let live = || t::follow_object::Live {};
        robot.run_paused::<t::FollowObject, crate::FollowObject>(inputs, live, pauses)
    };
    let wide = Some((0.02, 6.0));
    vec![
        exact("TurnToInfrared", face).of(with_light).elsewhere().within(wide),
        exact("ApproachInfrared", approach).of(with_light).elsewhere(),
        exact("FindObject", find).of(beside_a_post).elsewhere().within(wide),
        exact("FollowObject", follow).of(far_from_a_post).elsewhere(),
    ]
}

fn by_map() -> Vec<Case> {
    let follow = |robot: &mut Fake, pauses: &Pauses| {
        let path = Path::new([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]).unwrap();
        let inputs = t::follow_path::Inputs { speed: speed(), tolerance: metres(0.1) };
        let live = || t::follow_path::Live { path: &path };
        robot.run_paused::<t::FollowPath, crate::FollowPath>(inputs, live, pauses)
    };
    let choose = |robot: &mut Fake, pauses: &Pauses| {
        let (seen, live) = (Path::default(), || t::choose_view::Live {});
        let inputs = t::choose_view::Inputs { seen: &seen, sight: metres(4.0) };
        robot.run_paused::<t::ChooseView, crate::ChooseView>(inputs, live, pauses)
    };
    let drive = run!(DriveTo, drive_to, {
        let (x, y, heading) = (metres(1.0), metres(0.5), Angle::from_deg(90.0));
        t::drive_to::Inputs { x, y, heading, speed: speed(), tolerance: metres(0.1) }
    });
    vec![
        exact("FollowPath", follow).elsewhere(),
        exact("ChooseView", choose).of(on_a_map).elsewhere(),
        exact("DriveTo", drive).elsewhere().within(Some((0.02, 4.0))),
    ]
}

fn metres(of: f64) -> Length {
    Length::from_si(of)
}

fn speed() -> Speed {
    Speed::from_si(0.2)
}

fn rate() -> AngularSpeed {
    AngularSpeed::from_si(0.8)
}

fn red() -> Appearance {
    Appearance::of_color([0.7, 0.15, 0.15], 0.08)
}

fn rolling() -> Fake {
    let mut robot = Fake::new(&[]);
    robot.drifts = 0.5;
    robot
}

fn after_a_turn() -> Fake {
    let mut robot = Fake::new(&[]);
    let none = Pauses::default();
    let inputs = t::forward::Inputs { distance: metres(0.4), speed: speed() };
    let live = || t::forward::Live {};
    robot.run_paused::<t::Forward, crate::Forward>(inputs, live, &none).unwrap();
    let inputs = t::turn::Inputs { angle: Angle::from_deg(40.0), speed: rate() };
    robot.run_paused::<t::Turn, crate::Turn>(inputs, || t::turn::Live {}, &none).unwrap();
    robot
}

fn before_a_wall() -> Fake {
    Fake::new(&[plane(-30.0, 0.7)])
}

fn beside_a_wall() -> Fake {
    Fake::new(&[plane(-90.0, 0.475)])
}

fn with_light() -> Fake {
    let mut robot = Fake::new(&[]);
    robot.light = Some((2.0, 1.5));
    robot
}

fn post(x: f64, y: f64) -> Fake {
    let mut robot = Fake::new(&[]);
    robot.post = Some((x, y));
    robot
}

fn before_a_post() -> Fake {
    post(0.8, 0.0)
}

fn beside_a_post() -> Fake {
    post(1.0, 1.5)
}

fn far_from_a_post() -> Fake {
    post(2.0, 0.7)
}

fn on_a_map() -> Fake {
    let mut robot = Fake::new(&[]);
    robot.view = [2.0, 1.0];
    robot
}

#[test]
fn each_actor_of_the_toolbox_can_be_suspended_and_has_a_case() {
    let source = Source::new("carbot.afp", t::SOURCE);
    let (toolbox, _) = Toolbox::parse(&source, 0, "afp_carbot");
    let mut templates = toolbox.map(|toolbox| toolbox.templates).unwrap_or_default();
    templates.retain(|template| template.kind == TemplateKind::Actor);
    assert!(templates.iter().all(|template| template.resumable));
    let names: BTreeSet<_> = templates.iter().map(|template| template.name.as_str()).collect();
    assert_eq!(cases().iter().map(|case| case.template).collect::<BTreeSet<_>>(), names);
}

#[test]
fn pauses_do_not_change_the_end() {
    for case in cases() {
        let (end, at) = case.reference();
        for pause in &at {
            let paused = case.run(&Pauses { at: vec![*pause], ..Pauses::default() });
            case.compare(&end, &paused);
            let longer = paused.2.saturating_sub(end.2);
            assert!((10_000..14_000).contains(&longer), "{}: {longer} ms", case.template);
        }
        case.compare(&end, &case.run(&Pauses { at, ..Pauses::default() }));
    }
}

#[test]
fn a_robot_that_is_elsewhere_continues_or_gets_a_fault() {
    for case in cases() {
        let ((state, ..), at) = case.reference();
        for pause in at {
            let pauses = Pauses { at: vec![pause], moved: 0.3, ..Pauses::default() };
            let (found, ..) = case.run(&pauses);
            let expected = if case.from_elsewhere { state.clone() } else { Err(MOVED_AWAY) };
            assert_eq!(found, expected, "{} at {pause} ms", case.template);
        }
    }
}

#[test]
fn a_suspended_actor_that_is_abandoned_commands_nothing() {
    for case in cases() {
        for pause in case.reference().1 {
            let pauses = Pauses { at: vec![pause], abandoned: true, ..Pauses::default() };
            assert_eq!(case.run(&pauses).0, Ok("-".into()), "{}", case.template);
        }
    }
}
