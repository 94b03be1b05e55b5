//! Path generation with prescribed timing: a point of the coupler passes given points at given crank angles.
//!
//! In the crank's dyad, the crank W has given rotations, and Z turns with the coupler by unknown angles.
//! Each solution for this dyad gives the coupler's rotations. The rocker's dyad is then found as for motion generation.
//! (Sandor and Erdman, Advanced Mechanism Design, vol. 2, 1984, chapter 3.)

use crate::sentences;

use super::choice::{Choice, PrecisionSynthesis};
use super::dyad::dyads;
use super::four_bar::{GivenFrames, GroundLink};
use super::motion::of_motion;
use super::points::{check_apart, check_positions, no_dyad, turns_from_first, ways_from_first};
use linkage::error::Result;
use linkage::math::Complex;

/// A point of the path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedPoint {
    /// Position of the coupler's working point (m).
    pub point: Complex,
    /// Crank angle at this point (rad, counter-clockwise). Only the differences of the crank angles matter.
    pub crank: f64,
}

/// Requirements on a four-bar whose coupler point follows a path.
#[derive(Clone, Debug, PartialEq)]
pub struct PathSpec {
    /// Three to five points, in their order.
    pub points: Vec<TimedPoint>,
}

impl PathSpec {
    /// The best four-bars whose coupler point passes every given point at the given crank angle; at most `wanted`
    /// four-bars.
    ///
    /// # Errors
    /// [`ErrorKind::Input`](linkage::error::ErrorKind::Input) for a wrong number of points, for numbers that are not
    /// finite, and for equal crank angles.
    /// [`ErrorKind::Geometry`](linkage::error::ErrorKind::Geometry) if no four-bar exists. The error states the reason.
    pub fn four_bars(&self, wanted: usize) -> Result<PrecisionSynthesis> {
        let numbers = self.points.iter().flat_map(|own| [own.point.re, own.point.im, own.crank]);
        check_positions("points", self.points.len(), numbers)?;
        let cranks = turns_from_first(self.points.iter().map(|own| own.crank));
        check_apart("crank angles", &[], &cranks)?;
        let (first, points) = (self.points[0], self.points.iter().map(|own| own.point).collect::<Vec<_>>());
        let ways = ways_from_first(&points);
        let none = || no_dyad(sentences::THE_POINTS_ARE_A_CIRCLE, sentences::MOVE_A_POINT_OR_CHANGE_A_CRANK_ANGLE);
        let given = GivenFrames { point: Some(first.point), crank: Some(first.crank), ..GivenFrames::default() };
        let mut choice = Choice::new(given, wanted, self.points.len() < 5);
        for own in dyads(&cranks, &ways).ok_or_else(none)? {
            let pin = first.point - own.free;
            let crank = GroundLink { pivot: pin - own.given, pin, turns: cranks.clone() };
            // For five points, one of the solutions is the crank's dyad itself. As the rocker's dyad, it would
            // give a frame without length; this four-bar is refused.
            let rockers = dyads(&own.turns, &ways).unwrap_or_default();
            let rockers = rockers.into_iter().map(|dyad| of_motion(dyad, first.point));
            rockers.for_each(|rocker| choice.offer([&crank, &rocker]));
        }
        choice.best()
    }
}
