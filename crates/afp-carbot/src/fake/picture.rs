//! The test robot's camera: a grey picture with a red post.

use crate::devices::{Frame, Lens, Motion};
use afp_core::quantity::{Angle, Length};
use std::vec::Vec;

const COLUMNS: usize = 80;
const ROWS: usize = 60;
const GREY: [u8; 3] = [120, 120, 120];
const RED: [u8; 3] = [180, 40, 40];
/// Half the width and the height of the post, metres.
const POST: (f64, f64) = (0.15, 0.3);

/// At the turning centre, 20 cm above the floor.
pub(super) fn lens() -> Lens {
    Lens {
        forward: Length::from_si(0.0),
        height: Length::from_si(0.2),
        opening: Angle::from_deg(70.0),
        columns: COLUMNS,
        rows: ROWS,
    }
}

/// The latest picture.
#[derive(Default)]
pub(super) struct Picture {
    rgb: Vec<u8>,
    number: u64,
}

impl Picture {
    pub(super) fn frame(&self) -> Frame<'_> {
        Frame { width: COLUMNS, height: ROWS, rgb: &self.rgb, number: self.number }
    }

    /// Takes a picture of the post from the robot's position.
    pub(super) fn take(&mut self, post: Option<(f64, f64)>, motion: &Motion) {
        self.number += 1;
        if post.is_none() {
            self.rgb.resize(3 * COLUMNS * ROWS, GREY[0]);
            self.rgb.fill(GREY[0]);
            return;
        }
        let (sin, cos) = motion.heading.si().sin_cos();
        let seen = post.map(|(x, y)| {
            let (x, y) = (x - motion.x.si(), y - motion.y.si());
            (x * cos + y * sin, y * cos - x * sin)
        });
        let (lens, (half, top)) = (lens(), POST);
        let (focus, height) = (lens.focus(), lens.height.si());
        let is_post = |x: usize, y: usize| {
            seen.filter(|(ahead, _)| *ahead > 0.1).is_some_and(|(ahead, left)| {
                let right = (x as f64 + 0.5 - COLUMNS as f64 / 2.0) / focus * ahead;
                let up = height - (y as f64 + 0.5 - ROWS as f64 / 2.0) / focus * ahead;
                (right + left).abs() < half && (0.0..top).contains(&up)
            })
        };
        let pixel = |n: usize| if is_post(n % COLUMNS, n / COLUMNS) { RED } else { GREY };
        self.rgb = (0..COLUMNS * ROWS).flat_map(pixel).collect();
    }
}
