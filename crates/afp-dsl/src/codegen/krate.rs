//! A whole crate for a plan: what `afpc build` writes and builds.

use quote::quote;

use crate::codegen::Options;
use crate::codegen::layout::{doc, file};
use crate::codegen::names::{ident, snake};
use crate::codegen::plan::{Generated, plan};
use crate::graph::Graph;

/// What a generated crate needs to know about its surroundings.
#[derive(Clone, Debug)]
pub struct CrateOptions {
    /// The plan's file, as it was named.
    pub file: String,
    /// Path and text of the plan's file and of those that it uses, see
    /// [`crate::Compiled::plan_texts`]; the crate carries them along.
    pub texts: Vec<(String, String)>,
    /// Where the `afp` crates come from.
    pub origin: Origin,
    /// Crates of toolboxes that are not built in: package name and value in the manifest.
    pub dependencies: Vec<(String, String)>,
    /// Whether only a library is wanted, without the program that runs it in simulation.
    pub lib: bool,
}

/// Where a manifest takes the `afp` crates from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A checkout.
    Path(String),
    /// A repository.
    Git(String),
    /// A registry.
    Version(String),
}

impl Origin {
    /// One `afp` crate, as a manifest names it.
    fn dependency(&self, package: &str, defaults: bool) -> String {
        let features = if defaults { "" } else { ", default-features = false" };
        match self {
            Origin::Path(root) => {
                let path = quoted(&format!("{}/crates/{package}", root.trim_end_matches('/')));
                format!("{{ path = {path}{features} }}")
            }
            Origin::Git(url) => format!("{{ git = {}{features} }}", quoted(url)),
            Origin::Version(version) => format!("{{ version = {}{features} }}", quoted(version)),
        }
    }
}

/// The files of a crate: path below its folder, and text.
pub fn crate_files(graph: &Graph, options: &CrateOptions) -> Vec<(String, String)> {
    let generated = plan(graph, &Options { core: quote!(afp::core), ..Options::default() });
    let mut files = vec![("Cargo.toml".to_owned(), manifest(graph, options))];
    files.extend(options.texts.iter().cloned());
    files.push(("src/lib.rs".to_owned(), library(graph, &generated, options)));
    if !options.lib {
        files.push(("src/main.rs".to_owned(), program(graph, &generated, options)));
    }
    for module in &generated.modules {
        let name = module.name.to_string();
        let path = format!("src/{}.rs", name.trim_start_matches("r#"));
        files.push((path, file(module.tokens())));
    }
    files
}

fn package(graph: &Graph) -> String {
    snake(&graph.main().name).replace('_', "-")
}

fn manifest(graph: &Graph, options: &CrateOptions) -> String {
    let origin = &options.origin;
    let mut dependencies = vec![("afp".to_owned(), origin.dependency("afp", false))];
    if !options.lib {
        dependencies.push(("afp-run".to_owned(), origin.dependency("afp-run", false)));
    }
    for toolbox in &graph.toolboxes {
        let name = toolbox.rust_path.split("::").next().unwrap_or("").replace('_', "-");
        let given = options.dependencies.iter().find(|(known, _)| known.replace('_', "-") == name);
        dependencies.push(match given {
            Some(given) => given.clone(),
            None => (name.clone(), origin.dependency(&name, true)),
        });
    }
    dependencies.sort();
    dependencies.dedup();
    let lines = dependencies.iter().map(|(name, value)| format!("{name} = {value}\n"));
    let lines: String = lines.collect();
    format!(
        "# Made by 'afpc build' from {file}.\n\
         [package]\n\
         name = {name}\n\
         version = \"0.1.0\"\n\
         edition = \"2024\"\n\
         publish = false\n\
         \n\
         [dependencies]\n\
         {lines}\
         \n\
         # One unit, optimised as a whole: the scheduler melts into the plan.\n\
         [profile.release]\n\
         lto = \"fat\"\n\
         codegen-units = 1\n\
         \n\
         [workspace]\n",
        file = base_name(&options.file),
        name = quoted(&package(graph)),
    )
}

fn library(graph: &Graph, generated: &Generated, options: &CrateOptions) -> String {
    let modules = generated.modules.iter().map(|module| {
        let name = &module.name;
        quote!(pub mod #name;)
    });
    let about = format!(" The plan `{}`, made from its text by `afpc build`.", graph.main().name);
    let (module, ty) = (&generated.main, &generated.plan);
    let help = doc("", "Path and text of the plan's file, then of those that it uses.");
    let texts = options.texts.iter().map(|(path, _)| {
        let place = format!("../{path}");
        quote!((#path, include_str!(#place)))
    });
    file(quote! {
        #![doc = #about]
        #![no_std]
        #(#modules)*
        pub use #module::#ty;
        #help
        pub const TEXTS: &[(&str, &str)] = &[#(#texts),*];
    })
}

fn program(graph: &Graph, generated: &Generated, options: &CrateOptions) -> String {
    let name = &graph.main().name;
    let about = format!(" Runs the plan `{name}` on the simulated robot.");
    let (krate, ty) = (ident(&snake(name)), &generated.plan);
    let path = &options.file;
    file(quote! {
        #![doc = #about]
        use std::process::ExitCode;

        use afp_run::Program;
        use #krate::#ty;

        fn main() -> ExitCode {
            let program = Program { name: #name, file: #path, texts: #krate::TEXTS };
            afp_run::main(program, #ty::new)
        }
    })
}

/// The last part of a path of either kind.
fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// A text as a basic string of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            letter if letter.is_control() => quoted += &format!("\\u{:04X}", u32::from(letter)),
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}
