//! Enums of a file or toolbox.

use std::sync::Arc;

use crate::check::names::DeclaredNames;
use crate::check::size;
use crate::rows::MAX_ROWS;
use crate::types::Enum;
use afp_syntax::ast;
use afp_syntax::diagnostics::{Code, Diagnostic, Diagnostics};
use afp_syntax::message;

/// Reads an enum; `None` without a name.
pub(crate) fn read(
    node: &ast::Enum,
    toolbox: Option<&str>,
    diags: &mut Diagnostics,
) -> Option<Arc<Enum>> {
    let name = node.name()?;
    let mut variants = node.variants();
    let mut names = DeclaredNames::default();
    // Duplicates are reported once, not at each use of the enum.
    variants.retain(|variant| names.declare(variant, diags));
    let spans = variants.iter().map(|variant| variant.span);
    size::at_most(MAX_ROWS, ("an enum", "values"), spans, "split it into two enums", diags);
    if variants.is_empty() && !diags.error_within(node.span()) {
        diags.push(
            Diagnostic::new(
                Code::E0225,
                name.span,
                message!("the enum '{}' has no values", name.text),
            )
            .help("list at least one name in its braces"),
        );
    }
    Some(Arc::new(Enum {
        doc: node.doc(),
        toolbox: toolbox.map(str::to_owned),
        variant_spans: variants.iter().map(|variant| variant.span).collect(),
        variants: variants.into_iter().map(|variant| variant.text).collect(),
        span: name.span,
        name: name.text,
    }))
}
