//! Glances ahead while the sensor's main work is at the side.

/// Looks ahead at least once in so many metres.
const OFTEN: f64 = 0.25;
/// From this far before the lane's end the sensor keeps looking ahead, metres.
const STARE: f64 = 0.08;
/// A turn of the rotator there and back takes about this long, seconds.
const TURN: f64 = 0.5;
/// Glances go to either side of the heading in turn, radians.
const ASIDE: f64 = 10.0 / 180.0 * core::f64::consts::PI;
/// The rotator has arrived when it is nearer than this to where it should be, radians.
const ARRIVED: f64 = 4.0 / 180.0 * core::f64::consts::PI;
/// Nothing farther than this is remembered, metres; silence counts as this.
const FAR: f64 = 1.0;
/// So many pings in a row must find silence before it is believed: one may just be lost.
const SILENCES: u8 = 3;
/// Speed lost in a second while braking, and how long the brakes take to bite.
const BRAKING: f64 = 1.5;
const LAG: f64 = 0.08;

/// When to look ahead, and what is known of the lane there.
#[derive(Clone, Debug)]
pub(super) struct Glance {
    looking: bool,
    side: f64,
    /// Free space before the front at the last glance, and the way driven by then.
    seen: Option<(f64, f64)>,
    /// Pings of this glance that found silence.
    silences: u8,
}

impl Glance {
    /// Begins with a look.
    pub(super) fn new() -> Self {
        Glance { looking: true, side: ASIDE, seen: None, silences: 0 }
    }

    pub(super) fn looking(&self) -> bool {
        self.looking
    }

    /// Where to point for the glance that is under way.
    pub(super) fn bearing(&self) -> Option<f64> {
        self.looking.then_some(self.side)
    }

    /// Free space before the front at the last glance.
    pub(super) fn free(&self) -> Option<f64> {
        self.seen.map(|(free, _)| free)
    }

    /// Begins a glance if it is time; says whether it began now.
    pub(super) fn turns(&mut self, driven: f64, speed: f64, lanedist: f64) -> bool {
        let due = match self.seen {
            None => true,
            Some((free, at)) => {
                let since = driven - at;
                since > OFTEN || free - since < lanedist + STARE + speed * TURN
            }
        };
        let begins = due && !self.looking;
        self.looking |= due;
        begins
    }

    /// Takes an echo that came from `bearing`, `free` metres before the front; none is silence.
    pub(super) fn hear(&mut self, bearing: f64, free: Option<f64>, driven: f64) {
        if !self.looking || (bearing - self.side).abs() >= ARRIVED {
            return;
        }
        self.silences = if free.is_none() { self.silences + 1 } else { 0 };
        if free.is_none() && self.silences < SILENCES {
            return;
        }
        self.seen = Some((free.map_or(FAR, |free| free.min(FAR)), driven));
        self.silences = 0;
        self.looking = false;
        self.side = -self.side;
    }

    /// Whether braking must begin now to stand before `lanedist`.
    pub(super) fn blocked(&self, driven: f64, lanedist: f64, speed: f64) -> bool {
        let braking = speed * LAG + speed * speed / (2.0 * BRAKING);
        self.seen.is_some_and(|(free, at)| free - (driven - at) <= lanedist + braking)
    }
}
