//! Outputs of a run, with errors that name the output.

use std::path::{Path, PathBuf};

use crate::error::RunError;

/// Writes a file that appears under its name only when it is complete.
///
/// # Errors
/// As [`afp_output::write_whole`].
pub fn write_whole(
    what: &'static str,
    path: &Path,
    bytes: impl AsRef<[u8]>,
) -> Result<(), RunError> {
    afp_output::write_whole(path, bytes.as_ref()).map_err(RunError::file(what, path))
}

/// Checks in advance that a file can be written.
///
/// # Errors
/// As [`afp_output::check_writable`].
pub fn check_writable(what: &'static str, path: &Path) -> Result<(), RunError> {
    afp_output::check_writable(path).map_err(RunError::file(what, path))
}

/// Refuses an output that would overwrite an input or another output.
///
/// # Errors
/// The paths name one file.
pub fn check_apart<'a>(
    outputs: impl IntoIterator<Item = &'a Path>,
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), RunError> {
    let help = "give the output another name";
    let inputs: Vec<_> = inputs.into_iter().filter_map(place).collect();
    let mut known = Vec::new();
    for output in outputs {
        let (Some(place), shown) = (place(output), output.display()) else { continue };
        if inputs.contains(&place) {
            let message = format!("'{shown}' is an input, so it cannot be an output");
            return Err(RunError::usage(message, help));
        }
        if known.contains(&place) {
            return Err(RunError::usage(format!("'{shown}' is given for two outputs"), help));
        }
        known.push(place);
    }
    Ok(())
}

/// Whether two paths name one file, which need not exist.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    place(one).is_some_and(|one| place(other) == Some(one))
}

/// The canonical path of a file; `None` for a device or a pipe, which may be written twice.
fn place(path: &Path) -> Option<PathBuf> {
    if let Ok(real) = path.canonicalize() {
        return real.is_file().then_some(real);
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    Some(folder.unwrap_or(Path::new(".")).canonicalize().ok()?.join(path.file_name()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn outputs_differ_from_inputs_and_from_each_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("d")).unwrap();
        fs::write(path("a"), "").unwrap();
        let check = |outputs: &[&str]| {
            let outputs: Vec<_> = outputs.iter().map(|name| path(name)).collect();
            let checked = check_apart(outputs.iter().map(PathBuf::as_path), [&*path("a")]);
            checked.map_err(|error| error.code())
        };
        let refused = Err(crate::EXIT_USAGE);
        assert_eq!((check(&["b", "c"]), check(&["d", "/dev/null", "/dev/null"])), (Ok(()), Ok(())));
        assert_eq!((check(&["b", "a"]), check(&["d/../a"])), (refused, refused));
        assert_eq!((check(&["b", "d/../b"]), check(&["b", "d/b"])), (refused, Ok(())));
        assert!(is_same_file(&path("b"), &path("d/../b")) && !is_same_file(&path("a"), &path("b")));
    }
}
