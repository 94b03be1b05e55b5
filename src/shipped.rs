//! Files that help texts and documents mention.
//! The files are embedded in the program, because `cargo install` installs only the program.

use include_dir::{Dir, include_dir};

static SCENARIOS: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenarios");
static CATALOGUES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/catalogues");
const FINDINGS: &[u8] = include_bytes!("../docs/findings.md");

/// Directory of study scenarios. Study scenarios are not embedded: they are nearly half of all scenarios, and no help
/// text mentions them.
const STUDY: &str = "variants60";

fn below(directory: &'static Dir<'static>, path: &str, found: &mut Vec<(String, &'static [u8])>) {
    let own = |name: Option<&std::ffi::OsStr>| format!("{path}/{}", name.unwrap_or_default().to_string_lossy());
    found.extend(directory.files().map(|file| (own(file.path().file_name()), file.contents())));
    for inner in directory.dirs().filter(|inner| !inner.path().ends_with(STUDY)) {
        below(inner, &own(inner.path().file_name()), found);
    }
}

/// Every embedded file: its path, with `/` as separator, and its bytes.
/// The embedded files are the scenarios with their tables, the catalogues, and the document of findings, to which
/// scenarios refer beside published numbers.
#[must_use]
pub fn files() -> Vec<(String, &'static [u8])> {
    let mut found = vec![("docs/findings.md".to_string(), FINDINGS)];
    below(&SCENARIOS, "scenarios", &mut found);
    below(&CATALOGUES, "catalogues", &mut found);
    found.sort();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_file_equals_the_repository_file() {
        let top = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let files = files();
        for (path, bytes) in &files {
            assert!(std::fs::read(top.join(path)).unwrap() == *bytes, "{path}");
        }
        for folder in ["scenarios", "scenarios/formulas", "scenarios/ov7_base", "catalogues"] {
            for entry in std::fs::read_dir(top.join(folder)).unwrap().map(Result::unwrap) {
                let path = format!("{folder}/{}", entry.file_name().to_string_lossy());
                assert!(entry.path().is_dir() || files.iter().any(|(own, _)| *own == path), "{path}");
            }
        }
        assert!(!files.iter().any(|(path, _)| path.contains(STUDY)));
    }
}
