//! Summary of a sweep: the statistics of every figure, the best cases, and a sample of all cases.

use std::collections::BTreeMap;
use std::path::Path;

use linkage::error::Result;

use crate::groups::{RowGroup, SweepGroups};
use crate::plan::SweepPlan;

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

/// Figure by which cases are ranked, and whether its smallest or largest values are the best.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Counts a reason. Reasons that differ only in numbers are counted together.
fn count_reason(reasons: &mut Reasons, reason: &str) {
    let kind: String = reason.chars().filter(|sign| !sign.is_ascii_digit()).collect();
    if reasons.len() < MOST_REASONS || reasons.contains_key(&kind) {
        reasons.entry(kind).or_insert_with(|| (reason.to_string(), 0)).1 += 1;
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
        let groups = SweepGroups::of(plan, table)?;
        let (cases, figures) = (groups.cases(), plan.figures.len());
        let every = cases.div_ceil(SAMPLE).max(1);
        let mut summary = SweepSummary {
            cases,
            refused: 0,
            reasons: BTreeMap::new(),
            verdicts: BTreeMap::new(),
            figures: vec![None; figures],
            best: Vec::new(),
            sample: Vec::new(),
        };
        // Sums of squared deviations from the running mean (Welford 1962).
        let mut squares = vec![0.0; figures];
        let mut case = 0;
        for group in groups {
            let group = group?;
            for row in 0..group.reasons.len() {
                summary.add(&group, row, case, &mut squares);
                let is_solved = group.reasons[row].is_none();
                let rank = goal.rank(group.figures[goal.figure][row]);
                let of = |row: usize| SweepRow {
                    case,
                    values: group.values.iter().map(|column| column[row]).collect(),
                    figures: group.figures.iter().map(|column| column[row]).collect(),
                };
                if is_solved && case % every == 0 {
                    summary.sample.push(of(row));
                }
                // If two cases have the same figure, the case with the smaller index ranks first.
                let at = summary.best.partition_point(|own| goal.rank(own.figures[goal.figure]) <= rank);
                if is_solved && !rank.is_nan() && at < BEST {
                    summary.best.insert(at, of(row));
                    summary.best.truncate(BEST);
                }
                case += 1;
            }
        }
        for (spread, squares) in summary.figures.iter_mut().zip(squares) {
            if let Some(spread) = spread.as_mut().filter(|spread| spread.count > 1) {
                spread.deviation = (squares / (spread.count - 1) as f64).sqrt();
            }
        }
        Ok(summary)
    }

    fn add(&mut self, group: &RowGroup, row: usize, case: u64, squares: &mut [f64]) {
        if let Some(reason) = &group.reasons[row] {
            self.refused += 1;
            count_reason(&mut self.reasons, reason);
        }
        if let Some(Some(verdict)) = group.verdicts.get(row) {
            *self.verdicts.entry(verdict.clone()).or_default() += 1;
        }
        for ((spread, squares), column) in self.figures.iter_mut().zip(squares).zip(&group.figures) {
            let value = column[row];
            if value.is_nan() {
                continue;
            }
            let none = FigureSpread { count: 0, least: (value, case), most: (value, case), mean: 0.0, deviation: 0.0 };
            let spread = spread.get_or_insert(none);
            spread.count += 1;
            if value < spread.least.0 {
                spread.least = (value, case);
            }
            if value > spread.most.0 {
                spread.most = (value, case);
            }
            let off = value - spread.mean;
            spread.mean += off / spread.count as f64;
            *squares += off * (value - spread.mean);
        }
    }
}
