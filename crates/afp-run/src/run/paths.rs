//! The paths of the outputs of a run.

use std::fs;
use std::path::{Path, PathBuf};

use afp_log::LogError;

use crate::Program;
use crate::error::RunError;
use crate::options::{Destination, OnRobot, RunOptions};
use crate::output::{check_apart, check_writable, is_same_file};
use crate::picture::{PictureFormat, Rasterizer};

/// The default folder of logs and pictures.
const RUNS: &str = "target/afp/runs";

pub(super) struct Paths {
    pub(super) log: Option<PathBuf>,
    pub(super) svg: Option<PathBuf>,
}

impl Paths {
    /// Creates the default folder if needed, and finds errors early: paths that cannot be written,
    /// or that would overwrite an input.
    pub(super) fn new(
        program: &Program<'_>,
        options: &RunOptions,
        world: Option<&Path>,
    ) -> Result<Self, RunError> {
        let stem = Path::new(program.file).file_stem().unwrap_or("plan".as_ref());
        let path = |asked: &Option<Destination>, extension| -> Result<_, RunError> {
            match asked {
                Some(Destination::None) => Ok(None),
                Some(Destination::File(path)) => Ok(Some(path.clone())),
                None => {
                    let folder = Path::new(RUNS);
                    fs::create_dir_all(folder)
                        .map_err(|error| LogError::Create { path: folder.to_owned(), error })?;
                    let mut name = stem.to_owned();
                    name.push(extension);
                    Ok(Some(folder.join(name)))
                }
            }
        };
        let mut log = path(&options.log, ".mcap")?;
        // The log that is repeated may be at the default path and must not be overwritten.
        let is_repeated =
            |log: &PathBuf| options.again.as_ref().is_some_and(|it| is_same_file(it, log));
        if options.log.is_none() && log.as_ref().is_some_and(is_repeated) {
            log = path(&options.log, ".again.mcap")?;
        }
        // The pose of a real robot is usually unknown, so its picture must be asked for.
        let svg = match (&options.svg, options.robot) {
            (None, OnRobot::Hardware) => None,
            (asked, _) => path(asked, ".svg")?,
        };
        let paths = Paths { log, svg };
        let outputs = [&paths.log, &paths.svg].into_iter().flatten().map(PathBuf::as_path);
        let inputs = [Some(Path::new(program.file)), world, options.again.as_deref()];
        check_apart(outputs, inputs.into_iter().flatten())?;
        if let Some(path) = &paths.svg {
            check_writable("cannot write the picture", path)?;
        }
        Ok(paths)
    }

    /// Converts the SVG to the bytes of the picture; `None` for an SVG.
    pub(super) fn raster<'a>(
        &self,
        all: Option<Rasterizer<'a>>,
    ) -> Result<Option<Rasterizer<'a>>, RunError> {
        let Some(path) = &self.svg else { return Ok(None) };
        match (PictureFormat::of(path)?, all) {
            (PictureFormat::Svg, _) => Ok(None),
            (PictureFormat::Png, Some(raster)) => Ok(Some(raster)),
            (PictureFormat::Png, None) => Err(RunError::usage(
                "this program draws only SVG",
                "'afpc log RUN.mcap --svg PICTURE.png' draws its log as a PNG",
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn png_pictures_need_a_program_with_png_support() {
        let raster: Rasterizer<'_> = &|_| Ok(Vec::new());
        let of = |name: &str, raster| {
            let made = Paths { log: None, svg: Some(name.into()) }.raster(raster);
            made.map(|made| made.is_some()).map_err(|error| error.code())
        };
        let usage = crate::EXIT_USAGE;
        assert_eq!((of("a.svg", None), of("a.svg", Some(raster))), (Ok(false), Ok(false)));
        assert_eq!((of("a.png", None), of("a.png", Some(raster))), (Err(usage), Ok(true)));
    }
}
