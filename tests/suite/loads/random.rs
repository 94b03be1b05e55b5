//! Random mechanisms of all kinds of dyads under random loads of all kinds.

use linkage::math::KeepNan;

use analytic::{self, witness::momentum, witness::power};
use linkage::case::Case;
use linkage::drive::Load;
use linkage::trajectory::Stage;
use prover::bounds::residuals;
use scenario::Scenario;

use crate::common::loads::Sizes;
use crate::common::random::{for_each, within};
use crate::common::sketch::RandomSource;
use crate::common::{self, assert_within, shipped, states};

/// Six loads of random kinds, as scenario text.
pub fn loads(random: &mut RandomSource, case: &Case) -> String {
    common::loads::loads(random, case, 6, Sizes { force: 50.0, length: 1.0, speed: 1.0 })
}

/// The scenario of a sample with six more loads.
pub fn loaded(random: &mut RandomSource, scenario: &Scenario) -> Scenario {
    let text = format!("{}\n{}", scenario.text, loads(random, &scenario.case));
    Scenario::parse(&text, &scenario.path).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn reactions_balance_powers_and_momentum_on_both_sides() {
    let random = std::cell::RefCell::new(RandomSource::from_seed(71));
    let sorts = std::cell::RefCell::new(std::collections::BTreeMap::new());
    for_each(128, |sample| {
        let scenario = loaded(&mut random.borrow_mut(), &sample.scenario);
        let case = &scenario.case;
        // The name of a load is its type in the file.
        let said = scenario.text.split("[[loads]]\ntype = \"").skip(1).map(|load| load.split('"').next().unwrap());
        assert_eq!(case.loads.iter().map(Load::sort).collect::<Vec<_>>(), said.collect::<Vec<_>>());
        for load in &case.loads {
            *sorts.borrow_mut().entry(load.sort()).or_insert(0) += 1;
        }
        let [a, b] = analytic::all().map(|solver| solver.solve(case).expect("solvable"));
        let forces = |stage| {
            let own = a.iter().filter(move |(channel, _)| channel.kind.stage == stage);
            own.flat_map(|(_, values)| values).fold(0.0, |max: f64, v| max.larger(v.abs()))
        };
        let scale = forces(Stage::Reactions).larger(forces(Stage::BalancingMoment));
        // The bound is the same as without loads; see `both_solvers_agree_to_rounding` in the invariants.
        let bound = 1000.0 * f64::EPSILON * sample.condition;
        for residual in residuals(&a, &b).expect("one grid") {
            if residual.channel.kind.stage >= Stage::Reactions {
                within(residual.channel.kind.stage.name(), residual.max / scale, bound)?;
            }
        }
        for solver in analytic::all() {
            for state in states(solver, case, &case.grid.times).expect("solvable") {
                let moment = power::balancing_moment(case, &state);
                within("power", (moment - state.torques[0]).abs() / scale, bound)?;
                let [(force, turn), (other, other_turn)] = [state.shaking(case), momentum::shaking(case, &state)];
                within("shaking force", (force - other).norm() / scale, bound)?;
                within("shaking moment", (turn - other_turn).abs() / scale, bound)?;
            }
        }
        Ok(())
    });
    assert!(sorts.borrow().values().all(|&count| count > 30), "{:?}", sorts.borrow());
}

#[test]
fn higher_groups_agree_under_loads() {
    let mut random = RandomSource::from_seed(72);
    for name in ["fourth_class.toml", "ov7_new.toml", "five_bar.toml"] {
        for _ in 0..4 {
            let scenario = loaded(&mut random, &shipped(name));
            let case = &scenario.case;
            let [a, b] = analytic::all().map(|solver| solver.solve(case).expect("solvable"));
            let own = a.iter().filter(|(channel, _)| channel.kind.stage >= Stage::Reactions);
            let scale = own.flat_map(|(_, values)| values).fold(0.0, |max: f64, v| max.larger(v.abs()));
            for residual in residuals(&a, &b).expect("one grid") {
                let forces = residual.channel.kind.stage >= Stage::Reactions;
                assert!(
                    !forces || residual.max < 1e-11 * scale,
                    "{name} {}: {:e}",
                    residual.channel,
                    residual.max / scale
                );
            }
            for solver in analytic::all() {
                for state in states(solver, case, &case.grid.times).expect("solvable") {
                    let drives = case.drives.iter().zip(&state.torques);
                    let driving: f64 = drives.map(|(drive, torque)| torque * state.motions[drive.link].omega).sum();
                    let power = driving + power::of_known_forces(case, &state);
                    assert_within!(
                        power.abs(),
                        1e-11 * scale * case.drives.top_speed(case.mechanism.size()),
                        "{name} {}: {power:e}",
                        solver.name()
                    );
                }
            }
        }
    }
}
