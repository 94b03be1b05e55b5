//! Labelled points of hodographs: the label is the crank angle at which the vector ends at the point.

use linkage::input::Input;
use linkage::math::KeepNan;

/// Steps between labelled crank angles (deg).
const STEPS: [f64; 7] = [15.0, 30.0, 45.0, 60.0, 90.0, 180.0, 360.0];
/// Largest number of labelled points: on the only hodograph of a chart, and on each of several hodographs.
pub(super) const MOST: [f64; 2] = [12.0, 6.0];

/// The rows whose inputs are nearest to round values, with the round values as labels.
/// If several rows have the same position of the driving link, the first of these rows is labelled.
pub(super) fn labelled(input: Input, inputs: &[f64], most: f64) -> Vec<(usize, String)> {
    let shown: Vec<f64> = inputs.iter().map(|value| input.shown(*value)).collect();
    let [low, high] = linkage::math::statistics::ends(shown.iter().copied());
    let turn = input.period().map(|(turn, _)| input.shown(turn));
    let span = turn.map_or(high - low, |turn| (high - low).smaller(turn));
    let usual = STEPS.into_iter().find(|step| span / step <= most + 1e-9);
    let step = match turn {
        Some(turn) => usual.unwrap_or(turn),
        None => drawing::paper::scale::round_up(span / most),
    };
    let spacing = (high - low) / (shown.len().max(2) - 1) as f64;
    let mut labels: Vec<(usize, String)> = Vec::new();
    let [first, last] = [(low / step - 1e-9).ceil(), (high / step + 1e-9).floor()];
    for k in 0..=(last - first).larger(0.0).smaller(1000.0) as u32 {
        let value = (first + f64::from(k)) * step;
        let off = |row: &usize| (shown[*row] - value).abs();
        let Some(row) = (0..shown.len()).min_by(|a, b| off(a).total_cmp(&off(b))) else { break };
        let label = turn.map_or(value, |turn| if value.abs() >= turn { value % turn } else { value });
        let text = format!("{}{}", label + 0.0, input.sign()).replace('-', "−");
        if off(&row) <= 0.5 * spacing + 1e-9 && labels.iter().all(|(_, known)| *known != text) {
            labels.push((row, text));
        }
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_has_twelve_labels_and_its_end_is_its_start() {
        let inputs: Vec<f64> = (0..=360).map(|k| f64::from(k).to_radians()).collect();
        let found = labelled(Input::Angle, &inputs, MOST[0]);
        assert_eq!(found.len(), 12);
        assert_eq!((found[1].0, found[1].1.as_str()), (30, "30°"));
        let slide: Vec<f64> = (0..=10).map(|k| 0.3 + 0.01 * f64::from(k)).collect();
        assert_eq!(labelled(Input::Slide, &slide, MOST[0])[0], (0, "300 mm".into()));
        assert_eq!(labelled(Input::Angle, &[0.5], MOST[0]), []);
    }
}
