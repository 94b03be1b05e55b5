//! Brings two tables or recordings to the same instants: selects common rows, or interpolates the first party at the
//! instants of the second party.
//!
//! Values that are interpolated between the rows of a table carry the interpolation error.

use crate::sentences;

use super::allowed::ComparisonRule;
use super::judge::{Both, Which};
use super::pair::{Side, SidePair, crank_check};
use crate::tables::{By, Held, Instants, PartyColumn, RowKey};
use columns::MISSING;
use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use scenario::Claim;

/// Two instants count as equal if they differ by at most this fraction of the spacing of the rows.
const SAME: f64 = 1e-6;

/// Compares two parties at the instants of the second party.
pub(super) fn beside(one: &Side, other: &Side, how: &ComparisonRule) -> Result<SidePair> {
    let names = [one, other].map(|side| side.name.clone());
    let (one, other) = (&one.held, &other.held);
    // Rows are matched by times if both parties have times.
    let has_times = [one, other].iter().all(|own| own.at.times.is_some());
    let by = how.by.unwrap_or(if has_times { By::Time } else { By::Crank });
    let (from, to) = (one.at(Some(by))?, other.at(Some(by))?);
    let inputs = [one.at.input, other.at.input];
    if by == By::Crank && inputs[0] != inputs[1] {
        let message = sentences::the_rows_of_the_parties_have_different_inputs(&inputs[0].noun(), &inputs[1].noun());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::MAP_THE_INSTANTS_OF_BOTH_TO_THE_SAME_INPUT));
    }
    let asked = how.asked();
    let wanted = other.columns.iter().map(|own| &own.claim).filter(|claim| asked(claim));
    let claims: Vec<Claim> = wanted.filter(|claim| one.holds(claim)).cloned().collect();
    let lacks = |of: &Held, in_it: &Held| -> Vec<String> {
        let own = of.columns.iter().filter(|own| !in_it.holds(&own.claim));
        own.map(|own| own.claim.text.clone()).collect()
    };
    let alone = [lacks(one, other), lacks(other, one)];
    if claims.is_empty() {
        let some = |names: &[String]| names.iter().take(5).cloned().collect::<Vec<_>>().join(", ");
        let message = sentences::the_two_have_no_channel_in_common(&some(&alone[0]), &some(&alone[1]));
        return Err(Error::new(ErrorKind::Input, message).help(sentences::MAP_THE_COLUMNS_OF_BOTH_TO_THE_SAME));
    }
    let places = places(&from, &to, how);
    let unshared = places.iter().filter(|place| matches!(place, Place::Nowhere)).count();
    let shared = to.values.len() - unshared;
    // The comparison is refused if the second party has several instants and only one of them is common. This instant
    // may be 0, which is the same in every unit of time.
    if shared == 0 || shared == 1 && unshared > 0 {
        let what = if from.is_crank { one.at.input.noun() } else { "time" };
        let which = if shared == 0 { "no" } else { "only one" };
        let message = sentences::of_the_second_party_is_one_of_the_first(&which, &what);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::ALLOW_INTERPOLATION_OR_GIVE_BOTH));
    }
    let column = |claim: &Claim| {
        let values = at_places(&one.values_of(claim)?, &from, &places, claim.turn());
        Some(PartyColumn { claim: claim.clone(), values, scale: one.scale_of(claim), mapped: None })
    };
    let columns: Vec<PartyColumn> = claims.iter().filter_map(column).collect();
    let drift = drift(&from, &to, &places);
    let of_claims = columns.iter().map(|own| drift(&own.values, own.claim.turn())).collect();
    let mut first = Held::of_columns(Instants::default(), columns);
    first.is_analytic = one.is_analytic;
    let known = |of: &Option<Vec<Rounded>>| match of {
        Some(values) => values.iter().map(|at| at.value).collect(),
        None => vec![f64::NAN; to.values.len()],
    };
    let both = Both {
        parties: [&first, other],
        at: &to,
        input: other.at.input,
        instants: [known(&other.at.times), known(&other.at.cranks)],
        drift: of_claims,
        how,
    };
    let mut pair = SidePair { names, unshared, alone, ..SidePair::of(&both, Which::Second, &claims) };
    let have_one_input = !to.is_crank && inputs[0] == inputs[1];
    if let ([Some(ours), Some(theirs)], true) = ([&one.at.cranks, &other.at.cranks], have_one_input) {
        let turn = pair.input.period().map(|(turn, _)| turn);
        let ours = at_places(ours, &from, &places, turn);
        pair.checks.extend(crank_check(&both, [&ours, theirs], &drift(&ours, turn)));
    }
    Ok(pair)
}

