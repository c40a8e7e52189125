//! A whole crate for a plan: the output of `afpc build`.

use proc_macro2::TokenStream;
use quote::quote;

use crate::Options;
use crate::layout::{doc, file_with_places};
use crate::manifest::{Dependency, Origin, RUST_MADE_BY, manifest};
use crate::names::{NEVER, UniqueNames, ident, snake};
use crate::places::Places;
use crate::plan::{Generated, plan};
use afp_dsl::graph::Graph;
use afp_syntax::source::Span;

#[derive(Clone, Debug)]
pub struct CrateOptions {
    /// The plan's file name from the caller.
    pub file: String,
    /// Path and text of the plan's file and of the files that it uses, see
    /// [`afp_dsl::Compiled::plan_texts`]; the crate contains them.
    pub texts: Vec<(String, String)>,
    /// Name and text of the project's toolboxes; the program contains them for its logs.
    pub toolboxes: Vec<(String, String)>,
    /// The text of the project file, also for logs; empty without a project.
    pub project: String,
    /// The source of the `afp` crates.
    pub origin: Origin,
    /// Crates of toolboxes that are not built in.
    pub dependencies: Vec<Dependency>,
    /// Path of the robot's type, whose crate is among the dependencies; defaults to the simulated
    /// Carbot.
    pub robot: Option<String>,
    /// The hardware robot, in addition to the simulated robot; its crate is also a dependency.
    pub hardware: Option<Hardware>,
    /// Features of the runtime, such as `live` for live clients.
    pub features: Vec<String>,
    /// Whether to generate only a library, without the program that runs it in simulation.
    pub lib: bool,
}

#[derive(Clone, Debug)]
pub struct Hardware {
    pub ty: String,
    /// The settings for opening it: name and value.
    pub settings: Vec<(String, String)>,
}

#[derive(Clone, Debug)]
pub struct CrateFile {
    /// Its path, relative to the crate's folder.
    pub path: String,
    pub text: String,
    places: Places,
    whole: Span,
}

impl CrateFile {
    /// The source place of a line (counted from 1), and whether it is smaller than the whole plan.
    pub fn place(&self, line: usize) -> (Span, bool) {
        let place = self.places.at(line);
        (place.unwrap_or(self.whole), place.is_some())
    }
}

pub fn crate_files(graph: &Graph, options: &CrateOptions) -> Vec<CrateFile> {
    let generated = plan(graph, &Options { core: quote!(afp::core), ..Options::default() });
    let dependencies = dependencies(graph, options);
    let krate = crate_name(&graph.main().name, &dependencies);
    let main = graph.main().span;
    let plain = |path: &str, text| CrateFile {
        path: path.to_owned(),
        text,
        places: Places::default(),
        whole: main,
    };
    let mut files = vec![plain("Cargo.toml", cargo_toml(&krate, options, dependencies))];
    files.extend(options.texts.iter().map(|(path, text)| plain(path, text.clone())));
    let attached = Attached::of(options);
    if !options.lib {
        files.extend(attached.files().map(|(path, text)| plain(&path, text.to_owned())));
    }
    let head = format!("{RUST_MADE_BY} from {}.", base_name(&options.file));
    let rust = |path: &str, tokens| {
        let (text, places) = file_with_places(&head, tokens);
        CrateFile { path: path.to_owned(), text, places, whole: main }
    };
    files.push(rust("src/lib.rs", library(graph, &generated, options)));
    if !options.lib {
        files.push(rust("src/main.rs", program(graph, (&krate, &generated), options, &attached)));
    }
    for module in &generated.modules {
        let name = module.name.to_string();
        let path = format!("src/{}.rs", name.trim_start_matches("r#"));
        files.push(CrateFile { whole: module.span, ..rust(&path, module.tokens()) });
    }
    files
}

/// The files of the project that a program contains for its logs.
struct Attached<'a> {
    /// Their folder, in which no file of the plan is.
    folder: String,
    options: &'a CrateOptions,
}

impl<'a> Attached<'a> {
    fn of(options: &'a CrateOptions) -> Self {
        let mut folder = "attached".to_owned();
        while options.texts.iter().any(|(path, _)| path.starts_with(&folder)) {
            folder.push('_');
        }
        Attached { folder, options }
    }

    fn toolbox(&self, name: &str) -> String {
        format!("{}/{name}.afp", self.folder)
    }

    fn project(&self) -> String {
        format!("{}/project.toml", self.folder)
    }

    /// Path and text of each file.
    fn files(&self) -> impl Iterator<Item = (String, &'a str)> {
        let CrateOptions { toolboxes, project, .. } = self.options;
        let toolboxes = toolboxes.iter().map(|(name, text)| (self.toolbox(name), text.as_str()));
        let project = Some(project.as_str()).filter(|text| !text.is_empty());
        toolboxes.chain(project.map(|text| (self.project(), text)))
    }
}

/// Crates that belong to Rust, and folder names that cargo reserves.
const KEPT: &[&str] =
    &["alloc", "build", "core", "deps", "examples", "incremental", "proc_macro", "std", "test"];

