//! The same work as a behaviour tree of bonsai-bt: four conditions and an action, one tick.

use std::hint::black_box;

use bonsai_bt::{
    Action, ActionArgs, BT, Behavior, Event, Failure, Float, RUNNING, Status, Success, UpdateArgs,
    WhenAll,
};

use crate::board::{Board, speed};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Node {
    NoButton,
    NoTouch,
    WayFree,
    BatteryGood,
    Drive { goal: f64, gain: f64 },
}

struct Blackboard {
    board: Board,
    walldist: f64,
    low: f64,
}

const NODES: [Node; 5] = [
    Node::NoButton,
    Node::NoTouch,
    Node::WayFree,
    Node::BatteryGood,
    Node::Drive { goal: 100.0, gain: 0.5 },
];

/// Conditions and action in a sequence that starts again at every tick, the common idiom.
pub fn sequence() -> impl FnMut(u64) {
    let nodes = NODES.map(Action).to_vec();
    ticks(Behavior::Sequence(nodes).memory(false), (Success, 0.01))
}

/// All five in parallel, with a condition running while it holds, the library's fastest form.
pub fn when_all() -> impl FnMut(u64) {
    ticks(WhenAll(NODES.map(Action).to_vec()), RUNNING)
}

fn ticks(behavior: Behavior<Node>, holds: (Status, Float)) -> impl FnMut(u64) {
    let blackboard = Blackboard { board: Board::quiet(), walldist: 0.3, low: 10.0 };
    let mut tree = BT::new(behavior, blackboard);
    let event: Event = UpdateArgs { dt: 0.01 }.into();
    move |count| {
        for _ in 0..count {
            let tree = black_box(&mut tree);
            let mut act =
                |args: ActionArgs<Event, Node>, bb: &mut Blackboard| act(*args.action, bb, holds);
            black_box(tree.tick(black_box(&event), &mut act));
        }
    }
}

#[inline]
fn act(node: Node, bb: &mut Blackboard, holds: (Status, Float)) -> (Status, Float) {
    let fine = match node {
        Node::NoButton => bb.board.buttons & 1 == 0,
        Node::NoTouch => !bb.board.touched,
        Node::WayFree => bb.board.range >= bb.walldist,
        Node::BatteryGood => bb.board.battery >= bb.low,
        Node::Drive { goal, gain } => {
            let left = goal - bb.board.odometer;
            if left <= 0.0 {
                return (Success, 0.0);
            }
            bb.board.command = speed(left, gain);
            return RUNNING;
        }
    };
    if fine { holds } else { (Failure, 0.0) }
}
