//! The range sensor HC-SR04: a pulse on its trigger sends a ping, and the length of the pulse on
//! its echo line is the time of flight.

use afp_types::{Duration, Instant};

/// The time between two pings, so that the echoes of one have died away at the next.
const PERIOD: Duration = Duration::from_millis(60);
/// The speed of sound in metres per nanosecond, there and back.
const HALF_SOUND: f64 = 343.0e-9 / 2.0;
/// A longer pulse means no echo: without an obstacle, the sensor holds the line for 38 ms.
const FAR: f64 = 4.0;

/// A range sensor.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ranger {
    sent: Option<Instant>,
    /// The time of the echo line's rise in nanoseconds, by the clock of its edges.
    rose: Option<u64>,
}

impl Ranger {
    /// Whether a ping is due. The caller then sends it.
    pub fn is_due(&mut self, now: Instant) -> bool {
        let due = self.sent.is_none_or(|sent| now.since(sent) >= PERIOD);
        if due {
            (self.sent, self.rose) = (Some(now), None);
        }
        due
    }

    /// Takes an edge of the echo line and its time in nanoseconds. Returns the distance of a
    /// completed ping in metres, or its lack. A sensor whose line never rises completes no ping.
    pub fn edge(&mut self, rises: bool, at: u64) -> Option<Option<f32>> {
        if rises {
            self.rose = Some(at);
            return None;
        }
        let flight = at.checked_sub(self.rose.take()?)?;
        let distance = flight as f64 * HALF_SOUND;
        Some((distance <= FAR).then_some(distance as f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_of_the_pulse_is_the_distance() {
        let mut ranger = Ranger::default();
        let at = |ms| Instant::ZERO + Duration::from_millis(ms);
        assert!(ranger.is_due(at(0)) && !ranger.is_due(at(59)));
        assert_eq!(ranger.edge(true, 1_000_000), None);
        let one = ranger.edge(false, 1_000_000 + 5_830_904).unwrap().unwrap();
        assert!((one - 1.0).abs() < 1e-4, "{one}");
        assert!(ranger.is_due(at(60)));
        // Nothing in front of it.
        assert_eq!(ranger.edge(true, 70_000_000), None);
        assert_eq!(ranger.edge(false, 108_000_000), Some(None));
        // Neither a fall without a rise nor a clock that goes backwards is a ping.
        assert_eq!(ranger.edge(false, 109_000_000), None);
        assert_eq!(ranger.edge(true, 200_000_000), None);
        assert_eq!(ranger.edge(false, 199_000_000), None);
    }
}
