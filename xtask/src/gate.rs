//! The microcontroller gate: plans with core and templates, and the controller's program, link
//! without any panic. The controller's program runs on an emulated board.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::image;
use crate::shell::{Failure, cargo, program, run as run_command, target};

/// A crate of images.
struct Firmware {
    manifest: &'static str,
    target: &'static str,
    options: &'static [&'static str],
    images: &'static [&'static str],
    /// Whether the image has panics: of USB, whose panic handler cuts the motors' power.
    panics: bool,
    /// The largest size of code and constants, bytes.
    most: u64,
}

/// The plan of the paper, and a plan that suspends it.
const PLANS: Firmware = Firmware {
    manifest: "firmware/wall_following/Cargo.toml",
    target: "thumbv7em-none-eabihf",
    options: &[],
    images: &["firmware-wall-following", "paused"],
    panics: false,
    most: 100_000,
};
/// The second controller of the profile `carbot`, on the emulated board.
const EMULATED: Firmware = Firmware {
    manifest: "firmware/drive/Cargo.toml",
    target: "thumbv6m-none-eabi",
    options: &["--features", "microbit", "--bin", "microbit"],
    images: &["microbit"],
    panics: false,
    most: 40_000,
};
/// The same on a Raspberry Pi Pico.
const PICO: Firmware = Firmware {
    options: &["--features", "pico", "--bin", "pico"],
    images: &["pico"],
    panics: true,
    most: 80_000,
    ..EMULATED
};

/// The emulator of boards, and its package.
const QEMU: &str = "qemu-system-arm";
/// Debian's compiler and the sources of its library.
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_SOURCES: &str = "/usr/lib/rustlib/src/rust/library";

/// Builds and checks the images, and drives the emulated board.
///
/// # Errors
/// The build fails, panics are linked, an image is too large, or the board does not drive.
pub fn run() -> Result<(), Failure> {
    PLANS.check()?;
    let board = EMULATED.check()?.join("microbit");
    let pico = PICO.check()?.join("pico");
    let uf2 = target().join("firmware/drive.uf2");
    fs::write(&uf2, image::uf2(&fs::read(pico)?)?)?;
    println!("{} is for a Raspberry Pi Pico", uf2.display());
    if program(QEMU).arg("--version").output().is_err() {
        apt(&["update"]).and_then(|()| apt(&["install", "-y", "--no-install-recommends", QEMU]))?;
    }
    let mut test = cargo();
    test.args(["test", "--package", "afp-pi", "--test", "carbot", "--", "--ignored"]);
    run_command(test.env("AFP_CONTROLLER", fs::canonicalize(board)?))
}

impl Firmware {
    /// Builds and checks the images; returns their folder.
    fn check(&self) -> Result<PathBuf, Failure> {
        let folder = target().join("firmware");
        let folder = if self.install_target().is_ok() {
            self.build(&mut cargo(), &folder)
        } else {
            self.install_debian()?;
            // Another compiler needs a separate folder; otherwise every switch would rebuild
            // everything.
            let folder = target().join("firmware-debian");
            let mut command = cargo();
            command
                .env("RUSTC", DEBIAN_RUSTC)
                .env("RUSTC_BOOTSTRAP", "1")
                .env_remove("RUSTUP_TOOLCHAIN");
            self.build(command.arg("-Zbuild-std=core,alloc"), &folder)
        }?;
        self.images.iter().try_for_each(|name| self.check_image(name, &folder.join(name)))?;
        Ok(folder)
    }

    fn check_image(&self, name: &str, path: &Path) -> Result<(), Failure> {
        let image = image::read(&fs::read(path)?)?;
        let (symbols, text) = (image.symbols.len(), image.text);
        println!("{name} for {}: {text} bytes of text, {symbols} symbols", self.target);
        if text > self.most {
            return Err(format!("'{name}' may have {} bytes", self.most).into());
        }
        let panics = image.panics();
        if panics.is_empty() {
            println!("no panic is linked");
        } else if !self.panics {
            return Err(Failure(format!(
                "error: panics are linked:\n    {}",
                panics.join("\n    ")
            )));
        }
        Ok(())
    }

    fn build(&self, command: &mut Command, folder: &Path) -> Result<PathBuf, Failure> {
        command.args(["build", "--release", "--target", self.target]);
        command.args(["--manifest-path", self.manifest]).args(self.options);
        run_command(command.env("CARGO_TARGET_DIR", folder))?;
        Ok(folder.join(self.target).join("release"))
    }

    /// Installs the target's library by rustup.
    fn install_target(&self) -> Result<(), Failure> {
        run_command(program("rustup").args(["target", "add", self.target]))
    }

    /// Installs a compiler with sources from Debian, for machines without rustup.
    fn install_debian(&self) -> Result<(), Failure> {
        if Path::new(DEBIAN_RUSTC).exists() && Path::new(DEBIAN_SOURCES).exists() {
            return Ok(());
        }
        let install = apt(&["update"]).and_then(|()| {
            apt(&["install", "-y", "--no-install-recommends", "rustc-web", "rust-web-src"])
        });
        install.map_err(|why| {
            let needed = format!("the gate needs 'rustup target add {}' to work", self.target);
            Failure(format!("{}\nhelp: {needed}", why.0))
        })
    }
}

/// Runs `apt-get` as root.
fn apt(arguments: &[&str]) -> Result<(), Failure> {
    let root = program("id").arg("-u").output().is_ok_and(|out| out.stdout == b"0\n");
    let mut command = program(if root { "apt-get" } else { "sudo" });
    if !root {
        command.arg("apt-get");
    }
    run_command(command.args(arguments))
}
