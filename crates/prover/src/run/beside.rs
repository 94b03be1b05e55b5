//! The analytic sides without engines. Each side is compared with external numbers or, without such numbers, with the
//! other side.

use super::checks;
use super::each_side::{EachSide, Reference};
use super::entrants::TRUE_SIDES;
use super::known::Known;
use super::observe::{Watch, observe};
use crate::bounds::{Check, Verdict, difference, overall, scales};
use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use linkage::work::{Work, counted};

/// Comparison of one channel of a side with the values that count as true: external numbers, or the other side.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// The channel.
    pub channel: Channel,
    /// Largest error divided by the channel's scale.
    pub error: f64,
    /// Bound at the instant of the largest error: the known errors of the sides, divided by the channel's scale.
    pub bound: f64,
    /// Largest ratio of error to bound at any instant.
    pub used: f64,
}

/// One analytic side.
#[derive(Clone, Debug)]
pub struct AnalyticSide {
    /// Name of the solver.
    pub name: &'static str,
    /// Every compared channel; empty if the side failed, or if there are no values to compare with.
    pub deviations: Vec<Deviation>,
    /// Largest opening of a joint, divided by the larger of two lengths: the mechanism's size and the largest distance
    /// of a joint from the origin.
    pub closure: Option<f64>,
    /// Largest difference between the balancing moment from equilibrium and the balancing moment from powers, divided
    /// by the largest moment on the driving link.
    pub balance: Option<f64>,
    /// Work done to solve the case.
    pub work: Work,
    /// Reason why the side has no numbers.
    pub failure: Option<Error>,
}

/// Both analytic sides.
#[derive(Clone, Debug)]
pub struct BothSides {
    /// Side 1 and side 2.
    pub sides: [AnalyticSide; 2],
    /// The checks on the sides, the same as in a proof; empty if a side failed.
    pub checks: Vec<Check>,
    /// The overall verdict of `checks`; inconclusive if a side failed.
    pub verdict: Verdict,
    /// Number of channels of the sides that deviate from external numbers by more than their bounds although every
    /// check agrees.
    pub silent: usize,
    /// The trajectory of the first side that has one.
    pub trajectory: Option<Trajectory>,
}

/// Solves a case with both sides and judges the sides as in a proof. If `truth` is given, compares both sides with
/// these numbers.
///
/// # Errors
/// If `truth` has another grid. A failure of a side is not an error but a part of the result.
pub fn sides(case: &Case, truth: Option<&Trajectory>) -> Result<BothSides> {
    let solve = |side: &dyn Solver| observe(case, side, Watch::Side, &mut |_| {}).map_err(Error::from);
    let found = EachSide::of(|side| counted(|| solve(TRUE_SIDES[side].solver)));
    let solved = |side: Reference| found[side].0.as_ref().ok();
    let bare = |side: Reference| {
        let (name, work) = (side.name(), found[side].1);
        AnalyticSide { name, deviations: Vec::new(), closure: None, balance: None, work, failure: None }
    };
    let failed = |side: Reference, error: &Error| AnalyticSide { failure: Some(error.clone()), ..bare(side) };
    let Some(reference) = Reference::ALL.into_iter().find(|side| solved(*side).is_some()) else {
        let error = |side: Reference| found[side].0.as_ref().expect_err("no side has a trajectory");
        let sides = Reference::ALL.map(|side| failed(side, error(side)));
        let verdict = Verdict::open(sides[0].failure.as_ref().map_or("", Error::message));
        return Ok(BothSides { sides, checks: Vec::new(), verdict, silent: 0, trajectory: None });
    };
    let solver = TRUE_SIDES[reference].solver;
    let trajectory = |side: Reference| solved(side).map(|own| &own.trajectory);
    let own = trajectory(reference).expect("it has one");
    // A side without a trajectory gets the known errors of the other side.
    let beside = EachSide::of(|side| {
        trajectory(side).map_or((TRUE_SIDES[reference].tight, own), |own| (TRUE_SIDES[side].tight, own))
    });
    let mut known = Known::beside(case, reference, solver, beside)?;
    let judged = |known: &Known| {
        EachSide::tried(|side| match (trajectory(side), truth.or_else(|| trajectory(side.other()))) {
            (Some(own), Some(against)) => deviations(against, own, known),
            _ => Ok(Vec::new()),
        })
    };
    let mut deviating = judged(&known)?;
    let sides_differ = match Reference::ALL.map(trajectory) {
        [Some(first), Some(second)] => checks::sides_differ([first, second], &known),
        _ => false,
    };
    if sides_differ || deviating.pair().into_iter().flatten().any(|own| !(own.used <= 1.0)) {
        known.measure(case, solver)?;
        deviating = judged(&known)?;
    }
    let checks = match Reference::ALL.map(solved) {
        [Some(first), Some(second)] => checks::of_sides(case, EachSide::new(first, second), &known),
        _ => Vec::new(),
    };
    let size = case.mechanism.size();
    let mut verdict = None;
    let sides = Reference::ALL.map(|side| match &found[side].0 {
        Ok(own) => AnalyticSide {
            deviations: std::mem::take(&mut deviating[side]),
            closure: Some(own.closure() / size.larger(own.reach)),
            balance: (!own.power.is_empty()).then(|| own.two_ways()),
            ..bare(side)
        },
        Err(error) => {
            verdict = Some(Verdict::open(format!("{} fails: {}", side.name(), error.message())));
            failed(side, error)
        }
    });
    let verdict = overall(checks.iter().map(|check| &check.verdict).chain(&verdict));
    let beyond = sides.iter().flat_map(|side| &side.deviations).filter(|own| !(own.used <= 1.0)).count();
    let agrees = matches!(verdict, Verdict::Agree { .. } | Verdict::Expected { .. });
    let silent = if agrees && truth.is_some() { beyond } else { 0 };
    Ok(BothSides { sides, checks, verdict, silent, trajectory: Some(own.clone()) })
}

