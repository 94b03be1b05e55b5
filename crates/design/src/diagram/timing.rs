//! Timing diagram: the motion of an output over one turn, with the required phases.

use std::f64::consts::TAU;

/// A phase of the required motion, as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Crank angle at the start of the phase (rad).
    pub from: f64,
    /// Crank angle at the end of the phase (rad).
    pub to: f64,
    /// Required motion of the output.
    pub word: &'static str,
    /// Required sense: +1 forward, -1 back, 0 for a dwell.
    pub sign: f64,
    /// Achieved motion, in a few characters.
    pub figure: String,
    /// Line that shows the required travel, as fractions of the stroke at its two ends.
    /// The line goes from the achieved position at the phase's start to the position required at the phase's end.
    pub least: [f64; 2],
}

/// Timing diagram: the output as a fraction of the stroke over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TimingDiagram {
    /// Achieved curve: crank angle (rad) and fraction of the stroke.
    pub curve: Vec<[f64; 2]>,
    /// Required curve: crank angle (rad) and fraction of the stroke.
    /// The curve is empty if only senses of motion are required.
    pub wanted: Vec<[f64; 2]>,
    /// Phases.
    pub stretches: Vec<Stretch>,
    /// Main values of the motion, separated by `; `.
    pub note: String,
}

impl TimingDiagram {
    /// The diagram with all crank angles increased by `offset` (rad).
    /// Phases and parts of curves beyond the end of the turn continue at the beginning of the turn.
    #[must_use]
    pub fn shifted(self, offset: f64) -> TimingDiagram {
        let offset = offset.rem_euclid(TAU);
        if offset == 0.0 {
            return self;
        }
        let mut stretches = Vec::new();
        for mut own in self.stretches {
            own.from += offset;
            own.to += offset;
            if own.from >= TAU {
                (own.from, own.to) = (own.from - TAU, own.to - TAU);
            } else if own.to > TAU {
                let part = (TAU - own.from) / (own.to - own.from);
                let level = own.least[0] + part * (own.least[1] - own.least[0]);
                let rest = Stretch { from: 0.0, to: own.to - TAU, least: [level, own.least[1]], ..own.clone() };
                (own.to, own.least[1]) = (TAU, level);
                stretches.push(rest);
            }
            stretches.push(own);
        }
        stretches.sort_by(|a, b| a.from.total_cmp(&b.from));
        TimingDiagram { curve: turned(self.curve, offset), wanted: turned(self.wanted, offset), stretches, ..self }
    }
}

/// The curve of one turn, moved by `offset` (rad, below a turn).
/// The moved curve has a point at the start of the turn and a point at the end.
fn turned(mut curve: Vec<[f64; 2]>, offset: f64) -> Vec<[f64; 2]> {
    let Some(last) = curve.pop() else { return curve };
    let split = curve.partition_point(|point| point[0] + offset < TAU);
    curve.push(last);
    let [before, after] = [split.saturating_sub(1), split.min(curve.len() - 1)].map(|row| curve[row]);
    let part = if after[0] > before[0] { (TAU - offset - before[0]) / (after[0] - before[0]) } else { 0.0 };
    let seam = before[1] + part * (after[1] - before[1]);
    curve.pop();
    let moved = |way: f64| move |point: &[f64; 2]| [point[0] + way, point[1]];
    let mut all = vec![[0.0, seam]];
    all.extend(curve[split..].iter().map(moved(offset - TAU)));
    all.extend(curve[..split].iter().map(moved(offset)));
    all.push([TAU, seam]);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shifted_diagram_keeps_its_curve_and_splits_what_passes_the_end() {
        let stretch =
            |from: f64, to: f64, sign| Stretch { from, to, word: "", sign, figure: String::new(), least: [0.0, 1.0] };
        let curve: Vec<[f64; 2]> = (0..=36).map(|k| TAU * f64::from(k) / 36.0).map(|x| [x, x.cos()]).collect();
        let diagram = TimingDiagram {
            curve,
            wanted: Vec::new(),
            stretches: vec![stretch(0.0, 3.0, 1.0), stretch(3.0, TAU, -1.0)],
            note: String::new(),
        };
        let found = diagram.clone().shifted(1.0 - TAU);
        let ends: Vec<[f64; 2]> = found.stretches.iter().map(|own| [own.from, own.to]).collect();
        assert_eq!(ends, [[0.0, 1.0], [1.0, 4.0], [4.0, TAU]]);
        assert!(found.curve.windows(2).all(|pair| pair[0][0] <= pair[1][0]) && found.wanted.is_empty());
        // A chord of 10 deg deviates from the cosine by less than 0.004.
        assert!(found.curve.iter().all(|[x, y]| (y - (x - 1.0).cos()).abs() < 4e-3), "{:?}", found.curve);
        assert_eq!(diagram.clone().shifted(TAU), diagram);
    }
}
