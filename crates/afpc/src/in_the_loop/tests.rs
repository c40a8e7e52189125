//! Plants and controllers over a pseudo-terminal, without the command line.

use std::sync::Arc;

use afp_core::{Duration, Instant};
use afp_dsl::files::Texts;
use afp_dsl::{Toolboxes, compile};
use afp_session::{Open, SampleRef};
use afp_syntax::source::Source;

use super::*;

const PLAN: &str = "use carbot\nuse std\nplan Way {\n    start ahead\n    \
    actor ahead: Forward(distance = 60 cm) { ForwardSuccessful -> turn }\n    \
    actor turn: Turn(angle = 90 deg) { TurnSuccessful -> on }\n    \
    actor on: Forward(distance = 40 cm) { ForwardSuccessful -> terminate }\n}\n";

const WORLD: &str = "version = 1\nname = \"Empty\"\n[robot]\npose_m_deg = [0.0, 0.0, 0.0]\n";

/// Runs the plan and returns the true end of the robot.
fn end(loader: &dyn Loader, world: &dyn AnyWorld) -> [f64; 3] {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", PLAN), &toolboxes, &Texts::default());
    let graph = compiled.graph.clone().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut session = loader.session(&graph, world, 1, &[]).unwrap();
    session.set_rest(Duration::from_secs(1));
    session.run(Instant::ZERO + Duration::from_secs(60), &mut Open, &mut []).unwrap();
    assert!(session.ending().is_some(), "the plan does not end");
    let mut end = None;
    session.read(afp_carbot::table::signal::POSE, &mut |sample| {
        if let SampleRef::Pose(transform) = sample {
            end = Some([transform.pose.x, transform.pose.y, transform.pose.heading]);
        }
    });
    session.end();
    end.expect("the simulator knows the pose")
}

/// The robot behind its protocol ends where the simulated one does.
fn ends_as_simulated(project: &str) {
    let robot = afp_project::read(project).0.robot.unwrap().profile.unwrap();
    let looped = loader(Some(&robot)).unwrap();
    let text = robot.in_world().into_iter().fold(WORLD.to_owned(), |text, (key, value)| {
        let key = key.strip_prefix("robot.").unwrap();
        let metres = robot
            .profile()
            .unwrap()
            .sections
            .iter()
            .flat_map(|section| section.settings)
            .find(|setting| setting.in_world.is_some_and(|known| known.ends_with(key)))
            .unwrap()
            .of
            .read(value)
            .unwrap();
        format!("{text}{key} = {metres}\n")
    });
    let world: Arc<dyn AnyWorld> = looped.kind().world(&text).unwrap();
    let carbot = afp_sim::carbot(|_| ());
    let (pure, behind) = (end(&carbot, &*world), end(&looped, &*world));
    let apart = (pure[0] - behind[0]).hypot(pure[1] - behind[1]);
    println!("{}: {pure:?} and {behind:?}, {:.1} mm apart", robot.name, apart * 1000.0);
    // The simulated wheel counters are wrong by up to 1%, of a way of 1 m.
    assert!(apart < 0.03, "{pure:?} {behind:?}");
    assert!((pure[2] - behind[2]).abs() < 0.05, "{pure:?} {behind:?}");
}

#[test]
fn a_carbot_behind_its_protocol_ends_where_the_simulated_one_does() {
    ends_as_simulated(
        "[robot]\nprofile = 'carbot'\n[robot.body]\nlength = '24 cm'\nwidth = '18 cm'\n\
         [robot.drive]\ntrack = '14 cm'\nwheel_diameter = '65 mm'\nticks = 1440\n\
         fastest = '45 cm/s'\n[robot.ultrasonic]\nforward = '8 cm'\n",
    );
}

#[test]
fn a_ugv_behind_its_protocol_ends_where_the_simulated_one_does() {
    ends_as_simulated(
        "[robot]\nprofile = 'ugv'\n[robot.body]\nlength = '24 cm'\nwidth = '24 cm'\n\
         [robot.drive]\ntrack = '17 cm'\nfastest = '35 cm/s'\n",
    );
}

#[test]
fn a_robot_without_a_profile_is_refused() {
    let refused = loader(None).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("'--in-the-loop' needs a robot with a profile"), "{refused}");
}
