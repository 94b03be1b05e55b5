//! Largest reactions over a revolution, and the journals that carry the reactions.

use crate::common::assert_within;
use linkage::mechanism::JointId;
use std::path::Path;

use analytic::NewtonSolver;
use design::bearings::{journal_diameter, over_range};
use scenario::Scenario;

/// A crank alone with its mass centre at radius r; the unit vector e points from the pivot to the mass centre.
/// The reaction is |R| = m |w^2 r e + g|, which is largest where the mass centre is lowest.
#[test]
fn the_reaction_of_a_bare_crank_peaks_with_its_mass_lowest() {
    let text = "format = 1\nname = \"bare\"\ntitle = \"t\"\n[ground.points]\nO = { x_m = 0, y_m = 0 }\n[links.crank]\nmass_kg = 2\n\
        mass_centre = { x_m = 0.3, y_m = 0 }\n[links.crank.points]\nO = { x_m = 0, y_m = 0 }\n[[joints]]\nname = \"O\"\n\
        type = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n[drive]\njoint = \"O\"\nspeed_rad_s = 3\n[gravity]\nx_m_s2 = 0\n\
        y_m_s2 = -9.81\n[start]\ncrank_deg = 0\n[grid]\nfrom_deg = 0\nto_deg = 360\nstep_deg = 7\n[engine]\nstep_deg = 1\n";
    let peaks = over_range(&Scenario::parse(text, Path::new("bare.toml")).unwrap().case).unwrap();
    let expected = 2.0 * (9.0 * 0.3 + 9.81);
    assert_within!((peaks.reactions[0].value - expected).abs(), 1e-14 * expected, "{peaks:?}");
    // The reaction is stationary at its maximum, so the angle is accurate only to the square root of the rounding
    // error.
    assert_within!((peaks.reactions[0].crank - 1.5 * std::f64::consts::PI).abs(), 1e-7, "{peaks:?}");
    assert_eq!(peaks.reactions[0].value, peaks.shaking_force.value);
    assert_within!((peaks.balancing_moment.value - 2.0 * 9.81 * 0.3).abs(), 1e-14 * 6.0);
}

/// Printed maxima of R2 to R7, and the journals designed for them.
/// The authors search each maximum from a stated angle; for R2 and R3 their search ends 0.05 and 0.03 N too low.
/// The masses of the scenario were fitted to the authors' table and reproduce it to 0.015 N.
#[test]
fn val_ov7_new_largest_reactions_and_journals() {
    let scenario = crate::common::shipped("ov7_new_tabulated.toml");
    let case = &scenario.case;
    let peaks = over_range(case).unwrap();
    let printed = [
        ("2", 1039.52, 8.09),
        ("3", 647.28, 6.91),
        ("4", 299.37, 5.34),
        ("5", 161.28, 4.35),
        ("6", 286.49, 5.26),
        ("7", 146.43, 4.21),
    ];
    for (joint, force, diameter) in printed {
        let peak = peaks.reactions[case.mechanism.joint_named(joint).unwrap()];
        let short = peak.value - force;
        assert!((-0.02..0.06).contains(&short), "joint {joint}: {peak:?}, printed {force}");
        let found = 1e3 * journal_diameter(peak.value, 0.01, 200e6);
        assert_within!((found - diameter).abs(), 0.005, "joint {joint}: {found} mm, printed {diameter}");
    }
    // The authors design the crank's journal, of 4.91 mm, for R1 = 232.74 N.
    // This value of R1 is about a quarter of the load that the journal must carry.
    assert_within!((1e3 * journal_diameter(232.74, 0.01, 200e6) - 4.91).abs(), 0.005);
    let crank = peaks.reactions[case.mechanism.joint_named("1").unwrap()];
    assert_within!((crank.value - 1020.66).abs(), 0.02);
    assert_within!((1e3 * journal_diameter(crank.value, 0.01, 200e6) - 8.04).abs(), 0.005);
}

/// At the refined angle of a maximum, side 2 gives the same reaction.
/// Near this angle, side 2 gives no larger reaction.
#[test]
fn the_other_side_has_the_same_peaks() {
    for name in ["crank_rocker.toml", "fourth_class.toml", "class3_group.toml"] {
        let case = crate::common::shipped(name).case;
        let peaks = over_range(&case).unwrap();
        for (joint, peak) in peaks.reactions.iter().enumerate() {
            let cranks = [-1e-4, 0.0, 1e-4].map(|by| peak.crank + by);
            let times = cranks.map(|crank| case.crank().time_of(crank));
            let forces: Vec<f64> = crate::common::states(&NewtonSolver, &case, &times)
                .unwrap()
                .iter()
                .map(|s| s.forces[JointId(joint)].norm())
                .collect();
            assert_within!((forces[1] - peak.value).abs(), 1e-10 * peak.value, "{name}, joint {joint}");
            assert_within!(forces[0], peak.value * (1.0 + 1e-10), "{name}, {joint}");
            assert_within!(forces[2], peak.value * (1.0 + 1e-10), "{name}, {joint}");
        }
    }
}
