//! A massless slider-crank: the balancing moment of a load is -F dx/dphi in closed form.

use linkage::math::KeepNan;
use std::path::Path;

use linkage::case::Case;
use linkage::math::quadrature;
use scenario::Scenario;

use crate::common::{assert_within, states};

pub const R: f64 = 0.1;
pub const L: f64 = 0.35;
const OMEGA: f64 = 3.0;

/// Crank OA, rod AB, slider along x, without masses and gravity.
/// The rod has a point P, 0.2 m from A along the rod and 0.05 m beside it.
pub fn slider_crank(loads: &str) -> Scenario {
    let text = format!(
        "format = 1\nname = \"test\"\ntitle = \"test\"\n[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\nS = {{ x_m = 0.6, y_m = 0 }}\n\
         [links.crank.points]\nO = {{ x_m = 0, y_m = 0 }}\nA = {{ x_m = {R}, y_m = 0 }}\n\
         [links.rod.points]\nA = {{ x_m = 0, y_m = 0 }}\nB = {{ x_m = {L}, y_m = 0 }}\nP = {{ x_m = 0.2, y_m = 0.05 }}\n\
         [links.slider.points]\nB = {{ x_m = 0, y_m = 0 }}\n\
         [[joints]]\nname = \"O\"\ntype = \"revolute\"\nlinks = [\"ground\", \"crank\"]\n\
         [[joints]]\nname = \"A\"\ntype = \"revolute\"\nlinks = [\"crank\", \"rod\"]\n\
         [[joints]]\nname = \"B\"\ntype = \"revolute\"\nlinks = [\"rod\", \"slider\"]\n\
         [[joints]]\nname = \"guide\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"slider\"]\npoints = [\"O\", \"B\"]\naxis_deg = 0\n\
         [drive]\njoint = \"O\"\nspeed_rad_s = {OMEGA}\n{loads}\n\
         [start]\ncrank_rad = 0.2\n[[start.groups]]\nlinks = [\"rod\", \"slider\"]\nmode = \"ahead\"\n\
         [grid]\nfrom_deg = 0\nto_deg = 720\nstep_deg = 7.3\n[engine]\ndt_ms = 1\n"
    );
    Scenario::parse(&text, Path::new("test.toml")).unwrap_or_else(|error| panic!("{error}"))
}

/// Position of the slider, and its derivative with respect to the crank angle.
fn slide(phi: f64) -> [f64; 2] {
    let (sin, cos) = phi.sin_cos();
    let root = (L * L - R * R * sin * sin).sqrt();
    [R * cos + root, -R * sin - R * R * sin * cos / root]
}

/// Angle of the rod, and its derivative with respect to the crank angle.
fn rod(phi: f64) -> [f64; 2] {
    let sine = -R / L * phi.sin();
    [sine.asin(), -R / L * phi.cos() / (1.0 - sine * sine).sqrt()]
}

/// Checks that both solvers find the balancing moment `moment`, a function of the crank angle (rad).
/// The tolerance is the rounding error of a moment of the magnitude `size`.
fn balances(loads: &str, size: f64, moment: impl Fn(f64) -> f64) {
    let scenario = slider_crank(loads);
    let case = &scenario.case;
    for solver in analytic::all() {
        let found = states(solver, case, &case.grid.times).unwrap();
        for (state, &phi) in found.iter().zip(&case.grid.inputs) {
            let (found, expected) = (state.torques[0], moment(phi));
            assert_within!((found - expected).abs(), 1e-12 * size, "{} {phi}: {found} {expected}", solver.name());
        }
    }
}

#[test]
fn val_a_constant_force_on_the_slider() {
    balances("[[loads]]\ntype = \"force\"\nlink = \"slider\"\npoint = \"B\"\nx_kN = 0.05\ny_N = 9", 10.0, |phi| {
        -50.0 * slide(phi)[1]
    });
}

#[test]
fn val_a_force_that_follows_the_rod() {
    // The force acts at pin A, so it loads only the crank. The force points along the rod at the angle b.
    // At the crank angle phi, the moment of this force on the crank is
    // r F (cos b, sin b) . (-sin phi, cos phi) = r F sin(b - phi).
    // The balancing moment is the negative of this moment.
    let load = "[[loads]]\ntype = \"force\"\nlink = \"rod\"\npoint = \"A\"\nx_N = 20\ny_N = 0\nframe = \"link\"";
    balances(load, 10.0, |phi| -20.0 * R * (rod(phi)[0] - phi).sin());
}

#[test]
fn val_a_table_repeats_after_its_turns() {
    // The load rises linearly from 0 to 80 N in the first revolution, and falls back to 0 in the second revolution.
    let load = "[[loads]]\ntype = \"force\"\nlink = \"slider\"\npoint = \"B\"\nturns = 2\n\
                table = [{ crank_deg = 0, x_N = 0, y_N = 0 }, { crank_deg = 360, x_N = 80, y_N = 0 }]";
    balances(load, 10.0, |phi| {
        let turns = (phi / std::f64::consts::TAU).rem_euclid(2.0);
        -80.0 * (1.0 - (turns - 1.0).abs()) * slide(phi)[1]
    });
}

