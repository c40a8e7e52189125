//! Stops a build without a page, and names the command that builds it.

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=../../studio/dist");
    // A debug build reads the page from the checkout.
    let embeds = std::env::var_os("CARGO_FEATURE_PAGE").is_some()
        && std::env::var_os("PROFILE").is_some_and(|profile| profile == "release");
    if embeds && !Path::new("../../studio/dist/index.html").exists() {
        println!("cargo::error=the studio's page is not made yet: run 'cargo xtask studio'");
    }
}
