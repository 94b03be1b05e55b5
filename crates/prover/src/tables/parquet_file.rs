//! Parquet files, as pandas and polars write them.

mod announced;
mod thrift;

use crate::sentences;
use std::fmt::Display;
use std::fs::File;
use std::path::Path;

use parquet::basic::{Compression, ConvertedType, Type};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::schema::types::ColumnDescriptor;

use super::source::May;
use columns::{MISSING, TextTable, Twice, UNDEFINED};
use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};
use linkage::quiet::guarded;

/// Limit of the number of values read.
const MOST: u64 = 1 << 26;
/// Number of values that are read at a time.
const BATCH: usize = 1 << 12;

pub(super) fn read(path: &Path, size: u64, may: May) -> Result<TextTable> {
    let damaged = |error: &dyn Display| {
        Error::new(ErrorKind::Io, sentences::the_table_is_cut_off_or_damaged(&path.display(), &error))
            .help(sentences::WRITE_IT_AGAIN_AS_PARQUET)
    };
    // A damaged file can make the reader panic. The panic is caught and becomes an error.
    match guarded(|| of_file(path, size, may)) {
        Ok(Ok(read)) => read,
        Ok(Err(error)) => Err(damaged(&error)),
        Err(_) => Err(damaged(&sentences::ITS_PARTS_CONTRADICT_EACH_OTHER)),
    }
}

/// Reads the columns of numbers. Columns without numbers, such as names, are skipped.
fn of_file(path: &Path, size: u64, may: May) -> std::result::Result<Result<TextTable>, ParquetError> {
    let file = File::open(path)?;
    // The usual conversion would begin the message of a file-system error with "External".
    let wrong = |error: std::io::Error| ParquetError::General(error.to_string());
    announced::check_description(&file).map_err(wrong)?;
    let reader = SerializedFileReader::new(file.try_clone()?)?;
    let described = reader.metadata().file_metadata();
    let names: Vec<String> = described.schema().get_fields().iter().map(|field| field.name().to_string()).collect();
    let refused = |message: String, help: &str| {
        Ok(Err(Error::new(ErrorKind::Input, sentences::the_table(&path.display(), &message)).help(help.to_string())))
    };
    if let Some(twice) = Twice::of(&names) {
        return refused(twice.to_string(), Twice::HELP);
    }
    let groups = reader.metadata().row_groups();
    if let Some(name) = groups.iter().flat_map(|group| group.columns()).find_map(|part| unread(part.compression())) {
        let help = "write it uncompressed or with Snappy, Zstandard or gzip, or as CSV: \
                    df.to_parquet(FILE, compression=\"zstd\")";
        return refused(sentences::its_columns_are_compressed_with_which_is_not_read(&name), help);
    }
    let wanted = described.schema_descr().columns().iter().enumerate().filter(|(_, column)| is_number(column));
    let wanted: Vec<(usize, String)> = wanted.map(|(index, column)| (index, column.name().to_string())).collect();
    // Each group states its number of rows. The sum of these numbers must equal the total that the file states.
    let rows = groups.iter().try_fold(0_u64, |sum, group| sum.checked_add(u64::try_from(group.num_rows()).ok()?));
    let Some(rows) = rows.filter(|&rows| i64::try_from(rows) == Ok(described.num_rows())) else {
        return Err(ParquetError::General(sentences::ITS_GROUPS_HAVE_OTHER_ROWS.into()));
    };
    let values = rows.saturating_mul(wanted.len() as u64);
    if values > MOST {
        return refused(sentences::it_has_values_more_than(&values, &MOST), sentences::GIVE_FEWER_ROWS_OR_FEWER);
    }
    // The estimate of the memory leaves out the unpacked data, because compressed data is unpacked part by part.
    if let Err(error) = may(size as f64 + values as f64 * size_of::<Rounded>() as f64, rows as usize) {
        return Ok(Err(error));
    }
    let (mut names, mut columns) = (Vec::new(), Vec::new());
    for (index, name) in wanted {
        let mut column = Vec::with_capacity(rows as usize);
        for (number, group) in groups.iter().enumerate() {
            announced::check_pages(&file, group.num_rows() as u64, group.column(index)).map_err(wrong)?;
            let part = reader.get_row_group(number)?.get_column_reader(index)?;
            values_of(part, group.column(index).column_descr(), group.num_rows() as usize, &mut column)?;
        }
        names.push(name);
        columns.push(column);
    }
    Ok(Ok(TextTable { names, columns, lines: Vec::new() }))
}

