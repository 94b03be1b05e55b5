//! Properties of every mechanism, on random mechanisms of one to three dyads of all kinds.
//! These tests use no formula of the solvers.
//! Derivatives come from differences, and forces are checked by the laws of momentum and energy.

mod balance;
mod symmetry;
mod turns;

use crate::common::random::{DyadSpecimen, REACH, for_each, within};
use crate::common::{centre, centre_acceleration, centre_velocity, states};
use linkage::math::{KeepNan, Vec2};
use linkage::solver::{Solver, State};
use linkage::trajectory::Stage;
use proptest::test_runner::TestCaseError;
use prover::bounds::residuals;

/// Number of mechanisms on which every invariant is tested.
const COUNT: u32 = 128;

/// Crank angle between the points of a difference quotient (rad).
/// The angle is a little above eps^(1/5), where truncation error and rounding error are equal.
const TURN: f64 = 1e-3;
/// Bound on the rounding error of a difference quotient, divided by the value's magnitude and by the condition number.
/// The bound is ten units in the last place of the value, divided by the crank angle of the quotient.
/// The largest error of these mechanisms is a quarter of the bound.
const NOISE: f64 = 10.0 * f64::EPSILON / TURN;

/// States around an instant: at -4, -2, -1, 0, 1, 2, 4 times the spacing.
struct Around {
    states: [State; 7],
    spacing: f64,
    condition: f64,
}

impl Around {
    fn of(solver: &dyn Solver, sample: &DyadSpecimen, t: f64) -> Self {
        let case = &sample.scenario.case;
        let spacing = TURN / case.crank().at(0.0).rate.abs();
        let times = [-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0].map(|k| t + k * spacing);
        let found = states(solver, case, &times).unwrap_or_else(|error| panic!("{error}"));
        Around { states: found.try_into().expect("seven states"), spacing, condition: sample.condition }
    }

    fn here(&self) -> &State {
        &self.states[3]
    }

    /// Checks that `rate` is the derivative of `of`; the values of `of` have the magnitude `scale`.
    /// The test computes the derivative by a five-point rule at one spacing and at twice this spacing.
    /// The difference of the two results is 15 times the error of the finer one, and therefore bounds this error.
    fn is_slope(&self, what: &str, scale: f64, of: impl Fn(&State) -> f64, rate: f64) -> Result<(), TestCaseError> {
        let y = self.states.each_ref().map(of);
        let fine = (8.0 * (y[4] - y[2]) - (y[5] - y[1])) / (12.0 * self.spacing);
        let coarse = (8.0 * (y[5] - y[1]) - (y[6] - y[0])) / (24.0 * self.spacing);
        let noise = NOISE * self.condition * scale * TURN / self.spacing;
        within(what, (fine - rate).abs(), (fine - coarse).abs() + noise)
    }

    /// Checks that the vector `rate` is the derivative of the vectors `of`, which have the magnitude `scale`.
    fn are_slopes(&self, what: &str, scale: f64, of: impl Fn(&State) -> Vec2, rate: Vec2) -> Result<(), TestCaseError> {
        self.is_slope(what, scale, |s| of(s).x, rate.x)?;
        self.is_slope(what, scale, |s| of(s).y, rate.y)
    }
}

#[test]
fn velocities_and_accelerations_are_derivatives() {
    for_each(COUNT, |sample| {
        let case = &sample.scenario.case;
        let speed = case.crank().at(0.0).rate.abs();
        for solver in analytic::all() {
            for k in [0, case.grid.len() / 2, case.grid.len() - 1] {
                let around = Around::of(solver, sample, case.grid.times[k]);
                let here = around.here();
                let fastest = here.motions.iter().map(|m| m.omega.abs()).fold(speed, f64::larger);
                for link in case.mechanism.links().ids().skip(1) {
                    let motion = &here.motions[link];
                    let (velocity, acceleration) =
                        (centre_velocity(case, here, link), centre_acceleration(case, here, link));
                    let reach = REACH * fastest;
                    around.is_slope("angle", REACH, |s| s.angles[link], motion.omega)?;
                    around.is_slope("omega", fastest, |s| s.motions[link].omega, motion.alpha)?;
                    around.are_slopes("place", REACH, |s| centre(case, s, link), velocity)?;
                    around.are_slopes("velocity", reach, |s| centre_velocity(case, s, link), acceleration)?;
                }
            }
        }
        Ok(())
    });
}

#[test]
fn both_solvers_agree_to_rounding() {
    for_each(8 * COUNT, |sample| {
        let case = &sample.scenario.case;
        let [a, b] = analytic::all().map(|solver| solver.solve(case).expect("solvable"));
        let speed = case.crank().at(0.0).rate.abs();
        let largest = |stage: Stage| {
            let own = a.iter().filter(|(channel, _)| channel.kind.stage == stage);
            own.flat_map(|(_, values)| values).fold(0.0, |max: f64, v| max.larger(v.abs()))
        };
        for residual in residuals(&a, &b).expect("one grid") {
            let stage = residual.channel.kind.stage;
            let scale = match stage {
                Stage::Positions => REACH,
                Stage::Velocities => largest(stage).larger(REACH * speed),
                Stage::Accelerations => largest(stage).larger(REACH * speed * speed),
                Stage::Reactions | Stage::BalancingMoment => {
                    largest(Stage::Reactions).larger(largest(Stage::BalancingMoment))
                }
            };
            // Bounds on the residuals, in units in the last place times the condition number.
            // Each derivative, and each linear solve for forces, adds further rounding errors, so the bound depends on
            // the stage.
            // In these units, the largest measured residuals are 13 (positions), 55 (velocities), 230 (accelerations)
            // and 200 (reactions and balancing moment).
            let units = match stage {
                Stage::Positions => 50.0,
                Stage::Velocities => 200.0,
                _ => 1000.0,
            };
            within(stage.name(), residual.max / scale, units * f64::EPSILON * sample.condition)?;
        }
        Ok(())
    });
}
