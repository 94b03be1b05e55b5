//! What a fault changes in exact answers: a fault that changes nothing is none.

use super::kinds::{FaultInstant, Plant};
use super::planted::{Fault, Planted};
use super::stage::Stage;
use analytic::AssurSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::KeepNan;
use linkage::math::statistics::share;
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage as Of;
use prover::bounds::magnitudes;

/// Change, relative to the largest number of a quantity, that is rounding: of a case solved once more with other
/// numbers, which follow from each other. It is a tenth and less of what the two sides are allowed to differ by.
pub(super) fn rounding(stage: Of) -> f64 {
    match stage {
        Of::Positions => 1e-13,
        Of::Velocities | Of::Accelerations => 1e-12,
        Of::Reactions | Of::BalancingMoment => 1e-11,
    }
}

/// What a fault does to a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Effect {
    /// The case has no part that the fault is in.
    None,
    /// Exact answers are the same to rounding: the largest change, relative to the largest number of the quantity.
    Equivalent(f64),
    /// Exact answers change, by so much at most.
    Changes(f64),
    /// There is no exact answer any more.
    Unsolved,
}

/// Whether a case has a part that a fault is in.
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
    /// What a fault changes in the exact answers of side 1.
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
            // Whole turns count here.
            let change = ours.iter().zip(theirs).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs()));
            let relative = share(change, size);
            largest = largest.larger(relative);
            beyond |= !(relative <= rounding(channel.kind.stage) + share(*error, size));
        }
        Ok(if beyond { Effect::Changes(largest) } else { Effect::Equivalent(largest) })
    }
}
