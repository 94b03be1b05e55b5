//! One solver over one case, with everything that is watched on the way.

use crate::case::Case;
use crate::error::Result;
use crate::reference::power;
use crate::solver::{Sampler, Solver, State};
use crate::trajectory::{Stage, Trajectory};

/// A trajectory and what was watched while it was made.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    pub(super) trajectory: Trajectory,
    /// Largest distance between the two sides of a joint at any instant (m).
    pub(super) closure: f64,
    /// Largest distance of a joint from the origin (m).
    pub(super) reach: f64,
    /// Balancing moment from the balance of powers (N m) at every instant; empty if no balancing moment is wanted.
    pub(super) power: Vec<f64>,
    /// Largest moment on the driving link (N m): the balancing one, or that of a joint's force at the link's length.
    pub(super) moment: f64,
}

/// Solves `case` with `solver`, watching the closure of all joints and the balance of powers.
pub(super) fn observe(case: &Case, solver: &dyn Solver, progress: &mut dyn FnMut(f64)) -> Result<Observed> {
    let mut sampler = Sampler::new(case);
    let with_power = case.wanted.has(Stage::BalancingMoment);
    let mut power = if with_power { vec![0.0; case.grid.len()] } else { Vec::new() };
    let arm = case.mechanism.links()[case.drive.link].size();
    let size = case.mechanism.size();
    let (mut closure, mut reach, mut moment): (f64, f64, f64) = (0.0, 0.0, 0.0);
    let mut visit = |row: usize, state: &State| {
        for joint in case.mechanism.joints() {
            let sides = [joint.first, joint.second];
            let places = sides.map(|side| state.motions[side.link].point(side.local));
            let (distance, turn) = joint.opening(places, sides.map(|side| state.motions[side.link].direction));
            closure = closure.max(distance).max(turn * size);
            reach = reach.max(places[0].norm());
        }
        if with_power {
            power[row] = power::balancing_moment(case, &state.motions);
            let forces = state.forces.iter().map(|force| force.norm() * arm);
            moment = forces.fold(moment.max(state.torque.abs()), f64::max);
        }
        sampler.put(case, row, state);
        Ok(())
    };
    solver.sweep(case, &mut visit, progress)?;
    Ok(Observed {
        trajectory: sampler.finish(case, |channel| solver.provides(channel))?,
        closure,
        reach,
        power,
        moment,
    })
}
