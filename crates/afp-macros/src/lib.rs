//! The macros `toolbox!` and `plan!`: files looked up, `afp-dsl` asked, its answer handed on.
//!
//! Both emit `include_str!` of the files they read, so an edit rebuilds. Every diagnostic becomes
//! a compile error of its own, rendered as `afpc check` renders it.

mod input;
mod register;
mod scenarios;
mod sources;
#[cfg(test)]
mod tests;

use std::collections::HashSet;

use afp_codegen::{Asked, Options, complete};
use afp_dsl::toolbox::Toolbox;
use afp_syntax::diagnostics::{Diagnostics, Severity};
use afp_syntax::source::Sources;
use proc_macro2::{Group, Span, TokenStream, TokenTree};
use quote::quote;

use input::Input;

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

/// Turns the first plan of a file, with the sub-plans it uses, into native code.
///
/// `plan!("plans/wall_following.afp")` takes a path relative to the crate's manifest. It makes a
/// module for each plan and brings the plan's type into scope. Toolboxes that are not built in are
/// those of the project file `afp.toml`, which stands beside the manifest or above; others follow:
/// `plan!("x.afp", toolboxes = { "gripper.afp" => crate::gripper })`.
#[proc_macro]
pub fn plan(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    expand(input.into(), plan_code).into()
}

/// Registers the templates of a toolbox that a platform supports; crates of toolboxes wrap it in a macro of their own.
#[doc(hidden)]
#[proc_macro]
pub fn register(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse::<register::Input>(input).map_err(|error| error.into_compile_error());
    input.and_then(|input| register::statements(&input)).unwrap_or_else(|error| error).into()
}

/// Makes a test of each scenario of a file or of the files of a folder.
///
/// `scenarios!("plans/tests")` takes a path relative to the crate's manifest; behind it may stand what
/// registers the templates of toolboxes of one's own: `scenarios!("tests", gripper::templates::register)`, or a robot:
/// `scenarios!("tests", robot = vacuum::Vacuum)`.
#[proc_macro]
pub fn scenarios(input: proc_macro::TokenStream) -> proc_macro::TokenStream {
    let input = syn::parse::<scenarios::Input>(input).map_err(|error| error.into_compile_error());
    input.and_then(|input| scenarios::tests(&input)).unwrap_or_else(|error| error).into()
}

fn expand(input: TokenStream, make: fn(&Input) -> Result<TokenStream, TokenStream>) -> TokenStream {
    match syn::parse2::<Input>(input) {
        Err(error) => error.into_compile_error(),
        Ok(input) => {
            let made = make(&input).unwrap_or_else(|error| error);
            // Else what is wrong with the Rust beside the macro would be shown inside of `afp`.
            located(made, Span::call_site().located_at(input.span))
        }
    }
}

/// The tokens as if they stood at a place; `$crate` means what it meant.
fn located(tokens: TokenStream, at: Span) -> TokenStream {
    let each = tokens.into_iter().map(|mut token| {
        match &mut token {
            TokenTree::Group(group) => {
                let mut inner = Group::new(group.delimiter(), located(group.stream(), at));
                inner.set_span(at);
                *group = inner;
            }
            TokenTree::Ident(ident) if ident == "$crate" => {}
            token => token.set_span(at),
        }
        token
    });
    each.collect()
}

fn toolbox_code(input: &Input) -> Result<TokenStream, TokenStream> {
    let (mut toolbox, errors, file) = read_toolbox(&input.path)?;
    let mut names = HashSet::new();
    toolbox.templates.retain(|template| names.insert(template.name.clone()));
    let options = Options { core: input.core.clone(), source: file.text };
    let code = afp_codegen::code(afp_codegen::toolbox(&toolbox, &options));
    // Of a broken toolbox, whatever is missing follows from what is wrong with it.
    let nothing = Asked::Traits(TokenStream::new());
    let asked = input.robot.as_ref().unwrap_or(&nothing);
    let complete = errors.is_empty().then(|| complete(&input.core, &toolbox, asked));
    Ok(quote!(#errors #code #complete))
}

/// What a toolbox file declares, what is wrong with it, and the file.
fn read_toolbox(path: &str) -> Result<(Toolbox, TokenStream, sources::File), TokenStream> {
    let file = sources::toolbox(path).map_err(|text| error(&text))?;
    let mut sources = Sources::default();
    let index = sources.add(std::sync::Arc::new(file.source.clone())).unwrap_or(0);
    let (toolbox, diags) = Toolbox::parse_broken(&file.source, index, "crate");
    let errors = errors(&diags, &sources);
    Ok((toolbox.ok_or_else(|| errors.clone())?, errors, file))
}

fn plan_code(input: &Input) -> Result<TokenStream, TokenStream> {
    let file = sources::read(&input.path).map_err(|text| error(&text))?;
    let available = sources::toolboxes(&input.toolboxes).map_err(|text| error(&text))?;
    let compiled = afp_dsl::compile(&file.source, &available.toolboxes, &sources::used());
    let plans = compiled.plan_sources().map(|source| sources::included(&source.name));
    let texts: Vec<_> = plans.chain(available.texts).collect();
    let graph = compiled.graph.ok_or_else(|| errors(&compiled.diags, &compiled.sources))?;
    for (name, why) in &available.without_crate {
        if graph.toolboxes.iter().any(|toolbox| toolbox.name == *name) {
            return Err(error(why));
        }
    }
    let options = Options { core: input.core.clone(), ..Options::default() };
    let plan = afp_codegen::code(afp_codegen::plan(&graph, &options).tokens());
    // Cargo watches the files only because something includes them.
    Ok(quote! {
        #plan
        const _: &[&str] = &[#(#texts),*];
    })
}

/// A compile error for each error among the diagnostics.
fn errors(diags: &Diagnostics, sources: &Sources) -> TokenStream {
    let mut all = TokenStream::new();
    for diagnostic in diags.iter().filter(|d| d.severity == Severity::Error) {
        let mut one = Diagnostics::default();
        one.push(diagnostic.clone());
        all.extend(error(&one.render(sources, false)));
    }
    all
}

fn error(text: &str) -> TokenStream {
    let text = format!("\n{text}");
    quote!(::core::compile_error! { #text })
}
