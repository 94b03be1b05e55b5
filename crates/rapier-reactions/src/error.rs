//! Errors of reading reactions.

use crate::sentences;
use std::fmt;

/// A reason why reactions cannot be read. The text of the error says what was found and what to do.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReactionError {
    /// A joint or a body has a property that this crate does not support. The fields are the name and the property.
    Unsupported(String, &'static str),
    /// Fewer than three poses have been pushed since the joints last changed. The field is the number of poses.
    TooFewPoses(usize),
    /// Bodies or joints were added, removed or switched since `ImpulseReader::before_step`, or it was not called.
    Changed,
    /// The equations do not determine the forces of these joints.
    NotDetermined(Vec<String>),
    /// The sweeps of a probe did not converge. The fields are the number of sweeps and the last relative change.
    NotConverged(usize, f64),
    /// The time step is not a positive number (s).
    Step(f64),
    /// A pose, a load or a result is not finite.
    NotFinite,
}

impl fmt::Display for ReactionError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&match self {
            ReactionError::Unsupported(name, property) => sentences::is_not_supported(name, property),
            ReactionError::TooFewPoses(count) => sentences::three_poses_are_needed(count),
            ReactionError::Changed => sentences::BODIES_OR_JOINTS_HAVE_CHANGED.into(),
            ReactionError::NotDetermined(names) => sentences::the_forces_are_not_determined(&names.join(", ")),
            ReactionError::NotConverged(sweeps, change) => {
                sentences::the_sweeps_have_not_converged(sweeps, &format_args!("{change:.1e}"))
            }
            ReactionError::Step(step) => sentences::the_step_must_be_positive(step),
            ReactionError::NotFinite => sentences::A_NUMBER_IS_NOT_FINITE.into(),
        })
    }
}

impl std::error::Error for ReactionError {}
