//! Writes a generated crate into its folder.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use afp_codegen::{MADE_BY, Origin, RUST_MADE_BY};
use afp_run::{RunError, hash, write_whole};

const LOCK: &str = "Cargo.lock";
/// The hash of the checkout's lock file.
const LOCK_OF: &str = "locked";

/// Writes the crate of a plan into a folder that only AFP uses. Only changed files are written, so
/// that cargo builds only the changes. Sources of an earlier plan are removed.
///
/// # Errors
/// The folder cannot be written.
pub fn write_own(folder: &Path, files: &[(&str, &str)], origin: &Origin) -> Result<(), RunError> {
    remove_old(folder, files, |_| true)?;
    put_own(folder, files, origin)
}

/// Like [`write_own`], for a folder that the user chose; other files in it stay.
///
/// # Errors
/// The folder has a crate from another source, or other files of the same names, or cannot be
/// written.
pub fn write(folder: &Path, files: &[(&str, &str)], origin: &Origin) -> Result<(), RunError> {
    let manifest = folder.join("Cargo.toml");
    match fs::read_to_string(&manifest) {
        Ok(text) if !text.starts_with(MADE_BY) => {
            return Err(RunError::usage(
                format!("'{}' contains a crate that 'afpc' did not generate", folder.display()),
                "give an empty folder with '-o DIR'",
            ));
        }
        Ok(_) => {
            refuse_others(folder, files, is_made_here)?;
            remove_old(folder, files, is_made_here)?;
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            refuse_others(folder, files, |_| false)?;
        }
        Err(error) => return Err(RunError::file("cannot read", &manifest)(error)),
    }
    put(folder, files)?;
    pin(folder, origin).map(drop)
}

/// Writes the changed files into a folder that only AFP uses.
///
/// # Errors
/// The folder cannot be written.
pub(crate) fn put_own(
    folder: &Path,
    files: &[(&str, &str)],
    origin: &Origin,
) -> Result<(), RunError> {
    put(folder, files)?;
    pin_anew(folder, origin)
}

fn put(folder: &Path, files: &[(&str, &str)]) -> Result<(), RunError> {
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
    Ok(())
}

/// The lock file of the checkout; `None` without a checkout.
pub(crate) fn lock_of(origin: &Origin) -> Option<PathBuf> {
    match origin {
        Origin::Path(root) => Some(Path::new(root).join(LOCK)),
        Origin::Git(_) | Origin::Version(_) => None,
    }
}

/// Writes the checkout's lock file: another version of the physics engine drives other paths.
/// Returns the file's name if it was written.
///
/// # Errors
/// The folder cannot be written.
pub fn pin(folder: &Path, origin: &Origin) -> Result<Option<&'static str>, RunError> {
    let (Some(tested), lock) = (lock_of(origin), folder.join(LOCK)) else { return Ok(None) };
    match fs::read_to_string(tested) {
        Ok(text) if !lock.exists() => {
            write_whole("cannot write", &lock, &text)?;
            Ok(Some(LOCK))
        }
        // Without it, cargo chooses versions by the manifests.
        _ => Ok(None),
    }
}

/// Like [`pin`], for a folder that only AFP uses, and again after each change of the versions.
/// Cargo adds the crate's other dependencies to the file, so its source's hash is stored.
fn pin_anew(folder: &Path, origin: &Origin) -> Result<(), RunError> {
    let Some(text) = lock_of(origin).and_then(|tested| fs::read_to_string(tested).ok()) else {
        return Ok(());
    };
    let (lock, of, made_from) = (folder.join(LOCK), folder.join(LOCK_OF), hash(&text));
    let is_same = fs::read_to_string(&of).is_ok_and(|known| known == made_from);
    if !is_same || !lock.exists() {
        write_whole("cannot write", &lock, &text)?;
        write_whole("cannot write", &of, &made_from)?;
    }
    Ok(())
}

