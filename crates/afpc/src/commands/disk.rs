//! Where language servers find texts that nobody has open: the files of this machine.

use std::fs;
use std::path::Path;

use afp_lsp::Host;
use afp_run::write_whole;

use crate::plan_file::read_used;

/// The files of this machine.
#[derive(Debug)]
pub struct Disk;

/// Folders deeper than this are not searched for plans.
const DEPTH: usize = 12;

impl Host for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        read_used(path)
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        let mut paths = Vec::new();
        search(Path::new(folder), DEPTH, &mut paths);
        paths.sort();
        paths
    }

    fn built_in(&self, name: &str, text: &str) -> Option<String> {
        let folder = afp_build::cache()?.join("toolboxes").join(env!("CARGO_PKG_VERSION"));
        let path = folder.join(name);
        if fs::read_to_string(&path).is_ok_and(|known| known == text) {
            return path.to_str().map(str::to_owned);
        }
        fs::create_dir_all(&folder).ok()?;
        write_whole("cannot write the toolbox", &path, text).ok()?;
        path.to_str().map(str::to_owned)
    }
}

/// The plan files and toolboxes below a folder; hidden folders and those that builds fill are left out.
fn search(folder: &Path, depth: usize, paths: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let (name, path) = (entry.file_name(), entry.path());
        let name = name.to_string_lossy();
        // Links are not followed, so that no circle is walked.
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir()
            && depth > 0
            && !name.starts_with('.')
            && name != "target"
            && name != "node_modules"
        {
            search(&path, depth - 1, paths);
        } else if kind.is_file() && name.ends_with(".afp") {
            paths.extend(path.to_str().map(str::to_owned));
        }
    }
}
