//! Letters as paths, from the bundled font.

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, OutlineBuilder};

use crate::paper::figure::{Piece, Type, pieces};
use linkage::math::Vec2;

/// DejaVu Sans Condensed, Latin and Greek: see `font/LICENSE`.
const FONT: &[u8] = include_bytes!("../../font/DejaVuSansCondensed.ttf");
/// Slant of an italic letter, and outline thickness of a bold letter divided by the font size.
const LEAN: f64 = 0.2;
const BOLD: f64 = 0.045;

/// The font.
pub struct Glyphs {
    face: Option<Face<'static>>,
}

impl Glyphs {
    pub fn new() -> Glyphs {
        Glyphs { face: Face::parse(FONT, 0).ok() }
    }

    /// A text as a path (mm, y downwards), and the thickness of the line around it (mm).
    pub fn path(&self, at: Vec2, text: &str, set: &Type) -> (Option<Path>, f64) {
        let Some(face) = &self.face else { return (None, 0.0) };
        let unit = 1.0 / f64::from(face.units_per_em());
        let advance = |sign: char| {
            let glyph = face.glyph_index(sign).unwrap_or_default();
            (glyph, f64::from(face.glyph_hor_advance(glyph).unwrap_or_default()) * unit)
        };
        let pieces = pieces(text, set.size);
        let wide: f64 = pieces.iter().map(|Piece { sign, size, .. }| advance(*sign).1 * size).sum();
        let mut x = at.x
            - match set.anchor {
                "middle" => wide / 2.0,
                "end" => wide,
                _ => 0.0,
            };
        let mut builder = Letters { path: PathBuilder::new(), origin: Vec2::zeros(), scale: 0.0, lean: 0.0 };
        for Piece { sign, size, rise } in pieces {
            let (glyph, step) = advance(sign);
            builder.origin = Vec2::new(x, -at.y - rise);
            builder.scale = size * unit;
            builder.lean = if set.italic { LEAN } else { 0.0 };
            face.outline_glyph(glyph, &mut builder);
            x += step * size;
        }
        (builder.path.finish(), if set.bold { BOLD * set.size } else { 0.0 })
    }
}

struct Letters {
    path: PathBuilder,
    origin: Vec2,
    scale: f64,
    lean: f64,
}

impl Letters {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let (x, y) = (f64::from(x) * self.scale, f64::from(y) * self.scale);
        ((self.origin.x + x + self.lean * y) as f32, (self.origin.y - y) as f32)
    }
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
