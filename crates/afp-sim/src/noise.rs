//! The Carbot's noise streams.

pub(crate) use afp_platform::Noise;

/// The purpose of a stream. The number is part of every recorded run and never changes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source {
    /// The robot's calibration.
    Build = 1,
    /// The wheels' counters.
    Odometry = 2,
    /// Range and dropouts of the ultrasonic sensor.
    Ultrasonic = 3,
    /// The bumper's bouncing contact.
    Bumper = 4,
    /// Bearing and strength of infrared light.
    Infrared = 5,
    /// The colour sensor.
    Color = 6,
    /// Random rooms.
    Rooms = 8,
    /// The grain of pictures.
    Camera = 7,
    /// Random places.
    Places = 9,
}

impl Source {
    pub(crate) fn of(self, seed: u64) -> Noise {
        Noise::numbered(seed, self as u64)
    }
}
