//! Files that appear under their name only when they are whole.

use std::io::{ErrorKind, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::error::RunError;

/// Writes a file by way of a temporary one beside it.
///
/// # Errors
/// The folder is not there or not writable, the disk is full. No file of that name is left half
/// written then, and an old one stays as it was.
pub fn write_whole(
    what: &'static str,
    path: &Path,
    bytes: impl AsRef<[u8]>,
) -> Result<(), RunError> {
    let write = || {
        let mut file = NamedTempFile::new_in(folder(path))?;
        file.write_all(bytes.as_ref())?;
        allow_reading(&file)?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(RunError::file(what, path))
}

/// Finds out early whether a file can be written later.
///
/// # Errors
/// The folder is not there or not writable, or the name belongs to a folder.
pub(crate) fn check_writable(what: &'static str, path: &Path) -> Result<(), RunError> {
    let check = || match path.is_dir() {
        true => Err(ErrorKind::IsADirectory.into()),
        false => NamedTempFile::new_in(folder(path)).map(drop),
    };
    check().map_err(RunError::file(what, path))
}

/// The folder of a file.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Temporary files are private; what comes out of a run is an ordinary file.
#[cfg(unix)]
fn allow_reading(file: &NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn allow_reading(_: &NamedTempFile) -> std::io::Result<()> {
    Ok(())
}
