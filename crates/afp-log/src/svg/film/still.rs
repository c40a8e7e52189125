//! Camera pictures with fewer colours.
//!
//! A camera's grain changes every pixel a little, so a strip of forty pictures would have megabytes
//! of grain. With fewer levels most of the grain is gone, and the strip looks the same.

use png::{ColorType, Compression, Encoder, EncodingError};

use crate::picture::pixels;

/// The distance between two remaining levels, of 256.
const STEP: u8 = 8;

/// A PNG of a log with fewer levels of each colour; `None` if it cannot be read.
pub(super) fn fewer_colors(png: &[u8]) -> Option<Vec<u8>> {
    let (width, height, mut levels) = pixels(png)?;
    for level in &mut levels {
        *level = nearest(*level);
    }
    write(width, height, &levels).ok()
}

/// The nearest remaining level; black and white remain.
fn nearest(level: u8) -> u8 {
    let steps = (u16::from(level) + u16::from(STEP / 2)) / u16::from(STEP);
    u8::try_from(steps * u16::from(STEP)).unwrap_or(u8::MAX)
}

fn write(width: u32, height: u32, levels: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_compression(Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(levels)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_keeps_its_look_and_loses_its_grain() {
        let grain = |n: u32| (n.wrapping_mul(2_654_435_769) >> 16) % 7;
        let levels: Vec<u8> = (0..160 * 120 * 3).map(|n| 117 + grain(n * n) as u8).collect();
        let png = write(160, 120, &levels).unwrap();
        let smaller = fewer_colors(&png).unwrap();
        assert!(smaller.len() * 10 < png.len(), "{} of {}", smaller.len(), png.len());
        let (width, height, after) = pixels(&smaller).unwrap();
        assert_eq!((width, height), (160, 120));
        let off = after.iter().zip(&levels).map(|(a, b)| a.abs_diff(*b));
        assert!(off.max() <= Some(STEP / 2));
    }

    #[test]
    fn an_invalid_picture_is_rejected() {
        assert_eq!(fewer_colors(b"no picture"), None);
        assert_eq!([0, 3, 4, 255].map(nearest), [0, 0, 8, 255]);
    }
}
