//! `-` in place of a scenario file.

use std::fs;

use assert_cmd::Command;

use super::tools::{Outcome, Place};

fn fed(place: &Place, arguments: &str, input: &[u8]) -> Outcome {
    let mut command = Command::cargo_bin("linkproof").unwrap();
    let output =
        command.current_dir(place.path("")).args(arguments.split_whitespace()).write_stdin(input).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Outcome { code: output.status.code().unwrap(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

#[test]
fn every_command_reads_standard_input_as_a_file() {
    let place = Place::new();
    for (command, scenario) in [
        ("run FILE --no-record", "pendulum"),
        ("check FILE 90 --channel link.crank.angle_deg --error 1000", "crank_rocker"),
        ("solve FILE --with assur", "crank_rocker"),
        ("inspect FILE", "crank_rocker"),
        ("inspect FILE --modes --json -", "fourth_class"),
        ("bearings FILE", "crank_rocker"),
        ("clearance FILE", "crankcase"),
        ("drive FILE", "crank_rocker"),
        ("plan FILE", "crank_rocker"),
        ("diagram FILE --channel point.B.x_m", "crank_rocker"),
        ("export FILE --json -", "crank_rocker"),
        ("list --channels FILE", "crank_rocker"),
    ] {
        let file = format!("scenarios/{scenario}.toml");
        let from_file = place.run(&command.replace("FILE", &file));
        // With `-`, tables of published numbers are searched for in the working directory instead of the directory of
        // the file.
        let text = fs::read_to_string(place.path(&file)).unwrap().replace("file = \"", "file = \"scenarios/");
        let fed = fed(&place, &command.replace("FILE", "-"), text.as_bytes());
        assert_eq!((fed.code, fed.stderr.as_str()), (from_file.code, from_file.stderr.as_str()), "{command}");
        assert_eq!(fed.stdout, from_file.stdout, "{command}");
    }
}

#[test]
fn errors_name_standard_input() {
    let place = Place::new();
    let text = fs::read_to_string(place.path("scenarios/pendulum.toml")).unwrap();
    for (input, words) in [
        (text.replace("title =", "titel =").into_bytes(), ["--> <standard input>:", "did you mean `title`"]),
        (Vec::new(), ["the file contains no scenario", "<standard input>"]),
        (b"\xff\xfea\0".to_vec(), ["<standard input> cannot be read: it is written in UTF-16", "iconv"]),
    ] {
        let outcome = fed(&place, "run - --no-record --json out.json", &input);
        assert_eq!(outcome.code, 2);
        assert!(words.iter().all(|word| outcome.stderr.contains(word)), "{}", outcome.stderr);
        assert!(fs::read_to_string(place.path("out.json")).unwrap().contains("\"scenario\": \"<standard input>\""));
    }
}

#[test]
fn settings_are_not_written_to_standard_input() {
    let place = Place::new();
    let text = fs::read(place.path("scenarios/pendulum.toml")).unwrap();
    for command in ["run - --no-record --write", "tune - --within 1e-2 --write"] {
        let outcome = fed(&place, command, &text);
        assert_eq!((outcome.code, outcome.stdout.as_str()), (2, ""), "{command}");
        assert!(
            ["--write", "<standard input>", "help: save the scenario"].iter().all(|word| outcome.stderr.contains(word))
        );
    }
    assert!(!place.path("-").exists());
}

/// Settings found for changed parameters, another mode or another start are not valid for the mechanism in the file.
/// The option `--write` therefore cannot be combined with options that change parameters, mode or start.
#[test]
fn settings_found_for_other_numbers_are_not_written() {
    let place = Place::new();
    let before = fs::read(place.path("scenarios/pendulum.toml")).unwrap();
    for other in ["--set a_mm=30", "--mode coupler,rocker=left", "--start-crank-deg 30"] {
        let outcome = place.run(&format!("run scenarios/pendulum.toml --no-record --write {other}"));
        assert_eq!(outcome.code, 2, "{other}: {}", outcome.stdout);
        assert!(
            outcome.stderr.contains("--write") && outcome.stderr.contains("cannot be used with"),
            "{}",
            outcome.stderr
        );
    }
    assert_eq!(fs::read(place.path("scenarios/pendulum.toml")).unwrap(), before);
}

#[test]
fn the_channels_of_a_scenario_are_listed() {
    let place = Place::new();
    let text = place.ok("list --channels scenarios/crank_rocker.toml");
    let solved = place.ok("solve scenarios/crank_rocker.toml --with assur --times 0");
    // The list of channels contains every channel that a solution has as a column, and no further channel.
    let names = text.lines().take_while(|line| !line.is_empty());
    let names: Vec<&str> = names.filter_map(|line| line.split_whitespace().next()).collect();
    let columns: Vec<&str> = solved.lines().next().unwrap().split(',').skip(2).collect();
    assert_eq!(names, columns);
    for words in [
        "rad      angle of link rocker",
        "reaction in A, crank on coupler, along world y",
        "mass centre velocity of link coupler, along world x",
        "balancing moment on link crank",
        "stage \"velocities\"",
    ] {
        assert!(text.contains(words), "`{words}` is not in:\n{text}");
    }
    place.refused("list --channels nothing.toml", &["nothing.toml cannot be read"]);
}
