//! Random groups of four links: both analytic sides, by contours and angles here, by absolute coordinates there, must agree.

mod common;

use common::four_link::{Random, scenario};
use linkproof::compare::{magnitudes, residuals};
use linkproof::reference::{AssurSolver, NewtonSolver};
use linkproof::solver::Solver;
use linkproof::trajectory::Stage;

const TRIES: usize = 400;

#[test]
fn both_sides_agree_on_random_groups_of_four_links() {
    let mut random = Random::from_seed(7);
    for triad in [true, false] {
        let (mut solved, mut worst) = (0, [0.0f64; 5]);
        for _ in 0..TRIES {
            let scenario = scenario(&mut random, triad);
            let case = &scenario.case;
            assert!(case.start.closure(&case.mechanism) < 1e-13);
            let (assur, newton) = (AssurSolver.solve(case, &mut |_| {}), NewtonSolver.solve(case, &mut |_| {}));
            // Beyond a dead point there is nothing to compare; the two sides must both say so.
            let (Ok(assur), Ok(newton)) = (&assur, &newton) else {
                assert!(assur.is_err() && newton.is_err(), "{:?} {:?}", assur.err(), newton.err());
                continue;
            };
            // Omega measures how near the pose is to a singular one: rounding grows with its square. So does alpha, which is of the
            // order of that square and tells where omega happens to pass through zero.
            let most = |suffix: &str| {
                let near = assur.iter().filter(|(channel, _)| channel.kind.suffix == suffix);
                near.flat_map(|(_, values)| values).fold(0.0f64, |max, v| max.max(v.abs()))
            };
            let speed = (most("omega_rad_s") / 7.0).max(most("alpha_rad_s2").sqrt() / 7.0).max(1.0);
            solved += 1;
            for (residual, size) in residuals(assur, newton).unwrap().iter().zip(magnitudes(assur)) {
                let stage = residual.channel.kind.stage;
                let share = residual.max / (size * speed * speed);
                worst[stage as usize] = worst[stage as usize].max(share);
            }
        }
        assert!(solved * 2 > TRIES, "only {solved} of {TRIES}");
        for stage in Stage::ALL {
            // The bounds of the published mechanisms, times the square of the speed ratio.
            let bound = match stage {
                Stage::Positions => 1e-12,
                Stage::Velocities | Stage::Accelerations => 1e-11,
                Stage::Reactions | Stage::BalancingMoment => 1e-10,
            };
            assert!(worst[stage as usize] <= bound, "triad {triad}: {} {worst:?} of {solved}", stage.name());
        }
    }
}
