//! Names of sensor readings in conditions, and the supervisor that watches each.

/// A supervisor for names that contain one of some words.
pub(crate) struct Sensor {
    words: &'static [&'static str],
    /// The supervisor; `{limit}` is the value in the condition, `{then}` the target.
    pub supervisor: &'static str,
    /// The supervisor for a reading above the limit, if it is another one.
    pub above: &'static str,
    /// The type of the limit, the unit of a bare number, and the limit of a condition without one.
    pub limit: (&'static str, &'static str, &'static str),
}

const NO_LIMIT: (&str, &str, &str) = ("", "", "");

/// Every sensor; the first of those that fit counts.
const SENSORS: &[Sensor] = &[
    Sensor {
        words: &[
            "touch",
            "touched",
            "touching",
            "bump",
            "bumped",
            "bumper",
            "collision",
            "collided",
            "contact",
            "hit",
            "crash",
            "crashed",
            "pressed",
            "edge",
        ],
        supervisor: "supervise touch: CheckTouchSensor { TouchSensorPressed -> {then} }",
        above: "",
        limit: NO_LIMIT,
    },
    Sensor {
        words: &["button", "key", "escape", "esc", "click", "clicked"],
        supervisor: "supervise button: CheckEscapeButton { EscapeButtonPressed -> {then} }",
        above: "",
        limit: NO_LIMIT,
    },
    Sensor {
        words: &[
            "distance",
            "dist",
            "range",
            "ultrasonic",
            "sonar",
            "lidar",
            "obstacle",
            "wall",
            "near",
            "blocked",
            "proximity",
        ],
        supervisor: "supervise near: CheckDistance(distance = {limit}) { Nearer -> {then}, Farther -> ignore }",
        above: "supervise far: CheckDistance(distance = {limit}) { Farther -> {then}, Nearer -> ignore }",
        limit: ("length", "cm", "30 cm"),
    },
    Sensor {
        words: &["battery", "voltage", "charge"],
        supervisor: "supervise battery: CheckBattery { BatteryLow -> {then} }",
        above: "",
        limit: NO_LIMIT,
    },
    Sensor {
        words: &[
            "time", "timer", "timeout", "elapsed", "clock", "seconds", "millis", "t", "duration",
        ],
        supervisor: "supervise late: CheckTimeout(duration = {limit}) { TimedOut -> {then} }",
        above: "",
        limit: ("duration", "s", "3 s"),
    },
    Sensor {
        words: &["color", "colour", "line", "black", "white"],
        supervisor: "supervise color: CheckColor(red = 0, green = 0, blue = 0) { ColorSeen -> {then} }",
        above: "",
        limit: NO_LIMIT,
    },
    Sensor {
        words: &["light", "infrared", "ir", "beacon", "brightness"],
        supervisor: "supervise light: CheckInfrared { InfraredSeen -> {then}, InfraredLost -> ignore }",
        above: "",
        limit: NO_LIMIT,
    },
    Sensor {
        words: &["motion", "moving", "movement"],
        supervisor: "supervise motion: CheckMotion { MotionSeen -> {then} }",
        above: "",
        limit: NO_LIMIT,
    },
];

impl Sensor {
    /// The sensor for a reading with an unknown name.
    pub fn touch() -> &'static Sensor {
        &SENSORS[0]
    }

    /// The sensor that a name or a text mentions, as in `bumperPressed` or `front_distance`.
    pub fn named(name: &str) -> Option<&'static Sensor> {
        let words = words(name);
        SENSORS.iter().find(|sensor| words.iter().any(|word| sensor.words.contains(&&**word)))
    }
}

/// The words of a name, in small letters.
pub(super) fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut was_small = false;
    for each in name.chars() {
        let begins = !each.is_ascii_alphabetic() || was_small && each.is_ascii_uppercase();
        if begins {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut().filter(|_| each.is_ascii_alphabetic()) {
            word.push(each.to_ascii_lowercase());
        }
        was_small = each.is_ascii_lowercase();
    }
    words
}
