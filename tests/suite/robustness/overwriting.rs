//! Commands replace only files that the user named, or that this program wrote.
//! The test runs every command that chooses a file name, with various files of the user at the chosen path.
#![cfg(unix)]

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::cli::tools::{Outcome, Place, listed};

/// Reaction of a command to a file of the user at its output path.
#[derive(Clone, Copy, PartialEq)]
enum Then {
    /// The command writes nothing to the path, and reports the file with exit code 2.
    Refuses,
    /// The command keeps the file, continues, and reports the file.
    Keeps,
}

/// A command, the file whose name it chooses, and its reaction to a file of the user at that path.
/// The last field states whether the file has a seal.
/// With a seal, the command notices that its own output was edited, and treats the edited file as a file of the user.
type Writer = (&'static str, &'static str, Then, bool);

const GOLDEN: &str = "golden double_pendulum -o out";
const BENCH: &str = "bench scenarios/five_bar.toml --out out --quick --engine rapier --only positions --budget 1e4";
const STRESS: &str = "stress turns --quick --out out --page page.md";
const EXERCISE: &str = "exercise scenarios/crank_rocker.toml --ask link.rocker.omega_rad_s --positions 1 --output out";
const RUN: &str = "run scenarios/pendulum.toml --route differences";

const SWEEP: &str = "sweep scenarios/crank_rocker.toml --vary links.crank.mass_kg=1:2:3 --figure max:joint.A.fx_N";

/// The import of a four-bar from a web address of PMKS+.
const LINK: &str = concat!(
    "import ?00.VG.K,0.101.6A,A,0,0,0.0B,B,ku,VG,0.0C,C,2SG,1jO,0.4D,D,2xW,0,0..YRAB,AB,4uW,7q,NS,Fe,c5cae9,A,B,,.",
    "YRBC,BC,EfW,ku,1ba,16K,c5cae9,B,C,,.YRCD,CD,CDG,VG,2hu,si,c5cae9,C,D,,...N_q"
);

const WRITERS: [Writer; 32] = [
    ("run scenarios/pendulum.toml --route differences", "recordings/pendulum.mcap", Then::Keeps, false),
    ("run scenarios/pendulum.toml --route differences", "recordings/pendulum.foxglove.json", Then::Keeps, true),
    (
        "run scenarios/pendulum.toml --route differences --no-record --html out/",
        "out/pendulum.html",
        Then::Refuses,
        true,
    ),
    ("draw scenarios/pendulum.toml", "pendulum.svg", Then::Refuses, true),
    ("export scenarios/pendulum.toml", "pendulum.xml", Then::Refuses, true),
    ("export scenarios/pendulum.toml --json", "pendulum.json", Then::Refuses, true),
    (GOLDEN, "out/README.md", Then::Refuses, true),
    (GOLDEN, "out/double_pendulum/truth.parquet", Then::Refuses, true),
    (BENCH, "out/bench.json", Then::Refuses, true),
    (BENCH, "out/five_bar.csv", Then::Refuses, true),
    (BENCH, "out/five_bar.time.svg", Then::Refuses, true),
    (BENCH, "out/five_bar.solutions.svg", Then::Refuses, true),
    (BENCH, "out/five_bar.inner.svg", Then::Refuses, true),
    (STRESS, "out/turns.json", Then::Refuses, false),
    (STRESS, "out/turns.csv", Then::Refuses, false),
    (STRESS, "out/turns.svg", Then::Refuses, true),
    (STRESS, "out/report.txt", Then::Refuses, true),
    (STRESS, "page/turns.svg", Then::Refuses, true),
    (EXERCISE, "out/key.json", Then::Refuses, true),
    (EXERCISE, "out/tasks/crank_rocker.html", Then::Refuses, true),
    (EXERCISE, "out/scenarios/crank_rocker.toml", Then::Refuses, true),
    ("mark class -o out/", "out/crank_rocker.html", Then::Refuses, true),
    (
        "sweep scenarios/crank_rocker.toml --vary links.crank.mass_kg=1:2:3 --figure max:joint.A.fx_N -o out",
        "out/cases.parquet",
        Then::Refuses,
        false,
    ),
    ("merge shard -o out", "out/cases.parquet", Then::Refuses, false),
    ("view seen/pendulum.mcap --with foxglove", "seen/pendulum.foxglove.json", Then::Refuses, true),
    ("view seen/pendulum.mcap --with plotjuggler", "seen/pendulum.plotjuggler.xml", Then::Refuses, true),
    ("view seen/pendulum.mcap --python ./rerun", "seen/pendulum.rrd", Then::Refuses, false),
    ("accept scenarios/pendulum.toml --route differences", "scenarios/pendulum.accepted", Then::Refuses, false),
    ("new four-bar", "four_bar.toml", Then::Refuses, false),
    ("new --shipped out", "out/catalogues/motors.toml", Then::Refuses, false),
    (LINK, "pmks.toml", Then::Refuses, false),
    ("man -o out", "out/linkproof-run.1", Then::Refuses, true),
];

