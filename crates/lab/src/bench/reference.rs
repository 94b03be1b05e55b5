//! The reference and its uncertainty.

use super::options::CLEAR;
use super::point::Errors;
use crate::sentences;
use analytic::range::explained;
use analytic::{AssurSolver, NewtonSolver, TIGHT_ASSUR, TIGHT_NEWTON};
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Stage, Trajectory};
use prover::bounds::residuals;

/// In free motion, the reference is a run with tighter accuracy.
/// The reference's estimated integration error is this fraction of the difference between the reference and a run at
/// the usual accuracy.
/// In every step, the tighter accuracy allows a hundredth of the usual error.
/// The constant is this hundredth times a factor of four, the margin `SAFETY` of `prover::run::known`.
const LEFT: f64 = 0.04;

/// The error of the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    /// The reference, in words.
    pub reference: &'static str,
    /// Basis of the reference's error, in words.
    pub basis: &'static str,
    /// Error by stage divided by the scales, in the order of [`Stage::ALL`]; at least the machine epsilon.
    pub errors: [f64; Stage::ALL.len()],
}

impl Floor {
    /// The errors of a point. Errors below `CLEAR` times the reference's error are marked as limited.
    pub fn judged(&self, stage: Stage, [max, rms]: [f64; 2]) -> Errors {
        Errors { max, rms, is_limited: !(max >= CLEAR * self.errors[stage as usize]) }
    }
}

/// The reference of a case, and the reference's error.
///
/// # Errors
/// The errors of the analytic sides, which compute the reference.
pub(super) fn of(case: &Case) -> Result<(Trajectory, Floor)> {
    let solved = |solver: &dyn Solver| solver.solve(case).map_err(|error| explained(case, error));
    if case.is_free() {
        let (tight, other) = (solved(&TIGHT_ASSUR)?, solved(&TIGHT_NEWTON)?);
        let (between, left) = (apart(&tight, &other)?, apart(&tight, &solved(&AssurSolver)?)?);
        let errors = std::array::from_fn(|stage| between[stage][0].larger(LEFT * left[stage][0]).larger(f64::EPSILON));
        let basis = sentences::DIFFERENCE_OF_BOTH_SIDES_AT_THE_TIGHTER;
        return Ok((tight, Floor { reference: sentences::SIDE_ASSUR_INTEGRATED_A_HUNDRED, basis, errors }));
    }
    let (first, second) = (solved(&AssurSolver)?, solved(&NewtonSolver)?);
    let between = apart(&first, &second)?;
    let errors = std::array::from_fn(|stage| between[stage][0].larger(f64::EPSILON));
    Ok((first, Floor { reference: sentences::SIDE_ASSUR, basis: sentences::DIFFERENCE_OF_THE_TWO_SIDES, errors }))
}

/// Largest error and largest root mean square by stage, divided by the reference's scales.
/// Only the channels that both trajectories have are compared.
///
/// # Errors
/// An error is returned if the grids differ.
pub(super) fn apart(reference: &Trajectory, found: &Trajectory) -> Result<[[f64; 2]; Stage::ALL.len()]> {
    let mut worst = [[0.0f64; 2]; Stage::ALL.len()];
    for residual in residuals(reference, found)? {
        let own = &mut worst[residual.channel.kind.stage as usize];
        let scale = if residual.scale > 0.0 { residual.scale } else { 1.0 };
        *own = [own[0].larger(residual.share()), own[1].larger(residual.rms / scale)];
    }
    Ok(worst)
}
