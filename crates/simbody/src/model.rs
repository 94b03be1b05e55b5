//! The description of a linkage, which is checked before any part reaches C++.

use crate::ffi::{Act, LinkageRun, RawBody};
use crate::parts::{Failure, Inertia, IntegrationSettings, LoopClosure, SimbodyBody, SimbodyJoint};
use crate::sentences;

/// A planar linkage.
#[derive(Clone, Debug)]
pub struct SimbodyModel {
    gravity: [f64; 2],
    bodies: Vec<RawBody>,
    loops: Vec<LoopClosure>,
}

impl SimbodyModel {
    /// A model that contains only the ground, with the acceleration of gravity `gravity` (m/s^2).
    pub fn new(gravity: [f64; 2]) -> Self {
        SimbodyModel { gravity, bodies: Vec::new(), loops: Vec::new() }
    }

    /// Adds a body and returns its number.
    ///
    /// # Errors
    /// A parent that does not exist, a number that is not finite, a negative mass or inertia, or an axis that is not a
    /// unit vector.
    pub fn add(&mut self, body: SimbodyBody) -> Result<usize, Failure> {
        let number = self.bodies.len() + 1;
        let wrong = |what: &str| Err(Failure::of(format!("body {number}: {what}")));
        if body.parent >= number {
            return wrong(&sentences::its_parent_is_which_has_not_been(&body.parent));
        }
        let raw = RawBody::of(&body);
        if !raw.numbers().all(f64::is_finite) {
            return wrong(sentences::IT_HOLDS_A_NUMBER_THAT_IS_NOT_FINITE);
        }
        let Inertia { mass, inertia, extra_mass, extra_inertia, .. } = body.inertia;
        if [mass, inertia, extra_mass, extra_inertia].iter().any(|&value| value < 0.0) {
            return wrong(sentences::A_MASS_OR_A_MOMENT_OF_INERTIA);
        }
        if let SimbodyJoint::Slider { axis_parent, axis_child, .. } = body.joint
            && [axis_parent, axis_child].iter().any(|axis| (axis[0].hypot(axis[1]) - 1.0).abs() > 1e-9)
        {
            return wrong(sentences::THE_AXIS_OF_ITS_SLIDER_IS_NO_UNIT);
        }
        self.bodies.push(raw);
        Ok(number)
    }

    /// Closes a loop and returns its number, counted from 0.
    ///
    /// # Errors
    /// A body that does not exist, the same body twice, or a position that is not finite.
    pub fn close(&mut self, closing: LoopClosure) -> Result<usize, Failure> {
        let number = self.loops.len();
        let wrong = |what: &str| Err(Failure::of(format!("loop {number}: {what}")));
        let [first, second] = closing.bodies;
        if first.max(second) > self.bodies.len() || first == second {
            return wrong(&sentences::bodies_and_cannot_be_joined(&first, &second));
        }
        if !closing.places.as_flattened().iter().all(|place| place.is_finite()) {
            return wrong(sentences::IT_HOLDS_A_NUMBER_THAT_IS_NOT_FINITE);
        }
        self.loops.push(closing);
        Ok(number)
    }

    /// Assembles the linkage at time 0 and starts the run of the linkage.
    ///
    /// # Errors
    /// Settings out of their ranges, and errors of Simbody.
    /// Simbody fails, for example, if the model cannot be assembled from the given coordinates, or if a free mobilizer
    /// carries no inertia.
    pub fn run(&self, settings: IntegrationSettings) -> Result<LinkageRun, Failure> {
        self.run_under(settings, None)
    }

    /// Like [`SimbodyModel::run`], but with the forces and moments that `act` computes for the bodies.
    ///
    /// # Errors
    /// The errors of [`SimbodyModel::run`].
    pub fn run_under(&self, settings: IntegrationSettings, act: Option<Act>) -> Result<LinkageRun, Failure> {
        let IntegrationSettings { accuracy, tolerance, time_scale, .. } = settings;
        if !(accuracy > 0.0 && accuracy < 1.0) {
            return Err(Failure::of(sentences::the_accuracy_is_it_must_lie(&accuracy)));
        }
        for (what, value) in [("tolerance", tolerance), ("time scale", time_scale)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Failure::of(sentences::the_is_it_must_be_greater(&what, &value)));
            }
        }
        if !self.gravity.iter().all(|component| component.is_finite()) {
            return Err(Failure::of(sentences::GRAVITY_IS_NOT_FINITE));
        }
        if self.bodies.is_empty() {
            return Err(Failure::of(sentences::THERE_IS_NO_BODY));
        }
        LinkageRun::start(&self.bodies, &self.loops, self.gravity, settings, act)
    }
}
