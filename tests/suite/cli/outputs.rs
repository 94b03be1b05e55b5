//! An output that cannot be written is reported by its name, before the work if possible. No output is left
//! incomplete.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output};
use std::time::Instant;

use assert_cmd::cargo::CommandCargoExt;

use super::tools::Place;

/// Every command with an output: the arguments up to the file name, and the name of the output option.
const FILES: [(&str, &str); 28] = [
    ("run scenarios/pendulum.toml --no-record --json", "--json"),
    ("run scenarios/pendulum.toml --no-record --junit", "--junit"),
    ("run scenarios/pendulum.toml --no-record --markdown", "--markdown"),
    ("check scenarios/crank_rocker.toml phi --channel link.crank.angle_rad --json", "--json"),
    ("solve scenarios/crank_rocker.toml --with assur --csv", "--csv"),
    ("tune scenarios/pendulum.toml --within 1e-2 --engine rapier --json", "--json"),
    ("mutate scenarios/pendulum.toml --no-sizes --kind gravity-sign --json", "--json"),
    ("mutate scenarios/pendulum.toml --no-sizes --kind gravity-sign --markdown", "--markdown"),
    ("inspect scenarios/crank_rocker.toml --json", "--json"),
    ("bearings scenarios/crank_rocker.toml --json", "--json"),
    ("clearance scenarios/crankcase.toml --svg", "--svg"),
    ("clearance scenarios/crankcase.toml --csv", "--csv"),
    ("clearance scenarios/crankcase.toml --json", "--json"),
    ("drive scenarios/crank_rocker.toml --svg", "--svg"),
    ("drive scenarios/crank_rocker.toml --json", "--json"),
    ("drive scenarios/crank_rocker.toml --run-up", "--run-up"),
    ("plan scenarios/crank_rocker.toml --svg", "--svg"),
    ("plan scenarios/crank_rocker.toml --json", "--json"),
    ("diagram scenarios/crank_rocker.toml --channel point.B.x_m --svg", "--svg"),
    ("diagram scenarios/crank_rocker.toml --channel point.B.x_m --csv", "--csv"),
    ("export scenarios/crank_rocker.toml --mjcf", "--mjcf"),
    ("export scenarios/crank_rocker.toml --json", "--json"),
    ("compare scenarios/pendulum.toml scenarios/pendulum.toml --json", "--json"),
    ("compare scenarios/pendulum.toml scenarios/pendulum.toml --junit", "--junit"),
    ("compare scenarios/pendulum.toml scenarios/pendulum.toml --markdown", "--markdown"),
    ("accept --check scenarios/pendulum.toml --json", "--json"),
    ("schema -o", "--output"),
    ("synthesize slider-crank --stroke-mm 100 --rod-mm 200 --json", "--json"),
];

/// Names of the entries in the directory of the test, without the scenarios.
fn left(place: &Place) -> Vec<String> {
    let names = fs::read_dir(place.path("")).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| name != "scenarios").collect();
    names.sort();
    names
}

#[test]
fn unwritable_outputs_are_found_before_the_work() {
    let place = Place::new();
    fs::create_dir(place.path("taken")).unwrap();
    fs::write(place.path("file"), "old").unwrap();
    for (command, option) in FILES {
        for (target, words) in [
            ("no/such/out", "the directory no/such does not exist"),
            ("taken", "this is a directory"),
            ("file/below", "directory"),
            ("new/", "this is a directory"),
        ] {
            let outcome = place.refused(&format!("{command} {target}"), &[option, words]);
            assert_eq!(outcome.stdout, "", "{command} {target}");
        }
    }
    place.refused(
        "synthesize slider-crank --stroke-mm 100 --rod-mm 200 -o no/such.toml",
        &["--output", "the directory no does not exist;"],
    );
    for command in ["run scenarios/pendulum.toml --record", "bench scenarios/pendulum.toml --out", "stress speed --out"]
    {
        let outcome = place.refused(&format!("{command} file/below"), &["; expected a directory"]);
        assert_eq!(outcome.stdout, "", "{command}");
    }
    assert_eq!(left(&place), ["file", "taken"]);
    assert_eq!(fs::read_to_string(place.path("file")).unwrap(), "old");
}

#[test]
fn no_output_overwrites_another_output_or_an_input() {
    let place = Place::new();
    fs::write(place.path("mine.csv"), "t_s,link.crank.angle_deg\n0,0\n").unwrap();
    for (command, words) in [
        ("run scenarios/pendulum.toml --no-record --json out --junit ./out", "two results go to out"),
        ("run scenarios/pendulum.toml --no-record --markdown out --html out", "two results go to out"),
        ("run scenarios/pendulum.toml --no-record --json - --markdown -", "two results go to -"),
        ("compare scenarios/crank_rocker.toml mine.csv --json mine.csv", "--output and B both name mine.csv"),
        ("mutate scenarios/pendulum.toml --json out --markdown out", "two results go to out"),
        ("export scenarios/crank_rocker.toml --json out --mjcf out", "two results go to out"),
        ("synthesize search synthesis/straight_line.toml --svg out --json out", "two results go to out"),
    ] {
        let outcome = place.refused(command, &[words, "two files"]);
        assert_eq!(outcome.stdout, "", "{command}");
    }
    assert_eq!(left(&place), ["mine.csv"]);
    assert!(fs::read_to_string(place.path("mine.csv")).unwrap().starts_with("t_s"));
    // Two outputs may both go to the null device.
    place.ok("run scenarios/pendulum.toml --no-record --json /dev/null --junit /dev/null");
}

