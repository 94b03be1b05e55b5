//! Checks the sizes that a Parquet file states, before the file's reader allocates memory for them.
//! The reader allocates as much as the file states.

use crate::sentences;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

use flate2::bufread::MultiGzDecoder;
use parquet::basic::Compression;
use parquet::file::metadata::ColumnChunkMetaData;

use super::thrift::{Found, Walk, wrong};
use crate::tables::source::MAGIC;

/// Bytes after the description of a file: the length of the description, and the signature of the format.
const TAIL: u64 = 8;
/// Limit of the nesting depth of columns and groups of columns, because the reader is recursive.
const DEEPEST: usize = 32;
/// Largest number of bytes per value in a page. Eight bytes are for the value. Eight more are for its definition and
/// repetition levels and for the overhead of delta encoding.
const WIDEST: u64 = 16;
/// Bytes allowed for a page in addition to its values: delta encoding always fills its last block completely.
const BESIDE: u64 = 1 << 12;
/// Limit of a dictionary's size (bytes). Programs that write Parquet stop using a dictionary at 1 MiB.
const DICTIONARY: u64 = 1 << 26;

/// Field numbers in the description of a file, of a column in it, and in the header of a page.
const SCHEMA: i64 = 2;
const CHILDREN: i64 = 5;
const HELD: i64 = 2;
const STORED: i64 = 3;
const OF_DATA: [i64; 2] = [5, 8];
const OF_DICTIONARY: i64 = 7;
const VALUES: i64 = 1;

/// Checks the description of a file.
/// No group may state more columns than the description has bytes. Columns must not be nested too deeply.
pub(super) fn check_description(file: &File) -> io::Result<()> {
    let whole = file.metadata()?.len();
    let mut tail = [0; TAIL as usize];
    let mut from = file;
    from.seek(SeekFrom::Start(whole.saturating_sub(TAIL)))?;
    from.read_exact(&mut tail)?;
    let [length, magic] = [&tail[..4], &tail[4..]].map(|part| <[u8; 4]>::try_from(part).expect("four bytes"));
    let length = u64::from(u32::from_le_bytes(length));
    if magic != MAGIC || length + TAIL > whole {
        return Err(wrong(sentences::ITS_END_IS_NOT_THAT_OF_A_PARQUET));
    }
    from.seek(SeekFrom::Start(whole - TAIL - length))?;
    let (mut own, mut open, mut columns) = (0, Vec::<i64>::new(), 0_u64);
    let mut tell = |depth: usize, [outer, field]: [i64; 2], found: Found| {
        if (depth, outer) != (1, SCHEMA) {
            return Ok(());
        }
        match (field, found) {
            // A stated number of columns is rejected if it exceeds the bytes of the description.
            (CHILDREN, Found::Number(count)) if (0..=length.cast_signed()).contains(&count) => own = count,
            (CHILDREN, Found::Number(_) | Found::Other) => {
                return Err(wrong(sentences::IT_ANNOUNCES_COLUMNS_THAT_ARE_NOT_THERE));
            }
            (_, Found::End) => {
                columns += 1;
                if let Some(left) = open.last_mut() {
                    *left -= 1;
                }
                if own > 0 {
                    open.push(own);
                }
                while open.last() == Some(&0) {
                    open.pop();
                }
                own = 0;
                if open.len() > DEEPEST {
                    return Err(wrong(sentences::more_than_of_its_columns(&DEEPEST)));
                }
            }
            (_, Found::Number(_) | Found::Other) => {}
        }
        Ok(())
    };
    Walk::new(BufReader::new(from).take(length)).structure(0, 0, &mut tell)
}

/// Sizes announced in the header of a page: its bytes unpacked, its bytes in the file, and its number of values (in
/// `data` for a page of data, in `dictionary` for a page with a dictionary).
#[derive(Default)]
struct Page {
    held: Option<u64>,
    stored: Option<u64>,
    data: Option<u64>,
    dictionary: Option<u64>,
}

impl Page {
    /// Reads a header. Also returns the length of the header (bytes).
    fn read(from: impl Read) -> io::Result<(Self, u64)> {
        let mut page = Page::default();
        let mut tell = |depth: usize, [outer, field]: [i64; 2], found: Found| {
            let slot = match (depth, outer, field) {
                (0, _, HELD) => &mut page.held,
                (0, _, STORED) => &mut page.stored,
                (1, OF_DICTIONARY, VALUES) => &mut page.dictionary,
                (1, _, VALUES) if OF_DATA.contains(&outer) => &mut page.data,
                _ => return Ok(()),
            };
            match found {
                Found::Number(number) => {
                    let size = u32::try_from(number).map_err(|_| wrong(sentences::a_page_announces_bytes(&number)))?;
                    *slot = Some(size.into());
                    Ok(())
                }
                Found::Other => Err(wrong(sentences::THE_SIZE_OF_A_PAGE_IS_NO_NUMBER)),
                Found::End => Ok(()),
            }
        };
        let mut walk = Walk::new(from);
        walk.structure(0, 0, &mut tell)?;
        Ok((page, walk.read))
    }
}

/// Checks the pages of a column of numbers, in a group with this many `rows`.
pub(super) fn check_pages(file: &File, rows: u64, column: &ColumnChunkMetaData) -> io::Result<()> {
    let (start, mut left) = column.byte_range();
    let mut from = BufReader::new(file);
    from.seek(SeekFrom::Start(start))?;
    let mut values = 0;
    while left > 0 {
        let (page, header) = Page::read(&mut from)?;
        let (Some(held), Some(stored)) = (page.held, page.stored) else {
            return Err(wrong(sentences::A_PAGE_HAS_NO_SIZE));
        };
        left = left.checked_sub(header + stored).ok_or_else(|| wrong(sentences::A_PAGE_IS_LONGER_THAN_ITS_COLUMN))?;
        let own = page.data.unwrap_or(0);
        values += own;
        if values > rows {
            return Err(wrong(sentences::its_pages_have_more_values(&rows)));
        }
        let most = match page.dictionary {
            // A dictionary stores every value with at least four bytes. A dictionary with more values than its bytes
            // allow is rejected.
            Some(count) if count > held / 4 => {
                return Err(wrong(sentences::a_dictionary_of_bytes_has_values(&held, &count)));
            }
            Some(_) => DICTIONARY,
            None => own * WIDEST + BESIDE,
        };
        if held > most {
            return Err(wrong(sentences::a_page_announces_bytes_such_a_page(&held, &most)));
        }
        let mut body = from.by_ref().take(stored);
        let unpacked = match column.compression() {
            // The unpacking of gzip data does not stop at the size that the header states. The data is therefore
            // unpacked here to measure its size. For all other compressions, the unpacking stops at the stated size.
            Compression::GZIP(_) => io::copy(&mut MultiGzDecoder::new(&mut body).take(held + 1), &mut io::sink())?,
            Compression::UNCOMPRESSED | Compression::SNAPPY | Compression::ZSTD(_) => 0,
            Compression::BROTLI(_) | Compression::LZ4 | Compression::LZ4_RAW | Compression::LZO => 0,
        };
        if unpacked > held {
            return Err(wrong(sentences::a_page_holds_more_than_the_bytes(&held)));
        }
        io::copy(&mut body, &mut io::sink())?;
    }
    Ok(())
}
