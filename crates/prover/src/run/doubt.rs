//! Finds the instants at which channels jump. At these instants an engine's value depends on the smallest error of its
//! motion.
//!
//! A load may jump when its link reverses. A load that is zero at the reversal does not jump, so no instant is left
//! out. A load that is a table over the crank angle may jump at an angle of the table.
//! At the end of a piece of a cam's law, the third derivative of the motion jumps. The error of a second difference at
//! this end depends on the position of the jump within the step.
//! At a change point an engine follows one of many solutions.
//! The engine's rates at the instant of the change point do not show which solution the engine follows. Only later
//! instants show this.
//! See docs/numerics/bounds.md.

use linkage::case::Case;
use linkage::drive::DriveMotion;
use linkage::engine::{Route, Settings};
use linkage::math::Vec2;
use linkage::trajectory::Stage;

use super::observe::{Observed, Senses};
use super::runs::Runs;

/// Within this number of steps on either side of a jump, an engine's values are doubtful. The steps are those of the
/// coarsest judged run.
const STEPS: f64 = 8.0;
/// Number of steps instead of `STEPS` for impulses of a free motion. Impulses are interpolated from six steps, and are
/// one step late.
const IMPULSES: f64 = 5.0;
/// Number of steps instead of `STEPS` for a prescribed motion with extrapolated impulses. The instants at which a load
/// jumps differ between the runs by at most this fraction of a step, because the velocities of runs with the step h
/// have an error of about h^2 / 12 times their second derivative.
const APART: f64 = 0.25;

/// Number of steps instead of `STEPS` for accelerations and forces at the start of a free motion with friction. The
/// engine computes the friction of the first step from an acceleration without half of the centripetal part.
const START: f64 = 2.0;
/// Number of steps instead of `STEPS` for accelerations and forces at the end of a piece of a cam's law.
const KNOT: f64 = 2.0;
/// An instant lies at the end of a piece if its distance from this end is below this fraction of a step.
const ON_KNOT: f64 = 1e-6;

/// A drive counts as standing still below this fraction of its top speed. The limit exceeds the rounding error of a
/// law's formula.
const STANDSTILL: f64 = 1e-9;
/// Number of instants that may be left out, however small the step is: the two ends of a motion.
const ENDS: usize = 2;

/// Doubtful channels of an engine's runs, by row of the grid.
pub(super) struct Doubt(Vec<Doubtful>);

/// Doubtful channels at an instant.
#[derive(Clone, Copy, Default)]
struct Doubtful {
    rates: bool,
    accelerations: bool,
    forces: bool,
    /// Whether a finer step would make the instant usable.
    by_step: bool,
}

impl Doubt {
    /// Finds the doubtful instants from the reversals of drives and loads, and from the singular poses of the
    /// reference.
    /// `settings` are the settings of the judged run.
    pub(super) fn of(case: &Case, reference: &Observed, runs: &Runs, settings: Settings) -> Self {
        let Observed { senses, singular, to_knot, .. } = reference;
        let Settings { resolution, route, extrapolated, .. } = settings;
        let times = &case.grid.times;
        let reach = STEPS * 2.0 * resolution;
        let mut all = vec![Doubtful::default(); times.len()];
        let starts_with_friction = case.is_free() && case.has_friction();
        for (row, (&t, own)) in times.iter().zip(&mut all).enumerate() {
            let (turns, is_singular) = (drive_turns(case, t, reach), singular.get(row) == Some(&true));
            if turns || is_singular {
                // At the instant of the reversal itself, no step is fine enough.
                let by_step = turns && !drive_turns(case, t, 0.0);
                *own = Doubtful { rates: true, accelerations: true, forces: true, by_step };
            }
            if starts_with_friction && t <= START * 2.0 * resolution {
                (own.accelerations, own.forces) = (true, true);
                own.by_step |= t > 0.0;
            }
            if let Some(away) = to_knot.get(row).filter(|away| **away <= KNOT * 2.0 * resolution) {
                (own.accelerations, own.forces) = (true, true);
                own.by_step |= *away > ON_KNOT * resolution;
            }
            let against = |run: &Senses| {
                let mut all = senses.of(row).iter().zip(run.of(row)).zip(senses.jumps(row));
                all.any(|((a, b), jumps)| *jumps && against(*a, *b))
            };
            own.forces |= runs.resolutions.iter().any(|run| against(&run.senses));
        }
        let own = route != Route::Differences;
        let jumps = match (case.is_free(), own && extrapolated > 0) {
            (true, _) => Some(if own { IMPULSES * 2.0 * resolution } else { reach }),
            (false, true) => Some(APART * 2.0 * resolution),
            (false, false) => None,
        };
        if let Some(reach) = jumps {
            for t in reversals(times, senses) {
                for (_, own) in times.iter().zip(&mut all).filter(|(own, _)| (*own - t).abs() <= reach) {
                    (own.forces, own.by_step) = (true, true);
                    own.accelerations |= case.is_free();
                }
            }
        }
        Doubt(all)
    }

