//! Channel by channel: differences, bounds, verdicts.

use super::allowed::How;
use crate::compare::{Verdict, scales};
use crate::scenario::Claim;
use crate::tables::{At, Held};
use formula::{Rounded, Shape};
use linkage::error::{Advice, Result};
use linkage::math::statistics::half_range;
use linkage::math::{KeepNan, largest_size};
use linkage::trajectory::Trajectory;

/// One row of a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its number in the party that gives the instants.
    pub row: usize,
    /// Time (s); NaN where none is known.
    pub time: f64,
    /// Crank angle (rad, as the scenario states it); NaN where none is known.
    pub crank: f64,
    /// What the first and the second party say, in the unit of the claim.
    pub values: [f64; 2],
    /// Second less first; for angles without whole turns.
    pub difference: f64,
    /// How far they may be apart.
    pub bound: f64,
}

/// A channel, or an arithmetic of channels, of both parties.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The channel in its unit.
    pub claim: Claim,
    /// Number of instants compared.
    pub judged: usize,
    /// Number of instants at which one of the two has no number.
    pub missing: usize,
    /// Half the range over the run, at least a thousandth of what is natural for its quantity; in the claim's unit.
    pub scale: f64,
    /// Root of the mean square of the differences.
    pub rms: f64,
    /// The largest difference.
    pub largest: Option<Row>,
    /// The instant that uses most of its bound.
    pub worst: Option<Row>,
    /// The first instant beyond its bound.
    pub since: Option<Row>,
    /// Whether the bound is what is known of both parties, and nothing is allowed besides.
    pub is_derived: bool,
    /// Agreement within the bounds of all instants.
    pub verdict: Verdict,
}

impl Row {
    /// Share of the bound that is used.
    #[must_use]
    pub fn used(&self) -> f64 {
        let used = if self.difference == 0.0 { 0.0 } else { self.difference.abs() / self.bound };
        if used.is_nan() { f64::INFINITY } else { used }
    }
}

/// Both parties at the same rows.
pub(super) struct Both<'a> {
    pub parties: [&'a Held; 2],
    pub at: &'a At,
    /// Times and crank angles of rows as far as somebody knows them.
    pub places: [Vec<f64>; 2],
    pub how: &'a How,
}

/// Share of its scale beyond which what interpolation and instants leave open proves nothing.
const TELLING: f64 = 1e-2;

