//! The grid of runs and its numbering.

use std::fmt::Write;

use afp_core::Duration;
use afp_dsl::types::text::duration;
use afp_excerpt::words::{shell_file, shell_setting, shell_word};
use afp_run::options::{Failure, Press};
use afp_run::world::LoadedWorld;

use crate::seeds::Seeds;
use crate::stimuli::{Stimuli, varies_stimuli};

/// Integers below this are exact as floats.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// A grid of runs. The seed changes fastest, then the last axis, and the world changes slowest.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The plan as named on the command line.
    pub plan: String,
    /// The worlds, at least one.
    pub worlds: Vec<WorldChoice>,
    /// Whether there is one world for each seed, instead of all worlds for each seed.
    pub worlds_by_seed: bool,
    /// The varied values.
    pub axes: Vec<Axis>,
    pub seeds: Seeds,
    pub presses: Vec<Press>,
    /// Faults in each run.
    pub failures: Vec<Failure>,
    /// The time limit of each run.
    pub until: Duration,
    /// The reason why a run's command gives a different result; `None` if it repeats the run.
    pub caveat: Option<&'static str>,
}

#[derive(Clone, Debug)]
pub enum WorldChoice {
    /// The plan's default world.
    OfPlan,
    /// A world named as in `--world`.
    Named(String),
    /// A world without a file, and its name in tables.
    Made(String, LoadedWorld),
}

/// A varied value.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// An entry of the plan, `world.` and the path of a value in the world's file, or a stimulus as
    /// in [`crate::varies_stimuli`].
    pub name: String,
    pub points: Vec<Point>,
    /// Whether it has one point for each seed, instead of all points for each seed.
    pub by_seed: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// As written, with its unit.
    pub text: String,
    /// In SI units; `None` for other types, or before the plan is known.
    pub si: Option<f64>,
}

/// A run of the grid.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// Its number, from 0.
    pub run: u64,
    pub world_number: usize,
    pub world: &'a WorldChoice,
    pub seed: u64,
    pub values: Vec<(&'a str, &'a Point)>,
}

impl Row<'_> {
    pub(crate) fn stimuli(&self) -> Stimuli {
        Stimuli::of(self.values.iter().map(|(name, point)| (*name, &*point.text)))
    }
}

impl WorldChoice {
    /// The name in tables; `None` for the plan's world.
    pub fn name(&self) -> Option<&str> {
        match self {
            WorldChoice::OfPlan => None,
            WorldChoice::Named(name) | WorldChoice::Made(name, _) => Some(name),
        }
    }

    /// The reason why no command accepts it, if none does.
    fn caveat(&self) -> Option<&'static str> {
        matches!(self, WorldChoice::Made(..)).then_some("the world has no file")
    }
}

impl Sweep {
    /// The number of runs.
    pub fn len(&self) -> u64 {
        let axes = self.axes.iter().filter(|axis| !axis.by_seed);
        let points = axes.map(|axis| axis.points.len() as u64);
        let worlds = if self.worlds_by_seed { 1 } else { self.worlds.len() as u64 };
        let combinations = points.fold(worlds, u64::saturating_mul);
        combinations.saturating_mul(self.seeds.len())
    }

