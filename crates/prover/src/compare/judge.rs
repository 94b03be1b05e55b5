//! Computes differences, bounds and verdicts, channel by channel.

use crate::sentences;
use std::ops::Deref;

use super::allowed::{Allowances, ComparisonRule};
use crate::bounds::Verdict;
use crate::run::shifted::TELLING;
use crate::tables::{Held, RowKey};
use columns::{Beside, JudgedColumns, ScaleColumn, judge};
use formula::{NodeShape, Rounded};
use linkage::error::Advice;
use linkage::input::Input;
use linkage::math::statistics::{half_range, quantile, sorted_sizes};
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::Unit;
use scenario::Claim;

pub use columns::RowPair;

/// A channel, or an expression of channels, that both parties have.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The channel or expression, in its unit.
    pub claim: Claim,
    /// Scale over the whole run of a scenario or recording, in the claim's unit: see [`scales`](crate::bounds::scales).
    /// For tables and for expressions of channels, the scale comes from the numbers of this claim that are compared.
    /// The scale does not depend on which other channels are compared.
    pub scale: f64,
    /// Result of comparing the numbers of both parties, in the claim's unit.
    pub found: JudgedColumns,
    /// Whether the bound comes only from the known errors of both parties, without an allowed difference.
    pub is_derived: bool,
    /// The channel agrees only if the difference is within its bound at every instant.
    pub verdict: Verdict,
}

impl Deref for Compared {
    type Target = JudgedColumns;

    fn deref(&self) -> &JudgedColumns {
        &self.found
    }
}

impl Compared {
    /// Whether the channel disagrees because one party lacks a number at some instant.
    #[must_use]
    pub fn has_no_number(&self) -> bool {
        has_no_number(&self.found)
    }
}

fn has_no_number(own: &JudgedColumns) -> bool {
    own.since.is_some_and(|at| at.difference.is_nan())
}

/// One of two parties: the party that was named first or second.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Which {
    First,
    Second,
}

impl Which {
    pub(super) fn other(self) -> Which {
        if self == Which::First { Which::Second } else { Which::First }
    }

    /// The values of both parties in the order in which the parties were named; `own` belongs to the party `self`.
    pub(super) fn beside<T>(self, own: T, other: T) -> [T; 2] {
        if self == Which::First { [own, other] } else { [other, own] }
    }
}

/// Fraction of the rows that determine the uncertainty due to rounded instants, and ratio of the largest uncertainty to
/// the uncertainty that this fraction of the rows does not exceed.
const MOST_ROWS: f64 = 0.9;
const STEEPEST: f64 = 3.0;

/// Both parties at the same rows.
pub(super) struct Both<'a> {
    pub parties: [&'a Held; 2],
    pub at: &'a RowKey,
    /// What the input measures.
    pub input: Input,
    /// For every row, the time and the value of the input. An unknown time or value is NaN.
    pub instants: [Vec<f64>; 2],
    /// Uncertainty due to the digits of the instants, by claim and row; empty if the instants are exact.
    pub drift: Vec<Vec<f64>>,
    pub how: &'a ComparisonRule,
}

