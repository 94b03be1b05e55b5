//! Searches for the largest step whose error is within a limit.

use super::candidate::Measured;
use linkage::math::KeepNan;

/// Largest number of runs in one search.
const MOST_RUNS: usize = 9;
/// The step is large enough if the error is at least this fraction of the requested error.
/// At order 2, a larger step would save less than an eighth of the cost.
const NEAR_ENOUGH: f64 = 0.8;
/// The search aims at this fraction of the requested error.
const AIM: f64 = 0.92;
/// The search ends when the smallest step that was found too large, divided by the largest step that was found fine
/// enough, is below this number.
const CLOSE: f64 = 1.06;
/// Smallest observed order at which the error counts as dependent on the step.
const FLAT: f64 = 0.3;
/// Largest factor from one step to the next.
const LEAP: f64 = 16.0;
/// Highest order that is assumed possible. The highest observed order is 4, for extrapolated accelerations.
const STEEPEST: f64 = 6.0;
/// If a run costs at least this fraction of the limit, its step counts as the finest affordable step.
const AT_THE_LIMIT: f64 = 0.9;

/// Outcome of a search.
#[derive(Clone, Debug)]
pub(super) enum Found {
    /// The largest step (or accuracy) found whose error is within the limit.
    Step {
        /// The step.
        resolution: f64,
        /// The run with this step.
        measured: Measured,
    },
    /// All steps that meet the request cost more than the limit.
    /// The fields are the finest affordable step, and the measured or expected error at this step.
    TooDear {
        /// The step.
        resolution: f64,
        /// Measured or expected error at this step.
        error: f64,
    },
    /// No step has an error within the limit; the number is the smallest error found.
    TooCoarse(f64),
}

/// Searches from `start` for the largest step, up to `most`, whose error is at most `within`.
/// `order` is the formal order of the method.
/// A step is not run if its expected cost exceeds `limit`.
pub(super) fn largest_step(
    [start, most]: [f64; 2],
    order: f64,
    within: f64,
    limit: f64,
    run: &mut dyn FnMut(f64) -> Measured,
) -> Found {
    let mut met: Option<(f64, Measured)> = None;
    let mut missed: Option<f64> = None;
    let mut last: Option<[f64; 3]> = None;
    let (mut least, mut order, mut step) = (f64::INFINITY, order, start.smaller(most));
    for _ in 0..MOST_RUNS {
        let measured = run(step);
        let (error, price) = (measured.error, measured.price);
        // The cost is a constant and a part proportional to the number of steps.
        // After a single run the constant is taken as zero.
        // The cost of a failed run is unknown. After a failed run, the finest affordable step is therefore taken as 0.
        let mut affordable = if price.is_finite() { step * price / limit } else { 0.0 };
        if let Some([before, _, its_price]) = last {
            let per_step = (price - its_price) / (1.0 / step - 1.0 / before);
            if per_step > 0.0 && price.is_finite() && limit.is_finite() {
                affordable = (1.0 / step + (limit - price) / per_step).recip();
                affordable = if affordable > 0.0 { affordable } else { 0.0 };
            }
        }
        if error.is_finite() {
            least = least.smaller(error);
            if let Some([before, its_error, _]) = last {
                let observed = (error / its_error).ln() / (step / before).ln();
                if observed < FLAT && error > within && step < before {
                    return settled(met, least);
                }
                if observed.is_finite() {
                    order = observed.clamp(0.5, STEEPEST);
                }
            }
        }
        if price.is_finite() {
            last = Some([step, error, price]);
        }
        if error <= within {
            let larger = met.as_ref().is_none_or(|(known, _)| step > *known);
            if larger {
                met = Some((step, measured));
            }
            if error >= NEAR_ENOUGH * within || step >= most {
                break;
            }
        } else {
            missed = Some(missed.map_or(step, |known: f64| known.smaller(step)));
            if met.is_none() && error.is_finite() {
                // Errors expected at the finest affordable step: with the highest possible order, and with the present
                // order.
                let [at_best, expected] =
                    [STEEPEST, order].map(|order| error * (affordable / step).smaller(1.0).powf(order));
                if price >= AT_THE_LIMIT * limit || at_best > within {
                    return Found::TooDear { resolution: affordable, error: expected };
                }
            }
        }
        let factor = match error {
            0.0 => LEAP,
            error if error.is_finite() => (AIM * within / error).powf(1.0 / order).clamp(1.0 / LEAP, LEAP),
            _ => 0.25,
        };
        let aim = if met.is_none() { (step * factor).larger(affordable.smaller(step)) } else { step * factor };
        if met.is_none() && aim >= step && !(error <= within) {
            return Found::TooDear { resolution: affordable, error };
        }
        step = aim.smaller(most);
        if let (Some((good, _)), Some(bad)) = (&met, missed) {
            if bad / good < CLOSE {
                break;
            }
            if !(step > *good && step < bad) {
                step = (good * bad).sqrt();
            }
        }
    }
    settled(met, least)
}

