//! Crank-rocker from the two extreme positions of its rocker, in closed form.
//!
//! In the extreme positions, crank and coupler are in line: `|O B1| = OA + AB` if stretched, `|O B2| = AB - OA` if
//! folded.
//! The positions of B are given, so AB is half the sum of |O B1| and |O B2|, and OA is half the difference.
//! This module derives the solution from these two equations. Background: I. I. Artobolevsky, Theory of Mechanisms and
//! Machines, 4th ed., Nauka 1988.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use super::{time_ratio, transmission_angle, wrong};
use analytic::range::{FourBar, FourBarType};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::{Vec2, cross, unit};
use linkage::mechanism::AssemblyMode;

/// Requirements on a crank-rocker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrankRockerSpec {
    /// Pivot O of the crank (m).
    pub crank_pivot: Vec2,
    /// Pivot C of the rocker (m).
    pub rocker_pivot: Vec2,
    /// Length CB of the rocker (m).
    pub rocker: f64,
    /// Angle of the rocker C -> B in one extreme position (rad).
    pub extreme: f64,
    /// Angle from the rocker's angle `extreme` to the rocker's other extreme position (rad).
    /// The angle is positive counter-clockwise, not zero, and less than half a turn in either sense.
    pub swing: f64,
}

/// An extreme position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockerExtreme {
    /// Angle of the rocker C -> B in the extreme position (rad).
    pub rocker: f64,
    /// Angle of the crank O -> A in the extreme position (rad), from 0 to a full turn.
    pub crank: f64,
}

/// A crank-rocker that has the required extreme positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrankRocker {
    /// The requirements.
    pub wish: CrankRockerSpec,
    /// Length OA of the crank (m).
    pub crank: f64,
    /// Length AB of the coupler (m).
    pub coupler: f64,
    /// Extreme position in which crank and coupler are stretched.
    pub stretched: RockerExtreme,
    /// Extreme position in which crank and coupler are folded.
    pub folded: RockerExtreme,
    /// Assembly mode of the dyad (coupler, rocker).
    pub mode: AssemblyMode,
    /// Smallest transmission angle over the turn (rad): the angle between coupler and rocker at B, at most a right
    /// angle.
    pub transmission: f64,
    /// Crank angle (rad) at which the transmission angle is smallest. There, the crank is on the line of the pivots.
    pub transmission_at: f64,
    /// Time of the slower swing divided by the time of the faster swing, at a constant speed of the crank.
    pub time_ratio: f64,
}

impl CrankRocker {
    /// The crank-rocker for the given requirements.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a length that is not positive, an angle outside its range, or coincident pivots.
    /// [`ErrorKind::Geometry`] if the two positions permit no crank that turns fully. The error states the reason.
    pub fn of(wish: CrankRockerSpec) -> Result<Self> {
        check(&wish)?;
        let frame = wish.rocker_pivot - wish.crank_pivot;
        let angles = [wish.extreme, wish.extreme + wish.swing];
        // Vectors from the crank's pivot to B in both extreme positions.
        let arms = angles.map(|angle| frame + unit(angle) * wish.rocker);
        let distances = arms.map(|arm| arm.norm());
        let (far, near) = if distances[0] >= distances[1] { (0, 1) } else { (1, 0) };
        let (crank, coupler) = ((distances[far] - distances[near]) / 2.0, (distances[far] + distances[near]) / 2.0);
        let told = sentences::is_from_in_one_extreme_position(&distances[0], &distances[1]);
        if !(crank > 1e-9 * coupler) {
            let message = sentences::a_crank_of_no_length_would(&told);
            let help = sentences::MOVE_A_PIVOT_OR_TURN_THE_EXTREME_POSITIONS;
            return Err(Error::new(ErrorKind::Geometry, message).help(help));
        }
        let sides = arms.map(|arm| cross(frame, arm));
        if !(sides[0] * sides[1] > 0.0) {
            let message = sentences::THE_LINE_OF_THE_TWO_PIVOTS;
            return Err(Error::new(ErrorKind::Geometry, message).help(sentences::CHOOSE_A_SMALLER_SWING_OR_PIVOTS));
        }
        let lengths = [frame.norm(), crank, coupler, wish.rocker];
        let found = FourBar::of_lengths(lengths).of_type;
        // After the check above, O, B and C form a triangle in both extreme positions. By the triangle inequalities,
        // the crank is the shortest link and turns fully.
        // If the triangle is flat within rounding errors, this conclusion may fail. Such requirements are refused.
        if found != FourBarType::CrankRocker {
            let message = sentences::an_extreme_position_lies_on_the_line(&told, &found.name());
            return Err(Error::new(ErrorKind::Geometry, message).help(sentences::MOVE_A_PIVOT_OR_TURN_THE_EXTREME));
        }
        let direction = |k: usize| arms[k].y.atan2(arms[k].x);
        let at =
            |k: usize, turn: f64| RockerExtreme { rocker: angles[k], crank: (direction(k) + turn).rem_euclid(TAU) };
        let (transmission, transmission_at) = transmission(lengths, frame);
        Ok(CrankRocker {
            wish,
            crank,
            coupler,
            stretched: at(far, 0.0),
            folded: at(near, PI),
            mode: if sides[far] < 0.0 { AssemblyMode::Right } else { AssemblyMode::Left },
            transmission,
            transmission_at,
            time_ratio: time_ratio(cross(arms[0], arms[1]).atan2(arms[0].dot(&arms[1]))),
        })
    }
}

