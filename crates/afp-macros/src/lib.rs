//! The macros `toolbox!`, `plan!` and `scenarios!`: they find the files, compile them with
//! `afp-dsl`, and generate code with `afp-codegen`.
//!
//! All emit `include_str!` of the files they read, so an edit rebuilds. Every diagnostic becomes a
//! separate compile error, in the format of `afpc check`.
#![warn(missing_docs)]

mod sources;
#[cfg(test)]
mod tests;

use std::collections::HashSet;
use std::sync::Arc;

use afp_codegen::{
    Asked, MacroInput, Options, ScenarioSetting, ScenarioTests, Support, compile_error,
    compile_errors, complete, register_supported,
};
use afp_dsl::toolbox::Toolbox;
use afp_syntax::may_have_scenario;
use afp_syntax::source::Sources;
use proc_macro2::TokenStream;
use quote::quote;
use syn::parse::Parse;

use sources::{Available, File};

/// Turns a toolbox file into typed templates.
///
/// `toolbox!("carbot.afp")` takes a path relative to the crate's manifest, or the name of a
/// built-in toolbox file. Use it in a module `templates` next to the types that implement the
/// templates under the templates' names.
///
/// After the path, write the templates' requirements for a robot, as traits:
/// `toolbox!("signals.afp", robot: super::Lights)`. Write nothing if there are no requirements, or
/// `robot = Bench` if only one type is supported. A declared template without an implementation for
/// such a robot does not compile.
#[proc_macro]
pub fn toolbox(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), toolbox_code).into()
}

/// Turns a plan of a file, with its sub-plans, into native code.
///
/// `plan!("plans/wall_following.afp")` takes a path relative to the crate's manifest. A name after
/// a colon selects another plan than the first: `plan!("plans/patrol.afp:Search")`. It generates a
/// module for each plan and brings the plan's type into scope. Other toolboxes than the built-in
/// ones come from the project file `afp.toml`, in the manifest's folder or above. More can follow:
/// `plan!("x.afp", toolboxes = { "gripper.afp" => crate::gripper })`.
#[proc_macro]
pub fn plan(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), plan_code).into()
}

/// Registers the templates of a toolbox that a platform supports; toolbox crates wrap it in their
/// own macro.
#[doc(hidden)]
#[proc_macro]
pub fn register(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), register_code).into()
}

/// Generates a test from each scenario of a file or of a folder's files.
///
/// `scenarios!("plans/tests")` takes a path relative to the crate's manifest. Functions that
/// register the templates of other toolboxes can follow: `scenarios!("tests",
/// gripper::templates::register)`. So can a robot: `scenarios!("tests", robot = vacuum::Vacuum)`.
#[proc_macro]
pub fn scenarios(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), scenarios_code).into()
}

/// The generated code, or the errors.
fn expand<I: Parse>(
    input: TokenStream,
    make: fn(I) -> Result<TokenStream, TokenStream>,
) -> TokenStream {
    let input = syn::parse2(input).map_err(syn::Error::into_compile_error);
    input.and_then(make).unwrap_or_else(|wrong| wrong)
}

fn toolbox_code(input: MacroInput) -> Result<TokenStream, TokenStream> {
    let made = read_toolbox(&input.path).map(|(mut toolbox, errors, file)| {
        let mut names = HashSet::new();
        toolbox.templates.retain(|template| names.insert(template.name.clone()));
        let options = Options { core: input.core.clone(), source: file.text, ..Options::default() };
        let code = afp_codegen::code(afp_codegen::toolbox(&toolbox, &options));
        // In a broken toolbox, missing templates are consequences of its errors.
        let nothing = Asked::Traits(TokenStream::new());
        let asked = input.robot.as_ref().unwrap_or(&nothing);
        let complete = errors.is_empty().then(|| complete(&input.core, &toolbox, asked));
        quote!(#errors #code #complete)
    });
    input.located(made)
}

/// A toolbox file's declarations, diagnostics, and the file.
fn read_toolbox(path: &str) -> Result<(Toolbox, TokenStream, File), TokenStream> {
    let file = sources::toolbox(path)?;
    let mut sources = Sources::default();
    let index = sources.add(Arc::new(file.source.clone())).unwrap_or(0);
    let (toolbox, diags) = Toolbox::parse_broken(&file.source, index, "crate");
    let errors = compile_errors(&diags, &sources);
    Ok((toolbox.ok_or_else(|| errors.clone())?, errors, file))
}

fn plan_code(input: MacroInput) -> Result<TokenStream, TokenStream> {
    input.located(plan_tokens(&input))
}

fn plan_tokens(input: &MacroInput) -> Result<TokenStream, TokenStream> {
    let (file, plan) = sources::read_plan(&input.path)?;
    let (compiled, Available { texts, without_crate, .. }) =
        sources::compile(&file, plan, &input.toolboxes)?;
    let wrong = || compile_errors(&compiled.diags, &compiled.sources);
    let graph = compiled.graph.as_ref().ok_or_else(wrong)?;
    for (name, why) in &without_crate {
        if graph.toolboxes.iter().any(|toolbox| toolbox.name == *name) {
            return Err(compile_error(why));
        }
    }
    let options = Options { core: input.core.clone(), ..Options::default() };
    let plan = afp_codegen::code(afp_codegen::plan(graph, &options).tokens());
    // Cargo only watches included files.
    Ok(quote! {
        #plan
        const _: &[&str] = &[#(#texts),*];
    })
}

fn register_code(support: Support) -> Result<TokenStream, TokenStream> {
    let (toolbox, errors, _) = read_toolbox(&support.file)?;
    if errors.is_empty() { Ok(register_supported(&toolbox, &support)) } else { Err(errors) }
}

fn scenarios_code(setting: ScenarioSetting) -> Result<TokenStream, TokenStream> {
    let is_built_in = |path: &str| afp_toolboxes::ALL.iter().any(|each| each.rust_path == path);
    let mut tests = ScenarioTests::new(&setting, is_built_in);
    let mut without = Vec::new();
    for path in sources::plan_files(&setting.path)? {
        let file = sources::read(&path)?;
        if !may_have_scenario(&file.source.text) {
            without.push(file.text);
            continue;
        }
        let (compiled, available) = sources::compile(&file, None, &[])?;
        if compiled.graph.is_none() && compiled.invalid.is_empty() {
            return Err(compile_errors(&compiled.diags, &compiled.sources));
        }
        let full = sources::root().join(&path).to_string_lossy().into_owned();
        tests.add(&path, &full, &compiled, &available.texts);
    }
    let none = || compile_error(&format!("error: there are no scenarios in '{}'", setting.path));
    let modules = tests.modules().ok_or_else(none)?;
    // A file is watched even before its first scenario.
    Ok(quote!(#modules const _: &[&str] = &[#(#without),*];))
}
