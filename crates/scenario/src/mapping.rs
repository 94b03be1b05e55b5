//! Mapping files. A mapping file maps the numbers of another program's table to the channels of a mechanism.

use crate::sentences;
use std::path::Path;

use super::reader::TomlTable;
use super::source::Source;
use super::words::suggestion;
use formula::FormulaFault;
use linkage::error::{Error, ErrorKind, Place, Result};
use linkage::input::Input;

/// The mapping of the numbers of a table to instants and channels.
#[derive(Clone, Debug, Default)]
pub struct Mapping {
    /// The instants of the rows, under names such as `time_s`.
    pub at: Vec<Mapped>,
    /// Channels, or arithmetic expressions of channels.
    pub channels: Vec<Mapped>,
    /// Allowed differences.
    pub allowed: Vec<Allowed>,
}

/// A channel, and the arithmetic expression of table columns that gives the channel.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// The channel in the unit of its name, such as `link.rocker.angle_deg`; or a name of [`INSTANTS`].
    pub name: String,
    /// An arithmetic expression of the table's columns.
    pub text: String,
    place: Place,
    start: usize,
}

/// An allowed difference.
#[derive(Clone, Debug, PartialEq)]
pub struct Allowed {
    /// A channel, or a word for several channels; `None` for all channels.
    pub of: Option<String>,
    /// Size of the allowed difference.
    pub size: Size,
}

/// An allowed difference, by the quantity to which it refers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// In the channel's unit.
    Absolute(f64),
    /// The difference as a fraction of the channel's scale.
    Relative(f64),
    /// The difference as a fraction of each value.
    OfValue(f64),
}

/// A key of allowed differences, and the kind of difference that the key states.
type Sized = (&'static str, fn(f64) -> Size);

/// All keys of allowed differences, in the order of the kinds.
const SIZES: [Sized; 3] = [("abs", Size::Absolute), ("rel", Size::Relative), ("rel_value", Size::OfValue)];

impl Size {
    /// Index of the kind of difference, from 0: in units, as a fraction of the scale, as a fraction of each value.
    #[must_use]
    pub fn kind(self) -> usize {
        self.parts().0
    }

    fn parts(self) -> (usize, f64) {
        match self {
            Size::Absolute(number) => (0, number),
            Size::Relative(number) => (1, number),
            Size::OfValue(number) => (2, number),
        }
    }
}

/// Names for the instants of rows, each with its factor to SI. The last entry is the kind of input that the name
/// measures; `None` for a time.
pub const INSTANTS: [(&str, f64, Option<Input>); 8] = [
    ("time_s", 1.0, None),
    ("time_ms", 1e-3, None),
    (Input::Angle.key(), 1.0, Some(Input::Angle)),
    (Input::Angle.shown_in().1, DEGREE, Some(Input::Angle)),
    (Input::Turn.key(), 1.0, Some(Input::Turn)),
    (Input::Turn.shown_in().1, DEGREE, Some(Input::Turn)),
    (Input::Slide.key(), 1.0, Some(Input::Slide)),
    (Input::Slide.shown_in().1, 1e-3, Some(Input::Slide)),
];
/// One degree (rad).
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Mapped {
    /// Parses `EXPR=NAME`, as an argument gives it; `what` names the text in messages.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if there is no `=`, or if EXPR or NAME is empty.
    pub fn parse(text: &str, what: &str) -> Result<Self> {
        let place = Place { file: what.into(), text: text.into(), span: 0..text.len() };
        let parts = text.rsplit_once('=').map(|(left, right)| (left.trim(), right.trim()));
        match parts {
            Some((left, right)) if !left.is_empty() && !right.is_empty() => {
                let start = text.len() - text.trim_start().len();
                Ok(Mapped { name: right.into(), text: left.into(), place, start })
            }
            _ => Err(Error::new(ErrorKind::Input, sentences::A_MAPPING_IS_AN_ARITHMETIC)
                .at(place)
                .help(sentences::WRITE_IT_SUCH_AS_PHI3_PI)),
        }
    }

    /// Maps a column that already has the name of a channel to this channel.
    #[must_use]
    pub fn same(name: &str, text: &str) -> Self {
        let place = Place { file: "the header".into(), text: text.into(), span: 0..text.len() };
        Mapped { name: name.into(), text: text.into(), place, start: 0 }
    }

    /// The factor to SI and the kind of input of a name in [`INSTANTS`]; `None` for any other name. A time has no kind
    /// of input.
    #[must_use]
    pub fn instant(&self) -> Option<(f64, Option<Input>)> {
        INSTANTS.iter().find(|(name, ..)| *name == self.name).map(|&(_, factor, input)| (factor, input))
    }

    /// An error in the arithmetic expression.
    pub fn refused(&self, fault: &FormulaFault) -> Error {
        let span = self.start + fault.at.start..self.start + fault.at.end;
        let place = Place { span, ..self.place.clone() };
        Error::new(ErrorKind::Input, fault.message.clone()).at(place).help(fault.help.clone())
    }

    /// An error about the channel that this entry names.
    pub fn wrong(&self, message: &str, help: &str) -> Error {
        Error::new(ErrorKind::Input, message).at(self.place.clone()).help(help)
    }
}

impl Mapping {
    /// Reads a mapping file.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] if the file cannot be read.
    /// [`ErrorKind::Input`] for a mistake in the file. The error states the position of the mistake.
    pub fn load(path: &Path) -> Result<Self> {
        let text = files::read_text(path).map_err(|error| {
            Error::new(ErrorKind::Io, sentences::the_mapping_cannot_be_read(&path.display(), &error))
                .help(sentences::GIVE_A_MAPPING_FILE_OR_ONE_COLUMN)
        })?;
        let source = Source::new(path, &text);
        let tree = source.tree()?;
        read(&mut TomlTable::root(&source, &tree)).map_err(|error| source.located(tree.get_ref(), error))
    }

    /// Adds the content of the mapping `other` to this mapping.
    pub fn extend(&mut self, other: Mapping) {
        self.at.extend(other.at);
        self.channels.extend(other.channels);
        self.allowed.extend(other.allowed);
    }

    /// Adds one line to the mapping.
    pub fn push(&mut self, mapped: Mapped) {
        match mapped.instant() {
            Some(_) => self.at.push(mapped),
            None => self.channels.push(mapped),
        }
    }

    /// Whether the mapping is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.at.is_empty() && self.channels.is_empty() && self.allowed.is_empty()
    }

    /// The text of a mapping file with the same content as this mapping.
    #[must_use]
    pub fn text(&self) -> String {
        let mut document = toml_edit::DocumentMut::new();
        let mut section = |name: &str, lines: &[Mapped]| {
            let mut table = toml_edit::Table::new();
            for line in lines {
                table.insert(&line.name, toml_edit::value(line.text.as_str()));
            }
            if !table.is_empty() {
                document.insert(name, toml_edit::Item::Table(table));
            }
        };
        section("at", &self.at);
        section("channels", &self.channels);
        let mut tolerances = toml_edit::Table::new();
        for Allowed { of, size } in &self.allowed {
            let (kind, number) = size.parts();
            let entry = tolerances.entry(of.as_deref().unwrap_or(ALL)).or_insert_with(|| {
                toml_edit::Item::Value(toml_edit::Value::InlineTable(toml_edit::InlineTable::new()))
            });
            if let Some(table) = entry.as_inline_table_mut() {
                table.insert(SIZES[kind].0, number.into());
            }
        }
        if !tolerances.is_empty() {
            document.insert("tolerance", toml_edit::Item::Table(tolerances));
        }
        document.to_string()
    }
}

