//! Flywheel for a required coefficient of non-uniformity.

use crate::sentences;
use analytic::reduced::ReducedModel;
use analytic::steady::Regime;
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;
use linkage::math::root::{self, Close};

/// A flywheel on the crank's shaft, and the motion with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Flywheel {
    /// Moment of inertia (kg m^2); 0 if no flywheel is needed.
    pub inertia: f64,
    /// The steady motion with this flywheel.
    pub regime: Regime,
}

/// Largest inertia of a flywheel, divided by the first guess of the inertia: sixty doublings.
/// If a larger flywheel would be needed, the required coefficient of non-uniformity counts as unreachable.
const LARGEST: f64 = (1u64 << 60) as f64;
/// Upper limit of the number of regula falsi steps. About eight steps are needed.
const STEPS: usize = 80;
/// Accepted relative deviation of the coefficient of non-uniformity.
const CLOSE: f64 = 1e-12;

impl Flywheel {
    /// The flywheel with which the steady motion has the coefficient of non-uniformity `wanted`.
    /// If the coefficient is at most `wanted` without a flywheel, the inertia is 0.
    /// Regula falsi (Illinois) finds the inertia. Each step solves for the exact steady motion.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a coefficient that is not positive.
    /// [`ErrorKind::Numeric`] for a coefficient that no flywheel reaches, or if the search does not converge.
    /// The errors of [`ReducedModel::regime`].
    pub fn of(model: &ReducedModel, wanted: f64, accuracy: f64) -> Result<Self> {
        if !(wanted > 0.0 && wanted.is_finite()) {
            let message = sentences::a_coefficient_of_non_uniformity(&wanted);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_A_NUMBER_ABOVE_ZERO));
        }
        let mut last = Flywheel { inertia: 0.0, regime: model.with_flywheel(0.0).regime(&[], accuracy)? };
        // The coefficient of non-uniformity times the inertia is about the largest surplus of work divided by omega^2.
        // The inverse of the coefficient is therefore nearly linear in the flywheel's inertia.
        // The search compares the inverses of the actual and the required coefficient.
        let excess = |regime: &Regime| 1.0 / regime.non_uniformity() - 1.0 / wanted;
        let none = (0.0, excess(&last.regime));
        if none.1 >= 0.0 {
            return Ok(last);
        }
        let mut with = |inertia: f64| -> Result<f64> {
            last = Flywheel { inertia, regime: model.with_flywheel(inertia).regime(&[], accuracy)? };
            Ok(excess(&last.regime))
        };
        let guess = model.inertia_at_start()?.larger(f64::MIN_POSITIVE);
        let Some(ends) = root::widened(none, guess, guess * LARGEST, &mut with)? else {
            let message = sentences::no_flywheel_makes_the_coefficient(&wanted);
            return Err(Error::new(ErrorKind::Numeric, message).help(sentences::ASK_FOR_A_LARGER_COEFFICIENT));
        };
        let close = Close { value: CLOSE / wanted, width: 0.0 };
        if root::regula_falsi(ends, close, STEPS, with)?.is_some() {
            return Ok(last);
        }
        let message = sentences::the_flywheel_for_a_coefficient(&wanted, &STEPS);
        Err(Error::new(ErrorKind::Numeric, message).help(sentences::ASK_FOR_A_LARGER_COEFFICIENT))
    }
}
