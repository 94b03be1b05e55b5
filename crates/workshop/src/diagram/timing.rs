//! The timing diagram of an output: its course over one turn against the phases that it shall keep.

/// A phase, as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Crank angle at which it begins (rad).
    pub from: f64,
    /// Crank angle at which it ends (rad).
    pub to: f64,
    /// What the output shall do in it.
    pub word: &'static str,
    /// Whether it shall rest.
    pub rests: bool,
    /// What it does in truth, in a few letters.
    pub figure: String,
}

/// A timing diagram: shares of the stroke over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TimingDiagram {
    /// Crank angle (rad) and share of the stroke that were achieved.
    pub curve: Vec<[f64; 2]>,
    /// The same of the wanted curve; empty if only senses are wanted.
    pub wanted: Vec<[f64; 2]>,
    /// The phases.
    pub stretches: Vec<Stretch>,
    /// A line of figures.
    pub note: String,
}
