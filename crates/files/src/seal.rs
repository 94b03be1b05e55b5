//! A seal in a file. The seal shows whether this program wrote the file, and whether the file has been changed since.

use crate::sentences;
use std::path::Path;

/// Text before the digits of the seal.
const MARK: &str = sentences::MADE_BY_LINKPROOF_SEAL;
/// Number of hexadecimal digits of a seal.
const DIGITS: usize = 16;

/// Returns a text with its seal, in a comment or key that the file format allows.
/// The formats with such a comment or key are JSON, HTML, SVG, other XML, manual pages, scenarios, and tables whose
/// first lines may begin with `#`.
/// In any other format the seal is the last line.
pub fn sealed(text: &str, place: &Path) -> String {
    let blank = format!("{MARK}{}", "0".repeat(DIGITS));
    let open = match place.extension().and_then(|ending| ending.to_str()).unwrap_or_default() {
        "json" => text.replacen('{', &format!("{{\n  \"made_by\": \"{blank}\","), 1),
        "html" | "svg" | "xml" => format!("{}\n<!-- {blank} -->\n", text.trim_end()),
        "1" => format!(".\\\" {blank}\n{text}"),
        "csv" | "toml" => {
            let lines = text.split_inclusive('\n').take_while(|line| line.starts_with('#'));
            let (head, rows) = text.split_at(lines.map(str::len).sum());
            format!("{head}# {blank}\n{rows}")
        }
        _ => format!("{text}{blank}\n"),
    };
    open.replacen(&blank, &format!("{MARK}{:016x}", hash(open.as_bytes())), 1)
}

/// Whether a file has an unbroken seal.
/// An unbroken seal shows that this program wrote the file and that the file was not changed afterwards.
pub fn is_sealed(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    // The file's seal is the first or the last seal in the text.
    // Any seal between the first and the last may be a quotation of another file's seal.
    [text.find(MARK), text.rfind(MARK)].into_iter().flatten().any(|found| {
        let digits = found + MARK.len()..found + MARK.len() + DIGITS;
        let Some(told) = text.get(digits.clone()) else { return false };
        let mut open = text.to_string();
        open.replace_range(digits, &"0".repeat(DIGITS));
        told == format!("{:016x}", hash(open.as_bytes()))
    })
}

/// FNV-1a hash. The hash is the same with every version of Rust.
/// Carriage returns are not hashed, because tools change line endings.
fn hash(bytes: &[u8]) -> u64 {
    let letters = bytes.iter().filter(|&&byte| byte != b'\r');
    letters.fold(0xcbf2_9ce4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Check digits of a word. `super::temporary` recognises the names of temporary files by these digits.
pub(super) fn check(word: &str) -> String {
    format!("{:08x}", hash(word.as_bytes()) >> 32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_change_except_line_endings_breaks_the_seal() {
        for (name, text) in [
            ("a.json", "{\n  \"b\": 1\n}\n"),
            ("a.html", "<!doctype html>\n<p>b</p>\n"),
            ("a.svg", "<svg><title>made by linkproof, seal 0123</title></svg>\n"),
            ("a.1", ".TH b\n"),
            ("a.csv", "# cpu: b\nx,y\n"),
            ("a.toml", "# b\nx = 1\n"),
            ("a.txt", "b\n"),
        ] {
            let own = sealed(text, Path::new(name));
            assert!(is_sealed(own.as_bytes()), "{own}");
            assert!(is_sealed(own.replace('\n', "\r\n").as_bytes()), "{own}");
            assert!(!is_sealed(text.as_bytes()) && !is_sealed(b"") && !is_sealed(b"made by linkproof, seal 12"));
            for (at, letter) in own.char_indices().filter(|(_, letter)| *letter != '\n') {
                let other = if letter == 'x' { 'y' } else { 'x' };
                let mut changed = own.clone();
                changed.replace_range(at..at + letter.len_utf8(), &other.to_string());
                assert!(!is_sealed(changed.as_bytes()), "{changed}");
            }
            if name.ends_with("json") {
                let parsed: serde_json::Value = serde_json::from_str(&own).unwrap();
                assert_eq!(parsed["b"], 1);
            }
        }
    }
}
