//! Contract: a picture is the drawing: of its size, in its colours, with its words although no font may be installed.

use cpdmp::figure::{Axis, Chart, Figure, Mark, png, svg};
use cpdmp::palette::{BLACK, BLUE, ORANGE, Rgb};

/// A page of 320 pt with a blue line, an orange area and a title.
fn figure(title: &str) -> Figure {
    let mut panel = Chart::plot("", [Axis::new(""), Axis::new("")]);
    panel.marks = vec![
        Mark::line("line", BLUE, 2.0, vec![[0.0, 0.0], [1.0, 1.0]]),
        Mark::area("area", ORANGE, 1.0, vec![[0.0, 0.5], [0.4, 0.5], [0.4, 1.0], [0.0, 1.0]]),
    ];
    Figure { title: title.into(), panels: vec![panel], columns: 1, panel_size_pt: [320.0, 240.0] }
}

/// Width (pixels), pixels per metre, and all pixels.
fn opened(file: &[u8]) -> (usize, u32, Vec<Rgb>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut bytes).expect("a whole PNG");
    assert_eq!((frame.color_type, frame.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    let per_metre = reader.info().pixel_dims.expect("a size on paper").xppu;
    (frame.width as usize, per_metre, bytes.chunks(3).map(|rgb| Rgb::new(rgb[0], rgb[1], rgb[2])).collect())
}

#[test]
fn size_and_colours_are_those_of_the_drawing() {
    let (width, per_metre, pixels) = opened(&png(&svg(&figure("A title")).expect("drawn")).expect("a picture"));
    assert_eq!(width, (320.0_f64 / 72.0 * 200.0).round() as usize, "200 pixels per inch");
    assert_eq!(per_metre, (200.0_f64 / 0.0254).round() as u32);
    let share = |color: Rgb| pixels.iter().filter(|pixel| **pixel == color).count() as f64 / pixels.len() as f64;
    assert_eq!(pixels[0], Rgb::new(255, 255, 255), "the page is white");
    assert!(share(Rgb::new(255, 255, 255)) > 0.5 && share(BLUE) > 0.003 && share(ORANGE) > 0.05 && share(BLACK) > 0.001);
}

/// The heading's strip, the upper 26 pt of the page, is white without words.
#[test]
fn words_are_there() {
    let dark_in_heading = |title: &str| {
        let (width, _, pixels) = opened(&png(&svg(&figure(title)).expect("drawn")).expect("a picture"));
        pixels[..26 * 200 / 72 * width].iter().filter(|pixel| pixel.red < 128).count()
    };
    assert_eq!(dark_in_heading(""), 0);
    let (short, long) = (dark_in_heading("words"), dark_in_heading("words words"));
    assert!(short > 200 && long.abs_diff(2 * short) < short / 10, "{short} dark pixels for one word, {long} for two");
}

#[test]
fn equal_drawings_are_equal_pictures_and_what_is_no_drawing_is_an_error() {
    let drawing = svg(&figure("A title")).expect("drawn");
    assert_eq!(png(&drawing).expect("a picture"), png(&drawing).expect("a picture"));
    assert!(png("no drawing").expect_err("no SVG").to_string().contains("no picture"));
}
