//! Graphical methods: which motion diagram follows from which other diagram, and at which points.
//!
//! Chords of the displacement give the velocity at the midpoints of the divisions.
//! Chords of the chord velocity give the acceleration at the ends of the divisions.
//! Tangents give the derivative at the ends of the divisions.
//! Only the points at the ends of the divisions are known. The tangent is therefore drawn parallel to the chord of the
//! two neighbouring points, which is exact for a parabola. The error of a tangent is four times the error of a chord.
//! Integration by rays: the increments follow from the exact derivative at the midpoints of the divisions.
//! Integration by areas: the increments are the areas of the trapezoids below the exact derivative.
//! On paper, these areas are found by counting squares. Each integration starts from the exact first value.

use super::chord::{closed_slopes, integral, middles, slopes};

linkage::words! {
    /// Method that computes one diagram from another.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Method: words {
        /// Velocity from chords of the displacement.
        ChordVelocity = "velocity by chords",
        /// Acceleration from chords of the chord velocity.
        ChordAcceleration = "acceleration by chords of chords",
        /// Displacement by graphical integration of the velocity.
        IntegratedDisplacement = "displacement by integration",
        /// Velocity by graphical integration of the acceleration.
        IntegratedVelocity = "velocity by integration",
        /// Velocity from tangents to the displacement.
        TangentVelocity = "velocity by tangents",
        /// Acceleration from tangents to the velocity curve, which itself was found from tangents.
        TangentAcceleration = "acceleration by tangents",
        /// Displacement from areas below the velocity.
        AreaDisplacement = "displacement by areas",
        /// Velocity from areas below the acceleration.
        AreaVelocity = "velocity by areas",
    }
}

impl Method {
    /// Index of the quantity that the method computes: 0 displacement, 1 velocity, 2 acceleration.
    pub fn gives(self) -> usize {
        match self {
            Method::IntegratedDisplacement | Method::AreaDisplacement => 0,
            Method::ChordVelocity | Method::IntegratedVelocity | Method::TangentVelocity | Method::AreaVelocity => 1,
            Method::ChordAcceleration | Method::TangentAcceleration => 2,
        }
    }
}

/// Applies a method to divisions of `stride` rows. Returns the rows with a result, and the results.
/// `is_closed` states whether the motion repeats after the last row.
pub(super) fn apply(
    method: Method,
    stride: usize,
    is_closed: bool,
    times: &[f64],
    exact: &[Vec<f64>; 3],
) -> (Vec<usize>, Vec<f64>) {
    let ends: Vec<usize> = (0..times.len()).step_by(stride).collect();
    let midpoints: Vec<usize> = (stride / 2..times.len()).step_by(stride).collect();
    let at = |rows: &[usize], of: &[f64]| rows.iter().map(|&row| of[row]).collect::<Vec<f64>>();
    let places = at(&ends, times);
    let chords = || slopes(&places, &at(&ends, &exact[0]));
    let integrated = |of: usize| integral(exact[of][0], &places, &at(&midpoints, &exact[of + 1]));
    let areas = |of: usize| integral(exact[of][0], &places, &middles(&at(&ends, &exact[of + 1])));
    let tangent = || tangents(&ends, &places, &at(&ends, &exact[0]), is_closed);
    match method {
        Method::ChordVelocity => (midpoints, chords()),
        Method::ChordAcceleration if is_closed => (ends[1..].to_vec(), closed_slopes(&places, &chords())),
        Method::ChordAcceleration => (ends[1..ends.len() - 1].to_vec(), slopes(&at(&midpoints, times), &chords())),
        Method::TangentVelocity => tangent(),
        Method::TangentAcceleration => {
            let (rows, velocity) = tangent();
            // If the motion repeats, the first velocity equals the last one.
            let (rows, velocity) = match (is_closed, velocity.last()) {
                (true, Some(&last)) => ([&[0], &rows[..]].concat(), [&[last], &velocity[..]].concat()),
                (true, None) | (false, _) => (rows, velocity),
            };
            tangents(&rows, &at(&rows, times), &velocity, is_closed)
        }
        Method::IntegratedDisplacement => (ends.clone(), integrated(0)),
        Method::IntegratedVelocity => (ends.clone(), integrated(1)),
        Method::AreaDisplacement => (ends.clone(), areas(0)),
        Method::AreaVelocity => (ends.clone(), areas(1)),
    }
}

/// The rows that have two neighbours, and for each row the slope of the chord between its neighbours.
/// If the motion repeats, the last row is included. The slope in the last row is also the slope in the first row.
fn tangents(rows: &[usize], places: &[f64], values: &[f64], is_closed: bool) -> (Vec<usize>, Vec<f64>) {
    let last = rows.len() - 1;
    let wrapped = |of: &[f64]| if is_closed { [of, &[of[last] + (of[1] - of[0])]].concat() } else { of.to_vec() };
    let (places, values) = (wrapped(places), wrapped(values));
    let steps = places.windows(3).zip(values.windows(3)).map(|(x, y)| (y[2] - y[0]) / (x[2] - x[0]));
    (rows[1..if is_closed { last + 1 } else { last }].to_vec(), steps.collect())
}
