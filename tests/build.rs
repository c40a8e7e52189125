//! Compiles the plans of the tests to Rust: the cases of `run/` and the random plans.

#[path = "build/names.rs"]
mod names;
#[allow(dead_code, reason = "only the tests need the values for scripts")]
#[path = "src/random.rs"]
mod random;

use std::fmt::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use afp_codegen::Options;
use afp_dsl::Toolboxes;
use afp_dsl::compile_unchecked;
use afp_dsl::files::Texts;
use afp_syntax::source::Source;

use names::Words;

/// The default seeds of random plans.
const RANDOM_PLANS: Range<u64> = 0..40;

fn main() -> io::Result<()> {
    for path in ["build", "run", "plans", "toolbox/testing.afp", "src/random.rs", "src/random"] {
        println!("cargo::rerun-if-changed={path}");
    }
    println!("cargo::rerun-if-env-changed=AFP_RANDOM_PLANS");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    let toolboxes = toolboxes()?;
    let (cases, words) = cases(&toolboxes)?;
    fs::write(out.join("run.rs"), cases)?;
    fs::write(out.join("names.rs"), names::code(&words, &toolboxes)?)?;
    fs::write(out.join("steps.rs"), steps(&toolboxes)?)?;
    fs::write(out.join("random.rs"), random_plans(&toolboxes)?)
}

/// The toolboxes that the plans of the tests use.
fn toolboxes() -> io::Result<Toolboxes> {
    let mut toolboxes = Toolboxes::default();
    for builtin in afp_toolboxes::ALL.iter().filter(|builtin| builtin.name == "std") {
        toolboxes.add(Source::new(builtin.file_name, builtin.text), builtin.rust_path);
    }
    let text = fs::read_to_string("toolbox/testing.afp")?;
    toolboxes.add(Source::new("testing.afp", text), "afp_tests");
    Ok(toolboxes)
}

/// A module and a test for each case, and the words in the generated code.
fn cases(toolboxes: &Toolboxes) -> io::Result<(String, Words)> {
    let files = fs::read_dir("run")?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = files.collect::<io::Result<_>>()?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "afp"));
    files.sort();
    let (mut code, mut words) = (String::new(), Words::default());
    for path in files {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let text = fs::read_to_string(&path)?;
        let module = module(&name, &path, &text, toolboxes)?;
        words.add(&name, &text, &module);
        code += &module;
        let _ = write!(
            code,
            "#[test]
fn {name}() {{
    crate::check({name:?}, |script| afp_tests::drive::drive({name}::new(), script));
}}
"
        );
    }
    Ok((code, words))
}

/// The plan that must not allocate.
fn steps(toolboxes: &Toolboxes) -> io::Result<String> {
    let path = Path::new("plans/steps.afp");
    let module = module("steps", path, &fs::read_to_string(path)?, toolboxes)?;
    Ok(format!("pub {module}"))
}

/// The seeds in `AFP_RANDOM_PLANS`, such as `400..800`.
fn wanted() -> io::Result<Range<u64>> {
    let Ok(text) = env::var("AFP_RANDOM_PLANS") else { return Ok(RANDOM_PLANS) };
    let ends =
        text.split_once("..").and_then(|(from, to)| Some(from.parse().ok()?..to.parse().ok()?));
    ends.ok_or_else(|| {
        io::Error::other(format!("AFP_RANDOM_PLANS is '{text}', not seeds such as 400..800"))
    })
}

/// A module for each random plan, and a table of seeds and functions that run them.
fn random_plans(toolboxes: &Toolboxes) -> io::Result<String> {
    let (mut code, mut table) = (String::new(), String::new());
    for seed in wanted()? {
        let name = format!("seed{seed}");
        code += &module(
            &name,
            &Path::new(&name).with_extension("afp"),
            &random::plan(seed).text,
            toolboxes,
        )?;
        let run = format!("|script| afp_tests::drive::drive({name}::new(), script)");
        let _ = writeln!(table, "    ({seed}, {run}),");
    }
    let _ = write!(
        code,
        "/// Runs a plan.
pub type Run = fn(&afp_tests::script::Script) -> Vec<String>;

/// Each seed with the function that runs its plan.
pub const PLANS: &[(u64, Run)] = &[
{table}];
"
    );
    Ok(code)
}

/// A plan's Rust in a module, with a function `new`.
fn module(name: &str, path: &Path, text: &str, toolboxes: &Toolboxes) -> io::Result<String> {
    let (text, files) = Texts::in_one(text);
    // Paths in a case are relative to its folder.
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let source = Source::new(file, text);
    let compiled = compile_unchecked(&source, toolboxes, &files);
    let errors = compiled.render(false);
    let graph = compiled.graph.ok_or_else(|| io::Error::other(errors))?;
    let generated = afp_codegen::plan(&graph, &Options { hold: true, ..Options::default() });
    let (main, plan) = (&generated.main, &generated.plan);
    let code = afp_codegen::file(generated.tokens());
    Ok(format!(
        "mod {name} {{
{code}
pub fn new() -> self::{main}::{plan} {{
    self::{main}::{plan}::new()
}}
}}
"
    ))
}
