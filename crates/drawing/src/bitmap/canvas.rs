//! Paints a figure into pixels.

use crate::sentences;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapPaint, Stroke, StrokeDash, Transform,
};

use super::glyphs::Glyphs;
use crate::paper::figure::{DrawnFigure, Ink, Style, Tint, head};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;

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
    let mut canvas = Canvas { pixmap, view: Transform::from_scale(scale as f32, scale as f32), glyphs: Glyphs::new() };
    for ink in &figure.ink {
        canvas.draw(ink);
    }
    let Canvas { pixmap, .. } = canvas;
    Ok(Bitmap { width: pixels, height: rows as u32, rgba: pixmap.take() })
}

struct Canvas {
    pixmap: Pixmap,
    view: Transform,
    glyphs: Glyphs,
}

impl Canvas {
    fn draw(&mut self, ink: &Ink) {
        match ink {
            Ink::Line(ends, style) => self.paint(line(ends).finish(), None, style),
            Ink::Arrow(ends, style, _) => {
                let (base, corners) = head(*ends);
                self.paint(line(&[ends[0], base]).finish(), None, style);
                self.paint(polygon(&corners), Some(Tint::opaque(style.colour)), &Style { width: 0.0, ..*style });
            }
            Ink::Shape { corners, closed: true, fill, style } => self.paint(polygon(corners), *fill, style),
            Ink::Shape { corners, closed: false, fill, style } => self.paint(line(corners).finish(), *fill, style),
            Ink::Disc { centre, radius, fill, style } => {
                let path = PathBuilder::from_circle(centre.x as f32, -centre.y as f32, *radius as f32);
                self.paint(path, (*fill != "none").then_some(Tint::opaque(fill)), style);
            }
            Ink::Text { at, text, set } => {
                let (path, strength) = self.glyphs.path(*at, text, set);
                let style = Style { colour: set.colour, width: strength, dash: "" };
                self.paint(path, Some(Tint::opaque(set.colour)), &style);
            }
            Ink::Group { ink, opacity, .. } => {
                let Some(layer) = Pixmap::new(self.pixmap.width(), self.pixmap.height()) else { return };
                let below = std::mem::replace(&mut self.pixmap, layer);
                ink.iter().for_each(|own| self.draw(own));
                let layer = std::mem::replace(&mut self.pixmap, below);
                let paint = PixmapPaint { opacity: *opacity as f32, ..PixmapPaint::default() };
                self.pixmap.draw_pixmap(0, 0, layer.as_ref(), &paint, Transform::identity(), None);
            }
        }
    }

    fn paint(&mut self, path: Option<Path>, fill: Option<Tint>, style: &Style) {
        let Some(path) = path else { return };
        if let Some(tint) = fill {
            self.pixmap.fill_path(&path, &paint(tint), FillRule::Winding, self.view, None);
        }
        if style.width > 0.0 {
            let dashes: Vec<f32> = style.dash.split_whitespace().filter_map(|part| part.parse().ok()).collect();
            let stroke = Stroke {
                width: style.width as f32,
                line_cap: LineCap::Round,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dashes, 0.0),
                ..Stroke::default()
            };
            self.pixmap.stroke_path(&path, &paint(Tint::opaque(style.colour)), &stroke, self.view, None);
        }
    }
}

fn line(corners: &[Vec2]) -> PathBuilder {
    let mut path = PathBuilder::new();
    for (index, corner) in corners.iter().enumerate() {
        let (x, y) = (corner.x as f32, -corner.y as f32);
        if index == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path
}

fn polygon(corners: &[Vec2]) -> Option<Path> {
    let mut path = line(corners);
    path.close();
    path.finish()
}

/// A paint from `#rrggbb` or `white`; black for anything else.
fn paint(Tint { colour, opacity }: Tint) -> Paint<'static> {
    let part = |at: usize| colour.get(at..at + 2).and_then(|part| u8::from_str_radix(part, 16).ok()).unwrap_or(0);
    let [red, green, blue] = if colour == "white" { [255; 3] } else { [1, 3, 5].map(part) };
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(red, green, blue, (opacity * 255.0).round() as u8);
    paint
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::figure::solid;

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
        // The first tested pixel is outside both squares, the second in the first square only, and the third in both
        // squares.
        assert_eq!(grey(5), 255);
        assert!(grey(20).abs_diff(128) <= 1 && grey(20) == grey(40), "{} {}", grey(20), grey(40));
    }
}
