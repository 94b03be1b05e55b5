//! Comparison of two columns, each of them from one party, such as a solver or a table.

use crate::cell::is_missing;
use formula::Rounded;
use linkage::math::KeepNan;

/// One row of the two compared columns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowPair {
    /// Index of the row in the column of the party at whose instants the columns are compared.
    pub row: usize,
    /// Time (s); NaN if unknown.
    pub time: f64,
    /// Crank angle (rad, in the scenario's convention); NaN if unknown.
    pub crank: f64,
    /// Values of the first and the second party, in the unit of the columns. NaN if a party has no number.
    pub values: [f64; 2],
    /// Second value minus first value. For angles, whole turns are removed.
    pub difference: f64,
    /// Largest difference allowed.
    pub bound: f64,
    /// Known part of the bound. The known part comes from the digits of numbers and instants, from rounding, and from
    /// the error bounds of the parties.
    pub known: f64,
}

impl RowPair {
    /// Difference divided by the bound; infinite if a party has no number.
    pub fn used(&self) -> f64 {
        let used = if self.difference == 0.0 { 0.0 } else { self.difference.abs() / self.bound };
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// A difference that is allowed in addition to the known part of the bound. The larger of the fields `fixed` and
/// `of_value` counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Allowance {
    /// Allowance that is the same in every row, in the unit of the columns.
    pub fixed: f64,
    /// Allowance as a fraction of the reference value.
    pub of_value: f64,
}

/// Two columns at the same rows.
#[derive(Clone, Copy, Debug)]
pub struct Beside<'a> {
    /// Values of the first and the second party.
    pub values: [&'a [Rounded]; 2],
    /// Times (s) and crank angles (rad) of the rows; NaN if unknown.
    pub places: [&'a [f64]; 2],
    /// Uncertainty caused by the digits of the instants, row by row; empty if the digits cause no uncertainty.
    pub drift: &'a [f64],
    /// Period of a quantity, such as a whole turn. Values that differ by a multiple of the period count as equal.
    pub turn: Option<f64>,
    /// Difference that is allowed in addition to the known part of the bound.
    pub allowance: Allowance,
    /// The reference of the two columns.
    pub measure: ScaleColumn,
}

/// The reference of two columns.
/// The second column is the reference if it comes from an analytic side and the first column does not.
/// In all other cases, the first column is the reference.
#[derive(Clone, Copy, Debug)]
pub struct ScaleColumn {
    /// Index of the reference column: 0 or 1.
    pub party: usize,
    /// Whether the reference comes from an analytic side. A row in which this side has no number is not judged.
    pub is_analytic: bool,
}

impl ScaleColumn {
    /// Selects the reference. Each flag says whether its column comes from an analytic side.
    pub fn among([one, other]: [bool; 2]) -> Self {
        ScaleColumn { party: usize::from(!one && other), is_analytic: one || other }
    }
}

/// Result of the comparison of two columns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JudgedColumns {
    /// Number of rows compared.
    pub judged: usize,
    /// Number of rows that are not judged.
    /// In such a row, nothing was measured, the reference from an analytic side has no number, or no party has a
    /// number.
    pub missing: usize,
    /// Root mean square of the differences, over all rows in which both values are numbers.
    pub rms: f64,
    /// Largest known part of the bound in any row in which both values are numbers.
    pub widest: f64,
    /// The widest bound.
    pub loosest: f64,
    /// The row with the largest difference, among rows in which both values are numbers.
    pub largest: Option<RowPair>,
    /// The row whose difference is the largest fraction of its bound.
    pub worst: Option<RowPair>,
    /// Of all rows whose difference exceeds its bound, the row with the earliest instant.
    pub since: Option<RowPair>,
    /// Number of rows in which both values are numbers and their difference exceeds its bound.
    pub wrong: usize,
    /// Number of judged rows in which a party has no number.
    pub undefined: usize,
    /// Of these rows, the row with the earliest instant.
    pub undefined_since: Option<RowPair>,
}

/// Compares the two columns row by row.
/// If one value is a number and the other value is a computed NaN, the row exceeds its bound, unless the NaN belongs to
/// an analytic reference.
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
        let is_earlier = |since: RowPair| if time.is_nan() { crank < since.crank } else { time < since.time };
        own.judged += 1;
        if difference.is_finite() {
            numbers += 1;
            squares += difference * difference;
            (own.widest, own.loosest) = (own.widest.larger(known), own.loosest.larger(bound));
            own.wrong += usize::from(!(at.used() <= 1.0));
            if own.largest.is_none_or(|largest| difference.abs() > largest.difference.abs()) {
                own.largest = Some(at);
            }
        } else {
            own.undefined += 1;
            if own.undefined_since.is_none_or(is_earlier) {
                own.undefined_since = Some(at);
            }
        }
        if own.worst.is_none_or(|worst| at.used() > worst.used()) {
            own.worst = Some(at);
        }
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