    /// For every row, whether the channels of a stage are judged.
    pub(super) fn keeps(&self, stage: Stage) -> Vec<bool> {
        let is_out = |own: &Doubtful| match stage {
            Stage::Positions => false,
            Stage::Velocities => own.rates,
            Stage::Accelerations => own.accelerations,
            Stage::Reactions | Stage::BalancingMoment => own.forces,
        };
        self.0.iter().map(|own| !is_out(own)).collect()
    }

    /// Number of instants that are left out but would be kept with a finer step, divided by the number of all instants.
    /// The two ends of the motion are not counted.
    pub(super) fn too_coarse(&self) -> f64 {
        let out = self.0.iter().filter(|own| own.by_step).count().saturating_sub(ENDS);
        out as f64 / self.0.len().max(1) as f64
    }
}

/// Whether the angle between two velocities is at least 90 deg, or exactly one velocity is zero.
fn against(a: Vec2, b: Vec2) -> bool {
    a.dot(&b) <= 0.0 && (a != Vec2::zeros() || b != Vec2::zeros())
}

/// Whether, within `reach` (s) of `t` (s), a drive with a law stands still or reverses, or its acceleration jumps.
fn drive_turns(case: &Case, t: f64, reach: f64) -> bool {
    case.drives.iter().any(|drive| match &drive.motion {
        DriveMotion::Free { .. } => false,
        DriveMotion::Prescribed { law, .. } if law.holds() => false,
        DriveMotion::Prescribed { .. } => {
            let jumps = drive.jump().is_some_and(|jump| (t - jump).abs() <= reach);
            let least = STANDSTILL * drive.top_speed().abs();
            let speeds = [t - reach, t, t + reach].map(|t| drive.at(t).rate);
            jumps || speeds.iter().any(|speed| !(speed.abs() > least && speed * speeds[1] > 0.0))
        }
    })
}

