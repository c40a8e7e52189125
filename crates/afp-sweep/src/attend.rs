//! Who attends a run of a sweep: whoever judges it, and whoever may call it off.

use std::sync::atomic::{AtomicBool, Ordering};

use afp::load::{LoadedPlan, PlanNames};
use afp_core::trace::Record;
use afp_core::{Environment, Instant};
use afp_run::judge::Judge;
use afp_run::rig::{Company, Go, Rig};
use afp_sim::{Simulation, Truth};

use crate::outcome::{Ending, Outcome};

type Loaded = LoadedPlan<Simulation>;

/// Everybody who attends a run.
struct Attendants<'a> {
    judge: Judge,
    stop: &'a AtomicBool,
}

impl Company<Loaded> for Attendants<'_> {
    fn wait(&mut self, _: Instant, _: Instant) -> Go {
        if self.stop.load(Ordering::Relaxed) { Go::Stop } else { Go::On }
    }

    fn hear(&mut self, at: Instant, record: &Record<'_>, names: &PlanNames, truth: &Truth<'_>) {
        self.judge.hear(at, record, names, truth);
    }

    fn looks(&self) -> bool {
        true
    }

    fn look(&mut self, now: Instant, truth: &Truth<'_>) {
        self.judge.look(now, truth);
    }
}

/// Runs a plan as `afpc run` does; `None` when it was called off.
pub(crate) fn drive(
    run: u64,
    mut rig: Rig<Loaded>,
    until: Instant,
    stop: &AtomicBool,
) -> Option<Outcome> {
    let mut attendants = Attendants { judge: Judge::new(rig.names()), stop };
    match rig.run(until, &mut attendants) {
        Ok(Go::Stop) => return None,
        Ok(_) => {}
        Err(error) => {
            let why = afp_run::inputs::missing(error, rig.names()).to_string();
            return Some(Outcome::failed(run, Ending::NotStarted, why));
        }
    }
    let ending = match rig.ending() {
        Some(afp_core::Ending::Ok) => Ending::Ok,
        Some(afp_core::Ending::Interrupted) => Ending::Interrupted,
        Some(afp_core::Ending::Error(_)) => Ending::Error,
        None => {
            rig.stop(&mut attendants);
            match rig.ending() {
                // Stopping may fail as well.
                Some(afp_core::Ending::Error(_)) => Ending::Error,
                _ => Ending::TimeLimit,
            }
        }
    };
    rig.sim.emergency_stop();
    Some(outcome(run, &rig, &attendants.judge, ending))
}

fn outcome(run: u64, rig: &Rig<Loaded>, judge: &Judge, ending: Ending) -> Outcome {
    let judged = judge.wall.seconds() > 0.0;
    let why = match ending {
        Ending::TimeLimit => "time limit".to_owned(),
        _ => judge.cause(rig.names()),
    };
    Outcome {
        run,
        ending,
        place: judge.place(rig.names()).to_owned(),
        why,
        time_s: rig.sim.now().as_secs_f64(),
        distance_m: judge.distance,
        collisions: rig.sim.truth().collisions().len() as u64,
        interruptions: judge.interruptions,
        deadline_misses: rig.scheduler.misses(),
        wall_error_mean_m: judged.then(|| judge.wall.mean()),
        wall_error_max_m: judged.then_some(judge.wall.max),
        trace: rig.trace().to_string(),
        took_s: 0.0,
    }
}
