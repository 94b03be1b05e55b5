//! The suspect's values at some instants, and the differences of a changed case from these values.

use std::cell::Cell;
use std::rc::Rc;

use super::cause::LateChannels;
use super::question::{DiagnosisInput, SuspectChannel};
use super::slips::known;
use crate::bounds::{differences, magnitudes};
use linkage::case::{Case, Grid};
use linkage::math::statistics::ascending;
use linkage::math::{KeepNan, largest_size};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage};

/// A judged channel with a bound above zero, and its values at the instants of a bench.
pub(super) struct Column {
    pub(super) channel: Channel,
    pub(super) bound: f64,
    pub(super) disagrees: bool,
    /// The suspect's values.
    values: Vec<f64>,
    /// The reference's values.
    right: Vec<f64>,
}

/// Some instants of the grid, with the suspect's values at these instants.
pub(super) struct Bench<'a> {
    /// The case on the grid of these instants.
    pub(super) case: Case,
    pub(super) columns: Vec<Column>,
    solver: &'a dyn Solver,
    /// Number of cases that may still be solved.
    left: Rc<Cell<usize>>,
}

/// Differences between the suspect and a hypothesis, each divided by its bound: column by column, instant by instant.
#[derive(Clone, Debug)]
pub(super) struct Misfit(pub(super) Vec<f64>);

impl Misfit {
    /// The largest ratio of a difference to its bound.
    pub(super) fn worst(&self) -> f64 {
        largest_size(&self.0)
    }

    /// Whether all differences are within their bounds.
    pub(super) fn fits(&self) -> bool {
        self.worst() <= 1.0
    }

    pub(super) fn dot(&self, other: &Misfit) -> f64 {
        self.0.iter().zip(&other.0).map(|(a, b)| a * b).sum()
    }

    pub(super) fn times(&self, factor: f64) -> Misfit {
        Misfit(self.0.iter().map(|value| factor * value).collect())
    }

    /// The sum of this misfit and `factor` times the misfit `other`.
    pub(super) fn plus(&self, factor: f64, other: &Misfit) -> Misfit {
        Misfit(self.0.iter().zip(&other.0).map(|(a, b)| a + factor * b).collect())
    }

    /// Range of factors f for which this misfit plus f times `effect` stays within all bounds. `None` if no factor
    /// keeps all bounds. Least squares are not used, because they fit random errors, and a suspect's errors are not
    /// random.
    pub(super) fn kept_by(&self, effect: &Misfit) -> Option<[f64; 2]> {
        let mut range = [f64::NEG_INFINITY, f64::INFINITY];
        for (own, change) in self.0.iter().zip(&effect.0) {
            let ends = [(-1.0 - own) / change, (1.0 - own) / change];
            if *change == 0.0 || ends.iter().any(|end| !end.is_finite()) {
                if !(own.abs() <= 1.0) {
                    return None;
                }
                continue;
            }
            let [low, high] = [ends[0].smaller(ends[1]), ends[0].larger(ends[1])];
            range = [range[0].larger(low), range[1].smaller(high)];
        }
        (range[0] <= range[1] && range[0].is_finite() && range[1].is_finite()).then_some(range)
    }
}

impl<'a> Bench<'a> {
    /// Creates a bench for the given rows of the question's grid. `left` is the number of cases that may still be
    /// solved.
    pub(super) fn new(question: &DiagnosisInput<'a>, rows: &[usize], left: Rc<Cell<usize>>) -> Option<Self> {
        let grid = &question.case.grid;
        let of_rows = |values: &[f64]| rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        let case = question.case.on(Grid { times: of_rows(&grid.times), inputs: of_rows(&grid.inputs) }).ok()?;
        let sizes = magnitudes(question.reference);
        let column = |judged: &SuspectChannel| {
            let place = question.reference.channels().iter().position(|own| *own == judged.channel)?;
            Some(Column {
                channel: judged.channel.clone(),
                bound: judged.bound.larger(known(question.case) * sizes[place]),
                disagrees: judged.disagrees,
                values: of_rows(question.suspicious.column(&judged.channel)?),
                right: of_rows(question.reference.column(&judged.channel)?),
            })
        };
        let columns = question.judged.iter().filter_map(column).filter(|column| column.bound > 0.0).collect();
        Some(Bench { case, columns, solver: question.solver, left })
    }

