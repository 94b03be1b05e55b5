//! Tables of other Python packages: data frames, Arrow tables, mappings of columns.

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{
    ArrowPrimitiveType, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrayRef, Float64Array};
use arrow_schema::DataType;
use columns::{MISSING, TextTable, Twice, UNDEFINED};
use formula::Rounded;
use linkproof::parts::Error;
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3_arrow::{PyArray, PyTable};

use crate::errors::{OrRaised, argument};
use crate::sentences;

/// Name of the argument in messages.
const OTHER: &str = "other";

/// Columns by name, each consisting of one or several arrays.
type Parts = Vec<(String, Vec<ArrayRef>)>;

/// The numbers of a table. Columns without numbers are skipped.
/// A null is a missing value. A NaN is a value that a program could not compute.
pub(crate) fn taken_over(table: &Bound<'_, PyAny>) -> PyResult<TextTable> {
    let py = table.py();
    let columns = match streamed(table)? {
        Some(columns) => columns,
        None => mapped(table)?,
    };
    made(columns).or_raised(py)
}

/// The columns of an object with an Arrow stream. `None` if the object has no stream, or if the stream needs a package
/// that is not installed. For example, pandas needs pyarrow.
fn streamed(table: &Bound<'_, PyAny>) -> PyResult<Option<Parts>> {
    if !table.hasattr("__arrow_c_stream__")? {
        return Ok(None);
    }
    let whole = match table.extract::<PyTable>() {
        Ok(whole) => whole,
        Err(error) if error.is_instance_of::<PyImportError>(table.py()) => return Ok(None),
        Err(error) => return Err(error),
    };
    let (batches, schema) = whole.into_inner();
    let column = |(index, field): (usize, &std::sync::Arc<arrow_schema::Field>)| {
        (field.name().clone(), batches.iter().map(|batch| batch.column(index).clone()).collect())
    };
    Ok(Some(schema.fields().iter().enumerate().map(column).collect()))
}

/// The columns of a mapping from names to sequences of numbers.
fn mapped(table: &Bound<'_, PyAny>) -> PyResult<Parts> {
    let py = table.py();
    if !table.hasattr("keys")? || !table.hasattr("__getitem__")? {
        let found = table.get_type().name()?.to_string();
        let error = argument(OTHER, sentences::this_is_no_table(&found), sentences::GIVE_A_TABLE);
        return Err(error).or_raised(py);
    }
    let numpy = py.import("numpy")?;
    let mut columns = Vec::new();
    for key in table.call_method0("keys")?.try_iter()? {
        let key = key?;
        // `asanyarray` keeps the mask of a masked array.
        let values = numpy.call_method1("asanyarray", (table.get_item(&key)?,))?;
        let kind = values.getattr("dtype")?;
        let (word, bytes): (String, usize) = (kind.getattr("kind")?.extract()?, kind.getattr("itemsize")?.extract()?);
        let is_listed = word == "O" || values.hasattr("mask")?;
        let array: ArrayRef = if is_listed {
            // A masked value, and `None`, is a missing value. Other objects count as numbers if Python converts them.
            match values.call_method0("tolist")?.extract::<Vec<Option<f64>>>() {
                Ok(numbers) => Arc::new(Float64Array::from(numbers)),
                Err(_) => continue,
            }
        } else if ["f", "i", "u"].contains(&word.as_str()) {
            // Arrow reads the byte order of this machine, and no half precision.
            let own = if word == "f" && bytes == 4 { "=f4" } else { "=f8" };
            let values = numpy.call_method1("ascontiguousarray", (values.call_method1("astype", (own,))?,))?;
            values.extract::<PyArray>()?.into_inner().0
        } else {
            continue;
        };
        columns.push((key.str()?.extract()?, vec![array]));
    }
    Ok(columns)
}

fn made(columns: Parts) -> Result<TextTable, Error> {
    if let Some(twice) = Twice::of(columns.iter().map(|(name, _)| name)) {
        return Err(argument(OTHER, twice.to_string(), Twice::HELP));
    }
    let mut table = TextTable::default();
    for (name, parts) in columns {
        let mut values = Vec::new();
        if parts.iter().all(|part| put(part, &mut values)) && !parts.is_empty() {
            table.names.push(name);
            table.columns.push(values);
        }
    }
    let rows = table.len();
    if let Some(index) = table.columns.iter().position(|column| column.len() != rows) {
        let message = sentences::the_columns_differ_in_length(&table.names[0], &table.names[index]);
        return Err(argument(OTHER, message, sentences::GIVE_ONE_ROW_PER_INSTANT));
    }
    if rows == 0 {
        return Err(argument(OTHER, sentences::THE_TABLE_HAS_NO_NUMBERS, sentences::GIVE_ONE_ROW_PER_INSTANT));
    }
    Ok(table)
}

/// Appends the numbers of an array; `false` if the array does not contain numbers.
#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of Arrow")]
fn put(array: &ArrayRef, to: &mut Vec<Rounded>) -> bool {
    match array.data_type() {
        DataType::Float64 => taken::<Float64Type>(array, to, Rounded::nearly),
        DataType::Float32 => taken::<Float32Type>(array, to, |value| Rounded {
            value: value.into(),
            error: f64::from(f32::EPSILON) * f64::from(value.abs()),
        }),
        DataType::Int8 => taken::<Int8Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::Int16 => taken::<Int16Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::Int32 => taken::<Int32Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::Int64 => taken::<Int64Type>(array, to, |value| Rounded::nearly(value as f64)),
        DataType::UInt8 => taken::<UInt8Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::UInt16 => taken::<UInt16Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::UInt32 => taken::<UInt32Type>(array, to, |value| Rounded::exact(value.into())),
        DataType::UInt64 => taken::<UInt64Type>(array, to, |value| Rounded::nearly(value as f64)),
        _ => return false,
    }
    true
}

fn taken<T: ArrowPrimitiveType>(array: &ArrayRef, to: &mut Vec<Rounded>, number: impl Fn(T::Native) -> Rounded) {
    let finite = |number: Rounded| if number.value.is_finite() { number } else { UNDEFINED };
    let values = array.as_primitive::<T>().iter();
    to.extend(values.map(|value| value.map_or(MISSING, |value| finite(number(value)))));
}
