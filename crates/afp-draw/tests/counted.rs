//! A measure of how clear the drawings of shipped plans and of comparable plans are: crossings,
//! bends and sides, counted.
//!
//! `AFP_BLESS=1` rewrites the table; look at the changed drawings.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use afp_draw::{Options, PlanScene, Point, Scene};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Disk;
use afp_syntax::source::Source;

const TABLE: &str = "tests/draw/counted.txt";

/// The distance between parallel lines.
const APART: f64 = 12.0;

/// Plans, with their toolboxes in the same folder.
const FOLDERS: [(&str, &str); 4] = [
    ("plans", ""),
    ("plans/parts", ""),
    ("examples/peers/plans", "examples/peers/toolboxes"),
    ("examples/vacuum/plans", "examples/vacuum"),
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The `.afp` files of a folder, by name.
fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end == "afp"));
    files.sort();
    files
}

fn source(path: &Path) -> Source {
    Source::new(path.to_string_lossy(), fs::read_to_string(path).unwrap())
}

/// The drawings of all plans, each plan once.
fn scenes() -> Vec<PlanScene> {
    let mut found: Vec<PlanScene> = Vec::new();
    for (plans, beside) in FOLDERS {
        let mut toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        if !beside.is_empty() {
            files(beside).iter().for_each(|path| _ = toolboxes.add(source(path), "beside"));
        }
        for path in files(plans) {
            let compiled =
                compile(&source(&path), &toolboxes, &Disk(path.parent().unwrap().to_owned()));
            assert!(compiled.graph.is_some(), "{}", compiled.render(false));
            let mut plans = Scene::new(&compiled.outline, &Options::default(), None).plans;
            let file = plans[0].file;
            plans.retain(|plan| plan.file == file);
            found.extend(plans);
        }
    }
    found
}

/// The counts of drawings.
#[derive(Clone, Copy, Default)]
struct Counted {
    edges: usize,
    bends: usize,
    crossings: usize,
}

impl Counted {
    fn of(plan: &PlanScene) -> Counted {
        let ways: Vec<&[Point]> = plan.edges.iter().map(|edge| &edge.points[..]).collect();
        // The common part of edges before their target counts once.
        let kinds = plan.edges.iter().map(|edge| edge.kind);
        let inner = |way: &[Point]| way.iter().skip(1).rev().skip(1).copied().collect::<Vec<_>>();
        let bends = ways.iter().zip(kinds).flat_map(|(way, kind)| {
            inner(way).into_iter().map(move |(x, y)| (kind, x.to_bits(), y.to_bits()))
        });
        let bends = bends.collect::<BTreeSet<_>>().len();
        let pairs = (0..ways.len())
            .flat_map(|first| ways[first + 1..].iter().map(move |second| (first, second)));
        let crossings = pairs.map(|(first, second)| crossings(ways[first], second)).sum();
        Counted { edges: ways.len(), bends, crossings }
    }

    fn add(&mut self, other: Counted) {
        self.edges += other.edges;
        self.bends += other.bends;
        self.crossings += other.crossings;
    }

    fn per_edge(self, count: usize) -> f64 {
        count as f64 / self.edges.max(1) as f64
    }
}

fn crossings(one: &[Point], other: &[Point]) -> usize {
    let pairs = one.windows(2).flat_map(|a| other.windows(2).map(move |b| (a, b)));
    pairs.filter(|(a, b)| cross(a, b) || cross(b, a)).count()
}

/// The number of small shifts of a line that continues in the same direction: they look like
/// errors.
fn jogs(way: &[Point]) -> usize {
    let direction = |a: Point, b: Point| ((b.0 - a.0).signum(), (b.1 - a.1).signum());
    let inner = way.windows(4).filter(|corners| {
        let [before, from, to, after] = **corners else { return false };
        let shift = (to.0 - from.0).abs() + (to.1 - from.1).abs();
        shift < APART && direction(before, from) == direction(to, after)
    });
    inner.count()
}

/// Whether a vertical line crosses a horizontal line; a line that ends on it joins it.
fn cross(upright: &[Point], level: &[Point]) -> bool {
    let between = |x: f64, a: f64, b: f64| a.min(b) + 0.5 < x && x < a.max(b) - 0.5;
    upright[0].0 == upright[1].0
        && level[0].1 == level[1].1
        && between(upright[0].0, level[0].0, level[1].0)
        && between(level[0].1, upright[0].1, upright[1].1)
}

fn line(name: &str, counted: Counted, sides: Option<(f64, f64)>) -> String {
    let Counted { edges, bends, crossings } = counted;
    let sides =
        sides.map_or(String::new(), |(width, height)| format!("{width:>8.0} x {height:.0}"));
    format!("{name:<20}{edges:>6}{bends:>6}{crossings:>10}{sides}").trim_end().to_owned() + "\n"
}

#[test]
fn drawings_stay_clear() {
    let mut all = Counted::default();
    let mut table = "plan                 edges bends crossings  sides\n".to_owned();
    for plan in scenes() {
        let counted = Counted::of(&plan);
        all.add(counted);
        let ratio = plan.bounds.width / plan.bounds.height;
        // Two elements with their supervisors have only one shape. The first of them is the start.
        // A drawing that fits on a screen is not folded.
        let free = plan.elements.len() > 3 && plan.bounds.height > 760.0;
        assert!(!free || (0.5..=2.0).contains(&ratio), "'{}': {ratio:.2}", plan.name);
        for edge in &plan.edges {
            assert_eq!(
                jogs(&edge.points),
                0,
                "'{}': {} -> {} {:?}",
                plan.name,
                edge.item,
                edge.to,
                edge.points
            );
        }
        table += &line(&plan.name, counted, Some((plan.bounds.width, plan.bounds.height)));
    }
    table += &line("all", all, None);
    let (bends, crossings) = (all.per_edge(all.bends), all.per_edge(all.crossings));
    let _ = writeln!(table, "per edge: {bends:.2} bends, {crossings:.2} crossings");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(TABLE);
    if std::env::var_os("AFP_BLESS").is_some() {
        fs::write(&path, &table).unwrap();
    }
    assert_eq!(table, fs::read_to_string(&path).unwrap());
    assert!(bends < 2.1 && crossings < 0.4, "{table}");
}
