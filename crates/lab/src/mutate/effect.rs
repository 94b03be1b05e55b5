//! Effect of a fault on exact answers. A fault that changes no exact answer is not counted.

use super::kinds::{FaultInstant, Plant};
use super::stage::Stage;
use super::stage::{Fault, Planted};
use analytic::AssurSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage as Of;
use prover::bounds::magnitudes;

/// If an exact answer changes by at most this fraction of the quantity's largest number, the change counts as rounding
/// error.
/// Rounding errors of this size also appear if the same case is solved from other, mathematically equivalent numbers.
/// The limit is at most a tenth of the difference allowed between the two analytic sides.
pub(super) fn rounding(stage: Of) -> f64 {
    match stage {
        Of::Positions => 1e-13,
        Of::Velocities | Of::Accelerations => 1e-12,
        Of::Reactions | Of::BalancingMoment => 1e-11,
    }
}

/// Effect of a fault on a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effect {
    /// The case lacks the part that the fault affects.
    None,
    /// The fault changes exact answers by no more than rounding error.
    /// The number is the largest change, relative to the largest number of the quantity.
    Equivalent(f64),
    /// Exact answers change. The number is the largest change, relative to the largest number of the quantity.
    Changes(f64),
    /// No exact answer exists with the fault.
    Unsolved,
}

/// Whether a case has the part that a fault affects.
fn has_part(case: &Case, fault: Fault) -> Result<bool> {
    match fault.kind.plant {
        Plant::Case(change) => Ok(change(case, fault.size).is_some()),
        Plant::Answer(change) => {
            let mut any = false;
            let mut look = |row: usize, state: &State| {
                any |= change(FaultInstant { case, row }, &mut state.clone(), fault.size).is_some();
                Ok(())
            };
            AssurSolver.each(case, &mut look)?;
            Ok(any)
        }
        // No case has formulas.
        Plant::Formula(_) => Ok(false),
    }
}

impl Stage<'_> {
    /// Effect of a fault on the exact answers of analytic side 1.
    pub(super) fn effect(&self, fault: Fault) -> Result<Effect> {
        if !has_part(&self.case, fault)? {
            return Ok(Effect::None);
        }
        let Ok(wrong) = Planted { hook: fault, inner: Box::new(AssurSolver) }.solve(&self.case) else {
            return Ok(Effect::Unsolved);
        };
        let (mut largest, mut beyond) = (0.0f64, false);
        let known = magnitudes(&self.right).into_iter().zip(&self.integration);
        for ((channel, ours), ((size, error), (_, theirs))) in self.right.iter().zip(known.zip(wrong.iter())) {
            // A difference of whole turns also counts as a change of the answer.
            let change = ours.iter().zip(theirs).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs()));
            let relative = share(change, size);
            largest = largest.larger(relative);
            beyond |= !(relative <= rounding(channel.kind.stage) + share(*error, size));
        }
        Ok(if beyond { Effect::Changes(largest) } else { Effect::Equivalent(largest) })
    }
}
