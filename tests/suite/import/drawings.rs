//! Files of Linkage. The test compares the points with the coordinates from which the files were made by hand.

use super::{imported, proven};
use crate::cli::tools::Table;
use crate::common::assert_within;
use linkage::math::KeepNan;

/// A file, its unit of length in m, the positions of moving points at t = 0 in this unit, and a channel with its value
/// at t = 0.
type Drawing = (&'static str, f64, &'static [(&'static str, [f64; 2])], (&'static str, f64));

/// Turns per minute.
const RPM: f64 = std::f64::consts::TAU / 60.0;

const DRAWINGS: [Drawing; 7] = [
    (
        "four_bar",
        1e-3,
        &[("P1", [30.0, 20.0]), ("P2", [100.0, 70.0]), ("tracer", [60.0, 80.0])],
        ("link.crank.omega_rad_s", -15.0 * RPM),
    ),
    ("inches", 0.0254, &[("P1", [1.0, 1.5]), ("P2", [4.0, 3.0])], ("link.L0.omega_rad_s", 30.0 * RPM)),
    ("slider_crank", 1e-3, &[("P1", [20.0, 15.0]), ("P2", [90.0, -10.0])], ("point.P2.vy_m_s", 0.0)),
    ("gears", 1e-3, &[("P2", [75.0, 10.0]), ("P3", [40.0, 70.0])], ("link.large.omega_rad_s", 7.5 * RPM)),
    ("actuator", 1e-3, &[("P1", [100.0, 20.0])], ("joint.ram.slide_speed_m_s", 0.004)),
    ("two_sliders", 1e-3, &[("P1", [30.0, 10.0]), ("P6", [150.0, 40.0])], ("link.ram.omega_rad_s", 0.0)),
    ("fastened", 1e-3, &[("P2", [100.0, 70.0]), ("P5", [80.0, 40.0])], ("link.L0.omega_rad_s", -15.0 * RPM)),
];

#[test]
fn every_file_becomes_a_scenario_that_is_proven() {
    for (name, metres, points, (channel, expected)) in DRAWINGS {
        let (place, outcome) = imported(&format!("{name}.linkage2"));
        assert_eq!(outcome.code, 0, "{name}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("Linkage has no masses"), "{name}: {}", outcome.stderr);
        proven(&place, name);
        let table = Table::of(&place.ok("solve own.toml --with newton --times 0"));
        for (point, [x, y]) in points {
            let found = ["x", "y"].map(|axis| table.column(&format!("point.{point}.{axis}_m"))[0]);
            let off = (found[0] - x * metres).abs().larger((found[1] - y * metres).abs());
            assert_within!(off, 2e-6 * metres, "{name}: {point}");
        }
        assert_within!((table.column(channel)[0] - expected).abs(), 1e-8, "{name}: {channel}");
    }
}

/// A sector that is fastened to the rocker drives a chain wheel.
#[test]
fn fastened_links_are_one_body() {
    let (place, _) = imported("fastened.linkage2");
    let table = Table::of(&place.ok("solve own.toml --with assur --times 0:1:0.25"));
    let [rocker, pinion] = ["L2", "pinion"].map(|link| table.column(&format!("link.{link}.omega_rad_s")));
    for (rocker, pinion) in rocker.iter().zip(&pinion) {
        assert_within!((pinion - 2.0 * rocker).abs(), 1e-9 * rocker.abs().larger(1.0));
    }
}

#[test]
fn what_is_missing_has_its_name() {
    let (place, outcome) = imported("curved.linkage2");
    assert_eq!(outcome.code, 2);
    let stderr = outcome.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    for word in ["the path of slider \"P2\" is curved", "the mobility is W = 3*2 - 2*2 = 2", "written anyway"] {
        assert!(stderr.contains(word), "{word}: {stderr}");
    }
    let text = std::fs::read_to_string(place.path("own.toml")).unwrap();
    assert!(text.contains("# - the path of slider \"P2\" is curved: it is left out"), "{text}");
    let (place, outcome) = imported("broken.linkage2");
    assert!(outcome.code == 2 && outcome.stderr.contains("broken.linkage2:16:1"), "{}", outcome.stderr);
    assert!(!place.path("own.toml").exists());
}
