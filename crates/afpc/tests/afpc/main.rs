//! The command line: the real binary, in temporary folders.

mod again;
#[cfg(all(feature = "dap", feature = "pi", target_os = "linux"))]
mod attach;
mod book;
mod build;
#[cfg(unix)]
mod build_json;
#[cfg(all(feature = "pi", unix))]
mod calibrate;
mod check;
mod common;
mod coverage;
mod dap;
#[cfg(target_os = "linux")]
mod deploy;
#[cfg(target_os = "linux")]
mod every_output;
mod files;
mod fmt;
#[cfg(all(feature = "dap", feature = "pi", target_os = "linux"))]
mod fork;
mod graph;
mod log;
#[cfg(feature = "lsp")]
mod lsp;
mod new;
#[cfg(unix)]
mod outputs;
mod own_toolboxes;
#[cfg(all(feature = "pi", unix))]
mod profile;
#[cfg(all(feature = "pi", target_os = "linux"))]
mod profiles;
mod run;
mod sweep;
#[cfg(target_os = "linux")]
mod terminal;
mod test;
mod timing;
#[cfg(unix)]
mod toolchain;
#[cfg(all(feature = "pi", target_os = "linux"))]
mod ways_out;
#[cfg(all(feature = "pi", target_os = "linux"))]
mod wired;
