//! Builds every planar mechanism twice, once analytically and once as a Rapier multibody, and proves that the two agree.
//!
//! One line, one fork, one join: a [`scenario`] becomes a [`case`], the case is solved by an analytic
//! [`reference`](mod@reference) and by an [`engine`], both answer with a [`trajectory`], and only trajectories are
//! compared ([`compare`]). [`proof`] runs the whole line; [`record`] and [`report`] tell what came out.
//!
//! SI units and world axes (x right, y up, angles counter-clockwise from +x) everywhere inside; other units exist
//! only in scenario files and carry their suffix there.

pub mod cli;
pub mod compare;
pub mod engines;
pub mod proof;
pub mod record;
pub mod report;
pub mod scenario;
pub mod tolerance;
pub mod tune;
