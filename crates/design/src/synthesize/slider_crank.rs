//! Closed-form synthesis of a slider-crank from its stroke, its offset, and either the rod's length or the time ratio.
//!
//! Let r be the crank, l the rod, and e the offset: the distance of the crank's pivot from the slider's line.
//! The stroke is then `s = sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2)`.
//! Squaring this equation twice gives an equation that is linear in r^2:
//! `r^2 = s^2 (4 (l^2 - e^2) - s^2) / (4 (4 l^2 - s^2))`.
//! The crank turns fully if l > r + |e|.
//! At the limit l = r + |e|, the rod has its smallest possible length: `l = (|e| + sqrt(e^2 + s^2)) / 2`.
//! For the time ratio K, the directions from the pivot to the two extreme positions differ by
//! theta = pi (K - 1) / (K + 1).
//! Let n be the distance from the pivot to the nearer extreme position, measured along the slider's line. It solves
//! `n^2 + s n + e^2 - |e| s cot(theta) = 0`.
//! This equation follows from the right triangles of the extreme positions.

use crate::sentences;
use std::f64::consts::{PI, TAU};

use super::{time_ratio, wrong};
use linkage::error::{Advice, Error, ErrorKind, Result};

/// Requirement on a slider-crank in addition to its stroke and offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// Length of the rod (m).
    Rod(f64),
    /// Time of the slower stroke divided by the time of the faster stroke, at a constant speed of the crank. The ratio
    /// is at least 1.
    TimeRatio(f64),
}

/// A slider-crank with its crank's pivot at the origin and the slider's line parallel to x at y = `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrank {
    /// Stroke of the slider (m).
    pub stroke: f64,
    /// Offset of the slider's line (m), positive above the pivot.
    pub offset: f64,
    /// Length of the crank (m).
    pub crank: f64,
    /// Length of the rod (m).
    pub rod: f64,
    /// Crank angle (rad, from 0 to a full turn) and position of the slider along its line (m) where the slider is
    /// farthest from the pivot.
    pub far: [f64; 2],
    /// Crank angle (rad, from 0 to a full turn) and position of the slider along its line (m) where the slider is
    /// nearest to the pivot.
    pub near: [f64; 2],
    /// Time of the slower stroke divided by the time of the faster stroke, at a constant speed of the crank.
    pub time_ratio: f64,
    /// Pressure angle: the largest angle between the rod and the slider's line (rad).
    /// The smallest transmission angle is the complement of the pressure angle.
    pub pressure: f64,
}

fn impossible(message: String, help: impl Into<Advice>) -> Error {
    Error::new(ErrorKind::Geometry, message).help(help)
}

impl SliderCrank {
    /// The slider-crank with this stroke and offset (m), and with the length of the rod or the time ratio `given`.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a number outside its range.
    /// [`ErrorKind::Geometry`] if no crank turns fully, or if the time ratio does not determine the mechanism.
    /// If no crank turns fully, the error states the limit.
    pub fn of(stroke: f64, offset: f64, given: Given) -> Result<Self> {
        if !(stroke > 0.0 && stroke.is_finite()) {
            return Err(wrong("stroke", sentences::the_stroke_is(&stroke), sentences::GIVE_A_LENGTH_GREATER_THAN_ZERO));
        }
        if !offset.is_finite() {
            let help = sentences::GIVE_A_DECIMAL_NUMBER_FOR_A_CENTRAL;
            return Err(wrong("offset", sentences::the_offset_is(&offset), help));
        }
        let e = offset.abs();
        let (crank, rod) = match given {
            Given::Rod(rod) => (crank_of(stroke, e, rod)?, rod),
            Given::TimeRatio(ratio) => of_time_ratio(stroke, e, ratio)?,
        };
        let place = |reach: f64| (reach * reach - e * e).sqrt();
        // In the folded position (`near`), the rod points from the crank's pin through the crank's pivot to the slider.
        let far = [(offset / (rod + crank)).asin().rem_euclid(TAU), place(rod + crank)];
        let near = [((offset / (rod - crank)).asin() + PI).rem_euclid(TAU), place(rod - crank)];
        let between = (e / (rod - crank)).asin() - (e / (rod + crank)).asin();
        Ok(SliderCrank {
            stroke,
            offset,
            crank,
            rod,
            far,
            near,
            time_ratio: time_ratio(between),
            pressure: ((crank + e) / rod).asin(),
        })
    }
}

/// Length of the crank for a length of the rod (m).
fn crank_of(stroke: f64, e: f64, rod: f64) -> Result<f64> {
    if !(rod > 0.0 && rod.is_finite()) {
        return Err(wrong("rod", sentences::the_rod_length_is(&rod), sentences::GIVE_A_LENGTH_GREATER_THAN_ZERO));
    }
    let shortest = (e + e.hypot(stroke)) / 2.0;
    if !(rod > shortest) {
        let message = sentences::a_rod_of_is_too_short_for_a_stroke(&rod, &stroke, &e);
        return Err(impossible(message, sentences::give_a_rod_longer_than(&shortest)));
    }
    let (rod, s) = (rod * rod, stroke * stroke);
    Ok((s * (4.0 * (rod - e * e) - s) / (4.0 * (4.0 * rod - s))).sqrt())
}

