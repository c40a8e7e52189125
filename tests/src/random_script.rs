//! Random scripts for random plans: outcomes of components and stimuli, with times.

use std::fmt::Write;

use crate::random::dice::Dice;
use crate::random::{Channel, RandomPlan};

/// The length of a script in milliseconds.
const LENGTH: u64 = 200;

/// A script for a plan; equal seeds give equal scripts.
pub fn script(plan: &RandomPlan, seed: u64) -> String {
    let mut dice = Dice::new(seed);
    let mut text = format!("show names\nshow polls\nshow wakes\nuntil {LENGTH} ms\n");
    for channel in &plan.channels {
        answers(channel, &mut dice, &mut text);
        troubles(channel, &mut dice, &mut text);
    }
    outside(plan, &mut dice, &mut text);
    if dice.percent(40) {
        steps(&mut dice, &mut text);
    }
    text
}

/// A time; many are instants with several due components.
fn moment(dice: &mut Dice) -> u64 {
    match dice.percent(60) {
        true => 5 * dice.between(0, LENGTH / 5),
        false => dice.between(0, LENGTH),
    }
}

fn during(dice: &mut Dice) -> String {
    let from = moment(dice);
    match dice.percent(50) {
        true => format!("at {from} ms"),
        false => format!("from {from} ms to {} ms", from + dice.between(1, 40)),
    }
}

fn answers(channel: &Channel, dice: &mut Dice, text: &mut String) {
    let times = if channel.actor { dice.between(2, 6) } else { dice.between(0, 5) };
    for _ in 0..times {
        let (when, outcome) = (during(dice), dice.pick(channel.outcomes));
        let number = match dice.between(0, 12) {
            0..6 => String::new(),
            6 => " = 1e19".to_owned(),
            7 => " = nan".to_owned(),
            8 => " = 0".to_owned(),
            _ => format!(" = {}.5", dice.between(0, 100)),
        };
        let _ = writeln!(text, "{when}: {} {outcome}{number}", channel.name);
    }
}

fn troubles(channel: &Channel, dice: &mut Dice, text: &mut String) {
    let name = &channel.name;
    if dice.percent(25) {
        let (when, cost) = (during(dice), dice.between(1, 25));
        let _ = writeln!(text, "{when}: {name} costs {cost} ms");
    }
    if dice.percent(12) {
        let _ = writeln!(text, "{}: {name} fault", during(dice));
    }
    if dice.percent(8) {
        let _ = writeln!(text, "{}: {name} start fault", during(dice));
    }
    if channel.actor && dice.percent(20) {
        let _ = writeln!(text, "{}: {name} interrupt fault", during(dice));
    }
    for phase in ["suspend", "resume"] {
        if channel.actor && dice.percent(20) {
            let _ = writeln!(text, "{}: {name} {phase} fault", during(dice));
        }
    }
    if dice.percent(3) {
        let _ = writeln!(text, "{}: {name} panic", during(dice));
    }
}

fn outside(plan: &RandomPlan, dice: &mut Dice, text: &mut String) {
    let mut moments: Vec<u64> = (0..dice.between(0, 8)).map(|_| moment(dice)).collect();
    moments.sort_unstable();
    let values = ["true", "false", "0", "3", "-7", "0.25", "0.0", "\"5\"", "\"2 m\"", "#1", "nan"];
    for at in moments {
        let (entry, value) = (dice.pick(&plan.entries), dice.pick(&values));
        let _ = writeln!(text, "at {at} ms: write {entry} = {value}");
    }
    debugger(dice, text);
    if dice.percent(10) {
        let _ = writeln!(text, "at {} ms: stop", dice.between(LENGTH / 2, LENGTH));
    }
}

/// Holds and releases, in any order.
fn debugger(dice: &mut Dice, text: &mut String) {
    if dice.percent(50) {
        return;
    }
    let mut at = moment(dice) / 2;
    while at < LENGTH {
        let what = dice.pick(&["hold", "hold", "continue", "go to the next", "go to the next"]);
        let _ = writeln!(text, "at {at} ms: {what}");
        at += dice.pick(&[0, 1, 5, 10, 23, 40]);
    }
}

/// Steps of a driver that is late, early, stopped or goes back.
fn steps(dice: &mut Dice, text: &mut String) {
    let mut now = 0;
    text.push_str("step at");
    while now < LENGTH {
        now += dice.pick(&[0, 1, 1, 2, 3, 5, 5, 5, 10, 23]);
        let shown = if dice.percent(3) { now.saturating_sub(7) } else { now };
        let _ = write!(text, " {shown} ms");
    }
    text.push('\n');
}
