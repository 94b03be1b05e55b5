//! Tests of the architecture.
//! The tests check which crate may use which other crate, and which module may use which other module.
//! Files must not depend on each other in a circle.
//! The two analytic sides may share only their common base.
//! The tests also check a few rules that apply to every file.

mod graph;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use graph::Graph;

/// Every crate: name in code, directory, the workspace crates that it may use, and the foreign crates that it may use.
/// The table must match the manifests: a crate that the table allows but no manifest uses is also an error.
const CRATES: &[(&str, &str, &str, &str)] = &[
    ("linkage", "crates/linkage", "", "nalgebra petgraph"),
    ("analytic", "crates/analytic", "linkage", "differential-equations num-integer pulp wide"),
    ("columns", "crates/columns", "formula linkage", ""),
    ("crosschecks", "crates/crosschecks", "", ""),
    (
        "design",
        "crates/design",
        "analytic drawing files formula linkage precise scenario",
        "basin chacha20 cobyla parry2d-f64 quick-xml rand roxmltree toml_edit",
    ),
    (
        "drawing",
        "crates/drawing",
        "linkage",
        "gif image-webp pdf-writer plotters plotters-backend svg tiny-skia ttf-parser",
    ),
    ("files", "crates/files", "linkage", "tempfile"),
    ("fixtures", "crates/fixtures", "linkage scenario", ""),
    ("formula", "crates/formula", "", "winnow"),
    (
        "lab",
        "crates/lab",
        "analytic columns files formula linkage precise prover scenario",
        "chacha20 csv serde serde_json tempfile",
    ),
    ("precise", "crates/precise", "linkage", ""),
    (
        "prover",
        "crates/prover",
        "analytic columns files formula linkage rapier-twin scenario simbody-twin",
        "csv flate2 parquet",
    ),
    (
        "python",
        "crates/python",
        "analytic columns design formula linkage linkproof prover scenario sweep",
        "arrow-array arrow-buffer arrow-schema base64 pyo3 pyo3-arrow",
    ),
    ("rapier_reactions", "crates/rapier-reactions", "", "nalgebra rapier2d rapier2d-f64"),
    ("rapier_twin", "crates/rapier-twin", "linkage rapier-reactions", "parry2d parry2d-f64 rapier2d rapier2d-f64"),
    ("recording", "crates/recording", "drawing files linkage", "mcap prost prost-types"),
    ("scenario", "crates/scenario", "columns files formula linkage", "csv parry2d-f64 strsim toml toml_edit"),
    (
        "sweep",
        "crates/sweep",
        "analytic files formula linkage prover scenario",
        "bytes chacha20 parquet serde serde_json statrs",
    ),
    ("linkproof_simbody", "crates/simbody", "", ""),
    ("simbody_twin", "crates/simbody-twin", "linkage simbody", ""),
    (
        "linkproof",
        "",
        "analytic columns design drawing files formula lab linkage prover recording scenario sweep",
        "annotate-snippets anstream anstyle base64 clap clap_complete clap_mangen comfy-table csv ctrlc include_dir indicatif libtest-mimic quick-xml serde serde_json terminal_size textwrap tiny_http tungstenite",
    ),
];

