//! Reads text files, and describes the errors for files that are not text.

use crate::sentences;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use linkage::mechanism::is_unseen;

/// Upper limit of the size of a file that is read as text (bytes).
pub const LARGEST: u64 = 64 << 20;
/// Upper limit of the length of a message that is shown (characters).
const LONGEST: usize = 2000;

/// Limits the length of a text and escapes every invisible character.
/// Without the escapes, a name in a file could imitate a line of output or control a terminal.
#[must_use]
pub fn visible(text: &str) -> String {
    shown(text, is_unseen)
}

/// Limits the length of a text of several lines and escapes every invisible character except the line feed.
#[must_use]
pub fn visible_lines(text: &str) -> String {
    shown(text, |letter| letter != '\n' && is_unseen(letter))
}

fn shown(text: &str, is_escaped: impl Fn(char) -> bool) -> String {
    let mut shown = String::new();
    for letter in text.chars().take(LONGEST) {
        if is_escaped(letter) { shown.extend(letter.escape_default()) } else { shown.push(letter) }
    }
    if text.chars().nth(LONGEST).is_some() {
        shown.push_str(" ...");
    }
    shown
}

/// Text of the file at `path`, at most 64 MiB.
///
/// # Errors
/// The errors of the file system. A file that is larger than 64 MiB or is not text is also an error. [`way_out`] gives
/// the remedy.
pub fn read_text(path: &Path) -> io::Result<String> {
    text_from(File::open(path)?)
}

/// Text from an open source, at most 64 MiB.
///
/// # Errors
/// The errors of [`read_text`].
pub fn text_from(from: impl Read) -> io::Result<String> {
    let mut bytes = Vec::new();
    from.take(LARGEST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > LARGEST {
        return Err(io::Error::other(sentences::it_has_more_than_mib(&(LARGEST >> 20))));
    }
    decoded(bytes).map_err(|other| io::Error::new(io::ErrorKind::InvalidData, other))
}

/// Text of a file that another file names, at most 64 MiB.
/// The file must be regular: reading a terminal, for example, might never end.
///
/// # Errors
/// The errors of [`read_text`], or an error if the file is not regular.
pub fn read_named(path: &Path) -> io::Result<String> {
    if fs::metadata(path)?.is_file() {
        read_text(path)
    } else {
        Err(io::Error::other(sentences::IT_IS_NO_REGULAR_FILE))
    }
}

/// Text of a file whose name the program generated; `None` if there is no such file.
///
/// # Errors
/// The errors of [`read_named`].
pub fn text(path: &Path) -> io::Result<Option<String>> {
    match read_named(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        other => other.map(Some),
    }
}

/// Remedy for a file that could not be read. The remedy is `usual` for every error except a wrong encoding.
pub fn way_out(error: &io::Error, usual: &str) -> String {
    match error.get_ref().and_then(|inner| inner.downcast_ref::<Encoding>()) {
        None => usual.into(),
        Some(Encoding { name: None, .. }) => sentences::GIVE_A_TEXT_FILE_IN_UTF.into(),
        Some(Encoding { name: Some(name), .. }) => sentences::save_it_as_utf_in_your_editor(&name),
    }
}

/// Encoding of a file that is not written in UTF-8.
#[derive(Debug)]
struct Encoding {
    told: String,
    /// Name of the encoding for `iconv`; `None` if the file is not text.
    name: Option<&'static str>,
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told)
    }
}

impl std::error::Error for Encoding {}

fn decoded(bytes: Vec<u8>) -> Result<String, Encoding> {
    let other = |name| Encoding { told: sentences::it_is_written_in_but_utf(&name), name: Some(name) };
    match bytes.as_slice() {
        [0xff, 0xfe, 0, 0, ..] | [0, 0, 0xfe, 0xff, ..] => return Err(other("UTF-32")),
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => return Err(other("UTF-16")),
        // UTF-16 without byte order mark is recognised by its zeros: in UTF-16, every second byte of ASCII text is
        // zero.
        [first, 0, second, 0, ..] if *first != 0 && *second != 0 => return Err(other("UTF-16LE")),
        [0, first, 0, second, ..] if *first != 0 && *second != 0 => return Err(other("UTF-16BE")),
        _ => {}
    }
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        let told = sentences::it_is_no_text_byte_is_zero(&(at + 1));
        return Err(Encoding { told, name: None });
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let bytes = error.as_bytes();
        let (byte, line) = (bytes[at], bytes[..at].iter().filter(|&&byte| byte == b'\n').count() + 1);
        let told =
            sentences::it_is_not_written_in_utf(&line, &format_args!("{byte:02X}"), &char::from(byte).escape_debug());
        Encoding { told, name: Some("WINDOWS-1252") }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(bytes: &[u8]) -> (String, String) {
        let error = text_from(bytes).unwrap_err();
        (error.to_string(), way_out(&error, "usual"))
    }

    #[test]
    fn other_encodings_are_named_with_a_remedy() {
        let utf16 = |swap: bool| -> Vec<u8> {
            "name = \"ä\""
                .encode_utf16()
                .flat_map(|unit| if swap { unit.to_be_bytes() } else { unit.to_le_bytes() })
                .collect()
        };
        for (bytes, name) in [
            ([&[0xff, 0xfe][..], &utf16(false)].concat(), "UTF-16"),
            ([&[0xfe, 0xff][..], &utf16(true)].concat(), "UTF-16"),
            (utf16(false), "UTF-16LE"),
            (utf16(true), "UTF-16BE"),
            (b"\xff\xfe\0\0n\0\0\0".to_vec(), "UTF-32"),
        ] {
            let (message, help) = told(&bytes);
            assert_eq!(message, format!("it is written in {name}, but UTF-8 is needed"));
            assert!(help.contains(&format!("iconv -f {name} -t UTF-8")), "{help}");
        }
        let (message, help) = told(b"a = 1\nb = \"\xe4\"\n");
        assert!(message.contains("line 2 has the byte 0xE4, in Latin-1 the letter `\u{e4}`"), "{message}");
        assert!(help.contains("iconv -f WINDOWS-1252"), "{help}");
        let (message, help) = told(b"MCAP0\r\n\x01\0\0");
        assert!(message.contains("not a text file") && help == "give a text file in UTF-8", "{message} {help}");
    }

    #[test]
    fn utf_8_is_read_with_and_without_byte_order_mark() {
        assert_eq!(text_from("ä".as_bytes()).unwrap(), "ä");
        assert_eq!(text_from("\u{feff}a".as_bytes()).unwrap(), "\u{feff}a");
        assert_eq!(text_from(&b""[..]).unwrap(), "");
        let missing = File::open("no such file").unwrap_err();
        assert_eq!(way_out(&missing, "usual"), "usual");
    }
}
