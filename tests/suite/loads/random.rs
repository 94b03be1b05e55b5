//! Random mechanisms of dyads of all kinds under random loads of all kinds.

use linkage::math::KeepNan;
use std::fmt::Write;

use analytic::{self, witness::momentum, witness::power};
use linkage::case::Case;
use linkage::trajectory::Stage;
use linkproof::compare::residuals;
use linkproof::scenario::Scenario;

use crate::common::random::{for_each, within};
use crate::common::sketch::Random;
use crate::common::{assert_within, shipped, states};

/// Six loads of random kinds, as text.
pub fn loads(random: &mut Random, case: &Case) -> String {
    let links = case.mechanism.links();
    let mut text = String::new();
    for _ in 0..6 {
        let moving = 1 + random.index(links.len() - 1);
        let other = (moving + 1 + random.index(links.len() - 1)) % links.len();
        let (link, second) = (&links[moving], &links[other]);
        let pair = format!("links = [{:?}, {:?}]", link.name, second.name);
        let point = &link.points[random.index(link.points.len())].name;
        let far = second.points.iter().find(|far| far.name != *point);
        let size = random.number(10.0, 100.0);
        let table = |random: &mut Random, names: &[&str]| {
            let row = |random: &mut Random, k: usize| {
                let mut row = format!("crank_deg = {:?}", -400.0 + 110.0 * k as f64 + random.number(0.0, 100.0));
                for name in names {
                    write!(row, ", {name} = {:?}", random.number(-50.0, 50.0)).unwrap();
                }
                format!("{{ {row} }}")
            };
            let rows: Vec<String> = (0..6).map(|k| row(random, k)).collect();
            let interpolation = if random.yes() { "smooth" } else { "linear" };
            format!("turns = 2\ninterpolation = {interpolation:?}\ntable = [{}]", rows.join(", "))
        };
        let acts = if case.mechanism.can_turn(moving) {
            ["always", "clockwise", "counter-clockwise"][random.index(3)]
        } else {
            "always"
        };
        let own = match (random.index(8), far) {
            (0, _) if case.mechanism.can_turn(moving) => {
                format!("type = \"resistance\"\nlink = {:?}\nmoment_N_m = {size:?}", link.name)
            }
            (0 | 1, _) => format!(
                "type = \"moment\"\nlink = {:?}\nacts = {acts:?}\n{}",
                link.name,
                table(random, &["moment_N_m"])
            ),
            (2, _) => {
                let frame = if random.yes() { "link" } else { "world" };
                let table = table(random, &["x_N", "y_N"]);
                format!("type = \"force\"\nlink = {:?}\npoint = {point:?}\nframe = {frame:?}\n{table}", link.name)
            }
            (3, _) => {
                let hinged =
                    case.mechanism.joints().iter().any(|joint| joint.on(0).is_some() && joint.on(moving).is_some());
                let sort = if hinged {
                    "type = \"force\"\nx_N = 3\ny_N = -20".into()
                } else {
                    format!("type = \"resisting_force\"\nforce_N = {size:?}")
                };
                format!("{sort}\nlink = {:?}\npoint = {point:?}", link.name)
            }
            (4, Some(far)) => format!(
                "type = \"spring\"\n{pair}\npoints = [{point:?}, {:?}]\nstiffness_N_m = {size:?}\nfree_length_m = 0.4",
                far.name
            ),
            (5, Some(far)) => {
                format!("type = \"damper\"\n{pair}\npoints = [{point:?}, {:?}]\ndamping_N_s_m = {size:?}", far.name)
            }
            (6, _) => format!("type = \"torsion_spring\"\n{pair}\nstiffness_N_m_rad = {size:?}\nfree_angle_deg = 20"),
            _ => format!("type = \"torsion_damper\"\n{pair}\ndamping_N_m_s = {size:?}"),
        };
        writeln!(text, "[[loads]]\n{own}").unwrap();
    }
    text
}

/// The scenario of a sample under other loads.
pub fn loaded(random: &mut Random, scenario: &Scenario) -> Scenario {
    let text = format!("{}\n{}", scenario.text, loads(random, &scenario.case));
    Scenario::parse(&text, &scenario.path).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn reactions_balance_powers_and_momentum_on_both_sides() {
    let random = std::cell::RefCell::new(Random::from_seed(71));
    let sorts = std::cell::RefCell::new(std::collections::BTreeMap::new());
    for_each(128, |sample| {
        let scenario = loaded(&mut random.borrow_mut(), &sample.scenario);
        let case = &scenario.case;
        for load in &case.loads {
            *sorts.borrow_mut().entry(load.sort()).or_insert(0) += 1;
        }
        let [a, b] = analytic::all().map(|solver| solver.solve(case).expect("solvable"));
        let forces = |stage| {
            let own = a.iter().filter(move |(channel, _)| channel.kind.stage == stage);
            own.flat_map(|(_, values)| values).fold(0.0, |max: f64, v| max.larger(v.abs()))
        };
        let scale = forces(Stage::Reactions).larger(forces(Stage::BalancingMoment));
        // As without loads: see `both_solvers_agree_to_rounding` in the invariants.
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
    assert!(sorts.borrow().len() == 8 && sorts.borrow().values().all(|&count| count > 30), "{:?}", sorts.borrow());
}

#[test]
fn higher_groups_bear_loads_too() {
    let mut random = Random::from_seed(72);
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
                        1e-11 * scale * case.drives.top_speed(),
                        "{name} {}: {power:e}",
                        solver.name()
                    );
                }
            }
        }
    }
}
