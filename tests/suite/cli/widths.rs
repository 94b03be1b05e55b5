//! Every command on every shipped file at 80 columns: no line is wider than 80 columns.

use std::fs;
use std::thread;

use assert_cmd::Command;

use super::tools::{Place, listed};

/// Columns of the terminal.
const COLUMNS: usize = 80;

/// Runs a command at 80 columns and checks the width of both streams.
/// Lines that a message quotes from a file are not broken, so these lines may be wider.
fn assert_fits(place: &Place, arguments: &str) {
    let mut command = Command::cargo_bin("linkproof").unwrap();
    let command = command.current_dir(place.path("")).env("COLUMNS", "80").args(arguments.split_whitespace());
    let output = command.output().unwrap();
    for bytes in [output.stdout, output.stderr] {
        for line in String::from_utf8(bytes).unwrap().lines() {
            let quotes = line.trim_start().starts_with(|sign: char| sign.is_ascii_digit() || sign == '|');
            let is_quoted = quotes && line.contains(" | ") || line.trim_start().starts_with("--> ");
            assert!(line.chars().count() <= COLUMNS || is_quoted, "{arguments}: {line}");
        }
    }
}

#[test]
fn every_command_on_every_shipped_file_fits_80_columns() {
    const ON_FILES: [&str; 11] = [
        "inspect",
        "inspect --driver all",
        "inspect --modes",
        "inspect --range",
        "plan",
        "plan --centres --turned --scale crank",
        "bearings",
        "drive --table",
        "list --channels",
        "check --verbose",
        "clearance",
    ];
    let place = Place::new();
    let in_folder = |folder: &'static str| {
        let names = fs::read_dir(place.path(folder)).unwrap().map(|entry| entry.unwrap().file_name());
        names.map(move |name| format!("{folder}/{}", name.to_str().unwrap()))
    };
    let all = ["scenarios", "scenarios/formulas"].into_iter().flat_map(in_folder);
    let mut files: Vec<String> = all.filter(|name| name.ends_with(".toml")).collect();
    files.sort();
    assert!(files.len() > 40, "{files:?}");
    let halves = files.chunks(files.len().div_ceil(2));
    thread::scope(|scope| {
        for half in halves {
            let place = &place;
            scope.spawn(move || {
                for (file, command) in half.iter().flat_map(|file| ON_FILES.map(|command| (file, command))) {
                    assert_fits(place, &format!("{command} {file}"));
                }
            });
        }
    });
    let files = files.join(" ");
    assert_fits(&place, &format!("run --no-record --verbose --explain {files}"));
    // With so little work, most verdicts are inconclusive. `terminal.rs` tests short reports with other verdicts.
    assert_fits(&place, &format!("run --no-record --budget 1 {files}"));
}

#[test]
fn lists_helps_and_the_other_commands_fit_80_columns() {
    let place = Place::new();
    let help = place.ok("--help");
    let names: Vec<&str> = listed(&help).collect();
    assert!(names.len() > 20 && names.contains(&"stress"), "{names:?}");
    for name in names {
        assert_fits(&place, &format!("{name} --help"));
    }
    for command in [
        "--help",
        "new",
        "list",
        "list --channels",
        "list --solvers",
        "docs",
        "mutate --list",
        "tune scenarios/crank_rocker.toml --within 1e-3",
        "diagram scenarios/crank_rocker.toml --channel point.B.x_m",
        "drive scenarios/crank_rocker.toml --non-uniformity 0.02",
        "synthesize slider-crank --stroke-mm 100 --offset-mm 30 --time-ratio 1.2",
        "synthesize crank-rocker --pivot-mm 150,15 --rocker-mm 250 --extreme-deg 50 --swing-deg 32",
        "synthesize motion --pose 0,0,0 --pose 40,25,15 --pose 80,30,35 --pose 115,20,60",
        "synthesize check scenarios/ov7_drives/sinker_task.toml scenarios/ov7_drives/sinker.toml",
        "synthesize check scenarios/ov7_drives/eyelet_needle_task.toml scenarios/ov7_base.toml scenarios/ov7_new.toml scenarios/ov7_drives/eyelet_needle_found.toml",
        "synthesize cyclogram scenarios/ov7_drives/machine.toml",
        "synthesize search scenarios/synthesis/path_task.toml --candidates 300 --refined 1",
        "synthesize front scenarios/synthesis/path_task.toml --limit transmission_deg=10:20:2 --candidates 300 --refined 1",
        "mutate scenarios/crank_rocker.toml --no-sizes --kind mass-heaviest",
        "stress speed --quick -o stress",
        "bench scenarios/five_bar.toml --quick --only positions -o bench",
        "accept scenarios/crank_rocker.toml",
        "compare scenarios/crank_rocker.toml scenarios/crank_rocker.toml",
        "run scenarios/crank_rocker.toml --dt 2e-2",
        "run nothing.toml",
        "run scenarios/crank_rocker.toml --no-such-option",
        "solve scenarios/crank_rocker.toml --only nothing",
    ] {
        assert_fits(&place, command);
    }
}
