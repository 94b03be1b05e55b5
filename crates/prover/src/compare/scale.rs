//! Scales by which the differences in channels are judged.

use std::collections::BTreeMap;

use crate::bounds::scales;
use crate::run::solved::{known_at_least, known_of_complete};
use analytic::AssurSolver;
use formula::NodeShape;
use linkage::case::Grid;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Trajectory};
use scenario::{Claim, Scenario};

/// Largest number of instants from which scales are determined.
const MOST: usize = 20_000;

/// For each channel, by its name: the scale over a whole run, and a lower limit of the error of its values (SI units).
/// The scales do not depend on which channels are compared.
pub(super) struct Scales(BTreeMap<String, (f64, f64)>);

impl Scales {
    /// Scales of a scenario over its run.
    /// If the scenario has no run or cannot be solved over its run, the scales come from `grid`, the instants of the
    /// other party.
    pub(super) fn of(scenario: &Scenario, grid: &Grid) -> Self {
        let all = scenario.case.all_channels();
        let solved = |grid: &Grid| -> Option<Scales> {
            let step = grid.len().div_ceil(MOST).max(1);
            let few = |values: &[f64]| values.iter().copied().step_by(step).collect();
            let grid = Grid { times: few(&grid.times), inputs: few(&grid.inputs) };
            let case = scenario.case.on(grid).ok()?.wanting_only(&all);
            let has_instants = !case.grid.is_empty();
            let found = has_instants.then(|| AssurSolver.solve(&case).ok()).flatten()?;
            Some(Scales::with(&found, known_of_complete(&case, &found)))
        };
        solved(&scenario.case.grid).or_else(|| solved(grid)).unwrap_or_else(|| Scales(BTreeMap::new()))
    }

    /// Scales of a complete trajectory.
    pub(super) fn of_trajectory(trajectory: &Trajectory) -> Self {
        Scales::with(trajectory, known_at_least(trajectory))
    }

    fn with(trajectory: &Trajectory, known: Vec<f64>) -> Self {
        let all = trajectory.channels().iter().zip(scales(trajectory)).zip(known);
        Scales(all.map(|((channel, scale), known)| (channel.to_string(), (scale, known))).collect())
    }

    /// Smallest error assumed for an analytic side's values of a channel (SI unit): the rounding error in a
    /// well-conditioned pose. The result is 0 for a channel without a scale.
    pub(super) fn known(&self, channel: &Channel) -> f64 {
        self.0.get(&channel.to_string()).map_or(0.0, |(_, known)| *known)
    }

    /// The scale of a channel in the unit of its claim; `None` for an expression of channels.
    pub(super) fn of_claim(&self, claim: &Claim) -> Option<f64> {
        let (NodeShape::Name(_), Some((_, printed))) = (&claim.tree.shape, claim.channels.first()) else { return None };
        let of = |channel: &Channel| self.0.get(&channel.to_string()).map(|(scale, _)| *scale);
        let across = Channel::named(&format!("joint.{}.fy_N", printed.channel.of)).filter(|_| printed.magnitude);
        let own = of(&printed.channel)?;
        let scale = across.and_then(|across| of(&across)).map_or(own, |across| own.larger(across));
        Some(scale / printed.to_si(1.0))
    }
}