/// Uncertainty of a column of the first party at the rows of the second.
/// The uncertainty is due to the limited digits of both parties' instants.
fn drift(from: &RowKey, to: &RowKey, places: &[Place]) -> impl Fn(&[Rounded], Option<f64>) -> Vec<f64> + use<> {
    let widest = from.values.iter().map(|at| at.error).fold(0.0, f64::larger);
    let of = |(place, own): (&Place, &Rounded)| match place {
        Place::At(row) => own.error + from.values[*row].error,
        Place::Between(_) => own.error + widest,
        Place::Nowhere => 0.0,
    };
    let slack: Vec<f64> = places.iter().zip(&to.values).map(of).collect();
    let (at, order) = (to.values.iter().map(|at| at.value).collect::<Vec<f64>>(), to.ascending());
    move |values, turn| columns::drift(values, &at, &slack, &order, turn)
}

/// Location of an instant of the second party among the rows of the first party.
enum Place {
    /// At a row.
    At(usize),
    /// Between two rows, to be interpolated.
    Between(f64),
    /// Outside all rows, or between two rows although interpolation is not allowed.
    Nowhere,
}

fn places(from: &RowKey, to: &RowKey, how: &ComparisonRule) -> Vec<Place> {
    let order = from.ascending();
    let at = |index: usize| from.values[order[index]].value;
    let of = |wanted: &Rounded| {
        let next = order.partition_point(|&row| from.values[row].value < wanted.value);
        let near = [next.checked_sub(1), (next < order.len()).then_some(next)];
        let step = match near {
            [Some(before), Some(after)] => at(after) - at(before),
            [Some(_), None] | [None, Some(_)] | [None, None] => 0.0,
        };
        let is_same = |index: &usize| {
            let slack = wanted.error + from.values[order[*index]].error;
            (at(*index) - wanted.value).abs() <= slack.larger(SAME * step).larger(1e-9 * wanted.value.abs())
        };
        if let Some(index) = near.into_iter().flatten().find(is_same) {
            return Place::At(order[index]);
        }
        match near {
            [Some(_), Some(_)] if how.interpolates => Place::Between(wanted.value),
            _ => Place::Nowhere,
        }
    };
    to.values.iter().map(of).collect()
}

/// The values of a claim at the locations `places` among the rows `from`.
fn at_places(values: &[Rounded], from: &RowKey, places: &[Place], turn: Option<f64>) -> Vec<Rounded> {
    let order = from.ascending();
    let at: Vec<f64> = order.iter().map(|&row| from.values[row].value).collect();
    let sorted: Vec<Rounded> = order.iter().map(|&row| values[row]).collect();
    let course = Course::new(&at, &sorted, turn);
    let of = |place: &Place| match place {
        Place::At(row) => values[*row],
        Place::Between(wanted) => course.value(*wanted),
        Place::Nowhere => MISSING,
    };
    places.iter().map(of).collect()
}

/// Number of rows needed to interpolate: four for a cubic, and one more to estimate its error.
const FEWEST: usize = 5;
/// Between rows, the fourth divided difference is assumed to be at most this multiple of a measured difference.
/// The measured difference is the largest fourth divided difference in nearby windows of five rows.
const SAFETY: f64 = 2.0;

/// A column in ascending order of its instants.
pub(super) struct Course {
    at: Vec<f64>,
    values: Vec<Rounded>,
    /// Absolute fourth divided difference of every five successive rows.
    fourth: Vec<f64>,
}

