//! The crate of a runner: the command line with toolboxes of one's own linked in.

use proc_macro2::TokenStream;
use quote::quote;

use crate::layout::file;
use crate::manifest::{Dependency, Origin, manifest};

/// What a runner is made of.
#[derive(Clone, Debug)]
pub struct RunnerOptions {
    /// The name of its package and of its program.
    pub package: String,
    /// Where the `afp` crates come from.
    pub origin: Origin,
    /// The toolboxes: the name behind `use`, and the path of the module that has `templates`.
    pub toolboxes: Vec<(String, String)>,
    /// The crates of the toolboxes.
    pub dependencies: Vec<Dependency>,
}

/// The files of a runner: path below its folder, and text.
///
/// # Errors
/// A path that Rust cannot say; it is given back.
pub fn runner_files(options: &RunnerOptions) -> Result<Vec<(String, String)>, String> {
    let mut dependencies = options.dependencies.clone();
    dependencies.push(Dependency::ours("afpc", &options.origin));
    // A plan is interpreted here: what counts is that the runner is there soon.
    let profile = "[profile.release]\n\
                   debug = \"line-tables-only\"\n";
    let manifest = manifest("run' as a runner", &options.package, dependencies, profile);
    Ok(vec![
        ("Cargo.toml".to_owned(), manifest),
        ("src/main.rs".to_owned(), program(&options.toolboxes)?),
    ])
}

fn program(toolboxes: &[(String, String)]) -> Result<String, String> {
    let names: Vec<_> = toolboxes.iter().map(|(name, _)| format!("`{name}`")).collect();
    let about = format!(" The command line with {} linked in.", names.join(", "));
    let linked = toolboxes.iter().map(|(name, path)| {
        let home: TokenStream = path.parse().map_err(|_| path.clone())?;
        Ok(quote!(Linked { toolbox: #name, register: #home::templates::register }))
    });
    let linked = linked.collect::<Result<Vec<_>, String>>()?;
    Ok(file(quote! {
        #![doc = #about]
        use std::process::ExitCode;

        use afpc::Linked;

        fn main() -> ExitCode {
            afpc::main(&[#(#linked),*])
        }
    }))
}
