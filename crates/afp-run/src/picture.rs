//! Kinds of pictures, by the names of their files.

use std::path::Path;

use crate::error::RunError;

/// What a picture's file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// For browsers and papers.
    Svg,
    /// Pixels, with fonts of its own.
    Png,
}

/// Makes the bytes of a PNG file from those of an SVG.
pub type Rasterizer<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, RunError>;

impl PictureFormat {
    /// What the name of a file asks for: SVG, unless it has an ending.
    ///
    /// # Errors
    /// It ends neither in `.svg` nor in `.png`.
    pub fn of(path: &Path) -> Result<Self, RunError> {
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        match ending.as_ref().and_then(|ending| ending.to_str()) {
            None if ending.is_none() => Ok(PictureFormat::Svg),
            Some("svg") => Ok(PictureFormat::Svg),
            Some("png") => Ok(PictureFormat::Png),
            _ => Err(RunError::usage(
                format!("'{}' is neither an SVG nor a PNG", path.display()),
                "give it a name that ends in '.svg' or '.png'",
            )),
        }
    }

    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            PictureFormat::Svg => "svg",
            PictureFormat::Png => "png",
        }
    }
}
