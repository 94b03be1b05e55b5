//! Contents of the file as numbers: bodies, joints, loops, frictions and the first state.

use std::ops::Deref;

use super::limits;
use super::names;
use crate::rigid::RigidModel;
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::mechanism::{JointId, LinkId, PerLink};
use linkage::solver::State;

/// Inertia of a drive's rotor, divided by an estimate J of the mechanism's moment of inertia.
/// Inertia forces cause moments of about J times the square of the speed.
/// These moments change the rotor's speed by 1e-9 of its value per radian.
const ROTOR: f64 = 1e9;

/// Dry friction on the rotation of one link.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Friction {
    /// The link.
    pub link: LinkId,
    /// Moment (N m).
    pub moment: f64,
    /// Hinges on the path through the tree from the ground to the link, as indices of branches. The sum of the hinge
    /// angles is the link's angle.
    pub hinges: Vec<usize>,
    /// Whether the link's joint with its parent in the tree is the only hinge between the ground and the link.
    pub own_hinge: bool,
}

/// A mechanism as a MuJoCo model.
#[derive(Debug)]
pub struct MjcfModel<'a> {
    rigid: RigidModel<'a>,
    pub(super) step: f64,
    pub(super) frictions: Vec<Friction>,
}

impl<'a> Deref for MjcfModel<'a> {
    type Target = RigidModel<'a>;

    fn deref(&self) -> &Self::Target {
        &self.rigid
    }
}

impl<'a> MjcfModel<'a> {
    /// The model of a case whose state at t = 0 is `start`; see [`mjcf`](super::mjcf).
    ///
    /// # Errors
    /// The errors of [`mjcf`](super::mjcf) that do not come from the solver.
    pub fn new(case: &'a Case, start: &State, name: &'a str, step: f64) -> Result<Self> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(Error::new(ErrorKind::Input, sentences::the_time_step_is_but_must(&step))
                .help(sentences::GIVE_A_STEP_SUCH_AS));
        }
        names::check(&case.mechanism)?;
        case.drives.iter().try_for_each(limits::check_drive)?;
        case.loads.iter().try_for_each(limits::check)?;
        case.mechanism.transmissions().iter().try_for_each(limits::check_transmission)?;
        let mut model = MjcfModel { rigid: RigidModel::new(case, start, name), step, frictions: Vec::new() };
        model.frictions = model.frictions();
        Ok(model)
    }

    /// Inertia of the rotor that keeps the speed of a prescribed drive: a moment of inertia (kg m^2), or for a slide a
    /// mass (kg).
    pub fn rotor(&self, input: Input) -> f64 {
        let (size, links) = (self.size(), self.case.mechanism.links());
        // The estimate places all mass at the distance `size` from the axis.
        let inertia = ROTOR * (links.iter().map(|link| link.inertia).sum::<f64>() + self.mass() * size * size);
        if input == Input::Slide { inertia / (size * size) } else { inertia }
    }

    /// Inertia that moves with a driven joint: the rotor of a prescribed drive, or the inertia of a free link's motor
    /// (kg m^2; kg for a slide).
    pub(super) fn armature(&self, joint: JointId) -> Option<f64> {
        let drive = self.case.drives.iter().find(|drive| drive.joint == joint)?;
        if drive.is_free() {
            Some(drive.moving_inertia()).filter(|own| *own > 0.0)
        } else {
            Some(self.rotor(drive.input))
        }
    }

    /// One friction for each link with a resistance. A link that cannot turn gets no friction.
    fn frictions(&self) -> Vec<Friction> {
        let mut moments = PerLink::from(vec![0.0; self.case.mechanism.links().len()]);
        for (link, moment) in self.case.loads.iter().filter_map(Load::resistance) {
            moments[link] += moment;
        }
        let resisted = moments.entries().filter(|(_, moment)| **moment > 0.0);
        let frictions = resisted.map(|(link, &moment)| {
            let hinges = self.hinges(link);
            let own_hinge = hinges.len() == 1 && self.branch_of(link) == hinges.first().copied();
            Friction { link, moment, hinges, own_hinge }
        });
        frictions.filter(|friction| !friction.hinges.is_empty()).collect()
    }
}
