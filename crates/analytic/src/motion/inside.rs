//! States inside a step of DOP853, at the requested instants.
//!
//! The interpolant of DOP853 has order 7.
//! The interpolant is the sum of two terms (Hairer, Norsett, Wanner, "Solving ordinary differential equations I",
//! II.6).
//! The first term is a cubic H through the values and rates at both ends. The second term is s^2 (1 - s)^2 times a
//! cubic C.
//! The library exchanges s and 1 - s in C. The library's value at s therefore contains C at 1 - s, and has order 4.
//! The factor s^2 (1 - s)^2 has equal values at s and 1 - s. The true value is therefore H(s) + (library(1 - s) - H(1 -
//! s)).
//! A test below checks the order. The test will fail if the library corrects this error.
//! See docs/numerics/forces.md.

use std::cell::Cell;

use super::step::{Flow, Method, Step, lost, rate};
use differential_equations::interpolate::Interpolation;
use differential_equations::ode::ODE;
use linkage::error::Result;

/// Number of remembered evaluations. The last evaluations of a step are three inside the step and one at its end.
const REMEMBERED: usize = 4;

/// One evaluation: independent variable, state and rate.
type Evaluation<const N: usize> = (f64, [f64; N], [f64; N]);

/// An equation of motion that remembers its last evaluations, so that the rates at the ends of a step cost nothing.
pub(super) struct Remembering<'f, F, const N: usize> {
    flow: &'f F,
    known: [Cell<Evaluation<N>>; REMEMBERED],
    next: Cell<usize>,
}

impl<'f, F: Flow<N>, const N: usize> Remembering<'f, F, N> {
    pub(super) fn new(flow: &'f F) -> Self {
        Remembering {
            flow,
            known: [const { Cell::new((f64::NAN, [f64::NAN; N], [f64::NAN; N])) }; REMEMBERED],
            next: Cell::new(0),
        }
    }

    /// The rate at `x` and `y`. If the last evaluations contain this rate, it is not computed again.
    pub(super) fn rate(&self, x: f64, y: &[f64; N]) -> [f64; N] {
        let mut known = self.known.iter().map(Cell::get);
        let found = known.find(|(place, state, _)| *place == x && state == y);
        found.map_or_else(|| rate(self.flow, x, y), |(_, _, rate)| rate)
    }
}

impl<F: Flow<N>, const N: usize> ODE<f64, [f64; N]> for Remembering<'_, F, N> {
    fn diff(&self, x: f64, y: &[f64; N], rate: &mut [f64; N]) {
        self.flow.diff(x, y, rate);
        let at = self.next.get();
        self.known[at].set((x, *y, *rate));
        self.next.set((at + 1) % REMEMBERED);
    }
}

/// The remaining targets.
pub(super) struct Targets<'t>(&'t [f64]);

impl<'t> Targets<'t> {
    /// The targets of the ascending list `all` that lie beyond `x`.
    pub(super) fn beyond(all: &'t [f64], x: f64) -> Self {
        Targets(&all[all.partition_point(|&target| target <= x)..])
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Removes and returns the next target, if it lies before `x`.
    fn before(&mut self, x: f64) -> Option<f64> {
        let (&first, rest) = self.0.split_first().filter(|(first, _)| **first < x)?;
        self.0 = rest;
        Some(first)
    }
}

/// Visits the parts into which the targets divide the last step of the integration. Removes these targets from the
/// list.
pub(super) fn parts<const N: usize, F: Flow<N>>(
    flow: &F,
    course: &Course<N>,
    method: &mut Method<N>,
    targets: &mut Targets,
    visit: &mut dyn FnMut(&F, &Step<N>) -> Result<()>,
) -> Result<()> {
    let [mut from, to] = course.ends;
    while let Some(target) = targets.before(to.0) {
        let at = (target, course.at(method, target)?);
        visit(flow, &[from, at])?;
        from = at;
    }
    *targets = Targets::beyond(targets.0, to.0);
    visit(flow, &[from, to])
}

/// The course of a state in the last step of the integration.
pub(super) struct Course<const N: usize> {
    pub(super) ends: Step<N>,
    pub(super) rates: [[f64; N]; 2],
}

impl<const N: usize> Course<N> {
    /// The fraction of the step that lies before `x`.
    fn share(&self, x: f64) -> f64 {
        let [(from, _), (to, _)] = self.ends;
        (x - from) / (to - from)
    }

