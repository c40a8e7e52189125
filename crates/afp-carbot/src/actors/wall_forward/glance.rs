//! Glances ahead while the sensor mainly points to the side.

/// Longest distance between two glances, metres.
const OFTEN: f64 = 0.25;
/// The sensor keeps looking ahead within this distance of the lane's end, metres.
const STARE: f64 = 0.08;
/// Time for the rotator to turn there and back, seconds.
const TURN: f64 = 0.5;
/// Glances alternate between the sides at this bearing, radians. The beam then covers the body's
/// corners 20 cm ahead.
const ASIDE: f64 = 20.0 / 180.0 * core::f64::consts::PI;
/// The rotator has arrived within this distance of its target, radians.
const ARRIVED: f64 = 4.0 / 180.0 * core::f64::consts::PI;
/// Free space beyond this is not remembered, metres, unless the lane needs more until the next
/// look.
const FAR: f64 = 1.0;
/// This many silent pings in a row are believed: one may be lost.
const SILENCES: u8 = 3;
/// Deceleration, metres a second squared, and delay of the brakes, seconds.
const BRAKING: f64 = 1.5;
const LAG: f64 = 0.08;

/// Schedules glances and remembers the free space in the lane.
#[derive(Clone, Debug)]
pub(super) struct Glance {
    /// Free space needed before the front, metres.
    lanedist: f64,
    /// The sensor keeps looking ahead if less than `near` is free. Space beyond `far` is not
    /// remembered, and silence counts as `far`. Metres.
    near: f64,
    far: f64,
    looking: bool,
    /// The right and the left half of the lane.
    halves: [Half; 2],
    /// Index of the half of the current or the last glance.
    side: usize,
    /// Silent pings of this glance.
    silences: u8,
}

/// One half of the lane.
#[derive(Clone, Copy, Debug)]
struct Half {
    /// The sensor's bearing for this half.
    bearing: f64,
    /// Free space before the front when last seen, and the distance driven by then.
    seen: Option<(f64, f64)>,
}

impl Half {
    /// Free space before the front after `driven`; `None` if never seen.
    fn free(&self, driven: f64) -> Option<f64> {
        self.seen.map(|(free, at)| free - (driven - at))
    }

    /// Distance driven since the last glance at it.
    fn unseen(&self, driven: f64) -> f64 {
        self.seen.map_or(f64::INFINITY, |(_, at)| driven - at)
    }
}

impl Glance {
    /// Begins with a glance to the left, then to the right. `lanedist` must be free at this speed;
    /// the sensor's range beyond the front is `heard`.
    pub(super) fn new(lanedist: f64, speed: f64, heard: f64) -> Self {
        let near = lanedist + STARE + speed * TURN;
        Glance {
            lanedist,
            near,
            far: FAR.max(near + OFTEN + speed * TURN).min(heard),
            looking: true,
            halves: [-ASIDE, ASIDE].map(|bearing| Half { bearing, seen: None }),
            side: 1,
            silences: 0,
        }
    }

    pub(super) fn looking(&self) -> bool {
        self.looking
    }

    /// Bearing of the current glance.
    pub(super) fn bearing(&self) -> Option<f64> {
        self.halves.get(self.side).filter(|_| self.looking).map(|half| half.bearing)
    }

    /// Free space before the front in the half with less; `None` before both were seen.
    pub(super) fn free(&self, driven: f64) -> Option<f64> {
        let [right, left] = &self.halves;
        Some(right.free(driven)?.min(left.free(driven)?))
    }

    /// Begins a glance if due; returns whether it began.
    pub(super) fn turns(&mut self, driven: f64) -> bool {
        if self.looking {
            return false;
        }
        let due = |half: &Half| {
            half.unseen(driven) > OFTEN || half.free(driven).is_none_or(|free| free < self.near)
        };
        // The other half has priority.
        let next = 1 - self.side;
        let sides = [next, self.side];
        let side = sides.into_iter().find(|side| self.halves.get(*side).is_some_and(due));
        self.looking = side.is_some();
        self.side = side.unwrap_or(self.side);
        self.looking
    }

    /// Takes an echo from `bearing`, `free` metres before the front; `None` is silence.
    pub(super) fn on_echo(&mut self, bearing: f64, free: Option<f64>, driven: f64) {
        let Some(half) = self.halves.get_mut(self.side).filter(|_| self.looking) else { return };
        if (bearing - half.bearing).abs() >= ARRIVED {
            return;
        }
        self.silences = if free.is_none() { self.silences + 1 } else { 0 };
        if free.is_none() && self.silences < SILENCES {
            return;
        }
        half.seen = Some((free.map_or(self.far, |free| free.min(self.far)), driven));
        self.silences = 0;
        self.looking = false;
    }

    /// Whether braking must begin now to keep the lane free.
    pub(super) fn blocked(&self, driven: f64, speed: f64) -> bool {
        let braking = speed * LAG + speed * speed / (2.0 * BRAKING);
        let near =
            |half: &Half| half.free(driven).is_some_and(|free| free <= self.lanedist + braking);
        self.halves.iter().any(near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks at the target bearing and finds `free`.
    fn look(glance: &mut Glance, free: f64, driven: f64) {
        let bearing = glance.bearing().expect("it looks");
        glance.on_echo(bearing, Some(free), driven);
    }

    #[test]
    fn nothing_is_free_before_both_halves_were_seen() {
        let mut glance = Glance::new(0.3, 0.2, 3.9);
        look(&mut glance, 1.0, 0.0);
        assert_eq!(glance.free(0.0), None);
        assert!(glance.turns(0.0));
        look(&mut glance, 1.0, 0.0);
        assert_eq!(glance.free(0.1), Some(0.9));
    }

    #[test]
    fn an_obstacle_on_one_side_is_kept_when_the_other_side_is_free() {
        let mut glance = Glance::new(0.3, 0.2, 3.9);
        look(&mut glance, 1.0, 0.0);
        assert!(glance.turns(0.0));
        look(&mut glance, 0.7, 0.0);
        // The left half is free again; the right half is as near as before.
        assert!(glance.turns(0.26));
        assert_eq!(glance.bearing(), Some(ASIDE));
        look(&mut glance, 1.0, 0.26);
        assert!((glance.free(0.26).expect("both were seen") - 0.44).abs() < 1e-9);
        assert!(glance.blocked(0.38, 0.2));
    }
}
