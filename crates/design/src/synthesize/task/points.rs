//! Precision points: positions that the output link must reach, at given or at free crank angles.

use std::f64::consts::TAU;

use linkage::math::{KeepNan, Vec2};

/// A position that the output link must reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrecisionPoint {
    /// Crank angle (rad, from crank angle zero in the sense of rotation). `None` if the search chooses the crank angle.
    pub turn: Option<f64>,
    /// World position of the working point (m). `None` if only the angle is required.
    pub place: Option<Vec2>,
    /// Angle of the link (rad, counter-clockwise positive). `None` if only the position is required.
    pub angle: Option<f64>,
}

/// The precision points of a task. Points with free crank angles are reached in the order of the list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PrecisionPoints {
    points: Vec<PrecisionPoint>,
    /// Length by which deviations are divided (m).
    extent: f64,
}

impl PrecisionPoints {
    /// Stores the points and the extent: the length by which deviations of positions are divided.
    /// The extent is the largest distance between two required positions, or `size` (m) if this distance is zero.
    /// Deviations of angles are in radians.
    pub fn of(points: Vec<PrecisionPoint>, size: f64) -> Self {
        let places: Vec<Vec2> = points.iter().filter_map(|point| point.place).collect();
        let apart = |a: &Vec2| places.iter().map(|b| (a - b).norm()).fold(0.0, f64::larger);
        let extent = places.iter().map(apart).fold(0.0, f64::larger);
        PrecisionPoints { points, extent: if extent > 0.0 { extent } else { size } }
    }

    /// The points, in their order.
    pub fn all(&self) -> &[PrecisionPoint] {
        &self.points
    }

    /// Whether the task has no precision points.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Deviations of a position from a point: the deviations of x and y, divided by the extent, and the deviation of
    /// the angle (rad).
    /// A coordinate that is not required has the deviation 0.
    pub fn deviations(&self, point: &PrecisionPoint, place: Vec2, angle: f64) -> [f64; 3] {
        let apart = point.place.map_or(Vec2::zeros(), |wanted| (place - wanted) / self.extent);
        let turned = point.angle.map_or(0.0, |wanted| angle - wanted);
        [apart.x, apart.y, turned - TAU * (turned / TAU).round()]
    }

    /// Sum of the squared [deviations](PrecisionPoints::deviations) of a position from a point.
    pub fn squared_deviation(&self, point: &PrecisionPoint, place: Vec2, angle: f64) -> f64 {
        self.deviations(point, place, angle).iter().map(|own| own * own).sum()
    }

    /// The length by which deviations of positions are divided (m).
    pub fn extent(&self) -> f64 {
        self.extent
    }
}
