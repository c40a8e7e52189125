//! Packages for editors: the Visual Studio Code extension and the tree-sitter grammar, tested and
//! packed.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use crate::npm;
use crate::shell::{Failure, cargo, output, program, root, run as run_command, target};
use crate::studio;

/// The parser generator, as cargo names it. Its npm package only downloads it.
const TOOL: &str = "tree-sitter-cli@0.27.1";

/// The parser's ABI version; not the newest, so that older editors accept it.
const ABI: &str = "14";

/// Invalid texts that the grammar accepts: it has no depth limit, no words reserved for later, and
/// needs no comma between bindings of a line.
const BEYOND_GRAMMAR: [&str; 4] = [
    "bindings_without_a_sign.afp",
    "e0111_nested_too_deeply.afp",
    "e0112_reserved_for_later.afp",
    "e0236_unknown_unit.afp",
];

/// Files of the grammar's package, including the generated parser, so that editors need no tool.
const GRAMMAR: [&str; 6] =
    ["README.md", "grammar.js", "package.json", "tree-sitter.json", "queries", "src"];

const QUERIES: [&str; 3] = ["highlights", "folds", "locals"];

/// Folders of the grammar and the extension.
const FOLDERS: [&str; 2] = ["editors/tree-sitter-afp", "editors/vscode"];

/// Tests the extension against the real servers.
///
/// # Errors
/// No node, npm or browser, no network for packages the first time, or a failing test.
pub fn extension() -> Result<(), Failure> {
    let extension = root().join(FOLDERS[1]);
    npm::ci(&extension)?;
    run_command(npm::npm().args(["run", "--silent", "check"]).current_dir(&extension))?;
    let features = ["build", "--quiet", "--package", "afpc", "--features", "full"];
    run_command(cargo().args(features))?;
    studio::controller()?;
    let afpc = target().join("debug").join(format!("afpc{}", env::consts::EXE_SUFFIX));
    let mut tests = npm::npm();
    tests.args(["run", "--silent", "test"]).current_dir(&extension).env("AFPC", root().join(afpc));
    run_command(&mut tests)
}

/// Packs both under `target/editors` and prints the files.
///
/// # Errors
/// As [`extension`] and [`grammar`]; there is no `tar`.
pub fn pack() -> Result<(), Failure> {
    let made = target().join("editors");
    fs::create_dir_all(&made)?;
    let [grammar, extension] = FOLDERS.map(|folder| root().join(folder));
    tree_sitter(&tool()?, &["generate", "--abi", ABI], &grammar)?;
    let archive = made.join("tree-sitter-afp-0.1.0.tar.gz");
    let mut tar = program("tar");
    tar.arg("--create").arg("--gzip").arg("--file").arg(root().join(&archive));
    run_command(tar.args(GRAMMAR).current_dir(&grammar))?;
    npm::ci(&extension)?;
    let package = made.join("afp-0.1.0.vsix");
    fs::copy(root().join("LICENSE-MIT"), extension.join("LICENSE.txt"))?;
    let vsce = extension.join("node_modules/@vscode/vsce/vsce");
    let mut pack = program("node");
    pack.arg(vsce).args(["package", "--no-dependencies", "--allow-missing-repository", "--out"]);
    run_command(pack.arg(root().join(&package)).current_dir(&extension))?;
    for file in [archive, package] {
        println!("{} ({} kB)", file.display(), fs::metadata(&file)?.len().div_ceil(1000));
    }
    Ok(())
}

/// Tests the grammar: its cases, every text of the project, and the editors' queries on one text of
/// each kind. Its tool takes minutes to build the first time.
///
/// # Errors
/// No C compiler, no network for packages the first time, or a failing test.
pub fn grammar() -> Result<(), Failure> {
    let (tool, folder) = (tool()?, root().join(FOLDERS[0]));
    tree_sitter(&tool, &["generate", "--abi", ABI], &folder)?;
    tree_sitter(&tool, &["test"], &folder)?;
    let texts = Texts::sorted()?;
    let refused = refused(&tool, &folder, &texts.sound)?;
    if !refused.is_empty() {
        let why = "the parser of afp-syntax accepts these files, the grammar does not";
        return Err(format!("{why}:\n{}", refused.join("\n")).into());
    }
    let refused = self::refused(&tool, &folder, &texts.wrong)?;
    let taken = texts.wrong.iter().filter(|file| !refused.contains(file));
    let taken = taken.filter(|file| !BEYOND_GRAMMAR.iter().any(|known| file.ends_with(known)));
    let taken: Vec<_> = taken.map(String::as_str).collect();
    if !taken.is_empty() {
        let why = "the parser of afp-syntax rejects these files, the grammar does not";
        return Err(format!("{why}:\n{}", taken.join("\n")).into());
    }
    let samples = ["plans/wall_following.afp", "plans/tests/wall_following.afp"];
    for query in QUERIES {
        let query = format!("queries/{query}.scm");
        let files = samples.map(|file| root().join(file).display().to_string());
        let mut asked = tree_sitter_command(&tool, &folder);
        output(asked.args(["query", "--quiet", &query]).args(files))?;
    }
    neovim(&folder)?;
    let Texts { sound, wrong } = &texts;
    println!(
        "{} valid and {} invalid files are read like the parser reads them",
        sound.len(),
        wrong.len()
    );
    Ok(())
}

