//! Strips of pictures from the camera, as PNG.

use afp_carbot::devices::Frame;
use std::io;

/// Between pictures, pixels.
const GAP: usize = 4;
/// Grey level between pictures.
const GROUND: u8 = 32;

/// Frames in rows, from left to right.
#[derive(Clone, Debug, Default)]
pub struct Film {
    width: usize,
    height: usize,
    frames: Vec<Vec<u8>>,
}

impl Film {
    /// Adds a frame; ignores a frame whose size differs from the first frame's.
    pub fn add(&mut self, frame: &Frame<'_>) {
        if self.frames.is_empty() {
            (self.width, self.height) = (frame.width, frame.height);
        }
        let whole = frame.rgb.len() == frame.width * frame.height * 3;
        if whole && (frame.width, frame.height) == (self.width, self.height) {
            self.frames.push(frame.rgb.to_vec());
        }
    }

    /// The number of frames.
    pub fn frames(&self) -> usize {
        self.frames.len()
    }

    /// The strip as a PNG file, with this number of frames a row.
    ///
    /// # Errors
    /// No frame, or more pixels than a PNG can have.
    pub fn png(&self, columns: usize) -> io::Result<Vec<u8>> {
        if self.frames.is_empty() {
            return Err(io::Error::other("a film strip needs a frame"));
        }
        let columns = columns.clamp(1, self.frames.len());
        let rows = self.frames.len().div_ceil(columns);
        let width = columns * (self.width + GAP) + GAP;
        let height = rows * (self.height + GAP) + GAP;
        let mut pixels = vec![GROUND; width * height * 3];
        for (n, frame) in self.frames.iter().enumerate() {
            let left = GAP + (n % columns) * (self.width + GAP);
            let top = GAP + (n / columns) * (self.height + GAP);
            for (y, row) in frame.chunks_exact(self.width * 3).enumerate() {
                let first = ((top + y) * width + left) * 3;
                pixels[first..first + row.len()].copy_from_slice(row);
            }
        }
        let size = |size: usize| u32::try_from(size).map_err(io::Error::other);
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, size(width)?, size(height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().map_err(io::Error::other)?;
        writer.write_image_data(&pixels).map_err(io::Error::other)?;
        writer.finish().map_err(io::Error::other)?;
        Ok(file)
    }
}
