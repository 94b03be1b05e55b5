//! The interval of the driving moment or force at an instant at which joints with friction rest.
//! The friction of a joint at rest is undetermined, and so is the driving moment or force.

use super::PoseSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

/// Largest number of joints at rest whose friction is varied. The forces are solved for all combinations of the senses
/// of friction in these joints.
const MOST_RESTING: usize = 8;

/// For every friction of [`Case::frictions`], the instants of the grid at which its contact stands still.
///
/// # Errors
/// The errors of [`PoseSolver::solve_row`].
pub fn rows_at_rest(case: &Case) -> Result<Vec<Vec<usize>>> {
    let mut poses = PoseSolver::new(case)?;
    let mut all = vec![Vec::new(); case.frictions().count()];
    for row in 0..case.grid.len() {
        let motions = &poses.solve_row(row, Stage::Velocities)?.motions;
        let resting = all.iter_mut().zip(case.frictions()).filter(|(_, friction)| friction.rate(motions) == 0.0);
        resting.for_each(|(rows, _)| rows.push(row));
    }
    Ok(all)
}

/// Smallest and largest moment (N m) or force (N) of the first drive at the instant `row` of the grid.
/// The friction in each joint at rest may act in either sense: the range covers all combinations of senses, and the
/// state without friction in the joints at rest. If more than eight joints rest, only the first eight are varied.
/// `None` if every joint with friction is in motion.
///
/// # Errors
/// The errors of [`PoseSolver::solve_row`].
pub fn effort_at_rest(case: &Case, row: usize) -> Result<Option<[f64; 2]>> {
    let mut poses = PoseSolver::new(case)?;
    let state = poses.solve_row(row, Stage::BalancingMoment)?;
    let resting = case.frictions().enumerate().filter(|(_, friction)| friction.rate(&state.motions) == 0.0);
    let resting: Vec<usize> = resting.map(|(k, _)| k).take(MOST_RESTING).collect();
    let mut range = [state.torques[0]; 2];
    for senses in 0..1u32 << resting.len() {
        if let Some(dry) = poses.dry() {
            let sense = |bit: usize| if senses >> bit & 1 == 0 { -1.0 } else { 1.0 };
            resting.iter().enumerate().for_each(|(bit, &k)| dry.at_rest[k] = sense(bit));
        }
        let effort = poses.solve_row(row, Stage::BalancingMoment)?.torques[0];
        range = [range[0].smaller(effort), range[1].larger(effort)];
    }
    Ok((!resting.is_empty()).then_some(range))
}
