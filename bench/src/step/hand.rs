//! The same work, written by hand for this plan.

use std::hint::black_box;

use crate::board::{Board, speed};
use crate::steps::PERIOD;

struct Robot {
    activity: Activity,
    walldist: f64,
}

#[derive(Clone, Copy)]
enum Activity {
    Driving { goal: f64, gain: f64, low: f64 },
    Backing { goal: f64 },
    Stopped,
}

/// Repeats one pass of the loop.
pub fn case() -> impl FnMut(u64) {
    let mut board = Board::quiet();
    let mut robot =
        Robot { activity: Activity::Driving { goal: 100.0, gain: 0.5, low: 10.0 }, walldist: 0.3 };
    let mut last = 0;
    move |count| {
        let mut now = last;
        for _ in 0..count {
            now += PERIOD;
            black_box(black_box(&mut robot).pass(black_box(&mut board), black_box(now)));
        }
        last = now;
    }
}

impl Robot {
    /// One pass; returns the time of the next one.
    #[inline]
    fn pass(&mut self, board: &mut Board, now: u64) -> u64 {
        match self.activity {
            Activity::Driving { goal, gain, low } => {
                if board.buttons & 1 != 0 || board.battery < low {
                    return self.stop(board);
                }
                if board.touched || board.range < self.walldist {
                    return self.back(board);
                }
                let left = goal - board.odometer;
                if left <= 0.0 {
                    return self.stop(board);
                }
                board.command = speed(left, gain);
                now + PERIOD
            }
            Activity::Backing { goal } => {
                if board.odometer <= goal {
                    return self.stop(board);
                }
                board.command = -0.1;
                now + PERIOD
            }
            Activity::Stopped => u64::MAX,
        }
    }

    #[cold]
    fn back(&mut self, board: &mut Board) -> u64 {
        board.command = 0.0;
        self.activity = Activity::Backing { goal: board.odometer - self.walldist };
        0
    }

    #[cold]
    fn stop(&mut self, board: &mut Board) -> u64 {
        board.command = 0.0;
        self.activity = Activity::Stopped;
        u64::MAX
    }
}
