//! Parquet files, as pandas and polars write them.

use std::fmt::Display;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use parquet::basic::Compression;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::source::May;
use columns::{MISSING, Table, Twice, UNDEFINED};
use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};

/// What a Parquet file begins with.
pub(super) const MAGIC: &[u8; 4] = b"PAR1";
/// Largest number of values that is read.
const MOST: i64 = 1 << 26;

pub(super) fn read(path: &Path, size: u64, may: May) -> Result<Table> {
    let damaged = |error: &dyn Display| {
        Error::new(ErrorKind::Io, format!("the table {} is cut off or damaged: {error}", path.display()))
            .help("write it again, as Parquet or as CSV")
    };
    // The reader is given whatever a file claims to be.
    match catch_unwind(AssertUnwindSafe(|| of_file(path, size, may))) {
        Ok(Ok(read)) => read,
        Ok(Err(error)) => Err(damaged(&error)),
        Err(_) => Err(damaged(&"its parts contradict each other")),
    }
}

/// The columns that hold numbers; others, such as names, are passed over.
fn of_file(path: &Path, size: u64, may: May) -> std::result::Result<Result<Table>, ParquetError> {
    let reader = SerializedFileReader::new(File::open(path)?)?;
    let described = reader.metadata().file_metadata();
    let names: Vec<String> = described.schema().get_fields().iter().map(|field| field.name().to_string()).collect();
    let refused = |message: String, help: &str| {
        let message = format!("the table {}: {message}", path.display());
        Ok(Err(Error::new(ErrorKind::Input, message).help(help.to_string())))
    };
    if let Some(twice) = Twice::of(&names) {
        return refused(twice.to_string(), Twice::HELP);
    }
    let mut parts = reader.metadata().row_groups().iter().flat_map(|group| group.columns());
    if let Some(name) = parts.find_map(|part| unread(part.compression())) {
        let help = "write it uncompressed or with Snappy, Zstandard or gzip, or as CSV: \
                    df.to_parquet(FILE, compression=\"zstd\")";
        return refused(format!("its columns are compressed with {name}, which is not read here"), help);
    }
    let values = described.num_rows().saturating_mul(names.len() as i64);
    if !(0..=MOST).contains(&values) {
        return refused(format!("it has {values} values, more than {MOST}"), "give fewer rows, or fewer columns");
    }
    // What is compressed is unpacked part by part.
    if let Err(error) = may(size as f64 + values as f64 * size_of::<Rounded>() as f64, described.num_rows() as usize) {
        return Ok(Err(error));
    }
    let mut columns: Vec<Vec<Rounded>> = vec![Vec::new(); names.len()];
    let mut are_numbers = vec![true; names.len()];
    for row in reader.get_row_iter(None)? {
        for (index, (_, field)) in row?.get_column_iter().enumerate() {
            let number = number(field);
            are_numbers[index] &= number.is_some();
            columns[index].push(number.unwrap_or(MISSING));
        }
    }
    let mut are_kept = are_numbers.iter();
    let (names, columns) = names.into_iter().zip(columns).filter(|_| are_kept.next() == Some(&true)).unzip();
    Ok(Ok(Table { names, columns, lines: Vec::new() }))
}

/// Name of a compression that is not read.
fn unread(compression: Compression) -> Option<&'static str> {
    match compression {
        Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::GZIP(_) | Compression::ZSTD(_) => None,
        Compression::BROTLI(_) => Some("Brotli"),
        Compression::LZ4 | Compression::LZ4_RAW => Some("LZ4"),
        Compression::LZO => Some("LZO"),
    }
}

#[expect(clippy::wildcard_enum_match_arm, reason = "an enum of the Parquet reader")]
fn number(field: &Field) -> Option<Rounded> {
    let exact = |value: f64| Some(Rounded::exact(value));
    let finite = |number: Rounded| Some(if number.value.is_finite() { number } else { UNDEFINED });
    match *field {
        Field::Null => Some(MISSING),
        Field::Byte(value) => exact(value.into()),
        Field::Short(value) => exact(value.into()),
        Field::Int(value) => exact(value.into()),
        Field::UByte(value) => exact(value.into()),
        Field::UShort(value) => exact(value.into()),
        Field::UInt(value) => exact(value.into()),
        Field::Long(value) => Some(Rounded::nearly(value as f64)),
        Field::ULong(value) => Some(Rounded::nearly(value as f64)),
        Field::Double(value) => finite(Rounded::nearly(value)),
        Field::Float(value) => {
            finite(Rounded { value: value.into(), error: f64::from(f32::EPSILON) * f64::from(value.abs()) })
        }
        _ => None,
    }
}
