//! Pictures of the camera with fewer colours.
//!
//! A camera's grain changes every pixel a little, so that a strip of forty pictures has megabytes of it. With
//! fewer levels most of the grain is gone, and nobody who looks at a strip sees a difference.

use png::{
    ColorType, Compression, Decoder, DecodingError, Encoder, EncodingError, Transformations,
};
use std::io::Cursor;

/// From one level that is left to the next, of 256.
const STEP: u8 = 8;

/// Eight bits for each level of each pixel.
struct Picture {
    levels: Vec<u8>,
    width: u32,
    height: u32,
    color: ColorType,
}

/// A PNG with fewer levels of each colour, as a PNG; none if it cannot be read.
pub(super) fn fewer_colors(png: &[u8]) -> Option<Vec<u8>> {
    let mut picture = read(png).ok()??;
    for level in &mut picture.levels {
        *level = nearest(*level);
    }
    write(&picture).ok()
}

/// The nearest level that is left; black and white are.
fn nearest(level: u8) -> u8 {
    let steps = (u16::from(level) + u16::from(STEP / 2)) / u16::from(STEP);
    u8::try_from(steps * u16::from(STEP)).unwrap_or(u8::MAX)
}

/// None of a picture that is larger than that of any camera.
fn read(png: &[u8]) -> Result<Option<Picture>, DecodingError> {
    /// Four thousand by four thousand pixels.
    const MOST: usize = 64 << 20;
    let mut decoder = Decoder::new(Cursor::new(png));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let Some(size) = reader.output_buffer_size().filter(|size| *size <= MOST) else {
        return Ok(None);
    };
    let mut levels = vec![0; size];
    let info = reader.next_frame(&mut levels)?;
    levels.truncate(info.buffer_size());
    Ok(Some(Picture { levels, width: info.width, height: info.height, color: info.color_type }))
}

fn write(picture: &Picture) -> Result<Vec<u8>, EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, picture.width, picture.height);
    encoder.set_color(picture.color);
    encoder.set_compression(Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&picture.levels)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_looks_and_loses_its_grain() {
        let grain = |n: u32| (n.wrapping_mul(2_654_435_769) >> 16) % 7;
        let levels: Vec<u8> = (0..160 * 120 * 3).map(|n| 117 + grain(n * n) as u8).collect();
        let grainy = Picture { levels, width: 160, height: 120, color: ColorType::Rgb };
        let png = write(&grainy).unwrap();
        let smaller = fewer_colors(&png).unwrap();
        assert!(smaller.len() * 10 < png.len(), "{} of {}", smaller.len(), png.len());
        let after = read(&smaller).unwrap().unwrap();
        assert_eq!((after.width, after.height, after.color), (160, 120, ColorType::Rgb));
        let off = after.levels.iter().zip(&grainy.levels).map(|(a, b)| a.abs_diff(*b));
        assert!(off.max() <= Some(STEP / 2));
    }

    #[test]
    fn what_is_no_picture_is_left_alone() {
        assert_eq!(fewer_colors(b"no picture"), None);
        assert_eq!([0, 3, 4, 255].map(nearest), [0, 0, 8, 255]);
    }
}
