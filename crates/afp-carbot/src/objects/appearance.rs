//! Appearance of an object: the colours that distinguish it.
//!
//! A colour is reduced to its shares of red and green, which hardly depend on light and shade.
//! Objects are found by these colours, as in Swain and Ballard's "Color indexing" (1991), with a
//! yes or no instead of a likelihood.

use crate::devices::Frame;
use core::array;

/// Number of steps of a share.
const STEPS: usize = 32;
/// A darker pixel, by the sum of its three parts, has no reliable colour.
const DARKEST: u32 = 48;
/// A colour belongs to an object if it is this many times as frequent in it as around it.
const OWN: u32 = 3;
/// And if at least one of this many pixels has it.
const RARE: u32 = 64;

/// The colours of an object.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Appearance {
    /// A row for each share of red, a bit for each share of green.
    own: [u32; STEPS],
}

/// Shares of red and green, in steps.
type Chroma = (usize, usize);

impl Appearance {
    /// An object of one colour, with a tolerance for its shares of red and green.
    pub fn of_color([red, green, blue]: [f64; 3], tolerance: f64) -> Self {
        let sum = (red + green + blue).max(f64::MIN_POSITIVE);
        let near = |step: usize, part: f64| {
            let share = (step as f64 + 0.5) / STEPS as f64;
            (share - part / sum).abs() <= tolerance
        };
        let row = |r: usize| {
            (0..STEPS).filter(|g| near(*g, green)).fold(0, |row, g| row | 1 << g)
                * u32::from(near(r, red))
        };
        Appearance { own: array::from_fn(row) }
    }

    /// The object in the picture's middle, over a `share` of its width and height; `None` if its
    /// colours also occur around it.
    pub fn learnt(frame: &Frame<'_>, share: f64) -> Option<Self> {
        let (mut inside, mut around) = ([[0_u32; STEPS]; STEPS], [[0_u32; STEPS]; STEPS]);
        let (mut ins, mut outs) = (0_u32, 0_u32);
        for y in 0..frame.height {
            for x in 0..frame.width {
                let Some((r, g)) = frame.pixel(x, y).and_then(chroma) else { continue };
                let is_in = middle(x, frame.width, share) && middle(y, frame.height, share);
                let (counts, sum) =
                    if is_in { (&mut inside, &mut ins) } else { (&mut around, &mut outs) };
                counts[r][g] += 1;
                *sum += 1;
            }
        }
        let is_own = |r: usize, g: usize| {
            let (seen, beside) = (u64::from(inside[r][g]), u64::from(around[r][g]));
            let often = seen * u64::from(RARE) >= u64::from(ins).max(1);
            // Compares frequencies without a division.
            often && seen * u64::from(outs) >= u64::from(OWN) * beside * u64::from(ins)
        };
        let row =
            |r: usize| (0..STEPS).filter(|g| is_own(r, *g)).fold(0_u32, |row, g| row | 1 << g);
        let own = array::from_fn(row);
        own.iter().any(|row| *row != 0).then_some(Appearance { own })
    }

    /// Whether a pixel has a colour of the object.
    pub fn has(&self, pixel: [u8; 3]) -> bool {
        chroma(pixel).is_some_and(|(r, g)| self.own[r] >> g & 1 == 1)
    }
}

/// Whether a column or row is in the middle share.
fn middle(at: usize, of: usize, share: f64) -> bool {
    let (at, half) = (at as f64 + 0.5, of as f64 / 2.0);
    (at - half).abs() <= share * half
}

/// The shares of a pixel's colour; `None` if it is too dark.
fn chroma(pixel: [u8; 3]) -> Option<Chroma> {
    let [red, green, blue] = pixel.map(u32::from);
    let sum = red + green + blue;
    // A pure colour, the largest share, belongs to the last step.
    let step = |part: u32| (part as usize * STEPS / sum as usize).min(STEPS - 1);
    (sum >= DARKEST).then(|| (step(red), step(green)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn light_and_shade_do_not_change_a_colour() {
        let red = Appearance::of_color([0.69, 0.19, 0.19], 0.08);
        assert!(red.has([176, 48, 48]) && red.has([88, 24, 24]) && red.has([255, 70, 70]));
        assert!(!red.has([176, 120, 48]) && !red.has([128, 128, 128]) && !red.has([8, 2, 2]));
    }

    #[test]
    fn only_the_middle_of_the_picture_is_learnt() {
        for (width, height, share) in [(16, 16, 0.5), (640, 480, 0.2)] {
            let picture = |inside: [u8; 3], around: [u8; 3]| -> Vec<u8> {
                let is_in =
                    |n: usize| middle(n % width, width, share) && middle(n / width, height, share);
                (0..width * height).flat_map(|n| if is_in(n) { inside } else { around }).collect()
            };
            let learn = |inside, around| {
                let rgb = &picture(inside, around);
                Appearance::learnt(&Frame { width, height, rgb, number: 1 }, share)
            };
            let look = learn([20, 160, 40], [120, 110, 100]).unwrap();
            assert!(look.has([20, 160, 40]) && look.has([30, 240, 60]));
            assert!(!look.has([120, 110, 100]));
            assert_eq!(learn([120, 110, 100], [120, 110, 100]), None);
            assert_eq!(learn([0, 0, 0], [120, 110, 100]), None);
        }
    }
}
