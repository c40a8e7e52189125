//! The cost of checking a plan with index and outline, by plan size and compared with the lexer.

use std::hint::black_box;

use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_syntax::count_tokens;
use afp_syntax::source::Source;

use crate::big_plan;
use crate::measure::{Race, Times};
use crate::report::{Report, Row};

/// A turn takes about as long as a thousand turns of the shortest cases.
const ROUNDS: u32 = 25;

/// Races checks of a thousand and of ten thousand actors with the lexer.
pub fn run(rounds: u32, report: &mut Report) {
    let toolboxes = toolboxes();
    let (small, large) = (big_plan::text(1_000), big_plan::text(10_000));
    let changed = small.replacen("30 cm", "31 cm", 1);
    let megabytes = large.len() as f64 / 1e6;
    let mut race = Race::default();
    race.add("1,000 actors", checks(&toolboxes, vec![small.clone()]));
    race.add("10,000 actors", checks(&toolboxes, vec![large.clone()]));
    race.add("tokens of 10,000 actors", |count| {
        for _ in 0..count {
            black_box(count_tokens(black_box(&large)));
        }
    });
    race.add("1,000 actors, a character changed", checks(&toolboxes, vec![changed, small]));
    let plan = big_plan::text(60);
    let edited = plan.replacen("30 cm", "31 cm", 1);
    race.add("60 actors, a character changed", checks(&toolboxes, vec![edited, plan]));
    let times = race.run(rounds.div_ceil(ROUNDS));
    let [small, large, tokens, again, edited] = times.as_slice() else { return };
    report.add(Row::new("check/text of 10,000 actors", megabytes, "MB"));
    report.add(milliseconds(small));
    // A plan of a thousand actors fits into the caches, one of ten thousand does not.
    report.add(against(large, small, 14.0));
    report.add(milliseconds(tokens));
    // Both grow with the text; this limit checks that the check does not grow faster.
    report.add(against(large, tokens, 24.0));
    let within = again.median < 15e6 || again.ratio(small) <= 1.0 / 3.0;
    report.add(
        milliseconds(again)
            .against("check/1,000 actors", again.ratio(small))
            .limit("<= 0.33 or < 15 ms", within),
    );
    // Diagnostics, index and outline: an editor waits for these after each key.
    report.add(milliseconds(edited).limit("< 3 ms", edited.median < 3e6));
}

/// Checks the texts in turn; each must be a valid plan.
fn checks(toolboxes: &Toolboxes, texts: Vec<String>) -> impl FnMut(u64) {
    let sources: Vec<_> = texts.into_iter().map(|text| Source::new("big.afp", text)).collect();
    let mut next = 0;
    move |count| {
        for _ in 0..count {
            let compiled = compile(black_box(&sources[next]), toolboxes, &Texts::default());
            assert!(compiled.graph.is_some(), "{}", compiled.render(false));
            black_box(&compiled);
            next = (next + 1) % sources.len();
        }
    }
}

fn toolboxes() -> Toolboxes {
    afp_toolboxes::sources().collect()
}

fn milliseconds(case: &Times) -> Row {
    Row::new(format!("check/{}", case.name), case.median / 1e6, "ms")
}

fn against(case: &Times, baseline: &Times, at_most: f64) -> Row {
    let ratio = case.ratio(baseline);
    milliseconds(case)
        .against(format!("check/{}", baseline.name), ratio)
        .limit(format!("<= {at_most}"), ratio <= at_most)
}
