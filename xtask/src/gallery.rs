//! The gallery of the book: drawing, run, camera view and outcomes of each shipped plan.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};

const PAGE: &str = "docs/gallery.md";
/// The pictures' folder, relative to the page.
const PICTURES: &str = "images/gallery";
/// The start of the generated sections.
const SECTIONS: &str = "<!-- sections: made by 'cargo xtask gallery' -->\n";
/// Seeds of a sweep.
const SEEDS: &str = "0..30";

/// A plan, its time limit, and whether it uses the camera.
struct Shown {
    name: String,
    help: String,
    until: &'static str,
    sees: bool,
}

/// Draws, runs and sweeps the named plans of `plans/`, or all, and writes their sections.
///
/// # Errors
/// A plan cannot be drawn, run or swept, or a file cannot be written.
pub fn run(names: &[String]) -> Result<(), Failure> {
    run_command(cargo().args(["build", "--release", "--package", "afpc"]))?;
    fs::create_dir_all(root().join("docs").join(PICTURES))?;
    fs::create_dir_all(made(""))?;
    let page = fs::read_to_string(root().join(PAGE))?;
    let (head, old) = page.split_once(SECTIONS).ok_or("error: the page has no sections")?;
    let mut text = format!("{head}{SECTIONS}");
    for shown in plans()? {
        let kept = section_of(old, &shown.name)
            .filter(|_| !names.is_empty() && !names.contains(&shown.name));
        match kept {
            Some(section) => text += section,
            None => text += &section(&shown)?,
        }
    }
    fs::write(root().join(PAGE), text)?;
    println!("{PAGE}");
    Ok(())
}

/// The shipped plans, by name.
fn plans() -> Result<Vec<Shown>, Failure> {
    let mut plans = Vec::new();
    for file in fs::read_dir(root().join("plans"))? {
        let path = file?.path();
        if path.extension().is_none_or(|end| end != "afp") {
            continue;
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let text = fs::read_to_string(&path)?;
        // A plan without an end is shown for a minute.
        let until = if name == "wall_following" { "60s" } else { "400s" };
        let sees = text.contains(": FindObject(");
        plans.push(Shown { help: help(&text), name, until, sees });
    }
    plans.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(plans)
}

fn help(text: &str) -> String {
    let mut lines: Vec<&str> = Vec::new();
    for line in text.lines() {
        match line.strip_prefix("///") {
            Some(help) => lines.push(help.trim()),
            None if line.starts_with("plan ") => break,
            None => lines.clear(),
        }
    }
    lines.join("\n")
}

/// The section of a plan in the old page.
fn section_of<'a>(old: &'a str, name: &str) -> Option<&'a str> {
    let from = old.find(&format!("\n## `{name}`\n"))?;
    let rest = old.get(from + 1..)?;
    let to = rest.find("\n## `").unwrap_or(rest.len());
    old.get(from..from + 1 + to)
}

fn section(shown: &Shown) -> Result<String, Failure> {
    let Shown { name, help, until, sees } = shown;
    let plan = format!("plans/{name}.afp");
    let picture = |what: &str| format!("{PICTURES}/{name}{what}");
    let file = |what: &str| root().join("docs").join(picture(what));
    run_command(afpc().args(["graph", &plan, "-o"]).arg(file(".svg")))?;
    let log = made(&format!("{name}.mcap"));
    let mut drive = afpc();
    drive.args(["run", &plan, "--until", until, "--log"]).arg(&log);
    drive.arg("--svg").arg(file("-run.svg"));
    output(if *sees { drive.arg("--camera") } else { &mut drive })?;
    let mut text = format!("\n## `{name}`\n\n{help}\n\n![The plan]({})\n", picture(".svg"));
    let _ = write!(text, "\n![A run, seed 0]({})\n", picture("-run.svg"));
    if *sees {
        output(afpc().arg("log").arg(&log).arg("--film").arg(file("-film.png")))?;
        let _ = write!(text, "\n![The camera's view]({})\n", picture("-film.png"));
    }
    let table = made(&format!("{name}.csv"));
    let sweep = ["sweep", &plan, "--seeds", SEEDS, "--until", until, "--restart", "-o"];
    // The exit code reports failed runs, which are in the table.
    let _ = run_command(afpc().args(sweep).arg(&table));
    let command = format!("afpc sweep {plan} --seeds {SEEDS} --until {until}");
    let _ = write!(text, "\n`{command}`:\n\n{}", endings(&table)?);
    Ok(text)
}

/// The endings of a sweep's runs, as a Markdown table.
fn endings(table: &Path) -> Result<String, Failure> {
    let mut reader = csv::Reader::from_path(table).map_err(|why| why.to_string())?;
    let heads = reader.headers().map_err(|why| why.to_string())?.clone();
    let column = |name: &str| heads.iter().position(|head| head == name);
    let columns = ["ending", "where", "why", "time_s", "distance_m", "contacts_s"].map(column);
    let mut groups: BTreeMap<[String; 3], Vec<[f64; 3]>> = BTreeMap::new();
    for row in reader.records() {
        let row = row.map_err(|why| why.to_string())?;
        let [ending, place, why, time, way, contacts] =
            columns.map(|at| at.and_then(|at| row.get(at)).unwrap_or_default().to_owned());
        let figures = [time, way, contacts].map(|text| text.parse().unwrap_or(0.0));
        groups.entry([ending, place, why]).or_default().push(figures);
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|(_, runs)| std::cmp::Reverse(runs.len()));
    let mut text = "| runs | ended | in | by | time, median | way, median | touched something |\n\
                    |--:|---|---|---|--:|--:|--:|\n"
        .to_owned();
    for ([ending, place, why], runs) in &groups {
        let median = |n: usize| {
            let mut all: Vec<f64> = runs.iter().map(|run| run[n]).collect();
            all.sort_by(f64::total_cmp);
            all.get(all.len() / 2).copied().unwrap_or_default()
        };
        let touching = runs.iter().filter(|run| run[2] > 0.0).count();
        let (time, way) = (median(0), median(1));
        let _ = writeln!(
            text,
            "| {} | {ending} | `{place}` | {why} | {time:.1} s | {way:.1} m | {touching} |",
            runs.len()
        );
    }
    Ok(text)
}

/// Temporary files.
fn made(name: &str) -> PathBuf {
    target().join("xtask/gallery").join(name)
}

fn afpc() -> std::process::Command {
    program(target().join("release/afpc"))
}
