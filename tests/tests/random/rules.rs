//! The rules that a sample of traces exercised.

use std::collections::BTreeMap;

type Rule = (&'static str, fn(&[String]) -> bool);

const RULES: &[Rule] = &[
    ("an event is taken", |trace| any(trace, |line| line.contains(" event "))),
    ("an event in the look diverts", |trace| any(trace, |line| line.contains(" diverted by "))),
    ("an event leads where the plan already is", |trace| {
        any(trace, |line| line.contains(" already there: "))
    }),
    ("a local event restarts its actor", |trace| any(trace, restarts)),
    ("two supervisors have events at one instant", two_events),
    ("a deadline is missed by a long poll", |trace| any(trace, |line| line.contains("(long poll"))),
    ("a deadline is missed by a late release", |trace| {
        any(trace, |line| line.ends_with("(late release, 0 skipped)"))
    }),
    ("releases are skipped", |trace| {
        any(trace, |line| line.contains(" missed ") && !line.ends_with(" 0 skipped)"))
    }),
    ("'DeadlineMissed' is taken", |trace| any(trace, |line| line.contains("event DeadlineMissed"))),
    ("the look misses its deadline", look_misses),
    ("an actor fails to start", |trace| any(trace, |line| line.ends_with("[stop]"))),
    ("an 'Error' edge is taken", |trace| {
        any(trace, |line| line.contains(" fault ") && line.contains(" -> "))
    }),
    ("a supervisor fails", |trace| any(trace, |line| line.contains("polled: fault "))),
    ("a fault ends a plan", |trace| any(trace, |line| line.contains(" ended Error("))),
    ("a plan fails for a reason of its own", |trace| {
        any(trace, |line| line.contains(" ended Error(failed: "))
    }),
    ("an event resumes", |trace| any(trace, |line| line.contains(" -> resume"))),
    ("computations resume", |trace| {
        any(trace, |line| line.contains("link finished Again -> resume"))
    }),
    ("computations lead elsewhere", |trace| {
        any(trace, |line| line.contains("link finished Done -> "))
    }),
    ("an element is suspended", |trace| any(trace, |line| line.contains(" suspended by "))),
    ("an element is suspended before its start", |trace| {
        any(trace, |line| line.ends_with(" before its start"))
    }),
    ("computations suspend", |trace| {
        any(trace, |line| line.contains("link finished Again -> suspend"))
    }),
    ("a missed deadline suspends", |trace| {
        any(trace, |line| line.contains("event DeadlineMissed -> suspend"))
    }),
    ("an event suspends in the look of a return", suspends_again),
    ("an element returns", |trace| any(trace, |line| line.contains(" returned after "))),
    ("computations return", |trace| {
        any(trace, |line| line.contains("home finished Again -> return"))
    }),
    ("an event returns", |trace| {
        any(trace, |line| line.contains(" event ") && line.ends_with(" -> return"))
    }),
    ("a sub-plan returns with its active element", returns_inside),
    ("a supervisor continues", |trace| {
        any(trace, |line| line.contains(" returned after ") && is_supervisor(line))
    }),
    ("an element is abandoned", |trace| any(trace, |line| line.contains(" abandoned"))),
    ("an actor cannot be suspended", |trace| fails_after(trace, "[suspend ")),
    ("an actor cannot resume", |trace| fails_after(trace, "[resume ")),
    ("a formula has no value", |trace| any(trace, |line| line.contains(" fault arithmetic"))),
    ("a value is out of range", |trace| any(trace, |line| line.contains(" fault range"))),
    ("a text does not convert", |trace| any(trace, |line| line.contains(" fault conversion"))),
    ("a text is too long", |trace| any(trace, |line| line.contains(" fault too-long"))),
    ("a computation fails", |trace| any(trace, |line| line.contains(" fault no-such-way"))),
    ("a failed interrupt or a panic stops all", |trace| {
        any(trace, |line| line == "[emergency stop]")
            && !any(trace, |line| line.contains(" fault livelock"))
    }),
    ("a livelock", |trace| any(trace, |line| line.contains(" fault livelock"))),
    ("a sub-plan ends 'OK'", |trace| any(trace, |line| line.contains(" finished OK"))),
    ("a sub-plan ends 'Interrupted'", |trace| {
        any(trace, |line| line.contains(" finished Interrupted"))
    }),
    ("a sub-plan ends in 'Error'", |trace| {
        any(trace, |line| line.contains(" ended Error(") && !line.contains(" Plan0 "))
    }),
    ("an outer event interrupts what runs inside", interrupts_inside),
    ("plans stand in plans in plans", |trace| any(trace, |line| depth(line) >= 3)),
    ("a sub-plan commits its results", commits_results),
    ("a loop of computations", |trace| any(trace, |line| line.contains(" finished Again"))),
    ("a row of a table is read", |trace| any(trace, |line| line.contains(" finished Row -> "))),
    ("an index is behind the last row", |trace| {
        any(trace, |line| line.contains(" finished End -> "))
    }),
    ("an object is committed", |trace| any(trace, |line| line.contains("-> Map#"))),
    ("a write from outside", |trace| any(trace, |line| line.contains(" outside commits "))),
    ("a write is refused", |trace| any(trace, |line| line.contains(" refused: "))),
    ("a write is out of its entry's range", |trace| {
        any(trace, |line| line.contains(" out of the entry's range]"))
    }),
    ("an active actor is held", |trace| any(trace, |line| line.ends_with(" held"))),
    ("the plan is held between two elements", |trace| {
        any(trace, |line| line.ends_with(" held before its start"))
    }),
    ("a held plan continues", |trace| any(trace, |line| line.ends_with(" released"))),
    ("a stop request ends a held plan", |trace| {
        ends_a_hold(trace, |line| line.ends_with(" stop requested"))
    }),
    ("a stop request", |trace| any(trace, |line| line.ends_with(" stop requested"))),
    ("the clock goes back", |trace| any(trace, |line| line.contains("clock went back"))),
    ("the run ends 'OK'", |trace| any(trace, |line| line.ends_with("Plan0 ended OK"))),
    ("the run ends 'Interrupted'", |trace| {
        any(trace, |line| line.ends_with("Plan0 ended Interrupted"))
    }),
    ("the run goes on to the end", |trace| !any(trace, |line| line.contains(" Plan0 ended "))),
];

/// The number of traces for each rule.
#[derive(Debug, Default)]
pub struct Exercised {
    traces: usize,
    counts: BTreeMap<&'static str, usize>,
}

impl Exercised {
    pub fn count(&mut self, trace: &[String]) {
        self.traces += 1;
        for (rule, shows) in RULES {
            *self.counts.entry(rule).or_default() += usize::from(shows(trace));
        }
    }

    /// A line for each rule.
    pub fn print(&self) {
        println!("rules exercised by {} runs:", self.traces);
        for (rule, _) in RULES {
            println!("  {:5}  {rule}", self.counts.get(rule).unwrap_or(&0));
        }
    }

    /// The rules that no trace exercised.
    pub fn missing(&self) -> Vec<&'static str> {
        let names = RULES.iter().map(|(rule, _)| *rule);
        names.filter(|rule| self.counts.get(rule).is_none_or(|count| *count == 0)).collect()
    }
}

