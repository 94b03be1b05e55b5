//! Letters as paths, from the bundled font.

use tiny_skia::{Path, PathBuilder};
use ttf_parser::{Face, OutlineBuilder};

use crate::paper::figure::{Piece, Type, pieces};
use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::Vec2;

/// DejaVu Sans Condensed, Latin, Greek and Cyrillic: see `font/LICENSE`.
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

    /// Checks that the font has all letters of a text.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the first letter that the font lacks.
    pub fn check(&self, text: &str) -> Result<()> {
        let lacks = |sign: &char| self.face.as_ref().is_some_and(|face| face.glyph_index(*sign).is_none());
        match pieces(text, 1.0).into_iter().map(|piece| piece.sign).find(lacks) {
            None => Ok(()),
            Some(sign) => {
                let text: String = text.chars().filter(|sign| !sign.is_control()).collect();
                let message = sentences::the_font_lacks_the_letter(&sign, &format!("{:04X}", u32::from(sign)), &text);
                Err(Error::new(ErrorKind::Input, message).help(sentences::USE_LATIN_GREEK_OR_CYRILLIC))
            }
        }
    }

    /// A text as a path (mm, y downwards), and the thickness of the line around the letters (mm).
    pub fn path(&self, at: Vec2, text: &str, set: &Type) -> (Option<Path>, f64) {
        let Some(face) = &self.face else { return (None, 0.0) };
        let unit = 1.0 / f64::from(face.units_per_em());
        let advance = |sign: char| {
            let glyph = face.glyph_index(sign).unwrap_or_default();
            (glyph, f64::from(face.glyph_hor_advance(glyph).unwrap_or_default()) * unit)
        };
        let pieces = pieces(text, set.size);
        let wide: f64 = pieces.iter().map(|Piece { sign, size, .. }| advance(*sign).1 * size).sum();
        let mut along = match set.anchor {
            "middle" => -wide / 2.0,
            "end" => -wide,
            _ => 0.0,
        };
        let (path, lean) = (PathBuilder::new(), if set.italic { LEAN } else { 0.0 });
        let mut builder = Letters { path, origin: Vec2::zeros(), scale: 0.0, lean, upward: set.upward };
        for Piece { sign, size, rise } in pieces {
            let (glyph, step) = advance(sign);
            builder.origin = Vec2::new(at.x, -at.y) + builder.turned(along, rise);
            builder.scale = size * unit;
            face.outline_glyph(glyph, &mut builder);
            along += step * size;
        }
        (builder.path.finish(), if set.bold { BOLD * set.size } else { 0.0 })
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
    /// The vector on paper (y downwards) of a step `along` the base line and of a step `rise` above the base line.
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
