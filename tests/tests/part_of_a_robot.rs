//! A robot with some of the Carbot's devices runs the plans that need only these.

use afp::load::{LoadError, LoadedPlan, Registry};
use afp::{Ending, Environment, Instant, Platform, Scheduler, StillClock};
use afp_carbot::devices::{Body, Motion, Navigator, Odometry, Reading};
use afp_core::quantity::{AngularSpeed, Length, Speed};
use afp_dsl::files::Texts;
use afp_syntax::source::Source;

/// Follows commands, and counts its wheels.
#[derive(Default)]
struct Cart {
    now: Instant,
    motion: Motion,
}

impl Platform for Cart {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    fn now(&self) -> Instant {
        self.now
    }

    fn advance(&mut self, to: Instant) {
        let seconds = to.since(self.now).as_secs_f64();
        self.motion.x = self.motion.x + Length::from_si(self.motion.speed.si() * seconds);
        self.now = self.now.max(to);
    }
}

impl Environment for Cart {
    fn stop(&mut self, now: Instant) {
        self.halt(now);
    }

    fn emergency_stop(&mut self) {
        self.motion.speed = Speed::from_si(0.0);
    }
}

impl Navigator for Cart {
    fn drive(&mut self, speed: Speed, _: AngularSpeed, _: Instant) {
        self.motion.speed = speed;
    }

    fn body(&self) -> Body {
        let [front, rear, half_width] = [0.2, 0.2, 0.15].map(Length::from_si);
        Body { front, rear, half_width }
    }
}

impl Odometry for Cart {
    fn motion(&self) -> Reading<Motion> {
        Reading::valid(self.motion, self.now)
    }
}

fn load(body: &str) -> Result<LoadedPlan<Cart>, LoadError> {
    let text = format!("use std\nuse carbot\nplan P {{ start a\n{body} }}");
    let toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new("plan.afp", text);
    let compiled = afp_dsl::compile(&source, &toolboxes, &Texts::default());
    let graph = compiled.graph.as_ref().unwrap_or_else(|| panic!("{}", compiled.render(false)));
    let mut registry = Registry::new();
    afp_std::register!(&mut registry, Cart);
    afp_carbot::register!(&mut registry, Cart);
    LoadedPlan::new(graph, &registry)
}

#[test]
fn plans_run_on_a_robot_with_the_needed_devices() {
    let plan = "actor a: Forward(distance = 50 cm) { ForwardSuccessful -> b }
        actor b: Wait { Elapsed -> terminate }";
    let (mut cart, mut plan) = (Cart::default(), Scheduler::new(load(plan).unwrap()));
    assert_eq!(plan.run(&mut cart).unwrap(), Ending::Ok);
    assert!((cart.motion.x.si() - 0.5).abs() < 0.01, "{:?}", cart.motion.x);
}

#[test]
fn a_missing_device_is_refused_by_name() {
    let plan =
        "actor a: Forward { supervise touch: CheckTouchSensor { TouchSensorPressed -> terminate }
        ForwardSuccessful -> terminate }";
    let refused = load(plan).err().map(|error| error.to_string()).unwrap_or_default();
    let begins = "the robot does not support 'carbot.CheckTouchSensor', used at plan.afp:4:30: ";
    assert!(refused.starts_with(begins), "{refused}");
    assert!(refused.contains("'TouchSensor'") && !refused.contains("'Navigator'"), "{refused}");
}
