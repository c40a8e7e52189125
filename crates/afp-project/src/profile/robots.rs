//! The tables of all profiles.

use afp_core::Duration;

use super::{Of, Profile, Section, Setting};
use crate::key::{Key, key};

const fn section(
    key: Key,
    needed: bool,
    devices: &'static [&'static str],
    settings: &'static [Setting],
) -> Section {
    Section { key, needed, devices, settings }
}

const fn needed(key: Key, of: Of) -> Setting {
    Setting { key, of, usual: None, in_world: None }
}

const fn usual(key: Key, of: Of, usual: &'static str) -> Setting {
    Setting { key, of, usual: Some(usual), in_world: None }
}

const fn simulated(setting: Setting, in_world: &'static str) -> Setting {
    Setting { in_world: Some(in_world), ..setting }
}

const OUTLINE: Section =
    section(key("body", "The outline from above.", "[robot.body]"), true, &[], BODY);

const fn drive(settings: &'static [Setting]) -> Section {
    section(key("drive", "The wheels and their motors.", "[robot.drive]"), true, &[], settings)
}

const fn bumper(settings: &'static [Setting]) -> Section {
    let key = key("bumper", "The switch of the bumper.", "[robot.bumper]");
    section(key, false, &["touch"], settings)
}

const fn button(settings: &'static [Setting]) -> Section {
    section(key("button", "The escape button.", "[robot.button]"), false, &["buttons"], settings)
}

/// The devices of the Carbot that a robot on wheels with a range sensor lacks.
const WITHOUT: &[&str] = &["infrared", "color", "camera", "battery", "localisation", "signals"];

/// All profiles.
pub const PROFILES: &[Profile] = &[CARBOT, PI, UGV, PICARX];

const CARBOT: Profile = Profile {
    name: "carbot",
    help: "A second controller on a serial port drives two motors with encoders.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[usual(
                key("port", "The serial port of the controller.", "port = \"/dev/ttyACM0\""),
                Of::Text,
                "/dev/ttyACM0",
            )],
        ),
        OUTLINE,
        drive(DRIVE),
        section(
            key("ultrasonic", "The range sensor on its servo.", "[robot.ultrasonic]"),
            false,
            &["ultrasonic", "rotator", "sweeping"],
            &[FORWARD, OFFSET],
        ),
        bumper(SWITCH),
        button(SWITCH),
    ],
    lacks: WITHOUT,
    estimates: &[],
};

const PI: Profile = Profile {
    name: "pi",
    help: "The Raspberry Pi's own pins drive two motors with encoders.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[
                CHIP,
                usual(
                    key("pwm", "The folder of the kernel's PWM chips.", "pwm = \"/sys/class/pwm\""),
                    Of::Text,
                    "/sys/class/pwm",
                ),
            ],
        ),
        OUTLINE,
        drive(PI_DRIVE),
        section(key("left", "The pins of the left wheel.", "[robot.left]"), true, &[], WHEEL),
        section(key("right", "The pins of the right wheel.", "[robot.right]"), true, &[], WHEEL),
        section(key("guard", "The enable line of the motors.", "[robot.guard]"), true, &[], GUARD),
        section(
            key("ultrasonic", "The range sensor HC-SR04.", "[robot.ultrasonic]"),
            false,
            &["ultrasonic", "rotator"],
            &[
                FORWARD,
                OFFSET,
                needed(key("trigger", "The line of the trigger.", "trigger = 23"), Of::Line),
                needed(key("echo", "The line of the echo, at 3.3 V.", "echo = 24"), Of::Line),
            ],
        ),
        section(
            key("servo", "The servo of the range sensor.", "[robot.servo]"),
            false,
            &["sweeping"],
            &[needed(key("pwm", "The PWM channel.", "pwm = \"pwmchip0/2\""), Of::Pwm)],
        ),
        bumper(PINNED),
        button(PINNED),
    ],
    lacks: WITHOUT,
    estimates: &[],
};

const PICARX: Profile = Profile {
    name: "picarx",
    help: "A SunFounder PiCar-X, which steers like a car.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[
                CHIP,
                usual(
                    key("bus", "The I2C bus of the Robot HAT.", "bus = \"/dev/i2c-1\""),
                    Of::Text,
                    "/dev/i2c-1",
                ),
            ],
        ),
        OUTLINE,
        drive(&[
            TRACK,
            simulated(
                needed(
                    key(
                        "wheelbase",
                        "From the rear axis ahead to the front axis.",
                        "wheelbase = \"8.72 cm\"",
                    ),
                    Of::Length([0.02, 1.0]),
                ),
                "robot.wheelbase_m",
            ),
            simulated(
                needed(
                    key(
                        "steering",
                        "The largest angle of the front wheels.",
                        "steering = \"30 deg\"",
                    ),
                    Of::Angle([0.17, 1.05]),
                ),
                "robot.steering_deg",
            ),
            usual(
                key(
                    "straight",
                    "The angle of the front wheels at which the robot drives straight ahead.",
                    "straight = \"1.5 deg\"",
                ),
                Of::Angle([-0.35, 0.35]),
                "0 deg",
            ),
            FASTEST,
        ]),
        section(
            key("guard", "The enable line of the motors.", "[robot.guard]"),
            true,
            &[],
            &[usual(
                key("line", "The line that resets the Robot HAT's controller.", "line = 5"),
                Of::Line,
                "5",
            )],
        ),
        section(
            key("ultrasonic", "The range sensor in front.", "[robot.ultrasonic]"),
            false,
            &["ultrasonic", "rotator"],
            &[FORWARD, OFFSET],
        ),
    ],
    lacks: &[
        "turning_in_place",
        "encoders",
        "sweeping",
        "touch",
        "buttons",
        "infrared",
        "color",
        "camera",
        "battery",
        "localisation",
        "signals",
    ],
    estimates: &["odometry"],
};

