//! Range of the input over which relations are proven.

/// The range of the first drive's input. The driven joint's coordinate follows from this input.
#[derive(Clone, Copy, Debug)]
pub(super) struct InputRange {
    /// Both ends (rad or m), in the direction of motion.
    pub ends: [f64; 2],
    /// Input in the start pose (rad or m).
    pub start: f64,
    /// Change of the driven joint's coordinate per unit of the input: 1 or -1.
    pub sense: f64,
}

impl InputRange {
    pub fn coordinate(&self, input: f64) -> f64 {
        self.sense * (input - self.start)
    }

    pub fn input(&self, coordinate: f64) -> f64 {
        self.start + self.sense * coordinate
    }
}