fn any(trace: &[String], shows: impl Fn(&str) -> bool) -> bool {
    trace.iter().any(|line| shows(line))
}

/// Whether a held plan ends, with such a line before.
fn ends_a_hold(trace: &[String], why: impl Fn(&str) -> bool) -> bool {
    let mut held = false;
    trace.windows(2).any(|lines| {
        held |= lines[0].contains(" held");
        held &= !lines[0].ends_with(" released");
        let ends = lines[1].ends_with(" abandoned") || lines[1].contains(" ended ");
        held && ends && why(&lines[0])
    })
}

/// Time, component and the rest of a line.
fn parts(line: &str) -> Option<(&str, &str, &str)> {
    let (time, rest) = line.split_once(' ')?;
    let (component, rest) = rest.split_once(' ')?;
    Some((time, component, rest))
}

/// The nesting depth of a line's component, 0 for the outermost plan.
fn depth(line: &str) -> usize {
    let element = parts(line).filter(|(_, _, rest)| *rest == "interrupted" || *rest == "started");
    element.map_or(0, |(_, component, _)| component.matches('.').count())
}

/// `e1.w0 event E -> e1`
fn restarts(line: &str) -> bool {
    let Some((_, component, rest)) = parts(line) else { return false };
    let Some((owner, _)) = component.rsplit_once('.') else { return false };
    let element = owner.rsplit('.').next().unwrap_or(owner);
    rest.starts_with("event ")
        && rest.ends_with(&format!("-> {element}"))
        && component.rsplit('.').next().is_some_and(|name| name.starts_with('w'))
}

