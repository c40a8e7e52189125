//! Drawings as pixels: the SVG, rendered with bundled fonts, so that a picture is the same on every
//! machine.

use std::collections::HashMap;

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg;

/// DejaVu Sans, reduced to European scripts, arrows and mathematical signs. Other letters are left
/// out.
const FONTS: [&[u8]; 2] = [
    include_bytes!("../../fonts/DejaVuSans.ttf"),
    include_bytes!("../../fonts/DejaVuSans-Bold.ttf"),
];

/// The family name in both fonts.
const FAMILY: &str = "DejaVu Sans";

/// The maximum number of pixels: rendering needs 1 GB.
pub const MOST_PIXELS: f64 = 250e6;

/// The reasons for a missing picture.
pub enum Failure {
    TooLarge(f64, f64),
    /// The renderer failed.
    Renderer(String),
}

/// A drawing as a PNG file, with `scale` pixels per SVG pixel.
///
/// # Errors
/// [`Failure`]; AFP's own drawings are always readable.
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

/// Encodes pixels: with a palette if there are few colours, which saves a third of the bytes;
/// without an alpha channel if all pixels are opaque, as in AFP's pictures.
fn encoded(pixels: &Pixmap) -> Result<Vec<u8>, EncodingError> {
    let colors = || {
        pixels.pixels().iter().map(|pixel| {
            let plain = pixel.demultiply();
            [plain.red(), plain.green(), plain.blue(), plain.alpha()]
        })
    };
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    let opaque = pixels.pixels().iter().all(|pixel| pixel.alpha() == u8::MAX);
    let bytes: Vec<u8> = match indexed(colors()).filter(|_| opaque) {
        Some((palette, bytes)) => {
            encoder.set_color(ColorType::Indexed);
            encoder.set_palette(palette);
            encoder.set_filter(Filter::NoFilter);
            bytes
        }
        None => {
            encoder.set_color(if opaque { ColorType::Rgb } else { ColorType::Rgba });
            colors().flat_map(|color| color.into_iter().take(if opaque { 3 } else { 4 })).collect()
        }
    };
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(file)
}

/// The colours in order of appearance, and the colour index of each pixel; `None` for more than 256
/// colours.
fn indexed(colors: impl Iterator<Item = [u8; 4]>) -> Option<(Vec<u8>, Vec<u8>)> {
    let mut known = HashMap::new();
    let mut palette = Vec::new();
    let indices = colors.map(|color| {
        let next = known.len();
        let index = *known.entry(color).or_insert_with(|| {
            palette.extend_from_slice(&color[..3]);
            next
        });
        u8::try_from(index).ok()
    });
    let indices = indices.collect::<Option<Vec<_>>>()?;
    Some((palette, indices))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_use_a_palette_unless_there_are_too_many_colours() {
        let (red, blue) = ([200, 0, 0, 255], [0, 0, 200, 255]);
        let (palette, indices) = indexed([red, blue, red].into_iter()).unwrap();
        assert_eq!((palette, indices), (vec![200, 0, 0, 0, 0, 200], vec![0, 1, 0]));
        let many = |count: u16| (0..count).map(|n| [(n >> 8) as u8, n as u8, 0, 255]);
        assert_eq!(indexed(many(256)).map(|(_, indices)| indices.last().copied()), Some(Some(255)));
        assert!(indexed(many(257)).is_none());
    }
}
