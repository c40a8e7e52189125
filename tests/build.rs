//! Makes a test of each case of `run/`.

use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    println!("cargo::rerun-if-changed=run");
    fs::write(out.join("run.rs"), cases()?)
}

fn cases() -> io::Result<String> {
    let files = fs::read_dir("run")?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = files.collect::<io::Result<_>>()?;
    files.retain(|path| path.extension().is_some_and(|extension| extension == "afp"));
    files.sort();
    let mut code = String::new();
    for path in files {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let _ = write!(code, "#[test]\nfn {name}() {{\n    crate::check({name:?});\n}}\n");
    }
    Ok(code)
}
