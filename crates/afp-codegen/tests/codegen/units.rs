// units.rs

/// Units of `speed`.
pub static SPEED: [Unit<'static>; 30] = [
    Unit {
        name: "m/s",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "m/ms",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "m/us",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "m/ns",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "m/min",
        scale: Scale::fraction(1, 60, 0, 0),
    },
    Unit {
        name: "m/h",
        scale: Scale::fraction(1, 3600, 0, 0),
    },
    Unit {
        name: "km/s",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "km/ms",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "km/us",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "km/ns",
        scale: Scale::Decimal(12),
    },
    Unit {
        name: "km/min",
        scale: Scale::fraction(1, 60, 3, 0),
    },
    Unit {
        name: "km/h",
        scale: Scale::fraction(1, 3600, 3, 0),
    },
    Unit {
        name: "cm/s",
        scale: Scale::Decimal(-2),
    },
    Unit {
        name: "cm/ms",
        scale: Scale::Decimal(1),
    },
    Unit {
        name: "cm/us",
        scale: Scale::Decimal(4),
    },
    Unit {
        name: "cm/ns",
        scale: Scale::Decimal(7),
    },
    Unit {
        name: "cm/min",
        scale: Scale::fraction(1, 60, -2, 0),
    },
    Unit {
        name: "cm/h",
        scale: Scale::fraction(1, 3600, -2, 0),
    },
    Unit {
        name: "mm/s",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "mm/ms",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "mm/us",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "mm/ns",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "mm/min",
        scale: Scale::fraction(1, 60, -3, 0),
    },
    Unit {
        name: "mm/h",
        scale: Scale::fraction(1, 3600, -3, 0),
    },
    Unit {
        name: "um/s",
        scale: Scale::Decimal(-6),
    },
    Unit {
        name: "um/ms",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "um/us",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "um/ns",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "um/min",
        scale: Scale::fraction(1, 60, -6, 0),
    },
    Unit {
        name: "um/h",
        scale: Scale::fraction(1, 3600, -6, 0),
    },
];

/// Units of `angular_speed`.
pub static ANGULAR_SPEED: [Unit<'static>; 18] = [
    Unit {
        name: "rad/s",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "rad/ms",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "rad/us",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "rad/ns",
        scale: Scale::Decimal(9),
    },
    Unit {
        name: "rad/min",
        scale: Scale::fraction(1, 60, 0, 0),
    },
    Unit {
        name: "rad/h",
        scale: Scale::fraction(1, 3600, 0, 0),
    },
    Unit {
        name: "mrad/s",
        scale: Scale::Decimal(-3),
    },
    Unit {
        name: "mrad/ms",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "mrad/us",
        scale: Scale::Decimal(3),
    },
    Unit {
        name: "mrad/ns",
        scale: Scale::Decimal(6),
    },
    Unit {
        name: "mrad/min",
        scale: Scale::fraction(1, 60, -3, 0),
    },
    Unit {
        name: "mrad/h",
        scale: Scale::fraction(1, 3600, -3, 0),
    },
    Unit {
        name: "deg/s",
        scale: Scale::fraction(1, 1, 0, 1),
    },
    Unit {
        name: "deg/ms",
        scale: Scale::fraction(1, 1, 3, 1),
    },
    Unit {
        name: "deg/us",
        scale: Scale::fraction(1, 1, 6, 1),
    },
    Unit {
        name: "deg/ns",
        scale: Scale::fraction(1, 1, 9, 1),
    },
    Unit {
        name: "deg/min",
        scale: Scale::fraction(1, 60, 0, 1),
    },
    Unit {
        name: "deg/h",
        scale: Scale::fraction(1, 3600, 0, 1),
    },
];

/// Units of `temperature`.
pub static TEMPERATURE: [Unit<'static>; 2] = [
    Unit {
        name: "K",
        scale: Scale::Decimal(0),
    },
    Unit {
        name: "degC",
        scale: Scale::Celsius,
    },
];