    /// Whether a position or a rate is among the disagreeing channels.
    pub(super) fn is_moved(&self) -> bool {
        self.columns.iter().any(|column| column.disagrees && column.channel.kind.stage < Stage::Reactions)
    }

    /// Whether the compared channels include positions or rates.
    pub(super) fn shows_motion(&self) -> bool {
        self.columns.iter().any(|column| column.channel.kind.stage < Stage::Reactions)
    }

    /// The differences from the unchanged reference.
    pub(super) fn start(&self) -> Misfit {
        self.misfit(|column| Some(column.right.clone())).expect("the reference has its own columns")
    }

    /// The differences between the suspect and a changed case. `None` if the case cannot be solved, or if the limit of
    /// solved cases is reached.
    pub(super) fn tried(&self, case: &Case) -> Option<Misfit> {
        self.tried_in(case, LateChannels::All)
    }

    /// The differences between the suspect and a changed case, in which only the channels `of` are changed. The other
    /// channels keep the values of the reference.
    pub(super) fn tried_in(&self, case: &Case, of: LateChannels) -> Option<Misfit> {
        self.left.set(self.left.get().checked_sub(1)?);
        let found = self.solver.solve(case).ok()?;
        let is_changed = |column: &Column| match of {
            LateChannels::All => true,
            LateChannels::OfStage(stage) => column.channel.kind.stage == stage,
            LateChannels::Explained => column.disagrees,
        };
        self.misfit(|column| match is_changed(column) {
            true => found.column(&column.channel).map(<[f64]>::to_vec),
            false => Some(column.right.clone()),
        })
    }

    fn misfit(&self, expected: impl Fn(&Column) -> Option<Vec<f64>>) -> Option<Misfit> {
        let mut all = Vec::with_capacity(self.columns.len() * self.case.grid.len());
        for column in &self.columns {
            let gaps = differences(&expected(column)?, &column.values, column.channel.kind.periodic);
            all.extend(gaps.iter().map(|gap| gap / column.bound));
        }
        Some(Misfit(all))
    }

    /// For every column of a misfit, the largest ratio of a difference to its bound.
    pub(super) fn by_column(&self, misfit: &Misfit) -> Vec<f64> {
        misfit.0.chunks(self.case.grid.len()).map(largest_size).collect()
    }

    /// Disagreeing channels that a hypothesis with this remaining `misfit` explains. The list is empty if an agreeing
    /// channel disagrees under the hypothesis. If the hypothesis does not explain all disagreeing channels, channels
    /// that exceed their bounds only slightly are left out.
    pub(super) fn explained(&self, start: &Misfit, misfit: &Misfit) -> Vec<Channel> {
        let all = misfit.fits();
        let [before, after] = [start, misfit].map(|misfit| self.by_column(misfit));
        let columns = || self.columns.iter().zip(before.iter().zip(&after));
        if columns().any(|(column, (_, after))| !column.disagrees && !(*after <= 1.0)) {
            return Vec::new();
        }
        let counts = |before: f64, after: f64| after <= 1.0 && (all || before > EVIDENT);
        let explained = columns().filter(|(column, (before, after))| column.disagrees && counts(**before, **after));
        explained.map(|(column, _)| column.channel.clone()).collect()
    }

    /// Sum of the changes that a hypothesis makes to agreeing channels, each divided by its bound.
    /// Of several hypotheses that have the same rank and explain the same number of channels, the hypothesis with the
    /// smallest sum is preferred.
    pub(super) fn claim(&self, start: &Misfit, misfit: &Misfit) -> f64 {
        let changes = self.by_column(&misfit.plus(-1.0, start));
        self.columns.iter().zip(changes).filter(|(column, _)| !column.disagrees).map(|(_, change)| change).sum()
    }
}

