//! Only the command line may name its options and commands, and set the panic hook of the process.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Directory of the command line, below the repository's root.
const COMMAND_LINE: &str = "src/cli";

/// Source files of the library and of all its crates, without tests.
fn sources() -> Vec<PathBuf> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(top.join("crates")).unwrap().map(|entry| entry.unwrap().path().join("src"));
    let mut files: Vec<PathBuf> =
        crates.chain([top.join("src")]).flat_map(|directory| rust_files(&directory)).collect();
    let of_command_line = [COMMAND_LINE, "src/sentences/command.rs"].map(|place| top.join(place));
    files.retain(|file| !of_command_line.iter().any(|place| file.starts_with(place)));
    files.sort();
    assert!(files.len() > 150, "the sources are not found: {}", files.len());
    files
}

fn rust_files(directory: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        let is_test = path.file_stem().is_some_and(|stem| stem == "tests");
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if !is_test && path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// A file's text without the test module at its end.
fn without_tests(code: &str) -> &str {
    let marks = code.match_indices("#[cfg(test)]\nmod ").map(|(at, _)| at);
    let module = marks.into_iter().find(|&at| code[at..].lines().nth(1).is_some_and(|line| line.ends_with('{')));
    &code[..module.unwrap_or(code.len())]
}

/// String literals of a source text with their line numbers, counted from 1, and the rest of the text without comments.
fn literals(code: &str) -> (Vec<(usize, String)>, String) {
    let (mut found, mut code_alone, mut line) = (Vec::new(), String::new(), 1);
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let hashes = rest[1.min(rest.len())..].bytes().take_while(|&byte| byte == b'#').count();
        let raw = first == 'r' && rest[1 + hashes..].starts_with('"') && !code_alone.ends_with(char::is_alphanumeric);
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if raw {
            let end = format!("\"{}", "#".repeat(hashes));
            let body = &rest[2 + hashes..];
            let body = &body[..body.find(&end).unwrap_or(body.len())];
            found.push((line, body.to_string()));
            2 + hashes + body.len() + end.len()
        } else if first == '"' {
            let end = end_of_quoted(rest, '"');
            found.push((line, rest[1..end - 1].to_string()));
            end
        } else if first == '\'' && (rest[1..].starts_with('\\') || rest.chars().nth(2) == Some('\'')) {
            end_of_quoted(rest, '\'')
        } else {
            code_alone.push(first);
            first.len_utf8()
        };
        let (passed, after) = rest.split_at(length.min(rest.len()));
        line += passed.matches('\n').count();
        rest = after;
    }
    (found, code_alone)
}

fn end_of_quoted(code: &str, quote: char) -> usize {
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

/// Whether a text names an option (`--dt`) or a command (`linkproof solve`).
fn names_an_option(text: &str) -> bool {
    let goes_on = |mark: &str| {
        let word = |at: usize| text[at + mark.len()..].starts_with(|sign: char| sign.is_ascii_lowercase());
        text.match_indices(mark).any(|(at, _)| word(at))
    };
    goes_on("--") || goes_on("linkproof ")
}

#[test]
fn only_the_command_line_names_its_options_and_commands() {
    let mut wrong = Vec::new();
    for file in sources() {
        let code = fs::read_to_string(&file).unwrap();
        let (found, _) = literals(without_tests(&code));
        let found = found.into_iter().filter(|(_, text)| names_an_option(text));
        wrong.extend(found.map(|(line, text)| format!("{}:{line}: \"{text}\"", file.display())));
    }
    assert!(wrong.is_empty(), "give advice as `linkage::error::Advice`:\n{}", wrong.join("\n"));
}

/// The sentences are items that a macro of another crate defines.
/// The compiler does not report such items as unused, so this test looks for unused sentences.
#[test]
fn every_sentence_is_used() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(top.join("crates")).unwrap().map(|entry| entry.unwrap().path());
    let mut unused = Vec::new();
    for source in crates.chain([top.to_path_buf()]).map(|path| path.join("src")) {
        let is_list =
            |path: &PathBuf| path.components().any(|part| part.as_os_str().to_string_lossy().starts_with("sentences"));
        let (lists, code): (Vec<PathBuf>, Vec<PathBuf>) = rust_files(&source).into_iter().partition(is_list);
        let texts = |paths: &[PathBuf]| paths.iter().map(|path| fs::read_to_string(path).unwrap()).collect::<String>();
        let code = texts(&code);
        let words: BTreeSet<&str> = code.split(|sign: char| !sign.is_alphanumeric() && sign != '_').collect();
        for line in texts(&lists).lines().filter(|line| line.ends_with("\";") && line.contains(" = \"")) {
            let name = line.trim_start().split(|sign: char| !sign.is_alphanumeric() && sign != '_').next().unwrap();
            if !words.contains(name) {
                unused.push(format!("{}: {name}", source.display()));
            }
        }
    }
    assert!(unused.is_empty(), "{unused:#?}");
}

#[test]
fn only_the_command_line_sets_the_panic_hook() {
    for file in sources() {
        let code = fs::read_to_string(&file).unwrap();
        let (_, code) = literals(without_tests(&code));
        assert!(!code.contains("set_hook") && !code.contains("take_hook"), "{}", file.display());
    }
}

#[test]
fn every_form_of_a_string_literal_is_found() {
    let code = r##"
        //! Choose a smaller step: --hidden.
        fn f<'a>(x: &'a str) -> char { g("--seen", '"', r#"use "linkproof solve" "#); '\'' }
        /* "--hidden" */ const TEXT: &str = "a \"quoted\" --seen";
        #[cfg(test)]
        mod hidden;
        const NONE: [&str; 3] = ["a -- b", "--", "linkproof 0.1"];
        #[cfg(test)]
        mod tests {
            const HIDDEN: &str = "--hidden";
            fn take_hook() {}
        }
    "##
    .replace("\n        ", "\n");
    let (found, code_alone) = literals(without_tests(&code));
    let told: Vec<bool> = found.iter().map(|(_, text)| names_an_option(text)).collect();
    assert_eq!(told, [true, true, true, false, false, false], "{found:?}");
    assert_eq!(found[1], (3, "use \"linkproof solve\" ".to_string()));
    assert!(!code_alone.contains("hook") && !code_alone.contains("seen"), "{code_alone}");
}
