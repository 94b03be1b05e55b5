//! Simbody's results at one instant. The memory layout is that of C.

/// Results at one instant. Bodies and loops are in the order in which they were added. The first body has number 1.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SimbodyState {
    /// All bodies except the ground.
    pub bodies: Vec<BodyState>,
    /// Every loop.
    pub loops: Vec<LoopState>,
}

/// State of a body at one instant, in world axes. Force, moment and drive are 0 if reactions were not requested.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct BodyState {
    /// Coordinate of the body's joint (rad, unwrapped, or m).
    pub coordinate: f64,
    /// Rate of the coordinate (rad/s or m/s).
    pub rate: f64,
    /// Position of the origin of the body's frame (m).
    pub origin: [f64; 2],
    /// Unit vector of the x axis of the body's frame.
    pub direction: [f64; 2],
    /// Velocity of the origin (m/s).
    pub velocity: [f64; 2],
    /// Angular velocity (rad/s).
    pub omega: f64,
    /// Acceleration of the origin (m/s^2).
    pub acceleration: [f64; 2],
    /// Angular acceleration (rad/s^2).
    pub alpha: f64,
    /// Force on the body from its joint with the parent (N).
    pub force: [f64; 2],
    /// Moment on the body from its joint with the parent, about the joint's point on the body (N m).
    /// This moment includes the driving moment.
    pub moment: f64,
    /// Generalised force of the prescribed motion (N m for a pin, N for a slider).
    pub drive: f64,
}

impl BodyState {
    pub(crate) fn is_finite(&self) -> bool {
        let pairs = [self.origin, self.direction, self.velocity, self.acceleration, self.force];
        let others = [self.coordinate, self.rate, self.omega, self.alpha, self.moment, self.drive];
        pairs.as_flattened().iter().chain(&others).all(|number| number.is_finite())
    }
}

/// State of a loop at one instant.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct LoopState {
    /// Force of the first body on the second (N, world axes).
    pub force: [f64; 2],
    /// Opening of the loop (m): distance between the joint's point on the first body and its point on the second body.
    pub gap: f64,
}

impl LoopState {
    pub(crate) fn is_finite(&self) -> bool {
        self.force.iter().chain([&self.gap]).all(|number| number.is_finite())
    }
}
