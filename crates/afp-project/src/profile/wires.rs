//! The wires of a robot with a profile, from its values in `afp.toml`.

use super::ProfileRobot;

/// A wire between two pins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wire {
    pub kind: WireKind,
    /// The board, and its pin.
    pub board: &'static str,
    pub pin: String,
    /// The part, and its pin.
    pub part: &'static str,
    pub at: &'static str,
    /// A component in the wire; empty for a plain wire.
    pub note: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WireKind {
    Supply,
    Ground,
    /// A command to the part.
    Command,
    /// A reading of the part.
    Reading,
    /// The current of a motor.
    Motor,
}

use WireKind::{Command, Ground, Motor, Reading, Supply};

const RASPBERRY: &str = "Raspberry Pi";
const PICO: &str = "Raspberry Pi Pico";
const SERVO_DRIVER: &str = "PCA9685";
const POWER: &str = "Power supply";
const LEFT: &str = "Left motor";
const RIGHT: &str = "Right motor";
const ENCODERS: [&str; 2] = ["Left encoder", "Right encoder"];
const SONAR: &str = "HC-SR04";
const SERVO: &str = "Servo";

/// The pin on the header of a Raspberry Pi, by line.
const HEADER: [u8; 28] = [
    27, 28, 3, 5, 7, 29, 31, 26, 24, 21, 19, 23, 32, 33, 8, 10, 36, 11, 12, 35, 38, 40, 15, 16, 18,
    22, 37, 13,
];

/// The lines of the PWM of a Raspberry Pi, by channel of the first chip.
const PWM: [u32; 2] = [12, 13];

