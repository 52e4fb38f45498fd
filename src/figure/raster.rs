//! From SVG to PNG. Text is set in a font that the program brings: a picture is the same on every machine, fonts installed or not.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::error::FigureError;

/// Pixels per point of the page: 200 per inch, enough for print and for a screen.
const PIXELS_PER_PT: f64 = 200.0 / 72.0;

/// Metres per point.
const POINT_M: f64 = 0.0254 / 72.0;

/// The family that words of a figure are set in.
const FONT: &str = "Noto Sans";

/// The picture (PNG, 8-bit RGB, white behind) of a drawing that [`svg`](super::svg()) made, with its size in pixels per metre. Equal drawings
/// give equal bytes.
///
/// # Errors
/// When the text is no SVG document, or one of no size.
pub fn png(document: &str) -> Result<Vec<u8>, FigureError> {
    let fault = |error: &dyn std::fmt::Display| FigureError::Raster(error.to_string());
    let tree = Tree::from_str(document, &options()).map_err(|error| fault(&error))?;
    // The library measures in the pixels of a browser, of which an inch has 96.
    let scale = PIXELS_PER_PT * 72.0 / 96.0;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|length| (f64::from(length) * scale).round() as u32);
    let mut pixels = Pixmap::new(width, height).ok_or_else(|| fault(&format!("{width} x {height} pixels are no picture")))?;
    pixels.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale as f32, scale as f32), &mut pixels.as_mut());
    encode(&pixels).map_err(|error| fault(&error))
}

fn options() -> Options<'static> {
    let mut options = Options { font_family: FONT.to_owned(), ..Options::default() };
    let fonts = options.fontdb_mut();
    for font in [notosans::REGULAR_TTF, notosans::BOLD_TTF] {
        fonts.load_font_data(font.to_vec());
    }
    fonts.set_sans_serif_family(FONT);
    options
}

fn encode(pixels: &Pixmap) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::Fast);
    let per_metre = (PIXELS_PER_PT / POINT_M).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }));
    let opaque: Vec<u8> = pixels.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&opaque)?;
    writer.finish()?;
    Ok(file)
}
