use afp_carbot::devices::Frame;

/// Brightness by pixel, row by row from the top left.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    width: usize,
    height: usize,
    grey: Vec<u8>,
}

/// The weights of red, green and blue in the brightness, of 256 (ITU-R BT.601).
const WEIGHTS: [u32; 3] = [77, 150, 29];

impl Picture {
    /// A black picture of this size.
    pub fn new(width: usize, height: usize) -> Self {
        Picture { width, height, grey: vec![0; width * height] }
    }

    /// Pixels a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The brightness of each pixel: `width * height` bytes.
    pub fn grey(&self) -> &[u8] {
        &self.grey
    }

    /// Copies a frame in grey. Allocates only if the frame has a different size; missing pixels are
    /// black.
    pub fn take(&mut self, frame: &Frame<'_>) {
        (self.width, self.height) = (frame.width, frame.height);
        let grey = |[red, green, blue]: &[u8; 3]| {
            let parts = [red, green, blue].into_iter().zip(WEIGHTS);
            (parts.map(|(part, weight)| u32::from(*part) * weight).sum::<u32>() >> 8) as u8
        };
        let (pixels, _) = frame.rgb.as_chunks();
        self.grey.clear();
        self.grey.extend(pixels.iter().map(grey));
        self.grey.resize(frame.width * frame.height, 0);
    }

    /// Copies another picture. Allocates only if it has a different size.
    pub fn copy(&mut self, other: &Picture) {
        self.clone_from(other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn green_is_brighter_than_red_and_red_than_blue() {
        let rgb = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
        let mut picture = Picture::new(1, 1);
        picture.take(&Frame { width: 4, height: 1, rgb: &rgb, number: 1 });
        assert_eq!(picture.grey(), [76, 149, 28, 255]);
    }

    #[test]
    fn a_truncated_frame_is_filled_up_with_black() {
        let mut picture = Picture::new(2, 2);
        picture.take(&Frame { width: 2, height: 2, rgb: &[255; 7], number: 1 });
        assert_eq!(picture.grey(), [255, 255, 0, 0]);
    }
}
