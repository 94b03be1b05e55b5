//! Ticks of an axis at round numbers, and the power of ten before the unit of the axis.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::chart::PlotAxis;
use crate::paper::figure::scripted;
use crate::paper::scale::{multiple, round_up};
use linkage::math::KeepNan;

/// Steps between the ticks of an axis of angles (deg). Larger steps are multiples of a turn.
const DEGREES: [f64; 12] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];
/// If the largest magnitude of an axis lies outside these limits, a power of ten stands before the unit.
const PLAIN: [f64; 2] = [0.01, 1e5];
/// If an end of the axis differs from a multiple of the step by at most this fraction of a step, the end counts as this
/// multiple.
const SAME: f64 = 1e-6;

/// Ticks of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    /// First and last value of the axis.
    pub(super) ends: [f64; 2],
    /// Values of the ticks.
    pub(super) values: Vec<f64>,
    /// Difference of two neighbouring ticks.
    step: f64,
    /// Exponent of the power of ten in the axis label. The number printed at a tick is the tick's value divided by this
    /// power of ten.
    power: i32,
}

impl Ticks {
    /// Ticks of an axis of the length `long` (mm) for values from `low` to `high`.
    /// The distance between neighbouring ticks is at least `apart` (mm).
    /// `noise` is the largest rounding error of the values. If the range of the values is at most twice this error,
    /// the values count as constant.
    pub(super) fn of(axis: &PlotAxis, [low, high]: [f64; 2], noise: f64, long: f64, apart: f64) -> Ticks {
        let count = (long / apart).floor().larger(1.0);
        let [low, high] = widened([low, high], noise, axis.degrees);
        let step = step(axis, (high - low) / count);
        let ends = match axis.rounded {
            true => [(low / step + SAME).floor() * step, (high / step - SAME).ceil() * step],
            false => [low, high],
        };
        Ticks::between(ends, step)
    }

    /// Ticks at all multiples of `step` between two values.
    pub(super) fn between([low, high]: [f64; 2], step: f64) -> Ticks {
        let (first, last) = ((low / step - SAME).ceil(), (high / step + SAME).floor());
        let count = (last - first).larger(0.0) as u32;
        // A tick that lies beyond an end because of rounding is moved to the end.
        let values = (0..=count).map(|k| ((first + f64::from(k)) * step + 0.0).larger(low).smaller(high));
        let size = low.abs().larger(high.abs());
        let power = if (PLAIN[0]..PLAIN[1]).contains(&size) || size == 0.0 { 0.0 } else { size.log10().floor() };
        Ticks { ends: [low, high], values: values.collect(), step, power: power as i32 }
    }

    /// Ticks with the same step between the ends `ends`.
    pub(super) fn over(&self, ends: [f64; 2]) -> Ticks {
        Ticks::between(ends, self.step)
    }

    /// The number at a tick.
    pub(super) fn number(&self, value: f64) -> String {
        let unit = 10f64.powi(self.power);
        // Rounding to ten digits removes the rounding error of the quotient.
        let round = |own: f64| format!("{:.9e}", own / unit).parse().unwrap_or(own / unit);
        multiple(round(value) + 0.0, round(self.step)).replace('-', "−")
    }

    /// Name of the axis, power of ten and unit.
    pub(super) fn label(&self, axis: &PlotAxis) -> String {
        let power = if self.power == 0 { String::new() } else { scripted(&format!("10^{}", self.power)) };
        let unit = [power.replace('-', "−"), axis.unit.clone()].into_iter().filter(|own| !own.is_empty());
        let unit = unit.collect::<Vec<_>>().join(" ");
        match (axis.name.is_empty(), unit.is_empty()) {
            (_, true) => axis.name.clone(),
            (true, false) => unit,
            (false, false) => format!("{}, {unit}", axis.name),
        }
    }
}

/// The interface through which `plotters` places grid lines and numbers.
impl Ranged for Ticks {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let share = (value - self.ends[0]) / (self.ends[1] - self.ends[0]);
        from + (share * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.values.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.ends[0]..self.ends[1]
    }
}

impl ValueFormatter<f64> for Ticks {
    fn format_ext(&self, value: &f64) -> String {
        self.number(*value)
    }
}

/// The smallest usual step that is at least `least`.
pub(super) fn step(axis: &PlotAxis, least: f64) -> f64 {
    match axis.degrees && least > DEGREES[0] / 2.0 {
        false => round_up(least),
        true => {
            let usual = DEGREES.into_iter().find(|own| *own >= least * (1.0 - SAME));
            usual.unwrap_or_else(|| 360.0 * round_up(least / 360.0).ceil().larger(1.0))
        }
    }
}

/// The range from `low` to `high`, widened if the values count as a constant.
fn widened([low, high]: [f64; 2], noise: f64, degrees: bool) -> [f64; 2] {
    let size = low.abs().larger(high.abs());
    if high - low > (2.0 * noise).larger(1e-9 * size) {
        return [low, high];
    }
    match size {
        _ if degrees => [low - 5.0, high + 5.0],
        _ if size <= noise => [-1.0, 1.0],
        _ => [low.smaller(0.0), high.larger(0.0)].map(|end| 1.25 * end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(degrees: bool, rounded: bool) -> PlotAxis {
        PlotAxis { name: "moment".into(), unit: "N·m".into(), degrees, rounded }
    }

    fn told(ticks: &Ticks) -> Vec<String> {
        ticks.values.iter().map(|value| ticks.number(*value)).collect()
    }

    #[test]
    fn ticks_are_round_and_include_the_ends() {
        let ticks = Ticks::of(&axis(true, false), [0.0, 360.0], 0.0, 140.0, 11.0);
        assert_eq!(told(&ticks).len(), 13);
        let ticks = Ticks::of(&axis(false, true), [-0.31, 1.27], 0.0, 50.0, 9.0);
        assert_eq!(told(&ticks), ["−0.5", "0.0", "0.5", "1.0", "1.5"]);
        let ticks = Ticks::of(&axis(true, false), [-720.0, 0.0], 0.0, 140.0, 11.0);
        assert_eq!(told(&ticks)[..2], ["−720", "−630"]);
    }

    #[test]
    fn small_and_large_numbers_put_a_power_of_ten_into_the_unit() {
        let ticks = Ticks::of(&axis(false, true), [0.0, 4.2e-9], 0.0, 50.0, 9.0);
        assert_eq!(told(&ticks), ["0", "1", "2", "3", "4", "5"]);
        let label = ticks.label(&axis(false, true));
        assert!(label.starts_with("moment, 10") && label.contains("−9") && label.ends_with(" N·m"), "{label:?}");
        assert_eq!(Ticks::of(&axis(false, true), [0.0, 40.0], 0.0, 50.0, 9.0).label(&axis(false, true)), "moment, N·m");
    }

    #[test]
    fn a_constant_is_drawn_on_an_axis_of_its_size_and_rounding_errors_as_zero() {
        let ends = |low, high, noise| Ticks::of(&axis(false, true), [low, high], noise, 50.0, 9.0).ends;
        assert_eq!(ends(20.0, 20.0 + 1e-13, 1e-12), [0.0, 25.0]);
        assert_eq!(ends(-1e-17, 3e-17, 1e-15), [-1.0, 1.0]);
        assert_eq!(ends(0.0, 0.0, 0.0), [-1.0, 1.0]);
        let one = Ticks::of(&axis(true, false), [90.0, 90.0], 0.0, 140.0, 11.0).ends;
        assert_eq!(one, [85.0, 95.0]);
    }
}
