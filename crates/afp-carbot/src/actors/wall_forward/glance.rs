//! Glances ahead while the sensor's main work is at the side.

/// Looks ahead at least once in so many metres.
const OFTEN: f64 = 0.25;
/// From this far before the lane's end the sensor keeps looking ahead, metres.
const STARE: f64 = 0.08;
/// A turn of the rotator there and back takes about this long, seconds.
const TURN: f64 = 0.5;
/// Glances go to either side of the heading in turn, so far that the beam reaches the corners of the body 20 cm before it; radians.
const ASIDE: f64 = 20.0 / 180.0 * core::f64::consts::PI;
/// The rotator has arrived when it is nearer than this to where it should be, radians.
const ARRIVED: f64 = 4.0 / 180.0 * core::f64::consts::PI;
/// Nothing farther than this is remembered, metres, if that is far enough for the lane to be free until the next look.
const FAR: f64 = 1.0;
/// So many pings in a row must find silence before it is believed: one may just be lost.
const SILENCES: u8 = 3;
/// Speed lost in a second while braking, and how long the brakes take to bite.
const BRAKING: f64 = 1.5;
const LAG: f64 = 0.08;

/// When to look ahead, and what is known of the lane there.
#[derive(Clone, Debug)]
pub(super) struct Glance {
    /// What must be free before the front, metres.
    lanedist: f64,
    /// Where less is free the sensor keeps looking ahead; what is free beyond `far` is not remembered, and silence counts
    /// as `far`; metres.
    near: f64,
    far: f64,
    looking: bool,
    /// What is known of the right and of the left half of the lane.
    halves: [Half; 2],
    /// Which of them is looked at, or was last.
    side: usize,
    /// Pings of this glance that found silence.
    silences: u8,
}

/// What is known of one half of the lane.
#[derive(Clone, Copy, Debug)]
struct Half {
    /// Where the sensor looks for it, against the heading.
    bearing: f64,
    /// Free space before the front when it was seen last, and the way driven by then.
    seen: Option<(f64, f64)>,
}

impl Half {
    /// Free space before the front after `driven`, if it has ever been seen.
    fn free(&self, driven: f64) -> Option<f64> {
        self.seen.map(|(free, at)| free - (driven - at))
    }

    /// The way driven without a look at it.
    fn unseen(&self, driven: f64) -> f64 {
        self.seen.map_or(f64::INFINITY, |(_, at)| driven - at)
    }
}

impl Glance {
    /// Begins with a look to the left, then one to the right. A robot of this speed needs `lanedist` free; its sensor
    /// hears no farther than `heard` before the front.
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

    /// Where to point for the glance that is under way.
    pub(super) fn bearing(&self) -> Option<f64> {
        self.halves.get(self.side).filter(|_| self.looking).map(|half| half.bearing)
    }

    /// Free space before the front, in the half that has less; none before both were seen.
    pub(super) fn free(&self, driven: f64) -> Option<f64> {
        let [right, left] = &self.halves;
        Some(right.free(driven)?.min(left.free(driven)?))
    }

    /// Begins a glance if it is time; says whether it began now.
    pub(super) fn turns(&mut self, driven: f64) -> bool {
        if self.looking {
            return false;
        }
        let due = |half: &Half| {
            half.unseen(driven) > OFTEN || half.free(driven).is_none_or(|free| free < self.near)
        };
        // The half that was looked at last has its turn after the other one.
        let next = 1 - self.side;
        let sides = [next, self.side];
        let side = sides.into_iter().find(|side| self.halves.get(*side).is_some_and(due));
        self.looking = side.is_some();
        self.side = side.unwrap_or(self.side);
        self.looking
    }

    /// Takes an echo that came from `bearing`, `free` metres before the front; none is silence.
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

    /// Whether braking must begin now for the lane's length to stay free.
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

    /// Looks to where it points and finds so much free.
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
    fn what_stands_on_one_side_is_not_forgotten_when_the_other_is_free() {
        let mut glance = Glance::new(0.3, 0.2, 3.9);
        look(&mut glance, 1.0, 0.0);
        assert!(glance.turns(0.0));
        look(&mut glance, 0.7, 0.0);
        // The left half is looked at again, and is free; the right one is as near as it was.
        assert!(glance.turns(0.26));
        assert_eq!(glance.bearing(), Some(ASIDE));
        look(&mut glance, 1.0, 0.26);
        assert!((glance.free(0.26).expect("both were seen") - 0.44).abs() < 1e-9);
        assert!(glance.blocked(0.38, 0.2));
    }
}
