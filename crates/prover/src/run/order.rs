//! Finds an engine that converges with a lower order than its method has.
//!
//! Typical causes are a value computed half a step late, or a wrong weight.
//! The bound comes from the engine's runs and covers the error at every size of the step, even if the order is too low.
//! The size of the error therefore never reveals the fault. Five runs give three estimates of the order. The order is
//! reliable only if all three estimates are near the same whole number.
//! See docs/numerics/bounds.md.

use crate::sentences;
use linkage::engine::Settings;
use linkage::error::ErrorKind;
use linkage::math::KeepNan;
use linkage::trajectory::Stage;

use super::engine_proof::{ChannelProof, EngineProof};
use super::judge::Judge;
use super::observe::Stopped;
use super::runs::{Bank, FEWER, other_sweeps};
use crate::bounds::{Convergence, Verdict};
use crate::numbers::error;
use crate::tolerance::Parts;

/// An observed order is examined further if it is below this fraction of the formal order.
const LOW: f64 = 0.75;
/// Orders are steady if they differ from the same whole number by at most this amount.
const STEADY: f64 = 0.1;
/// The observed order counts as the order of the step error only if the step error of the finest run exceeds this
/// multiple of each other error: rounding, iteration and reference.
const CLEAR: f64 = 5.0;
/// A low order does not matter if the bound is below this fraction of the widest conclusive bound.
const NEGLIGIBLE: f64 = 0.01;

/// Finds channels that converge steadily with too low an order, and sets the verdict of each to [`Verdict::Disagree`].
/// Returns whether there are channels that converge with too low an order.
///
/// # Errors
/// The errors of a run. Numeric errors are not returned, because they show nothing about the order.
pub(super) fn look(judge: &Judge, bank: &mut Bank, proof: &mut EngineProof) -> Result<bool, Stopped> {
    let wanted = judge.problem.engine_rel;
    // Across a knot of a law of motion or of a cam the third derivative jumps, so second differences have order 1 at
    // the knot. The order of accelerations and forces is then not examined.
    let has_cam = bank.case.mechanism.transmissions().iter().any(|own| own.cam.is_some());
    let is_smooth = bank.case.is_steady() && !has_cam;
    let is_low = |own: &ChannelProof| {
        let Convergence { observed, formal, .. } = own.convergence;
        let has_order = is_smooth || own.residual.channel.kind.stage < Stage::Accelerations;
        has_order && observed > 0.0 && observed < LOW * formal && own.bound > NEGLIGIBLE * wanted * own.residual.scale
    };
    if !proof.channels.iter().any(is_low) {
        return Ok(false);
    }
    let found = proof.info.settings;
    let finest = found.resolution * 0.5f64.powi(found.extrapolated as i32);
    let mut rung = |times: f64, asks_sweeps: bool| {
        let plain = Settings { resolution: times * finest, extrapolated: 0, ..found };
        let own = bank.engine(plain);
        let mut others = other_sweeps(bank.case, own.as_ref(), plain.sweeps, FEWER);
        others.truncate(usize::from(asks_sweeps));
        match bank.runs(plain, &others, &mut |_| {}).and_then(|runs| Ok(judge.judge(own.as_ref(), runs)?)) {
            Ok(own) => Ok(Some(own.proof)),
            // A run that is too coarse shows nothing about the order.
            Err(stopped) if stopped.error.kind() == ErrorKind::Numeric => Ok(None),
            Err(stopped) => Err(stopped),
        }
    };
    let mut rungs = Vec::new();
    for times in [4.0, 2.0, 1.0] {
        let Some(own) = rung(times, false)? else { return Ok(false) };
        rungs.push(own);
    }
    // An estimate of the iteration error requires one more run, which takes half as long as the longest run.
    // This run is made only if a channel converges steadily with too low an order, which is rare.
    let may_be = |index: usize| {
        is_low(&proof.channels[index]) && is_steady([0, 1, 2].map(|k| rungs[k].channels[index].convergence))
    };
    if !(0..proof.channels.len()).any(may_be) {
        return Ok(false);
    }
    let Some(fine) = rung(1.0, true)? else { return Ok(false) };
    let [coarse, middle, fine] = [&rungs[0], &rungs[1], &fine];
    let mut is_found = false;
    for index in 0..proof.channels.len() {
        if is_low(&proof.channels[index]) {
            let rungs = [coarse, middle, fine].map(|rung| &rung.channels[index]);
            let (convergences, parts) = (rungs.map(|own| own.convergence), rungs[2].parts);
            if let Some(order) = steady(convergences, parts) {
                let steps = [8.0, 0.5].map(|times| times * finest);
                let place = sentences::the_runs_converge_with_order(
                    &order,
                    &error(steps[0]),
                    &error(steps[1]),
                    &convergences[2].formal,
                );
                proof.channels[index].verdict = Verdict::Disagree { place };
                is_found = true;
            }
        }
    }
    proof.conclude();
    Ok(is_found)
}

/// Whether three estimates of the order are near the same whole number, and this number is too low. The last estimate
/// belongs to the finest step.
fn is_steady(rungs: [Convergence; 3]) -> bool {
    let Convergence { observed, formal, .. } = rungs[2];
    let whole = observed.round();
    let is_same = rungs.iter().all(|own| (own.observed - whole).abs() <= STEADY);
    is_same && whole >= 1.0 && whole <= LOW * formal
}

/// The order from three estimates. The last estimate belongs to the finest step. `None` if the order is not steady, or
/// if other parts of the finest run's error may have caused this order.
fn steady(rungs: [Convergence; 3], finest: Parts) -> Option<f64> {
    let other = finest.iteration.larger(finest.rounding).larger(finest.reference);
    let is_clear = rungs[2].error > CLEAR * other;
    (is_steady(rungs) && is_clear).then_some(rungs[2].observed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error begins at 8 and is halved with each halving of the step. The observed order is therefore 1, but the
    /// method has order 2.
    /// If an error from sweeps, rounding or the reference is a fourth of the finest run's error, it may have caused the
    /// observed order.
    #[test]
    fn an_order_counts_only_if_other_errors_are_much_smaller() {
        let rungs = |orders: [f64; 3], formal: f64| {
            let error = |k: usize| 8.0 * 0.5f64.powi(k as i32);
            [0, 1, 2].map(|k| Convergence {
                observed: orders[k],
                formal,
                error: error(k),
                safety: 1.25,
                iteration: 0.0,
            })
        };
        let first = rungs([1.02, 0.98, 1.01], 2.0);
        let none = Parts::default();
        for (size, found) in [(0.0, Some(1.01)), (0.1, Some(1.01)), (0.5, None), (5.0, None)] {
            for other in
                [Parts { iteration: size, ..none }, Parts { rounding: size, ..none }, Parts { reference: size, ..none }]
            {
                assert_eq!(steady(first, other), found, "{other:?}");
            }
        }
        // In the following cases no fault is reported: changing orders, an order of zero, and the formal order of the
        // method.
        for (orders, formal) in [([1.3, 1.1, 1.0], 2.0), ([0.0; 3], 2.0), ([2.0; 3], 2.0), ([1.0; 3], 1.0)] {
            assert_eq!(steady(rungs(orders, formal), none), None, "{orders:?} {formal}");
        }
    }
}
