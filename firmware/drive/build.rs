//! The memory and the linker scripts of the board.

use std::path::Path;
use std::{env, fs};

const PICO: &str = "MEMORY {
    BOOT2 : ORIGIN = 0x10000000, LENGTH = 0x100
    FLASH : ORIGIN = 0x10000100, LENGTH = 2048K - 0x100
    RAM : ORIGIN = 0x20000000, LENGTH = 264K
}
";
const MICROBIT: &str = "MEMORY {
    FLASH : ORIGIN = 0x00000000, LENGTH = 256K
    RAM : ORIGIN = 0x20000000, LENGTH = 16K
}
";

fn main() {
    let is_pico = env::var_os("CARGO_FEATURE_PICO").is_some();
    let folder = env::var_os("OUT_DIR").expect("cargo sets OUT_DIR");
    let memory = if is_pico { PICO } else { MICROBIT };
    fs::write(Path::new(&folder).join("memory.x"), memory).expect("OUT_DIR can be written");
    println!("cargo::rustc-link-search={}", Path::new(&folder).display());
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if is_pico {
        println!("cargo::rustc-link-arg-bins=-Tlink-rp.x");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