/// If a cause explains only some of the disagreeing channels, a channel counts as explained only if its largest
/// difference from the reference exceeds this multiple of its bound.
const EVIDENT: f64 = 3.0;

/// Number of instants of a bench, besides the worst instant of each channel.
const INSTANTS: usize = 32;
/// At first a free motion is followed only until a difference exceeds this multiple of its bound. Larger differences
/// may depend on the cause in a complicated way.
const EARLY: f64 = 100.0;

/// A selection of rows of the whole grid, which includes the worst instants of the disagreeing channels.
pub(super) fn thinned(question: &DiagnosisInput) -> Vec<usize> {
    let ascending = ascending(question.reference.times());
    let mut rows = spread(&ascending);
    for judged in question.judged.iter().filter(|judged| judged.disagrees) {
        rows.extend(
            gaps(question, &judged.channel)
                .and_then(|gaps| (0..gaps.len()).max_by(|&a, &b| gaps[a].abs().total_cmp(&gaps[b].abs()))),
        );
        if rows.len() >= INSTANTS + INSTANTS / 2 {
            break;
        }
    }
    in_order(rows)
}

/// A selection of rows as in `thinned`, but only from the early part of the run in which the differences are still
/// small.
pub(super) fn early(question: &DiagnosisInput) -> Vec<usize> {
    let ascending = ascending(question.reference.times());
    let mut end = ascending.len();
    for judged in question.judged.iter().filter(|judged| judged.disagrees) {
        let Some(gaps) = gaps(question, &judged.channel) else { continue };
        let far = ascending.iter().position(|&row| gaps[row].abs() > EARLY * judged.bound);
        end = end.min(far.unwrap_or(end));
    }
    let rows = spread(&ascending[..end.max(INSTANTS).min(ascending.len())]);
    in_order(rows)
}

/// Suspect minus reference, by row.
fn gaps(question: &DiagnosisInput, channel: &Channel) -> Option<Vec<f64>> {
    let (right, found) = (question.reference.column(channel)?, question.suspicious.column(channel)?);
    Some(differences(right, found, channel.kind.periodic))
}

fn spread(rows: &[usize]) -> Vec<usize> {
    let last = rows.len().saturating_sub(1);
    if rows.len() > INSTANTS { (0..INSTANTS).map(|k| rows[k * last / (INSTANTS - 1)]).collect() } else { rows.to_vec() }
}

/// Each row once, in ascending order. The grid's first row is added, because whole revolutions are counted from it.
fn in_order(mut rows: Vec<usize>) -> Vec<usize> {
    rows.push(0);
    rows.sort_unstable();
    rows.dedup();
    rows
}

#[cfg(test)]
mod tests {
    use super::Misfit;

    /// The expected ranges were computed by hand from -1 <= own + amount * effect <= 1 for every value.
    #[test]
    fn amounts_of_an_effect_keep_all_values_within_bounds() {
        for (own, effect, wanted) in [
            (vec![4.0], vec![2.0], Some([-2.5, -1.5])),
            (vec![4.0], vec![-2.0], Some([1.5, 2.5])),
            (vec![4.0, 3.0], vec![-2.0, -1.0], Some([2.0, 2.5])),
            (vec![4.0, -3.0], vec![-2.0, 1.0], Some([2.0, 2.5])),
            (vec![4.0, 3.0], vec![-2.0, 1.0], None),
            (vec![4.0, 0.5], vec![-2.0, 0.0], Some([1.5, 2.5])),
            (vec![4.0, 1.5], vec![-2.0, 0.0], None),
            (vec![0.5], vec![0.0], None),
        ] {
            assert_eq!(Misfit(own.clone()).kept_by(&Misfit(effect.clone())), wanted, "{own:?} {effect:?}");
        }
    }
}
