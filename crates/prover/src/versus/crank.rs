//! The crank angle, where both parties carry it beside the times by which they are brought together.

use std::f64::consts::TAU;

use super::allowed::How;
use super::judge::{Row, place};
use crate::compare::{Check, Verdict};
use crate::tolerance::{Basis, Tolerance};
use columns::{Beside, judge};
use formula::Rounded;
use linkage::math::statistics::half_range;

/// What the check is called.
pub(super) const NAME: &str = "crank angle";

/// Compares the crank angles (rad, as the scenario states them) of both parties at the same rows; `None` if nobody asks
/// for it, or no row has both. `drift` is what the digits of the times leave open, `measure` the party that is measured
/// by and whether one of the two is analytic.
pub(super) fn check(
    cranks: [&[Rounded]; 2],
    places: &[Vec<f64>; 2],
    drift: &[f64],
    measure: (usize, bool),
    how: &How,
) -> Option<Check> {
    let values: Vec<f64> = cranks[measure.0].iter().map(|own| own.value).filter(|value| value.is_finite()).collect();
    let allowed = how.allows_crank(half_range(&values));
    let mut allowance = allowed.unwrap_or_default();
    // Taking off whole turns rounds.
    allowance.fixed += 4.0 * f64::EPSILON * TAU;
    let places = [&places[0][..], &places[1]];
    let found = judge(&Beside { values: cranks, places, drift, turn: Some(TAU), allowance, measure });
    let worst = found.worst.filter(|_| how.asks_for_crank())?;
    let basis =
        Basis::Wanted("both are said to count the crank angle alike: digits, rounding and integration allow this");
    let tolerance = Tolerance { bound: worst.bound, basis };
    let mut check = Check::new(NAME, worst.difference.abs(), tolerance, "rad");
    check.verdict = match found.since {
        Some(_) if !measure.1 && allowed.is_none() => Verdict::open(
            "the crank angles differ, and neither party is analytic: say by how much the channel crank may differ",
        ),
        Some(at) => Verdict::Disagree { place: place(&in_degrees(at)) },
        None => Verdict::Agree { margin: 1.0 / worst.used() },
    };
    Some(check)
}

fn in_degrees(at: Row) -> Row {
    Row { values: at.values.map(f64::to_degrees), ..at }
}
