//! Two tables side by side: rows of the same instants, or the first interpolated at those of the second.

use super::allowed::How;
use super::interpolate::Course;
use super::judge::Both;
use super::pair::{Pair, Side};
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
    let places = places(&from, &to, how.interpolates);
    let unshared = places.iter().filter(|place| matches!(place, Place::Nowhere)).count();
    if unshared == to.values.len() {
        let what = if from.is_crank { "crank angle" } else { "time" };
        let message = format!("no {what} of the second party is one of the first");
        return Err(Error::new(ErrorKind::Input, message)
            .help("allow interpolation, or give both the same instants; check the units of both"));
    }
    let column = |claim: &Claim| {
        let values = at_places(&one.1.values_of(claim)?, &from, &places, claim.turn());
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
    let (instants, by_crank, turns_back) = (to.values.len(), to.is_crank, to.turns_back());
    let (checks, causes) = (Vec::new(), Vec::new());
    Ok(Pair { names, channels, checks, instants, unshared, alone, turns_back, by_crank, causes })
}

/// Where an instant of the second party lies among the rows of the first.
enum Place {
    /// At a row.
    At(usize),
    /// Between two rows, in order to be interpolated.
    Between(f64),
    /// Between two rows, and nothing is interpolated; or beyond all of them.
    Nowhere,
}

fn places(from: &At, to: &At, interpolates: bool) -> Vec<Place> {
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
            [Some(_), Some(_)] if interpolates => Place::Between(wanted.value),
            _ => Place::Nowhere,
        }
    };
    to.values.iter().map(of).collect()
}

/// The numbers of a claim at some places among the rows that hold at `from`.
fn at_places(values: &[Rounded], from: &At, places: &[Place], turn: Option<f64>) -> Vec<Rounded> {
    let order = from.ascending();
    let at: Vec<f64> = order.iter().map(|&row| from.values[row].value).collect();
    let sorted: Vec<Rounded> = order.iter().map(|&row| values[row]).collect();
    let course = Course::new(&at, &sorted, turn);
    let of = |place: &Place| match place {
        Place::At(row) => values[*row],
        Place::Between(wanted) => course.value(*wanted),
        Place::Nowhere => Rounded::exact(f64::NAN),
    };
    places.iter().map(of).collect()
}
