//! Addresses of documents, as the protocol has them.

use gen_lsp_types::Uri;

pub use afp_dsl::files::{path_of, uri_of};

/// The scheme of built-in toolboxes, which have no file.
pub(crate) const BUILT_IN: &str = "afp:";

pub(crate) fn path(uri: &Uri) -> String {
    path_of(&uri.0)
}

pub(crate) fn uri(path: &str) -> Uri {
    Uri(uri_of(path))
}
