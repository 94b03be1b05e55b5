//! Curves and charts with their names.

use super::names::{CommonName, CurveName};
use crate::sentences;
use drawing::plot::PlotAxis;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;

/// A curve with its names.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    /// Name of the quantity.
    pub(super) name: CurveName,
    /// Word that distinguishes curves of the same quantity: a solver, `formula` or `mechanism`; empty if not needed.
    pub(super) who: String,
    /// Name of the scenario, if several scenarios are drawn.
    pub(super) file: Option<String>,
    /// Name that the user gave to the curve; `None` for the usual name.
    pub(super) title: Option<String>,
    /// Names of both columns in a table.
    pub(super) x_key: String,
    pub(super) y_key: String,
    /// Values of the horizontal and of the vertical axis, in the order of time.
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Size of the rounding errors of the values.
    pub(super) noise: f64,
    /// A full turn in the unit of the values, if they are angles.
    pub(super) turn: Option<f64>,
    pub(super) marks: Vec<([f64; 2], String)>,
}

/// A chart: curves over one horizontal axis.
pub(super) struct Panel {
    pub(super) x: PlotAxis,
    pub(super) curves: Vec<Curve>,
    pub(super) equal: bool,
}

impl Panel {
    /// Adds the curves of another scenario.
    pub(super) fn join(&mut self, other: Panel) -> Result<()> {
        if self.x.unit != other.x.unit || self.equal != other.equal {
            let message =
                sentences::the_horizontal_axes_differ(&self.x.name, &self.x.unit, &other.x.name, &other.x.unit);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::DRAW_OVER_TIME_OR_EACH_ALONE));
        }
        if self.x.name != other.x.name {
            self.x.name = format!("{}, {}", self.x.name, other.x.name);
        }
        self.curves.extend(other.curves);
        Ok(())
    }
}

impl Curve {
    /// The name in a legend, without the words that the axis already has.
    pub(super) fn shown(&self, common: &CommonName, several: bool) -> String {
        let rest = common.rest(&self.name);
        let file = self.file.iter().filter(|_| several).map(String::as_str);
        let parts: Vec<&str> =
            [rest.as_str(), self.who.as_str()].into_iter().chain(file).filter(|part| !part.is_empty()).collect();
        if parts.is_empty() { self.name.full() } else { parts.join(", ") }
    }

    /// The name of the curve's column in a table.
    pub(super) fn key(&self) -> String {
        let parts = [self.y_key.as_str(), self.who.as_str()].into_iter().chain(self.file.as_deref());
        let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
        self.title.clone().unwrap_or_else(|| parts.join(", "))
    }
}

/// Name and unit of an input, and its column's name.
pub(super) fn input_axis(input: Input) -> (PlotAxis, String) {
    let (unit, key) = input.shown_in();
    let degrees = input != Input::Slide;
    (PlotAxis { name: input.noun().into(), unit: unit.into(), degrees, rounded: false }, key.into())
}

/// The time axis, and its column's name.
pub(super) fn time_axis() -> (PlotAxis, String) {
    (PlotAxis { name: "time".into(), unit: "s".into(), ..PlotAxis::default() }, "t_s".into())
}

/// A curve without the names of its solver or engine and of its scenario.
pub(super) fn curve(name: CurveName, [x_key, y_key]: [&str; 2], [x, y]: [Vec<f64>; 2], noise: f64) -> Curve {
    let (who, file, title, marks) = (String::new(), None, None, Vec::new());
    Curve { name, who, file, title, x_key: x_key.into(), y_key: y_key.into(), x, y, noise, turn: None, marks }
}