impl Both<'_> {
    /// All claims that both parties have.
    pub(super) fn judged(&self, claims: &[Claim]) -> Result<Vec<Compared>> {
        let known: Vec<(&Claim, [Vec<Rounded>; 2])> = claims
            .iter()
            .filter_map(|claim| {
                let [one, other] = self.parties;
                Some((claim, [one.values_of(claim)?, other.values_of(claim)?]))
            })
            .collect();
        let scales = self.scales(&known)?;
        Ok(known.into_iter().zip(scales).map(|((claim, values), scale)| self.channel(claim, &values, scale)).collect())
    }

    /// The scale of every channel as in a proof; that of an arithmetic is half its range, or a tenth of its size.
    fn scales(&self, known: &[(&Claim, [Vec<Rounded>; 2])]) -> Result<Vec<f64>> {
        let party = usize::from(!self.parties[0].is_analytic && self.parties[1].is_analytic);
        let rows: Vec<usize> = (0..self.at.values.len())
            .filter(|&row| known.iter().all(|(_, own)| own[party][row].value.is_finite()))
            .collect();
        let numbers = |values: &[Rounded]| -> Vec<f64> { rows.iter().map(|&row| values[row].value).collect() };
        let own = |values: &[f64]| half_range(values).larger(0.1 * largest_size(values));
        let (mut channels, mut columns) = (Vec::new(), Vec::new());
        for (claim, values) in known {
            if matches!(claim.tree.shape, Shape::Name(_)) {
                let channel = &claim.channels[0].1;
                channels.push(channel.channel.clone());
                columns.push(numbers(&values[party]).iter().map(|&value| channel.to_si(value)).collect::<Vec<f64>>());
            }
        }
        let place = |of: usize| -> Vec<f64> {
            rows.iter().map(|&row| self.places[of][row]).map(|at| if at.is_finite() { at } else { 0.0 }).collect()
        };
        let mut of_channels = scales(&Trajectory::new(place(0), place(1), channels, columns)?).into_iter();
        let of = |(claim, values): &(&Claim, [Vec<Rounded>; 2])| match &claim.tree.shape {
            Shape::Name(_) => of_channels.next().unwrap_or(0.0) / claim.channels[0].1.to_si(1.0),
            Shape::Number(_) | Shape::Negative(_) | Shape::Pair(..) | Shape::Call(..) => own(&numbers(&values[party])),
        };
        Ok(known.iter().map(of).collect())
    }

    fn channel(&self, claim: &Claim, values: &[Vec<Rounded>; 2], scale: f64) -> Compared {
        let turn = claim.turn();
        let allowed = self.how.allows(claim, scale);
        let drift = self.drift(&values[0], turn);
        let mut own = Compared {
            claim: claim.clone(),
            judged: 0,
            missing: 0,
            scale,
            rms: 0.0,
            largest: None,
            worst: None,
            since: None,
            is_derived: allowed.is_none(),
            verdict: Verdict::open("nothing was compared"),
        };
        let (mut squares, mut widest) = (0.0, 0.0f64);
        for (row, (&one, &other)) in values[0].iter().zip(&values[1]).enumerate() {
            if one.value.is_nan() || other.value.is_nan() {
                own.missing += 1;
                continue;
            }
            let gap = other.value - one.value;
            let difference = turn.map_or(gap, |turn| gap - turn * (gap / turn).round());
            let known = one.error + other.error + drift[row];
            widest = widest.larger(known);
            let bound = known + allowed.unwrap_or(0.0);
            let [time, crank] = [0, 1].map(|of: usize| self.places[of][row]);
            let at = Row { row, time, crank, values: [one.value, other.value], difference, bound };
            own.judged += 1;
            squares += difference * difference;
            if own.largest.is_none_or(|largest| difference.abs() > largest.difference.abs()) {
                own.largest = Some(at);
            }
            if own.worst.is_none_or(|worst| at.used() > worst.used()) {
                own.worst = Some(at);
            }
            let is_earlier = |since: Row| if time.is_nan() { crank < since.crank } else { time < since.time };
            if !(at.used() <= 1.0) && own.since.is_none_or(is_earlier) {
                own.since = Some(at);
            }
        }
        own.rms = (squares / own.judged.max(1) as f64).sqrt();
        own.verdict = self.verdict(&own, widest);
        own
    }

    fn verdict(&self, own: &Compared, widest: f64) -> Verdict {
        let Some(worst) = own.worst else {
            return Verdict::open("at no instant do both have a number");
        };
        let is_known = self.parties.iter().any(|party| party.is_analytic);
        let open = |reason: String, advice: &str| Verdict::Inconclusive {
            reason,
            advice: vec![Advice::Text(advice.to_string())],
        };
        match own.since {
            Some(_) if own.is_derived && !is_known => open(
                format!("they differ by up to {:.3e}, and neither is analytic, so that no bound is known", {
                    own.largest.map_or(0.0, |largest| largest.difference.abs())
                }),
                "say what difference is allowed",
            ),
            Some(since) => Verdict::Disagree { place: place(&since) },
            None if widest > TELLING * own.scale && own.is_derived => open(
                format!(
                    "the numbers are known to {:.1e} of their scale only: digits, instants or interpolation",
                    widest / own.scale
                ),
                "give more digits or closer instants, or say what difference is allowed",
            ),
            None => Verdict::Agree { margin: 1.0 / worst.used() },
        }
    }

    /// What the digits of the instants leave open: as much as the values change meanwhile.
    fn drift(&self, values: &[Rounded], turn: Option<f64>) -> Vec<f64> {
        let at = &self.at.values;
        let mut drift = vec![0.0; values.len()];
        if at.iter().all(|at| at.error == 0.0) {
            return drift;
        }
        for pair in self.at.ascending().windows(2) {
            let gap = values[pair[1]].value - values[pair[0]].value;
            let gap = turn.map_or(gap, |turn| gap - turn * (gap / turn).round());
            let span = at[pair[1]].value - at[pair[0]].value;
            let slope = if span > 0.0 { (gap / span).abs() } else { 0.0 };
            for &row in pair {
                drift[row] = drift[row].larger(slope * at[row].error);
            }
        }
        drift
    }
}

/// Where, and what stands there.
fn place(at: &Row) -> String {
    let Row { time, crank, values: [one, other], .. } = at;
    let when = match (time.is_nan(), crank.is_nan()) {
        (false, false) => format!("t = {time:.6} s, crank angle {:.3} deg", crank.to_degrees()),
        (false, true) => format!("t = {time:.6} s"),
        (true, _) => format!("crank angle {:.3} deg", crank.to_degrees()),
    };
    format!("first at {when}: {one:.9e} against {other:.9e}")
}
