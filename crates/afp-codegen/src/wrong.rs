//! Diagnostics as errors of the Rust compiler.

use afp_syntax::diagnostics::{Diagnostics, Severity};
use afp_syntax::source::Sources;
use proc_macro2::TokenStream;
use quote::quote;

/// A compile error for each error in the diagnostics, in the format of `afpc check`.
pub fn compile_errors(diags: &Diagnostics, sources: &Sources) -> TokenStream {
    let errors = diags.iter().filter(|each| each.severity == Severity::Error);
    let errors = errors.map(|each| {
        let mut one = Diagnostics::default();
        one.push(each.clone());
        compile_error(&one.render(sources, false))
    });
    errors.collect()
}

pub fn compile_error(text: &str) -> TokenStream {
    let text = format!("\n{text}");
    quote!(::core::compile_error! { #text })
}
