//! Moves the first drive of a mechanism to another joint.

use super::{Case, Grid};
use crate::drive::{Drive, DriveMotion, Drives, MotionLaw};
use crate::error::Result;
use crate::input::Input;
use crate::mechanism::assembly::transmission_sine;
use crate::mechanism::{AssemblyMode, DrivenJoint, Group, JointId, Mechanism, Structure};

impl Case {
    /// Structure of the mechanism with the first drive at `joint`. All other drives stay at their joints.
    ///
    /// # Errors
    /// The errors of [`Structure::of_driven`].
    pub fn structure_at(&self, joint: JointId) -> Result<Structure> {
        let further = self.drives.further().iter().map(|own| DrivenJoint { joint: own.joint, input: own.input });
        let (input, _) = Drive::of_joint(&self.mechanism.joints()[joint], &[], false);
        let driven: Vec<DrivenJoint> = std::iter::once(DrivenJoint { joint, input }).chain(further).collect();
        Structure::of_driven(&self.mechanism, &driven)
    }

    /// This case with the first drive at `joint`, from the same start pose.
    /// The start joint of a transmission is the joint whose given coordinate at t = 0 fixes the transmission's phase.
    /// The drive determines the coordinate of `joint`. If `joint` is a start joint, the joint between first member and
    /// carrier becomes the start joint instead.
    /// `law` receives the kind of the drive's input and returns the law of motion. The grid consists of `times` (s).
    ///
    /// # Errors
    /// The errors of [`Structure::of`], [`Mechanism::with_transmissions`] and [`Case::new`].
    pub fn driven_at(&self, joint: JointId, law: impl FnOnce(Input) -> MotionLaw, times: Vec<f64>) -> Result<Case> {
        let driven: Vec<DrivenJoint> = self.structure_at(joint)?.drivers.iter().map(DrivenJoint::from).collect();
        let mechanism = self.with_start_beside(joint)?;
        let structure = Structure::of(&mechanism, &driven)?;
        let (input, link) = Drive::of_joint(&self.mechanism.joints()[joint], &[], false);
        let start = self.mechanism.joints()[joint].coordinate(link, input, &self.start);
        let motion = DriveMotion::Prescribed { law: law(input), motor: None };
        let drive = Drive { input, joint, link, zero: 0.0, start, motion, through: false };
        let mode = |group: &Group| {
            let is_positive = transmission_sine(&self.mechanism, group, &self.start).is_some_and(|sine| sine > 0.0);
            match group.kind.modes() {
                Some(modes) => modes[usize::from(!is_positive)],
                None if group.kind.has_one_configuration() => AssemblyMode::Only,
                None => AssemblyMode::Followed,
            }
        };
        self.with(|parts| {
            parts.grid = Grid::of_times(&drive, times);
            parts.drives = Drives::new(drive, self.drives.further().to_vec());
            parts.mechanism = mechanism;
            parts.modes = structure.groups.iter().map(mode).collect();
            parts.structure = structure;
        })
    }

    /// The mechanism in which the joint between first member and carrier replaces `joint` as the start joint of
    /// transmissions. If there is no joint between first member and carrier, `joint` stays.
    fn with_start_beside(&self, joint: JointId) -> Result<Mechanism> {
        let (mut designs, joints) = (self.mechanism.transmission_designs(), self.mechanism.joints());
        for design in designs.iter_mut().filter(|design| design.joint == joint) {
            let Some(found) = self.mechanism.joint_between(design.links[0], design.carrier) else { continue };
            let input = if joints[found].slides() { Input::Slide } else { Input::Turn };
            design.start = joints[found].coordinate(joints[found].second.link, input, &self.start);
            design.joint = found;
        }
        self.mechanism.clone().with_transmissions(designs)
    }
}
