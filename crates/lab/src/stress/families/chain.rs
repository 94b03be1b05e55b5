//! Chains of four-bars: the rocker of each four-bar is the crank of the next.

use linkage::case::Case;
use linkage::error::Result;
use linkage::mechanism::AssemblyMode;

use super::four_bar::SPEED_OF_ALL;
use crate::stress::{EngineUse, Setup, StressFamily};

/// Length of the bars (m) and distance between their pivots (m).
const BAR: f64 = 0.5;
const PITCH: f64 = 1.0;
/// The crank swings through the upright position, from the first angle to the last (rad).
const ANGLES: [f64; 2] = [1.1, 2.0];
/// Number of intervals between the instants.
const INSTANTS: usize = 24;
/// Engines run only on chains of at most this many four-bars.
const MOST_ENGINES: usize = 10;

/// A chain of `count` four-bars that are nearly parallelograms.
/// The bars differ in length by only some thousandths of `BAR`. All bars therefore stay nearly parallel to the crank,
/// and no four-bar comes near a dead point.
pub(in crate::stress) fn chain(count: usize, speed: f64) -> Result<Case> {
    let length = |k: usize| BAR * (1.0 + 2e-3 * (k as f64).sin());
    let rod = |length: f64| (10.0 * length, [0.5 * length, 0.05 * length], 10.0 * length.powi(3) / 12.0);
    let names = |k: usize| ["O", "A", "B", "bar", "rod"].map(|word| format!("{word}{k}"));
    let pivots: Vec<String> = (0..=count).map(|k| format!("O{k}")).collect();
    let places = pivots.iter().enumerate().map(|(k, name)| (name.as_str(), [PITCH * k as f64, 0.0]));
    let mut builder = Case::builder().ground(&places.collect::<Vec<_>>());
    for k in 0..=count {
        // Points A and B of a bar coincide.
        // The rod that drives the bar is joined at A. The rod that the bar drives is joined at B.
        let [o, a, b, bar, rod_name] = &names(k);
        let (end, (mass, centre, inertia)) = ([length(k), 0.0], rod(length(k)));
        builder = builder.link(bar, &[(o, [0.0; 2]), (a, end), (b, end)]).mass(bar, mass, centre, inertia);
        builder = builder.pin(o, "ground", bar);
        if k > 0 {
            let [_, _, before, bar_before, _] = &names(k - 1);
            let (mass, centre, inertia) = rod(PITCH);
            builder = builder
                .link(rod_name, &[(before, [0.0; 2]), (a, [PITCH, 0.0])])
                .mass(rod_name, mass, centre, inertia)
                .pin(before, bar_before, rod_name)
                .pin(a, rod_name, bar)
                .mode(&[rod_name, bar], AssemblyMode::Left);
        }
    }
    let times: Vec<f64> =
        (0..=INSTANTS).map(|k| (ANGLES[1] - ANGLES[0]) * k as f64 / INSTANTS as f64 / speed).collect();
    builder.gravity([0.0, -9.81]).crank("O0", speed).start(ANGLES[0]).times(&times).build()
}

/// Family that varies the number of four-bars in a chain.
pub(super) const CHAIN: StressFamily = StressFamily {
    name: "chain",
    dial: "number of four-bars in the chain",
    title: "a chain of up to 1000 four-bars, each driven by the rocker of the previous one",
    points: &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0],
    quick: &[1.0, 5.0, 20.0],
    samples: 1,
    setup: |count, _, _| {
        let usual = Setup::usual(chain(count as usize, SPEED_OF_ALL)?);
        let engines = if count as usize > MOST_ENGINES { EngineUse::None } else { usual.engines };
        Ok(Setup { engines, ..usual })
    },
};
