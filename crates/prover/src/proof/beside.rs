//! The analytic sides by themselves: each against numbers from outside, or against the other side where there are none.

use super::checks;
use super::entrants::TRUE_SIDES;
use super::known::Known;
use super::observe::{Observed, Watch, observe};
use super::sensitivity;
use crate::compare::{Check, Verdict, difference, overall, scales};
use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use linkage::work::{Work, counted};

/// A channel of a side beside its truth.
#[derive(Clone, Debug)]
pub struct Deviation {
    /// The channel.
    pub channel: Channel,
    /// Largest error, as a share of the channel's scale.
    pub error: f64,
    /// What the sides know of their numbers at the instant of that error, as a share of the scale.
    pub bound: f64,
    /// Largest error over bound at any instant.
    pub used: f64,
}

/// One analytic side.
#[derive(Clone, Debug)]
pub struct Side {
    /// Name of the solver.
    pub name: &'static str,
    /// Every channel beside its truth; empty if the side failed, or if there is nothing to hold it against.
    pub deviations: Vec<Deviation>,
    /// Largest opening of a joint over the size of the mechanism or its distance from the origin.
    pub closure: Option<f64>,
    /// Balancing moment from equilibrium less that from powers, over the moments in the balance.
    pub balance: Option<f64>,
    /// What it has done.
    pub work: Work,
    /// Why there are no numbers.
    pub failure: Option<Error>,
}

/// Both analytic sides.
#[derive(Clone, Debug)]
pub struct Sides {
    /// Side 1 and side 2.
    pub sides: [Side; 2],
    /// The checks that a proof makes of the sides; none if one failed.
    pub checks: Vec<Check>,
    /// The verdict of these checks. A side that fails leaves it open.
    pub verdict: Verdict,
    /// Number of channels of a side that are beyond what is known of them against numbers from outside, while every
    /// check agrees.
    pub silent: usize,
    /// The trajectory of the first side that has one.
    pub trajectory: Option<Trajectory>,
}

/// Both sides on a case, against `truth` where it is given, and judged as in a proof.
///
/// # Errors
/// If `truth` stands on another grid. A side that fails is part of the result.
pub fn sides(case: &Case, truth: Option<&Trajectory>) -> Result<Sides> {
    let solve = |side: &dyn Solver| observe(case, side, Watch::Side, &mut |_| {}).map_err(Error::from);
    let counted = TRUE_SIDES.map(|side| (side.solver, counted(|| solve(side.solver))));
    let works = counted.each_ref().map(|(_, (_, work))| *work);
    let found = counted.map(|(side, (own, _))| (side, own));
    let names = found.each_ref().map(|(side, _)| side.name());
    let solved = |index: usize| Some((TRUE_SIDES[index].tight, &found[index].1.as_ref().ok()?.trajectory));
    let solved: Vec<(&dyn Solver, &Trajectory)> = (0..2).filter_map(solved).collect();
    let failed = |index: usize, error: &Error| Side {
        name: names[index],
        deviations: Vec::new(),
        closure: None,
        balance: None,
        work: works[index],
        failure: Some(error.clone()),
    };
    let (Some(&reference), Some(&other)) = (solved.first(), solved.last()) else {
        let sides = [0, 1].map(|index| failed(index, found[index].1.as_ref().expect_err("no side has a trajectory")));
        let verdict = Verdict::open(sides[0].failure.as_ref().map_or("", Error::message));
        return Ok(Sides { sides, checks: Vec::new(), verdict, silent: 0, trajectory: None });
    };
    let solver = found.iter().find(|(_, own)| own.is_ok()).expect("one side has a trajectory").0;
    let mut known = Known::beside(case, [reference, other], &sensitivity::of(case, solver, reference.1)?)?;
    let judged = |known: &Known| -> Result<[Vec<Deviation>; 2]> {
        let mut all = [Vec::new(), Vec::new()];
        for (index, (_, own)) in found.iter().enumerate() {
            let against = match truth {
                Some(truth) => Some(truth),
                None => found[1 - index].1.as_ref().ok().map(|other| &other.trajectory),
            };
            if let (Ok(own), Some(against)) = (own, against) {
                all[index] = deviations(against, &own.trajectory, known)?;
            }
        }
        Ok(all)
    };
    let mut deviating = judged(&known)?;
    let sides_differ = match [0, 1].map(|side| found[side].1.as_ref().map(|own| &own.trajectory)) {
        [Ok(first), Ok(second)] => checks::sides_differ([first, second], &known),
        _ => false,
    };
    if sides_differ || deviating.iter().flatten().any(|own| !(own.used <= 1.0)) {
        known.measure(case, solver)?;
        deviating = judged(&known)?;
    }
    let mut checks = Vec::new();
    let mut verdict = None;
    let [first, second] = found;
    let [first, second] = match (first.1, second.1) {
        (Ok(first), Ok(second)) => {
            let observed = [(names[0], first), (names[1], second)];
            checks = checks::of_sides(case, &observed, &known);
            observed.map(|(_, own)| Ok(own))
        }
        other => [other.0, other.1],
    };
    let size = case.mechanism.size();
    let [of_first, of_second] = deviating;
    let mut side = |index: usize, own: std::result::Result<Observed, Error>, deviations: Vec<Deviation>| match own {
        Ok(own) => Side {
            name: names[index],
            deviations,
            closure: Some(own.closure() / size.larger(own.reach)),
            balance: (!own.power.is_empty()).then(|| own.two_ways()),
            work: works[index],
            failure: None,
        },
        Err(error) => {
            verdict = Some(Verdict::open(format!("{} fails: {}", names[index], error.message())));
            failed(index, &error)
        }
    };
    let trajectory = reference_of(&first, &second);
    let sides = [side(0, first, of_first), side(1, second, of_second)];
    let verdict = overall(checks.iter().map(|check| &check.verdict).chain(&verdict));
    let beyond = sides.iter().flat_map(|side| &side.deviations).filter(|own| !(own.used <= 1.0)).count();
    let agrees = matches!(verdict, Verdict::Agree { .. } | Verdict::Expected { .. });
    let silent = if agrees && truth.is_some() { beyond } else { 0 };
    Ok(Sides { sides, checks, verdict, silent, trajectory })
}

fn reference_of(
    first: &std::result::Result<Observed, Error>,
    second: &std::result::Result<Observed, Error>,
) -> Option<Trajectory> {
    [first, second].into_iter().find_map(|own| Some(own.as_ref().ok()?.trajectory.clone()))
}

/// Every channel of a trajectory beside its truth.
fn deviations(truth: &Trajectory, own: &Trajectory, known: &Known) -> Result<Vec<Deviation>> {
    let errors = difference(truth, own)?;
    let scales = scales(truth);
    let of = |(index, (channel, values)): (usize, (&Channel, &[f64]))| {
        let (scale, stage) = (scales[index], channel.kind.stage);
        let mut found = Deviation { channel: channel.clone(), error: 0.0, bound: 0.0, used: 0.0 };
        for (row, value) in values.iter().enumerate() {
            let bound = known.apart(stage, index, row) * known.magnitude(index);
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
    use linkage::case::Grid;
    use scenario::of_repository;

    /// At one instant between others, in every channel.
    #[test]
    fn numbers_from_outside_that_are_off_at_one_instant_are_seen() {
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
