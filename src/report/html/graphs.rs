//! Reduced inertia and motor as curves for the script of a page.

use serde_json::{Value, json};

use super::markup::singles;
use super::thinned::ends;
use crate::report::pretty::list;
use design::diagram::Graphs;
use linkage::case::Case;
use linkage::drive::{Motor, MotorLaw};
use linkage::math::KeepNan;
use linkage::trajectory::{Channel, Trajectory};

/// Number of intervals of the motor's curve.
const POINTS: u32 = 240;
/// Two speeds are compared: the largest speed of the run and the no-load speed of the motor.
/// The speed axis of the motor's curve ends at this multiple of the larger one.
const BEYOND: f64 = 1.15;

/// Graphs over the crank angle.
pub(super) fn over_crank(graphs: &Graphs) -> Value {
    let each = list(&graphs.graphs, |graph| {
        let [x, y] = [0, 1].map(|axis| singles(graph.points.iter().map(move |point| point[axis])));
        let marks = graph.marks.map(|mark| json!({ "word": mark.word, "at": mark.at }));
        json!({
            "name": graph.name, "symbol": graph.symbol, "unit": graph.unit, "x": x, "y": y,
            "mean": graph.mean, "mean_word": graph.mean_word, "marks": marks, "constant": graph.is_constant(),
        })
    });
    json!({ "period": graphs.period, "graphs": each, "note": graphs.notes.last() })
}

/// The moment of the motor on the crank as a function of the crank's speed, in the motor's direction; `null` without a
/// motor.
pub(super) fn motor(case: &Case, trajectory: &Trajectory) -> Value {
    let Some(motor) = case.crank().motor() else { return Value::Null };
    let sense = case.crank().sense();
    let link = &case.mechanism.links()[case.crank().link].name;
    let column = Channel::named(&format!("link.{link}.omega_rad_s"))
        .and_then(|speed| trajectory.channels().iter().position(|own| *own == speed));
    let speeds = column.map(|index| trajectory.iter().nth(index).map_or(&[][..], |(_, values)| values));
    let run = ends(speeds.into_iter().flatten().map(|speed| sense * speed));
    let most = BEYOND * run[1].larger(no_load(motor)).larger(1e-9);
    let least = run[0].smaller(0.0);
    let speed = |k: u32| least + (most - least) * f64::from(k) / f64::from(POINTS);
    let [x, y] = [singles((0..=POINTS).map(speed)), singles((0..=POINTS).map(|k| motor.moment_on_crank(speed(k))))];
    json!({ "x": x, "y": y, "sense": sense, "speed": column, "ratio": motor.ratio, "efficiency": motor.efficiency })
}

/// The crank's speed (rad/s) at which the motor has no moment; 0 if the motor's law has no such speed.
/// For a table, the last speed of the table.
fn no_load(motor: &Motor) -> f64 {
    let own = match &motor.law {
        MotorLaw::Constant { .. } => 0.0,
        MotorLaw::Linear { at_rest, slope } => {
            if *slope < 0.0 {
                -at_rest / slope
            } else {
                0.0
            }
        }
        MotorLaw::Kloss { synchronous_speed, .. } => *synchronous_speed,
        MotorLaw::Table { speeds, .. } => speeds.last().copied().unwrap_or_default(),
    };
    own / motor.ratio
}
