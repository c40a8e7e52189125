//! Formats of pictures, by file extension.

use std::path::Path;

use crate::error::RunError;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// For browsers and papers.
    Svg,
    /// Pixels, with embedded fonts.
    Png,
}

/// Converts an SVG to the bytes of a PNG file.
pub type Rasterizer<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, RunError>;

impl PictureFormat {
    /// The format for a file extension; SVG without one.
    ///
    /// # Errors
    /// The extension is neither `.svg` nor `.png`.
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

    /// The file extension.
    pub fn ending(self) -> &'static str {
        match self {
            PictureFormat::Svg => "svg",
            PictureFormat::Png => "png",
        }
    }
}