#[test]
fn val_a_force_against_the_motion_of_the_slider() {
    let load = "[[loads]]\ntype = \"resisting_force\"\nlink = \"slider\"\npoint = \"B\"\nforce_N = 30";
    balances(load, 10.0, |phi| {
        // At the dead points the slider is at rest, so the force has no direction and the moment is zero.
        if phi.sin().abs() < 1e-9 { 0.0 } else { 30.0 * slide(phi)[1].abs() }
    });
}

#[test]
fn val_a_moment_in_one_sense_of_rotation_only() {
    for (acts, allowed) in
        [("always", [true, true]), ("clockwise", [true, false]), ("counter-clockwise", [false, true])]
    {
        let load = format!("[[loads]]\ntype = \"moment\"\nlink = \"rod\"\nmoment_N_m = 4\nacts = \"{acts}\"");
        balances(&load, 10.0, |phi| {
            let ratio = rod(phi)[1];
            if allowed[usize::from(ratio > 0.0)] { -4.0 * ratio } else { 0.0 }
        });
    }
}

#[test]
fn val_spring_and_damper_on_the_slider() {
    let load = "[[loads]]\ntype = \"spring\"\nlinks = [\"slider\", \"ground\"]\npoints = [\"B\", \"S\"]\nstiffness_N_mm = 0.4\nfree_length_mm = 180\n\
                [[loads]]\ntype = \"damper\"\nlinks = [\"ground\", \"slider\"]\npoints = [\"S\", \"B\"]\ndamping_N_s_m = 25";
    balances(load, 10.0, |phi| {
        let [x, ratio] = slide(phi);
        -(400.0 * (0.6 - x - 0.18) - 25.0 * ratio * OMEGA) * ratio
    });
}

#[test]
fn val_torsional_spring_and_damper() {
    // A spring between ground and rod, and a damper between crank and rod.
    let load = "[[loads]]\ntype = \"torsion_spring\"\nlinks = [\"ground\", \"rod\"]\nstiffness_N_m_rad = 12\nfree_angle_deg = 30\n\
                [[loads]]\ntype = \"torsion_damper\"\nlinks = [\"rod\", \"crank\"]\ndamping_N_m_s = 0.7";
    balances(load, 10.0, |phi| {
        let [angle, ratio] = rod(phi);
        12.0 * (angle - 30f64.to_radians()) * ratio + 0.7 * OMEGA * (1.0 - ratio).powi(2)
    });
}

#[test]
fn val_a_torsional_spring_is_wound_up_turn_by_turn() {
    let load = "[[loads]]\ntype = \"torsion_spring\"\nlinks = [\"ground\", \"crank\"]\nstiffness_N_m_rad = 5\nfree_angle_deg = -10";
    balances(load, 100.0, |phi| 5.0 * (phi + 10f64.to_radians()));
}

/// Work of the balancing moment between two crank angles, by Gaussian quadrature.
fn work(case: &Case, from: f64, to: f64) -> f64 {
    let nodes = quadrature::composite(&[from, to], 0.05);
    let times: Vec<f64> = nodes.iter().map(|&(crank, _)| case.crank().time_of(crank)).collect();
    let found = states(analytic::all()[0], case, &times).unwrap();
    found.iter().zip(&nodes).map(|(state, &(_, weight))| state.torques[0] * weight).sum()
}

#[test]
fn the_work_of_the_crank_is_the_energy_of_the_springs() {
    let scenario = slider_crank(
        "[[loads]]\ntype = \"spring\"\nlinks = [\"crank\", \"slider\"]\npoints = [\"A\", \"B\"]\nstiffness_N_m = 900\nfree_length_m = 0.2\n\
         [[loads]]\ntype = \"spring\"\nlinks = [\"ground\", \"rod\"]\npoints = [\"S\", \"P\"]\nstiffness_N_m = 700\nfree_length_m = 0.45\n\
         [[loads]]\ntype = \"torsion_spring\"\nlinks = [\"crank\", \"rod\"]\nstiffness_N_m_rad = 3\nfree_angle_deg = 15",
    );
    let case = &scenario.case;
    let energy = |phi: f64| {
        let ([x, _], [angle, _]) = (slide(phi), rod(phi));
        let (sin, cos) = angle.sin_cos();
        let p = [R * phi.cos() + 0.2 * cos - 0.05 * sin, R * phi.sin() + 0.2 * sin + 0.05 * cos];
        let lengths = [L, (p[0] - 0.6).hypot(p[1])];
        assert!(x > 0.0);
        let twist = angle - phi - 15f64.to_radians();
        0.5 * (900.0 * (lengths[0] - 0.2).powi(2) + 700.0 * (lengths[1] - 0.45).powi(2) + 3.0 * twist * twist)
    };
    for (from, to) in [(0.2, 1.7), (0.2, 4.0), (1.0, 9.0)] {
        let (found, expected) = (work(case, from, to), energy(to) - energy(from));
        assert_within!((found - expected).abs(), 1e-11 * energy(to).larger(1.0), "{from} {to}: {found} {expected}");
    }
}
