//! Differences between the engine's world and the case, and their contribution to the reactions.
//!
//! Rapier needs a mass and a moment of inertia on every link.
//! For a given motion, reactions and driving moment are linear in masses, inertias and loads.
//! The contribution of the differences can therefore be computed separately and subtracted.
//! This contribution follows from the Newton-Euler equations with the engine's accelerations.
//! See docs/numerics/twins.md.

use super::masses::{added, masses, masses_with_flywheels};
use super::newton_euler::NewtonEuler;
use super::tree::SpanningTree;
use linkage::case::Case;
use linkage::error::Result;
use linkage::input::Input;
use linkage::solver::State;

/// The differences between the engine's world and the case, called stand-ins.
/// One kind of stand-in is the masses and moments of inertia added to links, except in free motion, where loads
/// compensate them. Flywheels are stand-ins too; the flywheels of cranks only count in accelerated motion. The loads of
/// the case are stand-ins if the engine's world lacks these loads.
#[derive(Debug)]
pub(super) struct Ghost {
    statics: NewtonEuler,
    state: State,
}

impl Ghost {
    /// The stand-ins of a case. If the engine's world lacks the case's loads (`unloaded`), these loads are included
    /// too.
    /// `None` if nothing has to be subtracted.
    pub(super) fn of(case: &Case, unloaded: bool) -> Option<Self> {
        // The flywheel of a crank adds a moment only in accelerated motion. A flywheel on a driven slide is modelled
        // as a mass, which also has a weight.
        let tree = SpanningTree::none(&case.mechanism);
        let only_cranks = case.drives.iter().all(|drive| drive.input == Input::Angle);
        let flywheels_idle = case.is_steady() && only_cranks;
        let masses = if flywheels_idle { masses(case, &tree) } else { masses_with_flywheels(case, &tree) };
        let links = case.mechanism.links().iter().zip(masses);
        let mut extra: Vec<[f64; 2]> =
            links.map(|(link, [mass, inertia])| [mass - link.mass, inertia - link.inertia]).collect();
        if case.is_free() {
            // Added masses are left out here, because loads in the engine's world already compensate them.
            for (link, extra) in case.mechanism.links().ids().zip(&mut extra) {
                let [mass, inertia] = added(case, link, &tree);
                extra[0] -= mass;
                extra[1] -= inertia;
            }
        }
        let unloaded = unloaded && !case.loads.is_empty();
        let any = unloaded || extra.iter().flatten().any(|&extra| extra != 0.0);
        // The contribution of the stand-ins is subtracted later. Missing loads are therefore included with a negative
        // sign.
        let load_share = if unloaded { -1.0 } else { 0.0 };
        any.then(|| Ghost { statics: NewtonEuler::of(case, extra, load_share), state: State::at_rest(case) })
    }

    /// Subtracts the contribution of the stand-ins from reactions and moments.
    ///
    /// # Errors
    /// The errors of [`NewtonEuler::solve`].
    pub(super) fn take_off(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        self.state.motions.clone_from(&state.motions);
        self.state.angles.clone_from(&state.angles);
        self.statics.solve(case, &mut self.state, t)?;
        for (own, ghost) in state.forces.iter_mut().zip(&self.state.forces) {
            *own -= ghost;
        }
        let moments = state.moments.iter_mut().zip(&self.state.moments);
        let transmitted = state.transmitted.iter_mut().zip(&*self.state.transmitted);
        for (own, ghost) in moments.chain(transmitted).chain(state.torques.iter_mut().zip(&self.state.torques)) {
            *own -= ghost;
        }
        Ok(())
    }
}