impl Both<'_> {
    /// Judges all claims that both parties have.
    pub(super) fn judged(&self, claims: &[Claim]) -> Vec<Compared> {
        let [one, other] = self.parties;
        let allowances = self.how.allowances();
        let of = |(index, claim): (usize, &Claim)| {
            let values = [one.values_of(claim)?, other.values_of(claim)?];
            Some(self.channel(claim, index, [&values[0], &values[1]], &allowances))
        };
        claims.iter().enumerate().filter_map(of).collect()
    }

    /// The party whose values determine the scale.
    pub(super) fn measure(&self) -> ScaleColumn {
        ScaleColumn::among(self.parties.map(|party| party.is_analytic))
    }

    pub(super) fn places(&self) -> [&[f64]; 2] {
        self.instants.each_ref().map(Vec::as_slice)
    }

    /// The uncertainty of most rows due to the digits of the instants, if these `values` belong to the rows. Rows in
    /// which a simulation diverges do not count.
    pub(super) fn drift_of(&self, values: &[Rounded], turn: Option<f64>) -> f64 {
        if self.drift.is_empty() {
            return 0.0;
        }
        let (instants, slack): (Vec<f64>, Vec<f64>) = self.at.values.iter().map(|at| (at.value, at.error)).unzip();
        let drift = columns::drift(values, &instants, &slack, &self.at.ascending(), turn);
        STEEPEST * quantile(&sorted_sizes(&drift), MOST_ROWS)
    }

    /// The scale of a channel. The scale does not depend on which other channels are compared.
    /// If a party has a complete trajectory, the scale comes from this trajectory.
    /// For tables and for expressions of channels, the scale comes from the numbers alone: half the range of the
    /// numbers, but at least a tenth of the largest value (a thousandth for a coordinate).
    fn scale(&self, claim: &Claim, values: &[Rounded]) -> f64 {
        let measure = self.measure().party;
        let complete = [measure, 1 - measure].into_iter().find_map(|party| self.parties[party].scale_of(claim));
        complete.unwrap_or_else(|| {
            let numbers: Vec<f64> = values.iter().map(|own| own.value).filter(|value| value.is_finite()).collect();
            let is_coordinate = matches!(claim.tree.shape, NodeShape::Name(_))
                && matches!(claim.channels[0].1.channel.kind.unit, Unit::Radian | Unit::Metre);
            let share = match (numbers.len(), is_coordinate) {
                // A single instant has no range, so its value is the scale.
                (1, _) => 1.0,
                (_, true) => 1e-3,
                (_, false) => 0.1,
            };
            half_range(&numbers).larger(share * largest_size(&numbers))
        })
    }

    fn channel(&self, claim: &Claim, index: usize, values: [&[Rounded]; 2], allowances: &Allowances) -> Compared {
        let measure = self.measure();
        let scale = self.scale(claim, values[measure.party]);
        let allowed = allowances.of(claim, scale);
        let found = judge(&Beside {
            values,
            places: self.places(),
            drift: self.drift.get(index).map_or(&[], Vec::as_slice),
            turn: claim.turn(),
            allowance: allowed.unwrap_or_default(),
            measure,
        });
        let is_derived = allowed.is_none();
        Compared { claim: claim.clone(), scale, is_derived, verdict: self.verdict(&found, scale, is_derived), found }
    }

    fn verdict(&self, own: &JudgedColumns, scale: f64, is_derived: bool) -> Verdict {
        let Some(worst) = own.worst else {
            return Verdict::open(sentences::AT_NO_INSTANT_DO_BOTH_HAVE_A_NUMBER);
        };
        let open = |reason: String, advice: &str| Verdict::Inconclusive {
            reason,
            advice: vec![Advice::Text(advice.to_string())],
        };
        let largest = own.largest.map_or(0.0, |largest| largest.difference.abs());
        match own.since {
            Some(_) if is_derived && !self.measure().is_analytic && !has_no_number(own) => open(
                sentences::they_differ_by_up_to_and_neither(&format_args!("{largest:.3e}")),
                sentences::SAY_WHAT_DIFFERENCE_IS_ALLOWED,
            ),
            Some(since) => Verdict::Disagree { place: place(&since, self.input) },
            // Numbers with few digits agree in spite of their large uncertainty if the difference is at most the
            // fraction `TELLING` of the scale.
            None if is_derived && own.widest > TELLING * scale && largest > TELLING * scale => open(
                sentences::the_numbers_are_known_to_of_their(&format_args!("{:.1e}", own.widest / scale)),
                sentences::GIVE_MORE_DIGITS_OR_CLOSER,
            ),
            None => Verdict::Agree { margin: 1.0 / worst.used() },
        }
    }
}

/// Text with an instant and the numbers of both parties at this instant.
pub(super) fn place(at: &RowPair, input: Input) -> String {
    let RowPair { time, crank, values: [one, other], .. } = at;
    let when = match (time.is_nan(), crank.is_nan()) {
        (false, false) => format!("t = {time:.6} s, {:.3}", input.at(*crank)),
        (false, true) => format!("t = {time:.6} s"),
        (true, _) => format!("{:.3}", input.at(*crank)),
    };
    let told = |value: &f64| if value.is_nan() { "no number".into() } else { format!("{value:.9e}") };
    let way_out = if at.difference.is_nan() { sentences::LEAVE_A_CELL_EMPTY_WHERE } else { "" };
    sentences::first_at_against(&when, &told(one), &told(other), &way_out)
}
