//! Timing diagram of an output: the output's course over one turn, with the required phases.

/// Phase in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Crank angle at the start of the phase (rad).
    pub from: f64,
    /// Crank angle at the end of the phase (rad).
    pub to: f64,
    /// Required motion of the output.
    pub word: &'static str,
    /// Whether a dwell is required.
    pub rests: bool,
    /// Achieved motion, in a few characters.
    pub figure: String,
    /// Smallest required travel, drawn as a line.
    /// The line begins at the achieved fraction of the stroke and ends at the required fraction.
    pub least: [f64; 2],
}

/// Timing diagram: the output as a fraction of the stroke over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TimingDiagram {
    /// Achieved curve: crank angle (rad) and fraction of the stroke.
    pub curve: Vec<[f64; 2]>,
    /// Required curve: crank angle (rad) and fraction of the stroke.
    /// The curve is empty if only senses of motion are required.
    pub wanted: Vec<[f64; 2]>,
    /// Phases.
    pub stretches: Vec<Stretch>,
    /// Main values of the motion, separated by `; `.
    pub note: String,
}
