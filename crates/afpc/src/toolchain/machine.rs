//! The machines that binaries are built for, and what makes them.

use clap::ValueEnum;

/// What a binary runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Machine {
    /// This machine
    Host,
    /// Raspberry Pi with a system of 64 bit
    Pi,
    /// Raspberry Pi 2 or later with a system of 32 bit
    Pi32,
    /// Cortex-M (not in this release)
    #[value(hide = true)]
    Mcu,
}

/// How the tools call another machine that runs Linux.
#[derive(Debug)]
pub struct Linux {
    /// As people call it.
    pub name: &'static str,
    /// As Rust does.
    pub triple: &'static str,
    /// As Debian's compilers do, and zig.
    pub gnu: &'static str,
    /// Debian's packages of a compiler and a C library for it.
    pub packages: [&'static str; 2],
}

impl Machine {
    /// How the tools call it, if it is another machine that runs Linux.
    pub fn linux(self) -> Option<&'static Linux> {
        match self {
            Machine::Pi => Some(&PI),
            Machine::Pi32 => Some(&PI32),
            Machine::Host | Machine::Mcu => None,
        }
    }
}

const PI: Linux = Linux {
    name: "a Raspberry Pi of 64 bit",
    triple: "aarch64-unknown-linux-gnu",
    gnu: "aarch64-linux-gnu",
    packages: ["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross"],
};

const PI32: Linux = Linux {
    name: "a Raspberry Pi of 32 bit",
    triple: "armv7-unknown-linux-gnueabihf",
    gnu: "arm-linux-gnueabihf",
    packages: ["gcc-arm-linux-gnueabihf", "libc6-dev-armhf-cross"],
};
