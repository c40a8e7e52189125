//! Watch the bumper and the escape button: their state and their presses.

use core::marker::PhantomData;

use crate::devices::{Button, Buttons, Reading, TouchSensor};
use crate::helpers::guard::{Guard, NO_BUTTON, NO_TOUCH};
use crate::templates::{
    self, check_escape_button, check_escape_button_click, check_touch_sensor,
    check_touch_sensor_click,
};
use afp_core::{Events, Fault, Instant, Supervisor, SupervisorTemplate};

/// Reports while the bumper is pressed.
pub type CheckTouchSensor = Watch<templates::CheckTouchSensor, Held>;
/// Reports each press of the bumper once.
pub type CheckTouchSensorClick = Watch<templates::CheckTouchSensorClick, Press>;
/// Reports while the escape button is pressed.
pub type CheckEscapeButton = Watch<templates::CheckEscapeButton, Held>;
/// Reports each press of the escape button once.
pub type CheckEscapeButtonClick = Watch<templates::CheckEscapeButtonClick, Press>;

/// Watches the switch of a template; `R` decides when to report.
#[derive(Clone, Debug)]
pub struct Watch<T, R> {
    guard: Guard,
    report: R,
    template: PhantomData<T>,
}

/// A template with one event for one switch.
pub trait Switch<E: ?Sized>: SupervisorTemplate {
    /// The fault of a switch without usable readings.
    const SILENT: Fault;
    /// The reported event.
    const EVENT: Self::Event;

    /// Whether the switch is held down.
    fn held(env: &E) -> Reading<bool>;
}

/// When to report.
pub trait Report: Default {
    /// Whether a reading is reported.
    fn is_due(&mut self, held: Option<bool>) -> bool;
}

impl<E: ?Sized, T: Switch<E>, R: Report> Supervisor<T, E> for Watch<T, R> {
    fn start(_: T::Inputs<'_>, _: &mut E, now: Instant) -> Result<Self, Fault> {
        let guard = Guard::new(T::SILENT, now);
        Ok(Watch { guard, report: R::default(), template: PhantomData })
    }

    fn poll(
        &mut self,
        _: T::Live<'_>,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<T::Event>, Fault> {
        let held = self.guard.current(T::held(env), now)?;
        Ok((self.report.is_due(held) && wanted.contains(0)).then_some(T::EVENT))
    }
}

impl<E: TouchSensor + ?Sized> Switch<E> for templates::CheckTouchSensor {
    const SILENT: Fault = NO_TOUCH;
    const EVENT: Self::Event = check_touch_sensor::Event::TouchSensorPressed;

    fn held(env: &E) -> Reading<bool> {
        env.touched()
    }
}

impl<E: TouchSensor + ?Sized> Switch<E> for templates::CheckTouchSensorClick {
    const SILENT: Fault = NO_TOUCH;
    const EVENT: Self::Event = check_touch_sensor_click::Event::TouchSensorClicked;

    fn held(env: &E) -> Reading<bool> {
        env.touched()
    }
}

impl<E: Buttons + ?Sized> Switch<E> for templates::CheckEscapeButton {
    const SILENT: Fault = NO_BUTTON;
    const EVENT: Self::Event = check_escape_button::Event::EscapeButtonPressed;

    fn held(env: &E) -> Reading<bool> {
        env.pressed(Button::Escape)
    }
}

impl<E: Buttons + ?Sized> Switch<E> for templates::CheckEscapeButtonClick {
    const SILENT: Fault = NO_BUTTON;
    const EVENT: Self::Event = check_escape_button_click::Event::EscapeButtonClicked;

    fn held(env: &E) -> Reading<bool> {
        env.pressed(Button::Escape)
    }
}

/// Reports for as long as the switch is held down.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held;

impl Report for Held {
    fn is_due(&mut self, held: Option<bool>) -> bool {
        held == Some(true)
    }
}

/// Reports the beginning of a press; stores whether the switch was held at the last reading.
#[derive(Clone, Copy, Debug, Default)]
pub struct Press {
    held: Option<bool>,
}

impl Report for Press {
    /// A switch held at the first reading was pressed before. A failed reading changes nothing.
    fn is_due(&mut self, held: Option<bool>) -> bool {
        let begins = self.held == Some(false) && held == Some(true);
        self.held = held.or(self.held);
        begins
    }
}

#[cfg(test)]
mod tests {
    use core::fmt::Debug;
    use std::vec;
    use std::vec::Vec;

