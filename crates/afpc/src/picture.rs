//! Pictures as files: SVG, or pixels where the name ends in `.png`.

#[cfg(feature = "png")]
mod png;

use std::path::Path;

use afp_draw::Theme;
use afp_run::{PictureFormat, RunError, write_whole};

/// Pixels of a PNG for each one of the SVG, where nothing is said: sharp on today's screens.
pub const DEFAULT_SCALE: f32 = 2.0;

/// The colours of a picture, where nothing is said: a PNG cannot ask the system of its reader.
pub fn theme(format: PictureFormat) -> Theme {
    match format {
        PictureFormat::Svg => Theme::Auto,
        PictureFormat::Png => Theme::Light,
    }
}

/// Writes a picture as its name asks for.
///
/// # Errors
/// The name's ending, pixels that cannot be made, a file that cannot be written.
pub fn write(path: &Path, svg: &str) -> Result<(), RunError> {
    let what = "cannot write the picture";
    match PictureFormat::of(path)? {
        PictureFormat::Svg => write_whole(what, path, svg),
        PictureFormat::Png => write_whole(what, path, pixels(svg, DEFAULT_SCALE)?),
    }
}

/// Refuses a drawing of which is known, before anything is laid out, that it takes too many pixels; `area` in its own.
///
/// # Errors
/// It is too large.
#[cfg(feature = "png")]
pub fn check_area(area: f64, scale: f32) -> Result<(), RunError> {
    let pixels = area * f64::from(scale).powi(2);
    if pixels <= png::MOST_PIXELS {
        return Ok(());
    }
    let millions = (pixels / 1e6).round();
    let most = png::MOST_PIXELS / 1e6;
    Err(RunError::usage(
        format!(
            "the picture would be more than {millions} million pixels large, at most {most} million"
        ),
        "choose a smaller '--scale', or draw SVG",
    ))
}

/// There are no pixels in this program, so none are too many.
///
/// # Errors
/// None.
#[cfg(not(feature = "png"))]
pub fn check_area(_: f64, _: f32) -> Result<(), RunError> {
    Ok(())
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
