//! A copy of the simulation that goes on by itself: a keyframe to come back to.

use super::Simulation;

impl Simulation {
    /// The same robot in the same world at the same instant, every noise where it is, with a clock of its own: both go
    /// on alike.
    pub(super) fn split(&self) -> Simulation {
        Simulation {
            stage: self.stage.split(),
            start: self.start,
            now: self.now,
            steps: self.steps,
            drive: self.drive.clone(),
            odometer: self.odometer.clone(),
            rotator: self.rotator.clone(),
            sonar: self.sonar.clone(),
            ping: self.ping,
            echo: self.echo,
            switch: self.switch.clone(),
            bump: self.bump,
            trail: self.trail,
            battery: self.battery.clone(),
            scene: self.scene.clone(),
            lights: self.lights.clone(),
            infrared: self.infrared.clone(),
            glow: self.glow,
            color_sensor: self.color_sensor.clone(),
            color: self.color,
            exposure: self.exposure.clone(),
            exposed_before: self.exposed_before.clone(),
            flow: self.flow.clone(),
            locator: self.locator.clone(),
            located: self.located.clone(),
            planner: self.planner.clone(),
            audible: self.audible.clone(),
            shown: self.shown,
            seed: self.seed,
            held: self.held,
            escape: self.escape,
            stopped: self.stopped,
            faults: self.faults.clone(),
            lines: self.lines.clone(),
            delayed: self.delayed,
            clock: self.clock.split(),
            map: self.map.clone(),
            left_map: self.left_map,
            dropped: self.dropped,
        }
    }
}
