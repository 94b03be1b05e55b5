//! Laws of cams: lift of the follower as a function of the cam's angle, in pieces or as one curve.
//!
//! The curve of a piece is normalised.
//! The normalised curve rises from 0 to 1 while x goes from 0 to 1. The slope of the normalised curve is zero at both
//! ends.
//! Equations: Norton, Cam Design and Manufacturing Handbook, 2nd ed., Industrial Press 2009, chapters 2 and 3.

use std::f64::consts::{PI, TAU};

use crate::math::{Curve, KeepNan};

/// Curve of a rise or return.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CamCurve {
    /// Cycloidal: sine acceleration.
    Cycloidal,
    /// Polynomial 3-4-5.
    Polynomial345,
    /// Polynomial 4-5-6-7.
    Polynomial4567,
    /// Modified sine.
    ModifiedSine,
}

impl CamCurve {
    /// All curves.
    pub const ALL: [CamCurve; 4] =
        [CamCurve::Cycloidal, CamCurve::Polynomial345, CamCurve::Polynomial4567, CamCurve::ModifiedSine];

    /// Value and first two derivatives at `x`, which is between 0 and 1.
    #[must_use]
    pub fn at(self, x: f64) -> [f64; 3] {
        match self {
            CamCurve::Cycloidal => {
                let (sine, cosine) = (TAU * x).sin_cos();
                [x - sine / TAU, 1.0 - cosine, TAU * sine]
            }
            CamCurve::Polynomial345 => [
                x * x * x * (10.0 - x * (15.0 - 6.0 * x)),
                x * x * (30.0 - x * (60.0 - 30.0 * x)),
                x * (60.0 - x * (180.0 - 120.0 * x)),
            ],
            CamCurve::Polynomial4567 => {
                let cube = x * x * x;
                [
                    cube * x * (35.0 - x * (84.0 - x * (70.0 - 20.0 * x))),
                    cube * (140.0 - x * (420.0 - x * (420.0 - 140.0 * x))),
                    x * x * (420.0 - x * (1680.0 - x * (2100.0 - 840.0 * x))),
                ]
            }
            CamCurve::ModifiedSine => {
                // At each end, the acceleration follows a quarter period of a sine wave.
                // In between, it follows half a period of a slower sine wave.
                let (share, turns) = ((4.0 + PI).recip(), (x * 8.0).clamp(0.0, 8.0));
                let (sine, cosine) = (4.0 * PI * x).sin_cos();
                let (slow, slow_cosine) = ((4.0 * PI * x + PI) / 3.0).sin_cos();
                match turns {
                    ..1.0 => {
                        [share * (PI * x - 0.25 * sine), share * PI * (1.0 - cosine), share * 4.0 * PI * PI * sine]
                    }
                    7.0.. => [
                        share * (4.0 + PI * x - 0.25 * sine),
                        share * PI * (1.0 - cosine),
                        share * 4.0 * PI * PI * sine,
                    ],
                    _ => [
                        share * (2.0 + PI * x - 2.25 * slow),
                        share * PI * (1.0 - 3.0 * slow_cosine),
                        share * 4.0 * PI * PI * slow,
                    ],
                }
            }
        }
    }
}

/// A piece of a law. The piece begins where the previous piece ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamSegment {
    /// Angle of the cam at the end (rad).
    pub to: f64,
    /// Lift at the end (m, or rad for a swinging follower).
    pub lift: f64,
    /// Curve of the rise or return. The curve has no effect in a dwell, because the lift is constant.
    pub curve: CamCurve,
}

/// The motion of a follower over the angle of its cam, repeated with every turn.
#[derive(Clone, Debug, PartialEq)]
pub enum CamLaw {
    /// Pieces from lift 0 at angle 0 to lift 0 at a full turn; see [`CamLaw::of`].
    Segments(Vec<CamSegment>),
    /// A periodic spline, or a formula from 0 to a full turn.
    Curve(Curve),
}

impl CamLaw {
    /// The law with these pieces.
    /// `None` if the pieces are not valid.
    /// The ends of the pieces must ascend, from an angle above 0 to a full turn, and the last lift must be 0.
    #[must_use]
    pub fn of(segments: Vec<CamSegment>) -> Option<Self> {
        let ends = std::iter::once(0.0).chain(segments.iter().map(|own| own.to));
        let ascends = ends.zip(&segments).all(|(from, own)| own.to > from && own.lift.is_finite());
        let last = segments.last()?;
        (ascends && (last.to - TAU).abs() < 1e-9 && last.lift == 0.0).then_some(CamLaw::Segments(segments))
    }

