//! Writes a generated crate into its folder.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use afp_codegen::{MADE_BY, Origin};
use afp_run::{RunError, write_whole};

/// Writes the files that differ from what is there, so that cargo builds only what changed, and
/// removes sources of an earlier plan.
///
/// # Errors
/// The folder holds a crate that somebody else made, or other files of the same names, or cannot be written.
pub fn write(folder: &Path, files: &[(&str, &str)], origin: &Origin) -> Result<(), RunError> {
    let manifest = folder.join("Cargo.toml");
    match fs::read_to_string(&manifest) {
        Ok(text) if !text.starts_with(MADE_BY) => {
            return Err(RunError::usage(
                format!("'{}' holds a crate that 'afpc' did not make", folder.display()),
                "give an empty folder with '-o DIR'",
            ));
        }
        Ok(_) => remove_old(folder, files)?,
        Err(error) if error.kind() == ErrorKind::NotFound => leave_alone(folder, files)?,
        Err(error) => return Err(RunError::file("cannot read", &manifest)(error)),
    }
    for (name, text) in files {
        let path = folder.join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(RunError::file("cannot make the folder", parent))?;
        }
        if fs::read_to_string(&path).is_ok_and(|old| old == *text) {
            continue;
        }
        write_whole("cannot write", &path, text)?;
    }
    pin(folder, origin).map(drop)
}

/// Writes down the versions that the checkout was tested with: another physics engine drives other paths. Gives the
/// file's name where it was written.
///
/// # Errors
/// The folder cannot be written.
pub fn pin(folder: &Path, origin: &Origin) -> Result<Option<&'static str>, RunError> {
    const LOCK: &str = "Cargo.lock";
    let (Origin::Path(root), lock) = (origin, folder.join(LOCK)) else { return Ok(None) };
    match fs::read_to_string(Path::new(root).join(LOCK)) {
        Ok(text) if !lock.exists() => {
            write_whole("cannot write", &lock, &text)?;
            Ok(Some(LOCK))
        }
        // Without it cargo chooses versions by the manifests.
        _ => Ok(None),
    }
}

/// Refuses a folder without a manifest in which others keep something under a name that the crate would take.
fn leave_alone(folder: &Path, files: &[(&str, &str)]) -> Result<(), RunError> {
    let others = |(name, text): &&(&str, &str)| {
        let path = folder.join(name);
        path.exists() && fs::read_to_string(path).ok().as_deref() != Some(*text)
    };
    match files.iter().find(others) {
        None => Ok(()),
        Some((name, _)) => Err(RunError::usage(
            format!("'{}' is there, and 'afpc' did not make it", folder.join(name).display()),
            "give an empty folder with '-o DIR'",
        )),
    }
}

fn remove_old(folder: &Path, files: &[(&str, &str)]) -> Result<(), RunError> {
    let sources = folder.join("src");
    let Ok(entries) = fs::read_dir(&sources) else { return Ok(()) };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let kept = files.iter().any(|(name, _)| folder.join(name) == path);
        if !kept && path.extension().is_some_and(|extension| extension == "rs") {
            fs::remove_file(&path).map_err(RunError::file("cannot remove", &path))?;
        }
    }
    Ok(())
}
