//! Side 1: group by group, forwards for the motion and backwards for the forces; dyads in closed form.

use super::pose_solver::PoseSolver;
use crate::case::Case;
use crate::error::Result;
use crate::solver::{Progress, Provision, Solver, State};
use crate::trajectory::Channel;

/// Group by group.
#[derive(Clone, Copy, Debug)]
pub struct AssurSolver;

impl Solver for AssurSolver {
    fn name(&self) -> &'static str {
        "assur"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: &mut dyn FnMut(usize, &State) -> Result<()>, progress: Progress) -> Result<()> {
        let mut poses = PoseSolver::counting_turns(case)?;
        let deepest = case.wanted.deepest();
        for (done, row) in case.grid.ascending().into_iter().enumerate() {
            let drive = case.drive.at(case.grid.times[row]);
            poses.solve(case.grid.cranks[row], drive.omega, drive.alpha, deepest)?;
            visit(row, poses.with_angles())?;
            progress((done + 1) as f64 / case.grid.len() as f64);
        }
        Ok(())
    }
}
