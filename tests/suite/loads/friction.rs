//! Friction in joints: closed forms, the limits of self-locking, both analytic sides compared with each other, and
//! motions under forces.

use std::path::Path;

use linkage::case::Case;
use linkage::drive::Load;
use linkage::error::ErrorKind;
use linkage::math::KeepNan;
use linkage::solver::Solver;
use scenario::Scenario;

use super::closed_form::{L, R, slider_crank};
use crate::common::{assert_within, shipped, states};

/// Coefficient of friction of the wedge.
const MU: f64 = 0.1;

fn load(text: &str) -> Case {
    Scenario::parse(text, Path::new("test.toml")).unwrap_or_else(|error| panic!("{error}")).case
}

/// Friction in the guide of a massless slider-crank. With the rod at the angle beta to the guide and the force P along
/// the guide, the rod's force q satisfies q cos(beta) -+ mu |q| |sin(beta)| = -P.
#[test]
fn val_friction_of_a_guide_on_a_slider_crank() {
    let (mu, force) = (0.2, -50.0);
    let friction = format!("[[loads]]\ntype = \"friction\"\njoint = \"guide\"\ncoefficient = {mu}\n");
    let text =
        format!("[[loads]]\ntype = \"force\"\nlink = \"slider\"\npoint = \"B\"\nx_N = {force}\ny_N = 0\n{friction}");
    let case = slider_crank(&text).case;
    for solver in analytic::all() {
        let found = states(solver, &case, &case.grid.times).unwrap();
        for (state, &phi) in found.iter().zip(&case.grid.inputs) {
            let (sin, cos) = phi.sin_cos();
            let sine = -R / L * sin;
            let cosine = (1.0 - sine * sine).sqrt();
            let speed = -R * sin + R * cos * sine / cosine;
            let q = -force / (cosine - speed.signum() * mu * sine.abs());
            let torque = q * R * (cos * sine - sin * cosine);
            assert_within!((state.torques[0] - torque).abs(), 1e-12 * 10.0, "{} {phi}", solver.name());
        }
    }
}

/// A lever that lifts a weight: the reaction of its journal is the weight, so that T = F (l + mu r).
#[test]
fn val_friction_of_a_journal_on_a_lever() {
    let (l, r, mu, weight) = (0.25, 0.03, 0.3, 40.0);
    let text = format!(
        "format = 1\nname = \"lever\"\ntitle = \"t\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\n\
         [links.lever.points]\nO = {{ x_m = 0, y_m = 0 }}\nA = {{ x_m = {l}, y_m = 0 }}\n\
         [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"lever\"]\n\
         [drive]\njoint = \"O\"\nspeed_rad_s = 1\n[start]\ncrank_deg = 0\n\
         [[loads]]\ntype = \"force\"\nlink = \"lever\"\npoint = \"A\"\nx_N = 0\ny_N = -{weight}\n\
         [[loads]]\ntype = \"friction\"\njoint = \"O\"\ncoefficient = {mu}\nradius_m = {r}\n\
         [grid]\nfrom_deg = 0\nto_deg = 0\nstep_deg = 1\n"
    );
    let case = load(&text);
    for solver in analytic::all() {
        let torque = states(solver, &case, &[0.0]).unwrap()[0].torques[0];
        assert_within!((torque - weight * (l + mu * r)).abs(), 1e-13 * weight, "{}", solver.name());
    }
}