/// The name of the crate in Rust: the plan's name, unless a dependency has it.
fn crate_name(plan: &str, dependencies: &[Dependency]) -> String {
    let others = dependencies.iter().flat_map(|it| [&it.key, &it.package]);
    let others: Vec<_> = others.map(|name| name.replace('-', "_")).collect();
    let kept = [KEPT, NEVER].concat().into_iter();
    let mut names = UniqueNames::taken(kept.chain(others.iter().map(String::as_str)));
    match snake(plan) {
        // Indirect dependencies of AFP's crates.
        name if name.starts_with("afp_") => names.unique(format!("{name}_plan")),
        name => names.unique_or(name, "plan"),
    }
}

fn cargo_toml(krate: &str, options: &CrateOptions, dependencies: Vec<Dependency>) -> String {
    let made_by = format!(" build' from {}", base_name(&options.file));
    let package = krate.replace('_', "-");
    let profile = "# One unit, optimised as a whole: the scheduler melts into the plan.\n\
                   [profile.release]\n\
                   lto = \"fat\"\n\
                   codegen-units = 1\n";
    manifest(&made_by, &package, dependencies, profile)
}

fn dependencies(graph: &Graph, options: &CrateOptions) -> Vec<Dependency> {
    let origin = &options.origin;
    let mut all = vec![Dependency::ours("afp", origin).with_only(&[])];
    if !options.lib {
        all.push(Dependency::ours("afp-run", origin).with_only(&options.features));
        match &options.robot {
            None => all.push(Dependency::ours("afp-sim", origin).with_only(&[])),
            Some(path) => all.extend(given(options, path).cloned()),
        }
        let itself = options.hardware.as_ref().and_then(|itself| given(options, &itself.ty));
        all.extend(itself.cloned());
    }
    for toolbox in graph.toolboxes.iter().filter(|toolbox| toolbox.is_named()) {
        let built_in = || {
            let name = toolbox.rust_path.split("::").next().unwrap_or("");
            Dependency::ours(&name.replace('_', "-"), origin)
        };
        all.push(given(options, &toolbox.rust_path).cloned().unwrap_or_else(built_in));
    }
    all
}

/// The dependency at the start of a Rust path.
fn given<'a>(options: &'a CrateOptions, path: &str) -> Option<&'a Dependency> {
    let name = path.split("::").next().unwrap_or("");
    options.dependencies.iter().find(|given| given.key.replace('-', "_") == name)
}

fn library(graph: &Graph, generated: &Generated, options: &CrateOptions) -> TokenStream {
    let modules = generated.modules.iter().map(|module| {
        let name = &module.name;
        quote!(pub mod #name;)
    });
    let about = format!(" The plan `{}`, made from its text by `afpc build`.", graph.main().name);
    let (module, ty) = (&generated.main, &generated.plan);
    let help = doc("", "Path and text of the plan's file, then of the files that it uses.");
    let texts = options.texts.iter().map(|(path, _)| {
        let place = format!("../{path}");
        quote!((#path, include_str!(#place)))
    });
    quote! {
        #![doc = #about]
        #![no_std]
        #(#modules)*
        pub use self::#module::#ty;
        #help
        pub const TEXTS: &[(&str, &str)] = &[#(#texts),*];
    }
}

fn program(
    graph: &Graph,
    (krate, generated): (&str, &Generated),
    options: &CrateOptions,
    attached: &Attached<'_>,
) -> TokenStream {
    let name = &graph.main().name;
    let itself = options.hardware.as_ref();
    let also = if itself.is_some() { ", or on the robot itself" } else { "" };
    let about = format!(" Runs the plan `{name}` on the simulated robot{also}.");
    let (krate, ty) = (ident(krate), &generated.plan);
    let path = &options.file;
    let (import, robot) = match options.robot.as_ref().and_then(|path| path.parse().ok()) {
        None => (
            quote!(
                use afp_sim::Simulation;
            ),
            quote!(Simulation),
        ),
        Some(robot) => (TokenStream::new(), robot),
    };
    let included = |path: String| {
        let place = format!("../{path}");
        quote!(include_str!(#place))
    };
    let toolboxes = options.toolboxes.iter().map(|(name, _)| {
        let text = included(attached.toolbox(name));
        quote!((#name, #text))
    });
    let project = match options.project.is_empty() {
        true => quote!(""),
        false => included(attached.project()),
    };
    let settings = itself.iter().flat_map(|itself| &itself.settings);
    let settings = settings.map(|(name, value)| quote!((#name, #value)));
    let main = match itself.and_then(|itself| itself.ty.parse::<TokenStream>().ok()) {
        None => quote!(afp_run::main::<#robot, _>(program, #krate::#ty::new)),
        Some(hardware) => {
            quote!(afp_run::main_with::<#robot, #hardware, _>(program, #krate::#ty::new))
        }
    };
    quote! {
        #![doc = #about]
        use std::process::ExitCode;

        use afp_run::Program;
        #import

        fn main() -> ExitCode {
            let program = Program {
                name: #name,
                file: #path,
                texts: #krate::TEXTS,
                toolboxes: &[#(#toolboxes),*],
                project: #project,
                hardware: &[#(#settings),*],
            };
            #main
        }
    }
}

fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
