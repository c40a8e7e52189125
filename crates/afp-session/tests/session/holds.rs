//! Holds of a control and their ends, and holds of a plan.

use afp_core::{Duration, Instant, Platform as _, Release};
use afp_session::{AnySession, Applied, Observer, Open, Request, RequestError, Session, Stimulus};

use super::{FRONT, Toy, at, session};

afp_macros::plan!("../afp/examples/patience.afp");

/// Requests, and changes of the control, each with its time in milliseconds.
type Case<'a> = (&'a [(u64, Request)], &'a [(u64, bool)]);

#[test]
fn a_control_is_pressed_until_its_last_holder_releases_it() {
    let hold = |lasting| Request::Hold(FRONT, Duration::from_millis(lasting));
    let (press, release) = (Request::Press(FRONT, true), Request::Press(FRONT, false));
    let cases: [Case<'_>; 5] = [
        (
            &[(100, hold(500)), (200, hold(100))],
            &[(150, true), (350, true), (590, true), (610, false)],
        ),
        (
            &[(100, hold(100)), (200, hold(100))],
            &[(199, true), (200, true), (299, true), (301, false)],
        ),
        // The order of the requests does not matter.
        (
            &[(200, hold(100)), (100, hold(100))],
            &[(199, true), (200, true), (299, true), (301, false)],
        ),
        // A release ends all holds, and their later ends do not affect new holds.
        (
            &[(100, hold(500)), (200, release), (300, hold(600))],
            &[(190, true), (250, false), (310, true), (650, true), (890, true), (910, false)],
        ),
        (&[(100, press), (200, hold(100))], &[(350, true), (5000, true)]),
    ];
    for (requests, looks) in cases {
        let mut session = session();
        for (millis, request) in requests {
            session.at(at(*millis), request.clone()).unwrap();
        }
        let mut told = Told::default();
        for (millis, pressed) in looks {
            session.run(at(*millis), &mut Open, &mut [&mut told]).unwrap();
            assert_eq!(session.robot().is_pressed(), *pressed, "{requests:?} at {millis} ms");
        }
        // The requests of a run, repeated as from a log, make the same run.
        let end = session.robot().now();
        let mut repeated = super::session();
        for (at, what) in &told.0 {
            let request =
                what.request(AnySession::devices(&repeated), AnySession::names(&repeated));
            repeated.at(*at, request.unwrap()).unwrap();
        }
        let mut again = Told::default();
        repeated.run(end, &mut Open, &mut [&mut again]).unwrap();
        assert_eq!((repeated.trace(), again.0), (session.trace(), told.0), "{requests:?}");
    }
}

/// Collects requests from outside.
#[derive(Default)]
struct Told(Vec<(Instant, Stimulus)>);

impl Observer for Told {
    fn on_request(&mut self, applied: &Applied<'_>) {
        assert_eq!(applied.refused, None);
        self.0.push((applied.at, applied.what.clone()));
    }
}

#[test]
fn only_an_interpreted_plan_can_be_held() {
    let compiled = Session::new(Patience::new(), Toy::new());
    for request in [Request::Pause, Request::Release(Release::Step)] {
        assert_eq!(compiled.can(&request), Err(RequestError::NotHeld));
        assert_eq!(session().can(&request), Ok(()));
    }
}
