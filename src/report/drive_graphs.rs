//! The reduced quantities and the steady motion of a mechanism as graphs.

use crate::scenario::Scenario;
use analytic::reduced::means::Means;
use analytic::reduced::{ACCURACY, Model};
use analytic::steady::Regime;
use analytic::steady::course::{Extremes, Row};
use linkage::error::Result;
use linkage::math::KeepNan;
use workshop::diagram::{Graph, Graphs, Mark, draw};

/// Equal parts of the period, at whose ends graphs have points: half a degree over one turn.
const PARTS: u32 = 720;

/// The graphs as an SVG document. `extremes`: of inertia and resistance; `steady`: the steady motion, where there is a motor.
pub(crate) fn draw(
    scenario: &Scenario,
    model: &Model,
    means: &Means,
    extremes: &[Extremes; 2],
    steady: Option<&Regime>,
) -> Result<String> {
    let case = &scenario.case;
    let (start, sense) = (case.crank().start, case.crank().sense());
    let period = model.kinks().period.unwrap_or(std::f64::consts::TAU);
    let even: Vec<f64> = (0..=PARTS).map(|k| start + sense * period * (f64::from(k) / f64::from(PARTS))).collect();
    let kinks = model.kinks().cranks.iter().map(|kink| start + sense * (sense * (kink - start)).rem_euclid(period));
    let mut cranks: Vec<f64> = even.iter().copied().chain(kinks).collect();
    cranks.sort_by(|a, b| (sense * a).total_cmp(&(sense * b)));
    let rows = model.rows(&cranks)?;
    let points = |of: fn(&Row) -> f64| rows.iter().map(|row| [row.crank, of(row)]).collect::<Vec<[f64; 2]>>();
    let reduced = |[name, symbol, unit]: [&'static str; 3], of: fn(&Row) -> f64, mean, found: &Extremes| {
        let marks = [("least", found.least), ("greatest", found.greatest)];
        let marks = marks.map(|(word, (crank, value))| Mark { at: [crank, value], word });
        let size = found.least.1.abs().larger(found.greatest.1.abs());
        Graph { name, symbol, unit, points: points(of), mean, mean_word: "mean", marks, size }
    };
    let slope = model.slope_extremes()?;
    let mut graphs = vec![
        reduced(["reduced moment of inertia", "I*", "kg m^2"], |row| row.inertia, means.inertia, &extremes[0]),
        Graph {
            // A constant inertia has a derivative of roundings.
            size: extremes[0].greatest.1.larger(slope.greatest.1),
            // After a period the inertia is what it was.
            ..reduced(["derivative of the reduced moment of inertia", "dI*/dφ", "kg m^2"], |row| row.slope, 0.0, &slope)
        },
        reduced(
            ["reduced moment of resistance", "M_r", "N m"],
            |row| row.resistance,
            sense * means.resistance,
            &extremes[1],
        ),
    ];
    let turns = (period / std::f64::consts::TAU).round();
    let over = if turns > 1.0 { format!("{turns} turns") } else { "one turn".into() };
    let mut note =
        format!("over {over} of the crank in the sense of its motion; motor, reducer and flywheel left out of I*");
    if let Some(steady) = steady {
        let regime = model.regime_at(steady, &even, ACCURACY)?;
        let mut marks = [("slowest", regime.slowest), ("fastest", regime.fastest)]
            .map(|(word, at)| Mark { at: [at.crank, at.omega], word });
        // The lower one on paper comes first.
        marks.sort_by(|a, b| a.at[1].total_cmp(&b.at[1]));
        graphs.push(Graph {
            name: "angular velocity of the crank in the steady motion",
            symbol: "ω",
            unit: "rad/s",
            points: regime.samples.iter().map(|at| [at.crank, at.omega]).collect(),
            mean: regime.mean_speed,
            mean_word: "mean over time",
            marks,
            size: regime.mean_speed,
        });
        note += &format!("; non-uniformity {:.6}", regime.non_uniformity());
    }
    let graphs = Graphs { period: [start, start + sense * period], graphs, notes: vec![scenario.title.clone(), note] };
    Ok(draw::graphs(&graphs, &scenario.name))
}
