//! Planar mechanisms, and the interfaces that their solvers and engines share.
//!
//! Links, joints and Assur groups are in [`mechanism`], drives and loads in [`drive`], what an input measures in [`input`].
//! [`case`] has the problem as every solver receives it, [`trajectory`] the result that every solver returns.
//! [`solver`] and [`engine`] have the traits of solvers and engines, [`work`] counts what they do.
//!
//! SI units and world axes (x right, y up, angles counter-clockwise from +x) everywhere.

pub mod case;
pub mod drive;
pub mod engine;
pub mod error;
#[cfg(any(test, feature = "fixtures"))]
#[doc(hidden)]
pub mod fixtures;
pub mod input;
pub mod math;
pub mod mechanism;
pub mod quiet;
pub mod solver;
pub mod trajectory;
pub mod work;

pub use error::{Error, ErrorKind, Result};
