//! The colours of M. Okabe and K. Ito, "Color Universal Design" (2008), and a grey for what stands behind. Magenta and
//! brown, for comparisons, are as bright as each other and darker than orange: they and violet are seen on black and on white.

use super::Rgb;

/// Black.
pub const BLACK: Rgb = Rgb::new(0, 0, 0);
/// Orange.
pub const ORANGE: Rgb = Rgb::new(230, 159, 0);
/// Sky blue.
pub const SKY_BLUE: Rgb = Rgb::new(86, 180, 233);
/// Bluish green.
pub const GREEN: Rgb = Rgb::new(0, 158, 115);
/// Yellow.
pub const YELLOW: Rgb = Rgb::new(240, 228, 66);
/// Blue.
pub const BLUE: Rgb = Rgb::new(0, 114, 178);
/// Vermilion.
pub const VERMILION: Rgb = Rgb::new(213, 94, 0);
/// Reddish purple.
pub const PURPLE: Rgb = Rgb::new(204, 121, 167);
/// Magenta.
pub const MAGENTA: Rgb = Rgb::new(221, 52, 151);
/// Violet, between blue and reddish purple, darker than the one and bluer than the other.
pub const VIOLET: Rgb = Rgb::new(126, 98, 226);
/// Brown.
pub const BROWN: Rgb = Rgb::new(160, 100, 50);
/// Grey, for what stands behind the data.
pub const GREY: Rgb = Rgb::new(150, 150, 150);
