//! Writes a drawing as an SVG document.

use super::figure::DrawnFigure;
use crate::palette::dark_rules;
use crate::sentences;
use svg::Document;

/// A finished drawing: a figure on white paper.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// The figure. The origin of its coordinates is the paper's upper left corner.
    pub figure: DrawnFigure,
    /// Size of the paper (mm).
    pub size: [f64; 2],
    /// Title of the document.
    pub title: String,
}

impl Drawing {
    /// The drawing as an SVG document.
    pub fn svg(&self) -> String {
        document(&self.figure, self.size, &self.title)
    }
}

/// The SVG document of a figure on white paper of the given size (mm). A viewer in dark mode shows dark paper.
/// The document's upper left corner is the figure's origin.
pub fn document(figure: &DrawnFigure, [width, height]: [f64; 2], title: &str) -> String {
    let mut document = Document::new()
        .set("width", format!("{width:.0}mm"))
        .set("height", format!("{height:.0}mm"))
        .set("viewBox", format!("0 0 {width:.0} {height:.0}"))
        .set("font-family", sentences::LIBERATION_SANS_ARIAL_HELVETICA_SANS)
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round")
        .add(svg::node::element::Title::new(super::figure::clean(title)))
        .add(svg::node::element::Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "white"));
    for node in figure.nodes() {
        document = document.add(node);
    }
    let text = format!("{document}\n");
    text.replacen("</title>\n", &format!("</title>\n<style>{}</style>\n", dark_rules(&text)), 1)
}
