//! Pictures as files: SVG, or pixels where the name ends in `.png`.

#[cfg(feature = "png")]
mod png;

use std::path::Path;

use afp_dsl::draw::Theme;
use afp_run::{RunError, write_whole};

/// Pixels of a PNG for each one of the SVG, where nothing is said: sharp on today's screens.
pub const DEFAULT_SCALE: f32 = 2.0;

/// What a picture's file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// For browsers and papers.
    Svg,
    /// Pixels, with fonts of its own.
    Png,
}

impl Format {
    /// What the name of a file asks for; `None` for anything else.
    pub fn of(path: &Path) -> Option<Format> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "svg" => Some(Format::Svg),
            "png" => Some(Format::Png),
            _ => None,
        }
    }

    /// The colours, where nothing is said: a PNG cannot ask the system of its reader.
    pub fn theme(self) -> Theme {
        match self {
            Format::Svg => Theme::Auto,
            Format::Png => Theme::Light,
        }
    }

    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
        }
    }
}

/// What the name of a picture asks for.
///
/// # Errors
/// It ends neither in `.svg` nor in `.png`.
pub fn format(path: &Path) -> Result<Format, RunError> {
    Format::of(path).ok_or_else(|| {
        let message = format!("'{}' is neither an SVG nor a PNG", path.display());
        RunError::usage(message, "give it a name that ends in '.svg' or '.png'")
    })
}

/// Writes a picture as its name asks for.
///
/// # Errors
/// The name's ending, pixels that cannot be made, a file that cannot be written.
pub fn write(path: &Path, svg: &str) -> Result<(), RunError> {
    match format(path)? {
        Format::Svg => write_whole("cannot write the picture", path, svg),
        Format::Png => write_whole("cannot write the picture", path, pixels(svg, DEFAULT_SCALE)?),
    }
}

/// A drawing as a PNG file, `scale` pixels for each of its own.
///
/// # Errors
/// It is too large, or this program was built without pixels.
#[cfg(feature = "png")]
pub fn pixels(svg: &str, scale: f32) -> Result<Vec<u8>, RunError> {
    png::png(svg, scale).map_err(|why| match why {
        png::Failure::TooLarge(width, height) => RunError::usage(
            format!("the picture would be {width} x {height} pixels"),
            "choose a smaller '--scale', or draw SVG",
        ),
        png::Failure::Renderer(why) => RunError::usage(
            format!("the drawing cannot be painted: {why}"),
            "draw SVG; and please report this",
        ),
    })
}

/// There are no pixels in this program.
///
/// # Errors
/// Always.
#[cfg(not(feature = "png"))]
pub fn pixels(_: &str, _: f32) -> Result<Vec<u8>, RunError> {
    let help = "draw SVG and convert it, or install afpc with its feature 'png'";
    Err(RunError::usage("this afpc was built without PNG", help))
}
