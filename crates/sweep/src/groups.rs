//! Reads a table of cases one row group at a time, so that memory does not grow with the table.

use std::fs::File;
use std::path::{Path, PathBuf};

use linkage::error::Result;
use linkage::quiet::guarded;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};

use crate::plan::SweepPlan;
use crate::sentences;
use crate::store::broken;
use crate::table::RowGroup;

/// Reads the row groups of the table of a sweep, in the order of the table.
pub struct SweepGroups {
    reader: SerializedFileReader<File>,
    path: PathBuf,
    axes: usize,
    figures: usize,
    is_proven: bool,
    next: usize,
}

/// Calls `read`. A panic becomes an error, because the reader of Parquet may panic on a broken table.
fn sound<T>(table: &Path, read: impl FnOnce() -> std::result::Result<T, ParquetError>) -> Result<T> {
    match guarded(read) {
        Ok(read) => read.map_err(|error| broken(table, &error)),
        Err(_) => Err(broken(table, &sentences::ITS_PARTS_CONTRADICT_EACH_OTHER)),
    }
}

impl SweepGroups {
    /// Opens the table of a sweep.
    ///
    /// # Errors
    /// [`linkage::error::ErrorKind::Io`] if it cannot be read.
    pub fn of(plan: &SweepPlan, table: &Path) -> Result<SweepGroups> {
        Ok(SweepGroups {
            reader: sound(table, || SerializedFileReader::new(File::open(table)?))?,
            path: table.into(),
            axes: plan.design.axes().len(),
            figures: plan.figures.len(),
            is_proven: plan.prove_every.is_some(),
            next: 0,
        })
    }
}

impl Iterator for SweepGroups {
    type Item = Result<RowGroup>;

    fn next(&mut self) -> Option<Result<RowGroup>> {
        let index = self.next;
        self.next += 1;
        if index >= self.reader.num_row_groups() {
            return None;
        }
        Some(sound(&self.path, || group(&self.reader, index, self.axes, self.figures, self.is_proven)))
    }
}

/// Reads a row group.
fn group(
    reader: &SerializedFileReader<File>,
    index: usize,
    axes: usize,
    figures: usize,
    is_proven: bool,
) -> std::result::Result<RowGroup, ParquetError> {
    let group = reader.get_row_group(index)?;
    let rows = group.metadata().num_rows() as usize;
    let numbers = |at: usize| -> std::result::Result<Vec<f64>, ParquetError> {
        let ColumnReader::DoubleColumnReader(reader) = group.get_column_reader(at)? else {
            return Err(contradiction());
        };
        column::<DoubleType, f64>(reader, rows, |own| own, || f64::NAN)
    };
    let texts = |at: usize| -> std::result::Result<Vec<Option<String>>, ParquetError> {
        let ColumnReader::ByteArrayColumnReader(reader) = group.get_column_reader(at)? else {
            return Err(contradiction());
        };
        let text = |own: ByteArray| String::from_utf8_lossy(own.data()).into_owned();
        column::<ByteArrayType, Option<String>>(reader, rows, |own| Some(text(own)), || None)
    };
    let (first, last) = (1 + axes, 1 + axes + figures);
    Ok(RowGroup {
        values: (1..first).map(numbers).collect::<std::result::Result<_, _>>()?,
        figures: (first..last).map(numbers).collect::<std::result::Result<_, _>>()?,
        // The column `last`, the state of the case, is not read, because the reason determines the state.
        reasons: texts(last + 1)?,
        verdicts: if is_proven { texts(last + 2)? } else { Vec::new() },
    })
}

/// The error if a table does not match the plan of the sweep.
fn contradiction() -> ParquetError {
    ParquetError::General(sentences::ITS_PARTS_CONTRADICT_EACH_OTHER.into())
}

/// The values of a column. A row without a value gets the value of `none`.
fn column<T: DataType, V>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
    value: impl Fn(T::T) -> V,
    none: impl Fn() -> V,
) -> std::result::Result<Vec<V>, ParquetError> {
    let (mut values, mut present) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    let mut read = 0;
    while read < rows {
        let (records, ..) = reader.read_records(rows - read, Some(&mut present), None, &mut values)?;
        if records == 0 {
            return Err(contradiction());
        }
        read += records;
    }
    if values.len() == rows {
        return Ok(values.into_iter().map(value).collect());
    }
    let mut values = values.into_iter();
    let found = present.iter().map(|present| if *present == 1 { values.next() } else { None });
    let found: Vec<V> = found.map(|own| own.map_or_else(&none, &value)).collect();
    if found.len() == rows { Ok(found) } else { Err(contradiction()) }
}
