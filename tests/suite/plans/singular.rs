//! Singular (Assur) points of groups of class III and IV: the constructions agree with the solvers.

use analytic::{AssurSolver, NewtonSolver};
use design::draw;
use design::plan::singular::AssurAcceleration;
use design::plan::{SingularPoint, TipKind};
use linkage::case::When;
use linkage::math::{KeepNan, Vec2, cross, rotated};
use linkage::mechanism::GroupId;
use linkage::solver::Solver;

use super::{Named, plans, scenario};
use crate::common::assert_within;

/// The method through the singular point is exact: it gives the same values as both solvers.
#[test]
fn the_singular_point_gives_the_solvers_velocities_and_accelerations() {
    let case = scenario("fourth_class").case;
    let group = &case.structure.groups[GroupId(0)];
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        for degrees in 0..72 {
            let state =
                design::plan::state_at(&case, solver, When::Crank((5.0 * f64::from(degrees)).to_radians())).unwrap();
            let point = SingularPoint::of(&case, group, &state.motions).unwrap().unwrap();
            assert_eq!(point.lines(), "BD x CE");
            // The farther S is from the group, the more digits cancel.
            // `far` measures the cancellation: `far` grows with the distance of S divided by the size of the group.
            let far = 1.0 + point.at.norm() / 0.1;
            for &(link, omega, alpha) in &point.links {
                let motion = &state.motions[link];
                assert_within!(
                    (omega - motion.omega).abs(),
                    1e-12 * 100.0 * far,
                    "{degrees}: {omega} {}",
                    motion.omega
                );
                assert_within!((alpha - motion.alpha).abs(), 1e-12 * 1e4 * far, "{degrees}: {alpha} {}", motion.alpha);
            }
            for (side, link) in [point.links[0].0, point.links[1].0].into_iter().enumerate() {
                let motion = &state.motions[link];
                let local = rotated(Vec2::new(motion.direction.x, -motion.direction.y), point.at - motion.origin);
                let speed = point.velocity.norm().larger(1.0);
                assert_within!((motion.point_velocity(local) - point.velocity).norm(), 1e-12 * speed * far);
                let strong = point.accelerations[side].norm().larger(100.0);
                assert_within!(
                    (motion.point_acceleration(local) - point.accelerations[side]).norm(),
                    1e-12 * strong * far
                );
            }
        }
    }
    let case = scenario("crank_rocker").case;
    let state = design::plan::state_at(&case, &AssurSolver, When::Crank(0.3)).unwrap();
    for group in &case.structure.groups {
        assert_eq!(SingularPoint::of(&case, group, &state.motions).unwrap(), None);
    }
}

/// In the acceleration plan, two assumed angular accelerations give two false positions of the singular point's tip.
/// The true position of the tip is on the line through the two false positions.
/// The construction gives the angular accelerations of the solver.
#[test]
fn two_false_positions_give_the_solvers_accelerations() {
    let case = scenario("fourth_class").case;
    let group = &case.structure.groups[GroupId(0)];
    for degrees in 0..36 {
        let when = When::Crank((10.0 * f64::from(degrees)).to_radians());
        let state = design::plan::state_at(&case, &AssurSolver, when).unwrap();
        let point = SingularPoint::of(&case, group, &state.motions).unwrap().unwrap();
        let AssurAcceleration::FalsePositions(found) = &point.acceleration else { panic!("class IV") };
        let far = 1.0 + point.at.norm() / 0.1;
        let alpha = state.motions[found.driver].alpha;
        let [(first, one), (second, other)] = &found.trials;
        assert!(first != second && one.at != other.at, "{degrees}: {found:?}");
        assert_within!((found.alphas[0] - alpha).abs(), 1e-10 * 1e4 * far, "{degrees}: {alpha}");
        assert_within!((found.alphas[1] - state.motions[point.links[0].0].alpha).abs(), 1e-10 * 1e4 * far);
        let size = point.accelerations[0].norm().larger(100.0) * far;
        assert_within!((found.at - point.accelerations[0]).norm(), 1e-10 * size, "{degrees}");
        // The position of the tip depends linearly on the assumed angular acceleration.
        let share = (alpha - first) / (second - first);
        assert_within!((one.at + (other.at - one.at) * share - found.at).norm(), 1e-10 * size);
    }
}

/// For a class III group, the construction needs no assumed value.
/// The motions of the base link and of the leads agree with the solvers.
#[test]
fn the_singular_point_of_a_class_iii_group_gives_the_solvers_motions() {
    for name in ["ov7_new", "class3_group", "ov7_new_tabulated"] {
        let case = scenario(name).case;
        let groups = &case.structure.groups;
        for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
            for degrees in 0..36 {
                let when = When::Crank((10.0 * f64::from(degrees)).to_radians());
                let state = design::plan::state_at(&case, solver, when).unwrap();
                let found = groups.iter().find_map(|group| SingularPoint::of(&case, group, &state.motions).unwrap());
                let point = found.unwrap();
                let most = |of: fn(&linkage::math::Motion) -> f64| state.motions.iter().map(of).fold(0.0, f64::larger);
                let [fast, steep] = [most(|own| own.omega.abs()), most(|own| own.omega.powi(2) + own.alpha.abs())];
                // The farther the point is from the group, the more digits cancel.
                let far = 1.0 + point.at.norm() / case.mechanism.size();
                for &(link, omega, alpha) in &point.links {
                    let motion = &state.motions[link];
                    assert_within!((omega - motion.omega).abs(), 1e-11 * fast * far, "{name} {degrees}: {omega}");
                    assert_within!((alpha - motion.alpha).abs(), 1e-10 * steep * far, "{name} {degrees}: {alpha}");
                }
                let base = &state.motions[point.links[0].0];
                assert_within!((base.velocity_at(point.at) - point.velocity).norm(), 1e-10 * fast * far);
                assert_eq!((point.class, point.links.len(), point.accelerations.len()), (3, 4, 1));
            }
        }
    }
}

/// In the velocity plan, the line of each lead passes through the tips of its ends, and is perpendicular to the lead.
/// The lines of the two leads meet at the tip of the singular point.
#[test]
fn the_singular_point_is_drawn_in_the_velocity_plan() {
    for name in ["fourth_class", "class3_group"] {
        let plans = plans(name, 70.0);
        let plan = &plans.velocity;
        let tip = plan.tips.iter().find(|tip| tip.kind == TipKind::Singular).unwrap();
        assert_eq!(tip.letter, "σ");
        assert_within!((plan.vector("v_Σ").unwrap().value - tip.at).norm(), 1e-15);
        assert_eq!(plan.lines.len(), 2);
        for (line, lead) in plan.lines.iter().zip(&plans.scheme.singular[0].leads) {
            let letters = lead.names.each_ref().map(|name| plan.tip(&name.to_lowercase()).unwrap());
            let across = lead.ends[1] - lead.ends[0];
            for end in letters {
                let off = cross(line[1] - line[0], end - line[0]) / (line[1] - line[0]).norm();
                assert_within!(off.abs(), 1e-10 * plan.longest(), "{name}");
            }
            assert_within!((line[1] - line[0]).normalize().dot(&across.normalize()).abs(), 1e-10, "{name}");
            assert_eq!(line[1], tip.at);
        }
        let text = draw::plans(&plans, name, "").svg();
        assert!(text.contains("Σ") && text.contains("σ"));
        assert_eq!(text.contains("line of false positions"), name == "fourth_class");
        assert!(!draw::plans(&plans.only(&["C".into()]).unwrap(), name, "").svg().contains("σ"));
    }
}
