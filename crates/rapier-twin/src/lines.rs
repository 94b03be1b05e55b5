//! The lines of action that carry the forces of transmissions.
//!
//! The engine and the Newton-Euler equations apply the force of a transmission in the first line of action, whatever
//! the sign of the force.
//! A negative force, however, acts in the second line of action.
//! In a drive with two strands, the slack strand also has a tension.
//! The corrections for both effects do not change the motion; they change only the reactions of the axles.

use super::newton_euler::NewtonEuler;
use linkage::case::Case;
use linkage::drive::Wrench;
use linkage::error::Result;
use linkage::math::{Vec2, cross};
use linkage::mechanism::LinkId;
use linkage::solver::State;

/// Computes the corrections of the reactions. The memory is reused for every pose.
#[derive(Debug)]
pub(super) struct Lines {
    /// The equations without masses.
    equations: NewtonEuler,
    moved: Vec<Wrench>,
    beside: State,
}

impl Lines {
    /// The transmissions of a case; `None` if there are none.
    pub(super) fn of(case: &Case) -> Option<Self> {
        let links = case.mechanism.links().len();
        (!case.mechanism.transmissions().is_empty()).then(|| Lines {
            equations: NewtonEuler::of(case, vec![[0.0; 2]; links], 1.0),
            moved: vec![Wrench::ZERO; links],
            beside: State::at_rest(case),
        })
    }

    /// Moves the forces of the transmissions of a state to the lines that carry them.
    ///
    /// # Errors
    /// The errors of [`NewtonEuler::solve`].
    pub(super) fn change(&mut self, case: &Case, state: &mut State, t: f64) -> Result<()> {
        let (mechanism, moved) = (&case.mechanism, &mut self.moved);
        moved.fill(Wrench::ZERO);
        let mut put = |link: LinkId, force: Vec2, place: Vec2| {
            let centre = state.motions[link].point(mechanism.links()[link].mass_centre);
            moved[link].force += force;
            moved[link].moment += cross(place - centre, force);
        };
        for (transmission, &force) in mechanism.transmissions().iter().zip(&*state.transmitted) {
            transmission.each_action(mechanism.joints(), force, &state.motions, &mut put);
            for (link, unit, place) in transmission.unit_actions(mechanism.joints(), &state.motions) {
                put(link, unit * -force, place);
            }
        }
        self.beside.motions.clone_from(&state.motions);
        self.equations.solve_under(&self.moved, case, &mut self.beside, t)?;
        state.forces.iter_mut().zip(&self.beside.forces).for_each(|(own, beside)| *own += beside);
        state.moments.iter_mut().zip(&self.beside.moments).for_each(|(own, beside)| *own += beside);
        Ok(())
    }
}