fn settled(met: Option<(f64, Measured)>, least: f64) -> Found {
    match met {
        Some((resolution, measured)) => Found::Step { resolution, measured },
        None => Found::TooCoarse(least),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A model run: its error falls with a power of the step down to a floor, and its cost is 1 / step.
    fn model(order: f64, floor: f64) -> impl FnMut(f64) -> Measured {
        move |step: f64| Measured { error: (step.powf(order)).larger(floor), worst: "x".into(), price: 1.0 / step }
    }

    #[test]
    fn the_step_is_found_for_any_order() {
        for order in [1.0, 2.0, 4.0] {
            for start in [1e-6, 1e-3, 1.0] {
                let found = largest_step([start, 1e9], 2.0, 1e-4, f64::INFINITY, &mut model(order, 0.0));
                let Found::Step { resolution, measured } = found else { panic!("{found:?}") };
                let exact = 1e-4f64.powf(1.0 / order);
                assert!(
                    measured.error <= 1e-4 && resolution > exact / 1.5,
                    "order {order} from {start}: {resolution} of {exact}"
                );
            }
        }
    }

    #[test]
    fn an_error_goal_met_at_every_step_gives_the_largest_step() {
        let found = largest_step([1e-8, 0.1], 1.0, 1e-4, f64::INFINITY, &mut |step| Measured {
            error: 1e-14,
            worst: "x".into(),
            price: 1.0 / step,
        });
        assert!(matches!(found, Found::Step { resolution, .. } if resolution == 0.1), "{found:?}");
    }

    #[test]
    fn an_error_floor_above_the_goal_is_too_coarse() {
        let found = largest_step([1.0, 1e9], 2.0, 1e-4, f64::INFINITY, &mut model(2.0, 1e-3));
        assert!(matches!(found, Found::TooCoarse(error) if error == 1e-3), "{found:?}");
    }

    #[test]
    fn a_search_beyond_the_cost_limit_is_given_up() {
        let found = largest_step([1.0, 1e9], 2.0, 1e-8, 100.0, &mut model(2.0, 0.0));
        assert!(matches!(found, Found::Step { .. } | Found::TooDear { .. }));
        let mut runs = 0;
        let mut counted = |step: f64| {
            runs += 1;
            model(1.0, 0.0)(step)
        };
        let found = largest_step([1e-3, 1e9], 2.0, 1e-8, 100.0, &mut counted);
        assert!(matches!(found, Found::TooDear { .. }) && runs == 1, "{found:?} after {runs}");
    }

    #[test]
    fn a_failed_run_counts_as_too_coarse() {
        let mut fails = |step: f64| match step > 1e-2 {
            true => Measured { error: f64::INFINITY, worst: String::new(), price: 0.0 },
            false => model(2.0, 0.0)(step),
        };
        let found = largest_step([1.0, 1e9], 2.0, 1e-6, f64::INFINITY, &mut fails);
        assert!(matches!(found, Found::Step { resolution, .. } if resolution > 5e-4), "{found:?}");
    }
}
