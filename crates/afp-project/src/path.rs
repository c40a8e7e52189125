use std::path::{Path, PathBuf};

pub(crate) const NAME: &str = "afp.toml";

/// A path relative to the current folder if possible.
pub fn shown(path: &Path) -> PathBuf {
    let here = std::env::current_dir().ok();
    let below = here.and_then(|here| Some(path.strip_prefix(here).ok()?.to_owned()));
    below.unwrap_or_else(|| path.to_owned())
}
