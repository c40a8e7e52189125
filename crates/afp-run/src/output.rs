//! Outputs of a run, with errors that say what could not be written.

use std::path::Path;

use crate::error::RunError;

/// Writes a file that appears under its name only when it is whole.
///
/// # Errors
/// As of [`afp_output::write_whole`].
pub fn write_whole(
    what: &'static str,
    path: &Path,
    bytes: impl AsRef<[u8]>,
) -> Result<(), RunError> {
    afp_output::write_whole(path, bytes.as_ref()).map_err(RunError::file(what, path))
}

/// Finds out early whether a file can be written later.
///
/// # Errors
/// As of [`afp_output::check_writable`].
pub fn check_writable(what: &'static str, path: &Path) -> Result<(), RunError> {
    afp_output::check_writable(path).map_err(RunError::file(what, path))
}