/// Names of a motor driver's pins: the power and the two inputs of the left and the right motor, and
/// their outputs.
struct Bridge {
    name: &'static str,
    inputs: [[&'static str; 3]; 2],
    outputs: [[&'static str; 2]; 2],
    logic: &'static str,
    motors: &'static str,
}

const TB6612: Bridge = Bridge {
    name: "TB6612",
    inputs: [["PWMA", "AIN1", "AIN2"], ["PWMB", "BIN1", "BIN2"]],
    outputs: [["AO1", "AO2"], ["BO1", "BO2"]],
    logic: "VCC",
    motors: "VM",
};

const L298N: Bridge = Bridge {
    name: "L298N",
    inputs: [["ENA", "IN1", "IN2"], ["ENB", "IN3", "IN4"]],
    outputs: [["OUT1", "OUT2"], ["OUT3", "OUT4"]],
    logic: "",
    motors: "12V",
};

/// The names of a board's pins.
struct Board {
    name: &'static str,
    pin: fn(u32) -> String,
    supply: &'static str,
    five_volts: &'static str,
    ground: &'static str,
}

const PI_HEADER: Board = Board {
    name: RASPBERRY,
    pin: |line| {
        let pin = HEADER.get(line as usize).copied().unwrap_or_default();
        format!("GPIO {line} (pin {pin})")
    },
    supply: "3.3 V (pin 1)",
    five_volts: "5 V (pin 2)",
    ground: "ground (pin 6)",
};

const PICO_PINS: Board = Board {
    name: PICO,
    // Every fifth pin is ground.
    pin: |line| format!("GP{line} (pin {})", line + 1 + (line + 2) / 4),
    supply: "3V3 (pin 36)",
    five_volts: "VBUS (pin 40)",
    ground: "ground (pin 38)",
};

/// The wires of a board.
struct Wires {
    board: Board,
    all: Vec<Wire>,
}

impl Wires {
    fn wire(
        &mut self,
        (kind, pin): (WireKind, impl Into<String>),
        (part, at): (&'static str, &'static str),
        note: &'static str,
    ) {
        let (board, pin) = (self.board.name, pin.into());
        self.all.push(Wire { kind, board, pin, part, at, note });
    }

    fn line(
        &mut self,
        kind: WireKind,
        line: u32,
        part: (&'static str, &'static str),
        note: &'static str,
    ) {
        self.wire((kind, (self.board.pin)(line)), part, note);
    }

    fn ground(&mut self, part: (&'static str, &'static str)) {
        self.wire((Ground, self.board.ground), part, "");
    }

    fn encoder(&mut self, part: &'static str, [a, b]: [u32; 2]) {
        self.line(Reading, a, (part, "A"), "");
        self.line(Reading, b, (part, "B"), "");
        self.wire((Supply, self.board.supply), (part, "VCC"), "");
        self.ground((part, "GND"));
    }

    fn sonar(&mut self, trigger: u32, echo: u32) {
        self.line(Command, trigger, (SONAR, "Trig"), "");
        self.line(Reading, echo, (SONAR, "Echo"), "1 kOhm; 2 kOhm to ground");
        self.wire((Supply, self.board.five_volts), (SONAR, "VCC"), "");
        self.ground((SONAR, "GND"));
    }

    fn switch(&mut self, part: &'static str, line: u32) {
        self.line(Reading, line, (part, "one contact"), "");
        self.ground((part, "other contact"));
    }

    /// The wires from the bridge to the motors and their battery.
    fn motors(&mut self, bridge: &Bridge) {
        let mut wire = |kind, pin: &str, part, at| {
            let (pin, note) = (pin.to_owned(), "");
            self.all.push(Wire { kind, board: bridge.name, pin, part, at, note });
        };
        for (part, [one, other]) in [LEFT, RIGHT].into_iter().zip(bridge.outputs) {
            wire(Motor, one, part, "+");
            wire(Motor, other, part, "-");
        }
        wire(Supply, bridge.motors, "Battery", "+");
        wire(Ground, "GND", "Battery", "-");
    }

    /// Power of a servo; its signal comes from a board.
    fn servo_supply(&mut self) {
        for (kind, pin, at) in [(Supply, "5 V", "red"), (Ground, "ground", "brown")] {
            let (pin, note) = (pin.to_owned(), "");
            self.all.push(Wire { kind, board: POWER, pin, part: SERVO, at, note });
        }
    }
}

impl ProfileRobot {
    /// The wires of the robot, board by board and part by part. The parts of a bought robot are
    /// wired already.
    pub fn wires(&self) -> Vec<Wire> {
        match self.name {
            "carbot" => self.with_a_pico(),
            "pi" => self.on_pins(),
            "ugv" => ugv(),
            "picarx" => self.with_a_hat(),
            _ => Vec::new(),
        }
    }

    fn has(&self, section: &str) -> bool {
        self.sections.contains(&section)
    }

    /// The lines of a setting.
    fn lines(&self, path: &str) -> Vec<u32> {
        let text = self.values.iter().find(|(name, _)| name == path).map(|(_, text)| text);
        text.into_iter().flat_map(|text| text.split(',')).filter_map(super::line).collect()
    }

    fn two(&self, path: &str) -> [u32; 2] {
        let lines = self.lines(path);
        [0, 1].map(|at| lines.get(at).copied().unwrap_or_default())
    }

    fn one(&self, path: &str) -> u32 {
        self.two(path)[0]
    }

    /// The pins of `firmware/drive`.
    fn with_a_pico(&self) -> Vec<Wire> {
        let mut wires = Wires { board: PICO_PINS, all: Vec::new() };
        let (kind, pin, note) = (Reading, "USB".to_owned(), "USB cable");
        wires.all.push(Wire { kind, board: RASPBERRY, pin, part: PICO, at: "USB", note });
        let bridge = &TB6612;
        for (at, lines) in bridge.inputs.into_iter().zip([[2, 4, 5], [3, 6, 7]]) {
            at.into_iter().zip(lines).for_each(|(at, line)| {
                wires.line(Command, line, (bridge.name, at), "");
            });
        }
        wires.line(Command, 8, (bridge.name, "STBY"), "10 kOhm to ground");
        wires.wire((Supply, PICO_PINS.supply), (bridge.name, bridge.logic), "");
        wires.ground((bridge.name, "GND"));
        for (part, lines) in ENCODERS.into_iter().zip([[10, 11], [12, 13]]) {
            wires.encoder(part, lines);
        }
        if self.has("ultrasonic") {
            wires.sonar(16, 17);
            wires.line(Command, 15, (SERVO, "signal"), "");
        }
        if self.has("bumper") {
            wires.switch("Bumper", 18);
        }
        if self.has("button") {
            wires.switch("Button", 19);
        }
        wires.motors(bridge);
        if self.has("ultrasonic") {
            wires.servo_supply();
        }
        wires.all
    }

    fn on_pins(&self) -> Vec<Wire> {
        let mut wires = Wires { board: PI_HEADER, all: Vec::new() };
        let is_l298n =
            self.values.iter().any(|(name, value)| name == "drive.kind" && value == "l298n");
        let bridge = if is_l298n { &L298N } else { &TB6612 };
        for (side, [pwm, ahead, back]) in ["left", "right"].into_iter().zip(bridge.inputs) {
            let channel = self.channel(&format!("{side}.pwm"));
            wires.wire((Command, channel.0), (bridge.name, pwm), "");
            let [first, second] = self.two(&format!("{side}.in"));
            wires.line(Command, first, (bridge.name, ahead), "");
            wires.line(Command, second, (bridge.name, back), "");
        }
        let guard = match is_l298n {
            true => ("Transistor in the motors' supply", "gate"),
            false => (bridge.name, "STBY"),
        };
        if !is_l298n {
            wires.line(Command, self.one("guard.line"), guard, "10 kOhm to ground");
            wires.wire((Supply, PI_HEADER.supply), (bridge.name, bridge.logic), "");
        }
        wires.ground((bridge.name, "GND"));
        if is_l298n {
            wires.line(Command, self.one("guard.line"), guard, "10 kOhm to ground");
        }
        for (part, side) in ENCODERS.into_iter().zip(["left", "right"]) {
            wires.encoder(part, self.two(&format!("{side}.encoder")));
        }
        if self.has("ultrasonic") {
            wires.sonar(self.one("ultrasonic.trigger"), self.one("ultrasonic.echo"));
        }
        if self.has("bumper") {
            wires.switch("Bumper", self.one("bumper.pin"));
        }
        if self.has("button") {
            wires.switch("Button", self.one("button.pin"));
        }
        if self.has("servo") {
            self.servo(&mut wires);
        }
        wires.motors(bridge);
        if self.has("servo") {
            wires.servo_supply();
        }
        wires.all
    }

    /// The signal of the servo.
    fn servo(&self, wires: &mut Wires) {
        let (pin, is_own) = self.channel("servo.pwm");
        if is_own {
            wires.wire((Command, pin), (SERVO, "signal"), "");
            return;
        }
        for (line, at) in [(2, "SDA"), (3, "SCL")] {
            wires.line(Command, line, (SERVO_DRIVER, at), "");
        }
        wires.wire((Supply, PI_HEADER.supply), (SERVO_DRIVER, "VCC"), "");
        wires.ground((SERVO_DRIVER, "GND"));
        let (kind, board, note) = (Command, SERVO_DRIVER, "");
        wires.all.push(Wire { kind, board, pin, part: SERVO, at: "signal", note });
    }

    /// The pin of a PWM channel, and whether it is a pin of the Raspberry Pi.
    fn channel(&self, path: &str) -> (String, bool) {
        let text = self.values.iter().find(|(name, _)| name == path).map(|(_, text)| &**text);
        let (chip, channel) = text.and_then(|text| text.split_once('/')).unwrap_or_default();
        let own = channel.parse::<usize>().ok().and_then(|channel| PWM.get(channel));
        match own.filter(|_| chip == "pwmchip0") {
            Some(line) => ((PI_HEADER.pin)(*line), true),
            None => (format!("channel {channel}"), false),
        }
    }

    /// The ports of the Robot HAT, and the lines behind them.
    fn with_a_hat(&self) -> Vec<Wire> {
        let hat = "Robot HAT";
        let mut all = Vec::new();
        let mut wire = |kind, pin: &str, part, at| {
            let pin = pin.to_owned();
            all.push(Wire { kind, board: hat, pin, part, at, note: "" });
        };
        wire(Command, "P2", "Steering servo", "plug");
        wire(Motor, "left motor port", LEFT, "plug");
        wire(Motor, "right motor port", RIGHT, "plug");
        if self.has("ultrasonic") {
            wire(Command, "D2 (GPIO 27)", SONAR, "Trig");
            wire(Reading, "D3 (GPIO 22)", SONAR, "Echo");
            wire(Supply, "3V3", SONAR, "VCC");
            wire(Ground, "GND", SONAR, "GND");
        }
        wire(Supply, "power plug", "Battery", "plug");
        let line = (PI_HEADER.pin)(self.one("guard.line"));
        let reset = Wire {
            kind: Command,
            board: RASPBERRY,
            pin: line,
            part: hat,
            at: "reset",
            note: "on the header",
        };
        let bus = [(2, "SDA"), (3, "SCL")].map(|(line, at)| {
            let pin = (PI_HEADER.pin)(line);
            Wire { kind: Command, board: RASPBERRY, pin, part: hat, at, note: "on the header" }
        });
        all.splice(0..0, bus.into_iter().chain([reset]));
        all
    }
}

/// The serial line of a UGV, whose board also feeds the Raspberry Pi.
fn ugv() -> Vec<Wire> {
    let part = "UGV controller (ESP32)";
    let mut wires = Wires { board: PI_HEADER, all: Vec::new() };
    wires.line(Command, 14, (part, "RX"), "");
    wires.line(Reading, 15, (part, "TX"), "");
    wires.wire((Supply, PI_HEADER.five_volts), (part, "5V"), "");
    wires.ground((part, "GND"));
    wires.all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_of_the_headers_have_their_numbers() {
        let pico = |line| (PICO_PINS.pin)(line);
        let known = [
            (0, 1),
            (1, 2),
            (2, 4),
            (3, 5),
            (4, 6),
            (5, 7),
            (6, 9),
            (7, 10),
            (8, 11),
            (9, 12),
            (10, 14),
            (13, 17),
            (14, 19),
            (15, 20),
            (16, 21),
            (17, 22),
            (18, 24),
            (19, 25),
            (22, 29),
        ];
        for (line, pin) in known {
            assert_eq!(pico(line), format!("GP{line} (pin {pin})"));
        }
        let mut all = HEADER.to_vec();
        all.sort_unstable();
        all.dedup();
        let others = [1, 2, 4, 6, 9, 14, 17, 20, 25, 30, 34, 39];
        assert!(all.len() == 28 && !all.iter().any(|pin| others.contains(pin)));
    }
}
