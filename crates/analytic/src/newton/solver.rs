//! Side 2 solves the whole mechanism at once, from its constraint equations and their Jacobian.
//!
//! The coordinates of a link are (x, y, theta) of a frame at its mass centre.
//! Constraints C = 0: two equations per joint, one equation per transmission, and one equation per drive.
//! Positions follow by Newton's method, then velocities from J q' = rates of the drives.
//! Accelerations follow from J q'' = gamma with the centripetal terms, and multipliers from M q'' = Q + J^T lambda.
//! The multipliers are the reactions on the second links, the forces of the transmissions, and the balancing moments:
//! E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, vol. 1, Allyn and Bacon 1989, sections 6.3
//! and 6.6.

use super::free::Embedded;
use super::passing::Passing;
use super::system::System;
use crate::motion::free;
use crate::motion::march::{ACCURACY, NARROWER, TIGHTER};
use linkage::case::Case;
use linkage::error::{Error, Result};
use linkage::solver::{Progress, Provision, Solver, State, Visit};
use linkage::trajectory::Channel;

/// The solver of side 2. Side 2 solves the whole mechanism by Newton's method and Lagrange multipliers.
#[derive(Clone, Copy, Debug)]
pub struct NewtonSolver;

impl Solver for NewtonSolver {
    fn name(&self) -> &'static str {
        "newton"
    }

    fn provides(&self, _: &Channel) -> Provision {
        Provision::Computed
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        if case.is_free() {
            return free_motion(case, ACCURACY, visit, progress);
        }
        let mut system = System::new(case);
        let mut state = State::at_rest(case);
        let rows = case.grid.ascending();
        // The motion starts at t = 0 and is followed in both directions: first the rows at and after t = 0, then the
        // earlier rows, backwards.
        let split = rows.partition_point(|&row| case.grid.times[row] < 0.0);
        let mut done = 0;
        let mut follow = |rows: &mut dyn Iterator<Item = usize>, system: &mut System| -> Result<()> {
            system.settle().map_err(Error::out_of_reach)?;
            let mut passing = Passing::of(system);
            for row in rows {
                let t = case.grid.times[row];
                match &mut passing {
                    Some(passing) => passing.pass_to(system, t)?,
                    None => system.go_to(t).map_err(Error::out_of_reach)?,
                }
                system.fill(&mut state);
                state.passing = passing.as_ref().and_then(Passing::condition);
                visit(row, &state)?;
                done += 1;
                progress(done as f64 / case.grid.len() as f64);
            }
            Ok(())
        };
        follow(&mut rows[split..].iter().copied(), &mut system)?;
        if split > 0 {
            system = System::new(case);
            follow(&mut rows[..split].iter().rev().copied(), &mut system)?;
        }
        Ok(())
    }
}

/// Side 2, with a chosen bound of the error in each step in which a motion under forces is integrated: see
/// [`AssurAt`](crate::AssurAt).
#[derive(Clone, Copy, Debug)]
pub struct NewtonAt(pub f64);

impl Solver for NewtonAt {
    fn name(&self) -> &'static str {
        NewtonSolver.name()
    }

    fn provides(&self, channel: &Channel) -> Provision {
        NewtonSolver.provides(channel)
    }

    fn sweep(&self, case: &Case, visit: Visit, progress: Progress) -> Result<()> {
        match case.is_free() {
            true => free_motion(case, self.0, visit, progress),
            false => NewtonSolver.sweep(case, visit, progress),
        }
    }
}

/// Side 2 with a tighter integration of motions under forces: see [`TIGHT_ASSUR`](crate::TIGHT_ASSUR).
pub const TIGHT_NEWTON: NewtonAt = NewtonAt(TIGHTER * ACCURACY);

fn free_motion(case: &Case, accuracy: f64, visit: Visit, progress: Progress) -> Result<()> {
    let mut system = System::new(case);
    system.settle().map_err(Error::out_of_reach)?;
    let mut passing = Passing::of(&mut system);
    if let Some(passing) = passing.as_mut().filter(|_| accuracy < ACCURACY) {
        passing.share = NARROWER;
    }
    free::sweep(case, &mut Embedded::new(system, passing), accuracy, visit, progress)
}
