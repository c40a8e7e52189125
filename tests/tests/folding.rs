//! The compiler and the run time compute the same values of formulas.

use afp_core::trace::{Ending, NoTrace};
use afp_core::{Instant, Scheduler, StillClock, Value, Wake};
use afp_tests::interpret::{graph, load};
use afp_tests::platform::{CostClock, Log, Platform};
use afp_tests::script::Script;

/// A formula over literals, and the same over entries unknown to the compiler.
struct Random {
    state: u64,
    entries: String,
    count: u32,
}

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.state >> 33) as usize % end
    }

    fn pick(&mut self, from: &[&'static str]) -> &'static str {
        from[self.below(from.len())]
    }

    fn leaf(&mut self, ty: &str) -> (String, String) {
        let literal = match ty {
            "int" => self.pick(&["0", "1", "2", "7", "3037000500", "9223372036854775807"]),
            _ => self.pick(&["0.0", "0.1", "3.0", "1e308", "2.5e-300", "-7.5", "1e19"]),
        };
        let name = format!("e{}", self.count);
        self.count += 1;
        self.entries += &format!("    in {name}: {ty} = {literal}\n");
        (format!("({literal})"), name)
    }

    fn formula(&mut self, ty: &str, depth: u32) -> (String, String) {
        if depth == 0 || self.below(8) == 0 {
            return self.leaf(ty);
        }
        let operators: &[_] = if ty == "int" {
            &["+", "-", "*", "%", "min"]
        } else {
            &["+", "-", "*", "/", "%", "min", "max"]
        };
        let operator = self.pick(operators);
        let inner = if ty == "float" && self.below(3) == 0 { "int" } else { ty };
        let (a, b) = (self.formula(inner, depth - 1), self.formula(ty, depth - 1));
        let sign = self.pick(&["", "-"]);
        let joined = |a: &str, b: &str| match operator {
            "min" | "max" => format!("{sign}{operator}({a}, {b})"),
            _ => format!("{sign}({a} {operator} {b})"),
        };
        (joined(&a.0, &b.0), joined(&a.1, &b.1))
    }
}

fn plan(entries: &str) -> String {
    let actor = "    actor a: Task(name = \"a\") { Done -> a }";
    format!("use testing\n\nplan P {{\n    start a\n{entries}{actor}\n}}\n")
}

/// The value of `x`, or `None` if the plan cannot begin.
fn run(text: &str) -> Option<Value> {
    let graph = graph("run", text).unwrap_or_else(|errors| panic!("{errors}"));
    let mut scheduler = Scheduler::new(load(&graph));
    let mut platform = Platform::new(Script::default(), Log::default(), CostClock::default());
    let wake = scheduler.start((&mut platform, &mut NoTrace, &StillClock), Instant::ZERO);
    match wake.expect("nothing is missing") {
        Wake::At(_) => Some(
            scheduler
                .plan()
                .get("x")
                .expect("there is an x")
                .to_value()
                .expect("a value of an entry fits"),
        ),
        Wake::Ended(ending) => {
            assert!(matches!(ending, Ending::Error(_)), "{ending:?}");
            None
        }
        Wake::NotStarted => panic!("it has been started"),
    }
}

#[test]
fn constant_folding_equals_evaluation() {
    let (mut valued, mut failed, mut divided) = (0, 0, 0);
    for seed in 0..250 {
        let mut random = Random { state: seed, entries: String::new(), count: 0 };
        for _ in 0..3 {
            random.below(1);
        }
        let ty = random.pick(&["int", "float"]);
        let (literals, names) = random.formula(ty, 3);
        let entries = format!("{}    var x: {ty} = {names}\n", random.entries);
        let ran = run(&plan(&entries));
        match (graph("fold", &plan(&format!("    const x: {ty} = {literals}\n"))), ran) {
            (Err(errors), None) if errors.contains("a division by zero") => divided += 1,
            (Err(_), None) => failed += 1,
            (Ok(_), Some(value)) => {
                valued += 1;
                let divide = if ty == "int" { "%" } else { "/" };
                let value = match value {
                    Value::Int(value) => format!("({value})"),
                    value => format!(
                        "({})",
                        format!("{value:?}").trim_start_matches("Float(").trim_end_matches(')')
                    ),
                };
                let text = format!("    const y = 1 {divide} ({literals} - {value})\n");
                let errors = graph("zero", &plan(&text)).expect_err("it divides by zero");
                assert!(errors.contains("a division by zero"), "{text}{errors}");
            }
            (folded, ran) => {
                panic!("{ty} {literals}: folded {:?}, ran {ran:?}", folded.map(|_| "a value"));
            }
        }
    }
    assert!(valued > 100 && failed > 20 && divided > 20, "{valued} {failed} {divided}");
}

#[test]
fn strings_are_parsed_alike() {
    let units =
        ["3 km/h", "0.03 min", "1.5 m", "90 deg", "- 2 cm", "20 degC", "5", "x", "2 m*s^-1", "1 h"];
    let types = ["speed", "duration", "length", "angle", "temperature", "float", "int"];
    for text in units.into_iter().chain([" 7 ", "1.0", "1e3", ""]) {
        for ty in types {
            let folded = graph("fold", &plan(&format!("    const x: {ty} = \"{text}\"\n")));
            let entries = format!("    in t: string = \"{text}\"\n    var x: {ty} = t\n");
            let ran = run(&plan(&entries));
            assert_eq!(folded.is_ok(), ran.is_some(), "{text} as {ty}");
        }
    }
}

#[test]
fn a_string_equals_its_literal() {
    for hundredths in (0..600).step_by(7) {
        let text = format!("{}.{:02} min", hundredths / 100, hundredths % 100);
        let read = format!("    in t: string = \"{text}\"\n    var x: duration = t\n");
        let written = format!("    var x: duration = {text}\n");
        assert_eq!(run(&plan(&read)), run(&plan(&written)), "{text}");
    }
}