/// Neovim with the grammar, installed as in docs/editors.md; reports a missing Neovim.
fn neovim(grammar: &Path) -> Result<(), Failure> {
    if program("nvim").arg("--version").output().is_err() {
        eprintln!("skipped: 'nvim' is not installed; run 'apt-get install neovim'");
        return Ok(());
    }
    let data = root().join(target()).join("xtask/neovim");
    let site = data.join("nvim/site");
    let queries = site.join("queries/afp");
    fs::create_dir_all(&queries)?;
    fs::create_dir_all(site.join("parser"))?;
    for query in QUERIES {
        let name = format!("{query}.scm");
        fs::copy(grammar.join("queries").join(&name), queries.join(name))?;
    }
    let mut compile = program("cc");
    compile.args(["-O1", "-shared", "-fPIC", "-I", "src", "src/parser.c", "src/scanner.c", "-o"]);
    run_command(compile.arg(site.join("parser/afp.so")).current_dir(grammar))?;
    let look = format!("luafile {}", grammar.join("test/neovim.lua").display());
    let mut ask = program("nvim");
    ask.args(["--headless", "-u", "NONE", "-i", "NONE", "plans/wall_following.afp", "-c", &look]);
    let said = output(ask.env("XDG_DATA_HOME", &data))?;
    let mut lines = said.lines();
    if lines.next() == Some("errors false")
        && said.lines().count() > 1
        && lines.all(|line| line.ends_with(" true"))
    {
        return Ok(());
    }
    Err(format!("Neovim finds in plans/wall_following.afp:\n{said}").into())
}

/// The texts in which the grammar finds errors; it parses each to the end.
fn refused(tool: &Path, folder: &Path, texts: &[String]) -> Result<Vec<String>, Failure> {
    let list = list(texts)?;
    let mut command = tree_sitter_command(tool, folder);
    let said = command.args(["parse", "--quiet", "--paths"]).arg(&list).output()?;
    // Exit code 1 means errors.
    if said.status.code().is_none_or(|code| code > 1) {
        let errors = String::from_utf8_lossy(&said.stderr);
        return Err(format!(
            "the parser breaks on one of {}: {}\n{errors}",
            list.display(),
            said.status
        )
        .into());
    }
    let lines = String::from_utf8_lossy(&said.stdout);
    let name = |line: &str| line.split('\t').next().unwrap_or_default().trim().to_owned();
    let found: Vec<_> = lines.lines().filter(|line| line.contains("\tParse:")).map(name).collect();
    if said.status.success() == found.is_empty() {
        Ok(found)
    } else {
        Err(format!("cannot read its output:\n{lines}").into())
    }
}

/// A file with the paths of texts, for programs with many inputs.
fn list(texts: &[String]) -> Result<PathBuf, Failure> {
    let list = root().join(target()).join("xtask/texts.txt");
    fs::write(&list, texts.join("\n") + "\n")?;
    Ok(list)
}

/// The project's texts, split by whether the language's parser finds errors.
struct Texts {
    sound: Vec<String>,
    wrong: Vec<String>,
}

impl Texts {
    fn sorted() -> Result<Texts, Failure> {
        let listed = output(program("git").args(["ls-files", "--", "*.afp"]))?;
        let all = listed.lines().map(|file| root().join(file).display().to_string());
        let all: Vec<_> = all.collect();
        let mut command = cargo();
        command.args(["run", "--quiet", "--package", "afp-syntax", "--example", "sound", "--"]);
        let sound = output(command.arg(list(&all)?))?;
        let sound: Vec<String> = sound.lines().map(str::to_owned).collect();
        let wrong = all.into_iter().filter(|file| !sound.contains(file)).collect();
        Ok(Texts { sound, wrong })
    }
}

/// The tool, installed once under target/.
fn tool() -> Result<PathBuf, Failure> {
    let home = root().join(target()).join("xtask/tools");
    let mut install = cargo();
    install.args(["install", "--quiet", "--locked", "--no-default-features", TOOL, "--root"]);
    // Long optimisation takes longer than all uses of the tool.
    install
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1")
        .env("CARGO_PROFILE_RELEASE_LTO", "off")
        .env("CARGO_PROFILE_RELEASE_CODEGEN_UNITS", "16");
    run_command(install.arg(&home))?;
    Ok(home.join("bin").join(format!("tree-sitter{}", env::consts::EXE_SUFFIX)))
}

fn tree_sitter(tool: &Path, arguments: &[&str], folder: &Path) -> Result<(), Failure> {
    run_command(tree_sitter_command(tool, folder).args(arguments))
}

/// The tool in the folder of the grammar; its caches are under target/.
fn tree_sitter_command(tool: &Path, folder: &Path) -> Command {
    let kept = root().join(target()).join("xtask/tree-sitter");
    let mut command = program(tool);
    command.current_dir(folder).env("XDG_CACHE_HOME", kept.join("cache"));
    command.env("XDG_CONFIG_HOME", kept.join("config"));
    command
}
