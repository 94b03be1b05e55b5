//! Real output of foreign programs in `examples/foreign`: correct tables agree, and faults in wrong tables are found.

use std::fs;
use std::path::{Path, PathBuf};

use super::scenario;
use linkproof::plain::diagnosis::cause;
use prover::compare::{ComparedParty, ComparisonRule, PartyComparison, compare};
use prover::tables::{Held, load};
use scenario::mapping::{Mapped, Mapping};

const FOREIGN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/foreign");

/// For each correct table: its map, its scenario, and the table.
const RIGHT: [(&str, &str, &str); 6] = [
    ("mujoco_crank_rocker", "crank_rocker", "mujoco_crank_rocker.csv"),
    ("mujoco_crank_rocker_runup", "crank_rocker_runup", "mujoco_crank_rocker_runup.csv"),
    ("exudyn_crank_rocker", "crank_rocker", "exudyn_crank_rocker.csv"),
    ("exudyn_crankcase", "crankcase", "exudyn_crankcase.txt"),
    ("pylinkage_crank_rocker", "crank_rocker", "pylinkage_crank_rocker.csv"),
    ("pylinkage_six_bar", "six_bar_slider", "pylinkage_six_bar.csv"),
];

fn path(name: &str) -> PathBuf {
    Path::new(FOREIGN).join(name)
}

/// Compares a table with a scenario; the map and the scenario are those of the correct table `right`.
/// `lines` replace lines of the map for the same channels.
fn compared(right: &str, table: &str, lines: &[&str]) -> PartyComparison {
    let (map, of, _) = RIGHT.into_iter().find(|(map, ..)| *map == right).unwrap();
    let mut mapping = Mapping::load(&path(&format!("{map}.map.toml"))).unwrap();
    for line in lines {
        let line = Mapped::parse(line, "a test").unwrap();
        mapping.channels.retain(|own| own.name != line.name);
        mapping.push(line);
    }
    let file = path("data").join(table);
    let held = Held::of_table(&load(&file).unwrap(), &mapping).unwrap_or_else(|error| panic!("{table}: {error}"));
    let parties = [ComparedParty::from(scenario(of)), ComparedParty::from(held)];
    let how = ComparisonRule { allowed: mapping.allowed, ..ComparisonRule::default() };
    compare(parties, &how).unwrap_or_else(|error| panic!("{table}: {error}"))
}

fn causes(found: &PartyComparison) -> Vec<String> {
    let causes = found.pairs.iter().flat_map(|pair| &pair.causes);
    causes.filter_map(|explained| explained.diagnosis.cause.as_ref()).map(cause).collect()
}

#[test]
fn three_programs_agree_within_their_tolerances() {
    for (map, _, table) in RIGHT {
        let found = compared(map, table, &[]);
        let channels = &found.pairs[0].channels;
        assert_eq!(found.verdict.word(), "agree", "{map}: {:?}", found.verdict);
        // In each table, the error of at least one channel must use more than the share `near` of its tolerance.
        // If all tolerances were far too wide, the agreement would prove nothing.
        // Tables from closed formulas contain only rounding errors, so a smaller share is enough for these tables.
        let near = if map.starts_with("pylinkage") { 0.01 } else { 0.3 };
        assert!(channels.iter().any(|own| own.worst.unwrap().used() > near), "{map}");
        let mapping = Mapping::load(&path(&format!("{map}.map.toml"))).unwrap();
        assert_eq!(mapping.allowed.len(), channels.len(), "{map}");
    }
}

/// Tables with planted faults, their maps, and words of the cause (empty if there is no single simple cause).
const WRONG: [(&str, &str, &str); 11] = [
    ("wrong_mujoco_soft.csv", "mujoco_crank_rocker", ""),
    ("wrong_mujoco_late.csv", "mujoco_crank_rocker", "1 ms, 0.25 row too late"),
    ("wrong_mujoco_start.csv", "mujoco_crank_rocker", "one row alone, at t = 0 s"),
    ("wrong_mujoco_lag.csv", "mujoco_crank_rocker", ""),
    ("wrong_mujoco_reset.csv", "mujoco_crank_rocker", ""),
    ("wrong_exudyn_inertia.csv", "exudyn_crank_rocker", "moment of inertia of coupler: taken about joint A"),
    ("wrong_exudyn_ringing.csv", "exudyn_crank_rocker", ""),
    ("wrong_exudyn_no_gravity.txt", "exudyn_crankcase", "gravity: missing"),
    ("wrong_pylinkage_early.csv", "pylinkage_crank_rocker", "1 row too early"),
    ("wrong_pylinkage_branch.csv", "pylinkage_crank_rocker", "another configuration of coupler, rocker"),
    ("wrong_pylinkage_tracker.csv", "pylinkage_six_bar", "zero instead of point.D.vy_m_s"),
];

