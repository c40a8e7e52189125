//! Other machines under emulation: their packages, and how to run their programs.

use std::fs;
use std::path::{Path, PathBuf};

use crate::shell::{Failure, output, program, run};

/// A machine that QEMU emulates.
pub struct Emulated {
    /// The name for `afpc build --target`.
    pub name: &'static str,
    /// The target triple of Rust.
    pub triple: &'static str,
    /// The architecture in Debian.
    debian: &'static str,
    /// The C compiler and linker.
    pub linker: &'static str,
    /// The emulator.
    qemu: &'static str,
    /// The folder of Debian's libraries.
    libraries: &'static str,
    /// Debian's packages: a linker with its libraries, and the emulator.
    packages: [&'static str; 3],
}

/// A Raspberry Pi with a 64-bit system.
pub const PI: Emulated = Emulated {
    name: "pi",
    triple: "aarch64-unknown-linux-gnu",
    debian: "arm64",
    linker: "aarch64-linux-gnu-gcc",
    qemu: "qemu-aarch64",
    libraries: "/usr/aarch64-linux-gnu",
    packages: ["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross", "qemu-user"],
};

/// A Raspberry Pi with a 32-bit system.
pub const PI32: Emulated = Emulated {
    name: "pi32",
    triple: "armv7-unknown-linux-gnueabihf",
    debian: "armhf",
    linker: "arm-linux-gnueabihf-gcc",
    qemu: "qemu-arm",
    libraries: "/usr/arm-linux-gnueabihf",
    packages: ["gcc-arm-linux-gnueabihf", "libc6-dev-armhf-cross", "qemu-user"],
};

impl Emulated {
    /// The command prefix for a program of the machine.
    pub fn emulator(&self) -> [&'static str; 3] {
        [self.qemu, "-L", self.libraries]
    }

    /// The environment variable of a cargo key for the machine.
    pub fn variable(&self, what: &str) -> String {
        format!("CARGO_TARGET_{}_{what}", self.triple.to_uppercase().replace('-', "_"))
    }

    /// Commands that install the missing packages; empty if nothing is missing.
    pub fn missing(&self) -> Vec<String> {
        let mut commands = Vec::new();
        let libdir = ["--print", "target-libdir", "--target", self.triple];
        let library = output(program("rustc").args(libdir));
        if !library.is_ok_and(|folder| Path::new(folder.trim()).is_dir()) {
            commands.push(format!("rustup target add {}", self.triple));
        }
        let there = |name: &str| program(name).arg("--version").output().is_ok();
        if !(there(self.linker) && there(self.qemu) && Path::new(self.libraries).is_dir()) {
            commands.push(format!("apt-get install {}", self.packages.join(" ")));
        }
        commands
    }

    /// Installs missing packages as root; for other users it prints them.
    ///
    /// # Errors
    /// The installation fails.
    pub fn install(&self) -> Result<(), Failure> {
        let missing = self.missing();
        if missing.is_empty() {
            return Ok(());
        }
        let options = ["install", "-y", "--no-install-recommends"];
        let install = run(program("rustup").args(["target", "add", self.triple]))
            .and_then(|()| run(program("apt-get").arg("update")))
            .and_then(|()| run(program("apt-get").args(options).args(self.packages)));
        install.map_err(|why| Failure(format!("{}\nhelp: {}", why.0, missing.join(" && "))))
    }

    /// The root of a system with Debian's Python for the machine, unpacked once into a folder;
    /// nothing is installed.
    ///
    /// # Errors
    /// No network for the packages.
    pub fn python(&self, folder: &Path) -> Result<PathBuf, Failure> {
        let root = folder.join("root");
        let done = folder.join("done");
        if done.exists() {
            return Ok(root);
        }
        for needed in ["state/lists/partial", "cache/archives/partial"] {
            fs::create_dir_all(folder.join(needed))?;
        }
        let at = |what: &str, name: &str| format!("{what}={}", folder.join(name).display());
        let options = [
            at("Dir::State", "state"),
            at("Dir::Cache", "cache"),
            "Dir::State::status=/dev/null".to_owned(),
            format!("APT::Architecture={}", self.debian),
            format!("APT::Architectures={}", self.debian),
            "Debug::NoLocking=1".to_owned(),
        ];
        let apt = || {
            let mut apt = program("apt-get");
            apt.arg("-qq").args(options.iter().flat_map(|option| ["-o", option]));
            apt
        };
        run(apt().arg("update"))?;
        let download = ["-y", "--no-install-recommends", "--download-only", "install"];
        // numpy needs the second package.
        run(apt().args(download).args(["python3", "libstdc++6"]))?;
        for package in fs::read_dir(folder.join("cache/archives"))? {
            let package = package?.path();
            if package.extension().is_some_and(|ending| ending == "deb") {
                run(program("dpkg").arg("--extract").arg(package).arg(&root))?;
            }
        }
        fs::write(done, "")?;
        Ok(root)
    }

    /// The command prefix for a program of the machine that needs the files of a root.
    pub fn emulator_in(&self, root: &Path) -> [String; 3] {
        [self.qemu.to_owned(), "-L".to_owned(), root.display().to_string()]
    }
}
