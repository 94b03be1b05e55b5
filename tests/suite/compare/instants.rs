//! Columns of instants as they occur in practice.
//! The instants may be in a different order, repeated, in different units, concatenated, or under different names.
//! Each column is judged correctly, or refused with a message that states where the problem is.

use std::fmt::Write;
use std::fs;

use linkage::case::Grid;
use linkage::solver::Solver;

use super::{scenario, solved};
use crate::cli::tools::{Place, Table};

/// A row: instant, angle of the rocker (deg), and its angular velocity.
type Row = (String, f64, f64);

/// Rows of a correct table of the crank-rocker.
/// `of` converts a time (s) to the printed instant.
fn rows(of: impl Fn(f64) -> f64) -> Vec<Row> {
    let right = solved(&scenario("crank_rocker"));
    let [angle, omega] = ["link.rocker.angle_rad", "link.rocker.omega_rad_s"].map(|name| right.named(name).unwrap());
    let row = |row: usize| (of(right.times()[row]).to_string(), angle[row].to_degrees(), omega[row]);
    (0..right.times().len()).map(row).collect()
}

fn text(instants: &str, rows: &[Row]) -> String {
    let mut text = format!("{instants},link.rocker.angle_deg,link.rocker.omega_rad_s\n");
    rows.iter().for_each(|(at, angle, omega)| writeln!(text, "{at},{angle:.9},{omega:.9}").unwrap());
    text
}

