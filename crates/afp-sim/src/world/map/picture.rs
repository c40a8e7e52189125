//! Pictures of maps: PGM, plain or binary, and PNG.

use std::io::Cursor;

/// A map has at most this many cells.
const MOST: usize = 1 << 26;

/// Grey values row by row from the top, 0 black to 255 white.
pub(super) struct Grey {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<u8>,
}

/// Reads a picture; the message says what is wrong with it.
pub(super) fn read(bytes: &[u8]) -> Result<Grey, String> {
    match bytes {
        [b'P', b'5', ..] => pgm(bytes, true),
        [b'P', b'2', ..] => pgm(bytes, false),
        [0x89, b'P', b'N', b'G', ..] => png(bytes),
        _ => Err("the map's picture is neither PGM nor PNG".to_owned()),
    }
}

fn pgm(bytes: &[u8], binary: bool) -> Result<Grey, String> {
    let mut numbers = Numbers { bytes, at: 2 };
    let mut next = || numbers.next().ok_or("the map's PGM ends too early");
    let (width, height, most) = (next()?, next()?, next()?);
    let cells = cells(width, height).ok_or("the map's PGM is too large")?;
    if !(1..=65535).contains(&most) || cells == 0 {
        return Err(format!("a PGM of {width} by {height} with values up to {most} is no map"));
    }
    let scale = |value: usize| (value.min(most) * 255 / most) as u8;
    let values: Vec<u8> = if binary {
        let data = bytes.get(numbers.at + 1..).unwrap_or_default();
        // Above 255 a value has two bytes, the higher one first.
        let size = if most > 255 { 2 } else { 1 };
        let value = |bytes: &[u8]| bytes.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
        data.chunks_exact(size).take(cells).map(|bytes| scale(value(bytes))).collect()
    } else {
        std::iter::from_fn(|| numbers.next()).take(cells).map(scale).collect()
    };
    if values.len() < cells {
        return Err("the map's PGM ends too early".to_owned());
    }
    Ok(Grey { width, height, values })
}

/// How many cells a map of that size has, unless those are too many.
fn cells(width: usize, height: usize) -> Option<usize> {
    width.checked_mul(height).filter(|cells| *cells <= MOST)
}

/// Numbers of a PGM, with comments between them.
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

fn png(bytes: &[u8]) -> Result<Grey, String> {
    let wrong = |why: png::DecodingError| format!("the map's PNG is broken: {why}");
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (width, height) = reader.info().size();
    let size = cells(width as usize, height as usize).and(reader.output_buffer_size());
    let mut data = vec![0; size.ok_or("the map's PNG is too large")?];
    let info = reader.next_frame(&mut data).map_err(wrong)?;
    let samples = info.color_type.samples();
    // Colours count by their mean; what is transparent counts like what is not.
    let colors = if samples >= 3 { 3 } else { 1 };
    let mean = |pixel: &[u8]| {
        (pixel[..colors].iter().map(|part| usize::from(*part)).sum::<usize>() / colors) as u8
    };
    let values = data[..info.buffer_size()].chunks_exact(samples).map(mean).collect();
    Ok(Grey { width: info.width as usize, height: info.height as usize, values })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_and_binary_pgm_are_the_same() {
        let plain = read(b"P2 # made by hand\n3 2\n# grey\n100\n0 50 100 100 50 0\n").unwrap();
        let binary = read(b"P5\n3 2\n100\n\x00\x32\x64\x64\x32\x00").unwrap();
        assert_eq!(plain.values, [0, 127, 255, 255, 127, 0]);
        assert_eq!((plain.width, plain.height), (3, 2));
        assert_eq!(plain.values, binary.values);
        let wide = read(b"P5\n2 1\n65535\n\xff\xff\x7f\xff").unwrap();
        assert_eq!(wide.values, [255, 127]);
    }

    #[test]
    fn a_png_is_read_in_grey_and_in_colour() {
        for (color, data) in [
            (png::ColorType::Grayscale, &[0u8, 255][..]),
            (png::ColorType::Rgba, &[0, 0, 0, 255, 255, 255, 255, 0]),
        ] {
            let mut file = Vec::new();
            let mut encoder = png::Encoder::new(&mut file, 2, 1);
            encoder.set_color(color);
            encoder.write_header().unwrap().write_image_data(data).unwrap();
            assert_eq!(read(&file).unwrap().values, [0, 255]);
        }
    }

    #[test]
    fn pictures_of_more_cells_than_a_map_has_are_refused_before_they_take_memory() {
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