/// For each top-level module of the crates with internal rules: the modules of the same crate that it may use.
const ROOMS: &[(&str, &str)] = &[
    ("linkage::case", "drive error input math mechanism trajectory"),
    ("linkage::drive", "input math mechanism"),
    ("linkage::engine", "case error math solver threads trajectory"),
    ("linkage::error", "input"),
    ("linkage::input", ""),
    ("linkage::math", ""),
    ("linkage::mechanism", "error input math"),
    ("linkage::solver", "case error math mechanism trajectory"),
    ("linkage::quiet", ""),
    ("linkage::threads", "work"),
    ("linkage::trajectory", "error input"),
    ("linkage::work", "error"),
    ("analytic::assur", "motion"),
    ("analytic::assur_solver", "assur motion reduced"),
    ("analytic::modes", "assur range"),
    ("analytic::motion", ""),
    ("analytic::newton", "motion"),
    ("analytic::range", ""),
    ("analytic::reduced", "assur motion range"),
    ("analytic::steady", "assur assur_solver motion reduced"),
    ("analytic::witness", ""),
    ("design::bearings", ""),
    ("design::clearance", ""),
    ("design::diagram", ""),
    ("design::draw", "clearance diagram plan sensitivity"),
    ("design::drive", ""),
    ("design::exercise", ""),
    ("design::export", "relations rigid"),
    ("design::import", ""),
    ("design::plan", ""),
    ("design::relations", "clearance rigid"),
    ("design::rigid", ""),
    ("design::sensitivity", ""),
    ("design::synthesize", "sensitivity"),
    ("lab::bench", "steps"),
    ("lab::mutate", ""),
    ("lab::outside", "bench"),
    ("lab::specimens", ""),
    ("lab::steps", ""),
    ("lab::stress", "specimens"),
    ("lab::tune", "steps"),
    ("prover::accept", "bounds run"),
    ("prover::bounds", "numbers tolerance"),
    ("prover::check", "numbers"),
    ("prover::compare", "bounds check diagnosis run tables tolerance"),
    ("prover::diagnosis", "bounds"),
    ("prover::engines", ""),
    ("prover::mark", "diagnosis"),
    ("prover::numbers", ""),
    ("prover::run", "bounds check diagnosis engines numbers tolerance"),
    ("prover::tables", ""),
    ("prover::tolerance", ""),
    ("linkproof::check", ""),
    ("linkproof::cli", "check draw graph plain report shipped"),
    ("linkproof::draw", ""),
    ("linkproof::graph", ""),
    ("linkproof::plain", ""),
    ("linkproof::report", "plain"),
    ("linkproof::shipped", ""),
    ("linkproof::testing", "plain"),
];

/// For each module: the parts of other crates that this module must not name, although its crate may use them.
const NEVER: &[(&str, &str)] = &[
    // `prover::bounds` only compares trajectories.
    ("prover::bounds", "analytic rapier_twin simbody_twin linkage::case linkage::mechanism linkage::solver"),
    // Diagnosis solves changed cases with the solver that it receives as an argument.
    ("prover::diagnosis", "analytic rapier_twin simbody_twin linkage::engine"),
    ("prover::tolerance", "analytic rapier_twin simbody_twin linkage"),
    // `prover::run` takes its engines only from the list in `prover::engines`.
    ("prover::run", "rapier_twin simbody_twin"),
    // Reports show results of the analytic crate and of design work, but compute no motion.
    ("linkproof::report", "analytic::assur analytic::assur_solver analytic::motion analytic::newton rapier_twin"),
    ("linkproof::cli", "rapier_twin"),
    // Random mechanisms are made without a solver.
    ("lab::specimens", "analytic prover linkage::solver"),
    // `lab::outside` starts foreign programs, but does not use the solvers of this project.
    ("lab::outside", "analytic prover linkage"),
    // Diagrams and exports accept the states of any solver; the task of a synthesis needs no solver.
    ("design::diagram", "analytic"),
    ("design::export", "analytic"),
    ("design::synthesize::task", "analytic linkage::solver"),
];