impl Course {
    /// Creates a column from its instants, in ascending order, and its values.
    /// Rows without a number are left out. Angles may jump by multiples of `turn`.
    pub(super) fn new(at: &[f64], values: &[Rounded], turn: Option<f64>) -> Self {
        let rows: Vec<(f64, Rounded)> =
            at.iter().copied().zip(values.iter().copied()).filter(|(_, own)| own.value.is_finite()).collect();
        let at: Vec<f64> = rows.iter().map(|(at, _)| *at).collect();
        let values = unwound(rows.into_iter().map(|(_, value)| value).collect(), turn);
        let window = |first: usize| {
            let mut own: Vec<f64> = values[first..first + FEWEST].iter().map(|own| own.value).collect();
            for order in 1..FEWEST {
                for index in 0..FEWEST - order {
                    own[index] = (own[index + 1] - own[index]) / (at[first + index + order] - at[first + index]);
                }
            }
            own[0].abs()
        };
        let fourth = (0..(at.len() + 1).saturating_sub(FEWEST)).map(window).collect();
        Course { at, values, fourth }
    }

    /// The value at an instant, interpolated by the cubic through the four rows around the instant.
    /// The value's error is the error of the rows plus the first neglected term.
    /// The value is NaN for an instant outside the rows, and if there are too few rows.
    pub(super) fn value(&self, wanted: f64) -> Rounded {
        let next = self.at.partition_point(|&at| at < wanted);
        if next == 0 || next == self.at.len() || self.at.len() < FEWEST {
            return MISSING;
        }
        let first = next.saturating_sub(2).min(self.at.len() - 4);
        let rows = first..first + 4;
        let weight = |row: usize| -> f64 {
            let others = rows.clone().filter(|&other| other != row);
            others.map(|other| (wanted - self.at[other]) / (self.at[row] - self.at[other])).product()
        };
        let [value, error] = rows.clone().fold([0.0, 0.0], |[sum, error], row| {
            let (weight, own) = (weight(row), self.values[row]);
            [sum + weight * own.value, error + weight.abs() * own.error]
        });
        let near = first.saturating_sub(2)..(first + 2).min(self.fourth.len());
        let fourth = self.fourth[near].iter().copied().fold(0.0, f64::larger);
        let distances: f64 = rows.map(|row| (wanted - self.at[row]).abs()).product();
        Rounded { value, error: error + SAFETY * fourth * distances }
    }
}

/// Removes jumps by multiples of `turn` between the rows of an angle.
fn unwound(mut values: Vec<Rounded>, turn: Option<f64>) -> Vec<Rounded> {
    let Some(turn) = turn else { return values };
    for row in 1..values.len() {
        let gap = values[row].value - values[row - 1].value;
        values[row].value -= turn * (gap / turn).round();
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_is_exact_for_cubics_and_bounded_for_sines() {
        let at: Vec<f64> = (0..40).map(|row| 0.2 * f64::from(row) + 0.03 * f64::from(row % 3)).collect();
        let of = |f: &dyn Fn(f64) -> f64| {
            let values: Vec<Rounded> = at.iter().map(|&at| Rounded::exact(f(at))).collect();
            Course::new(&at, &values, None)
        };
        let (cubic, sine) = (of(&|x| x * x * (x - 3.0)), of(&f64::sin));
        for step in 1..=770 {
            let x = 0.01 * f64::from(step);
            let (exact, found) = (x * x * (x - 3.0), cubic.value(x));
            assert!((found.value - exact).abs() < 1e-11 && found.error < 1e-9, "{x}: {found:?}");
            let found = sine.value(x);
            assert!((found.value - x.sin()).abs() <= found.error + 1e-15 && found.error < 5e-4, "{x}: {found:?}");
        }
        assert!(cubic.value(-0.1).value.is_nan() && cubic.value(8.0).value.is_nan());
    }

    #[test]
    fn row_errors_propagate_with_their_weights() {
        let at: Vec<f64> = (0..20).map(f64::from).collect();
        let values: Vec<Rounded> = at.iter().map(|&at| Rounded { value: at, error: 1e-6 }).collect();
        // Midway between two rows the weights are -1/16, 9/16, 9/16 and -1/16.
        // The absolute weights add up to 5/4. Equal errors of the four rows are therefore multiplied by 5/4.
        let found = Course::new(&at, &values, None).value(9.5);
        assert!((found.error - 1.25e-6).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn an_angle_that_wraps_is_interpolated_smoothly() {
        let at: Vec<f64> = (0..20).map(f64::from).collect();
        let values: Vec<Rounded> = at.iter().map(|at| Rounded::exact((100.0 * at).rem_euclid(360.0))).collect();
        let found = Course::new(&at, &values, Some(360.0)).value(7.5);
        assert!((found.value - 750.0).abs() < 1e-9 && found.error < 1e-9, "{found:?}");
    }
}
