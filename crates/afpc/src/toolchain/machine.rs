//! The target machines of binaries, and the tools for them.

use clap::ValueEnum;

/// The machine that runs a binary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Machine {
    /// This machine
    Host,
    /// Raspberry Pi with a 64-bit system
    Pi,
    /// Raspberry Pi 2 or later with a 32-bit system
    Pi32,
    /// Cortex-M (not in this release)
    #[value(hide = true)]
    Mcu,
}

/// The names of a Linux machine in the tools.
#[derive(Debug)]
pub struct Linux {
    /// The name for people.
    pub name: &'static str,
    /// The target triple of Rust.
    pub triple: &'static str,
    /// The triple of Debian's compilers and zig.
    pub gnu: &'static str,
    /// Debian's packages of a C compiler and a C library for it.
    pub packages: [&'static str; 2],
}

impl Machine {
    /// The names of another Linux machine; `None` for this machine.
    pub fn linux(self) -> Option<&'static Linux> {
        match self {
            Machine::Pi => Some(&PI),
            Machine::Pi32 => Some(&PI32),
            Machine::Host | Machine::Mcu => None,
        }
    }
}

const PI: Linux = Linux {
    name: "a 64-bit Raspberry Pi",
    triple: "aarch64-unknown-linux-gnu",
    gnu: "aarch64-linux-gnu",
    packages: ["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross"],
};

const PI32: Linux = Linux {
    name: "a 32-bit Raspberry Pi",
    triple: "armv7-unknown-linux-gnueabihf",
    gnu: "arm-linux-gnueabihf",
    packages: ["gcc-arm-linux-gnueabihf", "libc6-dev-armhf-cross"],
};