/// Word for all channels in the tolerances of a mapping file.
const ALL: &str = "all";

fn read(root: &mut TomlTable) -> Result<Mapping> {
    let (at, channels) = (root.optional_table("at")?, root.optional_table("channels")?);
    let tolerances = root.optional_table("tolerance")?;
    root.finish()?;
    let mut mapping = Mapping::default();
    if let Some(mut at) = at {
        for name in at.keys() {
            let mapped = line(&mut at, &name)?;
            if mapped.instant().is_none() {
                let help = suggestion(&name, INSTANTS.map(|(name, ..)| name), "`");
                return at.refuse(&name, sentences::rows_do_not_hold_at(&name), help);
            }
            mapping.at.push(mapped);
        }
        at.finish()?;
    }
    if let Some(mut channels) = channels {
        for name in channels.keys() {
            mapping.channels.push(line(&mut channels, &name)?);
        }
        channels.finish()?;
    }
    if let Some(mut tolerances) = tolerances {
        for mut entry in tolerances.all_tables()? {
            let name = entry.name().to_string();
            let of = (name != ALL).then_some(name);
            for (key, size) in SIZES {
                let Some(number) = entry.optional_number(key)? else { continue };
                if number < 0.0 {
                    return entry.refuse(key, format!("found {number}"), sentences::A_DIFFERENCE_THAT_IS_ALLOWED);
                }
                mapping.allowed.push(Allowed { of: of.clone(), size: size(number) });
            }
            entry.finish()?;
        }
        tolerances.finish()?;
    }
    Ok(mapping)
}

fn line(table: &mut TomlTable, name: &str) -> Result<Mapped> {
    let text = table.string(name)?;
    let whole = FormulaFault { message: String::new(), at: 0..text.len(), help: String::new() };
    let place = table.fault_in(name, &whole).place().cloned();
    let place = place.unwrap_or_else(|| Place { file: table.source().path.into(), text: "".into(), span: 0..0 });
    Ok(Mapped { name: name.into(), text, start: place.span.start, place })
}
