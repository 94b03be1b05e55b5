//! The same mechanism, driven at another joint.

use super::{Case, Grid};
use crate::drive::{Drive, DriveMotion, Drives, MotionLaw};
use crate::error::Result;
use crate::input::Input;
use crate::mechanism::assembly::transmission_sine;
use crate::mechanism::{AssemblyMode, DrivenJoint, Group, GroupKind, JointId, Structure};

impl Case {
    /// Structure of the mechanism if the first drive moves `joint` instead of its joint. Further drives stay.
    ///
    /// # Errors
    /// Those of [`Structure::of`].
    pub fn structure_at(&self, joint: JointId) -> Result<Structure> {
        let further = self.drives.further().iter().map(|own| DrivenJoint { joint: own.joint, input: own.input });
        let (input, _) = Drive::of_joint(&self.mechanism.joints()[joint], &[], false);
        let driven: Vec<DrivenJoint> = std::iter::once(DrivenJoint { joint, input }).chain(further).collect();
        Structure::of(&self.mechanism, &driven)
    }

    /// This case with the first drive at `joint`, from the same start pose.
    /// `law` gives the law of motion for the kind of input. The grid has these times (s).
    ///
    /// # Errors
    /// Those of [`Structure::of`] and [`Case::new`].
    pub fn driven_at(&self, joint: JointId, law: impl FnOnce(Input) -> MotionLaw, times: Vec<f64>) -> Result<Case> {
        let structure = self.structure_at(joint)?;
        let (input, link) = Drive::of_joint(&self.mechanism.joints()[joint], &[], false);
        let start = self.mechanism.joints()[joint].coordinate(link, input, &self.start);
        let motion = DriveMotion::Prescribed { law: law(input), motor: None };
        let drive = Drive { input, joint, link, zero: 0.0, start, motion, through: false };
        let mode = |group: &Group| {
            let is_positive = transmission_sine(&self.mechanism, group, &self.start).is_some_and(|sine| sine > 0.0);
            match (group.kind, is_positive) {
                (GroupKind::Rrr, true) => AssemblyMode::Left,
                (GroupKind::Rrr, false) => AssemblyMode::Right,
                (GroupKind::Rrp | GroupKind::Rpr, true) => AssemblyMode::Ahead,
                (GroupKind::Rrp | GroupKind::Rpr, false) => AssemblyMode::Behind,
                (GroupKind::Rpp | GroupKind::Prp | GroupKind::Driven, _) => AssemblyMode::Only,
                (GroupKind::Higher, _) => AssemblyMode::Followed,
            }
        };
        self.with(|parts| {
            parts.grid = Grid::of_times(&drive, times);
            parts.drives = Drives::new(drive, self.drives.further().to_vec());
            parts.modes = structure.groups.iter().map(mode).collect();
            parts.structure = structure;
        })
    }
}
