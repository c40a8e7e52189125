//! Counts of suspended elements.

use afp_core::Duration;
use afp_session::{AnySession, Counts, Open, Session};

use super::{Toy, at, plan};

/// The wait is suspended after 0.7 s, for a second.
const PAUSED: &str = "use std
plan Paused {
    start wait
    actor wait: Wait(duration = 1 s) {
        supervise pause: After(duration = 700 ms) { Elapsed -> suspend rest }
        Elapsed -> terminate
    }
    actor rest: Wait(duration = 1 s) { Elapsed -> return }
}";

#[test]
fn the_time_of_a_suspension_is_not_the_time_of_the_element() {
    let mut session = Session::loaded(plan(PAUSED), Toy::new());
    let mut counts = Counts::new(AnySession::names(&session));
    session.run(at(5000), &mut Open, &mut [&mut counts]).unwrap();
    let [_, wait, rest, pause] = &counts.components[..] else { panic!("{counts:?}") };
    let used = [wait, rest].map(|usage| (usage.starts, usage.interruptions, usage.active));
    assert_eq!(used, [(1, 0, Duration::from_secs(1)); 2]);
    assert_eq!((pause.starts, pause.events()), (2, 1));
    assert_eq!(session.now(), at(2000));
}