/// Commands that write no file, or only files that the caller names.
const NAMED: [&str; 20] = [
    "bearings",
    "check",
    "clearance",
    "compare",
    "completions",
    "diagram",
    "docs",
    "drive",
    "graph",
    "help",
    "inspect",
    "list",
    "mutate",
    "plan",
    "schema",
    "sensitivity",
    "solve",
    "synthesize",
    "tune",
    "watch",
];

/// A directory in which all tested commands can run.
fn place() -> Place {
    let place = Place::new();
    place.ok(&format!("{RUN} --record seen"));
    fs::remove_file(place.path("seen/pendulum.foxglove.json")).unwrap();
    place.ok(&format!("{SWEEP} --shard 1/1 -o shard"));
    // Answers of a class of students with only one exercise sheet; the only answer is right.
    place.ok(&EXERCISE.replace("output out", "output class"));
    let answers = fs::read_to_string(place.path("class/teacher/answers.csv")).unwrap();
    let cells: Vec<&str> = answers.lines().last().unwrap().split(',').collect();
    let answer = format!("crank_deg,link.rocker.omega_rad_s\n{},{}\n", cells[1], cells[4]);
    fs::write(place.path("class/answers/crank_rocker.csv"), answer).unwrap();
    // Stand-ins for Rerun's library and viewer that do only what `linkproof` needs.
    let script = "#!/bin/sh\nif [ \"$1\" = -m ]; then exit 0; fi\nprintf 'RRF2 linkproof pendulum' > \"$3\"\n";
    fs::write(place.path("rerun"), script).unwrap();
    fs::set_permissions(place.path("rerun"), fs::Permissions::from_mode(0o755)).unwrap();
    place
}

/// Runs a command whose output path is already occupied; `what` describes what is there.
/// Asserts that the command reports the occupied path, and checks the exit code.
fn meets(place: &Place, (command, file, then, _): Writer, what: &str) -> Outcome {
    let outcome = place.run(command);
    let told = format!("{}{}", outcome.stdout, outcome.stderr);
    let name = Path::new(file).file_name().unwrap().to_str().unwrap();
    assert!(told.contains(name), "{command}: {what} at {file} is not reported: {told}");
    match then {
        Then::Refuses => assert_eq!(outcome.code, 2, "{command}: {what} at {file}: {told}"),
        Then::Keeps => {
            let is_kept = if file.ends_with(".mcap") { "is kept: " } else { "it is not overwritten;" };
            assert!(outcome.code == 0 && told.contains(is_kept), "{command}: {what} at {file}: {told}");
        }
    }
    outcome
}

#[test]
fn foreign_files_are_replaced_only_if_named() {
    let mut seen = BTreeSet::new();
    for writer @ (command, file, _, is_sealed) in WRITERS {
        let place = place();
        let at = place.path(file);
        let remove = || fs::remove_file(&at).unwrap();
        let no_more = |what: &str| {
            let left: Vec<_> =
                fs::read_dir(at.parent().unwrap()).unwrap().map(|own| own.unwrap().file_name()).collect();
            let partial = left.iter().find(|name| name.to_string_lossy().ends_with(".partial"));
            assert!(partial.is_none(), "{command}: {what} leaves {partial:?}");
        };
        fs::create_dir_all(at.parent().unwrap()).unwrap();
        // A file of the user.
        fs::write(&at, "mine").unwrap();
        meets(&place, writer, "a file of the user's");
        assert_eq!(fs::read_to_string(&at).unwrap(), "mine", "{command}: {file}");
        remove();
        // The path is a symbolic link to a file of the user.
        fs::write(place.path("precious"), "mine").unwrap();
        symlink(place.path("precious"), &at).unwrap();
        meets(&place, writer, "a link");
        assert_eq!(fs::read_to_string(place.path("precious")).unwrap(), "mine", "{command}: {file}");
        assert!(fs::symlink_metadata(&at).unwrap().is_symlink(), "{command}: {file}");
        remove();
        // A symbolic link whose target does not exist.
        symlink(place.path("elsewhere"), &at).unwrap();
        meets(&place, writer, "a link to nothing");
        assert!(!place.path("elsewhere").exists(), "{command}: {file}");
        assert!(fs::symlink_metadata(&at).unwrap().is_symlink(), "{command}: {file}");
        remove();
        // A pipe without a reader.
        assert!(Command::new("mkfifo").arg(&at).status().unwrap().success());
        meets(&place, writer, "a pipe");
        remove();
        no_more("what was refused");
        // Before the first run, nothing is at the output path. Before the second run, the output of the first run is
        // there.
        let first = place.run(command);
        assert_eq!(first.code, 0, "{command}: {}", first.stderr);
        let own = fs::read(&at).unwrap();
        match command.starts_with("new") || command.starts_with("import") {
            // `new` and `import` do not replace even a file that they wrote before.
            true => drop(meets(&place, writer, "its output")),
            false => assert_eq!(place.run(command).code, 0, "{command}: {file}"),
        }
        if is_sealed {
            // The command's own output, edited by the user.
            let edited = [&own[..], b" "].concat();
            fs::write(&at, &edited).unwrap();
            meets(&place, writer, "an edited file");
            assert_eq!(fs::read(&at).unwrap(), edited, "{command}: {file}");
        }
        no_more("a run");
        seen.insert(command.split(' ').next().unwrap());
    }
    // No command is forgotten.
    let help = Place::empty().ok("--help");
    for command in listed(&help) {
        assert!(
            seen.contains(command) || NAMED.contains(&command),
            "this test does not cover the files that {command} writes"
        );
    }
}

