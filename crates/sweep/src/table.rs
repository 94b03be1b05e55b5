//! The table of cases as Parquet: a row for each case.
//!
//! Columns, in this order:
//! - `case`, the index from 0;
//! - the varied numbers, named by their keys;
//! - the figures, absent in a refused case and if a figure does not exist;
//! - `state`: `solved` or `refused`;
//! - `reason` of a refusal;
//! - `proof`, if the sweep has proofs: the verdict of a proven case, or the message of the error that ended the proof.
//!
//! The metadata of the joined table contain the plan (`linkproof.sweep`), and the units of the varied numbers and
//! figures (`linkproof.units`, JSON).

use std::fs::File;
use std::io::{BufWriter, Read, Write};
use std::path::Path;
use std::sync::Arc;

use bytes::Bytes;
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as PhysicalType, ZstdLevel};
use parquet::column::writer::ColumnCloseResult;
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{WriterProperties, WriterPropertiesPtr};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type, TypePtr};

use crate::design::DesignKind;
use crate::plan::SweepPlan;

/// Rows of the table, column by column.
#[derive(Clone, Debug, PartialEq)]
pub struct RowGroup {
    /// Values of the varied numbers, by axis.
    pub values: Vec<Vec<f64>>,
    /// Values of the figures: one list for each figure, with one value for each case. NaN if the figure does not exist
    /// in that case.
    pub figures: Vec<Vec<f64>>,
    /// Why a case was refused; `None` for a solved case.
    pub reasons: Vec<Option<String>>,
    /// Verdict of the proof of each case, if the case is proven. The list is empty if the sweep proves no case.
    pub verdicts: Vec<Option<String>>,
}

/// Number of appended bytes after which the program waits until the storage device has stored the joined table. The
/// wait after the last part is then short.
const SYNCED: u64 = 2 << 20;
/// Capacity of the buffer of a table that is written (bytes). The pages of most columns are smaller.
const BUFFERED: usize = 1 << 18;

/// State of a solved case.
pub const SOLVED: &str = "solved";
/// State of a case that could not be solved.
pub const REFUSED: &str = "refused";

fn schema(plan: &SweepPlan) -> Result<TypePtr, ParquetError> {
    let field = |name: &str, physical: PhysicalType, repetition: Repetition, logical: Option<LogicalType>| {
        Type::primitive_type_builder(name, physical)
            .with_repetition(repetition)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    };
    let text = |name: &str, repetition| field(name, PhysicalType::BYTE_ARRAY, repetition, Some(LogicalType::String));
    let mut fields = vec![field("case", PhysicalType::INT64, Repetition::REQUIRED, None)?];
    for axis in plan.design.axes() {
        fields.push(field(&axis.key, PhysicalType::DOUBLE, Repetition::REQUIRED, None)?);
    }
    for figure in &plan.figures {
        fields.push(field(&figure.text, PhysicalType::DOUBLE, Repetition::OPTIONAL, None)?);
    }
    fields.push(text("state", Repetition::REQUIRED)?);
    fields.push(text("reason", Repetition::OPTIONAL)?);
    if plan.prove_every.is_some() {
        fields.push(text("proof", Repetition::OPTIONAL)?);
    }
    Type::group_type_builder("cases").with_fields(fields).build().map(Arc::new)
}

/// The metadata of the joined table: the plan and the units.
fn metadata(plan: &SweepPlan) -> Vec<KeyValue> {
    let units = serde_json::Value::Object(plan.columns().map(|(name, unit)| (name.into(), unit.into())).collect());
    let entry = |key: &str, value: String| KeyValue::new(key.to_string(), value);
    vec![entry("linkproof.sweep", plan.stored()), entry("linkproof.units", units.to_string())]
}

fn properties(plan: &SweepPlan, metadata: Option<Vec<KeyValue>>) -> WriterPropertiesPtr {
    // Nearly all values of figures are different, so a dictionary or a compression would only cost time.
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("linkproof {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(metadata)
        .set_dictionary_enabled(false)
        .set_column_encoding("case".into(), Encoding::DELTA_BINARY_PACKED)
        .set_column_compression("reason".into(), Compression::ZSTD(ZstdLevel::default()));
    for text in ["state", "reason", "proof"] {
        properties = properties.set_column_dictionary_enabled(text.into(), true);
    }
    if plan.design.kind() == DesignKind::Grid {
        for axis in plan.design.axes() {
            let column = ColumnPath::new(vec![axis.key.clone()]);
            properties = properties.set_column_dictionary_enabled(column, true);
        }
    }
    Arc::new(properties.build())
}

/// Writes one column of a row group. `present` marks the rows of an optional column that have a value.
pub(crate) fn column<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    values: &[T::T],
    present: Option<&[i16]>,
) -> Result<(), ParquetError> {
    let mut writer = group.next_column()?.ok_or_else(|| ParquetError::General("too few columns".into()))?;
    writer.typed::<T>().write_batch(values, present, None)?;
    writer.close()
}

