//! Export of a mechanism as a model for MuJoCo, and of the profiles of its cams.

pub mod cam;
pub mod mjcf;

use linkage::case::{Case, Grid, Wanted};
use linkage::error::Result;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Computes the state at t = 0 with velocities and accelerations by `solver`.
///
/// # Errors
/// The errors of the solver.
pub fn first_state(case: &Case, solver: &dyn Solver) -> Result<State> {
    let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities, Stage::Accelerations]);
    let case = case.on(Grid::of_times(case.crank(), vec![0.0]))?.wanting(wanted);
    let mut found = State::at_rest(&case);
    let mut keep = |_, state: &State| {
        found.clone_from(state);
        Ok(())
    };
    solver.each(&case, &mut keep)?;
    Ok(found)
}
