//! The cost of drawing a plan: layout, routes and picture, compared with GraphViz's `dot` for the
//! same plan.

use std::hint::black_box;
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use afp_draw::layout_file::{Layout, Position};
use afp_draw::{Options, Scene, dot, svg};
use afp_dsl::Toolboxes;
use afp_dsl::files::Texts;
use afp_dsl::{Compiled, compile};
use afp_syntax::source::Source;

use crate::big_plan;
use crate::report::{Report, Row};

/// A plan with a number of actors, named by `kind`, and the limit for its drawing in milliseconds.
struct Case {
    kind: &'static str,
    text: fn(usize) -> String,
    actors: usize,
    limit: Option<f64>,
}

/// Realistic plans, and plans with random edges.
const CASES: [Case; 6] = [
    Case { kind: "actors", text: big_plan::text, actors: 60, limit: Some(80.0) },
    Case { kind: "actors", text: big_plan::text, actors: 200, limit: None },
    Case { kind: "actors", text: big_plan::text, actors: 1_000, limit: None },
    Case { kind: "at random", text: big_plan::random, actors: 60, limit: None },
    Case { kind: "at random", text: big_plan::random, actors: 200, limit: None },
    Case { kind: "at random", text: big_plan::random, actors: 1_000, limit: Some(10_000.0) },
];

/// The limit for moving a box of the smallest plan, in milliseconds.
const MOVED: f64 = 5.0;

/// The time limit of `dot`, at least twice AFP's own time; a plan of 200 actors takes minutes.
const PATIENCE: Duration = Duration::from_secs(5);

/// The number of drawings of a case, if time permits; the best one counts.
const TURNS: u32 = 5;
const ENOUGH: Duration = Duration::from_secs(5);

/// Draws plans of several sizes, and moves a box.
pub fn run(_: u32, report: &mut Report) {
    for Case { kind, text, actors, limit } in CASES {
        let compiled = compiled(text(actors));
        let options = Options::default();
        let own = best(|| {
            black_box(svg(black_box(&compiled.outline), &options));
        });
        let name = format!("drawing/{actors} {kind}");
        let row = Row::new(&name, own, "ms");
        report.add(match limit {
            Some(most) => row.limit(format!("<= {most} ms"), own <= most),
            None => row,
        });
        let patience = PATIENCE.max(Duration::from_secs_f64(2.0 * own / 1e3));
        if let Some(peer) = dot_time(&dot(&compiled.outline, &options), patience) {
            let ratio = own / peer;
            let row = Row::new(format!("{name}, dot"), peer, "ms");
            report.add(row.against(name, ratio).limit("<= 1", ratio <= 1.0));
        }
    }
    let moved = moved(&compiled(big_plan::text(60)));
    let row = Row::new("drawing/60 actors, one box moved", moved, "ms");
    report.add(row.limit(format!("<= {MOVED} ms"), moved <= MOVED));
}

fn compiled(text: String) -> Compiled {
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let source = Source::new("big.afp", text);
    compile(&source, &toolboxes, &Texts::default())
}

/// The time of a new scene after a drag of one box.
fn moved(compiled: &Compiled) -> f64 {
    let before = Scene::new(&compiled.outline, &Options::default(), None);
    let Some(element) = before.plans.first().and_then(|plan| plan.elements.get(30)) else {
        return f64::INFINITY;
    };
    let mut layout = Layout::default();
    let position = Position { x: element.rect.x as i32 + 36, y: element.rect.y as i32 + 12 };
    layout.set(element.item.clone(), position);
    let positions = vec![layout; compiled.sources.len()];
    let options = Options { positions: &positions, ..Options::default() };
    best(|| {
        black_box(Scene::new(&compiled.outline, &options, Some(&before)));
    })
}

/// The best of several turns, in milliseconds.
fn best(mut run: impl FnMut()) -> f64 {
    let began = Instant::now();
    let mut best = f64::INFINITY;
    for _ in 0..TURNS {
        let start = Instant::now();
        run();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        if began.elapsed() > ENOUGH {
            break;
        }
    }
    best
}

/// The time of `dot` for a graph in milliseconds, up to the limit; `None` if it is not installed.
fn dot_time(graph: &str, patience: Duration) -> Option<f64> {
    let start = Instant::now();
    let quiet =
        Command::new("dot").arg("-Tsvg").stdin(Stdio::piped()).stdout(Stdio::null()).spawn();
    let Ok(mut peer) = quiet else {
        eprintln!("drawing: the comparison is skipped, because 'dot' is not installed");
        return None;
    };
    peer.stdin.take()?.write_all(graph.as_bytes()).ok()?;
    loop {
        if peer.try_wait().ok()?.is_some() {
            break;
        }
        if start.elapsed() > patience {
            eprintln!("drawing: 'dot' was given up after {:.0} s", patience.as_secs_f64());
            // It may have ended already.
            let _ = peer.kill();
            let _ = peer.wait();
            break;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    Some(start.elapsed().as_secs_f64() * 1e3)
}
