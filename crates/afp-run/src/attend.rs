//! Who attends a run of `afpc run` or of a generated binary: whoever judges it, tells of it, holds it
//! back to real time, and presses the robot's buttons.

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::Record;
use afp_core::{Duration, Instant};
use afp_sim::{Simulation, Truth};

use crate::judge::Judge;
use crate::options::{Button, Press};
use crate::pace::{Pace, Waited};
use crate::report::Report;
use crate::rig::{Company, Go, Rig};
use crate::stop::StopFlag;

/// How long a button is held down.
const HOLD: Duration = Duration::from_millis(200);

/// Everybody who attends a run.
pub(crate) struct Attendants {
    pub judge: Judge,
    pub report: Report,
    pub pace: Pace,
    pub stop: StopFlag,
    pub stimuli: Stimuli,
}

/// What happens to the robot from outside, in order of time.
#[derive(Debug, Default)]
pub(crate) struct Stimuli(Vec<(Instant, Stimulus)>);

#[derive(Clone, Copy, Debug)]
enum Stimulus {
    Press(Button),
    Release(Button),
}

impl Stimuli {
    pub(crate) fn new(presses: &[Press]) -> Self {
        let mut stimuli = Stimuli::default();
        for press in presses {
            stimuli.press(press.button, press.at);
        }
        stimuli
    }

    fn press(&mut self, button: Button, at: Instant) {
        self.0.push((at, Stimulus::Press(button)));
        self.0.push((at + HOLD, Stimulus::Release(button)));
        // The sort is stable: what was asked for first happens first.
        self.0.sort_by_key(|(at, _)| *at);
    }

    fn next(&self) -> Instant {
        self.0.first().map_or(Instant::MAX, |(at, _)| *at)
    }

    fn take_due(&mut self, now: Instant) -> Option<Stimulus> {
        (self.next() <= now && !self.0.is_empty()).then(|| self.0.remove(0).1)
    }
}

impl<P: NamedPlan + Plan<Simulation>> Company<P> for Attendants {
    fn wait(&mut self, target: Instant, now: Instant) -> Go {
        self.report.pass(now);
        if self.report.is_closed() {
            return Go::Stop;
        }
        match self.pace.wait(target, &self.stop) {
            Waited::Due => Go::On,
            Waited::Escape => {
                let at = self.pace.simulated().unwrap_or(target).min(target);
                self.stimuli.press(Button::Escape, at.max(now));
                Go::Again
            }
            Waited::Stop => Go::Stop,
        }
    }

    fn next(&self) -> Instant {
        self.stimuli.next()
    }

    fn happen(&mut self, rig: &mut Rig<P>, now: Instant) {
        while let Some(stimulus) = self.stimuli.take_due(now) {
            match stimulus {
                Stimulus::Press(Button::Escape) => rig.sim.press_escape(),
                Stimulus::Release(Button::Escape) => rig.sim.release_escape(),
                Stimulus::Press(Button::Touch) => rig.sim.press_bumper(),
                Stimulus::Release(Button::Touch) => rig.sim.release_bumper(),
            }
        }
    }

    fn hear(&mut self, at: Instant, record: &Record<'_>, names: &P::Names, truth: &Truth<'_>) {
        self.judge.hear(at, record, names, truth);
        self.report.tell(at, record, names);
    }

    fn looks(&self) -> bool {
        true
    }

    fn look(&mut self, now: Instant, truth: &Truth<'_>) {
        self.judge.look(now, truth);
    }
}