/// Times at which a load jumps, because the velocity that determines its direction reverses or the crank passes a jump
/// of a table. The times are interpolated linearly between the instants.
fn reversals(times: &[f64], senses: &Senses) -> Vec<f64> {
    let mut rows: Vec<usize> = (0..times.len()).collect();
    rows.sort_by(|&a, &b| times[a].total_cmp(&times[b]));
    let mut found = Vec::new();
    for pair in rows.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        let jumps = senses.jumps(from).iter().zip(senses.jumps(to)).map(|(before, after)| *before || *after);
        for ((a, b), jumps) in senses.of(from).iter().zip(senses.of(to)).zip(jumps) {
            if jumps && against(*a, *b) {
                let (before, after) = (a.norm(), b.norm());
                found.push(times[from] + (times[to] - times[from]) * (before / (before + after)));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::bounds::OtherSweeps;
    use crate::run::observe::{Watch, observe};
    use analytic::AssurSolver;
    use linkage::math::KeepNan;
    use linkage::trajectory::Trajectory;
    use scenario::Scenario;

    /// The doubtful channels of a run that equals the reference, at steps of 1.1 ms.
    fn doubt(case: &Case, route: Route) -> (Doubt, Trajectory) {
        let own = Arc::new(observe(case, &AssurSolver, Watch::Side, &mut |_| {}).unwrap_or_else(|stopped| {
            panic!("{}", stopped.error);
        }));
        let runs = Runs {
            resolutions: [0; 3].map(|_| Arc::clone(&own)),
            other_sweeps: OtherSweeps { runs: [None, None], factor: 1.0, growth: 0.0 },
        };
        let settings = Settings { resolution: 1.1e-3, sweeps: 16, substeps: 1, route, extrapolated: 0 };
        (Doubt::of(case, &own, &runs, settings), own.trajectory.clone())
    }

    fn text(file: &str) -> String {
        std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file)).unwrap()
    }

    fn parsed(text: &str) -> Case {
        Scenario::parse(text, std::path::Path::new("x.toml")).unwrap_or_else(|error| panic!("{error}")).case
    }

    /// Counts instants: instants whose velocities are left out, instants whose positions are left out, and instants
    /// that would be usable with a smaller step.
    /// At steps of 1.1 ms, the values within 17.6 ms on either side of a jump are doubtful.
    fn left_out(file: &str) -> ([usize; 2], f64) {
        let case = parsed(&text(file));
        let (doubt, _) = doubt(&case, Route::Differences);
        let out = |stage: Stage| doubt.keeps(stage).iter().filter(|kept| !**kept).count();
        let count = case.grid.times.len() as f64;
        ([out(Stage::Velocities), out(Stage::Positions)], doubt.too_coarse() * count)
    }

    /// A motion from rest to rest. The instants of rest are left out, and would be left out at any smaller step.
    #[test]
    fn rates_at_the_ends_of_a_law_of_motion_are_left_out() {
        assert_eq!(left_out("scenarios/cycloidal_start.toml"), ([2, 0], 0.0));
    }

    /// A ramp of 0.25 s with an instant every 20 ms. The initial rest is left out, and so are the instants on either
    /// side of the ramp's jump.
    #[test]
    fn rates_beside_a_jump_of_the_acceleration_are_left_out() {
        assert_eq!(left_out("tests/outside/scenarios/ramped_arm.toml"), ([3, 0], 0.0));
    }

    /// A pendulum with friction, released from rest, reverses twice in three seconds.
    /// Impulses are interpolated from six steps, and are one step late. Five of the longest steps (11 ms) are therefore
    /// doubtful on either side of each reversal.
    /// If forces come from second differences, 17.6 ms are doubtful on either side of each reversal.
    #[test]
    fn only_forces_beside_a_reversal_of_free_motion_are_left_out() {
        let text = text("scenarios/pendulum.toml").replace("step_s = 0.01", "step_s = 0.001");
        let grid = text.split("[[oracle]]").next().unwrap();
        let case = parsed(&format!("{grid}\n[[loads]]\ntype = \"resistance\"\nlink = \"rod\"\nmoment_N_m = 1\n"));
        for (route, reach) in [(Route::Native, 11e-3), (Route::Probe, 11e-3), (Route::Differences, 17.6e-3)] {
            let (doubt, found) = doubt(&case, route);
            let (times, omega) = (found.times(), found.named("link.rod.omega_rad_s").unwrap());
            let reverses = |row: &usize| omega[*row] * omega[*row + 1] < 0.0;
            let reversals: Vec<f64> = (1..times.len() - 1).filter(reverses).map(|row| times[row]).collect();
            assert_eq!(reversals.len(), 2, "{reversals:?}");
            // The pendulum starts at rest. Rows near the start are skipped.
            for (row, kept) in doubt.keeps(Stage::Reactions).into_iter().enumerate().skip(30) {
                let away = reversals.iter().map(|t| (times[row] - t - 5e-4).abs()).fold(f64::INFINITY, f64::smaller);
                assert!(away > reach - 1e-3 || !kept, "{route:?}: {} s", times[row]);
                assert!(away < reach + 1e-3 || kept, "{route:?}: {} s", times[row]);
            }
            assert_eq!(doubt.keeps(Stage::Accelerations), doubt.keeps(Stage::Reactions), "{route:?}");
        }
    }
}