const UGV: Profile = Profile {
    name: "ugv",
    help: "A Waveshare UGV, whose controller speaks JSON on a serial port.",
    sections: &[
        section(
            key("", "", ""),
            true,
            &[],
            &[usual(
                key("port", "The serial port of the controller.", "port = \"/dev/serial0\""),
                Of::Text,
                "/dev/serial0",
            )],
        ),
        OUTLINE,
        drive(&[TRACK, FASTEST, SCALE, TRIM]),
    ],
    lacks: &[
        "ultrasonic",
        "rotator",
        "sweeping",
        "touch",
        "buttons",
        "infrared",
        "color",
        "camera",
        "battery",
        "localisation",
        "signals",
    ],
    estimates: &[],
};

const BODY: &[Setting] = &[
    simulated(
        needed(
            key(
                "length",
                "Twice the distance from the wheels' axis to the farther end.",
                "length = \"24 cm\"",
            ),
            Of::Length([0.05, 1.0]),
        ),
        "robot.length_m",
    ),
    simulated(
        needed(key("width", "The whole width.", "width = \"18 cm\""), Of::Length([0.05, 1.0])),
        "robot.width_m",
    ),
];

const TRACK: Setting = simulated(
    needed(
        key("track", "Between the middles of the two tyres.", "track = \"14 cm\""),
        Of::Length([0.03, 1.0]),
    ),
    "robot.track_m",
);

const FASTEST: Setting = simulated(
    needed(
        key(
            "fastest",
            "The top speed of a wheel: nine tenths of its speed at full power.",
            "fastest = \"50 cm/s\"",
        ),
        Of::Speed([0.02, 2.0]),
    ),
    "robot.fastest_m_s",
);

// Errors of a robot that `afpc calibrate` measures.
const SCALE: Setting = usual(
    key("scale", "The driven distance over the counted distance.", "scale = 1.02"),
    Of::Number([0.5, 2.0]),
    "1",
);
const TRIM: Setting = usual(
    key("trim", "The right wheel's diameter over the left wheel's.", "trim = 1.01"),
    Of::Number([0.8, 1.25]),
    "1",
);
const OFFSET: Setting = usual(
    key("offset", "The distance to add to each echo.", "offset = \"1.5 cm\""),
    Of::Length([-0.1, 0.1]),
    "0 cm",
);

const DIAMETER: Setting = needed(
    key("wheel_diameter", "The diameter of a driven wheel.", "wheel_diameter = \"65 mm\""),
    Of::Length([0.01, 0.3]),
);

const TICKS: Setting = needed(
    key("ticks", "The counts of an encoder in one turn of its wheel.", "ticks = 1440"),
    Of::Count([4, 1_000_000]),
);

const RAMP: Setting = usual(
    key("ramp", "The time from standstill to the top speed, and back.", "ramp = \"150 ms\""),
    Of::Time([Duration::from_millis(10), Duration::from_millis(250)]),
    "150 ms",
);

const DRIVE: &[Setting] = &[TRACK, TRIM, DIAMETER, TICKS, FASTEST, RAMP];

const PI_DRIVE: &[Setting] = &[
    needed(
        key("kind", "The motor driver, which sets the frequency of the PWM.", "kind = \"tb6612\""),
        Of::Choice(&["tb6612", "l298n"]),
    ),
    TRACK,
    TRIM,
    DIAMETER,
    TICKS,
    FASTEST,
    RAMP,
];

const WHEEL: &[Setting] = &[
    needed(key("pwm", "The PWM channel of the motor.", "pwm = \"pwmchip0/0\""), Of::Pwm),
    needed(key("in", "The lines of the motor driver's two inputs.", "in = [5, 6]"), Of::Lines),
    needed(
        key("encoder", "The lines of the encoder; the first leads forwards.", "encoder = [17, 27]"),
        Of::Lines,
    ),
];

const GUARD: &[Setting] =
    &[needed(key("line", "The line that enables the motors.", "line = 25"), Of::Line)];

const CHIP: Setting = usual(
    key("chip", "The GPIO chip of the header.", "chip = \"/dev/gpiochip0\""),
    Of::Text,
    "/dev/gpiochip0",
);

const FORWARD: Setting = simulated(
    needed(
        key("forward", "From the wheels' axis ahead to the range sensor.", "forward = \"8 cm\""),
        Of::Length([0.0, 0.5]),
    ),
    "robot.sonar_m",
);

const CLOSED: Setting = usual(
    key(
        "closed",
        "When the switch is closed; 'free' makes a broken wire read as pressed.",
        "closed = \"free\"",
    ),
    Of::Choice(&["free", "pressed"]),
    "free",
);

const SWITCH: &[Setting] = &[CLOSED];

const PINNED: &[Setting] = &[
    needed(key("pin", "The line of the switch; its other end is ground.", "pin = 16"), Of::Line),
    CLOSED,
];
