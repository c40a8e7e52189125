//! Parses scripts line by line.

use std::fmt;
use std::str::FromStr;

use afp_core::{Duration, Instant, Release, Text, Value};

use super::{Act, Outside, Phase, Script, Signal};

/// An unknown line of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptError(String);

impl fmt::Display for ScriptError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the script says '{}'", self.0)
    }
}

impl std::error::Error for ScriptError {}

impl FromStr for Script {
    type Err = ScriptError;

    fn from_str(text: &str) -> Result<Self, ScriptError> {
        let mut script = Script::default();
        for line in text.lines().map(str::trim).filter(|line| !line.is_empty()) {
            read_line(&mut script, line).ok_or_else(|| ScriptError(line.to_owned()))?;
        }
        Ok(script)
    }
}

fn read_line(script: &mut Script, line: &str) -> Option<()> {
    if let Some((when, what)) = line.split_once(": ") {
        return read_happening(script, when, what);
    }
    match line.split_once(' ')? {
        ("show", "polls") => script.show_polls = true,
        ("show", "wakes") => script.show_wakes = true,
        ("show", "names") => script.show_names = true,
        ("show", "nothing") => script.show_nothing = true,
        ("show", what) => script.show_last = Some(what.strip_prefix("last ")?.parse().ok()?),
        ("until", time) => script.until = instant(time)?,
        ("set", assignment) => script.inputs.push(read_assignment(assignment)?),
        ("step", times) => {
            let words: Vec<&str> = times.strip_prefix("at ")?.split(' ').collect();
            let steps = words.chunks(2).map(|time| instant(&time.join(" ")));
            script.steps = Some(steps.collect::<Option<_>>()?);
        }
        _ => return None,
    }
    Some(())
}

fn read_happening(script: &mut Script, when: &str, what: &str) -> Option<()> {
    let during = match when.split_once(' ') {
        None if when == "always" => Instant::ZERO..Instant::MAX,
        Some(("at", time)) => instant(time)?..instant(time)? + Duration::from_millis(1),
        Some(("from", times)) => {
            let (from, to) = times.split_once(" to ")?;
            instant(from)?..instant(to)?
        }
        _ => return None,
    };
    match what.split_once(' ') {
        _ if let Some(steers) = read_steering(what) => script.outside.push((during.start, steers)),
        Some(("write", assignment)) => {
            let (entry, value) = read_assignment(assignment)?;
            script.outside.push((during.start, Outside::Write(entry, value)));
        }
        Some((channel, act)) => {
            let (phase, act) = read_act(act)?;
            script.signals.push(Signal { channel: channel.to_owned(), phase, during, act });
        }
        None => return None,
    }
    Some(())
}

fn read_steering(text: &str) -> Option<Outside> {
    Some(match text {
        "stop" => Outside::Stop,
        "hold" => Outside::Hold,
        "continue" => Outside::Release(Release::Continue),
        "go to the next" => Outside::Release(Release::Step),
        _ => return None,
    })
}

fn read_act(text: &str) -> Option<(Phase, Act)> {
    let (phase, text) = match text.split_once(' ') {
        Some(("start", rest)) => (Phase::Start, rest),
        Some(("suspend", rest)) => (Phase::Suspend, rest),
        Some(("resume", rest)) => (Phase::Resume, rest),
        Some(("interrupt", rest)) => (Phase::Interrupt, rest),
        _ => (Phase::Poll, text),
    };
    let act = match text.split_once(' ') {
        None if text == "fault" => Act::Fault,
        None if text == "panic" => Act::Panic,
        None => Act::Outcome(text.to_owned(), None),
        Some(("costs", time)) => Act::Cost(duration(time)?),
        Some((outcome, number)) => {
            let number = number.strip_prefix("= ")?.parse().ok()?;
            Act::Outcome(outcome.to_owned(), Some(number))
        }
    };
    Some((phase, act))
}

fn read_assignment(text: &str) -> Option<(String, Value)> {
    let (entry, value) = text.split_once(" = ")?;
    Some((entry.to_owned(), read_value(value)?))
}

/// `true`, `3`, `0.5` (SI), `"text"`, `#1` (a choice by position).
fn read_value(text: &str) -> Option<Value> {
    if let Some(text) = text.strip_prefix('"') {
        return Some(Value::Text(Text::try_from(text.strip_suffix('"')?).ok()?));
    }
    if let Some(choice) = text.strip_prefix('#') {
        return Some(Value::Choice(choice.parse().ok()?));
    }
    let truth = text.parse().map(Value::Bool).ok();
    truth
        .or_else(|| text.parse().map(Value::Int).ok())
        .or_else(|| text.parse().map(Value::Float).ok())
}

fn instant(text: &str) -> Option<Instant> {
    Some(Instant::ZERO + duration(text)?)
}

fn duration(text: &str) -> Option<Duration> {
    let (number, unit) = text.split_once(' ')?;
    let number = number.parse().ok()?;
    match unit {
        "ms" => Some(Duration::from_millis(number)),
        "us" => Some(Duration::from_micros(number)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_of_line_is_read() {
        let script: Script = "set x = 2.5
            at 10 ms: g First = 7
            from 1 ms to 2 ms: a start fault
            always: g costs 6 us
            at 15 ms: write x = \"a b\"
            at 20 ms: stop
            at 21 ms: hold
            at 22 ms: go to the next
            step at 10 ms 13 us
            show polls
            until 100 ms"
            .parse()
            .unwrap();
        assert_eq!(script.inputs, [("x".to_owned(), Value::Float(2.5))]);
        assert_eq!(script.signals.len(), 3);
        assert_eq!(script.signals[1].phase, Phase::Start);
        assert_eq!((script.outside.len(), script.show_polls), (4, true));
        assert_eq!(script.steps.unwrap()[1].as_nanos(), 13_000);
    }

    #[test]
    fn an_unknown_line_is_an_error() {
        for line in ["at 10: g First", "sometimes: g First", "write x = 3", "at 1 ms: g"] {
            assert_eq!(line.parse::<Script>().err(), Some(ScriptError(line.to_owned())));
        }
    }
}
