//! Charts for print: curves over axes. The axes have names, units and round numbers.
//! The library `plotters` draws the axes.

mod backend;
mod chart;
mod panel;
mod ticks;

use crate::paper::figure::{DrawnFigure, Type, width, words};
pub use chart::{PlotAxis, PlotChart, PlotCurve};
use linkage::error::Result;
use linkage::math::{KeepNan, Vec2};

/// Margin of a sheet, and space between two charts (mm).
const MARGIN: f64 = 4.0;
const BETWEEN: f64 = 5.0;
/// Font size of the title (mm).
const TITLE: f64 = 4.4;

/// Draws charts below each other on one sheet, under a title. Returns the figure and its size (mm).
/// The upper left corner of the sheet is the figure's origin.
///
/// # Errors
/// [`ErrorKind::Input`](linkage::error::ErrorKind::Input) if `plotters` cannot draw a chart of the requested size.
pub fn sheet(title: &str, plots: &[PlotChart]) -> Result<(DrawnFigure, [f64; 2])> {
    let wide = plots.iter().map(|plot| plot.size[0]).fold(width(title, TITLE), f64::larger);
    let mut sheet = DrawnFigure::default();
    let mut top = -MARGIN;
    if !title.is_empty() {
        top -= TITLE;
        let middle = Vec2::new(MARGIN + wide / 2.0, top);
        sheet.text(middle, title, Type { bold: true, anchor: "middle", ..words(TITLE) });
        top -= TITLE;
    }
    let panels: Vec<panel::Panel> = plots.iter().map(panel::Panel::of).collect();
    let left = panels.iter().map(panel::Panel::left).fold(0.0, f64::larger);
    for (index, panel) in panels.iter().enumerate() {
        top -= if index == 0 { 0.0 } else { BETWEEN };
        sheet.add(&panel.figure(left)?, Vec2::new(MARGIN, top));
        top -= panel.height();
    }
    Ok((sheet, [(wide + 2.0 * MARGIN).ceil(), (MARGIN - top).ceil()]))
}
