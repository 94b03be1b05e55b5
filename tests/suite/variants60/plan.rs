//! Crank angles and time steps at which a variant is solved.

use super::geometry::{Linkage, OURS, Variant};
use linkage::math::KeepNan;

/// If the crank cannot rotate fully, the grid ends where the transmission angle falls to this value (deg).
const LEAST: f64 = 15.0;
/// The transmission angle (deg) at which the grid ends, for variants whose given pose has a smaller angle than `LEAST`.
const SMALL: f64 = 10.0;
/// Least number of engine steps between an end of the grid and the nearest limit of the crank.
/// Near a limit, the motion varies as the square root of the distance to the limit.
/// The accuracy of a step near the limit therefore depends only on the number of steps in this distance.
/// With forty steps, one channel of variant 15 and one channel of variant 35 are inconclusive.
/// With sixty steps, all channels are decided.
const STEPS_TO_LIMIT: f64 = 60.0;
/// Engine step (deg) far from limits, and the smallest unit (deg): all steps are multiples of the unit.
const ENGINE: [f64; 2] = [0.25, 0.01];
/// Least number of instants in a grid.
const FEWEST: f64 = 12.0;
/// Tolerance of grid ends (deg): rounding error may move an end off a whole degree.
const SLACK: f64 = 1e-6;

const NESTED: &str = "limits are limits of larger angles too";

/// The data from which a variant's file is written.
#[derive(Clone, Debug)]
pub struct Plan {
    pub linkage: Linkage,
    /// Crank angles that can be reached (deg); `None` if all crank angles can be reached.
    pub limits: Option<[f64; 2]>,
    /// Smaller transmission angle of the given pose (deg).
    pub given: f64,
    /// Smallest transmission angle (deg) that the grid allows; 0 if the crank rotates fully.
    pub kept: f64,
    /// Crank angle of the start (deg): alpha, unless the given pose is outside the grid.
    pub start: f64,
    /// First and last crank angle of the grid (deg).
    pub grid: [f64; 2],
    pub grid_step: f64,
    /// Smallest transmission angle of each dyad on the grid (deg).
    pub least: [f64; 2],
    /// Step of the engine (deg).
    pub engine_step: f64,
}

impl Plan {
    pub fn of(variant: &Variant) -> Self {
        let linkage = Linkage::of(variant, OURS);
        let alpha = variant.alpha;
        let limits = linkage.interval(alpha, 0.0);
        let given = linkage.transmission(alpha);
        let (kept, start, [low, high]) = match limits {
            None => (0.0, alpha, [alpha, alpha + 360.0]),
            Some(_) if given >= LEAST - SLACK => (LEAST, alpha, linkage.interval(alpha, LEAST).expect(NESTED)),
            Some([from, to]) => {
                let inside = (1..360).flat_map(|k| [alpha + f64::from(k), alpha - f64::from(k)]);
                let start = inside.filter(|at| (from..to).contains(at)).find(|&at| linkage.transmission(at) >= SMALL);
                let start = start.expect("the crank can reach an angle with a sufficient transmission angle");
                (SMALL, start, linkage.interval(start, SMALL).expect(NESTED))
            }
        };
        let ends = |step: f64| {
            [((low - start - SLACK) / step).ceil() * step, ((high - start + SLACK) / step).floor() * step]
                .map(|offset| start + offset)
        };
        let steps = (0..).map(|k| 0.5f64.powi(k));
        let grid_step = steps.into_iter().find(|&step| high - low >= FEWEST * step).unwrap();
        let grid = ends(grid_step);
        let least = linkage.least(grid);
        let room = limits.map_or(f64::INFINITY, |[from, to]| (grid[0] - from).smaller(to - grid[1]));
        let engine_step = ((room / STEPS_TO_LIMIT / ENGINE[1]).floor() * ENGINE[1]).clamp(ENGINE[1], ENGINE[0]);
        Plan { limits, given, kept, start, grid, grid_step, least, engine_step, linkage }
    }

    /// Smallest transmission angle on the grid (deg).
    pub fn smallest(&self) -> f64 {
        self.least[0].smaller(self.least[1])
    }
}
