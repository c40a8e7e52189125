//! A single run of a sweep, with its verdict.

use std::sync::atomic::{AtomicBool, Ordering};

use afp_core::Instant;
use afp_session::{AnySession, Counts, Go, Observer, Track};

use crate::outcome::{CONTACTS, Ending, Outcome, numbers, touched};

/// Runs a plan like `afpc run`; returns `None` after a cancellation.
pub(crate) fn drive(
    run: u64,
    session: &mut dyn AnySession,
    until: Instant,
    stop: &AtomicBool,
    more: &mut [&mut dyn Observer],
) -> Option<Outcome> {
    let mut counts = Counts::new(session.names());
    let mut track = Track::distance_alone(session.devices());
    let mut observers: Vec<&mut dyn Observer> = vec![&mut counts, &mut track];
    for observer in more.iter_mut() {
        observers.push(&mut **observer);
    }
    let mut gate =
        |_: Instant, _: Instant| if stop.load(Ordering::Relaxed) { Go::Stop } else { Go::On };
    match session.run(until, &mut gate, &mut observers) {
        Ok(Go::Stop) => return None,
        Ok(_) => {}
        Err(error) => {
            let why = afp_run::inputs::missing(error, session.names()).to_string();
            return Some(Outcome::failed(run, Ending::NotStarted, why));
        }
    }
    let ending = match session.ending() {
        Some(afp_core::Ending::Ok) => Ending::Ok,
        Some(afp_core::Ending::Interrupted) => Ending::Interrupted,
        Some(afp_core::Ending::Error(_)) => Ending::Error,
        None => {
            session.stop(&mut observers);
            match session.ending() {
                // Stopping the robot can also fail.
                Some(afp_core::Ending::Error(_)) => Ending::Error,
                _ => Ending::TimeLimit,
            }
        }
    };
    Some(outcome(run, session, &counts, track.distance, ending))
}

fn outcome(
    run: u64,
    session: &mut dyn AnySession,
    counts: &Counts,
    distance_m: f64,
    ending: Ending,
) -> Outcome {
    let figures = session.end();
    let why = match ending {
        Ending::TimeLimit => "time limit".to_owned(),
        _ => counts.cause(session.names()),
    };
    Outcome {
        run,
        ending,
        place: counts.last(session.names()).to_owned(),
        why,
        time_s: session.now().as_secs_f64(),
        distance_m,
        collisions: figures.spans(CONTACTS).len() as u64,
        touched: touched(&figures),
        interruptions: counts.interruptions,
        deadline_misses: session.misses(),
        figures: numbers(&figures),
        trace: session.trace().to_string(),
        took_s: 0.0,
    }
}
