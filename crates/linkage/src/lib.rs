//! What a planar mechanism is, and what solvers and engines of it have in common.
//!
//! Links, joints and Assur groups ([`mechanism`]), what moves and loads them ([`drive`]), the problem as every solver is
//! given it ([`case`]), what every solver answers with ([`trajectory`]), and the traits of solvers and engines
//! ([`solver`], [`engine`]).
//!
//! SI units and world axes (x right, y up, angles counter-clockwise from +x) everywhere.

pub mod case;
pub mod drive;
pub mod engine;
pub mod error;
#[cfg(any(test, feature = "fixtures"))]
#[doc(hidden)]
pub mod fixtures;
pub mod math;
pub mod mechanism;
pub mod solver;
pub mod trajectory;

pub use error::{Error, ErrorKind, Result};
