//! Each rule, broken once.

use super::*;
use afp_carbot::devices::Navigator;
use afp_core::ValueRef;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::trace::{
    Author, ComponentId, ComponentName, EntryName, Outcome, Reaction, TraceEntryId,
};
use afp_sim::World;

const ROOM: &str = "version = 1\n[robot]\npose_m_deg = [2, 2, 0]\n[[wall]]\n\
    points_m = [[0, 0], [9, 0], [9, 9], [0, 9]]\nclosed = true\n";

/// A plan of one actor, 1.
struct One;

impl Names for One {
    fn components(&self) -> u32 {
        2
    }
    fn component(&self, id: ComponentId) -> ComponentName<'_> {
        let kind = if id.0 == 0 { ComponentKind::Plan } else { ComponentKind::Actor };
        ComponentName { path: "one", kind, template: "One" }
    }
    fn outcome(&self, _: ComponentId, _: Outcome) -> &str {
        ""
    }
    fn target(&self, _: ComponentId, _: Outcome) -> &str {
        ""
    }
    fn reaction(&self, _: ComponentId, _: u16) -> Option<Reaction<'_>> {
        None
    }
    fn input(&self, _: ComponentId, _: u16) -> &str {
        ""
    }
    fn entries(&self) -> u32 {
        0
    }
    fn entry(&self, _: TraceEntryId) -> EntryName<'_> {
        EntryName::NONE
    }
    fn choice(&self, _: TraceEntryId, _: u16) -> &str {
        ""
    }
}

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

fn watched() -> (Simulation, Watch) {
    let world = World::parse(ROOM).expect("the room is well-formed");
    let sim = Simulation::new(&world, 1).expect("the room can be built");
    let watch = Watch::new(&sim, Duration::from_millis(300), 9.0);
    (sim, watch)
}

/// Drives every 10 ms with valid odometry, up to but without `end`.
fn drive(watch: &mut Watch, from: u64, end: u64) {
    for millis in (from..end).step_by(10) {
        watch.step(at(millis));
        watch.told(Sensor::Odometry, true, at(millis), at(millis));
        watch.commanded(0.2, 0.0, at(millis));
    }
}

#[track_caller]
fn breaks(watch: Watch, why: &str) {
    let broken = watch.broken();
    assert!(broken.first().is_some_and(|(_, said)| said.contains(why)), "{broken:?}");
}

#[test]
fn driving_on_an_old_or_invalid_odometry_breaks_a_rule() {
    for (valid, measured) in [(true, 10), (false, 200)] {
        let (_, mut watch) = watched();
        watch.told(Sensor::Odometry, valid, at(measured), at(200));
        watch.commanded(0.0, 0.0, at(200));
        assert!(watch.broken.is_empty());
        watch.commanded(0.1, 0.0, at(200));
        breaks(watch, "odometry");
    }
}

#[test]
fn driving_on_without_a_usable_echo_breaks_a_rule() {
    // New invalid readings, and the same valid one repeatedly.
    for valid in [false, true] {
        let (_, mut watch) = watched();
        watch.told(Sensor::Ultrasonic, true, at(10), at(20));
        for millis in (20..560).step_by(20) {
            let measured = if valid { 10 } else { millis };
            watch.told(Sensor::Ultrasonic, valid, at(measured), at(millis));
            drive(&mut watch, millis, millis + 20);
        }
        assert!(watch.broken.is_empty(), "{:?}", watch.broken);
        drive(&mut watch, 560, 600);
        breaks(watch, "ultrasonic said nothing");
    }
}

#[test]
fn a_sensor_without_a_reading_since_the_actors_start_does_not_count() {
    let (_, mut watch) = watched();
    watch.told(Sensor::Ultrasonic, false, at(0), at(0));
    watch.on_record(at(10), &Record::Started { component: ComponentId(1) }, &One);
    drive(&mut watch, 10, 1000);
    assert!(watch.broken.is_empty(), "{:?}", watch.broken);
}

#[test]
fn a_motion_left_behind_breaks_a_rule() {
    let element = ComponentId(1);
    for record in
        [Record::Interrupted { element }, Record::Finished { element, state: Outcome::Declared(0) }]
    {
        let (_, mut watch) = watched();
        drive(&mut watch, 0, 20);
        watch.on_record(at(20), &record, &One);
        breaks(watch, "0.2 m/s, 0 rad/s remain");
    }
    for then in [Record::Started { component: element }, Record::StopRequested] {
        let (_, mut watch) = watched();
        drive(&mut watch, 0, 20);
        let fault = afp_carbot::guard::NO_RANGE;
        watch.on_record(at(20), &Record::Faulted { component: element, fault, detail: None }, &One);
        watch.on_record(at(20), &then, &One);
        watch.stepped(at(20));
        breaks(watch, "failed");
    }
}