    /// The rows are in descending order of their instants. The instants are times if known, otherwise crank angles.
    #[test]
    fn judgement_values_belong_to_their_row() {
        let of = |value: f64, error: f64| Rounded { value, error };
        let first = [of(10.0, 0.1), of(20.0, 0.0), of(30.0, 0.0), MISSING, of(40.0, 0.0)];
        let second = [of(10.0, 0.2), of(21.0, 0.0), of(26.0, 0.0), of(7.0, 0.0), UNDEFINED];
        let (at, nowhere, drift) = ([5.0, 4.0, 3.0, 2.0, 1.0], [f64::NAN; 5], [0.5, 0.0, 0.0, 0.0, 0.0]);
        for places in [[&at[..], &nowhere], [&nowhere, &at]] {
            let allowance = Allowance { fixed: 0.25, of_value: 0.1 };
            let measure = ScaleColumn { party: 0, is_analytic: true };
            let both = Beside { values: [&first, &second], places, drift: &drift, turn: None, allowance, measure };
            let found = judge(&both);
            // The differences are 0, 1, -4 and NaN; the bounds are 0.8 + 1, 2, 3 and 4.
            assert_eq!((found.judged, found.missing, found.widest), (4, 1, 0.1 + 0.2 + 0.5));
            assert_eq!(found.rms, (17.0f64 / 3.0).sqrt());
            let largest = found.largest.unwrap();
            assert_eq!((largest.row, largest.difference, largest.bound), (2, -4.0, 3.0));
            // The row with the NaN is the worst row. This row also has the earliest instant, so it is the first row
            // beyond its bound.
            assert_eq!([found.worst, found.since].map(|own| own.unwrap().row), [4, 4]);
            // The second party is now the reference. The bound therefore depends on the second party's number, 26.
            let by_other = judge(&Beside { measure: ScaleColumn { party: 1, is_analytic: false }, ..both });
            assert_eq!(by_other.largest.unwrap().bound, 0.1 * 26.0);
            // With a turn of 5, the difference -4 becomes 1.
            let turned = judge(&Beside { turn: Some(5.0), ..both });
            assert_eq!((turned.largest.unwrap().row, turned.largest.unwrap().difference.abs()), (1, 1.0));
        }
        let worst = judged(&[of(1.0, 1.0), of(1.0, 0.5), of(1.0, 1.0)], &[Rounded::exact(1.4); 3], [true, false]);
        assert_eq!((worst.worst.unwrap().row, worst.since), (1, None));
    }

    #[test]
    fn undefined_cells_differ_and_missing_cells_are_counted() {
        let right = [Rounded::exact(1.0); 4];
        let of = |cell: Rounded| judged(&right, &[right[0], cell, cell, right[0]], [true, false]);
        let found = of(MISSING);
        assert_eq!((found.judged, found.missing, found.since), (2, 2, None));
        let found = of(UNDEFINED);
        assert_eq!((found.judged, found.missing, found.since.map(|at| at.row)), (4, 0, Some(1)));
        assert_eq!((found.wrong, found.undefined, found.undefined_since.map(|at| at.row)), (0, 2, Some(1)));
        assert!(found.largest.unwrap().difference == 0.0 && found.worst.unwrap().used().is_infinite());
        // The analytic side has no number in this row, so the number of the other party is not judged.
        let found = judged(&[right[0], UNDEFINED], &right[..2], [true, false]);
        assert_eq!((found.judged, found.missing, found.since), (1, 1, None));
        // Neither column is analytic, and only one of the two columns has a number, so the row exceeds its bound.
        assert!(judged(&[right[0], UNDEFINED], &right[..2], [false; 2]).since.is_some());
        assert_eq!(judged(&[UNDEFINED], &[UNDEFINED], [false; 2]).missing, 1);
    }
}
