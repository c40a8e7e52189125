//! The crate of a runner: the command line with a robot and toolboxes of one's own linked in.

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
    /// The path of the robot's type; without one it is the Carbot.
    pub robot: Option<String>,
    /// The toolboxes: the name behind `use`, and the path of the module that has `templates`.
    pub toolboxes: Vec<(String, String)>,
    /// The crates of the robot and of the toolboxes.
    pub dependencies: Vec<Dependency>,
}

/// The files of a runner: path below its folder, and text.
///
/// # Errors
/// A path that Rust cannot say; it is given back.
pub fn runner_files(options: &RunnerOptions) -> Result<Vec<(String, String)>, String> {
    let mut dependencies = options.dependencies.clone();
    dependencies.push(Dependency::ours("afpc", &options.origin));
    if options.robot.is_some() {
        let built_in = ["afp-carbot", "afp-std"];
        dependencies.extend(built_in.map(|name| Dependency::ours(name, &options.origin)));
    }
    // A plan is interpreted here: what counts is that the runner is there soon.
    let profile = "[profile.release]\n\
                   debug = \"line-tables-only\"\n";
    let manifest = manifest("run' as a runner", &options.package, dependencies, profile);
    Ok(vec![("Cargo.toml".to_owned(), manifest), ("src/main.rs".to_owned(), program(options)?)])
}

fn program(options: &RunnerOptions) -> Result<String, String> {
    let names = options.toolboxes.iter().map(|(name, _)| name).chain(&options.robot);
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    let about = format!(" The command line with {} linked in.", names.join(", "));
    let register = options.toolboxes.iter().map(|(_, path)| {
        let home = tokens(path)?;
        Ok(quote!(#home::templates::register(registry);))
    });
    let register = register.collect::<Result<TokenStream, String>>()?;
    let toolboxes = options.toolboxes.iter().map(|(name, _)| name);
    let (robot, own_robot) = match &options.robot {
        None => (quote!(afpc::carbot(|registry| { #register })), quote!(None)),
        Some(name) => {
            let ty = tokens(name)?;
            // Templates of the Carbot need its devices, which another robot may have in part.
            let robot = quote!(afpc::simulated::<#ty, _>(|registry| {
                afp_std::register!(registry, #ty);
                afp_carbot::register!(registry, #ty);
                #register
            }));
            (robot, quote!(Some(#name)))
        }
    };
    Ok(file(quote! {
        #![doc = #about]
        use std::process::ExitCode;

        use afpc::Linked;

        fn main() -> ExitCode {
            let robot = #robot;
            afpc::main(&Linked {
                robot: &robot,
                own_robot: #own_robot,
                toolboxes: &[#(#toolboxes),*],
            })
        }
    }))
}

/// The tokens of a path in Rust.
fn tokens(path: &str) -> Result<TokenStream, String> {
    path.parse().map_err(|_| path.to_owned())
}
