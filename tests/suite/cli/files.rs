//! Files that commands write are complete or absent, whatever other processes write in the same directory.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use assert_cmd::cargo::CommandCargoExt;

use super::tools::Place;

const QUICK: &str = "run scenarios/pendulum.toml --route differences";

/// Names of the files in a directory of the test, except scenarios.
fn files(place: &Place, directory: &str) -> Vec<String> {
    let entries = fs::read_dir(place.path(directory)).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| name != "scenarios");
    names.sort();
    names
}

/// Symptom: two runs to one path shared `NAME.mcap.partial`, and one run ended with AGREE and a corrupt file.
#[test]
fn regress_runs_to_one_path_do_not_mix() {
    let place = Place::new();
    let runs = [0; 6].map(|_| {
        let mut command = Command::cargo_bin("linkproof").unwrap();
        command.current_dir(place.path("")).args(QUICK.split(' ')).args(["--record", "out"]).spawn().unwrap()
    });
    for run in runs {
        assert!(run.wait_with_output().unwrap().status.success());
    }
    assert_eq!(files(&place, "out"), ["pendulum.foxglove.json", "pendulum.mcap"]);
    let own = place.path("out/pendulum.mcap");
    place.ok(&format!("{QUICK} --record alone"));
    assert_eq!(fs::read(own).unwrap(), fs::read(place.path("alone/pendulum.mcap")).unwrap());
}

/// Symptom: a symbolic link at the path of the partial file was followed, and its target overwritten.
#[test]
fn regress_symlinks_at_temporary_paths_are_not_followed() {
    let place = Place::new();
    fs::create_dir(place.path("out")).unwrap();
    fs::write(place.path("victim"), "mine").unwrap();
    for name in ["pendulum.mcap.partial", ".linkproof-pendulum.partial"] {
        symlink("../victim", place.path("out").join(name)).unwrap();
    }
    place.ok(&format!("{QUICK} --record out"));
    assert_eq!(fs::read_to_string(place.path("victim")).unwrap(), "mine");
    assert_eq!(
        files(&place, "out"),
        [".linkproof-pendulum.partial", "pendulum.foxglove.json", "pendulum.mcap", "pendulum.mcap.partial"]
    );
}

/// If the user names a symbolic link as output, the command writes to the file to which the link points.
/// The permissions of this file stay unchanged.
#[test]
fn a_symlink_given_as_target_is_followed() {
    let place = Place::new();
    fs::write(place.path("real.json"), "old").unwrap();
    fs::set_permissions(place.path("real.json"), PermissionsExt::from_mode(0o640)).unwrap();
    symlink("real.json", place.path("link.json")).unwrap();
    place.ok(&format!("{QUICK} --no-record --json link.json"));
    assert!(fs::symlink_metadata(place.path("link.json")).unwrap().is_symlink());
    assert!(fs::read_to_string(place.path("real.json")).unwrap().starts_with('{'));
    assert_eq!(fs::metadata(place.path("real.json")).unwrap().permissions().mode() & 0o777, 0o640);
}

/// Symptom: on a full disk `--json` and `--csv` left empty files. Instead of a full disk, the test uses a limit on the
/// size of files, at which a write fails in the same way.
#[test]
fn regress_a_full_disk_leaves_the_older_file() {
    let place = Place::new();
    let linkproof = Command::cargo_bin("linkproof").unwrap().get_program().to_owned();
    for (arguments, file) in [
        (format!("{QUICK} --no-record --json results.json"), "results.json"),
        ("solve scenarios/crank_rocker.toml --with assur --csv table.csv".into(), "table.csv"),
        (format!("{QUICK} --record ."), "pendulum.mcap"),
    ] {
        for old in [Some("an older file"), None] {
            match old {
                Some(old) => fs::write(place.path(file), old).unwrap(),
                None => fs::remove_file(place.path(file)).unwrap(),
            }
            let limited = format!("ulimit -f 4; trap '' XFSZ; exec \"$0\" {arguments}");
            let mut command = Command::new("sh");
            command.current_dir(place.path("")).args(["-c", &limited]).arg(&linkproof);
            let output = command.output().unwrap();
            let told = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments}: {told}");
            assert!(
                told.contains(file.trim_end_matches(".mcap")) && told.contains("cannot be written"),
                "{arguments}: {told}"
            );
            assert_eq!(fs::read_to_string(place.path(file)).ok().as_deref(), old, "{arguments}");
        }
        assert_eq!(files(&place, ""), Vec::<String>::new());
    }
    // The command writes to a device; it does not replace the device by a file.
    place.refused(&format!("{QUICK} --no-record --json /dev/full"), &["/dev/full", "cannot be written"]);
    place.ok(&format!("{QUICK} --no-record --json /dev/null"));
}
