//! An XML file as a tree. Errors state the line.

use crate::sentences;
use linkage::error::{Error, ErrorKind, Place, Result};
use linkage::math::Vec2;
use roxmltree::{Document, Node, ParsingOptions};
use std::path::Path;
use std::sync::Arc;

/// Upper limit of the number of elements, comments and texts.
const MOST_NODES: u32 = 100_000;

/// A file and its tree of elements.
pub(super) struct XmlFile<'a> {
    path: &'a Path,
    shared: Arc<str>,
    pub(super) tree: Document<'a>,
}

impl<'a> XmlFile<'a> {
    /// Parses the file at `path`, whose content is `text`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a text that is not XML, with its line.
    pub(super) fn of(text: &'a str, path: &'a Path) -> Result<XmlFile<'a>> {
        let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
        let shared: Arc<str> = text.into();
        let tree = Document::parse_with_options(text, options).map_err(|error| {
            let row = error.pos().row.saturating_sub(1) as usize;
            let start = text.split_inclusive('\n').take(row).map(str::len).sum::<usize>();
            let end = text[start..].find('\n').map_or(text.len(), |length| start + length);
            let place = Place { file: path.into(), text: shared.clone(), span: start..end };
            let message = sentences::the_file_is_no_xml(&error);
            Error::new(ErrorKind::Input, message).at(place).help(sentences::SAVE_THE_FILE_AGAIN)
        })?;
        Ok(XmlFile { path, shared, tree })
    }

    /// An error at an element.
    pub(super) fn fault(&self, node: Node, kind: ErrorKind, message: String, help: &'static str) -> Error {
        let start = node.range().start;
        let end = self.shared[start..].find(['\n', '>']).map_or(self.shared.len(), |length| start + length);
        let place = Place { file: self.path.into(), text: self.shared.clone(), span: start..end };
        Error::new(kind, message).at(place).help(help)
    }

    /// Line of an element, counted from 1.
    pub(super) fn line(&self, node: Node) -> u32 {
        self.tree.text_pos_at(node.range().start).row
    }

    /// A required attribute.
    pub(super) fn text(&self, node: Node<'a, 'a>, name: &str) -> Result<&'a str> {
        let missing = || self.wrong(node, sentences::the_element_has_no(&node.tag_name().name(), &name));
        node.attribute(name).ok_or_else(missing)
    }

    /// The numbers of an attribute; `None` without the attribute.
    pub(super) fn numbers(&self, node: Node, name: &str) -> Result<Option<Vec<f64>>> {
        let Some(text) = node.attribute(name) else { return Ok(None) };
        let all = text.split_ascii_whitespace().map(|own| own.parse().ok().filter(|own: &f64| own.abs() <= 1e30));
        let all: Option<Vec<f64>> = all.collect();
        all.map(Some).ok_or_else(|| self.wrong(node, sentences::is_no_list_of_numbers(&name, &text)))
    }

    /// An attribute of one number; `otherwise` without the attribute.
    pub(super) fn number(&self, node: Node, name: &str, otherwise: f64) -> Result<f64> {
        match self.numbers(node, name)?.as_deref() {
            None => Ok(otherwise),
            Some([number]) => Ok(*number),
            Some(other) => Err(self.wrong(node, sentences::expected_so_many_numbers(&name, &1, &other.len()))),
        }
    }

    /// Reads a vector of three numbers whose z component is zero. Without the attribute, the vector is zero.
    pub(super) fn flat(&self, node: Node, name: &str) -> Result<Vec2> {
        match self.numbers(node, name)?.as_deref() {
            None => Ok(Vec2::zeros()),
            Some([x, y, 0.0]) => Ok(Vec2::new(*x, *y)),
            Some([_, _, z]) => Err(self.wrong(node, sentences::it_leaves_the_plane(&name, z))),
            Some(other) => Err(self.wrong(node, sentences::expected_so_many_numbers(&name, &3, &other.len()))),
        }
    }

    /// An error of the content of an element.
    pub(super) fn wrong(&self, node: Node, message: String) -> Error {
        self.fault(node, ErrorKind::Input, message, sentences::SAVE_THE_FILE_AGAIN)
    }
}
