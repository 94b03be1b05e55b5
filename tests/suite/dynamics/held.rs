//! Free motions that are solved, not refused.
//! The motions have loads that depend on a direction of motion, higher groups, or load tables over whole revolutions.

use analytic::range::Range;
use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid};
use linkage::drive::{Acts, Course, DriveMotion, Load};
use linkage::engine::Settings;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{JointSide, LinkId};
use linkage::trajectory::Trajectory;
use scenario::Scenario;

use super::free::{column, energies, solve, twin, worst};
use crate::common::{assert_within, shipped};

fn parsed(text: &str) -> Case {
    Scenario::parse(text, "held.toml").unwrap_or_else(|error| panic!("{error}")).case
}

fn loaded(case: &Case, loads: &[Load]) -> Case {
    case.with(|parts| parts.loads.extend(loads.iter().cloned())).unwrap()
}

/// Solves the motion with both analytic sides, and checks that they agree within `bound` of every channel's scale.
fn both(what: &str, case: &Case, bound: f64) -> [Trajectory; 2] {
    let found = [solve(&AssurSolver, case), solve(&NewtonSolver, case)];
    let apart = worst(&found[0], &found[1], |_| true);
    println!("{what}: {apart:.1e}");
    assert_within!(apart, bound, "{what}: {apart:e}");
    found
}

fn point(case: &Case, link: &str, point: &str) -> JointSide {
    let link = case.mechanism.link_named(link).unwrap();
    let own = &case.mechanism.links()[link];
    let local = own.points.iter().find(|own| own.name == point).unwrap().local;
    JointSide { link, local }
}

fn largest_change(values: &[f64]) -> f64 {
    values.iter().map(|value| (value - values[0]).abs()).fold(0.0, f64::larger)
}

/// A class III group on one crank; its dampers prevent side 1 from using the reduction to the crank.
#[test]
fn a_higher_group_moves_under_a_damper() {
    let case = shipped("ov7_new_runup.toml").case;
    let crank = case.crank().link;
    let damper = |damping| [Load::TorsionDamper { links: [LinkId(0), crank], damping }];
    let [plain, _] = both("without", &case, 1e-10);
    let [idle, _] = both("no damping", &loaded(&case, &damper(0.0)), 1e-10);
    let apart = worst(&plain, &idle, |_| true);
    assert_within!(apart, 1e-10, "{apart:e}");
    let [damped, _] = both("damped", &loaded(&case, &damper(20.0)), 1e-10);
    assert!(worst(&plain, &damped, |_| true) > 1e-3);
}

/// The class III group between two free cranks, with gravity as the only load: the energy of the mechanism is constant.
#[test]
fn a_higher_group_moves_between_two_free_cranks() {
    let text = shipped("class3_group.toml").text;
    let second = "[links.second]\nmass_kg = 0.5\nmass_centre = { x_mm = 10, y_mm = 0 }\ninertia_kg_m2 = 1e-4\n\
                  [links.second.points]\nQ = { x_mm = 0, y_mm = 0 }\nB = { x_mm = 20, y_mm = 0 }\n\n[links.lead_1]\n";
    let joint = "[[joints]]\nname = \"Q\"\ntype = \"revolute\"\nlinks = [\"ground\", \"second\"]\n\n\
                 [[joints]]\nname = \"A\"";
    let drives = "[[drive]]\njoint = \"P\"\nspeed_rad_s = 10\nmotion = \"free\"\ninitial_speed_rad_s = 6\n\
                  [[drive]]\njoint = \"Q\"\nstart_deg = 90\nspeed_rad_s = 10\nmotion = \"free\"\n\
                  initial_speed_rad_s = -9\n";
    let text = text
        .replacen("B = { x_mm = 240, y_mm = -40 }", "Q = { x_mm = 240, y_mm = -60 }", 1)
        .replacen("[links.lead_1]\n", second, 1)
        .replacen("[\"ground\", \"lead_2\"]", "[\"second\", \"lead_2\"]", 1)
        .replacen("[[joints]]\nname = \"A\"", joint, 1)
        .replacen("[drive]\njoint = \"P\"\nspeed_rad_s = 10\n", drives, 1);
    let text = format!("{}[grid]\nfrom_s = 0\nto_s = 1\nstep_s = 0.01\n", text.split("[grid]").next().unwrap());
    let case = parsed(&text);
    for found in both("two cranks", &case, 1e-10) {
        let energies = energies(&case, &found);
        let drift = largest_change(&energies) / energies[0].abs();
        assert_within!(drift, 1e-10, "{drift:e}");
    }
}

