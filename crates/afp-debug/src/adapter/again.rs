//! The command that repeats a run without a debugger.

use afp_core::{Duration, Instant};
use afp_dsl::types::text::duration;
use afp_excerpt::words::{shell_file, shell_setting, shell_word};
use afp_session::{DEFAULT_UNTIL, HOLD, NameWithUnit, Stimulus};

use super::Launch;
use super::mode::By;
use crate::target::Target;

/// Returns the command. It is `None` if some input has no option: a value written or forced during
/// the run, a move in the world, or a button held for an unknown time.
pub(super) fn command(launch: &Launch, target: &dyn Target, by: &By) -> Option<String> {
    if target.is_live() || launch.is_fork {
        // The log of a robot's run repeats it. No option continues a log.
        return None;
    }
    if let Some(log) = &launch.log {
        return Some(format!("afpc run --again {}", shell_file(log)));
    }
    let mut command = format!("afpc run {}", shell_file(&launch.program));
    let mut add = |option: &str, word: &str| command.extend([" ", option, " ", word]);
    if let Some(world) = &launch.world {
        add("--world", &shell_file(world));
    }
    if let Some([x, y, heading]) = launch.start {
        add("--start", &format!("{x}m,{y}m,{heading}rad"));
    }
    if let Some(seed) = launch.seed.filter(|seed| *seed != 0) {
        add("--seed", &seed.to_string());
    }
    for (entry, text) in &launch.set {
        add("--set", &shell_setting(entry, text));
    }
    let ended = target.now().as_secs_f64();
    match (by, launch.until) {
        (By::Client(_), _) if target.state().ended_by().is_none() => {
            add("--until", &format!("{ended}s"));
        }
        (_, Some(until)) => add("--until", &format!("{until}s")),
        (_, None) if ended >= DEFAULT_UNTIL.as_secs_f64() => {
            add("--until", &format!("{}s", ended.floor() + 1.0))
        }
        _ => {}
    }
    // Values set before the start are the first requests.
    let requests = target.requests();
    let requests = requests.get(launch.set.len()..)?;
    for (option, value) in options(requests, target.now())? {
        add(option, &shell_word(&value));
    }
    Some(command)
}

/// Converts the inputs up to the end to options.
fn options(
    requests: &[(Instant, Stimulus)],
    ended: Instant,
) -> Option<Vec<(&'static str, String)>> {
    let mut options = Vec::new();
    for (at, what) in requests {
        let press = |control| ("--press", format!("{control}@{}", second(*at)));
        options.push(match what {
            Stimulus::Hold(control, HOLD) => press(control),
            // The plan ended before the end of the press, so its length has no effect.
            Stimulus::Press(control, true) if ended <= *at + HOLD => press(control),
            Stimulus::Break(NameWithUnit { name, unit }, amount, lasting) => {
                let amount = match amount {
                    Some(amount) => format!("={amount}{unit}"),
                    None => String::new(),
                };
                let to = match *lasting {
                    Duration::MAX => String::new(),
                    lasting => format!("..{}", second(*at + lasting)),
                };
                ("--fail", format!("{name}{amount}@{}{to}", second(*at)))
            }
            _ => return None,
        });
    }
    Some(options)
}

/// An exact instant in command-line format.
fn second(at: Instant) -> String {
    duration(at.as_nanos()).replace(' ', "")
}
