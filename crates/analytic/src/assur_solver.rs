//! Side 1: the solver by Assur groups.
//! The solver computes the motion from the first group to the last, and the forces from the last group to the first.
//! Dyads are solved in closed form.

use crate::assur::PoseSolver;
use crate::assur::transfer::TransferSide;
use crate::motion::free;
use crate::motion::march::{NARROWER, TIGHTER};
use crate::reduced::{ACCURACY, ReducedModel, RunUpEnd, run_up};
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::error::{Error, ErrorKind, Result};
use linkage::solver::{Progress, Provision, Solver, Visit};
use linkage::trajectory::Channel;

/// The solver of side 1. Side 1 solves the mechanism group by group.
#[derive(Clone, Copy, Debug)]
pub struct AssurSolver;

impl Solver for AssurSolver {
    fn name(&self) -> &'static str {
        "assur"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        if case.is_free() {
            return free_motion(case, ACCURACY, visit, progress);
        }
        let mut poses = if case.wants_angles() { PoseSolver::counting_turns(case)? } else { PoseSolver::new(case)? };
        let deepest = case.wanted.deepest();
        for (done, row) in case.grid.ascending().into_iter().enumerate() {
            poses.solve_row(row, deepest)?;
            visit(row, poses.with_angles())?;
            progress((done + 1) as f64 / case.grid.len() as f64);
        }
        Ok(())
    }
}

/// Side 1, with a chosen bound of the error in each step in which a motion under forces is integrated.
/// The chosen error has no effect on a prescribed motion, because such a motion is not integrated.
#[derive(Clone, Copy, Debug)]
pub struct AssurAt(pub f64);

impl Solver for AssurAt {
    fn name(&self) -> &'static str {
        AssurSolver.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        AssurSolver.provides(channel)
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        match case.is_free() {
            true => free_motion(case, self.0, visit, progress),
            false => AssurSolver.sweep(case, visit, progress),
        }
    }
}

/// Side 1 with a tighter integration of motions under forces.
/// The results differ from those of [`AssurSolver`] by the integration error of [`AssurSolver`].
/// Both sides have this error, because they share the integrator.
/// For a prescribed motion, both solvers give the same results, because the motion is not integrated.
pub const TIGHT_ASSUR: AssurAt = AssurAt(TIGHTER * ACCURACY);

/// Solves a motion under forces.
/// A case of one degree of freedom is solved by the reduced equation of motion if all terms of this equation are
/// functions of the crank angle.
/// Every other case is solved with transfer functions.
fn free_motion(case: &Case, accuracy: f64, visit: Visit, progress: Progress) -> Result<()> {
    let share = if accuracy < ACCURACY { NARROWER } else { 1.0 };
    if !case.drives.further().is_empty() || case.loads.iter().any(Load::is_viscous) {
        return free::sweep(case, &mut TransferSide::new(case, share)?, accuracy, visit, progress);
    }
    free::check(case)?;
    let rows = case.grid.ascending();
    let mut times: Vec<f64> = rows.iter().map(|&row| case.grid.times[row]).collect();
    times.dedup();
    let model = match ReducedModel::of(case) {
        // Use the equations with transfer functions if the reduced equation does not apply.
        // The reduced equation does not apply if a load is not a periodic function of the crank angle: for example, a
        // spring that every turn winds up further.
        // The reduced equation also does not apply if the branch is not known over a full turn.
        Err(error) if matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::Numeric) => {
            return free::sweep(case, &mut TransferSide::new(case, share)?, accuracy, visit, progress);
        }
        model => model?,
    };
    if model.kinks().meets {
        // The reduced equation is valid only up to a change point, so the motion is solved with transfer functions.
        // The equations with transfer functions follow the motion beyond the change point, where the momentum selects
        // the branch.
        return free::sweep(case, &mut TransferSide::new(case, share)?, accuracy, visit, progress);
    }
    let (motion, end) =
        run_up::followed(&model, case.crank().initial_speed(), &times, accuracy, case.wanted.deepest())?;
    if motion.len() < times.len() {
        return Err(ended(case, end));
    }
    let mut next = 0;
    run_up::states(&model, case, &motion, &mut |index, state| {
        while let Some(&row) = rows.get(next).filter(|&&row| case.grid.times[row] == times[index]) {
            visit(row, state)?;
            next += 1;
        }
        progress(next as f64 / rows.len() as f64);
        Ok(())
    })
}

/// Error for a motion that ends before the last instant of the grid.
fn ended(case: &Case, end: RunUpEnd) -> Error {
    let (what, t, crank) = match end {
        RunUpEnd::Held(t, crank) => (sentences::LOADS_HOLD_THE_MECHANISM, t, crank),
        RunUpEnd::Limit(t, crank) => (sentences::THE_CRANK_COMES_TO_A_LIMIT, t, crank),
        RunUpEnd::Reached => (sentences::THE_MOTION_ENDS, 0.0, 0.0),
    };
    let at = case.told(crank);
    let error = Error::new(ErrorKind::Numeric, format!("{what} at t = {t:.6} s, {at}")).at_time(t).at_input(at);
    error.help(sentences::LET_THE_GRID_END_BEFORE_OR_GIVE)
}
