//! The class `Builder`: a mechanism link by link, in SI units.

use linkage::drive::{Acts, Course};
use linkage::mechanism::{JointSide, LinkId};
use linkproof::Case;
use linkproof::parts::{AssemblyMode, CaseBuilder, Error, Load, MotionLaw};
use pyo3::prelude::*;
use scenario::words::choice;

use crate::errors::{OrRaised, argument};
use crate::scenario_class::Scenario;
use crate::sentences;
use crate::task::released;

/// Coordinates (m) of the points of a link, by their names.
type Points = Vec<(String, [f64; 2])>;

/// Builds a mechanism link by link, in SI units. Every method returns the builder.
#[pyclass(module = "linkproof")]
pub(crate) struct Builder {
    name: String,
    inner: CaseBuilder,
    /// Names of the moving links. The first name belongs to link number 1.
    links: Vec<String>,
}

impl Builder {
    pub(crate) fn new(name: String) -> Builder {
        Builder { name, inner: Case::builder(), links: Vec::new() }
    }

    fn changed(&mut self, change: impl FnOnce(CaseBuilder) -> CaseBuilder) {
        let inner = std::mem::replace(&mut self.inner, Case::builder());
        self.inner = change(inner);
    }

    fn link_named(&self, name: &str) -> Result<LinkId, Error> {
        let position = self.links.iter().position(|own| own == name).map(|index| LinkId(index + 1));
        position.ok_or_else(|| {
            let message = sentences::there_is_no_link(&name);
            argument("link", message, sentences::it_has(&choice(self.links.iter().map(String::as_str), "\"")))
        })
    }
}

/// The points in the form of the library's builder.
fn borrowed(points: &Points) -> Vec<(&str, [f64; 2])> {
    points.iter().map(|(name, at)| (name.as_str(), *at)).collect()
}

/// Points of a dictionary, in its order.
fn points(given: &Bound<'_, PyAny>) -> PyResult<Points> {
    let pair = |item: PyResult<Bound<'_, PyAny>>| -> PyResult<(String, [f64; 2])> { item?.extract() };
    given.call_method0("items")?.try_iter()?.map(pair).collect()
}

#[pymethods]
impl Builder {
    /// Set the ground and its points: names and world coordinates (m).
    #[pyo3(signature = (points, /))]
    fn ground<'py>(mut slf: PyRefMut<'py, Self>, points: &Bound<'py, PyAny>) -> PyResult<PyRefMut<'py, Self>> {
        let own = self::points(points)?;
        slf.changed(|inner| inner.ground(&borrowed(&own)));
        Ok(slf)
    }

