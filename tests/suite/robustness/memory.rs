//! Memory of long runs is estimated in advance.
//! The estimate and the measured value differ by at most a factor of two.
#![cfg(target_os = "linux")]

use std::process::{Command, Stdio};
use std::time::Duration;

use assert_cmd::cargo::CommandCargoExt;
use linkage::case::{Grid, Wanted};
use linkage::trajectory::Stage;
use linkproof::{Options, prove};
use prover::run::memory;

use crate::common::{by_night, shipped};

/// Peak memory (bytes) of a command, which must succeed.
/// The memory is measured every few milliseconds.
fn peak(arguments: &[&str]) -> f64 {
    let mut command = Command::cargo_bin("linkproof").unwrap();
    command.args(arguments).stdout(Stdio::null()).current_dir(env!("CARGO_MANIFEST_DIR"));
    let mut child = command.spawn().unwrap();
    let mut most = 0.0f64;
    let outcome = loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.trim().parse::<f64>().ok());
        most = kilobytes.map_or(most, |kilobytes| kilobytes * 1024.0);
        if let Some(outcome) = child.try_wait().unwrap() {
            break outcome;
        }
        std::thread::sleep(Duration::from_millis(3));
    };
    assert!(outcome.code().is_some_and(|code| code != 2), "{arguments:?}: {outcome}");
    most
}

/// The test measures a proof and a table of the solution with all channels, in prescribed and in free motion.
/// The estimate for positions alone must be about half of the estimate for all channels, or less.
/// If `LINKPROOF_DRAWS` is above 1, the test adds a larger mechanism.
#[test]
fn a_run_uses_the_estimated_memory() {
    let every = "--crank-deg=0:360:0.0144";
    let runs = [("crank_rocker", every), ("crank_rocker_runup", "--times=0:0.5:0.00002"), ("ov7_base", every)];
    for (name, grid) in &runs[..if by_night() { 3 } else { 2 }] {
        let file = format!("scenarios/{name}.toml");
        let scenario = shipped(&format!("{name}.toml"));
        let case =
            scenario.case.on(Grid::of_times(scenario.case.crank(), (0..25_001).map(|k| f64::from(k) * 2e-5).collect()));
        let case = case.unwrap();
        let (told, measured) = (memory::of_proof(&case, 1), peak(&["run", &file, grid, "--no-record"]));
        assert!(measured <= 2.0 * told && told <= 2.0 * measured, "{name}: {measured:e} of {told:e}");
        let (told, measured) = (memory::of_solution(&case, 1), peak(&["solve", &file, grid, "--with", "assur"]));
        assert!(measured <= 2.0 * told && told <= 2.0 * measured, "solve {name}: {measured:e} of {told:e}");
        let positions = memory::of_proof(&case.wanting(Wanted::of(&[Stage::Positions])), 1);
        assert!(1.9 * positions < memory::of_proof(&case, 1), "{name}");
    }
}

/// A run that is too large is refused in advance, with three remedies.
#[test]
fn a_run_beyond_the_memory_limit_does_not_begin() {
    let scenario = shipped("crank_rocker.toml");
    let error = prove(&scenario, &Options::default().memory(1e6)).unwrap_err();
    assert_eq!(error.scenario_key(), Some("grid"));
    let (message, help) = (error.message(), error.way_out().unwrap());
    let needed = format!("361 instants of {} channels", scenario.case.channels().len());
    assert!(message.contains(&needed), "{message}");
    assert!(
        help.contains("fewer instants") && help.contains("fewer channels") && help.contains("more memory"),
        "{help}"
    );
    // Without an option for the memory, the limit is 4 GB.
    let scenario = shipped("ov7_base.toml");
    let long = |instants: u32| {
        let mut scenario = scenario.clone();
        let times = (0..instants).map(|k| f64::from(k) * 1e-6).collect();
        scenario.case = scenario.case.on(Grid::of_times(scenario.case.crank(), times)).unwrap();
        scenario
    };
    let of_one = memory::of_proof(&long(200_000).case, 1) / 2e5;
    let error = prove(&long((5e9 / of_one) as u32), &Options::default()).unwrap_err();
    assert!(error.scenario_key() == Some("grid") && error.message().contains("4.0 GB"), "{error}");
    for command in ["run --no-record", "solve --with assur", "tune --within 1e-3"] {
        let mut run = Command::cargo_bin("linkproof").unwrap();
        run.args(command.split(' ')).args(["scenarios/crank_rocker.toml", "--memory", "0.001"]);
        let output = run.current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{command}: {told}");
        assert!(told.contains("--memory 0.1"), "{command}: {told}");
    }
}