/// If an output directory is read-only, a proof ends before its long computation and changes no file.
#[test]
fn a_read_only_directory_is_found_at_once() {
    let place = Place::new();
    let locked = place.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    if fs::write(locked.join("probe"), "").is_ok() {
        eprintln!("skipped: this user may write to every directory");
        return;
    }
    let since = Instant::now();
    place.refused("run scenarios/ov7_base.toml --no-record --json locked/out.json", &["--json", "Permission denied"]);
    place.refused("run scenarios/ov7_base.toml --record locked/own", &["--record", "Permission denied"]);
    assert!(since.elapsed().as_secs() < 5, "{:?}", since.elapsed());
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).unwrap();
}

/// The command first tests whether an existing output file can be written. This leaves the file unchanged.
#[test]
fn an_older_file_survives_a_bad_scenario() {
    let place = Place::new();
    fs::write(place.path("out.json"), "old").unwrap();
    place.refused("solve nothing.toml --with assur --csv out.json", &["nothing.toml cannot be read"]);
    assert_eq!(fs::read_to_string(place.path("out.json")).unwrap(), "old");
}

/// Runs `linkproof` in a shell: `$0` is the command, and the shell commands `prepare` precede it.
fn in_shell(place: &Place, prepare: &str, arguments: &str) -> Output {
    let linkproof = Command::cargo_bin("linkproof").unwrap().get_program().to_owned();
    let script = format!("{prepare} exec \"$0\" {arguments}");
    Command::new("sh").current_dir(place.path("")).args(["-c", &script]).arg(linkproof).output().unwrap()
}

/// Instead of a full disk, the test uses a limit on the size of files, at which a write fails in the same way. Unlike a
/// full disk, the limit needs no special permissions.
#[test]
fn no_output_is_left_half_written() {
    let place = Place::new();
    for (index, (command, _)) in FILES.into_iter().enumerate() {
        // Every second command replaces an older file; the remaining commands create a new file.
        // One of these two cases is enough for each command, because all outputs are written by the same method.
        let old = index.is_multiple_of(2).then_some("an older file");
        if let Some(old) = old {
            fs::write(place.path("out"), old).unwrap();
        }
        let output = in_shell(&place, "ulimit -f 0; trap '' XFSZ;", &format!("{command} out"));
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command}: {told}");
        assert!(told.contains("out cannot be written: a file of this size is not allowed"), "{command}: {told}");
        assert!(told.contains("raise the limit"), "{command}: {told}");
        assert_eq!(fs::read_to_string(place.path("out")).ok().as_deref(), old, "{command}");
        let _ = fs::remove_file(place.path("out"));
        assert_eq!(left(&place), Vec::<String>::new(), "{command}");
    }
}

#[test]
fn a_full_device_is_reported_as_such() {
    let place = Place::new();
    for command in ["solve scenarios/crank_rocker.toml --with assur --csv", "plan scenarios/crank_rocker.toml --svg"] {
        place.refused(
            &format!("{command} /dev/full"),
            &["/dev/full cannot be written: no space is left on the device", "free space there"],
        );
        let output = in_shell(&place, "exec > /dev/full;", &format!("{command} -"));
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command}: {told}");
        let words = "standard output cannot be written: no space is left on the device";
        assert!(told.contains(words), "{command}: {told}");
    }
}

/// The outputs go to a file system of 16 kB.
/// The test is skipped if the kernel does not let the user mount this file system.
#[test]
fn a_full_disk_leaves_no_file() {
    let place = Place::new();
    fs::create_dir(place.path("small")).unwrap();
    let own = "mount -t tmpfs -o size=16k none small";
    let is_possible = Command::new("unshare").current_dir(place.path("")).args(["-rm", "sh", "-c", own]).status();
    if !is_possible.is_ok_and(|status| status.success()) {
        eprintln!("skipped: no file system can be mounted here");
        return;
    }
    let linkproof = Command::cargo_bin("linkproof").unwrap().get_program().to_owned();
    for (arguments, needs) in [
        ("solve scenarios/crank_rocker.toml --with assur --csv small/out", ""),
        ("run scenarios/pendulum.toml --route differences --record small", ""),
        ("run scenarios/pendulum.toml --route differences --no-record --json small/out", "kB are needed"),
        ("plan scenarios/ov7_base.toml --svg small/out", "kB are needed"),
    ] {
        let script = format!("{own}; \"$0\" {arguments}; code=$?; ls -A small; exit $code");
        let mut command = Command::new("unshare");
        let output =
            command.current_dir(place.path("")).args(["-rm", "sh", "-c", &script]).arg(&linkproof).output().unwrap();
        let (told, listed) = (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
        assert_eq!(output.status.code(), Some(2), "{arguments}: {told}");
        assert!(told.contains("no space is left on the device") && told.contains(needs), "{arguments}: {told}");
        assert!(
            !listed.lines().any(|line| line.ends_with("out") || line.ends_with(".mcap") || line.ends_with(".partial")),
            "{listed}"
        );
    }
}
