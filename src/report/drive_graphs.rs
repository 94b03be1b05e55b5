//! The reduced quantities and the steady motion of a mechanism as graphs.

use super::drive::Found;
use crate::sentences;
use analytic::steady::Regime;
use analytic::steady::course::{Extremes, ReducedRow};
use design::diagram::{CrankGraph, GraphPoint, Graphs};
use design::draw;
use drawing::paper::document::Drawing;
use linkage::math::KeepNan;
use scenario::Scenario;

/// Data of the curves.
pub(crate) struct Curves {
    /// The crank angle after which the reduced quantities repeat (rad).
    pub(crate) period: f64,
    /// The reduced quantities over one period, in the direction of the motion.
    pub(crate) rows: Vec<ReducedRow>,
    /// Extremes of dI*/dphi.
    pub(crate) slope: Extremes,
    /// The steady motion with samples over one period, if there is a motor.
    pub(crate) steady: Option<Regime>,
}

/// The graphs as a drawing.
pub(crate) fn draw(scenario: &Scenario, found: &Found, curves: &Curves) -> Drawing {
    draw::graphs(&graphs(scenario, found, curves), &scenario.name)
}

/// The graphs as data.
pub(crate) fn graphs(scenario: &Scenario, found: &Found, curves: &Curves) -> Graphs {
    let Curves { period, rows, slope, steady } = curves;
    let (start, sense) = (scenario.case.crank().start, scenario.case.crank().sense());
    let points = |of: fn(&ReducedRow) -> f64| rows.iter().map(|row| [row.crank, of(row)]).collect::<Vec<[f64; 2]>>();
    let reduced = |[name, symbol, unit]: [&'static str; 3], of: fn(&ReducedRow) -> f64, mean, ends: &Extremes| {
        let marks = [("least", ends.least), ("greatest", ends.greatest)];
        let marks = marks.map(|(word, (crank, value))| GraphPoint { at: [crank, value], word });
        let size = ends.least.1.abs().larger(ends.greatest.1.abs());
        CrankGraph { name, symbol, unit, points: points(of), mean, mean_word: "mean", marks, size }
    };
    let (means, [inertia, resistance]) = (&found.means, &found.extremes);
    let rate = reduced([sentences::DERIVATIVE_OF_THE_REDUCED_MOMENT, "dI*/dφ", "kg m^2"], |row| row.slope, 0.0, slope);
    let mut graphs = vec![
        reduced([sentences::REDUCED_MOMENT_OF_INERTIA, "I*", "kg m^2"], |row| row.inertia, means.inertia, inertia),
        // If the inertia is constant, its derivative is only rounding error.
        // The reference value of the derivative is therefore at least the largest inertia, so that such a derivative
        // counts as constant.
        CrankGraph { size: inertia.greatest.1.larger(slope.greatest.1), ..rate },
        reduced(
            [sentences::REDUCED_MOMENT_OF_RESISTANCE, "M_r", "N m"],
            |row| row.resistance,
            sense * means.resistance,
            resistance,
        ),
    ];
    let turns = (period / std::f64::consts::TAU).round();
    let over = if turns > 1.0 { format!("{turns} turns") } else { "one turn".into() };
    let mut note = sentences::over_of_the_crank_in_the_sense(&over);
    if let Some(regime) = steady {
        let mut marks = [("slowest", regime.slowest), ("fastest", regime.fastest)]
            .map(|(word, at)| GraphPoint { at: [at.crank, at.omega], word });
        // The marks are sorted by speed, the lower one first.
        marks.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
        graphs.push(CrankGraph {
            name: sentences::ANGULAR_VELOCITY_OF_THE_CRANK,
            symbol: "ω",
            unit: "rad/s",
            points: regime.samples.iter().map(|at| [at.crank, at.omega]).collect(),
            mean: regime.mean_speed,
            mean_word: sentences::MEAN_OVER_TIME,
            marks,
            size: regime.mean_speed,
        });
        note += &sentences::non_uniformity(&regime.non_uniformity());
    }
    Graphs { period: [start, start + sense * period], graphs, notes: vec![scenario.title.clone(), note] }
}
