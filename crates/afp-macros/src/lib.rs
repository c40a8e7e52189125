//! The macros `toolbox!`, `plan!` and `scenarios!`: files looked up, `afp-dsl` asked, what `afp-codegen` makes of the
//! answer handed on.
//!
//! All emit `include_str!` of the files they read, so an edit rebuilds. Every diagnostic becomes
//! a compile error of its own, rendered as `afpc check` renders it.
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
/// `toolbox!("carbot.afp")` takes a path relative to the crate's manifest, or the name of a built-in
/// toolbox file. It belongs into a module `templates` beside the types that implement the
/// templates under the templates' names.
///
/// Behind the path stands what the templates ask of a robot, as traits: `toolbox!("signals.afp", robot: super::Lights)`;
/// nothing where they ask for nothing, `robot = Bench` where they are implemented for one type alone. A template that is
/// declared and not implemented for such a robot does not compile.
#[proc_macro]
pub fn toolbox(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), toolbox_code).into()
}

/// Turns a plan of a file, with the sub-plans it uses, into native code.
///
/// `plan!("plans/wall_following.afp")` takes a path relative to the crate's manifest, with the name of a plan behind a
/// colon another one than the first: `plan!("plans/patrol.afp:Search")`. It makes a module for each plan and brings the
/// plan's type into scope. Toolboxes that are not built in are those of the project file `afp.toml`, which stands beside
/// the manifest or above; others follow: `plan!("x.afp", toolboxes = { "gripper.afp" => crate::gripper })`.
#[proc_macro]
pub fn plan(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), plan_code).into()
}

/// Registers the templates of a toolbox that a platform supports; crates of toolboxes wrap it in a macro of their own.
#[doc(hidden)]
#[proc_macro]
pub fn register(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), register_code).into()
}

/// Makes a test of each scenario of a file or of the files of a folder.
///
/// `scenarios!("plans/tests")` takes a path relative to the crate's manifest; behind it may stand what
/// registers the templates of toolboxes of one's own: `scenarios!("tests", gripper::templates::register)`, or a robot:
/// `scenarios!("tests", robot = vacuum::Vacuum)`.
#[proc_macro]
pub fn scenarios(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), scenarios_code).into()
}

/// What the input makes, or what is wrong with it.
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
        let options = Options { core: input.core.clone(), source: file.text };
        let code = afp_codegen::code(afp_codegen::toolbox(&toolbox, &options));
        // Of a broken toolbox, whatever is missing follows from what is wrong with it.
        let nothing = Asked::Traits(TokenStream::new());
        let asked = input.robot.as_ref().unwrap_or(&nothing);
        let complete = errors.is_empty().then(|| complete(&input.core, &toolbox, asked));
        quote!(#errors #code #complete)
    });
    input.located(made)
}

/// What a toolbox file declares, what is wrong with it, and the file.
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
    // Cargo watches the files only because something includes them.
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
    // A file that gets its first scenario is watched before.
    Ok(quote!(#modules const _: &[&str] = &[#(#without),*];))
}
