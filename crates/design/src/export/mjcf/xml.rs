//! Elements of an XML document, and numbers in it.

use std::fmt::{Arguments, Write};

use linkage::math::Vec2;

/// Shortest text that is parsed as the same number.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if (1e-4..1e7).contains(&size) => format!("{value}"),
        _ => format!("{value:e}"),
    }
}

pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

/// A position in the plane.
pub(super) fn flat(place: Vec2) -> String {
    numbers([place.x, place.y, 0.0])
}

/// A rotation about z.
pub(super) fn about_z(angle: f64) -> String {
    numbers([0.0, 0.0, 1.0, angle])
}

/// An XML document in memory, a line for every tag. Tags are given as they are written, without their brackets: names
/// from outside must be [escaped](quick_xml::escape::escape).
pub(super) struct Xml {
    pub(super) text: String,
    depth: usize,
}

impl Xml {
    pub(super) fn new() -> Xml {
        Xml { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into(), depth: 0 }
    }

    fn line(&mut self, content: Arguments) {
        let _ = writeln!(self.text, "{:1$}{content}", "", 2 * self.depth);
    }

    pub(super) fn leaf(&mut self, tag: Arguments) {
        self.line(format_args!("<{tag}/>"));
    }

    pub(super) fn nest(&mut self, name: &str, attributes: Arguments, inside: impl FnOnce(&mut Self)) {
        self.line(format_args!("<{name}{attributes}>"));
        self.depth += 1;
        inside(self);
        self.depth -= 1;
        self.line(format_args!("</{name}>"));
    }

    pub(super) fn comment(&mut self, text: &str) {
        self.line(format_args!("<!-- {text} -->"));
    }
}
