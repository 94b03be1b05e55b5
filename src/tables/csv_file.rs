//! Text with separated columns.

use std::path::Path;

use columns::{Fault, Table};

use crate::files;
use linkage::error::{Error, ErrorKind, Place, Result};

pub(super) fn read(path: &Path, may_take: &dyn Fn(f64) -> Result<()>) -> Result<Table> {
    let text = files::read_text(path).map_err(|error| {
        Error::new(ErrorKind::Io, format!("the table {} cannot be read: {error}", path.display()))
            .help("give a scenario (.toml), a recording (.mcap), a table of text (.csv) or a Parquet file")
    })?;
    may_take(columns::bytes(&text))?;
    columns::read(&text).map_err(|Fault { at, message, help }| {
        let place = Place { file: path.into(), text: text.as_str().into(), span: at };
        Error::new(ErrorKind::Input, message).at(place).help(help)
    })
}