    /// Lift at an angle of the cam (rad), and its first two derivatives with respect to the angle.
    #[must_use]
    pub fn at(&self, angle: f64) -> [f64; 3] {
        let angle = angle.rem_euclid(TAU);
        let segments = match self {
            CamLaw::Segments(segments) => segments,
            CamLaw::Curve(curve) => return curve.at(angle),
        };
        let index = segments.partition_point(|own| own.to < angle).min(segments.len() - 1);
        let (from, begun) = match index.checked_sub(1) {
            Some(before) => (segments[before].to, segments[before].lift),
            None => (0.0, 0.0),
        };
        let CamSegment { to, lift, curve } = segments[index];
        let (width, rise) = (to - from, lift - begun);
        let [value, first, second] = curve.at((angle - from) / width);
        [begun + rise * value, rise * first / width, rise * second / (width * width)]
    }

    /// The law with all lifts multiplied by `factor`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        match self {
            CamLaw::Segments(segments) => {
                CamLaw::Segments(segments.iter().map(|own| CamSegment { lift: own.lift * factor, ..*own }).collect())
            }
            CamLaw::Curve(curve) => CamLaw::Curve(curve.times(factor)),
        }
    }

    /// Angular distance (rad) from the given cam angle to the nearest end of a piece.
    /// At the end of a piece the third derivative jumps.
    /// A law that is a harmonic or a formula has no pieces. The result for such a law is pi.
    #[must_use]
    pub fn to_knot(&self, angle: f64) -> f64 {
        let away = |end: f64| ((angle - end + PI).rem_euclid(TAU) - PI).abs();
        match self {
            CamLaw::Segments(segments) => segments.iter().map(|own| away(own.to)).fold(PI, f64::smaller),
            CamLaw::Curve(Curve::Table(table)) => table.knots().iter().map(|&knot| away(knot)).fold(PI, f64::smaller),
            CamLaw::Curve(Curve::Harmonic { .. } | Curve::Formula(_)) => PI,
        }
    }

    /// Largest minus least lift (m or rad).
    #[must_use]
    pub fn range(&self) -> f64 {
        let segments = match self {
            CamLaw::Segments(segments) => segments,
            CamLaw::Curve(curve) => return curve.range(),
        };
        let lifts = || segments.iter().map(|own| own.lift);
        lifts().fold(f64::NEG_INFINITY, f64::larger) - lifts().fold(f64::INFINITY, f64::smaller)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn curves_rise_from_rest_to_rest_and_match_their_derivatives() {
        for curve in CamCurve::ALL {
            for (x, value) in [(0.0, 0.0), (1.0, 1.0)] {
                let [own, first, second] = curve.at(x);
                assert_relative_eq!(own, value, epsilon = 1e-14);
                assert_relative_eq!(first, 0.0, epsilon = 1e-13);
                assert_relative_eq!(second, 0.0, epsilon = 1e-12);
            }
            for x in [0.05, 0.124, 0.126, 0.3, 0.5, 0.8, 0.9] {
                let h = 1e-6;
                let [[before, rate, _], [after, later, _]] = [curve.at(x - h), curve.at(x + h)];
                let [_, first, second] = curve.at(x);
                assert_relative_eq!((after - before) / (2.0 * h), first, epsilon = 1e-8);
                assert_relative_eq!((later - rate) / (2.0 * h), second, epsilon = 1e-6);
            }
        }
        // Published peak factors of velocity and acceleration: Norton, table 3-3 and figure 3-19.
        let peak = |curve: CamCurve, k: usize| {
            (0..=4000).map(|i| curve.at(f64::from(i) / 4000.0)[k]).fold(0.0, KeepNan::larger)
        };
        for (curve, velocity, acceleration) in [
            (CamCurve::Cycloidal, 2.0, TAU),
            (CamCurve::Polynomial345, 1.875, 5.774),
            (CamCurve::Polynomial4567, 2.188, 7.513),
            (CamCurve::ModifiedSine, 1.760, 5.528),
        ] {
            assert_relative_eq!(peak(curve, 1), velocity, epsilon = 1e-3);
            assert_relative_eq!(peak(curve, 2), acceleration, epsilon = 1e-3);
        }
    }
}
