//! Addresses of documents, as the protocol has them.

use gen_lsp_types::Uri;

pub use afp_dsl::files::{path_of, uri_of};

/// The scheme of built-in toolboxes that lie in no file.
pub(crate) const BUILT_IN: &str = "afp:";

/// The path that an address stands for.
pub(crate) fn path(uri: &Uri) -> String {
    path_of(&uri.0)
}

/// The address of a path.
pub(crate) fn uri(path: &str) -> Uri {
    Uri(uri_of(path))
}
