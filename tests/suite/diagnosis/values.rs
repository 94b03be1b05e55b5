//! Faults in the values: the diagnosis names the change, or reports that there is no simple cause.

use super::{Tally, examined, parsed, text, told};
use linkage::case::{Case, Grid};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory};
use std::f64::consts::PI;

fn solved(case: &Case) -> Trajectory {
    analytic::AssurSolver.solve(case).unwrap()
}

/// The correct values, except that `change` is applied to the channels that `which` selects.
fn changed(case: &Case, which: impl Fn(&str, Stage) -> bool, change: impl Fn(usize, f64) -> f64) -> Trajectory {
    let right = solved(case);
    let column = |(channel, values): (&Channel, &[f64])| match which(&channel.to_string(), channel.kind.stage) {
        true => values.iter().enumerate().map(|(row, &value)| change(row, value)).collect(),
        false => values.to_vec(),
    };
    let columns = right.iter().map(column).collect();
    Trajectory::new(right.times().to_vec(), right.inputs().to_vec(), right.channels().to_vec(), columns).unwrap()
}

/// The correct values, except that the channels of the selected stages are late by `by` (s).
fn late(case: &Case, by: f64, which: impl Fn(Stage) -> bool) -> Trajectory {
    let times = case.grid.times.iter().map(|t| t - by).collect();
    let (right, other) = (solved(case), solved(&case.on(Grid::of_times(case.crank(), times)).unwrap()));
    let columns = right
        .iter()
        .zip(other.iter())
        .map(|((channel, values), (_, late))| if which(channel.kind.stage) { late.to_vec() } else { values.to_vec() });
    let columns = columns.collect();
    Trajectory::new(right.times().to_vec(), right.inputs().to_vec(), right.channels().to_vec(), columns).unwrap()
}

#[test]
fn slips_of_values_are_named() {
    let mut tally = Tally::default();
    for name in ["crank_rocker", "quick_return", "crank_rocker_runup"] {
        let case = parsed(name, &text(name)).case;
        let mut add = |what: &str, suspect: &Trajectory, expected: &str| {
            tally.add(&format!("{name}, {what}"), examined(&case, suspect, Some(1e-3)).as_ref(), expected);
        };
        let joint = |name: &str, _: Stage| name.starts_with("joint.A.");
        let torque = |name: &str, _: Stage| name == "drive.torque_N_m";
        let one = |name: &str, _: Stage| name == "joint.B.fx_N";
        add(
            "sign of a reaction",
            &changed(&case, joint, |_, value| -value),
            "the opposite sign of joint.A.fx_N, joint.A.fy_N",
        );
        add("sign of the torque", &changed(&case, torque, |_, value| -value), "the opposite sign of drive.torque_N_m");
        add("half the torque", &changed(&case, torque, |_, value| value / 2.0), "half the values of drive.torque_N_m");
        add("twice a reaction", &changed(&case, joint, |_, value| 2.0 * value), "twice the values of joint.A");
        add("no reaction", &changed(&case, one, |_, _| 0.0), "zero instead of joint.B.fx_N");
        add(
            "kN",
            &changed(&case, |_, stage| stage >= Stage::Reactions, |_, value| value / 1e3),
            "another unit in joint.*: a thousand times too small",
        );
        let angles = |name: &str, _: Stage| name.ends_with("angle_rad");
        let degrees = "another unit in link.*: degrees instead of radians";
        add("degrees", &changed(&case, angles, |_, value| value * 180.0 / PI), degrees);
        let speeds = |name: &str, _: Stage| name.ends_with("omega_rad_s");
        add(
            "rpm",
            &changed(&case, speeds, |_, value| value * 30.0 / PI),
            "another unit in link.*: revolutions per minute instead of rad/s",
        );
        let places = |name: &str, _: Stage| name.starts_with("point.") && name.ends_with("_m");
        let millimetres = "another unit in point.A.x_m, *: millimetres instead of metres";
        add("mm", &changed(&case, places, |_, value| value * 1e3), millimetres);
        let own = |name: &str, _: Stage| name == "link.rocker.angle_rad" || name == "link.guide.angle_rad";
        add("other zero", &changed(&case, own, |_, value| value + PI / 6.0), "30 deg added at every instant");
        add(
            "slip of a turn",
            &changed(&case, own, |row, value| if row > 90 { value + 2.0 * PI } else { value }),
            "whole turns",
        );
        let every = |_: &str, _: Stage| true;
        let alone = changed(&case, every, |row, value| if row == 40 { value + 0.1 } else { value });
        add("an outlier", &alone, "one row alone, at t = ");
        add("factor", &changed(&case, one, |_, value| 1.25 * value), "1.25 times the values of joint.B.fx_N");
    }
    tally.told("slips of values");
    assert!(tally.wrong.is_empty(), "\n{}", tally.wrong.join("\n"));
}

#[test]
fn values_of_another_instant_are_named() {
    let mut tally = Tally::default();
    for name in ["crank_rocker", "class3_group"] {
        let case = parsed(name, &text(name)).case;
        let mut add = |what: &str, suspect: &Trajectory, expected: &str| {
            tally.add(&format!("{name}, {what}"), examined(&case, suspect, Some(1e-3)).as_ref(), expected);
        };
        add("a step late", &late(&case, 1e-3, |_| true), "all channels are 1 ms, 1 step too late");
        add(
            "half a step late",
            &late(&case, 5e-4, |stage| stage == Stage::Velocities),
            "velocities are 0.5 ms, 0.5 step too late",
        );
        add(
            "a quarter early",
            &late(&case, -2.5e-4, |stage| stage == Stage::Accelerations),
            "accelerations are 0.25 ms, 0.25 step too early",
        );
    }
    tally.told("other instants");
    assert!(tally.wrong.is_empty(), "\n{}", tally.wrong.join("\n"));
}

/// Noise, a missing part of a reaction, a drift, and several faults at once have no single simple cause.
#[test]
fn deviations_without_a_simple_cause_are_reported_as_such() {
    let (mut silent, mut all, mut wrong) = (0, 0, Vec::new());
    for name in ["crank_rocker", "quick_return", "class3_group", "pendulum", "crank_rocker_runup"] {
        let scenario = parsed(name, &text(name));
        let case = &scenario.case;
        let hash = |row: usize| ((row as f64 * 12.9898).sin() * 43758.5453).fract();
        let forces = |_: &str, stage: Stage| stage >= Stage::Reactions;
        let one = |name: &str, _: Stage| name.starts_with("joint.") && name.ends_with("fx_N");
        let every = |_: &str, _: Stage| true;
        let suspects = [
            ("noise in the forces", changed(case, forces, |row, value| value * (1.0 + 0.1 * hash(row)))),
            ("noise in everything", changed(case, every, |row, value| value * (1.0 + 0.01 * hash(row)))),
            ("positive parts only", changed(case, one, |_, value| if value > 0.0 { value } else { 0.0 })),
            ("a drift", changed(case, forces, |row, value| value * (1.0 + 1e-3 * row as f64))),
            ("two outliers", changed(case, every, |row, value| if row % 40 == 7 { value + 0.1 } else { value })),
            ("a square", changed(case, one, |_, value| value * value.abs() / 100.0)),
        ];
        for (what, suspect) in suspects {
            let found = examined(case, &suspect, Some(1e-3));
            let found = found.expect("the suspect disagrees");
            all += 1;
            let line = format!("{name}, {what}: {}", told(Some(&found)));
            println!("{line}");
            if found.is_explained() { wrong.push(line) } else { silent += 1 }
        }
    }
    println!("{silent} of {all} reported as having no simple cause");
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
