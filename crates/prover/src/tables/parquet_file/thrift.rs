//! The compact protocol of Thrift, in which a Parquet file describes itself.
//! The description is read without allocating memory.

use crate::sentences;
use std::io::{self, Read};

/// Limit of the elements of all lists together, because the file's reader allocates memory for all stated elements.
const MOST: u64 = 1 << 22;
/// Limit of the nesting depth of structures and lists.
const DEEPEST: usize = 32;

/// Content of a field.
pub(super) enum Found {
    /// A whole number.
    Number(i64),
    /// Anything else.
    Other,
    /// End of the structure that the field belongs to.
    End,
}

/// Receives a field: its depth (0 in the outermost structure), the number of the enclosing field, the number of the
/// field itself, and its content.
pub(super) type Tell<'a> = &'a mut dyn FnMut(usize, [i64; 2], Found) -> io::Result<()>;

/// A walk over the data, with the number of bytes read.
pub(super) struct Walk<R> {
    from: R,
    pub read: u64,
    elements: u64,
}

pub(super) fn wrong(what: impl Into<String>) -> io::Error {
    io::Error::other(what.into())
}

impl<R: Read> Walk<R> {
    pub fn new(from: R) -> Self {
        Walk { from, read: 0, elements: 0 }
    }

    /// Walks over a structure. `depth` is 0 for the outermost structure.
    pub fn structure(&mut self, depth: usize, outer: i64, tell: Tell) -> io::Result<()> {
        let mut field: i64 = 0;
        loop {
            let head = self.byte()?;
            if head == 0 {
                return tell(depth, [outer, field], Found::End);
            }
            field = match i64::from(head >> 4) {
                0 => self.number()?,
                step => field.saturating_add(step),
            };
            match head & 15 {
                // The value of a Boolean is part of the type code.
                1 | 2 => tell(depth, [outer, field], Found::Other)?,
                kind => self.value(kind, depth, [outer, field], tell)?,
            }
        }
    }

    fn value(&mut self, kind: u8, depth: usize, at: [i64; 2], tell: Tell) -> io::Result<()> {
        if depth > DEEPEST {
            return Err(wrong(sentences::more_than_of_its_parts_are_within(&DEEPEST)));
        }
        if let 4..=6 = kind {
            let number = self.number()?;
            return tell(depth, at, Found::Number(number));
        }
        tell(depth, at, Found::Other)?;
        match kind {
            1..=3 => self.pass(1),
            7 => self.pass(8),
            8 => {
                let length = self.varint()?;
                self.pass(length)
            }
            9 | 10 => {
                let head = self.byte()?;
                let count = if head >> 4 == 15 { self.varint()? } else { u64::from(head >> 4) };
                self.each(count, &[head & 15], depth, at, tell)
            }
            11 => match self.varint()? {
                0 => Ok(()),
                count => {
                    let kinds = self.byte()?;
                    self.each(count, &[kinds >> 4, kinds & 15], depth, at, tell)
                }
            },
            12 => self.structure(depth + 1, at[1], tell),
            _ => Err(wrong(sentences::it_has_a_part_of_the_unknown(&kind))),
        }
    }

    /// Walks over the `count` elements of a list, or the `count` pairs of a map. `kinds` states the type of an element,
    /// or the types of the key and the value of a pair.
    fn each(&mut self, count: u64, kinds: &[u8], depth: usize, at: [i64; 2], tell: Tell) -> io::Result<()> {
        self.elements = self.elements.saturating_add(count);
        if self.elements > MOST {
            return Err(wrong(sentences::it_is_described_by_more_than_parts(&MOST)));
        }
        for _ in 0..count {
            for &kind in kinds {
                self.value(kind, depth + usize::from(kind != 12), at, tell)?;
            }
        }
        Ok(())
    }

    fn byte(&mut self) -> io::Result<u8> {
        let mut byte = [0];
        self.from.read_exact(&mut byte)?;
        self.read += 1;
        Ok(byte[0])
    }

    fn varint(&mut self) -> io::Result<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 127) << shift;
            if byte < 128 {
                return Ok(value);
            }
        }
        Err(wrong(sentences::IT_HAS_A_NUMBER_WITHOUT_AN_END))
    }

    /// A whole number whose last bit is the sign.
    fn number(&mut self) -> io::Result<i64> {
        let value = self.varint()?;
        Ok((value >> 1).cast_signed() ^ -(value & 1).cast_signed())
    }

    fn pass(&mut self, bytes: u64) -> io::Result<()> {
        let passed = io::copy(&mut self.from.by_ref().take(bytes), &mut io::sink())?;
        self.read += passed;
        if passed == bytes { Ok(()) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
    }
}
