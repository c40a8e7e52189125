//! Camera pictures: as PNG in logs, as pixels for viewers.

use std::io::Cursor;

use afp_core::Instant;

use crate::LogData;
use crate::robot::Image;

/// The picture as a PNG; `None` if its size and its pixels do not agree.
pub(crate) fn png(image: &Image) -> Option<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, image.width, image.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(&image.rgb).ok()?;
    writer.finish().ok()?;
    Some(file)
}

/// Width, height, and the red, green and blue bytes of a PNG. `None` for a file that cannot come
/// from a log, or is larger than any camera's picture: four thousand by five thousand pixels.
pub fn pixels(file: &[u8]) -> Option<(u32, u32, Vec<u8>)> {
    /// Bytes.
    const MOST: usize = 64 << 20;
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().ok()?;
    // Checked before any data is decoded.
    let size = reader.output_buffer_size().filter(|size| *size <= MOST)?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).ok()?;
    let plain = info.color_type == png::ColorType::Rgb && info.bit_depth == png::BitDepth::Eight;
    pixels.truncate(info.buffer_size());
    plain.then_some((info.width, info.height, pixels))
}

impl LogData {
    /// The camera's last picture at a time: width, height, and red, green and blue bytes. `None` if
    /// the log has no earlier picture.
    pub fn picture(&self, at: Instant) -> Option<(u32, u32, Vec<u8>)> {
        let later = self.images.partition_point(|(taken, _)| *taken <= at);
        pixels(&self.images.get(later.checked_sub(1)?)?.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(second: u64, red: u8) -> (Instant, Vec<u8>) {
        let time = Instant::from_nanos(second * 1_000_000_000);
        let rgb = [red, 2, 3, 4, 5, 6].into();
        (time, png(&Image { time, frame: "camera", width: 2, height: 1, rgb }).unwrap())
    }

    #[test]
    fn the_last_picture_before_a_time_has_its_pixels() {
        let mut log = LogData { images: vec![taken(1, 10), taken(2, 20)], ..LogData::default() };
        let red = |log: &LogData, tenths: u64| {
            let at = Instant::from_nanos(tenths * 100_000_000);
            log.picture(at).map(|(width, height, rgb)| (width, height, rgb[0], rgb.len()))
        };
        assert_eq!(red(&log, 9), None);
        assert_eq!(red(&log, 10), Some((2, 1, 10, 6)));
        assert_eq!(red(&log, 19), Some((2, 1, 10, 6)));
        assert_eq!(red(&log, 500), Some((2, 1, 20, 6)));
        log.images[1].1.truncate(40);
        assert_eq!(red(&log, 500), None, "a file that has been cut off");
    }

    #[test]
    fn a_picture_larger_than_any_camera_is_rejected() {
        // Few kilobytes as a file.
        let black = |height: u32| {
            let rgb = vec![0; 4000 * height as usize * 3].into();
            png(&Image { time: Instant::ZERO, frame: "camera", width: 4000, height, rgb }).unwrap()
        };
        assert!(pixels(&black(5000)).is_some());
        assert_eq!(pixels(&black(6000)), None);
    }
}
