//! Summary of a sweep: the statistics of every figure, the best cases, and a sample of all cases.

use std::collections::BTreeMap;
use std::path::Path;

use linkage::error::Result;

use crate::groups::SweepGroups;
use crate::plan::SweepPlan;
use crate::table::RowGroup;

/// A solved case.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepRow {
    /// Index of the case.
    pub case: u64,
    /// Values of the varied numbers.
    pub values: Vec<f64>,
    /// Figures; NaN where a figure does not exist.
    pub figures: Vec<f64>,
}

/// Statistics of a figure over all cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureSpread {
    /// Number of cases in which the figure exists.
    pub count: u64,
    /// Smallest value and its case.
    pub least: (f64, u64),
    /// Largest value and its case.
    pub most: (f64, u64),
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample; 0 for a single case.
    pub deviation: f64,
}

/// Figure by which cases are ranked, and whether its smallest or largest values are the best. By default the smallest
/// values of the first figure are the best.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Goal {
    /// Index of the figure.
    pub figure: usize,
    /// Whether the largest values are the best.
    pub is_largest: bool,
}

impl Goal {
    /// Number by which cases are sorted; the best value of the figure gives the smallest number.
    fn rank(self, value: f64) -> f64 {
        if self.is_largest { -value } else { value }
    }
}

/// Reasons of refusals, counted. The key is the reason without digits. The value is the first such reason with its
/// digits, and the number of such reasons.
pub type Reasons = BTreeMap<String, (String, u64)>;

/// Largest number of different reasons that are counted.
const MOST_REASONS: usize = 100;

/// Counts a reason `count` times. Reasons that differ only in numbers have the same `kind`, and are counted together.
fn count_reason(reasons: &mut Reasons, kind: String, reason: &str, count: u64) {
    if reasons.len() < MOST_REASONS || reasons.contains_key(&kind) {
        reasons.entry(kind).or_insert_with(|| (reason.to_string(), 0)).1 += count;
    }
}

/// Summary of the table of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct SweepSummary {
    /// Number of cases.
    pub cases: u64,
    /// Number of cases that were refused.
    pub refused: u64,
    /// Reasons of refusals.
    pub reasons: Reasons,
    /// Index of the first case whose proof disagrees.
    pub disagreement: Option<u64>,
    /// Number of proven cases for each verdict.
    pub verdicts: BTreeMap<String, u64>,
    /// Statistics of every figure; `None` if the figure exists in no case.
    pub figures: Vec<Option<FigureSpread>>,
    /// The best cases, the best one first.
    pub best: Vec<SweepRow>,
    /// A sample of the solved cases: all cases whose index is a multiple of a fixed number.
    pub sample: Vec<SweepRow>,
}

/// Number of best cases.
pub const BEST: usize = 10;
/// Largest number of cases in the sample.
pub const SAMPLE: u64 = 2000;

impl SweepSummary {
    /// Reads the table of a sweep, row group by row group.
    ///
    /// # Errors
    /// The errors of [`SweepGroups`].
    pub fn of(plan: &SweepPlan, table: &Path, goal: Goal) -> Result<SweepSummary> {
        Ok(SweepSummary::read(plan, table, 0, goal)?.finished())
    }

    /// Reads a table whose first row is the case `first`. The summary is not [finished](Self::finished).
    pub(crate) fn read(plan: &SweepPlan, table: &Path, first: u64, goal: Goal) -> Result<SweepSummary> {
        let mut summary = SweepSummary::none(plan);
        for group in SweepGroups::of(plan, table)? {
            let next = SweepSummary::of_rows(plan, first + summary.cases, &group?, goal);
            summary.add(next, goal);
        }
        Ok(summary)
    }

    /// The summary of no case.
    pub(crate) fn none(plan: &SweepPlan) -> SweepSummary {
        SweepSummary {
            cases: 0,
            refused: 0,
            reasons: BTreeMap::new(),
            disagreement: None,
            verdicts: BTreeMap::new(),
            figures: vec![None; plan.figures.len()],
            best: Vec::new(),
            sample: Vec::new(),
        }
    }

    /// The summary of some rows, before [`finished`](Self::finished). `first` is the index of the first case.
    pub(crate) fn of_rows(plan: &SweepPlan, first: u64, rows: &RowGroup, goal: Goal) -> SweepSummary {
        let every = plan.design.cases().div_ceil(SAMPLE).max(1);
        let mut summary = SweepSummary::none(plan);
        summary.cases = rows.reasons.len() as u64;
        summary.figures = rows.figures.iter().map(|column| FigureSpread::of(column, first)).collect();
        for reason in rows.reasons.iter().flatten() {
            summary.refused += 1;
            let kind = reason.chars().filter(|sign| !sign.is_ascii_digit()).collect();
            count_reason(&mut summary.reasons, kind, reason, 1);
        }
        for (case, verdict) in (first..).zip(&rows.verdicts) {
            let Some(verdict) = verdict else { continue };
            *summary.verdicts.entry(verdict.clone()).or_default() += 1;
            if verdict == "disagree" {
                summary.disagreement = summary.disagreement.or(Some(case));
            }
        }
        // The rank of the worst of the best cases so far.
        let mut last = f64::INFINITY;
        for (row, case) in (0..rows.reasons.len()).zip(first..) {
            let this = || SweepRow {
                case,
                values: rows.values.iter().map(|column| column[row]).collect(),
                figures: rows.figures.iter().map(|column| column[row]).collect(),
            };
            let is_solved = || rows.reasons[row].is_none();
            if case.is_multiple_of(every) && is_solved() {
                summary.sample.push(this());
            }
            let rank = goal.rank(rows.figures[goal.figure][row]);
            if (rank < last || summary.best.len() < BEST) && !rank.is_nan() && is_solved() {
                let at = summary.best.partition_point(|own| goal.rank(own.figures[goal.figure]) <= rank);
                summary.best.insert(at, this());
                summary.best.truncate(BEST);
                last = goal.rank(summary.best[summary.best.len() - 1].figures[goal.figure]);
            }
        }
        summary
    }

