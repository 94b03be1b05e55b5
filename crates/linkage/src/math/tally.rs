//! Statistics of a quantity that has one value per row. Eight rows are added at a time, each in its own lane.
//!
//! The order of the operations depends only on the rows. Equal values therefore give bit for bit equal results.

use std::array;
use std::sync::Arc;

/// Number of rows that are added at once.
pub const LANES: usize = 8;

/// For every lane: the largest score so far, and the first row that has this score.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct LanePeak {
    /// Largest scores.
    pub scores: [f64; LANES],
    /// Their rows.
    pub rows: [f64; LANES],
}

impl LanePeak {
    /// No row yet.
    pub const NONE: LanePeak = LanePeak { scores: [f64::NEG_INFINITY; LANES], rows: [0.0; LANES] };

    fn add(&mut self, row: usize, scores: [f64; LANES]) {
        for (lane, score) in scores.into_iter().enumerate() {
            if score > self.scores[lane] {
                (self.scores[lane], self.rows[lane]) = (score, (row + lane) as f64);
            }
        }
    }

    /// The largest score. A zero has no sign.
    fn highest(&self) -> f64 {
        self.scores.iter().fold(f64::NEG_INFINITY, |best, own| if *own > best { *own } else { best }) + 0.0
    }

    /// The first row with the largest score.
    fn first(&self) -> usize {
        let key = |lane: usize| (self.scores[lane], self.rows[lane]);
        let is_better =
            |(score, row): (f64, f64), (best, first): (f64, f64)| score > best || score == best && row < first;
        (1..LANES).map(key).fold(key(0), |best, own| if is_better(own, best) { own } else { best }).1 as usize
    }
}

/// A statistic of the rows so far.
#[derive(Clone, Debug, PartialEq)]
pub enum Tally {
    /// Largest value.
    Max(LanePeak),
    /// Smallest value.
    Min(LanePeak),
    /// Largest absolute value.
    MaxAbs(LanePeak),
    /// Largest minus smallest value.
    Range([LanePeak; 2]),
    /// Weighted sum.
    Mean(Weighted),
    /// Root of the weighted sum of the squares.
    Rms(Weighted),
    /// The value in a row.
    At(usize, f64),
    /// All values.
    Column(Vec<f64>),
}

/// A weighted sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Weighted {
    /// Weights of all rows, in groups of eight.
    pub weights: Arc<[[f64; LANES]]>,
    /// The sum of every lane.
    pub sums: [f64; LANES],
}

impl Weighted {
    /// A sum with one weight for each row.
    #[must_use]
    pub fn of(weights: &[f64]) -> Weighted {
        // If the last group has fewer than eight rows, weights of zero fill the group.
        let weight = |row: usize| weights.get(row).copied().unwrap_or(0.0);
        let blocks = (0..weights.len()).step_by(LANES);
        Weighted { weights: blocks.map(|row| array::from_fn(|lane| weight(row + lane))).collect(), sums: [0.0; LANES] }
    }

    fn add(&mut self, row: usize, values: [f64; LANES]) {
        let weights = &self.weights[row / LANES];
        for ((sum, weight), value) in self.sums.iter_mut().zip(weights).zip(values) {
            *sum += weight * value;
        }
    }

    fn sum(&self) -> f64 {
        self.sums.iter().sum()
    }
}

impl Tally {
    /// Forgets all rows.
    pub fn clear(&mut self) {
        match self {
            Tally::Max(peak) | Tally::Min(peak) | Tally::MaxAbs(peak) => *peak = LanePeak::NONE,
            Tally::Range(peaks) => *peaks = [LanePeak::NONE; 2],
            Tally::Mean(own) | Tally::Rms(own) => own.sums = [0.0; LANES],
            Tally::At(_, value) => *value = f64::NAN,
            Tally::Column(values) => values.clear(),
        }
    }

    /// Adds eight rows, beginning with `row`, a multiple of eight.
    /// If fewer than eight rows are left, the caller repeats the last row's value.
    pub fn add(&mut self, row: usize, values: &[f64; LANES]) {
        match self {
            Tally::Max(peak) => peak.add(row, *values),
            Tally::Min(peak) => peak.add(row, values.map(|value| -value)),
            Tally::MaxAbs(peak) => peak.add(row, values.map(f64::abs)),
            Tally::Range([most, least]) => {
                most.add(row, *values);
                least.add(row, values.map(|value| -value));
            }
            Tally::Mean(own) => own.add(row, *values),
            Tally::Rms(own) => own.add(row, values.map(|value| value * value)),
            Tally::At(wanted, value) => {
                *value = wanted.checked_sub(row).and_then(|at| values.get(at)).copied().unwrap_or(*value)
            }
            Tally::Column(all) => all.extend_from_slice(values),
        }
    }

    /// The value of the statistic. For a column, the last value of the column.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value_as(|value| value)
    }

    /// The statistic of the values `shown(value)`. The function `shown` must be odd and grow with the value.
    /// The result agrees bit for bit with the statistic of values that were converted one by one.
    /// For a mean, root mean square or column, `shown` is not applied.
    #[must_use]
    pub fn value_as(&self, shown: impl Fn(f64) -> f64) -> f64 {
        match self {
            Tally::Max(peak) | Tally::MaxAbs(peak) => shown(peak.highest()),
            Tally::Min(peak) => shown(0.0 - peak.highest()),
            Tally::Range([most, least]) => shown(most.highest()) - shown(0.0 - least.highest()),
            Tally::Mean(own) => own.sum(),
            Tally::Rms(own) => own.sum().sqrt(),
            Tally::At(_, value) => shown(*value),
            Tally::Column(values) => values.last().copied().unwrap_or(f64::NAN),
        }
    }

    /// The rows that determine the statistic. For an extreme value, this is the first row with that value.
    /// Only a range has two rows. Both entries are `None` if all rows count.
    #[must_use]
    pub fn rows(&self) -> [Option<usize>; 2] {
        match self {
            Tally::Max(peak) | Tally::Min(peak) | Tally::MaxAbs(peak) => [Some(peak.first()), None],
            Tally::Range(peaks) => peaks.map(|peak| Some(peak.first())),
            Tally::At(row, _) => [Some(*row), None],
            Tally::Mean(_) | Tally::Rms(_) | Tally::Column(_) => [None; 2],
        }
    }
}