/// A wedge of the angle `angle` (deg) on a floor under a follower in a vertical guide, with friction in all three
/// contacts. A force `force` (N) acts on the part that is not driven: down on the follower, or against the wedge.
fn wedge(angle: f64, by_wedge: bool, speed: f64, force: f64) -> Case {
    let (joint, start) = if by_wedge { ("floor", 100) } else { ("guide", 50) };
    let (link, point) = if by_wedge { ("follower", "P") } else { ("wedge", "W") };
    let (x, y) = if by_wedge { (0.0, -force) } else { (-force, 0.0) };
    let axis = 180.0 - angle;
    let friction = ["floor", "guide", "face"]
        .map(|joint| format!("[[loads]]\ntype = \"friction\"\njoint = \"{joint}\"\ncoefficient = {MU}\n"));
    load(&format!(
        "format = 1\nname = \"wedge\"\ntitle = \"t\"\n[ground.points]\nF = {{ x_mm = 0, y_mm = 0 }}\nG = {{ x_mm = 300, y_mm = 0 }}\n\
         [links.wedge.points]\nW = {{ x_mm = 0, y_mm = 0 }}\n[links.follower.points]\nP = {{ x_mm = 0, y_mm = 0 }}\n\
         [links.shoe.points]\nP = {{ x_mm = 0, y_mm = 0 }}\n\
         [[joints]]\nname = \"floor\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"wedge\"]\npoints = [\"F\", \"W\"]\naxis_deg = 0\n\
         [[joints]]\nname = \"guide\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"follower\"]\npoints = [\"G\", \"P\"]\naxis_deg = 90\n\
         second_axis_deg = 90\n\
         [[joints]]\nname = \"face\"\ntype = \"prismatic\"\nlinks = [\"wedge\", \"shoe\"]\npoints = [\"W\", \"P\"]\naxis_deg = {axis}\n\
         [[joints]]\nname = \"P\"\ntype = \"revolute\"\nlinks = [\"shoe\", \"follower\"]\n\
         [drive]\njoint = \"{joint}\"\nspeed_mm_s = {speed}\nstart_mm = {start}\n[start]\n\
         [[loads]]\ntype = \"force\"\nlink = \"{link}\"\npoint = \"{point}\"\nx_N = {x}\ny_N = {y}\n{}\
         [grid]\nfrom_s = 0\nto_s = 1\nstep_s = 0.5\n",
        friction.concat()
    ))
}

/// With the angle of friction phi in all three contacts, a wedge lifts with F = Q tan(alpha + 2 phi): J. L. Meriam,
/// L. G. Kraige, Engineering Mechanics: Statics, 7th ed., Wiley 2012, section 6/4.
#[test]
fn val_a_wedge_lifts_with_the_tangent_of_its_angle_and_twice_that_of_friction() {
    let phi = MU.atan();
    for angle in [5.0f64, 15.0, 40.0] {
        for solver in analytic::all() {
            let case = wedge(angle, true, 10.0, 1000.0);
            let lifting = states(solver, &case, &case.grid.times).unwrap();
            let wanted = 1000.0 * (angle.to_radians() + 2.0 * phi).tan();
            for state in lifting {
                assert_within!((state.torques[0] - wanted).abs(), 1e-11 * wanted, "{} {angle}", solver.name());
            }
        }
    }
}

/// Driven by its follower, the wedge moves only if its angle alpha exceeds 2 phi. The force is then
/// F = P / tan(alpha - 2 phi). Below 2 phi no force moves the wedge.
/// If P pulls instead of pushing, the equations have several solutions below 2 phi, so the forces are undetermined.
#[test]
fn val_a_wedge_locks_below_twice_the_angle_of_friction() {
    let limit = 2.0 * MU.atan();
    for beyond in [1e-4, 0.01, 0.1] {
        let angle = limit + beyond;
        for solver in analytic::all() {
            let case = wedge(angle.to_degrees(), false, 10.0, 100.0);
            let driven = states(solver, &case, &case.grid.times).unwrap();
            let wanted = 100.0 / beyond.tan();
            // With respect to the angle, the force has the condition number alpha / (alpha - 2 phi).
            let bound = 1e-13 * wanted * angle / beyond;
            assert_within!((driven[1].torques[0] - wanted).abs(), bound, "{} {beyond}", solver.name());
        }
        let case = |force| wedge((limit - beyond).to_degrees(), false, 10.0, force);
        for solver in analytic::all() {
            let error = states(solver, &case(100.0), &[0.5]).unwrap_err();
            assert!(error.kind() == ErrorKind::Numeric && error.message().contains("friction locks"), "{error}");
            assert!(error.input().is_some(), "{error}");
        }
        let error = states(&analytic::AssurSolver, &case(-100.0), &[0.5]).unwrap_err();
        assert!(error.message().contains("several states"), "{error}");
    }
}

