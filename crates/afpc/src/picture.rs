//! Pictures as files: SVG, or pixels if the file's extension is `.png`.

#[cfg(feature = "png")]
mod png;

use std::path::Path;

use afp_draw::Theme;
use afp_run::{PictureFormat, RunError, write_whole};

/// The default number of PNG pixels per SVG pixel: sharp on current screens.
pub const DEFAULT_SCALE: f32 = 2.0;

/// The default colours of a picture: a PNG cannot adapt to the reader's system.
pub fn theme(format: PictureFormat) -> Theme {
    match format {
        PictureFormat::Svg => Theme::Auto,
        PictureFormat::Png => Theme::Light,
    }
}

/// Writes a picture in the format of its file extension.
///
/// # Errors
/// The extension is unknown, the pixels cannot be rendered, the file cannot be written.
pub fn write(path: &Path, svg: &str) -> Result<(), RunError> {
    let what = "cannot write the picture";
    match PictureFormat::of(path)? {
        PictureFormat::Svg => write_whole(what, path, svg),
        PictureFormat::Png => write_whole(what, path, pixels(svg, DEFAULT_SCALE)?),
    }
}

/// Rejects a drawing with too many pixels before its layout; `area` is in SVG pixels.
///
/// # Errors
/// The drawing is too large.
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

/// This program cannot render pixels, so there is no limit.
///
/// # Errors
/// None.
#[cfg(not(feature = "png"))]
pub fn check_area(_: f64, _: f32) -> Result<(), RunError> {
    Ok(())
}

/// A drawing as a PNG file, with `scale` pixels per SVG pixel.
///
/// # Errors
/// The drawing is too large, or this program cannot render pixels.
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

/// This program cannot render pixels.
///
/// # Errors
/// Always.
#[cfg(not(feature = "png"))]
pub fn pixels(_: &str, _: f32) -> Result<Vec<u8>, RunError> {
    let help = "draw SVG and convert it, or install afpc with its feature 'png'";
    Err(RunError::usage("this afpc was built without PNG", help))
}
