//! Columns of numbers as Parquet.

use std::sync::Arc;

use parquet::basic::{Repetition, Type as PhysicalType};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;

use crate::table::column;

/// A table of columns with their names and units, as the bytes of a Parquet file with one row group.
/// The metadata `linkproof.units` contain the units, as JSON.
///
/// # Errors
/// The errors of the writer, such as columns of different lengths.
pub fn column_table(columns: &[(String, String, &[f64])]) -> Result<Vec<u8>, ParquetError> {
    let field = |(name, ..): &(String, String, &[f64])| {
        let column = Type::primitive_type_builder(name, PhysicalType::DOUBLE);
        column.with_repetition(Repetition::REQUIRED).build().map(Arc::new)
    };
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("instants").with_fields(fields).build().map(Arc::new)?;
    let units: serde_json::Map<_, _> =
        columns.iter().map(|(name, unit, _)| (name.clone(), unit.as_str().into())).collect();
    let units = KeyValue::new("linkproof.units".into(), serde_json::Value::Object(units).to_string());
    let properties = WriterProperties::builder()
        .set_created_by(format!("linkproof {}", env!("CARGO_PKG_VERSION")))
        .set_key_value_metadata(Some(vec![units]))
        .set_dictionary_enabled(false)
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for (.., values) in columns {
        column::<DoubleType, _>(&mut group, values, None)?;
    }
    group.close()?;
    writer.into_inner()
}