    /// Whether there are no runs.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns a run by its number, which is below [`Sweep::len`].
    pub fn row(&self, run: u64) -> Row<'_> {
        let (mut rest, seeds) = (run, self.seeds.len().max(1));
        let of_seed = rest % seeds;
        let seed = self.seeds.nth(of_seed);
        rest /= seeds;
        let mut values = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            if axis.by_seed {
                let point = axis.points.get(of_seed as usize);
                values.extend(point.map(|point| (axis.name.as_str(), point)));
                continue;
            }
            let count = (axis.points.len() as u64).max(1);
            if let Some(point) = axis.points.get((rest % count) as usize) {
                values.push((axis.name.as_str(), point));
            }
            rest /= count;
        }
        values.reverse();
        let of_world = if self.worlds_by_seed { of_seed } else { rest };
        let world_number = (of_world as usize).min(self.worlds.len().saturating_sub(1));
        let world = self.worlds.get(world_number).unwrap_or(&WorldChoice::OfPlan);
        Row { run, world_number, world, seed, values }
    }

    /// Returns the command that repeats a run.
    pub fn command(&self, row: &Row<'_>) -> String {
        let mut command = format!("afpc run {}", shell_file(&self.plan));
        // Writing to a string cannot fail.
        if let Some(world) = row.world.name() {
            let _ = write!(command, " --world {}", shell_file(world));
        }
        let _ = write!(command, " --seed {}", row.seed);
        for (name, point) in row.values.iter().filter(|(name, _)| !varies_stimuli(name)) {
            let _ = write!(command, " --set {}", shell_setting(name, &point.text));
        }
        let varied = row.stimuli();
        for press in self.presses.iter().chain(&varied.presses) {
            let _ = write!(command, " --press {}", shell_word(&press.to_string()));
        }
        for failure in self.failures.iter().chain(&varied.failures) {
            let _ = write!(command, " --fail {}", shell_word(&failure.to_string()));
        }
        let _ = write!(command, " --until {}", spelled(self.until));
        let no_word = row.values.iter().any(|(_, point)| point.text.contains('\0'));
        let no_word = no_word.then_some("no command takes a value with the character NUL");
        let caveats = [self.caveat, row.world.caveat(), no_word].into_iter().flatten();
        for (number, caveat) in caveats.enumerate() {
            let _ = write!(command, "{}{caveat}", if number == 0 { "  # " } else { "; " });
        }
        command
    }

    /// The grid as text, equal for sweeps with the same runs, independent of number formats.
    pub fn signature(&self) -> String {
        let mut text = format!("seeds {}, until {}", self.seeds, spelled(self.until));
        let by_seed = if self.worlds_by_seed { ", worlds by seed" } else { "" };
        text += by_seed;
        for world in &self.worlds {
            let name = world.name().map_or("of the plan".into(), shell_word);
            let _ = write!(text, ", world {name}");
        }
        for axis in &self.axes {
            let points = axis.points.iter().map(|point| match point.si {
                // Both zeros are one value; an integer beyond the limit is not exact.
                Some(si) if si.abs() < EXACT && !varies_stimuli(&axis.name) => {
                    (si + 0.0).to_string()
                }
                _ => shell_word(&point.text),
            });
            let equals = if axis.by_seed { "by seed" } else { "=" };
            let points = points.collect::<Vec<_>>().join(" ");
            let _ = write!(text, ", {} {equals} {points}", axis.name);
        }
        for press in &self.presses {
            let _ = write!(text, ", press {press}");
        }
        for failure in &self.failures {
            let _ = write!(text, ", fail {failure}");
        }
        text
    }
}