/// Lengths of crank and rod for a time ratio (m).
fn of_time_ratio(stroke: f64, e: f64, ratio: f64) -> Result<(f64, f64)> {
    if !(ratio >= 1.0 && ratio.is_finite()) {
        return Err(wrong("time_ratio", sentences::the_time_ratio_is(&ratio), sentences::GIVE_THE_TIME_OF_THE_SLOWER));
    }
    let theta = PI * (ratio - 1.0) / (ratio + 1.0);
    let undecided = match (e == 0.0, theta == 0.0) {
        (true, true) => Some(sentences::WITHOUT_AN_OFFSET_ANY_ROD.to_string()),
        (true, false) => Some(sentences::without_an_offset_both_strokes(&ratio)),
        (false, true) => Some(sentences::WITH_AN_OFFSET_THE_TWO_STROKES.to_string()),
        (false, false) => None,
    };
    if let Some(message) = undecided {
        return Err(impossible(message, sentences::GIVE_THE_LENGTH_OF_THE_ROD));
    }
    let rest = e * e - e * stroke / theta.tan();
    if !(rest < 0.0) {
        let most = time_ratio((stroke / e).atan());
        let message = sentences::a_time_ratio_of_is_out_of_reach(&ratio, &stroke, &e);
        return Err(impossible(message, sentences::ask_for_less_than_or_choose(&most)));
    }
    let near = 2.0 * -rest / (stroke + (stroke * stroke - 4.0 * rest).sqrt());
    let (far, near) = ((near + stroke).hypot(e), near.hypot(e));
    Ok(((far - near) / 2.0, (far + near) / 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_crank_of_a_central_slider_crank_is_half_the_stroke() {
        let found = SliderCrank::of(0.1, 0.0, Given::Rod(0.2)).unwrap();
        assert!((found.crank - 0.05).abs() < 1e-16 && (found.time_ratio - 1.0).abs() < 1e-15);
        assert!((found.pressure - 0.25f64.asin()).abs() < 1e-15);
    }

    #[test]
    fn rod_and_time_ratio_lead_to_the_same_linkage() {
        for (stroke, offset, rod) in [(0.1, 0.03, 0.15), (0.1, -0.03, 0.12), (0.02, 0.05, 0.08), (1.0, 1e-3, 0.7)] {
            let found = SliderCrank::of(stroke, offset, Given::Rod(rod)).unwrap();
            assert!((found.far[1] - found.near[1] - stroke).abs() < 1e-14);
            assert!(found.rod > found.crank + offset.abs());
            let again = SliderCrank::of(stroke, offset, Given::TimeRatio(found.time_ratio)).unwrap();
            assert!(
                (again.rod - rod).abs() < 1e-10 && (again.crank - found.crank).abs() < 1e-10,
                "{found:?} {again:?}"
            );
        }
    }

    #[test]
    fn the_reported_limits_are_sharp() {
        let (stroke, offset) = (0.1, 0.03);
        let told = |given| SliderCrank::of(stroke, offset, given).unwrap_err().way_out().unwrap().to_string();
        let number = |text: String| {
            text.split_whitespace().find_map(|word| word.trim_end_matches(',').parse::<f64>().ok()).unwrap()
        };
        let shortest = number(told(Given::Rod(0.05)));
        assert!(SliderCrank::of(stroke, offset, Given::Rod(shortest - 1e-6)).is_err());
        let found = SliderCrank::of(stroke, offset, Given::Rod(shortest + 1e-6)).unwrap();
        assert!(found.rod - found.crank - offset < 1e-5);
        let most = number(told(Given::TimeRatio(50.0)));
        assert!(SliderCrank::of(stroke, offset, Given::TimeRatio(most + 1e-5)).is_err());
        assert!(SliderCrank::of(stroke, offset, Given::TimeRatio(most - 1e-5)).is_ok());
    }

    #[test]
    fn invalid_requests_are_refused_with_the_reason() {
        for (stroke, offset, given, words) in [
            (0.0, 0.0, Given::Rod(1.0), "the stroke is 0 m"),
            (0.1, f64::NAN, Given::Rod(1.0), "the offset is NaN"),
            (0.1, 0.0, Given::Rod(0.0), "length is 0 m"),
            (0.1, 0.0, Given::TimeRatio(1.2), "without an offset both"),
            (0.1, 0.0, Given::TimeRatio(1.0), "any rod"),
            (0.1, 0.01, Given::TimeRatio(1.0), "never take the same time"),
            (0.1, 0.01, Given::TimeRatio(0.5), "the time ratio is 0.5"),
        ] {
            let error = SliderCrank::of(stroke, offset, given).unwrap_err();
            assert!(error.message().contains(words) && error.way_out().is_some(), "{error}");
        }
    }
}
