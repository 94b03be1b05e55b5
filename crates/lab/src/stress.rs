//! Numerical stability: families of mechanisms and settings with one dial each, and what every solver and engine makes
//! of them.
//!
//! A family is one entry of [`FAMILIES`]: the dial, its points, and the case and settings at a value of the dial. A
//! point is solved by both analytic sides and by engines, held against numbers in double-double where these can be had,
//! and against the other side where not. A failure with its reason is a result too.
//! See docs/numerics/laboratory.md.

mod families;
mod family;
mod outcome;
mod point;
mod work;

pub use families::{FAMILIES, named};
pub use family::{Engines, Family, Setup, WORK};
pub use outcome::{End, Group, Outcome, Party, Reached};
pub use point::fnv;
pub use point::run;
pub use work::{Job, jobs, run_all};
