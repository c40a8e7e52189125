//! Requests for a path or a view allocate nothing: only the job may, on its worker.
//!
//! This is a separate test binary, because it counts in the global allocator.

use afp_carbot::Path;
use afp_carbot::devices::{Aim, Beam, Belief, Body, Echo, Trip};
use afp_core::quantity::{Angle, Length};
use afp_core::{Fault, Instant, Poll, Ticket, Worker};
use afp_counting::{Counting, allocations};
use afp_navigation::maps::{EchoField, Map, Planner, SearchJob};

#[global_allocator]
static ALLOCATOR: Counting = Counting::SYSTEM;

/// Takes jobs and never runs them.
struct Idle {
    jobs: Vec<SearchJob>,
    begun: u64,
}

impl Worker<SearchJob> for Idle {
    fn begin(
        &mut self,
        _: Instant,
        prepare: &mut dyn FnMut(&mut SearchJob),
    ) -> Result<Option<Ticket>, Fault> {
        let slot = self.begun as usize % self.jobs.len();
        prepare(&mut self.jobs[slot]);
        self.begun += 1;
        Ok(Some(Ticket::new(slot as u16, self.begun)))
    }

    fn poll(&mut self, _: Ticket, _: Instant) -> Result<Poll<&SearchJob>, Fault> {
        Ok(Poll::Pending)
    }

    fn cancel(&mut self, _: Ticket, _: Instant) {}
}

#[test]
fn requests_allocate_nothing() {
    let metres = Length::from_si;
    let beam = Beam {
        forward: metres(0.1),
        opening: Angle::from_deg(30.0),
        min: metres(0.03),
        max: metres(4.0),
    };
    let body = Body { front: metres(0.2), rear: metres(0.2), half_width: metres(0.175) };
    let wall = |y: f64| vec![[-4.0, y], [4.0, y], [4.0, y + 0.1], [-4.0, y + 0.1]];
    let field = EchoField::new(Map::new([wall(-3.0), wall(3.0)]), &beam);
    let mut planner = Planner::new(field, &body, beam.forward, |jobs| Idle { jobs, begun: 0 });
    let seen = Path::new((0..Path::MOST).map(|n| [n as f64 / 50.0, 0.0])).unwrap();
    let here = (metres(0.0), metres(0.0));
    // Unknown obstacles all around: more than the limit.
    let hear = |planner: &mut Planner<Idle>, round: u64| {
        for degrees in 0..360 {
            let (bearing, distance) = (Angle::from_deg(f64::from(degrees)), Some(metres(1.2)));
            planner.on_echo(
                &Echo { bearing, distance },
                &Belief::default(),
                Instant::from_nanos(round),
            );
        }
    };
    let ask = |planner: &mut Planner<Idle>| {
        let place = Aim::Place { at: (metres(3.0), metres(1.0)), near: metres(0.1) };
        let view = Aim::View { seen: &seen, sight: metres(4.0) };
        for to in [place, view, place] {
            let ticket = planner.search(&Trip { from: here, to }, Instant::from_nanos(3)).unwrap();
            assert!(ticket.is_some());
        }
    };
    // The field computes cells on their first use.
    hear(&mut planner, 1);
    let before = allocations();
    hear(&mut planner, 2);
    ask(&mut planner);
    assert_eq!(allocations() - before, 0);
}
