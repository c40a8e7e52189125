//! The battery: two lithium cells in series, drained by the computer and the motors.

use afp_carbot::devices::Charge;
use afp_core::quantity::Voltage;

/// The energy of a full battery, in joules: 5.2 Ah at 7.4 V.
const CAPACITY: f64 = 5.2 * 7.4 * 3600.0;
/// The internal resistance, in ohms.
const RESISTANCE: f64 = 0.06;
/// The power of the computer and the sensors, in watts.
const IDLE: f64 = 5.0;
/// The power of a wheel per metre a second, in watts.
const WHEEL: f64 = 15.0;
/// The voltage without a load, by the remaining share of the charge.
const CURVE: [(f64, f64); 7] =
    [(0.0, 5.6), (0.05, 6.4), (0.1, 6.9), (0.2, 7.2), (0.5, 7.5), (0.9, 8.0), (1.0, 8.4)];
/// Down to this voltage, the motors reach their top speed. At the lower voltage, three volts a
/// cell, the controller cuts them off to protect the cells.
const FULL_SPEED: f64 = 6.6;
const CUT_OFF: f64 = 6.0;

#[derive(Clone, Debug)]
pub(crate) struct Battery {
    drawn: f64,
    /// Share of a full charge at the start.
    first: f64,
    most: f64,
    voltage: f64,
}

impl Battery {
    pub(crate) fn new(first: f64) -> Self {
        let mut battery = Battery { drawn: 0.0, first, most: 1.0, voltage: 0.0 };
        battery.step([0.0, 0.0], 0.0);
        battery
    }

    /// Limits the remaining share; 1 means no limit.
    pub(crate) fn limit(&mut self, most: f64) {
        self.most = most;
    }

    /// Draws energy for `dt` seconds with the wheels at these speeds, in metres a second.
    pub(crate) fn step(&mut self, wheels: [f64; 2], dt: f64) {
        let power = IDLE + WHEEL * (wheels[0].abs() + wheels[1].abs());
        self.drawn += power * dt;
        let open = open_voltage(self.left());
        self.voltage = open - RESISTANCE * power / open;
    }

    pub(crate) fn speed(&self) -> f64 {
        ((self.voltage - CUT_OFF) / (FULL_SPEED - CUT_OFF)).clamp(0.0, 1.0)
    }

    /// The reading of the gauge: the voltage to 10 mV, the share to 1 %.
    pub(crate) fn charge(&self) -> Charge {
        Charge {
            voltage: Voltage::from_si(libm::round(self.voltage * 100.0) / 100.0),
            left: libm::round(self.left() * 100.0) / 100.0,
        }
    }

    fn left(&self) -> f64 {
        (self.first - self.drawn / CAPACITY).clamp(0.0, self.most)
    }
}

/// The voltage between two points of the curve.
fn open_voltage(left: f64) -> f64 {
    let mut last = CURVE[0];
    for next in CURVE {
        if left <= next.0 {
            let width: f64 = next.0 - last.0;
            let share = if width > 0.0 { (left - last.0) / width } else { 0.0 };
            return last.1 + (next.1 - last.1) * share;
        }
        last = next;
    }
    last.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voltage_falls_with_the_charge_and_under_load() {
        let at = |left, wheels| {
            let mut battery = Battery::new(left);
            battery.step(wheels, 0.0);
            battery.charge().voltage.si()
        };
        assert!((at(1.0, [0.0; 2]) - 8.36).abs() < 0.011);
        assert!(at(1.0, [0.31; 2]) < at(1.0, [0.0; 2]));
        let falling: Vec<f64> = [1.0, 0.7, 0.3, 0.1, 0.02, 0.0].map(|c| at(c, [0.0; 2])).to_vec();
        assert!(falling.windows(2).all(|pair| pair[0] > pair[1]), "{falling:?}");
    }

    #[test]
    fn an_hour_of_driving_takes_about_a_third() {
        let mut battery = Battery::new(1.0);
        for _ in 0..3600 {
            battery.step([0.31, 0.31], 1.0);
        }
        // 5 W and twice 4.65 W of 38.5 Wh.
        assert!((battery.left() - (1.0 - 14.3 / 38.48)).abs() < 0.001, "{}", battery.left());
        assert_eq!(battery.speed(), 1.0);
    }

    #[test]
    fn a_low_battery_drives_slowly_and_an_empty_battery_stops() {
        assert_eq!(Battery::new(0.0).speed(), 0.0);
        assert!(Battery::new(0.05).speed() < 1.0);
        assert_eq!(Battery::new(0.2).speed(), 1.0);
    }
}
