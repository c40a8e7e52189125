//! The files of the page: embedded in the program, or in a debug build read from the checkout.

use std::borrow::Cow;

/// Returns a file of the page by name, with its content type.
pub(crate) fn file(name: &str) -> Option<(Cow<'static, [u8]>, &'static str)> {
    let kind = match name.rsplit_once('.')?.1 {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "map" | "json" => "application/json",
        _ => return None,
    };
    // Names without folders cannot leave the folder.
    let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_'));
    plain.then(|| bytes(name)).flatten().map(|bytes| (bytes, kind))
}

#[cfg(all(feature = "page", not(debug_assertions)))]
fn bytes(name: &str) -> Option<Cow<'static, [u8]>> {
    static DIST: include_dir::Dir<'_> =
        include_dir::include_dir!("$CARGO_MANIFEST_DIR/../../studio/dist");
    DIST.get_file(name).map(|file| Cow::Borrowed(file.contents()))
}

#[cfg(not(all(feature = "page", not(debug_assertions))))]
fn bytes(name: &str) -> Option<Cow<'static, [u8]>> {
    let made = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studio/dist");
    let folder = std::env::var_os("AFP_STUDIO_DIST").unwrap_or_else(|| made.into());
    std::fs::read(std::path::Path::new(&folder).join(name)).ok().map(Cow::Owned)
}
