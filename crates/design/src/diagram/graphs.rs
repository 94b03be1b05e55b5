//! Graphs of quantities over one period of the crank angle, independent of the method that computed them.

use linkage::math::statistics::ends;

/// Marked point of a graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraphPoint {
    /// Crank angle (rad, modulo the period) and value.
    pub at: [f64; 2],
    /// Meaning of the mark, for example "greatest".
    pub word: &'static str,
}

/// One quantity over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct CrankGraph {
    /// Name.
    pub name: &'static str,
    /// Symbol, with `_` before a subscript.
    pub symbol: &'static str,
    /// Unit, with `^` before a power.
    pub unit: &'static str,
    /// Crank angles (rad) over the period, in the direction of motion, and values.
    pub points: Vec<[f64; 2]>,
    /// Mean.
    pub mean: f64,
    /// Name of the mean: "mean" or "mean over time".
    pub mean_word: &'static str,
    /// Points with the lowest and the highest value.
    pub marks: [GraphPoint; 2],
    /// Reference value (SI) for the range of the graph.
    /// If the range is below a billionth of this value, the range is rounding error, and the quantity counts as
    /// constant.
    pub size: f64,
}

impl CrankGraph {
    /// Lowest and highest value.
    pub fn range(&self) -> [f64; 2] {
        let values = self.points.iter().map(|point| point[1]).chain(self.marks.iter().map(|mark| mark.at[1]));
        ends(values)
    }

    /// Whether the quantity is constant over the period up to rounding error.
    pub fn is_constant(&self) -> bool {
        let [low, high] = self.range();
        high - low <= 1e-9 * self.size.abs()
    }
}

/// Graphs over the same period, arranged vertically.
#[derive(Clone, Debug, PartialEq)]
pub struct Graphs {
    /// Crank angles at the start and the end of the period (rad), in the direction of motion.
    pub period: [f64; 2],
    /// Graphs, from the top.
    pub graphs: Vec<CrankGraph>,
    /// Lines below the title.
    pub notes: Vec<String>,
}
