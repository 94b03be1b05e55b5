//! One piece of an equation of motion, and one step of DOP853 on it.

use crate::sentences;
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use linkage::error::{Error, ErrorKind, Result};

/// DOP853 on a state of `N` numbers.
pub(crate) type Method<const N: usize> = ExplicitRungeKutta<Ordinary, DormandPrince, f64, [f64; N], 8, 12, 16>;

/// An equation of motion on one piece.
pub(crate) trait Flow<const N: usize>: ODE<f64, [f64; N]> {
    /// Number of bounds of the piece.
    fn bounds(&self) -> usize;

    /// Distance of the state from a bound, positive inside the piece and negative beyond the bound.
    fn margin(&self, bound: usize, x: f64, y: &[f64; N]) -> f64;

    /// Is called at the beginning of every step.
    fn begin(&self, x: f64, y: &[f64; N]);

    /// The error of an evaluation since the last call; `None` if all evaluations succeeded.
    fn fault(&self) -> Option<Error>;
}

/// One step: its beginning and its end.
pub(crate) type Step<const N: usize> = [(f64, [f64; N]); 2];

/// The derivative dy / dx at the state `y`.
pub(super) fn rate<const N: usize, F: Flow<N>>(flow: &F, x: f64, y: &[f64; N]) -> [f64; N] {
    let mut rate = [0.0; N];
    flow.diff(x, y, &mut rate);
    rate
}

/// State after one step of the length `h`.
pub(crate) fn one_step<const N: usize, F: Flow<N>>(flow: &F, x: f64, y: &[f64; N], h: f64) -> Result<[f64; N]> {
    Ok(*a_step(flow, x, y, h)?.y())
}

/// The integrator object after one DOP853 step of the length `h`. The error estimate is ignored, because the step is
/// part of an accepted step.
pub(super) fn a_step<const N: usize, F: Flow<N>>(flow: &F, x: f64, y: &[f64; N], h: f64) -> Result<Method<N>> {
    flow.begin(x, y);
    let mut method: Method<N> = ExplicitRungeKutta::dop853().rtol(1e6).atol(1e6).h0(h);
    // The interval is longer than the step, so that rounding of the interval's end does not shorten the step.
    let begun = method.init(flow, x, x + 2.0 * h, y);
    checked(flow, begun, x)?;
    let taken = method.step(flow);
    checked(flow, taken, x)?;
    if matches!(method.status(), Status::RejectedStep) {
        return Err(lost(x, sentences::A_STEP_ONTO_A_KINK_WAS_REFUSED));
    }
    Ok(method)
}

/// Reports an error of the equation of motion in preference to an error of the library. An error in a trial step that
/// was then repeated does not count.
pub(super) fn checked<const N: usize, F: Flow<N>, T, E: std::fmt::Debug>(
    flow: &F,
    answer: std::result::Result<T, E>,
    x: f64,
) -> Result<()> {
    let fault = flow.fault();
    answer.map(|_| ()).map_err(|why| fault.unwrap_or_else(|| lost(x, &format!("{why:?}"))))
}

/// The error of a motion that cannot be followed beyond `x`.
pub(super) fn lost(x: f64, why: &str) -> Error {
    Error::new(ErrorKind::Numeric, sentences::the_equation_of_motion_cannot(&x, &why))
        .help(sentences::WHERE_MASSES_NEARLY_VANISH_AT_A_CRANK)
}
