//! Change points, and mechanisms with redundant links.

use linkage::case::Case;
use linkage::mechanism::AssemblyMode;

use super::four_bar::{SPEED_OF_ALL, builder, rods};
use crate::stress::{Setup, StressFamily};

/// Lengths of a parallelogram (m).
const PARALLELOGRAM: [f64; 4] = [0.4, 0.1, 0.4, 0.1];

/// Family that approaches a change point.
pub(super) const CHANGE_POINT: StressFamily = StressFamily {
    name: "change_point",
    dial: "fraction by which the crank is shorter than the rocker",
    title: "a parallelogram whose crank is slightly too short, so that it just misses its change points",
    points: &[1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1],
    quick: &[1e-12, 1e-6, 0.1],
    samples: 1,
    setup: |share, _, _| {
        let [base, crank, coupler, rocker] = PARALLELOGRAM;
        let lengths = [base, crank * (1.0 - share), coupler, rocker];
        Ok(Setup::usual(builder(lengths, rods(lengths), SPEED_OF_ALL).build()?))
    },
};

/// Family with more bars than the parallelogram needs.
pub(super) const REDUNDANT: StressFamily = StressFamily {
    name: "redundant",
    dial: "number of redundant bars of the parallelogram, plus one",
    title: "a parallelogram that passes its change points, with redundant bars that fit",
    points: &[1.0, 2.0, 3.0, 4.0],
    quick: &[1.0, 2.0],
    samples: 1,
    setup: |bars, _, _| {
        let [base, crank, ..] = PARALLELOGRAM;
        let names = |k: usize| ["P", "Q", "bar"].map(|word| format!("{word}{k}"));
        let points: Vec<[String; 3]> = (1..bars as usize).map(names).collect();
        let along = |k: usize| base * (k + 1) as f64 / (points.len() + 1) as f64;
        let (mut ground, mut coupler) =
            (vec![("O", [0.0; 2]), ("C", [base, 0.0])], vec![("A", [0.0; 2]), ("B", [base, 0.0])]);
        ground.extend(points.iter().enumerate().map(|(k, [below, ..])| (below.as_str(), [along(k), 0.0])));
        coupler.extend(points.iter().enumerate().map(|(k, [_, above, _])| (above.as_str(), [along(k), 0.0])));
        let mut all = Case::builder()
            .ground(&ground)
            .link("crank", &[("O", [0.0; 2]), ("A", [crank, 0.0])])
            .link("coupler", &coupler)
            .link("rocker", &[("C", [0.0; 2]), ("B", [crank, 0.0])])
            .mass("crank", 1.0, [0.5 * crank, 0.0], 1e-3)
            .mass("coupler", 4.0, [0.5 * base, 0.0], 0.05)
            .mass("rocker", 1.0, [0.5 * crank, 0.0], 1e-3)
            .pin("O", "ground", "crank")
            .pin("A", "crank", "coupler")
            .pin("B", "coupler", "rocker")
            .pin("C", "ground", "rocker");
        for [below, above, bar] in &points {
            all = all
                .link(bar, &[(below, [0.0; 2]), (above, [crank, 0.0])])
                .mass(bar, 1.0, [0.5 * crank, 0.0], 1e-3)
                .pin(below, "ground", bar)
                .pin(above, "coupler", bar);
        }
        let all = all.gravity([0.0, -9.81]).crank("O", SPEED_OF_ALL).start(0.3).instants(36);
        let case = all.mode(&["coupler", "rocker"], AssemblyMode::Left).build()?;
        let case = case.with(|parts| parts.drives.crank_mut().through = true)?;
        // The double-double reference cannot pass change points.
        // The two analytic sides are therefore compared with each other.
        Ok(Setup { precise: false, ..Setup::usual(case) })
    },
};
