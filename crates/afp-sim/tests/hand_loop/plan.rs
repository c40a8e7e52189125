//! The transitions of `wall_following.afp` by hand.

use afp_carbot::{
    CheckDrivingLane, CheckTouchSensor, Forward, SearchWall, Turn, WallForward, templates,
};
use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use afp_core::{Actor, Duration, Events, Instant, Poll, Supervisor};
use afp_sim::Simulation;
use templates::{check_driving_lane, check_touch_sensor, forward, search_wall, turn, wall_forward};

type Touch = templates::CheckTouchSensor;
type Lane = templates::CheckDrivingLane;

/// The element that is active.
pub enum Active {
    SearchFirstWall { actor: Forward, touch: CheckTouchSensor, lane: CheckDrivingLane },
    BackupCollision(Forward),
    FindWallAngle(SearchWall),
    ParallelToWall(Turn),
    FollowWall { actor: WallForward, touch: CheckTouchSensor, since: Instant },
    TurnAfterWallLost(Turn),
}

/// Where the next edge leads.
enum To {
    SearchFirstWall,
    BackupCollision,
    FindWallAngle,
    ParallelToWall(Angle),
    FollowWall,
    TurnAfterWallLost,
}

pub struct Plan {
    active: Active,
    since: Instant,
}

const WALLDIST: Length = Length::from_si(0.30);
const SPEED: Speed = Speed::from_si(0.20);

impl Plan {
    pub fn start(sim: &mut Simulation) -> Plan {
        let now = Instant::ZERO;
        Plan { active: enter(To::SearchFirstWall, sim, now), since: now }
    }

    pub fn active(&self) -> &Active {
        &self.active
    }

    pub fn name(&self) -> &'static str {
        match self.active {
            Active::SearchFirstWall { .. } => "searchFirstWall",
            Active::BackupCollision(_) => "backupCollision",
            Active::FindWallAngle(_) => "findWallAngle",
            Active::ParallelToWall(_) => "parallelToWall",
            Active::FollowWall { .. } => "followWall",
            Active::TurnAfterWallLost(_) => "turnAfterWallLost",
        }
    }

    /// One step; to be called every millisecond.
    pub fn step(&mut self, sim: &mut Simulation, now: Instant) {
        let age = now.since(self.since);
        let due = |ms| age > Duration::ZERO && age.as_nanos().is_multiple_of(ms * 1_000_000);
        if let Some(to) = self.active.poll(sim, now, due) {
            self.active = enter(to, sim, now);
            self.since = now;
        }
    }
}

impl Active {
    fn poll(
        &mut self,
        sim: &mut Simulation,
        now: Instant,
        due: impl Fn(u64) -> bool,
    ) -> Option<To> {
        match self {
            Active::SearchFirstWall { actor, touch, lane } => {
                if touched(touch, sim, now) {
                    stop::<templates::Forward, _>(actor, sim, now);
                    return Some(To::BackupCollision);
                }
                if due(20)
                    && Supervisor::<Lane, _>::poll(
                        lane,
                        check_driving_lane::Live { distance: WALLDIST },
                        sim,
                        now,
                    )
                    .unwrap()
                    .is_some()
                {
                    stop::<templates::Forward, _>(actor, sim, now);
                    return Some(To::FindWallAngle);
                }
                if !due(10) {
                    return None;
                }
                match Actor::<templates::Forward, _>::poll(actor, forward::Live {}, sim, now)
                    .unwrap()
                {
                    Poll::Pending => None,
                    Poll::Ready(forward::State::ForwardSuccessful { .. }) => {
                        Some(To::SearchFirstWall)
                    }
                }
            }
            _ if !due(10) && !matches!(self, Active::FollowWall { .. }) => None,
            Active::BackupCollision(actor) => {
                match Actor::<templates::Forward, _>::poll(actor, forward::Live {}, sim, now)
                    .unwrap()
                {
                    Poll::Pending => None,
                    Poll::Ready(forward::State::ForwardSuccessful { .. }) => {
                        Some(To::FindWallAngle)
                    }
                }
            }
            Active::FindWallAngle(actor) => {
                match Actor::<templates::SearchWall, _>::poll(actor, search_wall::Live {}, sim, now)
                    .unwrap()
                {
                    Poll::Pending => None,
                    Poll::Ready(search_wall::State::WallFound { angle }) => {
                        Some(To::ParallelToWall(angle))
                    }
                    Poll::Ready(search_wall::State::NoWallFound) => Some(To::TurnAfterWallLost),
                }
            }
            Active::ParallelToWall(actor) => {
                match Actor::<templates::Turn, _>::poll(actor, turn::Live {}, sim, now).unwrap() {
                    Poll::Pending => None,
                    Poll::Ready(turn::State::TurnSuccessful { .. }) => Some(To::FollowWall),
                }
            }
            Active::FollowWall { actor, touch, .. } => {
                if due(5) && touched(touch, sim, now) {
                    stop::<templates::WallForward, _>(actor, sim, now);
                    return Some(To::BackupCollision);
                }
                if !due(10) {
                    return None;
                }
                match Actor::<templates::WallForward, _>::poll(
                    actor,
                    wall_forward::Live {},
                    sim,
                    now,
                )
                .unwrap()
                {
                    Poll::Pending => None,
                    Poll::Ready(wall_forward::State::ForwardSuccessful) => Some(To::FollowWall),
                    Poll::Ready(wall_forward::State::LaneNotFree) => Some(To::FindWallAngle),
                    Poll::Ready(wall_forward::State::WallLost) => Some(To::TurnAfterWallLost),
                }
            }
            Active::TurnAfterWallLost(actor) => {
                match Actor::<templates::Turn, _>::poll(actor, turn::Live {}, sim, now).unwrap() {
                    Poll::Pending => None,
                    Poll::Ready(turn::State::TurnSuccessful { .. }) => Some(To::SearchFirstWall),
                }
            }
        }
    }
}

