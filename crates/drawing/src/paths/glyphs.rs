//! Letters as paths, from the bundled font.

use std::sync::OnceLock;

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, OutlineBuilder};

use crate::paper::figure::{Piece, Type, pieces};
use linkage::math::Vec2;

/// DejaVu Sans Condensed, Latin, Greek and Cyrillic: see `font/LICENSE`.
const FONT: &[u8] = include_bytes!("../../font/DejaVuSansCondensed.ttf");
/// Slant of an italic letter. The second number is the additional stroke width of a bold letter, divided by the font
/// size.
const LEAN: f64 = 0.2;
const BOLD: f64 = 0.045;

/// The font.
pub struct Glyphs {
    face: Option<Face<'static>>,
}

impl Glyphs {
    /// The bundled font, read once.
    pub fn bundled() -> &'static Glyphs {
        static READ: OnceLock<Glyphs> = OnceLock::new();
        READ.get_or_init(|| Glyphs { face: Face::parse(FONT, 0).ok() })
    }

    /// Width of a letter divided by the font size.
    fn advance(&self, sign: char) -> f64 {
        let of = |face: &Face| {
            let glyph = face.glyph_index(sign).unwrap_or_default();
            f64::from(face.glyph_hor_advance(glyph).unwrap_or_default()) / f64::from(face.units_per_em())
        };
        self.face.as_ref().map_or(0.0, of)
    }

    /// Width of a text (mm) at the font size `size` (mm).
    pub fn width(&self, text: &str, size: f64) -> f64 {
        pieces(text, size).iter().map(|piece| self.advance(piece.sign) * piece.size).sum()
    }

    /// The letters of a text that the font lacks. A box is drawn in place of each such letter.
    pub fn lacking(&self, text: &str) -> impl Iterator<Item = char> {
        let lacks = |sign: &char| self.face.as_ref().is_some_and(|face| face.glyph_index(*sign).is_none());
        pieces(text, 1.0).into_iter().map(|piece| piece.sign).filter(lacks)
    }

    /// A text as a path (mm, y downwards). In a bold text, each letter has two outlines, slightly displaced from each
    /// other.
    pub fn path(&self, at: Vec2, text: &str, set: &Type) -> Option<Path> {
        let face = self.face.as_ref()?;
        let mut along = match set.anchor {
            "middle" => -self.width(text, set.size) / 2.0,
            "end" => -self.width(text, set.size),
            _ => 0.0,
        };
        let (path, lean) = (PathBuilder::new(), if set.italic { LEAN } else { 0.0 });
        let mut builder = Letters { path, origin: Vec2::zeros(), scale: 0.0, lean, upward: set.upward };
        let shifts: &[f64] = if set.bold { &[-BOLD / 2.0, BOLD / 2.0] } else { &[0.0] };
        for Piece { sign, size, rise } in pieces(text, set.size) {
            builder.scale = size / f64::from(face.units_per_em());
            for shift in shifts {
                builder.origin = Vec2::new(at.x, -at.y) + builder.turned(along + shift * size, rise);
                face.outline_glyph(face.glyph_index(sign).unwrap_or_default(), &mut builder);
            }
            along += self.advance(sign) * size;
        }
        builder.path.finish()
    }
}

struct Letters {
    path: PathBuilder,
    origin: Vec2,
    scale: f64,
    lean: f64,
    upward: bool,
}

impl Letters {
    /// Displacement on paper (y downwards): `along` in the direction of the base line, and `rise` above this line.
    fn turned(&self, along: f64, rise: f64) -> Vec2 {
        if self.upward { Vec2::new(-rise, -along) } else { Vec2::new(along, -rise) }
    }

    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        let (x, y) = (f64::from(x) * self.scale, f64::from(y) * self.scale);
        let at = self.origin + self.turned(x + self.lean * y, y);
        (at.x as f32, at.y as f32)
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
