//! The output files of a sweep.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::grid::Sweep;
use crate::header::Header;
use crate::outcome::Outcome;
use crate::table::to_csv;
use afp_run::{RunError, check_writable, hash, write_whole};

/// The title of an error about a table.
const WHAT: &str = "cannot write the table";

/// The default folder of tables.
const SWEEPS: &str = "target/afp/sweeps";

pub type Make = fn(&Sweep, &[Outcome], &Header) -> io::Result<Vec<u8>>;

/// The formats of tables by file extension.
const FORMATS: &[(&str, Make)] = &[
    ("csv", to_csv),
    #[cfg(feature = "parquet")]
    ("parquet", crate::table::to_parquet),
];

pub struct OutputFiles {
    pub journal: PathBuf,
    /// Tables, written at the end.
    pub tables: Vec<(PathBuf, Make)>,
    /// The identity of the sweep, for tables that keep it.
    header: Header,
}

impl OutputFiles {
    /// Returns the requested files, or the default for this plan and grid, and creates the folder.
    ///
    /// # Errors
    /// An unsupported extension, or a folder or table that cannot be written. This is checked
    /// before the runs, which can take hours.
    pub fn new(
        asked: Option<&Path>,
        plan: &Path,
        header: &Header,
    ) -> Result<OutputFiles, RunError> {
        let output = match asked {
            Some(path) => named(path, header)?,
            None => {
                let stem = plan.file_stem().unwrap_or_default().to_string_lossy();
                let grid = hash(&format!("{} {}", plan.display(), header.grid));
                let name = format!("{stem}-{}.csv", grid.get(..8).unwrap_or_default());
                single(&Path::new(SWEEPS).join(name), to_csv, header)
            }
        };
        let folder = output.journal.parent().unwrap_or(Path::new("."));
        if asked.is_none_or(|path| folder == path) {
            fs::create_dir_all(folder).map_err(RunError::file("cannot make the folder", folder))?;
        }
        for (path, _) in &output.tables {
            check_writable(WHAT, path)?;
        }
        Ok(output)
    }

    /// Writes the tables.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, sweep: &Sweep, outcomes: &[Outcome]) -> Result<(), RunError> {
        for (path, make) in &self.tables {
            let bytes = make(sweep, outcomes, &self.header).map_err(RunError::file(WHAT, path))?;
            write_whole(WHAT, path, bytes)?;
        }
        Ok(())
    }
}

/// The files of `-o`.
fn named(path: &Path, header: &Header) -> Result<OutputFiles, RunError> {
    let ends = path.to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR]);
    if path.is_dir() || ends {
        let formats = FORMATS.iter();
        let tables =
            formats.map(|(ending, make)| (path.join("outcomes").with_extension(ending), *make));
        return Ok(OutputFiles {
            journal: path.join("outcomes.journal"),
            tables: tables.collect(),
            header: header.clone(),
        });
    }
    let ending = path.extension().and_then(|extension| extension.to_str());
    match FORMATS.iter().find(|(known, _)| ending == Some(known)) {
        Some((_, make)) => Ok(single(path, *make, header)),
        None if ending == Some("parquet") => Err(RunError::usage(
            format!("'{}': this program was built without Parquet", path.display()),
            "name a .csv file, or build afpc with its feature: \
             'cargo install --path crates/afpc --features parquet'",
        )),
        None => Err(RunError::usage(
            unsupported(path),
            "use '.csv' or '.parquet'; a folder, with '/' after its name, gets both",
        )),
    }
}

fn unsupported(path: &Path) -> String {
    match path.extension() {
        Some(ending) => format!("unsupported format '.{}'", ending.display()),
        None => format!("'{}' has no file extension", path.display()),
    }
}

/// A single table, with the journal next to it.
fn single(path: &Path, make: Make, header: &Header) -> OutputFiles {
    let mut journal = path.as_os_str().to_owned();
    journal.push(".journal");
    let (tables, header) = (vec![(path.to_owned(), make)], header.clone());
    OutputFiles { journal: journal.into(), tables, header }
}
