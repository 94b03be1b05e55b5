//! Numbers, flags and fields of a share link.

use crate::sentences;
use linkage::error::{Error, ErrorKind, Result};

/// The digits of numbers, the smallest first.
const DIGITS: &[u8; 64] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";
/// The last character of a query is a checksum: the digit for the length of the query modulo this number.
const CHECKED: usize = 62;
/// A whole number has at most this many digits. PMKS+ cannot handle larger whole numbers.
const MOST_DIGITS: usize = 9;

/// The query without its escapes `%..`.
pub(super) fn unescaped(query: &str) -> String {
    let mut bytes = Vec::with_capacity(query.len());
    let mut rest = query.as_bytes();
    while let [first, tail @ ..] = rest {
        let escaped = match rest {
            [b'%', high, low, ..] => {
                std::str::from_utf8(&[*high, *low]).ok().and_then(|hex| u8::from_str_radix(hex, 16).ok())
            }
            _ => None,
        };
        bytes.push(escaped.unwrap_or(*first));
        rest = if escaped.is_some() { &rest[3..] } else { tail };
    }
    String::from_utf8(bytes).unwrap_or_else(|_| query.into())
}

/// The query without its last character, which must agree with the query's length.
pub(super) fn checked(query: &str) -> Result<&str> {
    let sign = query.chars().next_back().unwrap_or_default();
    let body = &query[..query.len() - sign.len_utf8()];
    // PMKS+ measures the length in code units of UTF-16.
    let length = body.encode_utf16().count();
    let expected = char::from(DIGITS[length % CHECKED]);
    if sign == expected {
        return Ok(body);
    }
    let message = sentences::the_last_sign_of_the_link_is_wrong(&sign, &expected, &length);
    Err(Error::new(ErrorKind::Input, message).key("link").help(sentences::COPY_THE_WHOLE_LINK))
}

/// The fields of one record of a share link.
pub(super) struct Fields<'a> {
    record: String,
    all: Vec<&'a str>,
    next: usize,
}

impl<'a> Fields<'a> {
    /// The fields of a record with this text. Messages call the record `record`.
    pub(super) fn of(record: String, text: &'a str) -> Fields<'a> {
        Fields { record, all: text.split(',').collect(), next: 0 }
    }

    /// The next field. The end of the record is an error, whose message names the missing field `what`.
    pub(super) fn text(&mut self, what: &str) -> Result<&'a str> {
        let found = self.all.get(self.next);
        self.next += 1;
        found.copied().ok_or_else(|| self.fault(sentences::the_record_ends_before(&what)))
    }

    /// The next field, if there is one.
    pub(super) fn optional(&mut self) -> Option<&'a str> {
        self.next += 1;
        self.all.get(self.next - 1).copied()
    }

    /// The next field as a whole number.
    pub(super) fn whole(&mut self, what: &str) -> Result<f64> {
        let text = self.text(what)?;
        number(text).ok_or_else(|| self.fault(sentences::is_no_number_of_a_link(&text, &what)))
    }

    /// The next field, a whole number of thousandths, divided by 1000.
    pub(super) fn decimal(&mut self, what: &str) -> Result<f64> {
        Ok(self.whole(what)? / 1000.0)
    }

    /// An error in this record.
    pub(super) fn fault(&self, message: String) -> Error {
        Error::new(ErrorKind::Input, message).key(self.record.clone()).help(sentences::COPY_THE_WHOLE_LINK)
    }
}

/// Reads a whole number. A leading zero is the minus sign.
fn number(text: &str) -> Option<f64> {
    let (sign, digits) = match text.strip_prefix('0') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    if text.is_empty() || digits.len() > MOST_DIGITS {
        return None;
    }
    let digit = |byte: u8| DIGITS.iter().position(|&own| own == byte);
    let value = digits.bytes().try_fold(0_u64, |value, byte| Some(value * 64 + digit(byte)? as u64))?;
    Some(sign * value as f64)
}

/// Reads flags that are packed in digits of six bits. The most significant digit is the first.
pub(super) fn flags(text: &str) -> Option<u64> {
    let digit = |byte: u8| DIGITS.iter().position(|&own| own == byte);
    text.bytes().try_fold(0_u64, |value, byte| Some((value << 6) | digit(byte)? as u64))
}
