//! The bumper's switch: it bounces, as contacts do.

use crate::noise::Noise;

/// After a change the contact is uncertain for so many steps.
const BOUNCING: u32 = 2;
/// And says the wrong thing with this probability.
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
    /// One that is not pressed, with a stream of noise.
    pub fn new(noise: Noise) -> Self {
        Switch { noise, pressed: false, bouncing: 0, says: false }
    }

    /// One step in which the bumper is pressed or not. A change is felt at once; then the contact
    /// bounces for 10 ms.
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

    /// What the switch says.
    pub fn says(&self) -> bool {
        self.says
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Source;

    #[test]
    fn a_press_is_felt_at_once_bounces_and_settles() {
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
