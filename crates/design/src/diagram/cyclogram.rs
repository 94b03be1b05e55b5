//! Cyclogram of a machine: the phases of all its organs over one turn of the main shaft.

use super::timing::TimingDiagram;

/// One organ: a ring of the circular diagram, and a displacement diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct CyclogramRing {
    /// Name of the organ.
    pub name: String,
    /// One line of text: the mechanism that drives the organ, and main values of this mechanism.
    pub drive: String,
    /// Phases and displacement over the shaft angle, counted from the beginning of the organ's task.
    pub diagram: TimingDiagram,
    /// Angle of the main shaft at which the task begins (rad).
    pub offset: f64,
}

/// Cyclogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Cyclogram {
    /// Title.
    pub title: String,
    /// Lines below the circular diagram.
    pub notes: Vec<String>,
    /// Organs, from the outer ring inwards.
    pub rings: Vec<CyclogramRing>,
    /// Operations of the machine's cycle, such as "clearing": the name, and the angles of the main shaft at the
    /// beginning and at the end (rad; the end is the larger angle).
    pub moments: Vec<(String, [f64; 2])>,
}