/// Output of an earlier run is replaced, even if the new output differs.
#[test]
fn an_older_output_is_replaced_by_a_new_one() {
    let place = place();
    let (page, film) = (format!("{RUN} --no-record --html out/"), format!("{RUN} --record seen"));
    for command in [&page, &film] {
        place.ok(command);
    }
    let files = ["out/pendulum.html", "seen/pendulum.mcap", "seen/pendulum.foxglove.json"];
    let old = files.map(|file| fs::read(place.path(file)).unwrap());
    place.ok(&format!("{page} --only positions"));
    place.ok(&format!("{film} --record-forces --slow 3"));
    for (file, old) in files.iter().zip(old) {
        assert_ne!(fs::read(place.path(file)).unwrap(), old, "{file}");
    }
}

/// Symptom: a dangling symbolic link was replaced, and a file appeared at a path that the user had not named.
/// If the user names a symbolic link, the command writes to the target of the link, as most programs do.
#[test]
fn a_named_symlink_is_followed_even_to_a_missing_file() {
    for (command, file) in [
        ("run scenarios/pendulum.toml --route differences --no-record --json FILE", "own.json"),
        ("run scenarios/pendulum.toml --route differences --no-record --html FILE", "own.html"),
        ("solve scenarios/pendulum.toml --with assur --csv FILE", "own.csv"),
        ("draw scenarios/pendulum.toml -o FILE", "own.svg"),
        ("export scenarios/pendulum.toml --mjcf FILE", "own.xml"),
        ("view seen/pendulum.mcap --with foxglove -o FILE", "own.json"),
        ("schema -o FILE", "own.json"),
    ] {
        let place = place();
        let command = command.replace("FILE", file);
        fs::create_dir(place.path("there")).unwrap();
        symlink("second", place.path(file)).unwrap();
        symlink("there/real", place.path("second")).unwrap();
        for old in [None, Some("an older file")] {
            if let Some(old) = old {
                fs::write(place.path("there/real"), old).unwrap();
            }
            place.ok(&command);
            let written = fs::read_to_string(place.path("there/real")).unwrap();
            assert!(!written.is_empty() && written != "an older file", "{command}");
            assert!(fs::symlink_metadata(place.path(file)).unwrap().is_symlink(), "{command}");
        }
        // Symbolic links that form a cycle.
        fs::remove_file(place.path("second")).unwrap();
        symlink(file, place.path("second")).unwrap();
        place.refused(&command, &["links"]);
    }
}

/// Symptom: a user's file `.linkproof-notes.partial` was deleted as if it came from a killed run.
#[test]
fn a_user_file_named_like_a_temporary_file_is_kept() {
    let place = place();
    for name in [".linkproof-notes.partial", ".linkproof-0123456789abcdef-01234567.partial"] {
        fs::write(place.path(name), "mine").unwrap();
    }
    place.ok(&format!("{RUN} --no-record --json out.json"));
    for name in [".linkproof-notes.partial", ".linkproof-0123456789abcdef-01234567.partial"] {
        assert_eq!(fs::read_to_string(place.path(name)).unwrap(), "mine");
    }
}

/// Files are written only through one common function, which obeys the overwriting rule.
/// The only exceptions are the files given to peers and viewers.
#[test]
fn files_are_written_only_through_the_common_function() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path().join("src"));
    let mut open: Vec<PathBuf> = crates.chain([root.join("src")]).collect();
    let mut found = BTreeSet::new();
    while let Some(directory) = open.pop() {
        for entry in fs::read_dir(directory).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
                continue;
            }
            if path.extension().is_none_or(|extension| extension != "rs") {
                continue;
            }
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            let writes = ["fs::write(", "File::create", "OpenOptions", "File::options", "fs::copy(", "fs::rename("];
            if writes.iter().any(|call| code.contains(call)) && !path.ends_with("tests.rs") {
                found.insert(path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/"));
            }
        }
    }
    // Files for peers and viewers are in directories created for them, so the code that writes these files is exempt.
    let made = ["peer", "process", "viewer"].map(|file| format!("crates/lab/src/outside/{file}.rs"));
    let known = made.into_iter().chain(["crates/files/src/lib.rs".into()]).collect();
    assert_eq!(found, known);
}