#[test]
fn planted_errors_in_tables_are_found_and_explained() {
    for (table, map, expected) in WRONG {
        let found = compared(map, table, &[]);
        assert_eq!(found.verdict.word(), "disagree", "{table}");
        let causes = causes(&found);
        assert!(expected.is_empty() || causes.iter().any(|words| words.contains(expected)), "{table}: {causes:?}");
        assert!(!expected.is_empty() || causes.is_empty(), "{table}: made up: {causes:?}");
    }
}

/// If MuJoCo's state is not finite, MuJoCo resets the time to zero and continues to write.
#[test]
fn time_that_jumps_back_is_reported() {
    let found = compared("mujoco_crank_rocker", "wrong_mujoco_reset.csv", &[]);
    let (row, [before, after]) = found.pairs[0].turns_back.unwrap();
    assert!(row > 10 && before > 0.2 && after < before, "{row} {before} {after}");
    assert!(compared("mujoco_crank_rocker", "mujoco_crank_rocker.csv", &[]).pairs[0].turns_back.is_none());
}

/// For each case: the map, a wrong line for it, and words of the cause that must be named (empty if none is required).
const LINES: [(&str, &str, &str); 17] = [
    ("mujoco_crank_rocker", "54.19349837312087 + q_rocker*180/pi=link.rocker.angle_deg", "opposite sense"),
    ("mujoco_crank_rocker", "54.19349837312087 - q_rocker=link.rocker.angle_deg", ""),
    ("mujoco_crank_rocker", "0.6781965782888193 - q_coupler=link.coupler.angle_rad", "measured from another link"),
    ("mujoco_crank_rocker", "B.z=point.B.y_mm", "metres taken for millimetres"),
    ("mujoco_crank_rocker", "aB.z=point.B.ay_m_s2", "9.8"),
    ("mujoco_crank_rocker", "F_A.x=joint.A.fx_N", ""),
    ("mujoco_crank_rocker", "efc_B.x=joint.B.fx_N", "opposite sign"),
    ("mujoco_crank_rocker", "-qd_crank*30/pi=link.crank.omega_rad_s", "revolutions per minute"),
    ("mujoco_crank_rocker", "-motor=drive.torque_N_m", "too late"),
    ("exudyn_crank_rocker", "rockerRot=link.rocker.angle_rad", "added at every instant"),
    ("exudyn_crank_rocker", "forceAY=joint.A.fy_N", "opposite sign"),
    ("exudyn_crank_rocker", "-forceBY=joint.B.fx_N", "joint.B.fy_N"),
    ("exudyn_crankcase", "-c36=joint.bore.moment_N_m", ""),
    ("exudyn_crankcase", "c2=link.crank.x_m", "added at every instant"),
    ("exudyn_crankcase", "c15=link.rod.ay_m_s2", "link.rod.vy_m_s"),
    ("pylinkage_six_bar", "0.05*`x_B'`=point.B.vx_m_s", "per radian"),
    ("pylinkage_six_bar", "0.05*20*`x_B''`=point.B.ax_m_s2", "0.05"),
];

#[test]
fn a_wrong_line_of_a_mapping_is_found_and_named() {
    let mut named = 0;
    for (map, line, expected) in LINES {
        let (_, _, table) = RIGHT.into_iter().find(|(own, ..)| *own == map).unwrap();
        let found = compared(map, table, &[line]);
        assert_eq!(found.verdict.word(), "disagree", "{line}");
        let off: Vec<&str> = found.pairs[0]
            .channels
            .iter()
            .filter(|own| own.since.is_some())
            .map(|own| own.claim.text.as_str())
            .collect();
        assert!(off.len() == 1 && line.ends_with(off[0]), "{line}: {off:?}");
        let causes = causes(&found);
        let is_named = !expected.is_empty() && causes.iter().any(|words| words.contains(expected));
        named += usize::from(is_named);
        if !is_named {
            println!("{line}: {causes:?}");
        }
    }
    println!("{named} of {} named", LINES.len());
    let simple = LINES.iter().filter(|(_, _, expected)| !expected.is_empty()).count();
    assert!(named >= simple, "{named} of {simple}");
}

/// The README of the scripts has a line for every table.
#[test]
fn every_table_has_its_line_in_the_readme() {
    let readme = fs::read_to_string(path("README.md")).unwrap();
    for entry in fs::read_dir(path("data")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(readme.contains(&format!("| `{name}` |")), "{name}");
    }
}
