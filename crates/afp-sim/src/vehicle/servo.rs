//! A servo that moves towards its target at a limited rate.

#[derive(Clone, Debug)]
pub(crate) struct Servo {
    position: f64,
    target: f64,
    reach: f64,
    rate: f64,
}

impl Servo {
    /// A servo at zero, with `reach` to either side and `rate` a second.
    pub(crate) fn new(reach: f64, rate: f64) -> Self {
        Servo { position: 0.0, target: 0.0, reach, rate }
    }

    /// Sets the target, limited to the reach; ignores a target that is not finite.
    pub(crate) fn aim(&mut self, target: f64) {
        if target.is_finite() {
            self.target = target.clamp(-self.reach, self.reach);
        }
    }

    pub(crate) fn hold(&mut self) {
        self.target = self.position;
    }

    /// Moves for `dt` seconds; returns whether it moved.
    pub(crate) fn step(&mut self, dt: f64) -> bool {
        let error = self.target - self.position;
        self.position += error.clamp(-self.rate * dt, self.rate * dt);
        error != 0.0
    }

    pub(crate) fn position(&self) -> f64 {
        self.position
    }
}
