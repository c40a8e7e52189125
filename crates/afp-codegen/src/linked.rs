//! Crates that link a project's robot and toolboxes: the command line, and the Python extension.

use std::collections::BTreeMap;

use afp_dsl::toolbox::Toolbox;
use proc_macro2::TokenStream;
use quote::quote;

use crate::layout::file;
use crate::manifest::{Dependency, Origin, manifest, quoted};
use crate::toolbox::{Support, register_supported};

#[derive(Clone, Debug)]
pub struct LinkOptions {
    /// The name of the package and of its program.
    pub package: String,
    /// The source of the `afp` crates.
    pub origin: Origin,
    /// The path of the robot's type; the Carbot if `None`.
    pub robot: Option<String>,
    /// The path of the hardware robot's type, for the command line.
    pub hardware: Option<String>,
    /// The toolboxes: the name in `use`, and the path of the module with `templates`.
    pub toolboxes: Vec<(String, String)>,
    /// The crates of the robot and of the toolboxes.
    pub dependencies: Vec<Dependency>,
    /// The features of the command line, if it is linked.
    pub features: Vec<String>,
}

/// Packages of the command line that a run spends no time in, with their levels of optimisation, as
/// in this workspace's manifest.
const LEVELS: [(&str, u8); 7] = [
    ("annotate-snippets", 1),
    ("clap_builder", 1),
    ("image", 0),
    ("moxcms", 0),
    ("pxfm", 0),
    ("saphyr-parser", 1),
    ("spade", 1),
];
/// The packages and levels of its feature `png`.
const LEVELS_OF_PNG: [(&str, u8); 9] = [
    ("fontdb", 1),
    ("harfrust", 1),
    ("image-webp", 0),
    ("kurbo", 1),
    ("read-fonts", 0),
    ("resvg", 1),
    ("skrifa", 0),
    ("svgtypes", 1),
    ("usvg", 1),
];

/// The files of a runner: path below its folder, and text. `declared` are the toolboxes'
/// declarations, in their order.
///
/// # Errors
/// A path that is invalid in Rust; it is returned.
pub fn runner_files(
    options: &LinkOptions,
    declared: &[&Toolbox],
) -> Result<Vec<(String, String)>, String> {
    let ours = Dependency::ours("afpc", &options.origin).with_only(&options.features);
    let dependencies = dependencies(options, ours);
    let png = options.features.iter().any(|feature| feature == "png");
    let of_png = if png { &LEVELS_OF_PNG[..] } else { &[] };
    let profile = profile(options, LEVELS.iter().chain(of_png));
    let manifest = manifest(" run' as a runner", &options.package, dependencies, &profile);
    Ok(vec![
        ("Cargo.toml".to_owned(), manifest),
        ("src/main.rs".to_owned(), program(options, declared)?),
    ])
}

/// The files of a Python extension, like [`runner_files`].
///
/// # Errors
/// A path that is invalid in Rust; it is returned.
pub fn extension_files(
    options: &LinkOptions,
    declared: &[&Toolbox],
) -> Result<Vec<(String, String)>, String> {
    let ours = Dependency::ours("afp-py", &options.origin);
    // The Carbot is a feature.
    let ours = if options.robot.is_some() { ours.with_only(&[]) } else { ours };
    let library = format!("[lib]\ncrate-type = [\"cdylib\"]\n\n{}", profile(options, []));
    let manifest =
        manifest("' for Python", &options.package, dependencies(options, ours), &library);
    Ok(vec![
        ("Cargo.toml".to_owned(), manifest),
        ("build.rs".to_owned(), build_script()),
        ("src/lib.rs".to_owned(), extension(options, declared)?),
    ])
}

/// Plans are interpreted, so a short build matters most. The project's own crates have line
/// numbers, for finding a panic.
fn profile<'l>(
    options: &LinkOptions,
    levels: impl IntoIterator<Item = &'l (&'l str, u8)>,
) -> String {
    let levels = levels.into_iter().map(|(name, level)| (*name, format!("opt-level = {level}")));
    let own = options.dependencies.iter().map(|own| &*own.package);
    let own = own.map(|package| (package, "debug = \"line-tables-only\"".to_owned()));
    // One section for each package; a project's package with the same name wins.
    let sections: BTreeMap<&str, String> = levels.chain(own).collect();
    let mut profile = "[profile.release]\nlto = \"off\"\n".to_owned();
    for (package, line) in sections {
        profile += &format!("[profile.release.package.{}]\n{line}\n", quoted(package));
    }
    profile
}