/// Whether an earlier build generated a file. Files other than Rust have no mark; for them, the
/// manifest decides.
fn is_made_here(path: &Path) -> bool {
    !is_rust(path) || fs::read_to_string(path).is_ok_and(|text| text.starts_with(RUST_MADE_BY))
}

fn is_rust(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "rs")
}

/// Refuses a folder with other files under the crate's names.
fn refuse_others(
    folder: &Path,
    files: &[(&str, &str)],
    is_ours: fn(&Path) -> bool,
) -> Result<(), RunError> {
    let others = |(name, text): &&(&str, &str)| {
        let path = folder.join(name);
        path.exists() && fs::read_to_string(&path).ok().as_deref() != Some(*text) && !is_ours(&path)
    };
    match files.iter().find(others) {
        None => Ok(()),
        Some((name, _)) => Err(RunError::usage(
            format!("'{}' exists, and 'afpc' did not generate it", folder.join(name).display()),
            "move it away, or give an empty folder with '-o DIR'",
        )),
    }
}

/// Removes the Rust files of an earlier plan.
fn remove_old(
    folder: &Path,
    files: &[(&str, &str)],
    is_ours: fn(&Path) -> bool,
) -> Result<(), RunError> {
    let sources = folder.join("src");
    let Ok(entries) = fs::read_dir(&sources) else { return Ok(()) };
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        let kept = files.iter().any(|(name, _)| folder.join(name) == path);
        if !kept && is_rust(&path) && is_ours(&path) {
            fs::remove_file(&path).map_err(RunError::file("cannot remove", &path))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const OURS: &str = "// Made by 'afpc build' from x.afp.\n";

    #[test]
    fn other_rust_files_are_not_removed_or_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let manifest = ("Cargo.toml", "# Made by 'afpc build' from x.afp.\n");
        let origin = Origin::Version("0.1.0".to_owned());
        let build = |files: &[(&str, &str)]| write(folder.path(), files, &origin);
        build(&[manifest, ("x.afp", "1"), ("src/lib.rs", OURS), ("src/old.rs", OURS)]).unwrap();
        fs::write(path("src/hardware.rs"), "//! Mine.\n").unwrap();
        let changed = format!("{OURS}//! Other.\n");
        build(&[manifest, ("x.afp", "2"), ("src/lib.rs", &changed)]).unwrap();
        let read = |name: &str| fs::read_to_string(path(name)).ok();
        assert_eq!(read("src/old.rs"), None);
        assert_eq!(read("src/hardware.rs").as_deref(), Some("//! Mine.\n"));
        assert_eq!(read("src/lib.rs"), Some(changed));
        assert_eq!(read("x.afp").as_deref(), Some("2"));
        let refused = build(&[manifest, ("src/hardware.rs", OURS)]).unwrap_err().to_string();
        assert!(
            refused.contains("src/hardware.rs' exists, and 'afpc' did not generate it"),
            "{refused}"
        );
        assert_eq!(read("src/hardware.rs").as_deref(), Some("//! Mine.\n"));
    }

    #[test]
    fn a_folder_of_builds_takes_the_new_versions_of_the_checkout() {
        let (checkout, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let origin = Origin::Path(checkout.path().display().to_string());
        let files = [("Cargo.toml", "# Made by 'afpc build' from x.afp.\n")];
        let locked = |versions: &str, own: bool| {
            fs::write(checkout.path().join(LOCK), versions).unwrap();
            match own {
                true => write_own(folder.path(), &files, &origin).unwrap(),
                false => write(folder.path(), &files, &origin).unwrap(),
            }
            fs::read_to_string(folder.path().join(LOCK)).unwrap()
        };
        assert_eq!(locked("engine 1\n", true), "engine 1\n");
        fs::write(folder.path().join(LOCK), "engine 1\nmine 1\n").unwrap();
        assert_eq!(locked("engine 1\n", true), "engine 1\nmine 1\n", "additions by cargo stay");
        assert_eq!(locked("engine 2\n", true), "engine 2\n");
        assert_eq!(locked("engine 3\n", false), "engine 2\n", "a folder of another program");
    }
}
