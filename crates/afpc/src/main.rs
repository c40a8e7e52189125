//! The command line of Action Flow Plans, with the built-in toolboxes alone.

use std::process::ExitCode;

/// Trees are many small pieces; checking a large plan takes a third less time than with the
/// allocator of the system.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    afpc::main(&[])
}
