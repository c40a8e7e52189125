//! The appearance of objects to camera and colour sensor.

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// The side of a texture's smallest part, metres.
const PART: f64 = 0.1;
/// The brightness of a pattern's dark parts.
const DARK: f64 = 0.5;

/// Colour and pattern of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Look {
    /// The colour; the darkest parts of the pattern have half of it.
    pub color: Rgb,
    /// The pattern.
    pub texture: Texture,
}

/// A pattern of light and dark parts, 10 cm wide.
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
    /// Blurred spots that never repeat, like carpet, plaster or bark.
    Mottled,
}

impl Texture {
    /// Every texture with its name in world files.
    pub(super) const NAMES: [(&'static str, Texture); 5] = [
        ("plain", Texture::Plain),
        ("stripes", Texture::Stripes),
        ("checks", Texture::Checks),
        ("bricks", Texture::Bricks),
        ("mottled", Texture::Mottled),
    ];

    /// The share of light that a place on a surface reflects: `along` it and `up`, in metres.
    fn light(self, along: f64, up: f64) -> f64 {
        let (along, up) = (along / PART, up / PART);
        let odd = |x: f64| (libm::floor(x) as i64).rem_euclid(2) == 1;
        let dark = match self {
            Texture::Plain => false,
            Texture::Stripes => odd(along),
            Texture::Checks => odd(along) != odd(up),
            Texture::Bricks => {
                let shifted = along / 2.0 + if odd(up) { 0.5 } else { 0.0 };
                up - libm::floor(up) < 0.12 || shifted - libm::floor(shifted) < 0.06
            }
            Texture::Mottled => {
                let blots = 0.6 * blots(along, up) + 0.4 * blots(along / 3.7, up / 3.7);
                // Extreme values are rare; twice the contrast compensates for this.
                return 1.0 - DARK * (2.0 * blots - 0.5).clamp(0.0, 1.0);
            }
        };
        if dark { DARK } else { 1.0 }
    }
}

/// Spots with soft edges, one in each square of side 1: 0 to 1.
fn blots(x: f64, y: f64) -> f64 {
    let (left, low) = (libm::floor(x), libm::floor(y));
    let soft = |t: f64| t * t * (3.0 - 2.0 * t);
    let (a, b) = (soft(x - left), soft(y - low));
    let corner = |i: f64, k: f64| chance(left + i, low + k);
    let under = corner(0.0, 0.0) * (1.0 - a) + corner(1.0, 0.0) * a;
    let over = corner(0.0, 1.0) * (1.0 - a) + corner(1.0, 1.0) * a;
    under * (1.0 - b) + over * b
}

/// A fixed random number from 0 to 1 for a corner of the squares.
fn chance(x: f64, y: f64) -> f64 {
    let mix = |n: u64| (n ^ (n >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let corner = (x as i64 as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (y as i64 as u64);
    (mix(mix(corner)) >> 40) as f64 / (1_u64 << 24) as f64
}

impl Look {
    /// The colour at a place of the surface: `along` it and `up`, metres.
    pub(crate) fn at(&self, along: f64, up: f64) -> Rgb {
        let light = self.texture.light(along, up);
        self.color.map(|part| (f64::from(part) * light) as u8)
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
        let dark = |texture: Texture, along, up| texture.light(along, up) < 1.0;
        assert!(!dark(Texture::Stripes, 0.05, 0.0) && dark(Texture::Stripes, 0.15, 0.0));
        assert!(dark(Texture::Stripes, -0.05, 0.0) && !dark(Texture::Stripes, -0.15, 0.0));
        assert!(dark(Texture::Checks, 0.05, 0.15) && !dark(Texture::Checks, 0.15, 0.15));
        assert!(dark(Texture::Bricks, 0.15, 0.005) && !dark(Texture::Bricks, 0.15, 0.05));
    }

    #[test]
    fn mottles_are_soft_and_do_not_repeat() {
        let at = |x: f64| Texture::Mottled.light(x, 0.31);
        let lights: Vec<f64> = (0..4000).map(|n| at(f64::from(n) / 1000.0 - 2.0)).collect();
        assert!(lights.iter().all(|light| (DARK..=1.0).contains(light)));
        assert!(lights.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 0.03), "soft");
        let range = lights.iter().fold((1.0, 0.0_f64), |(a, b), x| (x.min(a), x.max(b)));
        assert!(range.1 - range.0 > 0.3, "{range:?}");
        for period in (50..1000).step_by(50) {
            let repeats = |n: usize| (lights[n] - lights[n + period]).abs() < 0.02;
            assert!((0..3000).filter(|n| repeats(*n)).count() < 1500, "every {period} mm");
        }
    }
}
