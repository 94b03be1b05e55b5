//! Contact of the members of a transmission, in the frame of their carrier.

use crate::math::Vec2;

/// A line along which a transmission exerts its force, in the frame of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineOfAction {
    /// Direction of a positive force on the second member, as a unit vector.
    pub direction: Vec2,
    /// Points of the line at which the force acts on the first and on the second member.
    pub feet: [Vec2; 2],
}

/// The contact of a transmission in one pose, in the frame of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Contact {
    /// The lines of action. The first line is for positive forces, the second line for negative forces.
    pub lines: [LineOfAction; 2],
    /// Speed of the second member's foot along the first line, divided by the rate of the second member's coordinate
    /// (m, or 1 for a slide).
    pub factor: f64,
    /// Angular velocity of the lines relative to the carrier, divided by the rate of the first member's coordinate.
    pub turn: f64,
    /// Velocity of the feet relative to the carrier, divided by the rate of the first member's coordinate (m).
    pub drift: Vec2,
}
