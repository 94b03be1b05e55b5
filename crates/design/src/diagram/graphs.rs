//! Graphs of quantities over one period of the crank angle, independent of the method that computed them.

use linkage::math::statistics::ends;

/// A marked point of a graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraphPoint {
    /// Crank angle (rad; any of those a period apart) and value.
    pub at: [f64; 2],
    /// Its meaning, such as "greatest".
    pub word: &'static str,
}

/// One quantity over the crank angle.
#[derive(Clone, Debug, PartialEq)]
pub struct CrankGraph {
    /// Its name.
    pub name: &'static str,
    /// Its symbol, with `_` before a subscript.
    pub symbol: &'static str,
    /// Its unit, with `^` before a power.
    pub unit: &'static str,
    /// Crank angles (rad) over the period, in the sense of motion, and values.
    pub points: Vec<[f64; 2]>,
    /// Its mean.
    pub mean: f64,
    /// Name of the mean.
    pub mean_word: &'static str,
    /// Its lowest and its highest point on paper.
    pub marks: [GraphPoint; 2],
    /// Reference size for the range of its values.
    /// Below a billionth of this size the range is rounding, and the quantity is constant.
    pub size: f64,
}

impl CrankGraph {
    /// Lowest and highest value.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let values = self.points.iter().map(|point| point[1]).chain(self.marks.iter().map(|mark| mark.at[1]));
        ends(values)
    }

    /// Whether the quantity is constant over the period, except for rounding.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        let [low, high] = self.range();
        high - low <= 1e-9 * self.size.abs()
    }
}

/// Graphs over the same period, arranged vertically.
#[derive(Clone, Debug, PartialEq)]
pub struct Graphs {
    /// Crank angle at the start of the period and at its end (rad), in the sense of motion.
    pub period: [f64; 2],
    /// The graphs, from the top.
    pub graphs: Vec<CrankGraph>,
    /// Lines below the title.
    pub notes: Vec<String>,
}