/// The pendulum winds up a torsional spring over several revolutions.
/// The spring absorbs energy in each revolution.
#[test]
fn a_spring_is_wound_up_by_a_free_motion() {
    let case = shipped("pendulum.toml").case;
    let (rod, stiffness) = (case.crank().link, 1.0);
    let case = loaded(
        &case,
        &[Load::TorsionSpring {
            links: [LinkId(0), rod],
            stiffness,
            free_angle: 0.0,
            acts: linkage::drive::Acts::Always,
        }],
    );
    let case = case.with(|parts| match &mut parts.drives.crank_mut().motion {
        DriveMotion::Free { initial_speed, .. } => *initial_speed = 25.0,
        motion @ DriveMotion::Prescribed { .. } => panic!("{motion:?}"),
    });
    let case = case.unwrap();
    for found in both("wound up", &case, 1e-10) {
        let angles = column(&found, "link.rod.angle_rad");
        let turned = angles.iter().map(|angle| angle - angles[0]).fold(0.0, f64::larger);
        assert!(turned > 2.0 * std::f64::consts::TAU, "{turned}");
        let own = energies(&case, &found);
        let whole = own.iter().zip(angles).map(|(own, twist)| own + stiffness * twist * twist / 2.0);
        let drift = largest_change(&whole.collect::<Vec<_>>());
        assert_within!(drift, 1e-9, "{drift:e}");
    }
}

/// Three load tables with a common period of 1309 revolutions do not prevent a motion of a few revolutions.
#[test]
fn tables_of_many_turns_act_on_a_free_motion() {
    let case = shipped("crank_rocker_runup.toml").case;
    let link = case.crank().link;
    let table = |turns| Course::table(&[(0.0, 1.0), (3.0, -2.0)], turns, true);
    let loads = [7, 11, 17].map(|turns| Load::Moment { link, moment: table(turns), acts: Acts::Always });
    both("tables", &loaded(&case, &loads), 1e-9);
}

/// A force against the motion of the pendulum's end has the same effect as a moment against the pendulum's rotation.
#[test]
fn a_force_against_a_point_of_a_pendulum_is_a_moment() {
    let case = shipped("pendulum.toml").case;
    let at = point(&case, "rod", "E");
    let resisted = loaded(&case, &[Load::ResistingForce { at, force: 0.7 }]);
    let by_moment = loaded(&case, &[Load::Resistance { link: at.link, moment: 0.7 }]);
    let moments = both("moment", &by_moment, 1e-11);
    for (force, moment) in both("force", &resisted, 1e-11).iter().zip(&moments) {
        for name in ["link.rod.angle_rad", "link.rod.omega_rad_s", "link.rod.alpha_rad_s2", "point.E.ax_m_s2"] {
            let (a, b) = (column(force, name), column(moment, name));
            let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::larger);
            assert_within!(apart, 1e-10, "{name}: {apart:e}");
        }
    }
}

/// Symptom: if the loaded point reversed within a step, the Rapier model kept the direction of the resisting force
/// for the whole step.
/// If the reversal came just after the start of a step, all runs had the same error, so the bound from their
/// differences was too small.
/// Moments that resist a rotation were right: in such a step, each sense of rotation counts for its share of the step.
#[test]
fn regress_a_point_reversal_in_a_step_counts_by_its_shares() {
    let case = shipped("pendulum.toml").case;
    let case = case.on(Grid::of_times(case.crank(), vec![1.0, 2.0, 2.5])).unwrap();
    let at = point(&case, "rod", "E");
    let by_force = loaded(&case, &[Load::ResistingForce { at, force: 0.7 }]);
    let by_moment = loaded(&case, &[Load::Resistance { link: at.link, moment: 0.7 }]);
    for step in [2e-3, 1.7e-3, 1.3e-3, 1e-3] {
        let engine = twin("rapier", |settings| Settings { resolution: step, extrapolated: 1, ..settings });
        let [force, moment] = [&by_force, &by_moment].map(|case| {
            let [exact, found] = [solve(&AssurSolver, case), solve(engine.as_ref(), case)];
            worst(&exact, &found, |channel| channel.to_string() == "link.rod.omega_rad_s")
        });
        println!("{step}: {force:.1e}, {moment:.1e}");
        assert_within!(force, 1e-5, "{step}: {force:e}");
    }
}

