//! Instants many revolutions away have the same values as nearby instants, and not every revolution is computed.

use std::f64::consts::TAU;

use linkage::case::{Case, Grid};
use linkage::trajectory::{Trajectory, Unit};
use linkage::work::{Count, counted};

use crate::common::{assert_within, shipped};

/// Asserts that the values of `far` repeat the values of `near`, except for the whole revolutions that angles count.
fn assert_repeats(near: &Trajectory, far: &Trajectory, turns: f64, what: &str) {
    for ((channel, near), (_, far)) in near.iter().zip(far.iter()) {
        let scale = near.iter().fold(1e-3, |most: f64, value| if value.abs() > most { value.abs() } else { most });
        for (near, far) in near.iter().zip(far) {
            let gone = match channel.kind.unit {
                // The link must make a whole number of revolutions for each revolution of the crank.
                Unit::Radian => ((far - near) / TAU).round() * TAU,
                _ => 0.0,
            };
            if channel.kind.unit == Unit::Radian {
                assert_within!((gone / TAU).abs() % turns.abs(), 0.0, "{what}: {channel} turns {}", gone / TAU);
            }
            // The crank angle itself has lost digits: after 1e5 revolutions its rounding error is 1e-10 rad.
            assert_within!((far - near - gone).abs() / scale, 1e-7, "{what}: {channel} {near} {far}");
        }
    }
}

fn at(case: &Case, turns: f64) -> Case {
    let cranks = [0.3, 2.0, 5.5].map(|angle| angle + turns * TAU).to_vec();
    case.on(Grid::of_inputs(case.crank(), cranks)).unwrap()
}

#[test]
fn motion_and_work_are_the_same_after_1e5_turns() {
    for name in ["crank_rocker.toml", "ov7_base.toml", "fourth_class.toml", "quick_return.toml"] {
        let case = shipped(name).case;
        for solver in analytic::all() {
            let poses = |turns: f64| {
                let (found, work) = counted(|| solver.solve(&at(&case, turns)).unwrap());
                (found, work.of(Count::Poses))
            };
            let ((near, _), (_, few)) = (poses(0.0), poses(7.0));
            for turns in [7.0, -7.0, 1e4, -9e4] {
                let what = format!("{name}, {}, {turns} turns", solver.name());
                let (far, many) = poses(turns);
                assert_repeats(&near, &far, turns, &what);
                assert!(many <= 2 * few, "{what}: {many} poses, {few} for seven turns");
            }
        }
    }
}

/// Two drives have no common revolution, so their motion is followed revolution by revolution.
#[test]
fn several_drives_are_followed_turn_by_turn() {
    let case = shipped("five_bar.toml").case;
    let times: Vec<f64> = vec![0.0, 40.0 * TAU / case.crank().top_speed().abs()];
    let far = case.on(Grid::of_times(case.crank(), times.clone())).unwrap();
    // The same motion, followed in small steps.
    let pieces: Vec<f64> = (0..=4000).map(|k| times[1] * f64::from(k) / 4000.0).collect();
    let close = case.on(Grid::of_times(case.crank(), pieces)).unwrap();
    for solver in analytic::all() {
        let (far, close) = (solver.solve(&far), solver.solve(&close));
        match (far, close) {
            (Ok(far), Ok(close)) => {
                for ((channel, far), (_, close)) in far.iter().zip(close.iter()) {
                    let (one, other) = (far[1], close[4000]);
                    assert_within!((one - other).abs(), 1e-9 * (1.0 + one.abs()), "{channel}");
                }
            }
            (far, close) => assert_eq!(far.is_ok(), close.is_ok()),
        }
    }
}

/// Symptom: a law with a brief steep part made side 2 follow 1e18 revolutions.
#[test]
fn a_briefly_steep_law_terminates() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/crank_rocker.toml")).unwrap();
    let text = text.split("[[oracle]]").next().unwrap().replacen("[motor]", "[unused]", 1);
    let start = text.find("[unused]").unwrap();
    let end = start + text[start..].find("\n[gravity]").unwrap();
    let text = format!("{}{}", &text[..start], &text[end..]);
    let point = |time: &str, angle: u8| format!("{{ time_s = {time}, angle_deg = {angle} }}");
    let points = [point("0", 0), point("1e-9", 10), point("1e9", 20)].join(", ");
    let law = &format!("law = \"table\"\npoints = [{points}]");
    let grid = "[grid]\ntimes_s = [0, 1e-9, 1e9]\n";
    let cut = text.find("[grid]").unwrap();
    let text = format!("{}{grid}", text[..cut].replacen("speed_rpm = 130", law, 1));
    let scenario = scenario::Scenario::parse(&text, std::path::Path::new("steep.toml"));
    let scenario = scenario.unwrap_or_else(|error| panic!("{error}: {text}"));
    for solver in analytic::all() {
        if let Err(error) = solver.solve(&scenario.case) {
            assert!(error.message().contains("turns until"), "{error}");
        }
    }
}
