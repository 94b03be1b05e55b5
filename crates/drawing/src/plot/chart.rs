//! Charts to be drawn: axes, curves, and the sizes of their letters.

/// Colour of grid lines.
pub(super) const GRID: &str = "#d0d0d0";
/// Font sizes (mm) of names of axes and curves, and of numbers.
pub(super) const NAME: f64 = 3.5;
pub(super) const NUMBER: f64 = 3.1;
/// Distance of two lines of text divided by the font size.
pub(super) const LINE: f64 = 1.35;

/// An axis of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotAxis {
    /// Name of the quantity along the axis.
    pub name: String,
    /// Unit as printed, such as `N·m`; empty for a number without unit.
    pub unit: String,
    /// Whether the values are angles in degrees.
    /// The ticks of angles have usual steps, such as 30 or 45 degrees. The steps of long ranges are multiples of a
    /// turn, and the steps of very short ranges are round numbers.
    pub degrees: bool,
    /// Whether the axis ends at round numbers. If not, the axis ends at the extreme values of the curves.
    pub rounded: bool,
}

/// A curve of a chart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotCurve {
    /// Name in the legend.
    pub name: String,
    /// Pairs of values in the order of drawing. The curve has a gap at a pair that is not finite.
    pub points: Vec<[f64; 2]>,
    /// Largest rounding error of the ordinates.
    /// If the ordinates of a chart differ by at most twice the largest of these errors, the range of the vertical axis
    /// is widened, so that the curves look constant.
    pub noise: f64,
    /// Marked points with their labels.
    pub marks: Vec<([f64; 2], String)>,
    /// Whether arrows show the direction in which the points follow each other.
    pub directed: bool,
}

/// A chart: curves over common axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotChart {
    /// Horizontal and vertical axis.
    pub axes: [PlotAxis; 2],
    /// The curves.
    pub curves: Vec<PlotCurve>,
    /// Whether one unit has the same length on both axes. Both axes then include zero.
    pub equal: bool,
    /// Whether a legend above the chart names the curves.
    pub legend: bool,
    /// Size of the chart with its axes (mm).
    pub size: [f64; 2],
}
