//! The timing diagram of an output: its course over one turn, together with the wanted phases.

/// A phase in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Crank angle at which it begins (rad).
    pub from: f64,
    /// Crank angle at which it ends (rad).
    pub to: f64,
    /// The wanted motion of the output in it.
    pub word: &'static str,
    /// Whether a dwell is wanted.
    pub rests: bool,
    /// The achieved motion, in a few characters.
    pub figure: String,
    /// The least that is wanted of it: share of the stroke where it begins, as achieved, and where it ends.
    pub least: [f64; 2],
}

/// A timing diagram: shares of the stroke over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TimingDiagram {
    /// Achieved curve: crank angle (rad) and share of the stroke.
    pub curve: Vec<[f64; 2]>,
    /// The wanted curve, likewise; empty if only senses of motion are wanted.
    pub wanted: Vec<[f64; 2]>,
    /// The phases.
    pub stretches: Vec<Stretch>,
    /// A line of numbers.
    pub note: String,
}