/// Names that only some modules may use.
/// A foreign crate is used only in the module that wraps this crate.
/// Only the command line uses the clock and the terminal.
/// Only the modules that read or write files use the file system.
/// Outside `recording`, unordered hash tables are banned, so that no result depends on their order.
const HOMES: &[(&str, &str)] = &[
    ("mcap", "recording"),
    ("foxglove", ""),
    ("prost", "recording"),
    ("prost_types", "recording"),
    ("toml", "scenario"),
    ("toml_edit", "design::synthesize scenario"),
    ("comfy_table", "linkproof::plain linkproof::report"),
    // Only `lab::outside` starts foreign programs.
    // In the command line, `Command` is the command type of clap, and starts no program.
    // `testing` uses only the exit code from `process`.
    ("Command", "linkproof::cli lab::outside"),
    ("process", "linkproof::cli lab::outside linkproof::testing"),
    ("serde", "lab::stress linkproof::report sweep"),
    ("base64", "linkproof::report python::draw"),
    ("strsim", "scenario"),
    ("serde_json", "lab::outside linkproof::report sweep"),
    // `scenario` reads tables of published numbers, `outside` reads tables of peers, and `tables` reads any table.
    // `report` writes tables.
    ("csv", "lab::outside linkproof::report scenario prover::tables"),
    ("parquet", "prover::tables sweep"),
    ("flate2", "prover::tables"),
    ("anstream", "linkproof::cli"),
    ("anstyle", "linkproof::plain"),
    ("clap", "linkproof::cli"),
    ("clap_complete", "linkproof::cli"),
    ("clap_mangen", "linkproof::cli"),
    ("terminal_size", "linkproof::cli"),
    ("textwrap", "linkproof::plain"),
    ("indicatif", "linkproof::cli"),
    // Only the command line uses the network and the clock.
    ("ctrlc", "linkproof::cli"),
    ("tiny_http", "linkproof::cli"),
    ("tungstenite", "linkproof::cli"),
    ("TcpListener", "linkproof::cli"),
    ("TcpStream", "linkproof::cli"),
    ("libtest_mimic", "linkproof::testing"),
    ("annotate_snippets", "linkproof::plain"),
    ("Instant", "linkproof::cli"),
    ("SystemTime", "linkproof::cli"),
    ("stdout", "linkproof::cli"),
    ("stderr", "linkproof::cli"),
    // The command line only writes files; `files`, `outside`, `recording`, `scenario`, `sweep` and `tables` read files.
    ("fs", "linkproof::cli files lab::outside recording scenario sweep prover::tables"),
    ("File", "files lab::outside recording sweep prover::tables"),
    ("OpenOptions", ""),
    ("read_to_string", "files lab::outside scenario"),
    ("read_dir", "files scenario sweep"),
    ("tempfile", "files lab::outside"),
    ("read", "lab::outside recording scenario sweep prover::tables"),
    ("nalgebra", "linkage::math rapier_reactions"),
    ("petgraph", "linkage::mechanism"),
    ("differential_equations", "analytic::motion analytic::reduced"),
    ("num_integer", "analytic::reduced"),
    ("pulp", "analytic::assur"),
    ("basin", "design::synthesize"),
    ("cobyla", "design::synthesize"),
    ("rand", ""),
    ("chacha20", "lab::specimens design::exercise design::sensitivity design::synthesize sweep::design"),
    ("parry2d_f64", "design::clearance design::synthesize rapier_twin::double scenario::clearance"),
    ("svg", "drawing::paper"),
    ("tiny_skia", "drawing::bitmap drawing::paths drawing::pdf"),
    ("ttf_parser", "drawing::paths"),
    ("pdf_writer", "drawing::pdf"),
    ("plotters", "drawing::plot"),
    ("plotters_backend", "drawing::plot"),
    ("gif", "drawing::bitmap"),
    ("image_webp", "drawing::bitmap"),
    ("quick_xml", "design::export linkproof::report"),
    ("roxmltree", "design::import"),
    ("println", ""),
    ("eprintln", ""),
    ("HashMap", "recording"),
    ("HashSet", ""),
];

/// Files and directories of side 1 and side 2.
/// Both sides may use the mechanism, the integrator, and the integrator's interface to the equations of a side.
const SIDES: [&[&str]; 2] = [&["assur", "assur_solver.rs"], &["newton"]];

/// Limit on the number of lines of a file.
/// A file of this length or more is assumed to serve more than one purpose, so it must be split.
const MOST_LINES: usize = 600;

/// Words that no code may contain.
const BANNED: [&str; 4] = ["unsafe", "todo!", "unimplemented!", "dbg!"];

fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All crates: name in code and root file.
fn roots() -> Vec<(&'static str, PathBuf)> {
    CRATES.iter().map(|&(name, directory, ..)| (name, top().join(directory).join("src/lib.rs"))).collect()
}

/// The module of a file, such as `analytic::assur`: its crate and the first module below the crate's root.
fn room(file: &Path) -> String {
    let inside = file.strip_prefix(top()).unwrap_or(file);
    let of = |&&(_, directory, ..): &&(&str, &str, &str, &str)| inside.starts_with(Path::new(directory).join("src"));
    let &(name, directory, ..) = CRATES.iter().find(of).unwrap_or_else(|| panic!("{}: no crate", file.display()));
    let below = inside.strip_prefix(Path::new(directory).join("src")).unwrap();
    let first = below.components().next().unwrap().as_os_str().to_str().unwrap();
    format!("{name}::{}", first.trim_end_matches(".rs"))
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

/// Dependencies between modules: the using module, the used module, and a sentence with the using file and the path.
fn room_edges() -> BTreeMap<(String, String), String> {
    let mut edges = BTreeMap::new();
    for ((from, to), path) in Graph::of(&roots()).edges() {
        let pair = (room(&from), room(&to));
        if pair.0 != pair.1 {
            let told = || format!("{} names `{path}`", from.strip_prefix(top()).unwrap().display());
            edges.entry(pair).or_insert_with(told);
        }
    }
    assert!(edges.len() > 100, "the imports are not found any more");
    edges
}

/// Pairs from a table: each row gives one pair for every word of its second column.
fn pairs(table: &'static [(&str, &str)]) -> impl Iterator<Item = (&'static str, &'static str)> {
    table.iter().flat_map(|(from, all)| all.split_whitespace().map(|to| (*from, to)))
}

/// Fails with all entries of `wrong` in one message; passes if `wrong` is empty.
fn nothing(wrong: Vec<String>) {
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

/// The dependencies of a manifest, without development dependencies.
/// Each dependency has the name of its package, even if the code renames the package.
fn dependencies(manifest: &Path) -> BTreeSet<String> {
    let read = |manifest: &Path| fs::read_to_string(manifest).unwrap().parse::<toml::Table>().unwrap();
    let shared = read(&top().join("Cargo.toml"));
    let package = |name: &String| {
        let renamed = shared["workspace"]["dependencies"].get(name).and_then(|shared| shared.get("package"));
        renamed.and_then(toml::Value::as_str).unwrap_or(name).to_string()
    };
    let all = read(manifest);
    all.get("dependencies").and_then(toml::Value::as_table).into_iter().flat_map(|of| of.keys().map(package)).collect()
}

#[test]
fn manifests_have_exactly_the_dependencies_of_the_table() {
    for (name, directory, own, foreign) in CRATES {
        let package = |own| if own == "linkproof" { String::from(own) } else { format!("linkproof-{own}") };
        let own = own.split_whitespace().map(package);
        let allowed: BTreeSet<String> = own.chain(foreign.split_whitespace().map(String::from)).collect();
        assert_eq!(dependencies(&top().join(directory).join("Cargo.toml")), allowed, "{name}: not what the table says");
    }
    let directories = fs::read_dir(top().join("crates")).unwrap().count();
    assert_eq!(directories + 1, CRATES.len(), "one row a crate");
}

#[test]
fn the_map_has_the_edges_of_the_table() {
    let map = fs::read_to_string(top().join("ARCHITECTURE.md")).unwrap();
    for (_, directory, own, _) in CRATES {
        let name = if directory.is_empty() { "linkproof" } else { directory.trim_start_matches("crates/") };
        let row = map.lines().find(|line| line.starts_with(&format!("| `{name}` |")));
        let row = row.unwrap_or_else(|| panic!("ARCHITECTURE.md has no row for `{name}`"));
        let sees = row.trim_end_matches('|').rsplit('|').next().unwrap();
        let told: BTreeSet<&str> =
            sees.split(['`', ',', ' ']).filter(|word| !word.is_empty() && *word != "-").collect();
        assert_eq!(told, own.split_whitespace().collect(), "ARCHITECTURE.md, `{name}`");
    }
}

/// The file or directory that a name in ARCHITECTURE.md means.
/// The name is a path from the repository's root, or a crate followed by a path inside the crate.
fn of_the_map(name: &str) -> PathBuf {
    match name.split_once('/') {
        Some((own, rest)) if top().join("crates").join(own).is_dir() => {
            top().join("crates").join(own).join("src").join(rest)
        }
        Some(_) | None => top().join(name),
    }
}

/// ARCHITECTURE.md, and the pages that belong to it: name and text.
fn map_pages() -> Vec<(String, String)> {
    let numerics = fs::read_dir(top().join("docs/numerics")).unwrap().map(|page| page.unwrap().path());
    let pages = ["ARCHITECTURE.md", "docs/extending.md"].map(|page| top().join(page)).into_iter().chain(numerics);
    pages.map(|page| (page.display().to_string(), fs::read_to_string(&page).unwrap())).collect()
}

#[test]
fn every_file_named_by_the_map_exists() {
    let mut missing = Vec::new();
    for (page, text) in map_pages() {
        let named = text.split('`').skip(1).step_by(2);
        let files = named.filter(|name| name.contains('/') && (name.ends_with(".rs") || name.ends_with('/')));
        missing.extend(files.filter(|name| !of_the_map(name).exists()).map(|name| format!("{page}: {name}")));
    }
    nothing(missing);
}

#[test]
fn the_map_is_short() {
    assert!(fs::metadata(top().join("ARCHITECTURE.md")).unwrap().len() <= 15_000);
}

/// Every page of docs/numerics is named by a source file.
#[test]
fn every_page_of_numerics_is_named_by_a_file() {
    let files = ["src", "crates"].map(|directory| rust_files(&top().join(directory))).concat();
    let code: Vec<String> = files.iter().map(|file| fs::read_to_string(file).unwrap()).collect();
    for page in fs::read_dir(top().join("docs/numerics")).unwrap() {
        let name = format!("docs/numerics/{}", page.unwrap().file_name().into_string().unwrap());
        assert!(code.iter().any(|text| text.contains(&name)), "no file says: see {name}");
    }
}

#[test]
fn rooms_import_only_what_the_table_allows() {
    let allowed: BTreeSet<(String, String)> =
        pairs(ROOMS).map(|(from, to)| (from.into(), format!("{}::{to}", from.split("::").next().unwrap()))).collect();
    let edges = room_edges();
    let ruled: BTreeSet<&str> = ROOMS.iter().map(|(room, _)| *room).collect();
    let inside = |(from, to): &(String, String)| {
        from.split("::").next() == to.split("::").next() && ruled.contains(from.as_str()) && !to.ends_with("::lib")
    };
    let wrong = edges.iter().filter(|(edge, _)| inside(edge) && !allowed.contains(*edge));
    nothing(wrong.map(|((from, to), told)| format!("`{from}` must not know `{to}`: {told}")).collect());
    let dead = allowed.iter().filter(|edge| !edges.contains_key(*edge));
    nothing(dead.map(|(from, to)| format!("`{from}` does not use `{to}` any more: tighten the table")).collect());
}

#[test]
fn every_room_of_a_ruled_crate_has_a_row() {
    let ruled: BTreeSet<&str> = ROOMS.iter().map(|(room, _)| *room).collect();
    let crates: BTreeSet<&str> = ruled.iter().map(|room| room.split("::").next().unwrap()).collect();
    for (name, directory, ..) in CRATES.iter().filter(|(name, ..)| crates.contains(name)) {
        let files = rust_files(&top().join(directory).join("src"));
        let found: BTreeSet<String> = files.iter().map(|file| room(file)).collect();
        let roots = ["lib", "main", "fixtures", "sentences"].map(|root| format!("{name}::{root}"));
        let found: BTreeSet<&str> = found.iter().filter(|own| !roots.contains(*own)).map(String::as_str).collect();
        let rows: BTreeSet<&str> =
            ruled.iter().copied().filter(|room| room.split("::").next() == Some(*name)).collect();
        assert_eq!(found, rows, "{name}: one row a room");
    }
}

#[test]
fn forbidden_imports_are_absent() {
    let edges = room_edges();
    let mut wrong = Vec::new();
    for (from, to) in pairs(NEVER) {
        let seen = |target: &str| target == to || target.starts_with(&format!("{to}::"));
        let broken = edges.iter().filter(|((own, target), _)| own == from && seen(target));
        wrong.extend(broken.map(|(_, told)| format!("`{from}` must never see `{to}`: {told}")));
    }
    nothing(wrong);
}

/// Files of the analytic crate that both sides use, directly or through other files.
/// If one side uses the other side, the files of the used side count as shared.
fn shared_by_the_sides(root: &Path) -> Vec<String> {
    let mut next: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    for (from, to) in Graph::of(&[("analytic", root.join("lib.rs"))]).edges().into_keys() {
        next.entry(from).or_default().insert(to);
    }
    let reached = |side: &[&str]| {
        let own = |file: &PathBuf| side.iter().any(|part| file.starts_with(root.join(part)));
        let mut open: Vec<PathBuf> = rust_files(root).into_iter().filter(own).collect();
        let mut seen: BTreeSet<PathBuf> = open.iter().cloned().collect();
        while let Some(file) = open.pop() {
            let new = next.get(&file).into_iter().flatten().filter(|to| seen.insert((*to).clone()));
            open.extend(new.cloned().collect::<Vec<_>>());
        }
        seen
    };
    let [first, second] = SIDES.map(reached);
    let short = |file: &PathBuf| file.strip_prefix(root).unwrap().display().to_string();
    first.intersection(&second).map(short).collect()
}

#[test]
fn the_two_sides_share_the_integrator_and_nothing_else() {
    let shared = shared_by_the_sides(&top().join("crates/analytic/src"));
    let motion = ["flow", "free", "inside", "knots", "march", "side", "step"].map(|file| format!("motion/{file}.rs"));
    assert_eq!(shared, motion);
}

#[test]
fn an_additional_import_between_the_sides_is_found() {
    let planted = [
        ("assur/turns.rs", "use crate::newton::NewtonSolver;"),
        ("newton/constraint.rs", "fn borrowed(case: &Case) { let _ = crate::PoseSolver::new(case); }"),
        ("motion/side.rs", "use crate::assur::groups::Misfit;"),
        ("motion/march.rs", "fn borrowed() { println!(\"{:?}\", crate::range::reachable); }"),
    ];
    for (file, line) in planted {
        let copy = copy_of_analytic();
        let root = copy.path().join("crates/analytic/src");
        let before = shared_by_the_sides(&root);
        let text = fs::read_to_string(root.join(file)).unwrap();
        fs::write(root.join(file), format!("{text}\n{line}\n")).unwrap();
        assert!(shared_by_the_sides(&root).len() > before.len(), "{file}: {line}");
    }
}

/// A copy of the sources of the analytic crate in a temporary directory.
fn copy_of_analytic() -> tempfile::TempDir {
    let copy = tempfile::tempdir().unwrap();
    for file in rust_files(&top().join("crates/analytic/src")) {
        let to = copy.path().join(file.strip_prefix(top()).unwrap());
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(&file, to).unwrap();
    }
    copy
}

#[test]
fn no_files_import_each_other_in_a_cycle() {
    let edges = Graph::of(&roots()).edges();
    // Repeatedly removes the files that use no remaining file.
    let mut left: BTreeMap<&PathBuf, BTreeSet<&PathBuf>> = BTreeMap::new();
    for (from, to) in edges.keys() {
        left.entry(from).or_default().insert(to);
        left.entry(to).or_default();
    }
    while let Some(free) = left.iter().find(|(_, all)| all.is_empty()).map(|(file, _)| *file) {
        left.remove(free);
        left.values_mut().for_each(|all| {
            all.remove(free);
        });
    }
    let circle = edges.iter().filter(|((from, to), _)| left.contains_key(from) && left.contains_key(to));
    let told = |((from, to), path): (&(PathBuf, PathBuf), &String)| {
        let short = |file: &PathBuf| file.strip_prefix(top()).unwrap().display().to_string();
        format!("{} -> {} by `{path}`", short(from), short(to))
    };
    nothing(circle.map(told).collect());
}

/// All public type names are unique, so a name is clear without its path.
#[test]
fn public_type_names_are_unique() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (_, root) in roots() {
        for file in rust_files(root.parent().unwrap()) {
            let place = file.strip_prefix(top()).unwrap().display().to_string();
            for item in syn::parse_file(&fs::read_to_string(&file).unwrap()).unwrap().items {
                let (name, seen) = match item {
                    syn::Item::Struct(item) => (item.ident, item.vis),
                    syn::Item::Enum(item) => (item.ident, item.vis),
                    syn::Item::Trait(item) => (item.ident, item.vis),
                    syn::Item::Type(item) => (item.ident, item.vis),
                    _ => continue,
                };
                if matches!(seen, syn::Visibility::Public(_)) {
                    places.entry(name.to_string()).or_default().push(place.clone());
                }
            }
        }
    }
    assert!(places.len() > 300, "{} public types are too few to be all", places.len());
    places.retain(|_, places| places.len() > 1);
    nothing(places.into_iter().map(|(name, places)| format!("`{name}` in {}", places.join(", "))).collect());
}

#[test]
fn no_module_is_a_mod_rs_file() {
    let old = roots().into_iter().flat_map(|(_, root)| rust_files(root.parent().unwrap()));
    nothing(old.filter(|file| file.ends_with("mod.rs")).map(|file| file.display().to_string()).collect());
}

#[test]
fn restricted_dependencies_are_used_only_in_their_rooms() {
    let mut wrong = Vec::new();
    for (file, names) in Graph::of(&roots()).names() {
        let room = room(&file);
        for (name, homes) in HOMES {
            if names.contains(*name)
                && !homes.split_whitespace().any(|home| home == room || room.split("::").next() == Some(home))
            {
                wrong.push(format!("{}: `{name}` is at home in: {homes}", file.display()));
            }
        }
    }
    nothing(wrong);
}

/// Only one file of the repository may contain `unsafe`, and every use in this file needs a reason.
#[test]
fn unsafe_code_is_only_at_the_boundary_to_simbody() {
    let word = BANNED[0];
    let file = top().join("crates/simbody/src/ffi.rs");
    let text = fs::read_to_string(file).unwrap();
    let code = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    let places: usize = code.map(|line| line.matches(&format!("{word} {{")).count()).sum();
    assert!(places > 0, "the boundary is not found any more");
    assert_eq!(places, text.matches("// SAFETY: ").count(), "as many reasons as places");
}

#[test]
fn files_are_short_and_free_of_stopgaps() {
    let mut wrong = Vec::new();
    for directory in ["src", "crates", "tests", "benches", "examples"] {
        for file in rust_files(&top().join(directory)) {
            let text = fs::read_to_string(&file).unwrap();
            let lines = text.lines().count();
            if lines >= MOST_LINES {
                wrong.push(format!("{}: {lines} lines, fewer than {MOST_LINES} are allowed; split it", file.display()));
            }
            // Two files are exempt: this file lists the banned words, and the boundary to Simbody has a separate test.
            let own = file.ends_with("suite/architecture.rs") || file.ends_with("simbody/src/ffi.rs");
            let told = |line: &str| line.trim_start().starts_with("//");
            let code: String = text.lines().filter(|line| !told(line)).collect::<Vec<_>>().join("\n");
            let banned = BANNED.iter().filter(|word| !own && code.contains(**word));
            wrong.extend(banned.map(|word| format!("{}: holds `{word}`", file.display())));
        }
    }
    nothing(wrong);
}
