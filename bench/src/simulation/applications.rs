//! Applications in the simulator compared with real time: the cost of localisation, path planning
//! and the camera.

use afp_sim::World;
use std::hint::black_box;

use super::{NoLog, drive};
use crate::measure::Race;
use crate::plans::{find_object::GoToObject, navigate_room::NavigateRoom};
use crate::report::{Report, Row};

/// The smallest speeds as a multiple of real time: with localisation, and with the camera.
const OF_REAL_TIME: [f64; 2] = [500.0, 100.0];

/// Measures a drive to another room and one to an object.
pub(super) fn run(rounds: u32, report: &mut Report) {
    let world = |text| World::parse(text).unwrap_or_else(|why| panic!("{why:?}"));
    let flat = world(include_str!("../../../worlds/navigate_room.toml"));
    let hall = world(include_str!("../../../worlds/find_object.toml"));
    let navigate = || drive(NavigateRoom::new(), &flat, &mut NoLog);
    let find = || drive(GoToObject::new(), &hall, &mut NoLog);
    let seconds = [navigate(), find()].map(|(end, _)| end.as_nanos() as f64 / 1e9);
    let mut race = Race::default();
    race.add("navigate_room, localisation", |count| {
        (0..count).for_each(|_| {
            black_box(navigate());
        });
    });
    race.add("find_object, camera", |count| {
        (0..count).for_each(|_| {
            black_box(find());
        });
    });
    let times = race.run(rounds.div_ceil(50));
    for ((case, seconds), least) in times.iter().zip(seconds).zip(OF_REAL_TIME) {
        let speed = seconds * 1e9 / case.median;
        let row = Row::new(format!("simulated second/{}, speed", case.name), speed, "x");
        let row = row.against("real time", speed);
        report.add(row.limit(format!(">= {least}"), speed >= least));
    }
}
