//! What things look like to camera and colour sensor.

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// The side of a texture's smallest part, metres.
const PART: f64 = 0.1;

/// Colour and pattern of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// The colour; darker parts of the pattern have half of it.
    pub color: Rgb,
    /// The pattern.
    pub texture: Texture,
}

/// A pattern of light and dark parts, each 10 cm wide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Texture {
    /// None.
    #[default]
    Plain,
    /// Upright stripes; on the floor along y.
    Stripes,
    /// A chequerboard.
    Checks,
    /// Rows of bricks, 20 cm by 10 cm, in dark mortar.
    Bricks,
}

impl Texture {
    /// Every texture with what world files call it.
    pub(super) const NAMES: [(&'static str, Texture); 4] = [
        ("plain", Texture::Plain),
        ("stripes", Texture::Stripes),
        ("checks", Texture::Checks),
        ("bricks", Texture::Bricks),
    ];

    /// Whether a place on a surface is dark: `along` it and `up`, metres.
    fn dark(self, along: f64, up: f64) -> bool {
        let (along, up) = (along / PART, up / PART);
        let odd = |x: f64| (libm::floor(x) as i64).rem_euclid(2) == 1;
        match self {
            Texture::Plain => false,
            Texture::Stripes => odd(along),
            Texture::Checks => odd(along) != odd(up),
            Texture::Bricks => {
                let shifted = along / 2.0 + if odd(up) { 0.5 } else { 0.0 };
                up - libm::floor(up) < 0.12 || shifted - libm::floor(shifted) < 0.06
            }
        }
    }
}

impl Look {
    /// The colour at a place of the surface: `along` it and `up`, metres.
    pub(crate) fn at(&self, along: f64, up: f64) -> Rgb {
        if self.texture.dark(along, up) { self.color.map(|part| part / 2) } else { self.color }
    }
}

/// A colour written as `#rrggbb`.
pub(super) fn parse_color(text: &str) -> Option<Rgb> {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6)?;
    if !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    Some([red, green, blue])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_six_digits_after_a_hash() {
        assert_eq!(parse_color("#ff8000"), Some([255, 128, 0]));
        for wrong in ["ff8000", "#ff800", "#ff80000", "#+f8000", "#gg0000", "#äöü", ""] {
            assert_eq!(parse_color(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn textures_repeat_on_both_sides_of_zero() {
        let dark = |texture: Texture, along, up| texture.dark(along, up);
        assert!(!dark(Texture::Stripes, 0.05, 0.0) && dark(Texture::Stripes, 0.15, 0.0));
        assert!(dark(Texture::Stripes, -0.05, 0.0) && !dark(Texture::Stripes, -0.15, 0.0));
        assert!(dark(Texture::Checks, 0.05, 0.15) && !dark(Texture::Checks, 0.15, 0.15));
        assert!(dark(Texture::Bricks, 0.15, 0.005) && !dark(Texture::Bricks, 0.15, 0.05));
    }
}
