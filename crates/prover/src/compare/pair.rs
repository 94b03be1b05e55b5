//! Result of a comparison of two parties.

use crate::sentences;

use super::cause::Explained;
use super::judge::{Both, Compared, RowPair, Which, place};
use crate::bounds::{Check, Verdict, overall};
use crate::tables::Held;
use crate::tolerance::{BoundBasis, Tolerance};
use columns::{Beside, judge};
use formula::Rounded;
use linkage::input::Input;
use linkage::math::statistics::half_range;
use scenario::Claim;

/// One side of a party. Only a recording can have several sides.
pub(super) struct Side {
    /// Name in a recording; empty for a party that is not a recording.
    pub name: String,
    pub held: Held,
}

/// The comparison of a side of one party with a side of the other party.
#[derive(Default)]
pub struct SidePair {
    /// Names of the sides in the recordings; empty for a party that is not a recording.
    pub names: [String; 2],
    /// Channel by channel, in the order of the party that sets the instants.
    pub channels: Vec<Compared>,
    /// If a scenario was solved: checks of the analytic sides against each other. If both parties have values of the
    /// input: a check of these values.
    pub checks: Vec<Check>,
    /// Number of instants at which the comparison takes place.
    pub instants: usize,
    /// Number of instants of the second party that the first party does not have.
    pub unshared: usize,
    /// Channels that only one of the two parties has.
    pub alone: [Vec<String>; 2],
    /// The first row at which time or crank angle reverses: the number of the row, the previous instant, and the
    /// instant of the row. See [`RowKey::turns_back`](crate::tables::RowKey::turns_back).
    pub turns_back: Option<(usize, [f64; 2])>,
    /// Two contradictory rows for one instant in the party that sets the instants. No cause is sought if such rows
    /// exist.
    pub contradiction: Option<Contradiction>,
    /// Whether the instants are values of the input: crank angles, for example.
    pub by_crank: bool,
    /// What the input measures.
    pub input: Input,
    /// Simple causes of the disagreements.
    pub causes: Vec<Explained>,
    /// Whether the search for causes ended at the limit of its work.
    pub is_search_cut: bool,
}

impl SidePair {
    /// Compares the claims of both parties; `party` sets the instants.
    pub(super) fn of(both: &Both, party: Which, claims: &[Claim]) -> SidePair {
        SidePair {
            channels: both.judged(claims),
            contradiction: contradiction(both, party, claims),
            instants: both.at.values.len(),
            by_crank: both.at.is_crank,
            input: both.input,
            turns_back: both.at.turns_back(),
            ..SidePair::default()
        }
    }

    /// Number of compared values, and the number that would result if no value were missing.
    #[must_use]
    pub fn values(&self) -> [usize; 2] {
        let judged = self.channels.iter().map(|own| own.judged).sum();
        [judged, self.channels.len() * (self.instants - self.unshared)]
    }

    /// Whether the inputs of both parties disagree.
    #[must_use]
    pub fn crank_is_off(&self) -> bool {
        let name = self.input.noun();
        let is_off = |check: &Check| check.family == name && matches!(check.verdict, Verdict::Disagree { .. });
        self.checks.iter().any(is_off)
    }

    /// The first row at which the difference in one of the named channels exceeds its bound.
    #[must_use]
    pub fn since(&self, channels: &[String]) -> Option<RowPair> {
        let own = self.channels.iter().filter(|own| channels.contains(&own.claim.text));
        own.filter_map(|own| own.since).min_by(|one, other| one.time.total_cmp(&other.time))
    }

    /// The verdict on all channels and checks.
    pub fn verdict(&self) -> Verdict {
        let channels = self.channels.iter().map(|channel| &channel.verdict);
        overall(channels.chain(self.checks.iter().map(|check| &check.verdict)))
    }
}

/// Two rows of a table for the same instant that contradict each other.
/// Such rows occur if a table contains two runs, or if the time does not advance.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// Indices of the two rows, from 0.
    pub rows: [usize; 2],
    /// The instant: a time (s) or a value of the input (SI).
    pub at: f64,
    /// The channel as named in the table.
    pub channel: String,
    /// Both values, in the unit of the channel.
    pub values: [f64; 2],
}

/// The first two rows of a party for the same instant whose values contradict each other: the rounding of values and
/// instant does not explain the difference.
fn contradiction(both: &Both, party: Which, claims: &[Claim]) -> Option<Contradiction> {
    let at = both.at;
    let order = at.ascending();
    let is_same = |pair: &[usize]| at.values[pair[0]].value == at.values[pair[1]].value;
    let pairs: Vec<[usize; 2]> = order.windows(2).filter(|pair| is_same(pair)).map(|pair| [pair[0], pair[1]]).collect();
    if pairs.is_empty() {
        return None;
    }
    claims.iter().enumerate().find_map(|(index, claim)| {
        let values = both.parties[party as usize].values_of(claim)?;
        let drift = |row: usize| both.drift.get(index).and_then(|drift| drift.get(row)).copied().unwrap_or(0.0);
        let differ = |[one, other]: &[usize; 2]| {
            let gap = values[*other].value - values[*one].value;
            let gap = claim.turn().map_or(gap, |turn| gap - turn * (gap / turn).round());
            gap.abs() > values[*one].error + values[*other].error + drift(*one) + drift(*other)
        };
        let rows = *pairs.iter().find(|pair| differ(pair))?;
        let values = rows.map(|row| values[row].value);
        Some(Contradiction { rows, at: at.values[rows[0]].value, channel: claim.text.clone(), values })
    })
}

/// Compares the values of the input (SI unit, as the scenario states them) of both parties at the same rows.
/// The rows were matched by their times, so comparing the inputs is an additional check.
/// `None` if the check is not requested, or if the parties have no row with both values.
/// `drift` is the uncertainty due to the digits of the times.
pub(super) fn crank_check(both: &Both, cranks: [&[Rounded]; 2], drift: &[f64]) -> Option<Check> {
    let measure = both.measure();
    let values: Vec<f64> = cranks[measure.party].iter().map(|own| own.value).filter(|own| own.is_finite()).collect();
    let (input, turn) = (both.input, both.input.period().map(|(turn, _)| turn));
    let allowed = both.how.allows_crank(half_range(&values), input);
    let mut allowance = allowed.unwrap_or_default();
    // The allowance includes the rounding error of subtracting whole revolutions.
    allowance.fixed += 4.0 * f64::EPSILON * turn.unwrap_or_default();
    let found = judge(&Beside { values: cranks, places: both.places(), drift, turn, allowance, measure });
    let worst = found.worst.filter(|_| both.how.asks_for_crank())?;
    let basis = BoundBasis::Wanted(sentences::BOTH_ARE_SAID_TO_COUNT_THE_CRANK);
    let tolerance = Tolerance { bound: worst.bound, basis };
    let mut check = Check::new(input.noun(), worst.difference.abs(), tolerance, input.unit());
    check.verdict = match found.since {
        Some(_) if !measure.is_analytic && allowed.is_none() => {
            Verdict::open(sentences::the_inputs_differ_and_neither(&input.noun()))
        }
        Some(at) => {
            let values = at.values.map(|value| input.shown(value));
            Verdict::Disagree { place: place(&RowPair { values, ..at }, input) }
        }
        None => Verdict::Agree { margin: 1.0 / worst.used() },
    };
    Some(check)
}
