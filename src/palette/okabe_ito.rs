//! The colours of M. Okabe and K. Ito, "Color Universal Design" (2008), and a grey for what stands behind. Magenta,
//! brown, lime and maroon are for comparisons: who does not tell their hues apart sees that lime is lighter and maroon darker than the others.
//! They and violet are seen on black and on white.

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
/// Pink: the palette's authors call it reddish purple.
pub const PINK: Rgb = Rgb::new(204, 121, 167);
/// Magenta.
pub const MAGENTA: Rgb = Rgb::new(221, 52, 151);
/// Violet, between blue and reddish purple, darker than the one and bluer than the other.
pub const VIOLET: Rgb = Rgb::new(126, 98, 226);
/// Brown.
pub const BROWN: Rgb = Rgb::new(160, 100, 50);
/// Lime, lighter than every green beside it.
pub const LIME: Rgb = Rgb::new(136, 204, 119);
/// Maroon, darker than every other but black.
pub const MAROON: Rgb = Rgb::new(150, 35, 65);
/// Grey, for what stands behind the data.
pub const GREY: Rgb = Rgb::new(150, 150, 150);