fn touched(touch: &mut CheckTouchSensor, sim: &mut Simulation, now: Instant) -> bool {
    Supervisor::<Touch, _>::poll(touch, check_touch_sensor::Live {}, sim, now).unwrap().is_some()
}

fn stop<T: afp_core::ActorTemplate, A: Actor<T, Simulation>>(
    actor: &mut A,
    sim: &mut Simulation,
    now: Instant,
) {
    actor.interrupt(sim, now).unwrap();
}

fn enter(to: To, sim: &mut Simulation, now: Instant) -> Active {
    let all = Events::from_bits(1);
    let forward = |distance| forward::Inputs { distance, speed: SPEED };
    let turn = |angle| turn::Inputs { angle, speed: AngularSpeed::from_si(45f64.to_radians()) };
    match to {
        To::SearchFirstWall => {
            let touch = Supervisor::<Touch, _>::start(check_touch_sensor::Inputs {}, all, sim, now)
                .unwrap();
            let inputs = check_driving_lane::Inputs {
                clearance: Length::from_si(0.10),
                margin: Length::from_si(0.10),
                halfwidth: Length::from_si(0.25),
            };
            let lane = Supervisor::<Lane, _>::start(inputs, all, sim, now).unwrap();
            let actor =
                Actor::<templates::Forward, _>::start(forward(Length::from_si(100.0)), sim, now)
                    .unwrap();
            Active::SearchFirstWall { actor, touch, lane }
        }
        To::BackupCollision => Active::BackupCollision(
            Actor::<templates::Forward, _>::start(forward(-WALLDIST), sim, now).unwrap(),
        ),
        To::FindWallAngle => {
            let inputs =
                search_wall::Inputs { sweep: Angle::from_deg(60.0), range: Length::from_si(1.5) };
            Active::FindWallAngle(
                Actor::<templates::SearchWall, _>::start(inputs, sim, now).unwrap(),
            )
        }
        To::ParallelToWall(angle) => Active::ParallelToWall(
            Actor::<templates::Turn, _>::start(turn(angle), sim, now).unwrap(),
        ),
        To::FollowWall => {
            let touch = Supervisor::<Touch, _>::start(check_touch_sensor::Inputs {}, all, sim, now)
                .unwrap();
            let inputs = wall_forward::Inputs {
                walldist: WALLDIST,
                lanedist: WALLDIST,
                gain: 1.0,
                tolerance: Length::from_si(0.20),
                step: Length::from_si(5.0),
                speed: SPEED,
            };
            let actor = Actor::<templates::WallForward, _>::start(inputs, sim, now).unwrap();
            Active::FollowWall { actor, touch, since: now }
        }
        To::TurnAfterWallLost => Active::TurnAfterWallLost(
            Actor::<templates::Turn, _>::start(turn(Angle::from_deg(-60.0)), sim, now).unwrap(),
        ),
    }
}
