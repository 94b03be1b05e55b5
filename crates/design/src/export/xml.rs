//! Elements of an XML document, and numbers in it.

use std::fmt::{Display, Write};

use linkage::math::Vec2;

/// The shortest text from which a parser reads the same number.
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

/// An XML document in memory, with one line for every tag.
/// Callers pass tags as they are written, but without the angle brackets.
/// Names from outside must be [escaped](quick_xml::escape::escape).
pub(super) struct Xml {
    pub(super) text: String,
    depth: usize,
}

impl Xml {
    pub(super) fn new() -> Xml {
        Xml { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".into(), depth: 0 }
    }

    fn line(&mut self, content: &str) {
        let _ = writeln!(self.text, "{:1$}{content}", "", 2 * self.depth);
    }

    pub(super) fn leaf(&mut self, tag: impl Display) {
        self.line(&format!("<{tag}/>"));
    }

    pub(super) fn nest<T>(&mut self, tag: impl Display, inside: impl FnOnce(&mut Self) -> T) {
        let tag = tag.to_string();
        self.line(&format!("<{tag}>"));
        self.depth += 1;
        inside(self);
        self.depth -= 1;
        self.line(&format!("</{}>", tag.split(' ').next().unwrap_or_default()));
    }

    /// An element with a value.
    pub(super) fn value(&mut self, tag: &str, value: impl Display) {
        self.line(&format!("<{tag}>{value}</{tag}>"));
    }

    /// A comment.
    /// XML does not permit `--` in a comment.
    pub(super) fn comment(&mut self, text: &str) {
        self.line(&format!("<!-- {} -->", text.replace("--", "- -")));
    }
}