/// Name of a compression that this reader does not support.
fn unread(compression: Compression) -> Option<&'static str> {
    match compression {
        Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::GZIP(_) | Compression::ZSTD(_) => None,
        Compression::BROTLI(_) => Some("Brotli"),
        Compression::LZ4 | Compression::LZ4_RAW => Some("LZ4"),
        Compression::LZO => Some("LZO"),
    }
}

/// Whether a column contains one number in each row. Floating-point numbers count, and integers that do not stand for
/// dates, times or decimals.
fn is_number(column: &ColumnDescriptor) -> bool {
    use ConvertedType as Kind;
    let is_plain = column.path().parts().len() == 1 && column.max_rep_level() == 0;
    let kind = column.converted_type();
    is_plain
        && match column.physical_type() {
            Type::FLOAT | Type::DOUBLE => true,
            Type::INT32 => matches!(
                kind,
                Kind::NONE | Kind::INT_8 | Kind::INT_16 | Kind::INT_32 | Kind::UINT_8 | Kind::UINT_16 | Kind::UINT_32
            ),
            Type::INT64 => matches!(kind, Kind::NONE | Kind::INT_64 | Kind::UINT_64),
            Type::BOOLEAN | Type::INT96 | Type::BYTE_ARRAY | Type::FIXED_LEN_BYTE_ARRAY => false,
        }
}

/// Appends the values of a part of a column, one value for each row.
fn values_of(
    part: ColumnReader,
    of: &ColumnDescriptor,
    rows: usize,
    to: &mut Vec<Rounded>,
) -> std::result::Result<(), ParquetError> {
    let finite = |number: Rounded| if number.value.is_finite() { number } else { UNDEFINED };
    let is_unsigned = [ConvertedType::UINT_8, ConvertedType::UINT_16, ConvertedType::UINT_32, ConvertedType::UINT_64]
        .contains(&of.converted_type());
    let full = of.max_def_level();
    match part {
        ColumnReader::Int32ColumnReader(part) => taken(part, full, rows, to, |value: i32| {
            Rounded::exact(if is_unsigned { value.cast_unsigned().into() } else { value.into() })
        }),
        ColumnReader::Int64ColumnReader(part) => taken(part, full, rows, to, |value: i64| {
            Rounded::nearly(if is_unsigned { value.cast_unsigned() as f64 } else { value as f64 })
        }),
        ColumnReader::FloatColumnReader(part) => taken(part, full, rows, to, |value: f32| {
            finite(Rounded { value: value.into(), error: f64::from(f32::EPSILON) * f64::from(value.abs()) })
        }),
        ColumnReader::DoubleColumnReader(part) => {
            taken(part, full, rows, to, |value: f64| finite(Rounded::nearly(value)))
        }
        ColumnReader::BoolColumnReader(_)
        | ColumnReader::Int96ColumnReader(_)
        | ColumnReader::ByteArrayColumnReader(_)
        | ColumnReader::FixedLenByteArrayColumnReader(_) => unreachable!("these are no numbers"),
    }
}

/// Like [`values_of`], but for a part whose values have the type `T`. `full` is the definition level of a row with a
/// value. A row with another level has no value.
fn taken<T: DataType>(
    mut part: ColumnReaderImpl<T>,
    full: i16,
    rows: usize,
    to: &mut Vec<Rounded>,
    number: impl Fn(T::T) -> Rounded,
) -> std::result::Result<(), ParquetError>
where
    T::T: Copy,
{
    let (mut values, mut levels) = (Vec::with_capacity(BATCH), Vec::with_capacity(BATCH));
    let end = to.len() + rows;
    while to.len() < end {
        values.clear();
        levels.clear();
        let (read, _, _) = part.read_records(BATCH.min(end - to.len()), Some(&mut levels), None, &mut values)?;
        if read == 0 {
            return Err(ParquetError::General(sentences::A_COLUMN_HAS_FEWER_VALUES_THAN_THERE.into()));
        }
        let mut values = values.iter().map(|&value| number(value));
        let mut next =
            || values.next().ok_or_else(|| ParquetError::General(sentences::A_COLUMN_HAS_FEWER_VALUES.into()));
        // If the file stores no levels for a column, every row of the column has a value.
        for level in levels.iter().copied().chain(std::iter::repeat(full)).take(read) {
            to.push(if level == full { next()? } else { MISSING });
        }
    }
    Ok(())
}
