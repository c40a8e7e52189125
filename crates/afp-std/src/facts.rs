//! The implementations report what the toolbox declares of their events.

extern crate std;

use std::string::String;
use std::vec::Vec;

use afp_core::quantity::Time;
use afp_core::{Computation, Duration, Events, Instant, Supervisor, Value};
use afp_dsl::toolbox::case::value;
use afp_dsl::toolbox::{Fact, Template, Toolbox};
use afp_syntax::source::Source;

use crate::templates::{self, check_timeout, check_value, random};
use crate::{CheckTimeout, CheckValue, Random};

/// The templates with facts.
fn declared() -> Vec<Template> {
    let (toolbox, _) = Toolbox::parse(&Source::new("std.afp", templates::SOURCE), 0, "afp_std");
    let mut templates = toolbox.map(|toolbox| toolbox.templates).unwrap_or_default();
    templates.retain(|template| !template.facts.is_empty());
    templates
}

fn facts(name: &str) -> Vec<Fact> {
    let found = declared().into_iter().find(|template| template.name == name);
    found.map(|template| template.facts.to_vec()).unwrap_or_default()
}

/// Random numbers from 0 to less than 1.
fn draws() -> impl FnMut() -> f64 {
    let mut state = 20;
    move || {
        let Ok(random::State::Done { next, value }) = Random::compute(random::Inputs { state })
        else {
            return f64::NAN;
        };
        state = next;
        value
    }
}

#[test]
fn every_template_with_facts_is_sampled() {
    let names: Vec<String> = declared().into_iter().map(|template| template.name).collect();
    assert_eq!(names, ["CheckTimeout", "CheckValue"]);
}

#[test]
fn an_event_with_a_condition_is_reported_exactly_while_it_holds() {
    let (facts, mut draw) = (facts("CheckValue"), draws());
    let mut counts = [[0_u32; 2]; 2];
    for _ in 0..2000 {
        // Few values, so that some are equal.
        let mut number = || (draw() * 5.0).floor() - 2.0;
        let inputs = [number(), number()];
        let mut watch: CheckValue<f64> =
            Supervisor::start(check_value::Inputs {}, &mut (), Instant::ZERO).unwrap();
        for fact in &facts {
            let Fact::When(event, conditions) = fact else { panic!("{fact:?}") };
            let known = |port: u16| inputs.get(usize::from(port)).copied().map(Value::Float);
            let holds = conditions.iter().all(|one| one.holds(&known).unwrap());
            let live = check_value::Live { value: inputs[0], limit: inputs[1] };
            let wanted = Events::from_bits(1 << event);
            let reported = watch.poll(live, wanted, &mut (), Instant::ZERO).unwrap().is_some();
            assert_eq!(reported, holds, "{inputs:?} and event {event}");
            counts[usize::from(*event)][usize::from(holds)] += 1;
        }
    }
    assert!(counts.iter().flatten().all(|count| *count > 100), "{counts:?}");
}

#[test]
fn an_event_after_a_time_is_not_reported_before() {
    let (facts, mut draw) = (facts("CheckTimeout"), draws());
    let [Fact::After(event, time)] = facts.as_slice() else { panic!("{facts:?}") };
    let mut counts = [0_u32; 2];
    for _ in 0..200 {
        let duration = (draw() * 2000.0).floor() / 1000.0;
        let known = |port: u16| (port == 0).then_some(Value::Float(duration));
        let Some(Value::Float(time)) = value(time, &known) else { panic!("{time:?}") };
        let start = Instant::ZERO + Duration::from_millis((draw() * 1e4) as u64);
        let inputs = check_timeout::Inputs { duration: Time::from_si(duration) };
        let mut watch: CheckTimeout = Supervisor::start(inputs, &mut (), start).unwrap();
        for millis in (0..3000).step_by(50) {
            let now = start + Duration::from_millis(millis);
            let live = check_timeout::Live {};
            let reported = watch.poll(live, Events::from_bits(1 << event), &mut (), now);
            // Instants are whole nanoseconds.
            let is_over = millis as f64 / 1e3 >= time - 1e-9;
            assert!(is_over || reported.unwrap().is_none(), "{millis} ms of {time} s");
            counts[usize::from(is_over)] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 1000), "{counts:?}");
}
