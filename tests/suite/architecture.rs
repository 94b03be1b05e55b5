//! The architecture as a test: which module may know which, and a few rules for every file.

mod imports;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use imports::{code_words, imports};

/// Every module, and what it may name of the rest of the crate. As tight as the code is: an entry that nothing uses
/// fails too.
const ALLOWED: &[(&str, &str)] = &[
    ("assur", "math mechanism"),
    ("case", "drive math mechanism trajectory"),
    (
        "cli",
        "case compare diagram drive engine error export math mechanism proof record reference report scenario synthesis task trajectory tune",
    ),
    ("compare", "error math tolerance trajectory"),
    ("diagram", "case error math mechanism solver trajectory"),
    ("drive", "math mechanism"),
    ("engine", "case drive error math mechanism solver trajectory"),
    ("error", ""),
    ("export", "case drive error math mechanism solver trajectory"),
    ("math", ""),
    ("mechanism", "error math"),
    ("proof", "case compare drive engine error math mechanism reference scenario solver tolerance trajectory"),
    ("record", "error math mechanism trajectory"),
    ("reference", "assur case drive error math mechanism solver trajectory"),
    ("report", "compare error proof solver trajectory"),
    ("scenario", "case drive error math mechanism task trajectory"),
    ("solver", "case error math mechanism trajectory"),
    // Candidates are solved as fast as can be: by groups, without a solver's grid and channels.
    ("synthesis", "assur error math mechanism reference solver task"),
    ("task", "case error math mechanism"),
    ("tolerance", ""),
    ("trajectory", "error"),
    // A join like the proof: engines are priced against the reference.
    ("tune", "case compare engine error proof reference scenario solver trajectory"),
];

/// What must never be, whatever the table above comes to allow: module, and what it must not name.
const NEVER: &[(&str, &str)] = &[
    ("math", "mechanism drive case solver"),
    ("mechanism", "drive case solver scenario trajectory record"),
    ("drive", "solver assur reference engine"),
    ("tolerance", "solver assur reference engine"),
    ("trajectory", "mechanism solver"),
    ("case", "scenario tolerance solver assur reference engine"),
    ("solver", "assur reference engine"),
    ("scenario", "solver assur reference engine compare proof"),
    // Forces come to groups only in the reference, which owns kinetostatics.
    ("assur", "drive case solver reference engine compare"),
    ("reference", "engine compare proof scenario record"),
    ("engine", "assur reference compare proof scenario record"),
    ("compare", "mechanism case solver assur reference engine scenario"),
    // Any solver's states are drawn.
    ("diagram", "drive assur reference engine compare proof record scenario"),
    // A model is built from the mechanism and its first state, whoever solved it.
    ("export", "assur reference engine compare proof record scenario"),
    ("record", "compare proof solver assur reference engine"),
    ("report", "assur reference engine record scenario mechanism"),
    ("proof", "record report"),
    ("synthesis", "engine compare proof record scenario"),
    ("task", "scenario solver assur reference engine"),
    ("tune", "record report cli"),
];

/// What only some modules may name: other people's crates stay behind the module that wraps them, the clock and the
/// terminal behind the command line, and no result depends on the order of a hash.
const HOMES: &[(&str, &str)] = &[
    ("rapier2d", "engine"),
    ("rapier2d_f64", "engine"),
    ("linkproof_simbody", "engine"),
    ("mcap", "record"),
    ("foxglove", "record"),
    ("prost", "record"),
    ("prost_types", "record"),
    ("toml", "scenario"),
    ("toml_edit", "scenario"),
    ("cobyla", "synthesis"),
    ("rand", "synthesis"),
    ("rand_chacha", "synthesis"),
    ("strsim", "scenario"),
    ("num_integer", "reference"),
    ("rayon", "synthesis"),
    ("petgraph", "mechanism"),
    ("nalgebra", "math"),
    ("pulp", "reference"),
    ("differential_equations", "reference"),
    ("f64x8", "reference"),
    ("comfy_table", "report"),
    ("svg", "diagram"),
    ("quick_xml", "export"),
    ("serde", "report"),
    ("serde_json", "report cli"),
    ("clap", "cli"),
    ("indicatif", "cli"),
    ("annotate_snippets", "cli"),
    ("Instant", "cli"),
    ("SystemTime", "cli"),
    ("stdout", "cli"),
    ("stderr", "cli"),
    ("println", ""),
    ("eprintln", ""),
    ("HashMap", "record"),
    ("HashSet", ""),
];

/// Files longer than this have more than one purpose.
const MOST_LINES: usize = 600;

/// Words that no code may hold.
const BANNED: [&str; 4] = ["unsafe", "todo!", "unimplemented!", "dbg!"];

/// The crate's own names at its root, and the module that they come from.
fn module_of(name: &str) -> &str {
    match name {
        "Error" | "ErrorKind" | "Result" => "error",
        module => module,
    }
}

fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All Rust files below a directory, in order.
fn rust_files(directory: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Module path of a source file, `["engine", "rapier", "twin"]`; `None` for the roots and for files of tests.
fn module_path(file: &Path) -> Option<Vec<String>> {
    let inside = file.strip_prefix(top().join("src")).unwrap().with_extension("");
    let mut parts: Vec<String> = inside.iter().map(|part| part.to_str().unwrap().to_string()).collect();
    if parts.last().is_some_and(|last| last == "mod") {
        parts.pop();
    }
    let skipped = parts.iter().any(|part| part == "tests") || ["lib", "main"].contains(&parts[0].as_str());
    (!skipped).then_some(parts)
}

/// Edges between modules: from, to, and a file that has it.
fn edges() -> BTreeMap<(String, String), PathBuf> {
    let mut edges = BTreeMap::new();
    for file in rust_files(&top().join("src")) {
        let Some(module) = module_path(&file) else { continue };
        let found = imports(&fs::read_to_string(&file).unwrap(), module.len());
        assert!(found.unclear.is_empty(), "{}: {}", file.display(), found.unclear.join("; "));
        for name in found.names {
            let to = module_of(&name).to_string();
            if to != module[0] {
                edges.insert((module[0].clone(), to), file.clone());
            }
        }
    }
    assert!(edges.len() > 20, "the imports are not found any more");
    edges
}

/// Rows of a table, taken apart.
fn pairs(table: &'static [(&str, &str)]) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.iter().flat_map(|(from, all)| all.split_whitespace().map(|to| (*from, to)))
}

/// All that is wrong, in one message.
fn nothing(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

#[test]
fn modules_name_only_what_the_table_allows() {
    let allowed: BTreeSet<(&str, &str)> = pairs(ALLOWED).collect();
    let forbidden = edges().into_iter().filter(|((from, to), _)| !allowed.contains(&(from, to)));
    nothing(forbidden.map(|((from, to), file)| format!("`{from}` must not know `{to}`: {}", file.display())).collect());
}

#[test]
fn the_table_has_no_dead_rows() {
    let edges: BTreeSet<(String, String)> = edges().into_keys().collect();
    let dead = pairs(ALLOWED).filter(|(from, to)| !edges.contains(&(from.to_string(), to.to_string())));
    nothing(dead.map(|(from, to)| format!("`{from}` does not use `{to}` any more: tighten the table")).collect());
}

#[test]
fn the_table_has_every_module_once() {
    let library = fs::read_to_string(top().join("src/lib.rs")).unwrap();
    let declared = library.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
    let rows: Vec<&str> = ALLOWED.iter().map(|(module, _)| *module).collect();
    assert_eq!(declared.collect::<Vec<_>>(), rows, "one row a module, in the order of src/lib.rs");
    for (from, to) in pairs(NEVER) {
        assert!(rows.contains(&from) && rows.contains(&to), "`{from}`, `{to}`: a prohibition that nothing can break");
    }
}

#[test]
fn what_must_never_be_is_not_allowed_either() {
    let never: BTreeSet<(&str, &str)> = pairs(NEVER).collect();
    let both = pairs(ALLOWED).filter(|(from, to)| never.contains(&(from, to)) || *to == "cli");
    nothing(both.map(|(from, to)| format!("`{from}` must never see `{to}`, whatever it would gain")).collect());
}

#[test]
fn modules_do_not_know_each_other_in_circles() {
    // What is left after modules that know nobody left are taken out again and again.
    let mut left: BTreeMap<&str, BTreeSet<&str>> =
        ALLOWED.iter().map(|(from, all)| (*from, all.split_whitespace().collect())).collect();
    while let Some(free) = left.iter().find(|(_, all)| all.is_empty()).map(|(module, _)| *module) {
        left.remove(free);
        left.values_mut().for_each(|all| {
            all.remove(free);
        });
    }
    assert!(left.is_empty(), "these know each other in a circle, or know one that does: {:?}", left.keys());
}

#[test]
fn what_has_a_home_stays_there() {
    let mut wrong = Vec::new();
    for file in rust_files(&top().join("src")) {
        let Some(module) = module_path(&file) else { continue };
        let words = code_words(&fs::read_to_string(&file).unwrap());
        for (name, homes) in HOMES {
            // A field or a function of the same name is somebody else.
            let path = |at: usize| ["::", "!", ",", "}", ";"].contains(&words[at].as_str());
            let used = (1..words.len()).any(|at| words[at - 1] == *name && path(at));
            if used && !homes.split_whitespace().any(|home| home == module[0]) {
                wrong.push(format!("{}: `{name}` is at home in: {homes}", file.display()));
            }
        }
    }
    nothing(wrong);
}

/// The word that only one file of the repository may hold, and there with a reason at every place.
#[test]
fn unsafe_code_is_at_the_boundary_to_simbody_alone() {
    let unsafe_word = BANNED[0];
    let mut places = 0;
    for file in rust_files(&top().join("crates")) {
        let text = fs::read_to_string(&file).unwrap();
        if !file.ends_with("crates/simbody/src/ffi.rs") {
            let words = code_words(&text);
            assert!(words.iter().all(|word| word != unsafe_word), "{}: holds `{unsafe_word}`", file.display());
            continue;
        }
        let code = text.lines().map(|line| line.split("//").next().unwrap_or(""));
        places = code.map(|line| line.matches(&format!("{unsafe_word} {{")).count()).sum();
        let reasons = text.matches("// SAFETY: ").count();
        assert_eq!(places, reasons, "{}: as many reasons as places", file.display());
    }
    assert!(places > 0, "the boundary is not found any more");
}

#[test]
fn files_are_short_and_free_of_stopgaps() {
    let mut wrong = Vec::new();
    for file in rust_files(&top().join("src")).into_iter().chain(rust_files(&top().join("tests"))) {
        let text = fs::read_to_string(&file).unwrap();
        let lines = text.lines().count();
        if lines >= MOST_LINES {
            wrong.push(format!("{}: {lines} lines, fewer than {MOST_LINES} are allowed; split it", file.display()));
        }
        // This file names the banned words.
        let own = file.ends_with("tests/suite/architecture.rs");
        let banned = BANNED.iter().filter(|word| !own && text.contains(**word));
        wrong.extend(banned.map(|word| format!("{}: holds `{word}`", file.display())));
    }
    nothing(wrong);
}