/// Compares every channel of a trajectory with the true values.
fn deviations(truth: &Trajectory, own: &Trajectory, known: &Known) -> Result<Vec<Deviation>> {
    let errors = difference(truth, own)?;
    let scales = scales(truth);
    let of = |(index, (channel, values)): (usize, (&Channel, &[f64]))| {
        let (scale, stage) = (scales[index], channel.kind.stage);
        let mut found = Deviation { channel: channel.clone(), error: 0.0, bound: 0.0, used: 0.0 };
        for (row, value) in values.iter().enumerate() {
            let bound = known.apart(stage, index, row) * known.magnitudes[index];
            let error = share(value.abs(), scale);
            if row == 0 || !(error <= found.error) {
                (found.error, found.bound) = (error, share(bound, scale));
            }
            found.used = found.used.larger(share(value.abs(), bound));
        }
        found
    };
    Ok(errors.iter().enumerate().map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use analytic::AssurSolver;
    use fixtures::of_repository;
    use linkage::case::Grid;

    /// The external numbers are wrong at a single instant in the middle of the run. The comparison detects the error
    /// in every channel.
    #[test]
    fn external_numbers_wrong_at_one_instant_are_found() {
        let case = of_repository("scenarios/crank_rocker.toml").case;
        let cranks = [0.0, 1.0, 2.0, 3.0].to_vec();
        let case = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap();
        let right = AssurSolver.solve(&case).unwrap();
        let moved = |(_, values): (&Channel, &[f64])| [values[0], values[1], values[2] + 1e-3, values[3]].to_vec();
        let (times, cranks) = (right.times().to_vec(), right.inputs().to_vec());
        let truth =
            Trajectory::new(times, cranks, right.channels().to_vec(), right.iter().map(moved).collect()).unwrap();
        let found = sides(&case, Some(&truth)).unwrap();
        assert_eq!(found.silent, 2 * truth.channels().len());
        for (own, scale) in found.sides.iter().flat_map(|side| side.deviations.iter().zip(scales(&truth))) {
            assert!((own.error * scale / 1e-3 - 1.0).abs() < 1e-6, "{own:?}");
            assert!((own.used * own.bound / own.error - 1.0).abs() < 1e-6 && own.used > 1e3, "{own:?}");
        }
    }
}
