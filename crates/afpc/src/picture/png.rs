//! Drawings as pixels: the SVG, painted with the fonts that come along, so that a picture is the
//! same on every machine.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg;

/// DejaVu Sans, cut down to European scripts, arrows and mathematical signs.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../fonts/DejaVuSans.ttf"),
    include_bytes!("../../fonts/DejaVuSans-Bold.ttf"),
];

/// The name inside of both fonts.
const FAMILY: &str = "DejaVu Sans";

/// Pixels of the largest picture: 1 GB while it is painted.
pub const MOST_PIXELS: f64 = 250e6;

/// Why there is no picture.
pub enum Failure {
    /// It would have so many pixels.
    TooLarge(f64, f64),
    /// The renderer gave up.
    Renderer(String),
}

/// A drawing as a PNG file, `scale` pixels for each of its own.
///
/// # Errors
/// [`Failure`]; a drawing of ours is always read.
pub fn png(svg: &str, scale: f32) -> Result<Vec<u8>, Failure> {
    let renderer = |error: &dyn std::fmt::Display| Failure::Renderer(error.to_string());
    let mut options = usvg::Options { font_family: FAMILY.to_owned(), ..Default::default() };
    let fonts = options.fontdb_mut();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family(FAMILY);
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| renderer(&error))?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|size| f64::from((size * scale).ceil()));
    let too_large = || Failure::TooLarge(width, height);
    if width * height > MOST_PIXELS {
        return Err(too_large());
    }
    let mut pixels = Pixmap::new(width as u32, height as u32).ok_or_else(too_large)?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    encoded(&pixels).map_err(|error| renderer(&error))
}

/// Pixels as a file; without their opacity where all of them are opaque, as those of our pictures are.
fn encoded(pixels: &Pixmap) -> Result<Vec<u8>, EncodingError> {
    let opaque = pixels.pixels().iter().all(|pixel| pixel.alpha() == u8::MAX);
    let bytes: Vec<u8> = pixels
        .pixels()
        .iter()
        .flat_map(|pixel| {
            let plain = pixel.demultiply();
            let all = [plain.red(), plain.green(), plain.blue(), plain.alpha()];
            all.into_iter().take(if opaque { 3 } else { 4 })
        })
        .collect();
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(if opaque { ColorType::Rgb } else { ColorType::Rgba });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(file)
}