    /// Add a moving link and its points: names and coordinates (m) in the link's frame.
    #[pyo3(signature = (name, points, /))]
    fn link<'py>(
        mut slf: PyRefMut<'py, Self>,
        name: String,
        points: &Bound<'py, PyAny>,
    ) -> PyResult<PyRefMut<'py, Self>> {
        let own = self::points(points)?;
        slf.changed(|inner| inner.link(&name, &borrowed(&own)));
        slf.links.push(name);
        Ok(slf)
    }

    /// Set a link's mass (kg), mass centre in the link's frame (m) and moment of inertia about the mass centre (kg
    /// m^2).
    #[pyo3(signature = (link, mass, centre, inertia))]
    fn mass<'py>(
        mut slf: PyRefMut<'py, Self>,
        link: &str,
        mass: f64,
        centre: [f64; 2],
        inertia: f64,
    ) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.mass(link, mass, centre, inertia));
        slf
    }

    /// Add a revolute joint between two links that both have a point called `name`.
    #[pyo3(signature = (name, first, second, /))]
    fn pin<'py>(mut slf: PyRefMut<'py, Self>, name: &str, first: &str, second: &str) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.pin(name, first, second));
        slf
    }

    /// Add a prismatic joint. `first` and `second` give a link and a point of this link. `axes` gives the angle (rad)
    /// of the joint's axis in the frame of each link.
    #[pyo3(signature = (name, first, second, axes=[0.0, 0.0]))]
    fn slider<'py>(
        mut slf: PyRefMut<'py, Self>,
        name: &str,
        first: (String, String),
        second: (String, String),
        axes: [f64; 2],
    ) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.slider(name, (&first.0, &first.1), (&second.0, &second.1), axes));
        slf
    }

    /// Drive a joint at constant speed (rad/s, counter-clockwise positive; m/s for a prismatic joint).
    /// The first driven joint is the crank.
    #[pyo3(signature = (joint, speed, /))]
    fn crank<'py>(mut slf: PyRefMut<'py, Self>, joint: &str, speed: f64) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.crank(joint, speed));
        slf
    }

    /// Drive a joint from rest to a speed (rad/s) within a time (s), at constant acceleration.
    #[pyo3(signature = (joint, speed, time, /))]
    fn ramp<'py>(mut slf: PyRefMut<'py, Self>, joint: &str, speed: f64, time: f64) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.driven(joint, MotionLaw::Ramp { speed, time }));
        slf
    }

    /// Let a joint move freely. `initial_speed` (rad/s) is its speed at t = 0. `nominal_speed` (rad/s) is its constant
    /// speed in the nominal motion. An instant given by a crank angle is an instant of the nominal motion.
    #[pyo3(signature = (joint, initial_speed, nominal_speed))]
    fn free<'py>(
        mut slf: PyRefMut<'py, Self>,
        joint: &str,
        initial_speed: f64,
        nominal_speed: f64,
    ) -> PyRefMut<'py, Self> {
        slf.changed(|inner| inner.free(joint, initial_speed, nominal_speed));
        slf
    }

    /// Set the input at t = 0: the crank angle (rad) or the slide (m) of the first driven joint.
    #[pyo3(signature = (input, /))]
    fn start(mut slf: PyRefMut<'_, Self>, input: f64) -> PyRefMut<'_, Self> {
        slf.changed(|inner| inner.start(input));
        slf
    }

    /// Set the assembly mode of the group with these links: `left`, `right`, `ahead`, `behind`, `only` or `followed`.
    #[pyo3(signature = (*links, mode))]
    fn mode<'py>(mut slf: PyRefMut<'py, Self>, links: Vec<String>, mode: &str) -> PyResult<PyRefMut<'py, Self>> {
        let Some(own) = AssemblyMode::named(mode) else {
            let help = sentences::it_has(&choice(AssemblyMode::ALL.map(AssemblyMode::name), "\""));
            return Err(argument("mode", sentences::there_is_no_such_choice(&mode), help)).or_raised(slf.py());
        };
        let links: Vec<&str> = links.iter().map(String::as_str).collect();
        slf.changed(|inner| inner.mode(&links, own));
        Ok(slf)
    }

    /// Set the acceleration of gravity (m/s^2).
    #[pyo3(signature = (x=0.0, y=-9.81))]
    fn gravity(mut slf: PyRefMut<'_, Self>, x: f64, y: f64) -> PyRefMut<'_, Self> {
        slf.changed(|inner| inner.gravity([x, y]));
        slf
    }

    /// Add a force (N, world axes) at a point (m) of a link's frame.
    #[pyo3(signature = (link, at, force))]
    fn force<'py>(
        mut slf: PyRefMut<'py, Self>,
        link: &str,
        at: [f64; 2],
        force: [f64; 2],
    ) -> PyResult<PyRefMut<'py, Self>> {
        let link = slf.link_named(link).or_raised(slf.py())?;
        let at = JointSide { link, local: at.into() };
        slf.changed(|inner| inner.load(Load::Force { at, force: force.map(Course::Constant), follows: false }));
        Ok(slf)
    }

    /// Add a moment (N m, counter-clockwise positive) on a link.
    #[pyo3(signature = (link, moment))]
    fn moment<'py>(mut slf: PyRefMut<'py, Self>, link: &str, moment: f64) -> PyResult<PyRefMut<'py, Self>> {
        let link = slf.link_named(link).or_raised(slf.py())?;
        slf.changed(|inner| inner.load(Load::Moment { link, moment: Course::Constant(moment), acts: Acts::Always }));
        Ok(slf)
    }

    /// Set the number of equal intervals into which the instants divide one turn of the crank.
    #[pyo3(signature = (intervals, /))]
    fn instants(mut slf: PyRefMut<'_, Self>, intervals: usize) -> PyRefMut<'_, Self> {
        slf.changed(|inner| inner.instants(intervals));
        slf
    }

    /// Check the mechanism and return it as a scenario.
    fn build(&self, py: Python<'_>) -> PyResult<Scenario> {
        let (name, inner) = (self.name.clone(), self.inner.clone());
        released(py, move || Ok(Scenario::of_built(linkproof::Scenario::of_case(&name, inner.build()?)?)))
    }

    fn __repr__(&self) -> String {
        sentences::a_builder_of(&self.name)
    }
}

#[pymethods]
impl Scenario {
    /// A builder, which makes a mechanism link by link.
    #[staticmethod]
    #[pyo3(signature = (name, /))]
    fn builder(name: String) -> Builder {
        Builder::new(name)
    }
}
