//! Figures as DXF, for programs of computer-aided design.
//! The files have the format of AutoCAD release 12, which all programs read.
//! The `dxf` crate is not used, because it writes the date: the bytes would differ from run to run.

use std::fmt::Write;

use crate::paper::figure::{DrawnFigure, Ink, Type, head, pieces};
use linkage::math::Vec2;

/// A DXF file under construction. Lengths are in the unit of the file, y upwards.
pub struct Dxf(String);

impl Default for Dxf {
    fn default() -> Dxf {
        let mut own = Dxf(String::new());
        for (code, value) in [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009"), (0, "ENDSEC")] {
            own.put(code, value);
        }
        own.put(0, "SECTION");
        own.put(2, "ENTITIES");
        own
    }
}

impl Dxf {
    fn put(&mut self, code: u8, value: &str) {
        writeln!(self.0, "{code}\n{value}").expect("a text takes all");
    }

    fn point(&mut self, [x, y]: [u8; 2], at: Vec2) {
        self.put(x, &at.x.to_string());
        self.put(y, &at.y.to_string());
    }

    /// A line through points, or a polygon, on a layer.
    pub fn polyline(&mut self, layer: &str, points: impl IntoIterator<Item = Vec2>, closed: bool) {
        // The group code 66 states that vertices follow, and the group code 70 states whether the polyline is closed.
        for (code, value) in [(0, "POLYLINE"), (8, layer), (66, "1"), (70, if closed { "1" } else { "0" })] {
            self.put(code, value);
        }
        for point in points {
            self.put(0, "VERTEX");
            self.put(8, layer);
            self.point([10, 20], point);
        }
        self.put(0, "SEQEND");
    }

    fn circle(&mut self, layer: &str, centre: Vec2, radius: f64) {
        self.put(0, "CIRCLE");
        self.put(8, layer);
        self.point([10, 20], centre);
        self.put(40, &radius.to_string());
    }

    fn text(&mut self, layer: &str, at: Vec2, text: &str, set: &Type, factor: f64) {
        // The format allows only ASCII characters. Other characters are written as escape sequences.
        let letter = |sign: char| match sign.is_ascii() {
            true => sign.to_string(),
            false => format!("\\U+{:04X}", u32::from(sign)),
        };
        let letters: String = pieces(text, set.size).into_iter().map(|piece| letter(piece.sign)).collect();
        self.put(0, "TEXT");
        self.put(8, layer);
        self.point([10, 20], at);
        self.put(40, &(set.size * factor).to_string());
        self.put(1, &letters);
        self.put(50, if set.upward { "90" } else { "0" });
        self.put(
            72,
            match set.anchor {
                "middle" => "1",
                "end" => "2",
                _ => "0",
            },
        );
        self.point([11, 21], at);
    }

    /// Adds a figure, enlarged by `factor` and then moved by `offset`, on the layers of the figure.
    pub fn figure(&mut self, figure: &DrawnFigure, factor: f64, offset: Vec2) {
        for (index, ink) in figure.ink.iter().enumerate() {
            self.ink(figure.layer_of(index), ink, &|at| at * factor + offset, factor);
        }
    }

    fn ink(&mut self, layer: &str, ink: &Ink, at: &dyn Fn(Vec2) -> Vec2, factor: f64) {
        match ink {
            Ink::Line(ends, _) => self.polyline(layer, ends.map(at), false),
            Ink::Arrow(ends, ..) => {
                let (base, corners) = head(*ends);
                self.polyline(layer, [ends[0], base].map(at), false);
                self.polyline(layer, corners.map(at), true);
            }
            Ink::Shape { corners, closed, .. } => {
                self.polyline(layer, corners.iter().map(|corner| at(*corner)), *closed);
            }
            Ink::Disc { centre, radius, .. } => self.circle(layer, at(*centre), radius * factor),
            Ink::Text { at: place, text, set } => self.text(layer, at(*place), text, set, factor),
            Ink::Group { ink, .. } => ink.iter().for_each(|own| self.ink(layer, own, at, factor)),
        }
    }

    /// The text of the file.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.put(0, "ENDSEC");
        self.put(0, "EOF");
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::paper::figure::{solid, words};

    #[test]
    fn a_figure_keeps_its_layers_and_lengths() {
        let mut figure = DrawnFigure::default();
        figure.set_layer("links");
        figure.line([Vec2::zeros(), Vec2::new(2.0, 0.0)], solid("#000000", 0.5));
        figure.set_layer("joints");
        figure.disc(Vec2::new(2.0, 0.0), 1.5, "white", solid("#000000", 0.5));
        figure.text(Vec2::zeros(), "30°", words(3.0));
        let mut file = Dxf::default();
        file.figure(&figure, 10.0, Vec2::new(0.0, 1.0));
        let text = file.finish();
        assert!(text.contains("VERTEX\n8\nlinks\n10\n20\n20\n1\n"), "{text}");
        assert!(text.contains("CIRCLE\n8\njoints\n10\n20\n20\n1\n40\n15\n"), "{text}");
        assert!(text.contains("30\\U+00B0") && text.ends_with("ENDSEC\n0\nEOF\n"), "{text}");
    }
}
