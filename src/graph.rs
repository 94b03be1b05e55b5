//! Graphs of the results of solvers and engines, for print: choice, names, units and numbers of the curves.

mod ask;
mod curve;
mod curves;
mod marks;
mod names;
mod source;
mod table;
mod under_motor;

use crate::sentences;
use analytic::range::explained;
use curve::{Curve, Panel};
use drawing::paper::document::Drawing;
use drawing::plot::{PlotAxis, PlotChart, PlotCurve, sheet};
use linkage::error::{Error, ErrorKind, Result};

pub(crate) use ask::{Question, Words};
pub(crate) use source::Source;
pub(crate) use table::rows;

/// Usual size of a chart over an input, time or an expression, and of a hodograph (mm).
const SIZE: [f64; 2] = [160.0, 70.0];
const SQUARE: [f64; 2] = [110.0, 105.0];

/// Titles, names and size of graphs, as the user requests them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Look {
    /// Title above all charts.
    pub(crate) title: String,
    /// Name of all horizontal axes, including the unit; `None` for the name of the quantity.
    pub(crate) x_label: Option<String>,
    /// Names of the vertical axes, including the units, in the order of the charts. Further axes have the usual names.
    pub(crate) y_labels: Vec<String>,
    /// Names of all curves, in the order of the curves; empty for the usual names.
    pub(crate) legend: Vec<String>,
    /// Size of each chart (mm); `None` for the usual size.
    pub(crate) size: Option<[f64; 2]>,
    /// Whether the difference is drawn: the second minus the first result, each of a solver or an engine.
    pub(crate) difference: bool,
}

/// Graphs with their numbers and remarks.
pub(crate) struct Graphs {
    /// The sheet.
    pub(crate) drawing: Drawing,
    /// The drawn curves with their names.
    pub(crate) curves: Vec<Curve>,
    /// Remarks for the user about curves that are left out.
    pub(crate) notes: Vec<String>,
}

/// Draws the requested charts of all sources, below each other.
///
/// # Errors
/// [`ErrorKind::Input`] if the number of names differs from the number of curves, or if sources have horizontal axes of
/// different kinds.
/// The errors of the solvers.
pub(crate) fn graphs(sources: &[Source], look: &Look) -> Result<Graphs> {
    let (mut panels, mut notes): (Vec<Panel>, Vec<String>) = (Vec::new(), Vec::new());
    let charts = sources.iter().map(|source| source.question.charts.len()).max().unwrap_or(0);
    for chart in 0..charts {
        let mut joined: Vec<Panel> = Vec::new();
        for source in sources {
            let own = curves::panels(source, chart, look.difference, &mut notes);
            let own = own.map_err(|error| explained(&source.case, error))?;
            match joined.is_empty() {
                true => joined = own,
                false => joined.iter_mut().zip(own).try_for_each(|(panel, other)| panel.join(other))?,
            }
        }
        panels.extend(joined);
    }
    let several = sources.len() > 1;
    let is_finite = |curve: &Curve| curve.x.iter().zip(&curve.y).any(|(x, y)| x.is_finite() && y.is_finite());
    if let Some(empty) = panels.iter().find(|panel| !panel.curves.iter().any(is_finite)) {
        let name = empty.curves.first().map_or_else(String::new, Curve::key);
        let error = Error::new(ErrorKind::Input, sentences::has_no_value_at_any_instant(&name));
        return Err(error.help(sentences::CHOOSE_A_CURVE_WITH_VALUES));
    }
    if look.y_labels.len() > panels.len() {
        let message = sentences::y_labels_are_given_for_charts(&look.y_labels.len(), &panels.len());
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_LABEL_FOR_EACH_CHART));
    }
    let count: usize = panels.iter().map(|panel| panel.curves.len()).sum();
    if !look.legend.is_empty() && look.legend.len() != count {
        let message = sentences::names_are_given_for_curves(&look.legend.len(), &count);
        return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_NAME_FOR_EACH_CURVE));
    }
    let mut given = look.legend.iter();
    for curve in panels.iter_mut().flat_map(|panel| &mut panel.curves) {
        curve.title = given.next().cloned();
    }
    let plots: Vec<PlotChart> =
        panels.iter().enumerate().map(|(index, panel)| plot(panel, look, look.y_labels.get(index), several)).collect();
    let (figure, size) = sheet(&look.title, &plots)?;
    let names: Vec<&str> = sources.iter().map(|source| source.scenario.name.as_str()).collect();
    let title = if look.title.is_empty() { names.join(", ") } else { look.title.clone() };
    let mut curves: Vec<Curve> = panels.into_iter().flat_map(|panel| panel.curves).collect();
    if !several {
        curves.iter_mut().for_each(|curve| curve.file = None);
    }
    Ok(Graphs { drawing: Drawing { figure, size, title }, curves, notes })
}

/// A chart in the form that the crate `drawing` draws.
fn plot(panel: &Panel, look: &Look, y_label: Option<&String>, several: bool) -> PlotChart {
    let custom = |label: &String| PlotAxis { name: label.clone(), ..PlotAxis::default() };
    let common = names::common(panel.curves.iter().map(|curve| &curve.name));
    let x = match &look.x_label {
        Some(label) => custom(label),
        None => panel.x.clone(),
    };
    let y = match y_label {
        Some(label) => custom(label),
        None => PlotAxis { name: common.axis.clone(), unit: common.unit.clone(), ..PlotAxis::default() },
    };
    let y_degrees = common.unit == "deg" && !panel.equal;
    let curve = |own: &Curve| PlotCurve {
        name: own.title.clone().unwrap_or_else(|| own.shown(&common, several)),
        points: own.x.iter().zip(&own.y).map(|(x, y)| [*x, *y]).collect(),
        noise: own.noise,
        marks: own.marks.clone(),
        directed: panel.equal,
    };
    PlotChart {
        axes: [PlotAxis { degrees: panel.x.degrees, ..x }, PlotAxis { degrees: y_degrees, rounded: true, ..y }],
        curves: panel.curves.iter().map(curve).collect(),
        equal: panel.equal,
        legend: panel.curves.len() > 1 || !look.legend.is_empty(),
        size: look.size.unwrap_or(if panel.equal { SQUARE } else { SIZE }),
    }
}
