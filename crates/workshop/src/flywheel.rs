//! Flywheel for a wanted coefficient of non-uniformity.

use analytic::reduced::Model;
use analytic::steady::Regime;
use linkage::error::{Error, ErrorKind, Result};

/// A flywheel on the crank's shaft, and the motion with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Flywheel {
    /// Moment of inertia (kg m^2); 0 if none is needed.
    pub inertia: f64,
    /// The steady motion with it.
    pub regime: Regime,
}

/// Doublings of the first guess before a wish counts as out of reach.
const DOUBLINGS: usize = 60;
/// Regula falsi steps; it takes about eight.
const STEPS: usize = 80;
/// Relative deviation of the coefficient that is good enough.
const CLOSE: f64 = 1e-12;

impl Flywheel {
    /// The flywheel with which the steady motion's coefficient of non-uniformity is `wanted`, or none where it is less already, by regula falsi (Illinois) over
    /// true regimes.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a coefficient that is not positive, [`ErrorKind::Numeric`] for one that no flywheel reaches, and those of
    /// [`Model::regime`].
    pub fn of(model: &Model, wanted: f64, accuracy: f64) -> Result<Self> {
        if !(wanted > 0.0 && wanted.is_finite()) {
            let message = format!("a coefficient of non-uniformity of {wanted} is asked for");
            return Err(Error::new(ErrorKind::Input, message).help("give a number above zero, such as 0.02"));
        }
        let with = |inertia: f64| -> Result<(f64, Regime)> {
            let regime = model.with_flywheel(inertia).regime(&[], accuracy)?;
            // The inverse is nearly linear in the flywheel: delta J is about the largest surplus of work over omega^2.
            Ok((1.0 / regime.non_uniformity() - 1.0 / wanted, regime))
        };
        let (mut low, (mut below, regime)) = (0.0, with(0.0)?);
        if below >= 0.0 {
            return Ok(Flywheel { inertia: 0.0, regime });
        }
        let mut high = model.inertia_at_start()?.max(f64::MIN_POSITIVE);
        let mut above = with(high)?.0;
        let mut doublings = 0;
        while above < 0.0 {
            (low, below) = (high, above);
            high *= 2.0;
            above = with(high)?.0;
            doublings += 1;
            if doublings > DOUBLINGS {
                let message = format!("no flywheel makes the coefficient of non-uniformity {wanted}");
                return Err(Error::new(ErrorKind::Numeric, message).help("ask for a larger coefficient"));
            }
        }
        let mut side = 0i32;
        for _ in 0..STEPS {
            let middle = high - above * (high - low) / (above - below);
            let (value, regime) = with(middle)?;
            if (value * wanted).abs() <= CLOSE || high - low <= 4.0 * f64::EPSILON * high {
                return Ok(Flywheel { inertia: middle, regime });
            }
            let was = std::mem::replace(&mut side, if value >= 0.0 { 1 } else { -1 });
            if value >= 0.0 {
                (high, above) = (middle, value);
                below = if was > 0 { below / 2.0 } else { below };
            } else {
                (low, below) = (middle, value);
                above = if was < 0 { above / 2.0 } else { above };
            }
        }
        let message =
            format!("the flywheel for a coefficient of non-uniformity of {wanted} was not found in {STEPS} steps");
        Err(Error::new(ErrorKind::Numeric, message).help("ask for a larger coefficient"))
    }
}
