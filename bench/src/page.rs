//! The results as a page of the book, with the machine and the versions of the peers.

use std::fmt::Write;
use std::fs;
use std::process::Command;

use crate::report::{Report, Row};

/// The page, from the folder of the workspace.
pub const PATH: &str = "docs/results.md";

const HEAD: &str = "\
# Results

The project's benchmarks measure the cost of plans, logs, checks and editors. Their command writes
this page; no number here is written by hand.

- All cases of a group take turns in one process. A time is the median of the turns.
- A ratio is the median of the ratios in the same turn, so another program on the machine hardly
  changes it. Compare ratios between machines, not times.
- The limit belongs to the ratio, or to the value if there is no ratio. `cargo xtask bench --check`
  fails if a result exceeds its limit.

To repeat the measurement and to write the page again:

```console
$ cargo xtask bench --page
```

The peers `dot` and `cu29` are skipped if they are not installed or cannot be built.
";

/// Packages that the results depend on, with their lock files.
const PEERS: [(&str, &str); 3] = [
    ("bonsai-bt", include_str!("../../Cargo.lock")),
    ("rapier2d", include_str!("../../Cargo.lock")),
    ("cu29", include_str!("../copper/Cargo.lock")),
];

/// The state of the machine before the first case.
pub struct Machine {
    load: String,
}

impl Machine {
    pub fn now() -> Self {
        let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
        Machine { load: load.split(' ').next().unwrap_or_default().to_owned() }
    }
}

/// The whole page.
pub fn text(machine: &Machine, report: &Report) -> String {
    let mut text = HEAD.to_owned();
    text += "\n## Machine and versions\n\n| | |\n|---|---|\n";
    let cores = std::thread::available_parallelism().map_or(0, usize::from);
    let facts = [
        ("processor", processor()),
        ("cores", cores.to_string()),
        ("processes of other programs before the run", machine.load.clone()),
        ("Rust", version("rustc", "--version")),
        ("GraphViz", version("dot", "-V")),
    ];
    let peers = PEERS.map(|(name, lock)| (name, locked(name, lock)));
    for (name, value) in facts.into_iter().chain(peers) {
        let value = if value.is_empty() { "unknown" } else { &value };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {name} | {value} |");
    }
    let mut group = "";
    for row in &report.rows {
        let (of, name) = row.name.split_once('/').unwrap_or(("", &row.name));
        if of != group {
            group = of;
            let _ = writeln!(text, "\n## {}\n", capital(of));
            text += "| case | value | ratio | to | limit |\n|---|---|---|---|---|\n";
        }
        text += &line(name, row);
    }
    text
}

fn line(name: &str, row: &Row) -> String {
    let ratio = row.ratio.map_or(String::new(), |ratio| format!("{ratio:.2}"));
    let to = row.baseline.as_deref().unwrap_or_default();
    let to = to.split_once('/').map_or(to, |(_, name)| name);
    let limit = match &row.limit {
        Some((limit, true)) => limit.clone(),
        Some((limit, false)) => format!("{limit}, exceeded"),
        None => String::new(),
    };
    format!("| {name} | {:.2} {} | {ratio} | {to} | {limit} |\n", row.value, row.unit)
}

fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The processor's name; empty outside of Linux.
fn processor() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = info.lines().find_map(|line| line.strip_prefix("model name"));
    name.map_or(String::new(), |name| name.trim_start_matches([' ', '\t', ':']).to_owned())
}

/// The first line of a program's version; empty if it is not installed.
fn version(program: &str, option: &str) -> String {
    let Ok(output) = Command::new(program).arg(option).output() else { return String::new() };
    let printed = [output.stdout, output.stderr].concat();
    String::from_utf8_lossy(&printed).lines().next().unwrap_or_default().to_owned()
}

/// The version of a package in a lock file; empty if it is not in it.
fn locked(name: &str, lock: &str) -> String {
    let head = format!("name = \"{name}\"\nversion = \"");
    let version = lock.split_once(&head).and_then(|(_, rest)| rest.split_once('"'));
    version.map_or(String::new(), |(version, _)| version.to_owned())
}
