//! The beginning of every model file: the state at t = 0, and comment lines about the file's origin and the drives.

use crate::rigid::RigidModel;
use crate::sentences;
use linkage::case::{Case, Grid, Wanted};
use linkage::error::Result;
use linkage::input::Input;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// Lines at the beginning of a model file: its origin, and every driven joint.
pub(super) fn model_header(model: &RigidModel) -> Vec<String> {
    let mut lines = vec![sentences::written_by_linkproof(&env!("CARGO_PKG_VERSION"))];
    for drive in &model.case.drives {
        let body = model.bodies.iter().find(|body| body.branch.joint == drive.joint);
        let rate = body.map_or(0.0, |body| body.rate);
        let unit = if drive.input == Input::Slide { "m/s" } else { "rad/s" };
        lines.push(sentences::the_drive_of(&model.joint_name(drive.joint), &drive.law_name(), &rate, &unit));
    }
    lines
}

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
