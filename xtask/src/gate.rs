//! The microcontroller gate: plans with core and templates link without any panic.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::image;
use crate::shell::{Failure, cargo, program, run as run_command, target};

const TARGET: &str = "thumbv7em-none-eabihf";
const MANIFEST: &str = "firmware/wall_following/Cargo.toml";
/// The plan of the paper, and a plan that suspends it.
const IMAGES: [&str; 2] = ["firmware-wall-following", "paused"];
/// Debian's compiler and the sources of its library.
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_SOURCES: &str = "/usr/lib/rustlib/src/rust/library";

/// Builds and checks the images.
///
/// # Errors
/// The build fails, or panics are linked.
pub fn run() -> Result<(), Failure> {
    let folder = target().join("firmware");
    let built = if install_target().is_ok() {
        build(&mut cargo(), &folder)
    } else {
        install_debian()?;
        // Another compiler needs a separate folder; otherwise every switch would rebuild
        // everything.
        let folder = target().join("firmware-debian");
        let mut command = cargo();
        command
            .env("RUSTC", DEBIAN_RUSTC)
            .env("RUSTC_BOOTSTRAP", "1")
            .env_remove("RUSTUP_TOOLCHAIN");
        build(command.arg("-Zbuild-std=core,alloc"), &folder)
    };
    let folder = built?;
    IMAGES.iter().try_for_each(|name| check(name, &folder.join(name)))
}

/// Checks an image.
fn check(name: &str, path: &Path) -> Result<(), Failure> {
    let image = image::read(&fs::read(path)?)?;
    let (symbols, text) = (image.symbols.len(), image.text);
    println!("{name} for {TARGET}: {text} bytes of text, {symbols} symbols");
    let panics = image.panics();
    if panics.is_empty() {
        println!("no panic is linked");
        return Ok(());
    }
    Err(Failure(format!("error: panics are linked:\n    {}", panics.join("\n    "))))
}

fn build(command: &mut Command, folder: &Path) -> Result<PathBuf, Failure> {
    let build = ["build", "--release", "--target", TARGET, "--manifest-path", MANIFEST];
    run_command(command.args(build).env("CARGO_TARGET_DIR", folder))?;
    Ok(folder.join(TARGET).join("release"))
}

/// Installs the target's library by rustup.
fn install_target() -> Result<(), Failure> {
    run_command(program("rustup").args(["target", "add", TARGET]))
}

/// Installs a compiler with sources from Debian, for machines without rustup.
fn install_debian() -> Result<(), Failure> {
    if Path::new(DEBIAN_RUSTC).exists() && Path::new(DEBIAN_SOURCES).exists() {
        return Ok(());
    }
    let root = program("id").arg("-u").output().is_ok_and(|out| out.stdout == b"0\n");
    let apt = |arguments: &[&str]| {
        let mut command = program(if root { "apt-get" } else { "sudo" });
        if !root {
            command.arg("apt-get");
        }
        run_command(command.args(arguments))
    };
    let install = apt(&["update"]).and_then(|()| {
        apt(&["install", "-y", "--no-install-recommends", "rustc-web", "rust-web-src"])
    });
    install.map_err(|why| {
        Failure(format!("{}\nhelp: the gate needs 'rustup target add {TARGET}' to work", why.0))
    })
}
