//! The tiny steps of a probe.

/// A tiny step of a probe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TinyStep {
    /// Duration h of the step (s).
    pub step: f64,
    /// Weight of the reading of this step in the result.
    pub share: f64,
}

/// The two tiny steps of a probe: h, and h / 2.
/// Each reading y(h) has an error of first order in h, so the result is 2 y(h / 2) - y(h) (Richardson's extrapolation).
pub fn tiny_steps(step: f64) -> [TinyStep; 2] {
    [TinyStep { step, share: -1.0 }, TinyStep { step: 0.5 * step, share: 2.0 }]
}