/// An exact time in command-line format.
fn spelled(time: Duration) -> String {
    duration(time.as_nanos()).replace(' ', "")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use afp_run::options::{failure, press};

    use crate::ranges::{axis, seeds};

    fn sweep() -> Sweep {
        Sweep {
            caveat: None,
            plan: "my plan.afp".to_owned(),
            worlds: vec![WorldChoice::OfPlan, WorldChoice::Named("random:7".to_owned())],
            worlds_by_seed: false,
            axes: vec![axis("a=1,2,3").unwrap(), axis("b=20cm..30cm:5cm").unwrap()],
            seeds: seeds("5..9").unwrap(),
            presses: vec![press("touch@2s").unwrap()],
            failures: vec![failure("wheels.slip=0.2@3s..5s").unwrap()],
            until: Duration::from_millis(1500),
        }
    }

    #[test]
    fn every_combination_is_one_run() {
        let sweep = sweep();
        assert_eq!(sweep.len(), 2 * 3 * 3 * 4);
        let all: BTreeSet<_> = (0..sweep.len()).map(|run| sweep.command(&sweep.row(run))).collect();
        assert_eq!(all.len() as u64, sweep.len());
        assert_eq!(sweep.row(1).seed, 6);
        assert_eq!(sweep.row(4).values[1].1.text, "25cm");
        assert_eq!(sweep.row(36).world.name(), Some("random:7"));
    }

    #[test]
    fn each_seed_has_its_own_world() {
        let worlds = (5..9).map(|seed| WorldChoice::Named(format!("random:{seed}")));
        let sweep = Sweep { worlds: worlds.collect(), worlds_by_seed: true, ..sweep() };
        assert_eq!(sweep.len(), 3 * 3 * 4);
        for run in 0..sweep.len() {
            let row = sweep.row(run);
            assert_eq!(row.world.name(), Some(&*format!("random:{}", row.seed)));
        }
        assert_ne!(sweep.signature(), Sweep { worlds_by_seed: false, ..sweep.clone() }.signature());
    }

    #[test]
    fn commands_have_the_syntax_of_run() {
        let worlds = vec![WorldChoice::Named("-w.toml".to_owned())];
        let axes = vec![axis(r#"mode="x,y","",""q"""#).unwrap()];
        let sweep = Sweep { worlds, axes, plan: "-p.afp".to_owned(), ..sweep() };
        let command = |run| sweep.command(&sweep.row(run));
        assert!(command(0).starts_with("afpc run ./-p.afp --world ./-w.toml "), "{}", command(0));
        assert!(command(0).contains(" --set mode=x,y "), "{}", command(0));
        assert!(command(4).contains(r#" --set 'mode=""' "#), "{}", command(4));
        assert!(command(8).contains(r#" --set 'mode=""q""' "#), "{}", command(8));
    }

    /// The words of a command after a real shell has split them.
    #[cfg(unix)]
    fn in_shell(command: &str) -> Vec<String> {
        let mut shell = std::process::Command::new("sh")
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        let script = format!("printf '%s\\0' {command}");
        // The words come from a pipe, since a program's arguments are limited.
        let mut input = shell.stdin.take().unwrap();
        let writer =
            std::thread::spawn(move || std::io::Write::write_all(&mut input, script.as_bytes()));
        let out = shell.wait_with_output().unwrap();
        writer.join().unwrap().unwrap();
        let text = String::from_utf8(out.stdout).unwrap();
        text.strip_suffix('\0').unwrap().split('\0').map(str::to_owned).collect()
    }

    #[cfg(unix)]
    #[test]
    fn every_setting_survives_a_shell() {
        const SIGNS: [&str; 24] = [
            " ", "\t", "\n", "\r", "\"", "'", "\\", "$HOME", "`id`", "*", "~", "!", "#", "=", ",",
            "..", "-", "&", ";", "\u{a0}", "ä", "\u{202e}", "a", "3 cm",
        ];
        let mut state = 1_u64;
        let mut below = |most: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % most
        };
        let mut values: Vec<String> =
            (0..2000).map(|_| (0..below(6)).map(|_| SIGNS[below(24)]).collect()).collect();
        values.extend([" a ", "\"", "\"\"", "\" a \"", "''", "-x", "=ls"].map(str::to_owned));
        for name in ["mode", "world.name", "world.box.sofa.height_m"] {
            let points = values.iter().map(|text| Point { text: text.clone(), si: None }).collect();
            let axes = vec![Axis { name: name.to_owned(), points, by_seed: false }];
            let sweep = Sweep {
                axes,
                seeds: seeds("0").unwrap(),
                worlds: vec![WorldChoice::OfPlan],
                ..sweep()
            };
            let commands = (0..sweep.len()).map(|run| sweep.command(&sweep.row(run)));
            let words = in_shell(&commands.collect::<Vec<_>>().join(" "));
            let settings = words.windows(2).filter(|pair| pair[0] == "--set").map(|pair| &pair[1]);
            let read: Vec<_> =
                settings.map(|word| afp_excerpt::words::read_setting(word).unwrap()).collect();
            let meant: Vec<_> = values.iter().map(|value| (name, value.as_str())).collect();
            assert_eq!(read, meant);
        }
    }

    #[test]
    fn other_points_make_a_different_sweep() {
        let signature =
            |points: &str| Sweep { axes: vec![axis(points).unwrap()], ..sweep() }.signature();
        assert_ne!(signature("name=a b"), signature("name=a,b"));
        // Known numbers are equal in every format.
        let known = |points: &str, si: f64| {
            let mut axis = axis(points).unwrap();
            axis.points.iter_mut().for_each(|point| point.si = Some(si));
            Sweep { axes: vec![axis], ..sweep() }.signature()
        };
        assert_eq!(known("keep=30cm", 0.3), known("keep=0.3m", 0.3));
        assert_ne!(known("keep=30cm", 0.3), known("keep=30mm", 0.03));
        assert_ne!(known("n=9007199254740993", 2e53), known("n=9007199254740992", 2e53));
        assert_ne!(signature("name=p q r"), signature("name=p q,r"));
        assert_ne!(signature("name=a b,'"), signature("name=a,b '"));
        assert!(signature("name=20cm,30cm").contains("name = 20cm 30cm, "));
        let world = |name: &str| {
            let worlds = vec![WorldChoice::Named(name.to_owned())];
            Sweep { worlds, ..sweep() }.signature()
        };
        assert_ne!(world("a, world b"), world("a"));
        assert_ne!(
            world("of the plan"),
            Sweep { worlds: vec![WorldChoice::OfPlan], ..sweep() }.signature()
        );
    }

    #[test]
    fn a_run_is_a_command() {
        let sweep = sweep();
        let wanted = "afpc run 'my plan.afp' --world random:7 --seed 8 --set a=3 --set b=30cm --press touch@2s --fail wheels.slip=0.2@3s..5s --until 1.5s";
        assert_eq!(sweep.command(&sweep.row(71)), wanted);
        let changed = Sweep { caveat: Some("the plan has been changed"), ..sweep };
        let wanted = format!("{wanted}  # the plan has been changed");
        assert_eq!(changed.command(&changed.row(71)), wanted);
    }
}
