//! Two tables side by side: rows of the same instants, or the first interpolated at those of the second.

use super::judge::Both;
use super::{How, Pair, Side};
use crate::scenario::Claim;
use crate::tables::{At, Column, Held, Instants};
use formula::Rounded;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

/// Share of the distance of two rows within which an instant is one of them.
const SAME: f64 = 1e-6;

/// Compares two parties at the instants of the second.
pub(super) fn beside(one: &Side, other: &Side, how: &How) -> Result<Pair> {
    let by_crank = how.by_crank.or_else(|| {
        // By what both have.
        let has_times = [one, other].iter().all(|side| side.1.at.times.is_some());
        Some(!has_times)
    });
    let (from, to) = (one.1.at(by_crank)?, other.1.at(by_crank)?);
    let wanted: Vec<Claim> =
        other.1.columns.iter().map(|own| own.claim.clone()).filter(|claim| how.asks_for(claim)).collect();
    let claims: Vec<Claim> = wanted.iter().filter(|claim| one.1.values_of(claim).is_some()).cloned().collect();
    let lacks = |of: &Held, in_it: &Held| -> Vec<String> {
        let own = of.columns.iter().filter(|own| in_it.values_of(&own.claim).is_none());
        own.map(|own| own.claim.text.clone()).collect()
    };
    let alone = [lacks(&one.1, &other.1), lacks(&other.1, &one.1)];
    if claims.is_empty() {
        let some = |names: &[String]| names.iter().take(5).cloned().collect::<Vec<_>>().join(", ");
        let message = format!("the two have no channel in common: {} against {}", some(&alone[0]), some(&alone[1]));
        return Err(Error::new(ErrorKind::Input, message).help("map the columns of both to the same channels"));
    }
    let places: Vec<Place> = place(&from, &to, how.interpolates);
    let unshared = places.iter().filter(|place| matches!(place, Place::Nowhere)).count();
    if unshared == to.values.len() {
        let what = if from.is_crank { "crank angle" } else { "time" };
        let message = format!("no {what} of the second party is one of the first");
        return Err(Error::new(ErrorKind::Input, message)
            .help("allow interpolation, or give both the same instants; check the units of both"));
    }
    let column = |claim: &Claim| {
        let values = unwound(&one.1.values_of(claim)?, &from, claim.turn());
        let values = places.iter().map(|place| place.of(&values, &from)).collect();
        Some(Column { claim: claim.clone(), values, mapped: None })
    };
    let columns = claims.iter().filter_map(column).collect();
    let first = Held { at: Instants::default(), columns, is_analytic: one.1.is_analytic, unused: Vec::new() };
    let known = |of: &Option<Vec<Rounded>>| match of {
        Some(values) => values.iter().map(|at| at.value).collect(),
        None => vec![f64::NAN; to.values.len()],
    };
    let both = Both {
        parties: [&first, &other.1],
        at: &to,
        places: [known(&other.1.at.times), known(&other.1.at.cranks)],
        how,
    };
    let channels = both.judged(&claims)?;
    let names = [one.0.clone(), other.0.clone()];
    let (instants, by_crank) = (to.values.len(), to.is_crank);
    Ok(Pair { names, channels, checks: Vec::new(), instants, unshared, alone, by_crank, causes: Vec::new() })
}

/// Where an instant of the second party lies among the rows of the first.
enum Place {
    /// At a row.
    At(usize),
    /// Between rows: four of them around it, and the instant.
    Between([usize; 4], f64),
    /// Between two rows, and nothing is interpolated; or beyond all of them.
    Nowhere,
}

fn place(from: &At, to: &At, interpolates: bool) -> Vec<Place> {
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
            [Some(before), Some(_)] if interpolates && order.len() >= 4 => {
                let first = before.saturating_sub(1).min(order.len() - 4);
                Place::Between([0, 1, 2, 3].map(|index| order[first + index]), wanted.value)
            }
            _ => Place::Nowhere,
        }
    };
    to.values.iter().map(of).collect()
}

impl Place {
    /// The value there: the cubic through the four rows. Its error is what it differs by from the two parabolas through
    /// three of them; the cubic itself is better.
    fn of(&self, values: &[Rounded], from: &At) -> Rounded {
        match self {
            Place::At(row) => values[*row],
            Place::Nowhere => Rounded::exact(f64::NAN),
            Place::Between(rows, wanted) => {
                let at = rows.map(|row| from.values[row].value);
                let through = |first: usize, count: usize| -> [f64; 2] {
                    let own = first..first + count;
                    let weight = |index: usize| -> f64 {
                        let others = own.clone().filter(|&other| other != index);
                        others.map(|other| (wanted - at[other]) / (at[index] - at[other])).product()
                    };
                    own.clone().fold([0.0, 0.0], |[sum, error], index| {
                        let (weight, value) = (weight(index), values[rows[index]]);
                        [sum + weight * value.value, error + weight.abs() * value.error]
                    })
                };
                let [value, error] = through(0, 4);
                let apart = [0, 1].map(|first| (through(first, 3)[0] - value).abs());
                Rounded { value, error: error + apart[0].larger(apart[1]) }
            }
        }
    }
}

/// Angles without jumps by a turn from row to row, so that they may be interpolated.
fn unwound(values: &[Rounded], at: &At, turn: Option<f64>) -> Vec<Rounded> {
    let Some(turn) = turn else { return values.to_vec() };
    let mut unwound = values.to_vec();
    let mut last: Option<f64> = None;
    for row in at.ascending() {
        if let Some(last) = last.filter(|_| unwound[row].value.is_finite()) {
            let gap = unwound[row].value - last;
            unwound[row].value -= turn * (gap / turn).round();
        }
        if unwound[row].value.is_finite() {
            last = Some(unwound[row].value);
        }
    }
    unwound
}