    /// Adds the summary of the next cases. Neither summary is [finished](Self::finished).
    pub(crate) fn add(&mut self, next: SweepSummary, goal: Goal) {
        self.cases += next.cases;
        self.refused += next.refused;
        self.disagreement = self.disagreement.or(next.disagreement);
        for (kind, (reason, count)) in next.reasons {
            count_reason(&mut self.reasons, kind, &reason, count);
        }
        for (verdict, count) in next.verdicts {
            *self.verdicts.entry(verdict).or_default() += count;
        }
        for (own, next) in self.figures.iter_mut().zip(next.figures) {
            *own = FigureSpread::joined(*own, next);
        }
        // If two cases have the same figure, the case with the smaller index ranks first: the sort is stable.
        self.best.extend(next.best);
        self.best.sort_by(|a, b| {
            let [a, b] = [a, b].map(|own| goal.rank(own.figures[goal.figure]));
            a.partial_cmp(&b).expect("the best cases have a figure")
        });
        self.best.truncate(BEST);
        self.sample.extend(next.sample);
    }

    /// The summary of all cases: the sums of squares become standard deviations.
    pub(crate) fn finished(mut self) -> SweepSummary {
        for spread in self.figures.iter_mut().flatten().filter(|spread| spread.count > 1) {
            spread.deviation = (spread.deviation / (spread.count - 1) as f64).sqrt();
        }
        self
    }
}

impl FigureSpread {
    /// The statistics of a column whose first row is the case `first`; `None` if all values are NaN.
    /// Here, `deviation` is still the sum of the squared deviations from the mean, not the standard deviation.
    fn of(column: &[f64], first: u64) -> Option<FigureSpread> {
        let present = || (first..).zip(column).filter(|(_, value)| !value.is_nan());
        let (case, &first_value) = present().next()?;
        let (mut count, mut sum, mut least, mut most) = (0, 0.0, (first_value, case), (first_value, case));
        for (case, &value) in present() {
            (count, sum) = (count + 1, sum + (value - first_value));
            least = if value < least.0 { (value, case) } else { least };
            most = if value > most.0 { (value, case) } else { most };
        }
        // If all values are equal, the mean is exactly this value.
        let mean = first_value + sum / count as f64;
        let deviation = present().map(|(_, value)| (value - mean).powi(2)).sum();
        Some(FigureSpread { count, least, most, mean, deviation })
    }

    /// The statistics of two columns. The sums of squares about the joint mean follow from those about the two means by
    /// Steiner's theorem.
    fn joined(one: Option<FigureSpread>, other: Option<FigureSpread>) -> Option<FigureSpread> {
        let (Some(one), Some(other)) = (one, other) else { return one.or(other) };
        let count = one.count + other.count;
        let (apart, share) = (other.mean - one.mean, other.count as f64 / count as f64);
        Some(FigureSpread {
            count,
            least: if other.least.0 < one.least.0 { other.least } else { one.least },
            most: if other.most.0 > one.most.0 { other.most } else { one.most },
            mean: one.mean + apart * share,
            deviation: one.deviation + other.deviation + apart * apart * share * one.count as f64,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn joined(parts: &[&[f64]]) -> Option<FigureSpread> {
        let mut first = 0;
        parts.iter().fold(None, |before, part| {
            let own = FigureSpread::of(part, first);
            first += part.len() as u64;
            FigureSpread::joined(before, own)
        })
    }

    #[test]
    fn statistics_do_not_depend_on_the_parts() {
        let column: Vec<f64> = (0..40).map(|k| 1e3 + f64::from(k * k % 17) - f64::from(k)).collect();
        let whole = joined(&[&column]).unwrap();
        let nan = f64::NAN;
        for parts in [vec![&column[..7], &column[7..]], vec![&column[..1], &[], &column[1..30], &column[30..]]] {
            let found = joined(&parts).unwrap();
            assert_eq!((found.count, found.least, found.most), (40, whole.least, whole.most));
            assert_relative_eq!(found.mean, whole.mean, max_relative = 1e-14);
            assert_relative_eq!(found.deviation, whole.deviation, max_relative = 1e-12);
        }
        // Cases without a value do not count; equal values have no deviation.
        let found = joined(&[&[nan, 0.1], &[nan], &[0.1, nan, 0.1]]).unwrap();
        assert_eq!((found.count, found.least, found.most), (3, (0.1, 1), (0.1, 1)));
        assert_eq!((found.mean, found.deviation), (0.1, 0.0));
        assert!(joined(&[&[nan], &[]]).is_none());
    }
}
