//! Rows of a table that hold at the same instant and contradict each other: of two runs one behind the other, or of a
//! time that stands still.

use super::judge::Both;
use scenario::Claim;

/// Two rows of a table at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// Their numbers, from 0.
    pub rows: [usize; 2],
    /// The instant: a time (s) or a crank angle (rad).
    pub at: f64,
    /// The channel, as the table says it.
    pub channel: String,
    /// What stands there, in the unit of the channel.
    pub values: [f64; 2],
}

/// The first two rows of a party at one instant whose numbers are farther apart than their digits, and those of the
/// instant, allow.
pub(super) fn found(both: &Both, party: usize, claims: &[Claim]) -> Option<Contradiction> {
    let at = both.at;
    let order = at.ascending();
    let is_same = |pair: &[usize]| at.values[pair[0]].value == at.values[pair[1]].value;
    let pairs: Vec<[usize; 2]> = order.windows(2).filter(|pair| is_same(pair)).map(|pair| [pair[0], pair[1]]).collect();
    if pairs.is_empty() {
        return None;
    }
    claims.iter().enumerate().find_map(|(index, claim)| {
        let values = both.parties[party].values_of(claim)?;
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