/// Exit code and output of a comparison with a table.
fn compared(place: &Place, text: &str) -> (i32, String) {
    fs::write(place.path("spoiled.csv"), text).unwrap();
    let outcome = place.run("compare scenarios/crank_rocker.toml spoiled.csv");
    let all = format!("{}\n{}", outcome.stdout, outcome.stderr);
    (outcome.code, all.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// Duration of one revolution at 130 rpm (s).
const TURN: f64 = 60.0 / 130.0;

#[test]
fn correct_rows_agree_unordered_repeated_and_at_any_turn() {
    let place = Place::new();
    let right = rows(|at| at);
    let mixed: Vec<Row> = (0..right.len()).map(|row| right[(row * 137) % right.len()].clone()).collect();
    let backwards: Vec<Row> = right.iter().rev().cloned().collect();
    let twice = [right.clone(), right.clone()].concat();
    for (what, rows, note) in [
        ("mixed", mixed, "the time jumps back in row"),
        ("backwards", backwards, ""),
        ("twice", twice, "the time jumps back in row 362"),
        ("before zero", rows(|at| at - TURN), ""),
        ("a turn beyond the run", rows(|at| at + TURN), ""),
    ] {
        let (code, told) = compared(&place, &text("t_s", &rows));
        assert!(code == 0 && told.contains(note) && !told.contains("different values"), "{what}: {told}");
    }
}

#[test]
fn instant_columns_are_recognised_by_name_and_unit() {
    let place = Place::new();
    for name in ["t [s]", "Time", "TIME (s)", "time [s]", "t (s)"] {
        assert_eq!(compared(&place, &text(name, &rows(|at| at))).0, 0, "{name}");
    }
    for name in ["time_ms", "Time [ms]", "t (ms)"] {
        assert_eq!(compared(&place, &text(name, &rows(|at| 1e3 * at))).0, 0, "{name}");
    }
    for name in ["Crank [deg]", "crank angle (deg)"] {
        assert_eq!(compared(&place, &text(name, &rows(|at| 360.0 * at / TURN))).0, 0, "{name}");
    }
    // Unsupported units of an instant, and names that may denote a quantity other than time.
    for name in ["t [min]", "T", "temperature [s]"] {
        let (code, told) = compared(&place, &text(name, &rows(|at| at)));
        assert!(
            code == 2 && told.contains("has no column of times or crank angles") && told.contains("time_s"),
            "{name}: {told}"
        );
    }
    // If a table also has a column with the exact name `time_s`, the program uses the column `time_s`.
    let both: Vec<Row> =
        rows(|at| at).into_iter().map(|(at, angle, omega)| (format!("{at},7"), angle, omega)).collect();
    assert_eq!(compared(&place, &text("time_s,Time [ms]", &both)).0, 0);
}

#[test]
fn instants_in_another_unit_disagree_and_the_unit_is_named() {
    let place = Place::new();
    let (code, told) = compared(&place, &text("t_s", &rows(|at| 1e3 * at)));
    assert!(code == 1 && told.contains("milliseconds taken for seconds"), "{told}");
    // The motion cannot be solved at instants as far away as those of this table.
    let (code, told) = compared(&place, &text("t_s", &rows(|at| 1e9 * at)));
    assert!(code == 2 && told.contains("check the unit of the instants"), "{told}");
}

/// Rows of the same instant with different numbers are reported, and no cause is invented.
#[test]
fn contradictory_rows_of_one_instant_are_reported() {
    let place = Place::new();
    let right = rows(|at| at);
    let other: Vec<Row> = right.iter().map(|(at, angle, omega)| (at.clone(), angle + 5.0, *omega)).collect();
    let one = vec![(right[100].0.clone(), right[200].1, right[200].2)];
    let still: Vec<Row> = right.iter().map(|(_, angle, omega)| ("0.100000000".into(), *angle, *omega)).collect();
    for (rows, numbers) in [
        ([right.clone(), other].concat(), "rows 1 and 362 have the same time"),
        ([right.clone(), one].concat(), "rows 101 and 362 have the same time"),
        (still, "rows 1 and 2 have the same time"),
    ] {
        let (code, told) = compared(&place, &text("t_s", &rows));
        assert!(code == 1 && told.contains(numbers) && told.contains("but different values"), "{told}");
        assert!(!told.contains("cause ") && !told.contains("noise"), "{told}");
    }
}

#[test]
fn rows_without_an_instant_are_refused_with_their_line() {
    let place = Place::new();
    let right = rows(|at| at);
    for (cell, words) in [
        ("", ["line 9 of the table", "has no instant", "`t_s`"]),
        ("nan", ["line 9 of the table", "has no instant", "`t_s`"]),
        ("0.1 s", ["spoiled.csv:9:1", "\"t_s\"", "\"0.1 s\""]),
        ("2024-01-01", ["spoiled.csv:9:1", "\"t_s\": expected a number", "\"2024-01-01\""]),
        ("0,1", ["spoiled.csv:9:1", "4 cells", "header"]),
    ] {
        let mut spoiled = right.clone();
        spoiled[5].0 = cell.into();
        let (code, told) = compared(&place, &format!("# a comment\n\n{}", text("t_s", &spoiled)));
        assert!(code == 2 && words.iter().all(|word| told.contains(word)), "{cell}: {told}");
    }
}

/// A motion law has an end, and a free motion has a beginning.
/// Instants outside the range of the motion are refused, but the last instant may be outside by its rounding error.
#[test]
fn instants_beyond_a_law_are_refused_except_for_rounding() {
    let place = Place::new();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/outside/scenarios/cycloidal_press.toml");
    let press = fs::read_to_string(path).unwrap().replace("time_ms = 400", "time_ms = 400.06");
    fs::write(place.path("press.toml"), press.split("[[oracle]]").next().unwrap()).unwrap();
    let press = linkproof::Scenario::load(place.path("press.toml")).unwrap();
    let end = press.case.crank().end().unwrap();
    assert!((end - 0.400_06).abs() < 1e-12, "{end}");
    let of = |late: f64| {
        let times: Vec<f64> = (0..=40).map(|row| end * f64::from(row) / 40.0).collect();
        let grid = Grid::of_times(press.case.crank(), times);
        let right = analytic::AssurSolver.solve(&press.case.on(grid).unwrap()).unwrap();
        let angles = right.named("link.crank.angle_rad").unwrap();
        // The last instant is printed as 0.4001.
        let rows = right.times().iter().zip(angles).map(|(at, angle)| format!("{:.4},{angle}\n", at + late));
        fs::write(place.path("late.csv"), format!("t_s,link.crank.angle_rad\n{}", rows.collect::<String>())).unwrap();
        place.run("compare press.toml late.csv")
    };
    let outcome = of(0.0);
    assert!(outcome.code == 0, "{}{}", outcome.stdout, outcome.stderr);
    let outcome = of(0.01);
    assert!(outcome.code == 2 && outcome.stderr.contains("check the unit of the instants"), "{}", outcome.stderr);
}

/// A table by crank angle of a mechanism that turns faster. Positions agree, all rates and forces are wrong.
#[test]
fn regress_a_wrong_speed_in_a_table_by_crank_angle_is_named() {
    let place = Place::new();
    let faster =
        place.ok("solve scenarios/crank_rocker.toml --set drive.speed_rpm=132.6 --only point.B --only joint.C");
    let columns = Table::of(&faster);
    let names = ["crank_rad", "point.B.x_m", "point.B.vx_m_s", "joint.C.fx_N"];
    let rows: Vec<Vec<f64>> = names.iter().map(|name| columns.column(name)).collect();
    let line = |row: usize| rows.iter().map(|own| format!("{:.5e}", own[row])).collect::<Vec<_>>().join(",");
    let lines: Vec<String> = (0..rows[0].len()).map(line).collect();
    fs::write(place.path("faster.csv"), format!("{}\n{}\n", names.join(","), lines.join("\n"))).unwrap();
    let outcome = place.run("compare scenarios/crank_rocker.toml faster.csv");
    assert_eq!(outcome.code, 1, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("speed of the drive at O: 13.88"), "{}", outcome.stdout);
}
