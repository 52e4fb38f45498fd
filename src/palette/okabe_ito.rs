//! The colours of M. Okabe and K. Ito, "Color Universal Design" (2008), and a grey for what stands behind.

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
/// Grey, for what stands behind the data.
pub const GREY: Rgb = Rgb::new(150, 150, 150);