fn dependencies(options: &LinkOptions, ours: Dependency) -> Vec<Dependency> {
    let mut dependencies = options.dependencies.clone();
    dependencies.push(ours);
    if options.robot.is_some() || options.hardware.is_some() {
        let built_in = ["afp-carbot", "afp-std"];
        dependencies.extend(built_in.map(|name| Dependency::ours(name, &options.origin)));
    }
    dependencies
}

/// The description of the linked parts, for the heads of files.
fn about(options: &LinkOptions) -> String {
    let names = options.toolboxes.iter().map(|(name, _)| name).chain(&options.robot);
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// The code that registers templates.
struct Registering<'a> {
    options: &'a LinkOptions,
    /// The toolboxes' declarations, in their order.
    declared: &'a [&'a Toolbox],
    core: TokenStream,
    carbot: TokenStream,
}

impl Registering<'_> {
    /// A closure that registers the templates that a robot supports, including built-in toolboxes
    /// for a project's robot. A plan with another template is rejected by its name, which is
    /// clearer than the Rust compiler's error.
    fn on(&self, robot: Option<&str>) -> Result<TokenStream, String> {
        let platform = robot.map(tokens).transpose()?;
        // The Carbot's templates need its devices; another robot may have some of them.
        let built_in = platform.as_ref().map(|ty| {
            quote! {
                afp_std::register!(registry, #ty);
                afp_carbot::register!(registry, #ty);
            }
        });
        let platform = platform.unwrap_or_else(|| self.carbot.clone());
        let own = self.options.toolboxes.iter().zip(self.declared).map(|((_, path), toolbox)| {
            let support = Support {
                core: self.core.clone(),
                file: String::new(),
                module: tokens(path)?,
                registry: quote!(registry),
                platform: platform.clone(),
                traits: None,
            };
            let registered = register_supported(toolbox, &support);
            Ok(quote!(#registered;))
        });
        let own = own.collect::<Result<TokenStream, String>>()?;
        Ok(quote!(|registry| { #built_in #own }))
    }
}

fn program(options: &LinkOptions, declared: &[&Toolbox]) -> Result<String, String> {
    let about = format!(" The command line with {} linked in.", about(options));
    let (core, carbot) = (quote!(afpc::__private::afp_core), quote!(afpc::__private::Simulation));
    let register = Registering { options, declared, core, carbot };
    let made = register.on(options.robot.as_deref())?;
    let toolboxes = options.toolboxes.iter().map(|(name, _)| name);
    let (robot, own_robot) = match &options.robot {
        None => (quote!(afpc::carbot(#made)), quote!(None)),
        Some(name) => {
            let ty = tokens(name)?;
            (quote!(afpc::simulated::<#ty, _>(#made)), quote!(Some(#name)))
        }
    };
    let (opener, hardware) = match (&options.robot, &options.hardware) {
        (Some(sim), Some(name)) => {
            let (sim, ty) = (tokens(sim)?, tokens(name)?);
            let made = register.on(Some(name))?;
            let opener = quote!(let hardware = afpc::hardware::<#sim, #ty, _>(#made););
            (opener, quote!(Some((#name, &hardware))))
        }
        (None, Some(name)) => {
            let ty = tokens(name)?;
            let made = register.on(Some(name))?;
            let opener = quote!(let hardware = afpc::only_hardware::<#ty, _>(#made););
            (opener, quote!(Some((#name, &hardware))))
        }
        (_, None) => (TokenStream::new(), quote!(None)),
    };
    Ok(file(quote! {
        #![doc = #about]
        use std::process::ExitCode;

        use afpc::Linked;

        fn main() -> ExitCode {
            let robot = #robot;
            #opener
            afpc::main(&Linked {
                robot: &robot,
                own_robot: #own_robot,
                hardware: #hardware,
                toolboxes: &[#(#toolboxes),*],
            })
        }
    }))
}

fn extension(options: &LinkOptions, declared: &[&Toolbox]) -> Result<String, String> {
    let about =
        format!(" The native half of the Python package with {} linked in.", about(options));
    let (core, carbot) =
        (quote!(afp_py::__private::afp_core), quote!(afp_py::__private::Simulation));
    let register = Registering { options, declared, core, carbot };
    let register = register.on(options.robot.as_deref())?;
    let toolboxes = options.toolboxes.iter().map(|(name, _)| name);
    let toolboxes = quote!(&[#(#toolboxes),*]);
    let link = match &options.robot {
        None => quote!(afp_py::carbot(#toolboxes, #register)),
        Some(name) => {
            let ty = tokens(name)?;
            quote!(afp_py::linked::<#ty>(#name, #toolboxes, #register))
        }
    };
    Ok(file(quote! {
        #![doc = #about]
        use afp_py::pyo3::prelude::*;

        #[pymodule]
        #[pyo3(crate = "afp_py::pyo3")]
        fn _afp(module: &Bound<'_, PyModule>) -> PyResult<()> {
            afp_py::fill(module, #link)
        }
    }))
}

/// Lets the linker on macOS resolve Python's symbols at run time.
fn build_script() -> String {
    file(quote! {
        #![doc = " Python's symbols are missing when the extension is linked."]
        fn main() {
            if std::env::var("CARGO_CFG_TARGET_VENDOR").is_ok_and(|vendor| vendor == "apple") {
                println!("cargo::rustc-cdylib-link-arg=-undefined");
                println!("cargo::rustc-cdylib-link-arg=dynamic_lookup");
            }
        }
    })
}

fn tokens(path: &str) -> Result<TokenStream, String> {
    path.parse().map_err(|_| path.to_owned())
}

#[cfg(test)]
mod tests {
    use super::{LEVELS, LEVELS_OF_PNG, LinkOptions, Origin, runner_files};
    use crate::manifest::{Dependency, Features};

    #[test]
    fn packages_have_the_workspaces_optimisation() {
        let workspace = include_str!("../../../Cargo.toml");
        for (package, level) in LEVELS.iter().chain(&LEVELS_OF_PNG) {
            let said = format!("[profile.release.package.{package}]\nopt-level = {level}\n");
            assert!(workspace.contains(&said), "'{said}' is not in Cargo.toml");
        }
    }

    #[test]
    fn a_robot_without_a_simulation_is_linked_as_hardware() {
        let options = LinkOptions {
            package: "afp-runner".to_owned(),
            origin: Origin::Version("0.1.0".to_owned()),
            robot: None,
            hardware: Some("arm::Board".to_owned()),
            toolboxes: Vec::new(),
            dependencies: Vec::new(),
            features: Vec::new(),
        };
        let files = runner_files(&options, &[]).expect("the path is that of a type");
        let (manifest, program) = (&files[0].1, &files[1].1);
        assert!(manifest.contains("afp-carbot") && manifest.contains("afp-std"), "{manifest}");
        assert!(program.contains("afpc::only_hardware::<"), "{program}");
        assert!(program.contains("own_robot: None"), "{program}");
    }

    #[test]
    fn every_package_has_one_section_in_the_profile() {
        let path = Origin::Path("/robots".to_owned());
        let own = |key: &str, package: &str| Dependency {
            key: key.to_owned(),
            package: package.to_owned(),
            origin: path.clone(),
            features: Features::Default,
        };
        let options = LinkOptions {
            package: "afp-runner".to_owned(),
            origin: Origin::Version("0.1.0".to_owned()),
            robot: Some("mole::Mole".to_owned()),
            hardware: None,
            toolboxes: vec![("mole".to_owned(), "mole".to_owned())],
            dependencies: vec![own("mole", "mole"), own("tools", "mole"), own("image", "image")],
            features: vec!["png".to_owned()],
        };
        let files = runner_files(&options, &[]).expect("the paths are those of modules");
        let (_, manifest) = &files[0];
        let sections: Vec<_> =
            manifest.lines().filter(|line| line.starts_with("[profile.release.package")).collect();
        let mut once = sections.clone();
        once.dedup();
        assert_eq!(sections, once);
        let own = "[profile.release.package.\"image\"]\ndebug = \"line-tables-only\"\n";
        assert!(manifest.contains(own), "{manifest}");
    }
}