/// With two degrees of freedom, the direction of a point's motion rotates.
/// From the first instant on, the resisting force opposes the current direction.
/// The energy lost is the force times the path of the point.
#[test]
fn resisting_forces_dissipate_force_times_path() {
    let case = shipped("double_pendulum.toml").case;
    let force = 1.5;
    let resisted = loaded(&case, &[Load::ResistingForce { at: point(&case, "lower", "B"), force }]);
    let step = 5e-4;
    let fine = Grid::of_times(case.crank(), (0..=3000).map(|k| f64::from(k) * step).collect());
    let fine = resisted.on(fine).unwrap();
    for found in both("double pendulum", &fine, 1e-10) {
        let energies = energies(&fine, &found);
        let speeds: Vec<f64> = column(&found, "point.B.vx_m_s")
            .iter()
            .zip(column(&found, "point.B.vy_m_s"))
            .map(|(&x, &y)| Vec2::new(x, y).norm())
            .collect();
        let (mut taken, mut worst) = (0.0, 0.0f64);
        for row in (0..energies.len() - 2).step_by(2) {
            taken += force * step / 3.0 * (speeds[row] + 4.0 * speeds[row + 1] + speeds[row + 2]);
            worst = worst.larger((energies[row + 2] - energies[0] + taken).abs());
        }
        println!("energy: {worst:.1e} J of {taken:.2} J");
        assert!(taken > 1.0);
        assert_within!(worst, 1e-9, "{worst:e}");
    }
    let upper = case.mechanism.link_named("upper").unwrap();
    let more = [
        Load::ResistingForce { at: point(&case, "upper", "A"), force: 0.5 },
        Load::Resistance { link: upper, moment: 0.3 },
    ];
    both("several", &loaded(&resisted, &more), 1e-10);
}

/// A sufficiently large resisting force keeps the loaded point at rest from the start, and both sides report this.
#[test]
fn a_force_against_a_point_can_hold_it() {
    let case = shipped("double_pendulum.toml").case;
    let strong = loaded(&case, &[Load::ResistingForce { at: point(&case, "lower", "B"), force: 100.0 }]);
    for solver in [&AssurSolver as &dyn linkage::solver::Solver, &NewtonSolver] {
        let error = solver.solve(&strong).unwrap_err();
        assert!(error.message().contains("holds link \"lower\" at rest at t = 0.000000 s"), "{error}");
    }
}

/// A piston starts at its dead centre, where its speed and acceleration are zero.
/// From the first instant, the resisting force opposes the motion that begins.
/// The force reverses at every dead centre.
#[test]
fn a_piston_starts_from_its_dead_centre_against_a_force() {
    let case = shipped("compressor_runup.toml").case;
    let found = both("alone", &case, 1e-10);
    let resisted = loaded(&case, &[Load::ResistingForce { at: point(&case, "piston_3", "B"), force: 20.0 }]);
    let [first, _] = both("resisted", &resisted, 1e-10);
    let pin = |of: &Trajectory| column(of, "joint.O.fy_N")[0];
    assert_within!(((pin(&first) - pin(&found[0])).abs() - 20.0).abs(), 1e-6, "{} {}", pin(&first), pin(&found[0]));
}

/// The rocker starts at the end of its swing, as the piston in the previous test starts at its dead centre.
/// The resistance on the rocker cannot hold the crank in this pose.
/// The resistance acts against the motion that the rocker is about to begin.
#[test]
fn a_rocker_starts_from_its_dead_centre_against_a_moment() {
    let text = shipped("crank_rocker_runup.toml").text;
    let (crank, coupler, rocker, base) = (0.025995627740337, 0.34707193189181, 0.25, Vec2::new(0.15, 0.015));
    for (sum, turn) in [(coupler + crank, 0.0), (coupler - crank, std::f64::consts::PI)] {
        let at_pivot = ((sum * sum + base.norm_squared() - rocker * rocker) / (2.0 * sum * base.norm())).acos();
        let start = base.y.atan2(base.x) + at_pivot + turn;
        let case = parsed(&text.replacen("crank_deg = 0", &format!("crank_rad = {start:?}"), 1));
        both("reduced", &case, 1e-11);
        let damper = Load::TorsionDamper { links: [LinkId(0), case.crank().link], damping: 1e-3 };
        both("group by group", &loaded(&case, &[damper]), 1e-11);
    }
}

/// If a slide grows without bound, the links approach limit angles, and the search for these angles needs few poses.
#[test]
fn links_that_slide_to_infinity_reach_their_limit_angles() {
    let case = shipped("tangent.toml").case;
    let range = Range::of(&case).unwrap();
    let block = case.mechanism.link_named("block").unwrap();
    let own = range.links.iter().find(|own| own.link == block).unwrap();
    let turned = own.angles[LinkId(1)].value - own.angles[LinkId(0)].value;
    assert_within!((turned - std::f64::consts::PI).abs(), 1e-9, "{turned}");
    println!("{} poses", range.samples.len());
    assert!(range.samples.len() < 1000, "{}", range.samples.len());
}