#[test]
fn a_second_actor_or_a_torn_commit_breaks_a_rule() {
    let (_, mut watch) = watched();
    let starts = Record::Started { component: ComponentId(1) };
    watch.on_record(at(0), &starts, &One);
    watch.on_record(at(10), &Record::Interrupted { element: ComponentId(1) }, &One);
    watch.on_record(at(10), &starts, &One);
    assert!(watch.broken.is_empty(), "{:?}", watch.broken);
    watch.on_record(at(20), &starts, &One);
    breaks(watch, "'one' starts while 'one' is active");

    let writes = |old, new| Record::Committed {
        author: Author::Component(ComponentId(1)),
        entry: TraceEntryId(0),
        old: ValueRef::Int(old),
        new: ValueRef::Int(new),
    };
    for (between, old, why) in [(None, 2, "twice"), (Some(Record::StopRequested), 1, "was Int(2)")]
    {
        let (_, mut watch) = watched();
        watch.on_record(at(0), &writes(1, 2), &One);
        between.iter().for_each(|record| watch.on_record(at(0), record, &One));
        watch.on_record(at(0), &writes(old, 3), &One);
        breaks(watch, why);
    }
}

#[test]
fn a_command_that_is_not_finite_breaks_a_rule() {
    let (_, mut watch) = watched();
    watch.told(Sensor::Odometry, true, at(0), at(0));
    watch.commanded(f64::NAN, 0.0, at(0));
    breaks(watch, "NaN m/s");
}

#[test]
fn a_motion_after_the_end_breaks_a_rule() {
    let (_, mut watch) = watched();
    let (plan, ending) = (ComponentId(0), afp_core::Ending::Ok);
    watch.on_record(at(0), &Record::Ended { plan, ending }, &One);
    watch.stepped(at(0));
    assert!(watch.broken.is_empty());
    drive(&mut watch, 0, 10);
    breaks(watch, "after the end");
}

/// The robot drives for a second and is then commanded to stop, but receives nothing before `stop`.
fn rolls(chance: &Chance, stop: u64) -> Watch {
    let (mut sim, mut watch) = watched();
    watch.happened(chance);
    let mut next = 0;
    for millis in (0..2500).step_by(10) {
        sim.advance_to(at(millis));
        chance.happen(&mut next, &mut sim);
        if millis < stop {
            sim.drive(Speed::from_si(0.3), AngularSpeed::from_si(0.0), at(millis));
        } else {
            sim.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0), at(millis));
        }
        if millis < 1000 {
            watch.told(Sensor::Odometry, true, at(millis), at(millis));
            watch.commanded(0.3, 0.0, at(millis));
        } else {
            watch.commanded(0.0, 0.0, at(millis));
        }
        watch.look(&sim);
    }
    watch
}

#[test]
fn a_robot_that_rolls_past_its_stop_time_breaks_a_rule() {
    assert_eq!(rolls(&Chance::default(), 1000).broken(), []);
    breaks(rolls(&Chance::default(), 1100), "after the command to stand");
}

#[test]
fn a_slippery_floor_or_a_deaf_controller_allows_more_time() {
    let slip = Stimulus::Break(Fault::WheelsSlip { share: 0.1 }, Duration::MAX);
    let slip = Chance(vec![(at(500), slip)]);
    assert_eq!(rolls(&slip, 1000).broken(), []);
    breaks(rolls(&slip, 1900), "after the command to stand");
    let deaf = Stimulus::Break(Fault::ControllerDead, Duration::from_millis(400));
    let deaf = Chance(vec![(at(950), deaf)]);
    assert_eq!(rolls(&deaf, 1000).broken(), []);
    breaks(rolls(&deaf, 1500), "after the command to stand");
}

#[test]
fn a_robot_out_of_the_room_breaks_a_rule() {
    let (sim, _) = watched();
    let mut watch = Watch::new(&sim, Duration::ZERO, 1.5);
    watch.look(&sim);
    breaks(watch, "the robot is at");
}

/// Drives for a second with an infrared sensor whose reading at every poll was measured at `time`.
fn drive_by_infrared(time: impl Fn(u64) -> u64) -> Watch {
    let (_, mut watch) = watched();
    for millis in (1000..2000).step_by(10) {
        watch.step(at(millis));
        watch.told(Sensor::Odometry, true, at(millis), at(millis));
        watch.told(Sensor::Infrared, true, at(time(millis)), at(millis));
        watch.commanded(0.2, 0.0, at(millis));
    }
    watch
}

#[test]
fn a_late_infrared_reading_is_usable_while_it_is_new() {
    let late = drive_by_infrared(|now| (now - 341) / 50 * 50);
    assert_eq!(late.broken(), []);
    breaks(drive_by_infrared(|_| 900), "infrared said nothing");
    breaks(drive_by_infrared(|now| now - 510), "infrared said nothing");
}
