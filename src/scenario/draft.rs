//! What a file states of a mechanism that cannot be assembled, for a picture of it.

use std::path::Path;

use super::asked::Asked;
use super::reader::Table;
use super::source::{Source, text_of};
use super::stated::Stated;
use super::{parameter_table, start};
use linkage::drive::{Drives, Load};
use linkage::error::Result;
use linkage::math::Vec2;
use linkage::mechanism::{Mechanism, StartGroup, Structure};

/// The mechanism of a scenario file, whether or not it can be assembled.
#[derive(Clone, Debug)]
pub struct Draft {
    /// Short name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Links and joints.
    pub mechanism: Mechanism,
    /// Its groups, or why it has none.
    pub structure: Result<Structure>,
    /// What moves it.
    pub drives: Drives,
    /// What loads it.
    pub loads: Vec<Load>,
    /// Acceleration of gravity (m/s^2).
    pub gravity: Vec2,
    /// Crank angle at t = 0 (rad).
    pub crank: f64,
    /// The start of each group, as far as the file gives it and it is sound; in the order of the structure.
    pub starts: Vec<StartGroup>,
}

impl Draft {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// Those of [`Scenario::load_as`](super::Scenario::load_as), but for the structure, the first pose, and what rests on
    /// it.
    pub fn load(path: &Path, asked: &Asked) -> Result<Draft> {
        Draft::parse(&text_of(path)?, path, asked)
    }

    /// The same from the text of the file.
    ///
    /// # Errors
    /// Those of [`Draft::load`], except that the file cannot be read.
    pub fn parse(text: &str, path: &Path, asked: &Asked) -> Result<Draft> {
        let plain = Source::new(path, text);
        let tree = plain.tree()?;
        let table = Table::root(&plain, &tree).optional_table("parameters")?;
        let parameters = parameter_table::read(table, &asked.set, asked.adds_parameters)?;
        let source = plain.with(parameters);
        let found = Table::root(&source, &tree).read(|root| read(root, asked));
        found.map_err(|error| source.located(tree.get_ref(), error))
    }
}

fn read(root: &mut Table, asked: &Asked) -> Result<Draft> {
    let Stated { name, title, mechanism, drives, crank, loads, gravity, start, groups, .. } =
        Stated::read(root, asked)?;
    let structure = Structure::of(&mechanism, &drives.joints());
    let starts = structure.as_ref().map_or_else(
        |_| Vec::new(),
        |structure| {
            let wanted = asked.groups(&mechanism, structure).unwrap_or_default();
            let none = vec![StartGroup::default(); structure.groups.len()];
            let mut starts = start::groups(&start, groups, &mechanism, structure, &wanted).unwrap_or(none);
            for (index, group) in wanted {
                starts[index] = group;
            }
            starts
        },
    );
    let crank = asked.crank.unwrap_or(crank);
    Ok(Draft { name, title, mechanism, structure, drives, loads, gravity, crank, starts })
}
