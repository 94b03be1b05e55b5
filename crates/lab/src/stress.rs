//! Tests numerical stability with families of mechanisms and of settings. Each family varies one parameter.
//! Both analytic sides run on every family. Engines run where the family's [`Setup`] allows them.
//! A family is one entry of [`FAMILIES`].
//! See docs/numerics/laboratory.md.

mod families;
mod family;
mod outcome;
mod point;
mod work;

pub use families::{FAMILIES, named};
pub use family::{EngineUse, Setup, StressFamily, WORK};
pub use outcome::{PartyAtPoint, PointEnd, QuantityGroup, StressOutcome, WorstOfGroup};
pub use point::{fnv, run};
pub use work::{Job, jobs, run_all};