/// Largest difference of two solvers in any channel, divided by the largest value of all channels with the same unit.
pub(super) fn apart(case: &Case, solvers: [&dyn Solver; 2]) -> f64 {
    let [a, b] = solvers.map(|solver| solver.solve(case).unwrap());
    let largest = |unit: &str| {
        let own = a.channels().iter().filter(|channel| channel.kind.unit.symbol() == unit);
        let values = own.flat_map(|channel| a.column(channel).unwrap());
        values.fold(0.0f64, |most, value| most.larger(value.abs()))
    };
    a.channels().iter().fold(0.0, |worst: f64, channel| {
        let [a, b] = [&a, &b].map(|own| own.column(channel).unwrap());
        let gap = a.iter().zip(b).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs()));
        worst.larger(gap / largest(channel.kind.unit.symbol()))
    })
}

#[test]
fn both_sides_agree_with_friction_in_every_joint() {
    let press = shipped("slider_crank_friction.toml").case;
    let text = include_str!("../../outside/scenarios/friction_in_a_shaper.toml");
    for case in [press, load(text)] {
        assert_within!(
            apart(&case, [&analytic::AssurSolver, &analytic::NewtonSolver]),
            1e-11,
            "{:?}",
            case.loads.len()
        );
    }
}

/// A coefficient of friction that is off by a thousandth changes the driving moment by more than 1e-5 of its value.
/// A coefficient with the wrong sign has the same effect.
#[test]
fn a_coefficient_off_by_a_thousandth_is_seen_and_its_sign_too() {
    let case = shipped("slider_crank_friction.toml").case;
    let torque = |case: &Case| states(&analytic::NewtonSolver, case, &[0.1]).unwrap()[0].torques[0];
    for factor in [1.001, -1.0] {
        let off = case.with(|parts| {
            for load in &mut parts.loads {
                if let Load::Friction { coefficient, .. } = load {
                    *coefficient *= factor;
                }
            }
        });
        assert!((torque(&off.unwrap()) / torque(&case) - 1.0).abs() > 1e-5, "{factor}");
    }
}

/// A swinging rod with friction in its journal loses the energy that the friction dissipates.
#[test]
fn friction_of_a_swinging_rod_takes_its_energy() {
    let rod = shipped("pendulum.toml").case;
    let case = rod.with(|parts| {
        let ends = &parts.mechanism.joints()[linkage::mechanism::JointId(0)];
        let links = [ends.first.link, ends.second.link];
        parts.loads.push(Load::Friction {
            joint: linkage::mechanism::JointId(0),
            links,
            coefficient: 0.2,
            length: 0.02,
        });
    });
    let case = case.unwrap();
    let times: Vec<f64> = (0..=3000).map(|k| f64::from(k) * 1e-3).collect();
    for solver in analytic::all() {
        let found = states(solver, &case, &times).unwrap();
        let (body, own) = (&case.mechanism.links()[linkage::mechanism::LinkId(1)], linkage::mechanism::LinkId(1));
        let energy = |state: &linkage::solver::State| {
            let motion = &state.motions[own];
            let (v, place) = (motion.point_velocity(body.mass_centre), motion.point(body.mass_centre));
            0.5 * (body.mass * v.norm_squared() + body.inertia * motion.omega * motion.omega)
                - body.mass * case.gravity.dot(&place)
        };
        let power: Vec<f64> =
            found.iter().map(|state| case.load_power(&state.motions, &state.angles, state.reactions())).collect();
        let spent: f64 = power.windows(2).map(|pair| 0.5e-3 * (pair[0] + pair[1])).sum();
        let lost = energy(&found[3000]) - energy(&found[0]);
        // Friction jumps where the rod reverses, but its power is zero there, so the trapezium rule keeps its order 2.
        assert_within!((lost - spent).abs(), 1e-5 * lost.abs(), "{}: {lost} {spent}", solver.name());
        assert!(lost < -1.0, "{lost}");
    }
}