/// The verdict of a poll, if it is an event.
fn seen(line: &str) -> Option<&str> {
    let (time, _, rest) = parts(line)?;
    let verdict = rest.strip_prefix("polled: ")?;
    (verdict != "clear" && !verdict.starts_with("fault")).then_some(time)
}

fn two_events(trace: &[String]) -> bool {
    let times: Vec<&str> = trace.iter().filter_map(|line| seen(line)).collect();
    times.windows(2).any(|pair| pair[0] == pair[1])
}

fn look_misses(trace: &[String]) -> bool {
    trace.windows(2).any(|lines| lines[0].contains(" missed ") && lines[1].ends_with(" started"))
}

fn interrupts_inside(trace: &[String]) -> bool {
    trace.windows(2).any(|lines| depth(&lines[0]) > depth(&lines[1]) && both_interrupted(lines))
}

fn both_interrupted(lines: &[String]) -> bool {
    lines.iter().all(|line| line.ends_with(" interrupted") && !line.contains('['))
}

/// A handler returns, and the next handler starts although nothing was suspended in between.
fn suspends_again(trace: &[String]) -> bool {
    let at = |line: &String| line.split(' ').next().map(str::to_owned);
    trace.iter().enumerate().any(|(index, line)| {
        let rest = trace[index..].iter().skip(1).take_while(|next| at(next) == at(line));
        let mut rest = rest.take_while(|next| {
            ![" returned ", " suspended ", " diverted "].iter().any(|word| next.contains(word))
        });
        line.ends_with(" -> return") && rest.any(|next| next.contains(" -> suspend "))
    })
}

fn returns_inside(trace: &[String]) -> bool {
    let of = |line: &str| {
        let (_, component, rest) = parts(line)?;
        rest.starts_with("returned after ").then(|| component.to_owned())
    };
    let is_inside = |outer: &str, inner: &str| {
        let rest = inner.strip_prefix(outer).and_then(|rest| rest.strip_prefix('.'));
        rest.is_some_and(|rest| rest.starts_with(['e', 'h']))
    };
    trace.iter().enumerate().any(|(index, line)| {
        let Some(outer) = of(line) else { return false };
        trace[index..].iter().filter_map(|line| of(line)).any(|inner| is_inside(&outer, &inner))
    })
}

fn is_supervisor(line: &str) -> bool {
    let name = parts(line).and_then(|(_, component, _)| component.rsplit('.').next());
    name.is_some_and(|name| name.starts_with(['g', 'w']))
}

/// A call of an actor that the next line reports as failed.
fn fails_after(trace: &[String], call: &str) -> bool {
    let failed = |line: &str| line.contains(" fault scripted");
    trace.windows(2).any(|lines| lines[0].contains(call) && failed(&lines[1]))
}

/// `e3 finished OK ...`, then `e3 commits ...`.
fn commits_results(trace: &[String]) -> bool {
    trace.windows(2).any(|lines| {
        let (Some((_, ended, how)), Some((_, author, what))) = (parts(&lines[0]), parts(&lines[1]))
        else {
            return false;
        };
        let sub_plan = how.starts_with("finished OK") || how.starts_with("finished Interrupted");
        sub_plan && ended == author && what.starts_with("commits ")
    })
}
