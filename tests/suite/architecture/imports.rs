//! Which modules of the crate a source file names.

use std::collections::BTreeSet;

/// What a piece of code refers to in its own crate.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Imports {
    /// First names after `crate::`.
    pub names: BTreeSet<String>,
    /// Things that this reader cannot follow, in words.
    pub unclear: Vec<String>,
}

/// Reads the code of a file whose module lies `depth` below the crate's root. Comments, strings and everything under
/// `#[cfg(test)]` are left out: tests may borrow fixtures from anywhere.
pub fn imports(code: &str, depth: usize) -> Imports {
    let words = code_words(code);
    let mut found = Imports::default();
    for (at, word) in words.iter().enumerate() {
        let starts = at == 0 || words[at - 1] != "::";
        match word.as_str() {
            "crate" if words.get(at + 1).is_some_and(|next| next == "::") => heads(&words[at + 2..], &mut found),
            "crate" if at > 0 && words[at - 1] != "(" => found.unclear.push("`crate` without a path".into()),
            "super" if starts => {
                let supers = words[at..].iter().step_by(2).take_while(|word| *word == "super").count();
                if supers >= depth {
                    found.unclear.push("`super` reaches the crate's root; write `crate::`".into());
                }
            }
            "linkproof" => found.unclear.push("the crate calls itself by name; write `crate::`".into()),
            _ => {}
        }
    }
    found
}

/// Names, `::` and single signs of a code, without comments, strings, characters and tests.
pub fn code_words(code: &str) -> Vec<String> {
    without_tests(words(code))
}

/// The name that a path goes on with, or the first names of all paths of a group.
fn heads(words: &[String], found: &mut Imports) {
    let mut take = |word: &str| {
        if word == "self" || word == "*" {
            found.unclear.push(format!("`crate::{word}` hides what is used"));
        } else {
            found.names.insert(word.to_string());
        }
    };
    if words[0] != "{" {
        return take(&words[0]);
    }
    let (mut depth, mut expected) = (0, false);
    for word in words {
        match word.as_str() {
            "{" => {
                depth += 1;
                expected = depth == 1;
            }
            "}" if depth == 1 => return,
            "}" => depth -= 1,
            "," => expected = depth == 1,
            name if expected => {
                take(name);
                expected = false;
            }
            _ => {}
        }
    }
}

/// The same with tests.
fn words(code: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if rest.starts_with("r\"") || rest.starts_with("r#") {
            raw_string(rest).unwrap_or(1)
        } else if first == '"' {
            quoted(rest, '"')
        } else if first == '\'' && (rest[1..].starts_with('\\') || rest.chars().nth(2) == Some('\'')) {
            quoted(rest, '\'')
        } else {
            let name = rest.find(|sign: char| !sign.is_alphanumeric() && sign != '_').unwrap_or(rest.len());
            let length = if rest.starts_with("::") { 2 } else { name.max(first.len_utf8()) };
            if !first.is_whitespace() {
                words.push(rest[..length].to_string());
            }
            length
        };
        rest = &rest[length..];
    }
    words
}

/// Length of the string or character that `code` starts with.
fn quoted(code: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, sign) in code.char_indices().skip(1) {
        match sign {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            sign if sign == quote => return at + 1,
            _ => {}
        }
    }
    code.len()
}

/// Length of the raw string that `code` starts with, if it does.
fn raw_string(code: &str) -> Option<usize> {
    let hashes = code[1..].bytes().take_while(|&byte| byte == b'#').count();
    let end = format!("\"{}", "#".repeat(hashes));
    let body = code[1 + hashes..].strip_prefix('"')?;
    Some(2 + hashes + body.find(&end)? + end.len())
}

/// Takes out every item under `#[cfg(test)]`: up to its `;`, or to the end of its braces.
fn without_tests(words: Vec<String>) -> Vec<String> {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut rest = words.as_slice();
    while let Some(word) = rest.first() {
        if rest.len() >= MARK.len() && rest.iter().zip(MARK).all(|(word, mark)| word == mark) {
            rest = &rest[item_length(rest)..];
        } else {
            kept.push(word.clone());
            rest = &rest[1..];
        }
    }
    kept
}

fn item_length(words: &[String]) -> usize {
    let mut depth = 0;
    for (at, word) in words.iter().enumerate() {
        match word.as_str() {
            ";" if depth == 0 => return at + 1,
            "{" => depth += 1,
            "}" if depth == 1 => return at + 1,
            "}" => depth -= 1,
            _ => {}
        }
    }
    words.len()
}

#[test]
fn every_form_of_an_import_is_seen() {
    let code = r##"
        //! See [`crate::hidden_in_a_comment`].
        use crate::{a::{self, deep}, b, c::*};
        pub(crate) fn f<'a>(x: &'a str) -> crate::d::T { g("crate::hidden {", '{', r#"crate::hidden"#); super::e() }
        /* crate::hidden */
        #[cfg(test)]
        pub(crate) mod fixtures { use crate::hidden; fn f() { } }
        #[cfg(test)]
        mod tests;
        use crate::f;
    "##;
    let found = imports(code, 2);
    assert_eq!(found.names.iter().map(String::as_str).collect::<Vec<_>>(), ["a", "b", "c", "d", "f"]);
    assert!(found.unclear.is_empty(), "{:?}", found.unclear);
}

#[test]
fn ways_around_the_table_are_unclear() {
    for code in ["use crate::*;", "use crate::{self as all};", "use super::super::x;", "use linkproof::x;"] {
        assert_eq!(imports(code, 2).unclear.len(), 1, "{code}");
    }
    assert_eq!(imports("use super::x;", 1).unclear.len(), 1);
}
