//! A scenario in other units is the same scenario.

use std::path::Path;

use analytic::AssurSolver;
use linkage::math::largest_size;
use linkage::solver::Solver;
use linkage::trajectory::Trajectory;
use scenario::Scenario;

use crate::common::assert_within;

fn solved(text: &str) -> Trajectory {
    let scenario = Scenario::parse(text, "loaded_slider.toml").unwrap_or_else(|error| panic!("{error}"));
    AssurSolver.solve(&scenario.case).unwrap_or_else(|error| panic!("{error}"))
}

/// Replaces the unit `from` by the unit `to` in every key with a number, and converts the number.
/// One unit `to` is `unit` times the unit `from`.
fn rewritten(text: &str, [from, to]: [&str; 2], unit: f64) -> (String, usize) {
    let ending = format!("_{from} = ");
    let mut parts = text.split(&ending);
    let (mut all, mut count) = (parts.next().unwrap().to_string(), 0);
    for part in parts {
        let end = part.find(|letter: char| !(letter.is_ascii_digit() || "+-.e".contains(letter))).unwrap();
        let number: f64 = part[..end].parse().unwrap();
        all += &format!("_{to} = {:?}{}", number / unit, &part[end..]);
        count += 1;
    }
    (all, count)
}

#[test]
fn a_scenario_in_other_units_has_the_same_motion_and_forces() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/loaded_slider.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let usual = solved(&text);
    for (units, size) in [
        (["mm", "cm"], 10.0),
        (["mm", "in"], 25.4),
        (["kg", "lb"], 0.453_592_37),
        (["kg", "t"], 1000.0),
        (["N", "lbf"], 4.448_221_615_260_5),
        (["rpm", "deg_s"], 1.0 / 6.0),
    ] {
        let (other, count) = rewritten(&text, units, size);
        assert!(count > 0, "{units:?}");
        for ((channel, usual), (_, other)) in usual.iter().zip(solved(&other).iter()) {
            let apart = usual.iter().zip(other).map(|(a, b)| a - b).collect::<Vec<f64>>();
            assert_within!(largest_size(&apart), 1e-11 * largest_size(usual) + 1e-9, "{units:?}: {channel}");
        }
    }
}
