//! Motion generation: a coupler in three, four or five poses.
//!
//! Every pair of dyads is a four-bar. The vector W of a dyad turns about the pivot by unknown angles, and Z turns with
//! the coupler.
//! For three poses, a given pivot determines its pin: the centre of the circle through the three positions of the
//! pivot, as seen from the coupler.
//! A given pin determines its pivot: the centre of the circle through the three positions of the pin.
//! (For example McCarthy, Geometric Design of Linkages, 2000, section 5.2.)

use crate::sentences;

use super::choice::{Choice, PrecisionSynthesis};
use super::dyad::{StandardDyad, dyads};
use super::four_bar::{GivenFrames, GroundLink};
use super::points::{check_apart, check_positions, no_dyad, turns_from_first, ways_from_first};
use crate::synthesize::wrong;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Complex, KeepNan};

/// Three points count as collinear if the area that they span, divided by the square of the largest distance from the
/// first point, is below this limit.
const ON_LINE: f64 = 1e-9;

/// A pose of the coupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CouplerPose {
    /// Working point of the coupler (m).
    pub point: Complex,
    /// Angle of the coupler (rad, counter-clockwise).
    pub angle: f64,
}

/// Requirements on a four-bar that guides its coupler.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionSpec {
    /// Three to five poses of the coupler, in their order.
    pub poses: Vec<CouplerPose>,
    /// Given pivots on the ground (m); only for three poses.
    pub pivots: Vec<Complex>,
    /// Given pins of the coupler (m), only for three poses. `pivots` and `pins` together have at most two points.
    /// The coordinates are in the coupler's frame: its origin is the working point, and its x axis has the angle of the
    /// pose.
    pub pins: Vec<Complex>,
}

impl MotionSpec {
    /// The best four-bars that guide the coupler through all poses; at most `wanted` four-bars.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a wrong number of poses, pivots or pins, for numbers that are not finite, and for poses
    /// that coincide.
    /// [`ErrorKind::Geometry`] if no four-bar exists. The error states the reason.
    pub fn four_bars(&self, wanted: usize) -> Result<PrecisionSynthesis> {
        self.check()?;
        let first = self.poses[0];
        let mut given = self.given_links()?;
        let is_scanned = self.poses.len() < 5 && given.len() < 2;
        let scanned = if given.len() < 2 { self.dyads()? } else { Vec::new() };
        let links: Vec<GroundLink> = scanned.into_iter().map(|dyad| of_motion(dyad, first.point)).collect();
        let frames = GivenFrames { point: Some(first.point), coupler: Some(first.angle), ..GivenFrames::default() };
        let mut choice = Choice::new(frames, wanted, is_scanned);
        match (given.pop(), given.pop()) {
            (Some(b), Some(a)) => offer_both(&mut choice, &a, &b),
            (Some(a), None) => links.iter().for_each(|b| offer_both(&mut choice, &a, b)),
            (None, _) => (0..links.len())
                .flat_map(|j| (0..j).map(move |i| (i, j)))
                .for_each(|(i, j)| offer_both(&mut choice, &links[i], &links[j])),
        }
        choice.best()
    }

    fn check(&self) -> Result<()> {
        let numbers = self.poses.iter().flat_map(|pose| [pose.point.re, pose.point.im, pose.angle]);
        let given = self.pivots.iter().chain(&self.pins);
        check_positions("poses", self.poses.len(), numbers.chain(given.clone().flat_map(|at| [at.re, at.im])))?;
        check_apart("poses", &self.points(), &self.turns())?;
        let count = given.count();
        if count > 0 && self.poses.len() > 3 || count > 2 {
            let message = sentences::pivots_and_pins_are_given(&count, &self.poses.len());
            return Err(wrong("pivots", message, sentences::GIVE_TWO_PIVOTS_OR_PINS_WITH_THREE_POSES));
        }
        Ok(())
    }

    fn points(&self) -> Vec<Complex> {
        self.poses.iter().map(|pose| pose.point).collect()
    }

    /// Rotations of the coupler from the first pose to every pose.
    fn turns(&self) -> Vec<Complex> {
        turns_from_first(self.poses.iter().map(|pose| pose.angle))
    }

    fn dyads(&self) -> Result<Vec<StandardDyad>> {
        let none = || no_dyad(sentences::THE_POSES_ARE_ONE_ROTATION, sentences::TURN_A_POSE_OR_USE_A_PARALLELOGRAM);
        dyads(&self.turns(), &ways_from_first(&self.points())).ok_or_else(none)
    }

    /// The links that the given pivots and pins determine.
    fn given_links(&self) -> Result<Vec<GroundLink>> {
        let first = self.poses[0];
        let of_pivot = |&pivot: &Complex| {
            let seen = |(pose, turn): (&CouplerPose, Complex)| first.point + (pivot - pose.point) / turn;
            let pin = centre(self.poses.iter().zip(self.turns()).map(seen))
                .ok_or_else(|| on_line(sentences::the_pin_of_the_pivot_is_at_infinity(&pivot.re, &pivot.im)))?;
            Ok(self.link(pivot, (pin - first.point) * Complex::from_polar(1.0, -first.angle)))
        };
        let of_pin = |&pin: &Complex| {
            let pivot = centre(self.poses.iter().map(|pose| at_pose(pose, pin)))
                .ok_or_else(|| on_line(sentences::the_pivot_of_the_pin_is_at_infinity(&pin.re, &pin.im)))?;
            Ok(self.link(pivot, pin))
        };
        self.pivots.iter().map(of_pivot).chain(self.pins.iter().map(of_pin)).collect()
    }

    /// The link between a pivot and a pin of the coupler.
    fn link(&self, pivot: Complex, pin: Complex) -> GroundLink {
        let arms: Vec<Complex> = self.poses.iter().map(|pose| at_pose(pose, pin) - pivot).collect();
        let turns = arms.iter().map(|arm| arm / arms[0] * (arms[0].norm() / arm.norm())).collect();
        GroundLink { pivot, pin: pivot + arms[0], turns }
    }
}

/// World position of a pin at a pose (m). `pin` is given in the coupler's frame.
fn at_pose(pose: &CouplerPose, pin: Complex) -> Complex {
    pose.point + pin * Complex::from_polar(1.0, pose.angle)
}

/// The link that a dyad describes. The dyad's given vector turns with the coupler, and ends at `point` in position 1
/// (m).
pub(super) fn of_motion(dyad: StandardDyad, point: Complex) -> GroundLink {
    let pin = point - dyad.given;
    GroundLink { pivot: pin - dyad.free, pin, turns: dyad.turns }
}

/// Offers both four-bars of two links: either link may be the crank.
fn offer_both(choice: &mut Choice, a: &GroundLink, b: &GroundLink) {
    choice.offer([a, b]);
    choice.offer([b, a]);
}

/// Centre of the circle through three points (m); `None` if they lie on a line.
fn centre(mut points: impl Iterator<Item = Complex>) -> Option<Complex> {
    let [a, b, c] = [points.next()?, points.next()?, points.next()?];
    let [b, c] = [b - a, c - a];
    let area = (b.conj() * c).im;
    let size = b.norm().larger(c.norm());
    let is_circle = area.abs() > ON_LINE * size * size;
    is_circle.then(|| a + Complex::i() * (b * c.norm_sqr() - c * b.norm_sqr()) / (2.0 * area))
}

fn on_line(message: String) -> Error {
    Error::new(ErrorKind::Geometry, message).help(sentences::MOVE_THE_PIVOT_OR_THE_PIN)
}
