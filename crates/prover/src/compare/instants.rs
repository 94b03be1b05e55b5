//! Uncertainty due to rounded instants, if one party is a scenario, which can be solved at shifted instants.

use crate::check::KnownTrajectory;
use crate::run::shifted::{Along, grow, is_exact, shifted};
use crate::run::solved::Solved;
use crate::tables::{PartyColumn, RowKey};
use analytic::AssurSolver;
use formula::Rounded;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::trajectory::Trajectory;
use scenario::Claim;

/// Uncertainty of numbers due to the rounding of their instants, row by row; empty if the instants are exact.
#[derive(Default)]
pub(super) struct Drift {
    /// Uncertainty by claim, in the claim's unit.
    pub claims: Vec<Vec<f64>>,
    /// Uncertainty of the crank angle (rad).
    pub crank: Vec<f64>,
}

/// The largest change of every claim within the rounding of the instants: see [`shifted`].
/// If the scenario cannot be solved within this rounding, the change is estimated from neighbouring rows.
pub(super) fn drift(solved: &Solved, columns: &[PartyColumn], at: &RowKey, rows: &[usize]) -> Drift {
    let trajectory = solved.trajectory();
    let mut slack = vec![0.0; trajectory.times().len()];
    for (own, &row) in at.values.iter().zip(rows) {
        slack[row] = slack[row].larger(if is_exact(own.value, own.error) { 0.0 } else { own.error });
    }
    if slack.iter().all(|slack| *slack == 0.0) {
        return Drift::default();
    }
    let of_rows = |of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    if let Ok(Drift { claims, crank }) = by_solving(solved, columns, at, &slack) {
        return Drift { claims: claims.iter().map(|own| of_rows(own)).collect(), crank: of_rows(&crank) };
    }
    let (instants, order) = (at.values.iter().map(|at| at.value).collect::<Vec<f64>>(), at.ascending());
    let slack = of_rows(&slack);
    let along = |values: &[Rounded], turn| columns::drift(values, &instants, &slack, &order, turn);
    let cranks: Vec<Rounded> = of_rows(trajectory.inputs()).into_iter().map(Rounded::exact).collect();
    let claims = columns.iter().map(|own| along(&own.values, own.claim.turn())).collect();
    Drift { claims, crank: along(&cranks, None) }
}

fn by_solving(solved: &Solved, columns: &[PartyColumn], at: &RowKey, slack: &[f64]) -> Result<Drift> {
    let (case, own) = (&solved.case, solved.trajectory());
    let mut drift = Drift { claims: vec![vec![0.0; slack.len()]; columns.len()], crank: vec![0.0; slack.len()] };
    let values = |case: &Case, trajectory: &Trajectory, claim: &Claim| {
        KnownTrajectory::new(case, trajectory, &|_, _| 0.0).values(claim)
    };
    let along = if at.is_crank { Along::Crank } else { Along::Time };
    shifted(case, own, along, slack, &AssurSolver, &mut |shifted, found| {
        let claims = columns.iter().map(|own| &own.claim);
        for (claim, drift) in claims.zip(&mut drift.claims).filter(|(claim, _)| claim.figures.is_empty()) {
            let (before, after) = (values(case, own, claim)?, values(shifted, found, claim)?);
            grow(drift, before.iter().zip(&after).map(|(before, after)| after.value - before.value), claim.turn());
        }
        let turned = own.inputs().iter().zip(found.inputs()).map(|(before, after)| after - before);
        grow(&mut drift.crank, turned, None);
        Ok(())
    })?;
    Ok(drift)
}
