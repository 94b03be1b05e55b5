//! Two columns side by side.

use crate::cell::is_missing;
use formula::Rounded;
use linkage::math::KeepNan;

/// One row of both columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowPair {
    /// Its number in the party that gives the instants.
    pub row: usize,
    /// Time (s); NaN where none is known.
    pub time: f64,
    /// Crank angle (rad, as the scenario states it); NaN where none is known.
    pub crank: f64,
    /// What the first and the second party say, in the unit of the claim; NaN for no number.
    pub values: [f64; 2],
    /// Second less first; for angles without whole turns.
    pub difference: f64,
    /// Largest difference allowed.
    pub bound: f64,
    /// The part of the bound that is known: digits of the numbers and instants, rounding, and what a side knows.
    pub known: f64,
}

impl RowPair {
    /// Share of the bound that is used; infinite for no number.
    #[must_use]
    pub fn used(&self) -> f64 {
        let used = if self.difference == 0.0 { 0.0 } else { self.difference.abs() / self.bound };
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// A difference that is allowed besides what is known: the larger of two.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Allowance {
    /// The same at every row, in the unit of the columns.
    pub fixed: f64,
    /// Share of the value that is measured by.
    pub of_value: f64,
}

/// Two columns at the same rows.
#[derive(Clone, Copy, Debug)]
pub struct Beside<'a> {
    /// What both say.
    pub values: [&'a [Rounded]; 2],
    /// Times (s) and crank angles (rad) of the rows, as far as somebody knows them, else NaN.
    pub places: [&'a [f64]; 2],
    /// What the digits of the instants leave open, row by row; empty for nothing.
    pub drift: &'a [f64],
    /// Values so far apart mean the same.
    pub turn: Option<f64>,
    /// What is allowed.
    pub allowance: Allowance,
    /// Which of the two is measured by.
    pub measure: ScaleColumn,
}

/// Which of two columns is measured by: the first, unless the second alone is of an analytic side.
#[derive(Clone, Copy, Debug)]
pub struct ScaleColumn {
    /// Its number, from 0.
    pub party: usize,
    /// Whether its numbers are those of an analytic side: where that has none, nothing is expected.
    pub is_analytic: bool,
}

impl ScaleColumn {
    /// By whether each of the two is of an analytic side.
    #[must_use]
    pub fn among([one, other]: [bool; 2]) -> Self {
        ScaleColumn { party: usize::from(!one && other), is_analytic: one || other }
    }
}

/// What two columns come to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JudgedColumns {
    /// Number of rows compared.
    pub judged: usize,
    /// Number of rows at which nothing was measured, or nothing is defined.
    pub missing: usize,
    /// Root of the mean square of the differences between numbers.
    pub rms: f64,
    /// The widest part of a bound that is known.
    pub widest: f64,
    /// The widest bound.
    pub loosest: f64,
    /// The largest difference between numbers.
    pub largest: Option<RowPair>,
    /// The row that uses most of its bound.
    pub worst: Option<RowPair>,
    /// The first row beyond its bound.
    pub since: Option<RowPair>,
}

/// Judges row by row. Where only one of the two has a number although the other says that it has computed one, they
/// differ: such a NaN is beyond every bound.
#[must_use]
pub fn judge(both: &Beside) -> JudgedColumns {
    let Beside { values, places, drift, turn, allowance, measure } = *both;
    let (mut own, mut squares, mut numbers) = (JudgedColumns::default(), 0.0, 0usize);
    for (row, (&one, &other)) in values[0].iter().zip(values[1]).enumerate() {
        let measured = [one, other][measure.party];
        let nothing_expected = match measure.is_analytic {
            true => measured.value.is_nan(),
            false => one.value.is_nan() && other.value.is_nan(),
        };
        if nothing_expected || is_missing(&one) || is_missing(&other) {
            own.missing += 1;
            continue;
        }
        let gap = other.value - one.value;
        let difference = turn.map_or(gap, |turn| gap - turn * (gap / turn).round());
        let known = one.error + other.error + drift.get(row).copied().unwrap_or(0.0);
        let bound = known + allowance.fixed.larger(allowance.of_value * measured.value.abs());
        let [time, crank] = places.map(|of| of[row]);
        let at = RowPair { row, time, crank, values: [one.value, other.value], difference, bound, known };
        own.judged += 1;
        if difference.is_finite() {
            numbers += 1;
            squares += difference * difference;
            (own.widest, own.loosest) = (own.widest.larger(known), own.loosest.larger(bound));
            if own.largest.is_none_or(|largest| difference.abs() > largest.difference.abs()) {
                own.largest = Some(at);
            }
        }
        if own.worst.is_none_or(|worst| at.used() > worst.used()) {
            own.worst = Some(at);
        }
        let is_earlier = |since: RowPair| if time.is_nan() { crank < since.crank } else { time < since.time };
        if !(at.used() <= 1.0) && own.since.is_none_or(is_earlier) {
            own.since = Some(at);
        }
    }
    own.rms = if numbers == 0 { 0.0 } else { (squares / numbers as f64).sqrt() };
    own
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cell::{MISSING, UNDEFINED};

    fn judged(first: &[Rounded], second: &[Rounded], is_analytic: [bool; 2]) -> JudgedColumns {
        let at: Vec<f64> = (0..first.len()).map(|row| row as f64).collect();
        let (places, allowance) = ([&at[..], &at], Allowance::default());
        let measure = ScaleColumn::among(is_analytic);
        judge(&Beside { values: [first, second], places, drift: &[], turn: None, allowance, measure })
    }

    /// Rows in descending order of their instants: by time where there is one, else by crank angle.
    #[test]
    fn every_number_of_a_judgement_is_that_of_its_row() {
        let of = |value: f64, error: f64| Rounded { value, error };
        let first = [of(10.0, 0.1), of(20.0, 0.0), of(30.0, 0.0), MISSING, of(40.0, 0.0)];
        let second = [of(10.0, 0.2), of(21.0, 0.0), of(26.0, 0.0), of(7.0, 0.0), UNDEFINED];
        let (at, nowhere, drift) = ([5.0, 4.0, 3.0, 2.0, 1.0], [f64::NAN; 5], [0.5, 0.0, 0.0, 0.0, 0.0]);
        for places in [[&at[..], &nowhere], [&nowhere, &at]] {
            let allowance = Allowance { fixed: 0.25, of_value: 0.1 };
            let measure = ScaleColumn { party: 0, is_analytic: true };
            let both = Beside { values: [&first, &second], places, drift: &drift, turn: None, allowance, measure };
            let found = judge(&both);
            // Differences 0, 1, -4 and none; bounds 0.8 + 1, 2, 3 and 4.
            assert_eq!((found.judged, found.missing, found.widest), (4, 1, 0.1 + 0.2 + 0.5));
            assert_eq!(found.rms, (17.0f64 / 3.0).sqrt());
            let largest = found.largest.unwrap();
            assert_eq!((largest.row, largest.difference, largest.bound), (2, -4.0, 3.0));
            // What is no number uses most, and is beyond its bound at the earliest instant.
            assert_eq!([found.worst, found.since].map(|own| own.unwrap().row), [4, 4]);
            // By the second party, whose numbers are other ones.
            let by_other = judge(&Beside { measure: ScaleColumn { party: 1, is_analytic: false }, ..both });
            assert_eq!(by_other.largest.unwrap().bound, 0.1 * 26.0);
            // An angle of 4 turned by 5 is one of -1.
            let turned = judge(&Beside { turn: Some(5.0), ..both });
            assert_eq!((turned.largest.unwrap().row, turned.largest.unwrap().difference.abs()), (1, 1.0));
        }
        let worst = judged(&[of(1.0, 1.0), of(1.0, 0.5), of(1.0, 1.0)], &[Rounded::exact(1.4); 3], [true, false]);
        assert_eq!((worst.worst.unwrap().row, worst.since), (1, None));
    }

    #[test]
    fn what_was_computed_and_is_no_number_differs_and_what_is_missing_is_counted() {
        let right = [Rounded::exact(1.0); 4];
        let of = |cell: Rounded| judged(&right, &[right[0], cell, cell, right[0]], [true, false]);
        let found = of(MISSING);
        assert_eq!((found.judged, found.missing, found.since), (2, 2, None));
        let found = of(UNDEFINED);
        assert_eq!((found.judged, found.missing, found.since.map(|at| at.row)), (4, 0, Some(1)));
        assert!(found.largest.unwrap().difference == 0.0 && found.worst.unwrap().used().is_infinite());
        // Where the analytic side has no number, none is expected.
        let found = judged(&[right[0], UNDEFINED], &right[..2], [true, false]);
        assert_eq!((found.judged, found.missing, found.since), (1, 1, None));
        // Of two tables one has no number.
        assert!(judged(&[right[0], UNDEFINED], &right[..2], [false; 2]).since.is_some());
        assert_eq!(judged(&[UNDEFINED], &[UNDEFINED], [false; 2]).missing, 1);
    }
}
