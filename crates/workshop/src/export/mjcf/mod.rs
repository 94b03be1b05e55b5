//! MJCF, the XML of MuJoCo: the spanning tree as nested bodies, the loops closed by equality constraints.
//!
//! What is where:
//!
//! - The plane is XOY. Every body's frame is its link's; it stands in the start pose, and `ref` makes the joint coordinates those of the
//!   mechanism: the angle of the child less that of its parent, and the slide of a prismatic joint as its channel has it.
//! - A joint that closes a loop is a `connect` of two sites. Its third row, along z, is zero in a plane mechanism: it costs a little and does nothing.
//! - A drive is a rotor ([`Model::rotor`]) on the driven hinge, so heavy that nothing changes its speed: 1e-9, with any integrator and at any step. A velocity
//!   actuator as stiff as that diverges (`implicitfast` solves the constraints without its damping), a softer one lags. The rotor does
//!   not enter the interaction forces that sensors read: the torque sensor of the hinge reads the driving moment.
//! - A moment that resists the rotation of a link is dry friction: of its hinge if that is on the ground, else of a fixed tendon whose length is the
//!   link's angle. At rest it holds, where [`Load::Resistance`](linkage::drive::Load::Resistance) is zero.
//! - Constraints are as stiff as a step allows: with `solref="1e-9 0.5"` MuJoCo raises the time constant to twice the step (`refsafe`), which
//!   makes b = 1/h and k = 1/h^2, a gap closed in one step. So the file serves for any step, and the error is of second order in it.

mod bodies;
mod model;
mod names;
mod shapes;
mod write;

pub use model::Model;

use linkage::case::{Case, Grid, Wanted};
use linkage::error::Result;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;

/// The case as MJCF, called `name`, with the time step `step` (s). The pose is the case's own at t = 0, its speeds are those that `solver` finds.
///
/// # Errors
/// [`ErrorKind::Input`](linkage::ErrorKind::Input) for a step that is not positive and finite,
/// [`ErrorKind::Unsupported`](linkage::ErrorKind::Unsupported) for names that MuJoCo does not take, and those of the solver.
pub fn mjcf(case: &Case, solver: &dyn Solver, name: &str, step: f64) -> Result<String> {
    let start = first_state(case, solver)?;
    Ok(write::document(&Model::new(case, &start, name, step)?))
}

/// The state at t = 0, with velocities.
fn first_state(case: &Case, solver: &dyn Solver) -> Result<State> {
    let wanted = Wanted::of(&[Stage::Positions, Stage::Velocities]);
    let case = case.on(Grid::of_times(case.crank(), vec![0.0]))?.wanting(wanted);
    let mut found = State::at_rest(&case);
    let mut keep = |_, state: &State| {
        found.clone_from(state);
        Ok(())
    };
    solver.each(&case, &mut keep)?;
    Ok(found)
}
