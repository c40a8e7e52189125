//! Pictures of maps: PGM, plain or binary, and PNG.

use std::io::Cursor;

/// The maximum number of cells in a map.
const MOST: usize = 1 << 26;

/// A value for each cell, row by row from the top.
pub(super) struct Grid<T> {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<T>,
}

/// From 0 black to 65535 white.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pixel {
    pub(super) colors: [u16; 3],
    pub(super) alpha: Option<u16>,
}

/// Reads a picture and converts each pixel with `read`; returns a message for an invalid picture.
pub(super) fn read<T>(bytes: &[u8], read: impl Fn(Pixel) -> T) -> Result<Grid<T>, String> {
    match bytes {
        [b'P', b'5', ..] => pgm(bytes, true, read),
        [b'P', b'2', ..] => pgm(bytes, false, read),
        [0x89, b'P', b'N', b'G', ..] => png(bytes, read),
        _ => Err("the map's picture is neither PGM nor PNG".to_owned()),
    }
}

fn pgm<T>(bytes: &[u8], binary: bool, read: impl Fn(Pixel) -> T) -> Result<Grid<T>, String> {
    let mut numbers = Numbers { bytes, at: 2 };
    let mut next = || numbers.next().ok_or("the map's PGM ends too early");
    let (width, height, most) = (next()?, next()?, next()?);
    let cells = cells(width, height).ok_or("the map's PGM is too large")?;
    if !(1..=65535).contains(&most) || cells == 0 {
        return Err(format!("a PGM of {width} by {height} with values up to {most} is not a map"));
    }
    let scale = |value: usize| {
        let grey = (value.min(most) * 65535 + most / 2) / most;
        read(Pixel { colors: [grey as u16; 3], alpha: None })
    };
    let values: Vec<T> = if binary {
        let data = bytes.get(numbers.at + 1..).unwrap_or_default();
        // Values above 255 have two bytes, the higher one first.
        let size = if most > 255 { 2 } else { 1 };
        let value = |bytes: &[u8]| bytes.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        data.chunks_exact(size).take(cells).map(|bytes| scale(value(bytes))).collect()
    } else {
        std::iter::from_fn(|| numbers.next()).take(cells).map(scale).collect()
    };
    if values.len() < cells {
        return Err("the map's PGM ends too early".to_owned());
    }
    Ok(Grid { width, height, values })
}

/// The number of cells of a map of this size; `None` if there are too many.
fn cells(width: usize, height: usize) -> Option<usize> {
    width.checked_mul(height).filter(|cells| *cells <= MOST)
}

struct Numbers<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Numbers<'_> {
    fn next(&mut self) -> Option<usize> {
        loop {
            match *self.bytes.get(self.at)? {
                b'#' => {
                    let rest = self.bytes[self.at..].iter();
                    self.at += rest.take_while(|byte| **byte != b'\n').count();
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                byte if byte.is_ascii_digit() => break,
                _ => return None,
            }
        }
        let mut number: usize = 0;
        while let Some(digit) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_digit()) {
            number = number.checked_mul(10)?.checked_add(usize::from(digit - b'0'))?;
            self.at += 1;
        }
        Some(number)
    }
}

fn png<T>(bytes: &[u8], read: impl Fn(Pixel) -> T) -> Result<Grid<T>, String> {
    let wrong = |why: png::DecodingError| format!("the map's PNG is broken: {why}");
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (width, height) = reader.info().size();
    let size = cells(width as usize, height as usize).and(reader.output_buffer_size());
    let mut data = vec![0; size.ok_or("the map's PNG is too large")?];
    let info = reader.next_frame(&mut data).map_err(wrong)?;
    let samples = info.color_type.samples();
    let size = if info.bit_depth == png::BitDepth::Sixteen { 2 } else { 1 };
    let sample = |bytes: &[u8]| match bytes {
        [high, low] => u16::from_be_bytes([*high, *low]),
        bytes => u16::from(bytes.first().copied().unwrap_or_default()) * 257,
    };
    let pixel = |bytes: &[u8]| {
        let mut all = bytes.chunks(size).map(sample);
        let mut next = || all.next().unwrap_or_default();
        let colors = if samples >= 3 { [next(), next(), next()] } else { [next(); 3] };
        read(Pixel { colors, alpha: samples.is_multiple_of(2).then(next) })
    };
    let values = data[..info.buffer_size()].chunks_exact(samples * size).map(pixel).collect();
    Ok(Grid { width: info.width as usize, height: info.height as usize, values })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The greys of a picture, and the opacity of each.
    fn read(bytes: &[u8]) -> Result<Grid<(u16, Option<u16>)>, String> {
        super::read(bytes, |pixel| (pixel.colors[0], pixel.alpha))
    }

    #[test]
    fn plain_and_binary_pgm_are_the_same() {
        let plain = read(b"P2 # made by hand\n3 2\n# grey\n100\n0 50 100 100 50 0\n").unwrap();
        let binary = read(b"P5\n3 2\n100\n\x00\x32\x64\x64\x32\x00").unwrap();
        let greys = [0, 32768, 65535, 65535, 32768, 0].map(|grey| (grey, None));
        assert_eq!(plain.values, greys);
        assert_eq!((plain.width, plain.height), (3, 2));
        assert_eq!(plain.values, binary.values);
        let wide = read(b"P5\n2 1\n65535\n\xff\xff\x7f\xff").unwrap();
        assert_eq!(wide.values, [(65535, None), (0x7fff, None)]);
    }

    #[test]
    fn a_png_is_read_in_grey_and_in_colour() {
        use png::BitDepth::{Eight, Sixteen};
        use png::ColorType::{Grayscale, GrayscaleAlpha, Rgba};
        for (color, depth, data, pixels) in [
            (Grayscale, Eight, &[1u8, 255][..], [(257, None), (65535, None)]),
            (Grayscale, Sixteen, &[1, 2, 3, 4], [(0x0102, None), (0x0304, None)]),
            (GrayscaleAlpha, Eight, &[0, 255, 1, 0], [(0, Some(65535)), (257, Some(0))]),
            (Rgba, Eight, &[2, 0, 0, 1, 1, 0, 0, 0], [(514, Some(257)), (257, Some(0))]),
        ] {
            let mut file = Vec::new();
            let mut encoder = png::Encoder::new(&mut file, 2, 1);
            encoder.set_color(color);
            encoder.set_depth(depth);
            encoder.write_header().unwrap().write_image_data(data).unwrap();
            assert_eq!(read(&file).unwrap().values, pixels);
        }
    }

    #[test]
    fn pictures_with_too_many_cells_are_refused_before_they_take_memory() {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 1 << 14, (1 << 12) + 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().unwrap().write_chunk(png::chunk::IDAT, b"").unwrap();
        for (bytes, kind) in [(&*file, "PNG"), (b"P5\n16384 4097\n255\n", "PGM")] {
            assert_eq!(read(bytes).err().unwrap(), format!("the map's {kind} is too large"));
        }
    }

    #[test]
    fn broken_pictures_are_refused() {
        let huge = b"P5\n99999999999 99999999999\n255\n";
        let cases: [&[u8]; 9] = [
            b"",
            b"P6\n1 1\n255\n...",
            b"P5\n2 2\n255\nabc",
            b"P5\n0 2\n255\n",
            b"P2\n2 1\n255\n1 x",
            b"P5\n2 2\n65535\nabcdefg",
            b"P5\n2 2\n65536\nabcdefghijkl",
            b"\x89PNG\r\n\x1a\n...",
            huge,
        ];
        for case in cases {
            assert!(read(case).is_err(), "{case:?}");
        }
    }
}
