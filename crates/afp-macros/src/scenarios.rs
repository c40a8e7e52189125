//! A test for each scenario of some files.

use std::collections::HashSet;
use std::fs;
use std::path::Path;

use afp_dsl::graph::Graph;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::{LitStr, Path as RustPath, Token, Type};

use crate::{error, errors, sources};

/// `"file or folder" [, robot = type] [, path of a function that registers templates]...`.
pub struct Input {
    path: String,
    /// The robot; without one it is the Carbot.
    robot: Option<Type>,
    register: Vec<RustPath>,
}

impl Parse for Input {
    fn parse(input: ParseStream<'_>) -> syn::Result<Self> {
        let path = input.parse::<LitStr>()?.value();
        let (mut robot, mut register) = (None, Vec::new());
        while input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            if !input.peek2(Token![=]) {
                register.push(input.call(RustPath::parse_mod_style)?);
                continue;
            }
            let word: Ident = input.parse()?;
            if word != "robot" || robot.is_some() {
                return Err(syn::Error::new(word.span(), "expected one 'robot = Type'"));
            }
            input.parse::<Token![=]>()?;
            robot = Some(input.parse()?);
        }
        Ok(Input { path, robot, register })
    }
}

/// The tests, in a module for each file.
///
/// # Errors
/// Compile errors: no scenarios, a file that cannot be read or is wrong.
pub fn tests(input: &Input) -> Result<TokenStream, TokenStream> {
    let mut files = Vec::new();
    collect(&input.path, &mut files).map_err(|text| error(&text))?;
    let mut taken = HashSet::new();
    let mut modules = TokenStream::new();
    for file in &files {
        if let Some(tests) = of_file(file, input)? {
            let name = free(&slug(file.trim_end_matches(".afp")), &mut taken);
            modules.extend(quote! { mod #name { #tests } });
        }
    }
    match modules.is_empty() {
        true => Err(error(&format!("error: there are no scenarios in '{}'", input.path))),
        false => Ok(modules),
    }
}

/// The `.afp` files that a path means, seen from the manifest's folder.
fn collect(path: &str, files: &mut Vec<String>) -> Result<(), String> {
    let full = sources::root().join(path);
    if !full.is_dir() {
        files.push(path.to_owned());
        return Ok(());
    }
    let unread = |error| format!("error: cannot read '{}': {error}", full.display());
    let entries = fs::read_dir(&full).map_err(unread)?;
    let mut names: Vec<_> = entries
        .filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()))
        .collect();
    names.sort();
    for name in names {
        let path = format!("{}/{name}", path.trim_end_matches('/'));
        if sources::root().join(&path).is_dir() || name.ends_with(".afp") {
            collect(&path, files)?;
        }
    }
    Ok(())
}

/// The tests of one file; `None` when it has no scenarios.
fn of_file(path: &str, input: &Input) -> Result<Option<TokenStream>, TokenStream> {
    let file = sources::read(path).map_err(|text| error(&text))?;
    if !file.source.text.lines().any(|line| line.trim_start().starts_with("scenario ")) {
        return Ok(None);
    }
    let available = sources::toolboxes(&[]).map_err(|text| error(&text))?;
    let compiled = afp_dsl::compile(&file.source, &available.toolboxes, &sources::used());
    if compiled.graph.is_none() && compiled.unsound.is_empty() {
        return Err(errors(&compiled.diags, &compiled.sources));
    }
    let full = sources::root().join(Path::new(path)).to_string_lossy().into_owned();
    let mut taken = HashSet::new();
    let tests = compiled.scenarios.iter().map(|scenario| {
        let (name, title) = (free(&slug(&scenario.name), &mut taken), &scenario.name);
        let robot = robot(input, &scenario.graph);
        quote! {
            #[test]
            fn #name() {
                let robot = #robot;
                ::afp_test::check(::std::path::Path::new(#full), #title, &robot);
            }
        }
    });
    let tests: TokenStream = tests.collect();
    // A scenario that is wrong, or that its plan cannot meet any more, is a test that fails.
    let unsound = compiled.unsound.iter().map(|each| {
        let name = free(&slug(&each.name), &mut taken);
        let text = format!("\n{}", each.errors.render(&compiled.sources, false));
        quote! {
            #[test]
            fn #name() {
                panic!("{}", #text);
            }
        }
    });
    let unsound: TokenStream = unsound.collect();
    let texts = compiled.plan_sources().map(|source| sources::included(&source.name));
    let texts: Vec<_> = texts.chain(available.texts).collect();
    // Cargo watches the files only because something includes them.
    Ok(Some(quote! {
        #tests
        #unsound
        const _: &[&str] = &[#(#texts),*];
    }))
}

/// The expression of the robot with the templates that a plan may use.
fn robot(input: &Input, plan: &Graph) -> TokenStream {
    let register = &input.register;
    let Some(robot) = &input.robot else {
        return quote! {
            ::afp_sim::carbot(|registry| {
                let _ = &registry;
                #(#register(registry);)*
            })
        };
    };
    let toolboxes = plan.toolboxes.iter().map(|toolbox| {
        let built_in = afp_toolboxes::ALL.iter().any(|each| each.rust_path == toolbox.rust_path);
        let path: TokenStream = toolbox.rust_path.parse().unwrap_or_default();
        match built_in {
            true => quote!(::#path::register!(registry, #robot);),
            false => quote!(#path::templates::register(registry);),
        }
    });
    quote! {
        ::afp_session::simulated::<#robot, _>(|registry| {
            let _ = &registry;
            #(#toolboxes)*
            #(#register(registry);)*
        })
    }
}

/// A text as a name in Rust.
fn slug(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let slug: String = text.chars().map(plain).collect();
    let words: Vec<_> = slug.split('_').filter(|word| !word.is_empty()).collect();
    words.join("_")
}

/// The name, with a number behind it where it is taken or could not be one.
fn free(name: &str, taken: &mut HashSet<String>) -> Ident {
    let digit = name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty();
    let name = if digit { format!("n{name}") } else { name.to_owned() };
    let numbered = (2_u32..).map(|number| format!("{name}_{number}"));
    let mut names = std::iter::once(name.clone()).chain(numbered);
    let free = names.find(|name| taken.insert(name.clone())).unwrap_or(name);
    match syn::parse_str::<Ident>(&free) {
        Ok(ident) => ident,
        Err(_) => Ident::new(&format!("{free}_"), Span::call_site()),
    }
}
