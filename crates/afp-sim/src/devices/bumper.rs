//! The bumper's switch, with a bouncing contact.

use crate::noise::Noise;

/// The number of steps in which the contact bounces after a change.
const BOUNCING: u32 = 2;
/// The probability of a wrong reading while the contact bounces.
const WRONG: f64 = 0.3;

/// The switch behind the bumper.
#[derive(Clone, Debug)]
pub struct Switch {
    noise: Noise,
    pressed: bool,
    bouncing: u32,
    says: bool,
}

impl Switch {
    /// A switch that is not pressed, with a noise stream.
    pub fn new(noise: Noise) -> Self {
        Switch { noise, pressed: false, bouncing: 0, says: false }
    }

    /// Makes a step with the bumper pressed or not. A change has an immediate effect; then the
    /// contact bounces for 10 ms.
    pub fn step(&mut self, pressed: bool) {
        self.says = pressed;
        if pressed != self.pressed {
            self.pressed = pressed;
            self.bouncing = BOUNCING;
        } else if self.bouncing > 0 {
            self.bouncing -= 1;
            self.says ^= self.noise.uniform() < WRONG;
        }
    }

    /// The current reading.
    pub fn says(&self) -> bool {
        self.says
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Source;

    #[test]
    fn a_press_is_felt_immediately_bounces_and_settles() {
        let mut bounced = 0;
        for seed in 0..50 {
            let mut switch = Switch::new(Source::Bumper.of(seed));
            switch.step(false);
            assert!(!switch.says());
            switch.step(true);
            assert!(switch.says());
            for _ in 0..BOUNCING {
                switch.step(true);
                bounced += u32::from(!switch.says());
            }
            for _ in 0..100 {
                switch.step(true);
                assert!(switch.says(), "seed {seed}");
            }
        }
        assert!((15..50).contains(&bounced), "{bounced} of 100");
    }
}
