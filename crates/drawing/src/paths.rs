//! The elements of a figure as paths for bitmaps and PDF: strokes, filled areas and the outlines of letters.

mod glyphs;

use std::collections::BTreeSet;

use tiny_skia::{Path, PathBuilder};

use crate::paper::figure::{DrawnFigure, Ink, Style, Tint, head};
use crate::sentences;
pub(crate) use glyphs::Glyphs;
use linkage::error::{Error, ErrorKind};
use linkage::math::Vec2;

/// A bitmap or PDF page that receives paths (mm, y downwards).
pub(crate) trait Surface {
    /// Fills a path, then strokes it. A width of zero means no stroke.
    fn paint(&mut self, path: Option<Path>, fill: Option<Tint>, style: &Style);

    /// Calls `draw`. Everything that `draw` paints appears as one element with the opacity `opacity`.
    fn group(&mut self, opacity: f64, draw: &mut dyn FnMut(&mut Self));
}

/// Draws a figure on a surface.
pub(crate) fn draw(figure: &DrawnFigure, surface: &mut impl Surface) {
    let glyphs = Glyphs::bundled();
    figure.ink.iter().for_each(|ink| put(ink, glyphs, surface));
}

/// A warning if the font for bitmaps and PDF lacks letters that occur in the figures. It lists these letters and
/// suggests a remedy. `None` if no letter is missing.
pub fn lacking_letters<'a>(figures: impl Iterator<Item = &'a DrawnFigure>) -> Option<Error> {
    let mut found = BTreeSet::new();
    figures.for_each(|figure| collect(&figure.ink, &mut found));
    let told: Vec<String> = found.iter().map(|sign| format!("\"{sign}\" (U+{:04X})", u32::from(*sign))).collect();
    let warning = || Error::new(ErrorKind::Input, sentences::the_font_lacks(&told.join(", ")));
    (!told.is_empty()).then(|| warning().help(sentences::WRITE_AN_SVG))
}

fn collect(ink: &[Ink], found: &mut BTreeSet<char>) {
    for own in ink {
        match own {
            Ink::Text { text, .. } => found.extend(Glyphs::bundled().lacking(text)),
            Ink::Group { ink, .. } => collect(ink, found),
            Ink::Line(..) | Ink::Arrow(..) | Ink::Shape { .. } | Ink::Disc { .. } => {}
        }
    }
}

fn put<S: Surface>(ink: &Ink, glyphs: &Glyphs, surface: &mut S) {
    match ink {
        Ink::Line(ends, style) => surface.paint(line(ends).finish(), None, style),
        Ink::Arrow(ends, style, _) => {
            let (base, corners) = head(*ends);
            surface.paint(line(&[ends[0], base]).finish(), None, style);
            surface.paint(polygon(&corners), Some(Tint::opaque(style.colour)), &Style { width: 0.0, ..*style });
        }
        Ink::Shape { corners, closed: true, fill, style } => surface.paint(polygon(corners), *fill, style),
        Ink::Shape { corners, closed: false, fill, style } => surface.paint(line(corners).finish(), *fill, style),
        Ink::Disc { centre, radius, fill, style } => {
            let path = PathBuilder::from_circle(centre.x as f32, -centre.y as f32, *radius as f32);
            surface.paint(path, (*fill != "none").then_some(Tint::opaque(fill)), style);
        }
        Ink::Text { at, text, set } => {
            let style = Style { colour: set.colour, width: 0.0, dash: "" };
            surface.paint(glyphs.path(*at, text, set), Some(Tint::opaque(set.colour)), &style);
        }
        Ink::Group { ink, opacity: 1.0.., .. } => ink.iter().for_each(|own| put(own, glyphs, surface)),
        Ink::Group { ink, opacity, .. } => {
            surface.group(*opacity, &mut |surface| ink.iter().for_each(|own| put(own, glyphs, surface)));
        }
    }
}

/// Red, green and blue of a colour `#rrggbb` or `white`; black for any other text.
pub(crate) fn rgb(colour: &str) -> [u8; 3] {
    let part = |at: usize| colour.get(at..at + 2).and_then(|part| u8::from_str_radix(part, 16).ok()).unwrap_or(0);
    if colour == "white" { [255; 3] } else { [1, 3, 5].map(part) }
}

/// Lengths of strokes and gaps of a dashed line (mm); empty for a solid line.
pub(crate) fn dashes(style: &Style) -> Vec<f32> {
    style.dash.split_whitespace().filter_map(|part| part.parse().ok()).collect()
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