fn check(wish: &CrankRockerSpec) -> Result<()> {
    let finite = [wish.crank_pivot.x, wish.crank_pivot.y, wish.rocker_pivot.x, wish.rocker_pivot.y, wish.extreme];
    if !finite.iter().all(|value| value.is_finite()) {
        return Err(wrong("pivots", sentences::A_COORDINATE_OR_AN_ANGLE.into(), sentences::GIVE_DECIMAL_NUMBERS));
    }
    if !(wish.rocker > 0.0 && wish.rocker.is_finite()) {
        let message = sentences::the_rocker_length_is(&wish.rocker);
        return Err(wrong("rocker", message, sentences::GIVE_A_LENGTH_GREATER_THAN_ZERO));
    }
    if !(wish.swing != 0.0 && wish.swing.abs() < PI) {
        let message = sentences::the_swing_is_deg(&wish.swing.to_degrees());
        return Err(wrong("swing", message, sentences::GIVE_AN_ANGLE_BETWEEN_AND_DEG));
    }
    if !((wish.rocker_pivot - wish.crank_pivot).norm() > 0.0) {
        let message = sentences::BOTH_PIVOTS_ARE_ONE_POINT.into();
        return Err(wrong("pivots", message, sentences::GIVE_THE_ROCKER_A_PIVOT_OF_ITS_OWN));
    }
    Ok(())
}

/// Smallest transmission angle (rad) of a four-bar (frame, crank, coupler, rocker), and its crank angle (rad).
/// The transmission angle has its extremes where the crank is on the line of the pivots (Alt 1932).
/// In these two poses, A is nearest to C, or farthest from C.
fn transmission([frame, crank, coupler, rocker]: [f64; 4], line: Vec2) -> (f64, f64) {
    let at = |distance: f64| transmission_angle(distance, coupler, rocker);
    let towards = line.y.atan2(line.x).rem_euclid(TAU);
    let (near, far) = (at(frame - crank), at(frame + crank));
    if near <= far { (near, towards) } else { (far, (towards + PI).rem_euclid(TAU)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn published() -> CrankRockerSpec {
        CrankRockerSpec {
            crank_pivot: Vec2::zeros(),
            rocker_pivot: Vec2::new(0.15, 0.015),
            rocker: 0.25,
            extreme: 50f64.to_radians(),
            swing: 32f64.to_radians(),
        }
    }

    #[test]
    fn the_published_lengths_are_reproduced() {
        let found = CrankRocker::of(published()).unwrap();
        assert!((found.crank - 0.025_995_627_740_337).abs() < 1e-12, "{}", found.crank);
        assert!((found.coupler - 0.347_071_931_891_81).abs() < 1e-12, "{}", found.coupler);
        assert!((found.stretched.crank.to_degrees() - 33.610_819_789_881_56).abs() < 1e-9);
        assert!((found.folded.crank.to_degrees() - 234.862_320_107_189_4).abs() < 1e-9);
        assert_eq!(found.mode, AssemblyMode::Left);
    }

    #[test]
    fn swapped_or_mirrored_extremes_give_the_same_lengths() {
        let wish = published();
        let first = CrankRocker::of(wish).unwrap();
        let other = CrankRocker::of(CrankRockerSpec { extreme: wish.extreme + wish.swing, swing: -wish.swing, ..wish })
            .unwrap();
        assert!((first.crank - other.crank).abs() < 1e-16 && (first.time_ratio - other.time_ratio).abs() < 1e-14);
        let mirrored = CrankRockerSpec {
            rocker_pivot: Vec2::new(0.15, -0.015),
            extreme: -wish.extreme,
            swing: -wish.swing,
            ..wish
        };
        let mirrored = CrankRocker::of(mirrored).unwrap();
        assert!((first.crank - mirrored.crank).abs() < 1e-16 && mirrored.mode == AssemblyMode::Right);
    }

    #[test]
    fn impossible_requests_are_refused_with_the_reason() {
        let wish = published();
        for (bad, kind, words) in [
            (CrankRockerSpec { swing: 0.0, ..wish }, ErrorKind::Input, "the swing is 0 deg"),
            (CrankRockerSpec { rocker: -1.0, ..wish }, ErrorKind::Input, "length is -1 m"),
            (CrankRockerSpec { rocker_pivot: Vec2::zeros(), ..wish }, ErrorKind::Input, "two pivots coincide"),
            (CrankRockerSpec { extreme: f64::NAN, ..wish }, ErrorKind::Input, "not finite"),
            // The two positions of B are symmetric about the line of the pivots, so their distances from O are equal.
            (
                CrankRockerSpec { rocker_pivot: Vec2::new(0.15, 0.0), extreme: -0.3, swing: 0.6, ..wish },
                ErrorKind::Geometry,
                "zero length",
            ),
            (CrankRockerSpec { extreme: -0.3, swing: 1.0, ..wish }, ErrorKind::Geometry, "passes between"),
        ] {
            let error = CrankRocker::of(bad).unwrap_err();
            assert!(error.kind() == kind && error.message().contains(words), "{bad:?}: {error}");
            assert!(error.way_out().is_some());
        }
    }
}