    use super::*;
    use crate::fake::Fake;
    use crate::templates::{
        check_escape_button as held_button, check_escape_button_click as pressed_button,
        check_touch_sensor as held_bumper, check_touch_sensor_click as pressed_bumper,
    };
    use afp_core::Duration;

    /// Polls a new supervisor at some time, milliseconds.
    fn poll<'a, T: Switch<Fake>>(
        robot: &mut Fake,
        (inputs, live): (T::Inputs<'a>, T::Live<'a>),
        wanted: u64,
        after: u64,
    ) -> Result<Option<T::Event>, Fault> {
        let mut watch = Watch::<T, Held>::start(inputs, robot, robot.now)?;
        robot.now += Duration::from_millis(after);
        let now = robot.now;
        Supervisor::<T, Fake>::poll(&mut watch, live, Events::from_bits(wanted), robot, now)
    }

    fn reports_a_wanted_press_only<T: Switch<Fake, Event: Debug + PartialEq>>(
        ports: fn() -> (T::Inputs<'static>, T::Live<'static>),
        press: fn(&mut Fake),
    ) {
        let mut robot = Fake::new(&[]);
        assert_eq!(poll::<T>(&mut robot, ports(), 1, 5), Ok(None));
        press(&mut robot);
        assert_eq!(poll::<T>(&mut robot, ports(), 1, 5), Ok(Some(T::EVENT)));
        assert_eq!(poll::<T>(&mut robot, ports(), 0, 5), Ok(None));
    }

    fn bumper() -> (held_bumper::Inputs, held_bumper::Live) {
        (held_bumper::Inputs {}, held_bumper::Live {})
    }

    fn button() -> (held_button::Inputs, held_button::Live) {
        (held_button::Inputs {}, held_button::Live {})
    }

    #[test]
    fn only_a_wanted_press_is_reported() {
        reports_a_wanted_press_only::<templates::CheckTouchSensor>(bumper, |robot| {
            robot.touched = true;
        });
        reports_a_wanted_press_only::<templates::CheckEscapeButton>(button, |robot| {
            robot.escape = true;
        });
    }

    #[test]
    fn a_dead_switch_is_a_fault_after_half_a_second() {
        let mut robot = Fake::new(&[]);
        robot.dead_switches = true;
        let bumper =
            |robot: &mut Fake, ms| poll::<templates::CheckTouchSensor>(robot, bumper(), 1, ms);
        assert_eq!(bumper(&mut robot, 500), Ok(None));
        assert_eq!(bumper(&mut robot, 501), Err(NO_TOUCH));
        let button =
            |robot: &mut Fake, ms| poll::<templates::CheckEscapeButton>(robot, button(), 1, ms);
        assert_eq!(button(&mut robot, 500), Ok(None));
        assert_eq!(button(&mut robot, 501), Err(NO_BUTTON));
    }

    /// Whether each `[held, wanted]` poll of the bumper and of the button reports.
    fn clicks(polls: &[(bool, u64)]) -> [Result<Vec<bool>, Fault>; 2] {
        let bumper = Fake::new(&[])
            .clicks::<templates::CheckTouchSensorClick, CheckTouchSensorClick>(
                pressed_bumper::Inputs {},
                || pressed_bumper::Live {},
                |robot, held| robot.touched = held,
                polls,
            );
        let button = Fake::new(&[])
            .clicks::<templates::CheckEscapeButtonClick, CheckEscapeButtonClick>(
                pressed_button::Inputs {},
                || pressed_button::Live {},
                |robot, held| robot.escape = held,
                polls,
            );
        [bumper, button]
    }

    #[test]
    fn each_wanted_press_is_reported_once() {
        let polls = [false, true, true, false, true].map(|held| (held, 1));
        let both = |reports: &[bool]| [Ok(reports.to_vec()), Ok(reports.to_vec())];
        assert_eq!(clicks(&polls), both(&[false, true, false, false, true]));
        // A switch counts as not pressed if held from the start or not wanted.
        assert_eq!(clicks(&[(true, 1), (true, 1)]), both(&[false, false]));
        let unwanted = [(false, 1), (true, 0), (true, 1)];
        assert_eq!(clicks(&unwanted), both(&[false, false, false]));
    }

    #[test]
    fn an_invalid_reading_neither_begins_nor_ends_a_press() {
        let mut press = Press::default();
        let readings = [Some(false), Some(true), None, Some(true), Some(false), None, Some(true)];
        let begins: Vec<_> = readings.into_iter().map(|held| press.is_due(held)).collect();
        assert_eq!(begins, vec![false, true, false, false, false, false, true]);
    }
}
