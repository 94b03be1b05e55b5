//! Paints a figure into pixels.

use crate::sentences;
use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, Pixmap, PixmapPaint, Stroke, StrokeDash, Transform};

use crate::paper::figure::{DrawnFigure, Style, Tint};
use crate::paths::{Surface, dashes, rgb};
use linkage::error::{Error, ErrorKind, Result};

/// Largest number of pixels.
const MOST: f64 = 4e7;

/// Pixels, row by row from the top, opaque.
#[derive(Clone, Debug, PartialEq)]
pub struct Bitmap {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue and opacity of each pixel.
    pub rgba: Vec<u8>,
}

/// A figure on white paper of this size (mm), as a bitmap `pixels` wide. The paper's upper left corner is the figure's
/// origin.
///
/// # Errors
/// [`ErrorKind::Input`] for more than forty million pixels, or for zero pixels.
pub fn bitmap(figure: &DrawnFigure, [width, height]: [f64; 2], pixels: u32) -> Result<Bitmap> {
    let scale = f64::from(pixels) / width;
    let rows = (height * scale).round();
    if !(rows >= 1.0 && rows * f64::from(pixels) <= MOST) {
        let message = sentences::a_picture_of_by_pixels_is_asked(&pixels, &rows);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_WIDTH_BETWEEN_AND_PIXELS));
    }
    let none = || Error::new(ErrorKind::Input, sentences::THERE_IS_NO_MEMORY_FOR_THE_PICTURE);
    let mut pixmap = Pixmap::new(pixels, rows as u32).ok_or_else(none)?;
    pixmap.fill(Color::WHITE);
    let mut canvas = Canvas { pixmap, view: Transform::from_scale(scale as f32, scale as f32) };
    crate::paths::draw(figure, &mut canvas);
    let Canvas { pixmap, .. } = canvas;
    Ok(Bitmap { width: pixels, height: rows as u32, rgba: pixmap.take() })
}

struct Canvas {
    pixmap: Pixmap,
    view: Transform,
}

impl Surface for Canvas {
    fn group(&mut self, opacity: f64, draw: &mut dyn FnMut(&mut Canvas)) {
        let Some(layer) = Pixmap::new(self.pixmap.width(), self.pixmap.height()) else { return };
        let below = std::mem::replace(&mut self.pixmap, layer);
        draw(self);
        let layer = std::mem::replace(&mut self.pixmap, below);
        let paint = PixmapPaint { opacity: opacity as f32, ..PixmapPaint::default() };
        self.pixmap.draw_pixmap(0, 0, layer.as_ref(), &paint, Transform::identity(), None);
    }

    fn paint(&mut self, path: Option<Path>, fill: Option<Tint>, style: &Style) {
        let Some(path) = path else { return };
        if let Some(tint) = fill {
            self.pixmap.fill_path(&path, &paint(tint), FillRule::Winding, self.view, None);
        }
        if style.width > 0.0 {
            let stroke = Stroke {
                width: style.width as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dashes(style), 0.0),
                ..Stroke::default()
            };
            self.pixmap.stroke_path(&path, &paint(Tint::opaque(style.colour)), &stroke, self.view, None);
        }
    }
}

/// A paint of a colour and opacity.
fn paint(Tint { colour, opacity }: Tint) -> Paint<'static> {
    let [red, green, blue] = rgb(colour);
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (opacity * 255.0).round() as u8);
    paint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::figure::solid;
    use linkage::math::Vec2;

    #[test]
    fn overlaps_within_a_group_are_not_darker() {
        let square = |from: f64| {
            [(0.0, 0.0), (4.0, 0.0), (4.0, -4.0), (0.0, -4.0)].map(|(x, y)| Vec2::new(x + from, y - 3.0)).to_vec()
        };
        let (mut group, mut figure) = (DrawnFigure::default(), DrawnFigure::default());
        for from in [1.0, 3.0] {
            group.area(square(from), Some(Tint::opaque("#000000")), solid("#000000", 0.0));
        }
        figure.group(group, 0.5, "two squares".into());
        let bitmap = bitmap(&figure, [10.0, 10.0], 100).unwrap();
        let grey = |x: usize| bitmap.rgba[4 * (50 * 100 + x)];
        // The test reads three pixels: outside both squares, in the first square only, and in both squares.
        assert_eq!(grey(5), 255);
        assert!(grey(20).abs_diff(128) <= 1 && grey(20) == grey(40), "{} {}", grey(20), grey(40));
    }
}
