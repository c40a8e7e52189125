//! What everybody who drives the simulator has in common: one clock, one trace.

use afp::load::{LoadedPlan, Registry};
use afp_core::{Duration, Instant};
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_dsl::toolbox::Toolboxes;
use afp_run::rig::{Company, Go, Rig};
use afp_sim::{Defect, Fault, Sensor, Simulation, World};
use afp_syntax::source::Source;

const PLAN: &str = include_str!("../../../plans/wall_following.afp");
const ROOM: &str = include_str!("../../../worlds/wall_following.toml");

type Loaded = LoadedPlan<Simulation>;

fn rig() -> Rig<Loaded> {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let compiled = compile(&Source::new("plan.afp", PLAN), &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    afp_carbot::templates::register(&mut registry);
    let plan = LoadedPlan::new(graph, &registry).unwrap();
    let sim = Simulation::new(&World::parse(ROOM).unwrap(), 3).unwrap();
    Rig::new(plan, sim, Duration::ZERO)
}

/// Looks or not, and may stop the run at an instant.
struct Guest {
    looks: bool,
    stop: Instant,
}

impl Company<Loaded> for Guest {
    fn wait(&mut self, target: Instant, _: Instant) -> Go {
        if target > self.stop { Go::Stop } else { Go::On }
    }

    fn looks(&self) -> bool {
        self.looks
    }
}

fn at(seconds: u64) -> Instant {
    Instant::ZERO + Duration::from_secs(seconds)
}

const QUIET: Guest = Guest { looks: false, stop: Instant::MAX };

#[test]
fn a_slow_sensor_makes_polls_late_whoever_drives() {
    let mut rig = rig();
    let slow = Defect::Slow(Duration::from_millis(20));
    rig.sim.inject(Fault::Sensor(Sensor::Touch, slow), Instant::ZERO, Duration::MAX);
    assert_eq!(rig.run(at(2), &mut { QUIET }), Ok(Go::On));
    assert!(rig.scheduler.misses() > 50, "{}", rig.scheduler.misses());
}

#[test]
fn looking_and_pausing_do_not_change_the_run() {
    let mut whole = rig();
    assert_eq!(whole.run(at(20), &mut { QUIET }), Ok(Go::On));
    let mut parts = rig();
    let mut guest = Guest { looks: true, stop: at(7) };
    assert_eq!(parts.run(at(20), &mut guest), Ok(Go::Stop));
    assert!(parts.sim.now() <= at(7));
    guest.stop = Instant::MAX;
    assert_eq!(parts.run(at(11), &mut guest), Ok(Go::On));
    assert_eq!(parts.run(at(20), &mut guest), Ok(Go::On));
    assert_eq!((parts.trace(), parts.sim.now()), (whole.trace(), at(20)));
    parts.stop(&mut guest);
    assert_ne!(parts.trace(), whole.trace());
    assert!(parts.ending().is_some());
}
