//! Closed documents for language servers: the files of this machine.

use std::fs;
use std::path::Path;

use afp_dsl::files::{self, Files};
use afp_lsp::Host;
use afp_run::write_whole;

use crate::picture;

/// The files of this machine.
#[derive(Debug)]
pub struct Disk;

impl Host for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        files::Disk::default().read(path)
    }

    fn plan_files(&self, folder: &str) -> Vec<String> {
        let files = afp_project::files(Path::new(folder)).into_iter();
        let plans = files.filter(|path| path.extension().is_some_and(|ending| ending == "afp"));
        plans.filter_map(|path| Some(path.to_str()?.to_owned())).collect()
    }

    fn png(&self, svg: &str) -> Result<Vec<u8>, String> {
        let made = picture::pixels(svg, picture::DEFAULT_SCALE);
        made.map_err(|why| why.to_string().trim_start_matches("error: ").to_owned())
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
