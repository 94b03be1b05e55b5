//! Diagnosis of a disagreement: which party contradicts the others, since when, in which channels, and the simple
//! cause.
//! The functions of this module have no side effects. See docs/numerics/diagnosis.md.

mod alone;
mod bench;
mod cause;
mod changes;
mod configurations;
mod derived;
mod diagnose;
mod knobs;
mod late;
mod nature;
mod numbers;
mod others;
mod question;
mod slips;
mod tries;
mod whole;

pub use alone::{DiagnosedParty, PartyStanding, standing};
pub use cause::{Arm, CasePart, Change, DataSlip, DisagreementCause, FrameAxis, LateChannels, Over, PartChange, Plain};
pub use configurations::{others, reassembled};
pub(crate) use derived::even;
pub use diagnose::{Diagnosis, Since, diagnose, since};
pub use knobs::{at_speed, changed, driven, recoupled, remade};
pub use nature::ErrorNature;
pub use question::{DiagnosisInput, SuspectChannel};
pub use whole::without_inertia_forces;
