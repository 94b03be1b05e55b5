//! Prims of a USD document as text, and numbers in it.

use std::fmt::{Display, Write};

pub(super) use crate::export::xml::number;
use linkage::math::Vec2;

/// Numbers in parentheses.
pub(super) fn tuple(values: impl IntoIterator<Item = f64>) -> String {
    format!("({})", values.into_iter().map(number).collect::<Vec<_>>().join(", "))
}

/// A position or direction in the plane.
pub(super) fn flat(place: Vec2) -> String {
    tuple([place.x, place.y, 0.0])
}

/// A rotation about z (rad) as a quaternion.
pub(super) fn about_z(angle: f64) -> String {
    tuple([(angle / 2.0).cos(), 0.0, 0.0, (angle / 2.0).sin()])
}

/// Text in quotation marks.
pub(super) fn quoted(text: &str) -> String {
    let escaped: String =
        text.chars().flat_map(|one| if matches!(one, '"' | '\\') { vec!['\\', one] } else { vec![one] }).collect();
    format!("\"{escaped}\"")
}

/// A USD document in memory.
pub(super) struct Usd {
    pub(super) text: String,
    depth: usize,
}

impl Usd {
    /// A stage in metres and kilograms with z upwards, whose default prim is `mechanism`.
    /// The `comments`, joined by spaces, are the documentation of the stage.
    pub(super) fn new(comments: &[String]) -> Usd {
        let mut usd = Usd { text: "#usda 1.0\n(\n".into(), depth: 1 };
        usd.line(r#"defaultPrim = "mechanism""#);
        usd.line(format_args!("doc = {}", quoted(&comments.join(" "))));
        ["kilogramsPerUnit = 1", "metersPerUnit = 1", r#"upAxis = "Z""#].iter().for_each(|line| usd.line(line));
        usd.depth = 0;
        usd.line(")");
        usd
    }

    pub(super) fn line(&mut self, content: impl Display) {
        let _ = writeln!(self.text, "{:1$}{content}", "", 4 * self.depth);
    }

    pub(super) fn comment(&mut self, text: &str) {
        self.line(format_args!("# {text}"));
    }

    /// A prim with its metadata and its contents.
    pub(super) fn prim(&mut self, kind: &str, name: &str, facts: &[String], inside: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.text);
        self.line(format_args!("def {kind} \"{name}\"{}", if facts.is_empty() { "" } else { " (" }));
        if !facts.is_empty() {
            facts.iter().for_each(|fact| self.line(format_args!("    {fact}")));
            self.line(")");
        }
        self.line("{");
        self.depth += 1;
        inside(self);
        self.depth -= 1;
        self.line("}");
    }
}
