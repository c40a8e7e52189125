//! Writes cases for a state chart engine: the plans of `run/` and random ones.
//!
//! `state_charts COUNT FILE` writes a JSON object per line; `tests/scxml/replay.js` reads them.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::{env, io};

use afp_tests::case::Case;
use afp_tests::interpret::graph;
use afp_tests::script::Script;
use afp_tests::{random, random_script, state_chart};
use serde_json::Value;

/// Scripts for each random plan.
const SCRIPTS: u64 = 3;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().collect();
    let [_, count, file] = arguments.as_slice() else {
        return Err(io::Error::other("usage: state_charts COUNT FILE"));
    };
    let count: u64 = count.parse().map_err(io::Error::other)?;
    let mut out = BufWriter::new(File::create(file)?);
    for path in written()? {
        writeln!(out, "{}", from_file(&path)?)?;
    }
    for seed in 0..count {
        writeln!(out, "{}", from_seed(seed)?)?;
    }
    out.flush()
}

/// The cases of `run/`, by name.
fn written() -> io::Result<Vec<std::path::PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("run");
    let files = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut files = files.collect::<io::Result<Vec<_>>>()?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "afp"));
    files.sort();
    Ok(files)
}

fn from_file(path: &Path) -> io::Result<Value> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let case = Case::parse(&fs::read_to_string(path)?).map_err(io::Error::other)?;
    let graph = graph(&name, &case.plan).map_err(io::Error::other)?;
    Ok(state_chart::case(&name, &graph, &[case.script]))
}

fn from_seed(seed: u64) -> io::Result<Value> {
    let plan = random::plan(seed);
    let name = format!("random plan {seed}");
    let graph = graph(&name, &plan.text).map_err(io::Error::other)?;
    let scripts = (0..SCRIPTS).map(|script| random_script::script(&plan, script).parse());
    let scripts: Vec<Script> = scripts.collect::<Result<_, _>>().map_err(io::Error::other)?;
    Ok(state_chart::case(&name, &graph, &scripts))
}