fn numbers(group: &mut SerializedRowGroupWriter<'_, impl Write + Send>, values: &[f64]) -> Result<(), ParquetError> {
    let present: Vec<i16> = values.iter().map(|value| i16::from(!value.is_nan())).collect();
    let values: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
    column::<DoubleType, _>(group, &values, Some(&present))
}

fn texts<'r>(
    group: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    texts: impl Iterator<Item = Option<&'r str>>,
) -> Result<(), ParquetError> {
    let (mut values, mut present) = (Vec::new(), Vec::new());
    for text in texts {
        present.push(i16::from(text.is_some()));
        values.extend(text.map(ByteArray::from));
    }
    column::<ByteArrayType, _>(group, &values, Some(&present))
}

/// Writes the rows of one part as a table of one row group. `first` is the index of the first case.
pub(crate) fn write(plan: &SweepPlan, first: u64, rows: &RowGroup, mut to: &File) -> Result<(), ParquetError> {
    // The bytes are written to the file at once. Parquet would flush the file after every column.
    let mut writer = SerializedFileWriter::new(Vec::new(), schema(plan)?, properties(plan, None))?;
    let mut group = writer.next_row_group()?;
    let cases: Vec<i64> = (first..).take(rows.reasons.len()).map(|case| case as i64).collect();
    column::<Int64Type, _>(&mut group, &cases, None)?;
    for values in &rows.values {
        column::<DoubleType, _>(&mut group, values, None)?;
    }
    for values in &rows.figures {
        numbers(&mut group, values)?;
    }
    let [solved, refused] = [SOLVED, REFUSED].map(ByteArray::from);
    let state = |reason: &Option<String>| if reason.is_none() { &solved } else { &refused };
    let states: Vec<ByteArray> = rows.reasons.iter().map(|reason| state(reason).clone()).collect();
    column::<ByteArrayType, _>(&mut group, &states, None)?;
    texts(&mut group, rows.reasons.iter().map(Option::as_deref))?;
    if plan.prove_every.is_some() {
        texts(&mut group, rows.verdicts.iter().map(Option::as_deref))?;
    }
    group.close()?;
    Ok(to.write_all(&writer.into_inner()?)?)
}

/// The joined table while the tables of the parts are appended to it.
pub(crate) struct JoinedTable<'f> {
    file: &'f File,
    writer: SerializedFileWriter<BufWriter<&'f File>>,
    /// Roughly the number of bytes that the storage device may not have stored yet.
    unsynced: u64,
}

impl<'f> JoinedTable<'f> {
    pub(crate) fn new(plan: &SweepPlan, file: &'f File) -> Result<JoinedTable<'f>, ParquetError> {
        let to = BufWriter::with_capacity(BUFFERED, file);
        let writer = SerializedFileWriter::new(to, schema(plan)?, properties(plan, Some(metadata(plan))))?;
        Ok(JoinedTable { file, writer, unsynced: 0 })
    }

    /// Appends the table of a part without decoding it.
    pub(crate) fn append(&mut self, part: &Path) -> Result<(), ParquetError> {
        let named = |error: &dyn std::fmt::Display| ParquetError::General(format!("{}: {error}", part.display()));
        // The part is read at once. Parquet would read each of its columns with several calls of the system.
        let mut bytes = Vec::new();
        File::open(part).and_then(|mut file| file.read_to_end(&mut bytes)).map_err(|error| named(&error))?;
        let bytes = Bytes::from(bytes);
        let reader = SerializedFileReader::new(bytes.clone()).map_err(|error| named(&error))?;
        for group in reader.metadata().row_groups() {
            let mut out = self.writer.next_row_group()?;
            for metadata in group.columns() {
                let close = ColumnCloseResult {
                    bytes_written: metadata.compressed_size() as u64,
                    rows_written: group.num_rows() as u64,
                    metadata: metadata.clone(),
                    bloom_filter: None,
                    column_index: None,
                    offset_index: None,
                };
                self.unsynced += close.bytes_written;
                out.append_column(&bytes, close)?;
            }
            out.close()?;
        }
        if self.unsynced > SYNCED {
            self.file.sync_data()?;
            self.unsynced = 0;
        }
        Ok(())
    }

    pub(crate) fn close(self) -> Result<(), ParquetError> {
        Ok(self.writer.into_inner()?.flush()?)
    }
}