    /// The cubic through the values and rates at both ends.
    fn cubic(&self, s: f64) -> [f64; N] {
        let [(from, y0), (to, y1)] = &self.ends;
        let [f0, f1] = &self.rates;
        let (h, rest) = (to - from, 1.0 - s);
        std::array::from_fn(|k| {
            let rise = y1[k] - y0[k];
            y0[k] + s * (rise + rest * (h * f0[k] - rise + s * (2.0 * rise - h * (f0[k] + f1[k]))))
        })
    }

    /// The state at `x`.
    pub(super) fn at(&self, method: &mut Method<N>, x: f64) -> Result<[f64; N]> {
        let [(from, _), (to, _)] = self.ends;
        let mirrored = from + (to - x);
        let there = method.interpolate(mirrored).map_err(|why| lost(x, &format!("{why:?}")))?;
        let (here, cubic) = (self.cubic(self.share(x)), self.cubic(self.share(mirrored)));
        Ok(std::array::from_fn(|k| here[k] + (there[k] - cubic[k])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::step::a_step;
    use differential_equations::ode::OrdinaryNumericalMethod;
    use linkage::error::Error;
    use linkage::math::KeepNan;

    /// An oscillation in a potential that is not a parabola. The Taylor series of the solution therefore has terms of
    /// every order.
    struct Swing;

    impl ODE<f64, [f64; 2]> for Swing {
        fn diff(&self, _: f64, &[angle, speed]: &[f64; 2], rate: &mut [f64; 2]) {
            *rate = [speed, -angle.sin()];
        }
    }

    impl Flow<2> for Swing {
        fn bounds(&self) -> usize {
            0
        }
        fn margin(&self, _: usize, _: f64, _: &[f64; 2]) -> f64 {
            f64::INFINITY
        }
        fn begin(&self, _: f64, _: &[f64; 2]) {}
        fn fault(&self) -> Option<Error> {
            None
        }
    }

    /// Largest error inside one step of the length `h`. The reference values are the end states of sequences of short
    /// steps.
    fn error(h: f64) -> f64 {
        let start = [0.3, 1.1];
        let mut method = a_step(&Swing, 0.0, &start, h).unwrap();
        let ends = [(0.0, start), (method.t(), *method.y())];
        let course = Course { ends, rates: ends.map(|(x, y)| rate(&Swing, x, &y)) };
        (1..20).fold(0.0, |worst: f64, k| {
            let x = h * f64::from(k) / 20.0;
            let found = course.at(&mut method, x).unwrap();
            let exact = method_end(x, start);
            found.iter().zip(&exact).fold(worst, |worst, (a, b)| worst.larger((a - b).abs()))
        })
    }

    fn method_end(x: f64, start: [f64; 2]) -> [f64; 2] {
        // At the tested lengths, eight short steps are exact within rounding error.
        (0..8).fold(start, |y, k| {
            let h = x / 8.0;
            *a_step(&Swing, h * f64::from(k), &y, h).unwrap().y()
        })
    }

    #[test]
    fn dense_output_converges_with_order_seven() {
        let ratio = error(0.8) / error(0.4);
        // The error inside one step is proportional to the eighth power of the step's length.
        assert!(ratio > 150.0, "{ratio}");
        // If the interpolation had the library's order 4, `error(0.4)` would be 1e-5.
        assert!(error(0.4) < 1e-8, "{}", error(0.4));
    }
}
