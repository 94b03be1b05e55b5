//! The half of the wrong tables that was tried only after the diagnosis had been improved with the first half.

use super::{Make, Sheet, Wrong, link};

const FOUR_BAR: &[&str] = &[
    "link.rocker.angle_rad",
    "link.rocker.omega_rad_s",
    "link.rocker.alpha_rad_s2",
    "point.D.x_m",
    "point.D.vx_m_s",
    "point.D.vy_m_s",
    "point.D.ax_m_s2",
    "joint.O.fx_N",
    "joint.A.fx_N",
    "joint.B.fy_N",
    "drive.torque_N_m",
];
const MOTION: &[&str] = &["link.rocker.angle_rad", "point.D.x_m", "point.D.y_m", "point.D.vx_m_s"];
const FORCES: &[&str] = &["joint.O2.fx_N", "joint.A.fx_N", "joint.B.fy_N", "drive.torque_N_m"];
const PLACES: &[&str] = &["point.P.x_m", "point.P.y_m", "point.B.x_m", "link.coupler.angle_rad"];
const PRESS: &[&str] =
    &["joint.B.fx_N", "joint.B.fy_N", "joint.guide.fx_N", "joint.guide.moment_N_m", "drive.torque_N_m"];
const SHAPER: &[&str] = &["link.guide.angle_rad", "link.guide.omega_rad_s", "joint.B.fy_N", "drive.torque_N_m"];
const SIX_BAR: &[&str] = &["point.D.y_m", "joint.C.fx_N", "joint.D.fy_N", "drive.torque_N_m"];
const ENGINE: &[&str] = &["joint.O.fy_N", "joint.A.fx_N", "joint.B.fx_N", "drive.torque_N_m"];
const PENDULUM: &[&str] = &["link.rod.angle_rad", "link.rod.omega_rad_s"];

/// A pendulum computed with Runge-Kutta steps of 20 ms, which are too large.
fn runge_kutta(sheet: &mut Sheet) {
    let step = 0.02;
    let rate = |[angle, omega]: [f64; 2]| [omega, -9.80665 * f64::cos(angle) / (1.0 / 6.0 + 0.5)];
    let plus = |one: [f64; 2], factor: f64, other: [f64; 2]| [one[0] + factor * other[0], one[1] + factor * other[1]];
    let mut state = [sheet.of("link.rod.angle_rad")[0], 0.0];
    let mut found = [Vec::new(), Vec::new()];
    for row in 0..sheet.times.len() {
        // Every second row lies between two steps, so the state advances only at the remaining rows.
        if row > 0 && row % 2 == 0 {
            let first = rate(state);
            let second = rate(plus(state, step / 2.0, first));
            let third = rate(plus(state, step / 2.0, second));
            let fourth = rate(plus(state, step, third));
            let sum = plus(plus(first, 2.0, second), 1.0, plus(fourth, 2.0, third));
            state = plus(state, step / 6.0, sum);
        }
        found.iter_mut().zip(state).for_each(|(column, value)| column.push(value));
    }
    let keep = |values: &[f64]| values.iter().copied().step_by(2).collect::<Vec<f64>>();
    sheet.times = keep(&sheet.times);
    let [angles, omegas] = found;
    *sheet.of("link.rod.angle_rad") = keep(&angles);
    *sheet.of("link.rod.omega_rad_s") = keep(&omegas);
}

pub(super) const TABLES: &[Wrong] = &[
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "force on the other body in one component",
        make: Make::Values(|sheet| sheet.each("joint.B.fy_N", |_, value| -value)),
        named: &["the opposite sign of joint.B.fy_N"],
    },
    Wrong {
        scenario: "quick_return",
        columns: SHAPER,
        what: "gravity along x",
        make: Make::Text(&[("x_m_s2 = 0\ny_m_s2 = -9.81", "x_m_s2 = 9.81\ny_m_s2 = 0")]),
        named: &["gravity: turned by 90 deg"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "force of the next joint",
        make: Make::Values(|sheet| *sheet.of("joint.O.fx_N") = sheet.right("joint.A.fx_N")),
        named: &["the values of joint.A.fx_N instead of joint.O.fx_N"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "free length of the spring in cm",
        make: Make::Text(&[("free_length_mm = 60", "free_length_mm = 6")]),
        named: &["free length of load 2, spring: 0.006 m instead of 0.06 m"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "mm/s in one column",
        make: Make::Values(|sheet| sheet.each("point.D.vy_m_s", |_, value| 1e3 * value)),
        named: &["another unit in point.D.vy_m_s: millimetres instead of metres"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "tangential acceleration only",
        make: Make::Values(|sheet| {
            let (angle, omega) = (sheet.right("link.rocker.angle_rad"), sheet.right("link.rocker.omega_rad_s"));
            let arm = 1.0 / 3.0;
            sheet.each("point.D.ax_m_s2", |row, value| value + arm * omega[row].powi(2) * angle[row].cos());
        }),
        named: &["omega(rocker)^2*cos(rocker)"],
    },
    Wrong {
        scenario: "quick_return",
        columns: &["link.ram.x_m", "link.ram.ax_m_s2", "joint.C.fx_N"],
        what: "second differences over two rows",
        make: Make::Values(|sheet| {
            let (x, t) = (sheet.of("link.ram.x_m").clone(), sheet.times.clone());
            let last = t.len() - 3;
            sheet.each("link.ram.ax_m_s2", |row, _| {
                let row = row.clamp(2, last);
                (x[row + 2] - 2.0 * x[row] + x[row - 2]) / (t[row + 2] - t[row]).powi(2)
            });
        }),
        named: &["second finite differences, such as those of link.ram.x_m, over 2 rows before and after"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "velocity from the row before",
        make: Make::Values(|sheet| {
            let (x, t) = (sheet.of("point.D.x_m").clone(), sheet.times.clone());
            sheet.each("point.D.vx_m_s", |row, _| (x[row.max(1)] - x[row.max(1) - 1]) / (t[1] - t[0]));
        }),
        named: &["finite differences, such as those of point.D.x_m, over the row and the previous one"],
    },
    Wrong {
        scenario: "norton",
        columns: &["link.crank.angle_rad", "link.coupler.angle_rad", "point.P.x_m"],
        what: "angle by an arc cosine",
        make: Make::Values(|sheet| sheet.each("link.crank.angle_rad", |_, value| value.cos().acos())),
        named: &["the sign of link.crank.angle_rad is lost"],
    },
    Wrong {
        scenario: "six_bar_slider",
        columns: SIX_BAR,
        what: "one link too heavy by a tenth",
        make: Make::Case(|parts| link(parts, "rod_4", |own| own.mass *= 1.1)),
        named: &["mass of rod_4: 2.2 kg"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "moment at the motor, before the reducer",
        make: Make::Values(|sheet| sheet.each("drive.torque_N_m", |_, value| value / 21.115384615384617)),
        named: &["at the motor's shaft, before the reducer"],
    },
    Wrong {
        scenario: "norton",
        columns: FORCES,
        what: "load upwards",
        make: Make::Text(&[("y_N = -355.9", "y_N = 355.9")]),
        named: &["load 1, force: of the opposite sign"],
    },
    Wrong {
        scenario: "norton",
        columns: FORCES,
        what: "load in kiloponds",
        make: Make::Text(&[("y_N = -355.9", "y_N = -36.291700")]),
        named: &["load 1, force: 0.101972 "],
    },
    Wrong {
        scenario: "norton",
        columns: FORCES,
        what: "load at the pin",
        make: Make::Text(&[("point = \"P\"", "point = \"B\"")]),
        named: &["load 1, force: at point B"],
    },
    Wrong {
        scenario: "six_bar_slider",
        columns: SIX_BAR,
        what: "moment of inertia about the pin",
        make: Make::Case(|parts| link(parts, "rocker", |own| own.inertia += own.mass * 0.15 * 0.15)),
        named: &["moment of inertia of rocker: taken about joint"],
    },
    Wrong {
        scenario: "quick_return",
        columns: SHAPER,
        what: "gravity of 10 m/s^2",
        make: Make::Text(&[("y_m_s2 = -9.81", "y_m_s2 = -10")]),
        named: &["gravity: 10 m/s²"],
    },
    Wrong {
        scenario: "crank_rocker_runup",
        columns: &["link.crank.angle_rad", "link.crank.omega_rad_s", "joint.B.fx_N"],
        what: "run-up without the load",
        make: Make::Text(&[("moment_N_m = 100", "moment_N_m = 0")]),
        named: &["load 1, resistance: missing"],
    },
    Wrong {
        scenario: "pendulum",
        columns: PENDULUM,
        what: "rod as a point mass",
        make: Make::Text(&[("inertia_kg_m2 = 0.16666666666666666", "inertia_kg_m2 = 0")]),
        named: &["moment of inertia of rod: missing"],
    },
    Wrong {
        scenario: "pendulum",
        columns: PENDULUM,
        what: "start 1 deg lower",
        make: Make::Text(&[("crank_deg = 150", "crank_deg = 149")]),
        named: &["angle of the drive at O at t = 0: 149 deg"],
    },
    Wrong {
        scenario: "pendulum",
        columns: PENDULUM,
        what: "Runge-Kutta steps of 20 ms",
        make: Make::Values(runge_kutta),
        named: &["integration"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "noise of a measurement",
        make: Make::Values(|sheet| {
            let noise = |row: usize| ((row as f64 * 12.9898).sin() * 43758.5453).fract();
            for name in MOTION {
                sheet.each(name, |row, value| value + 1e-5 * noise(row));
            }
        }),
        named: &["noise"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: &["frame.fx_N", "frame.fy_N", "frame.moment_N_m"],
        what: "shaking moment about the other pin",
        make: Make::Values(|sheet| {
            let (x, y) = (sheet.right("frame.fx_N"), sheet.right("frame.fy_N"));
            sheet.each("frame.moment_N_m", |row, value| value - 0.15 * y[row] + 0.015 * x[row]);
        }),
        named: &["frame.moment_N_m taken about another point, (0.15, 0.015) m away"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "moment of the guide about the tool",
        make: Make::Values(|sheet| {
            let (x, y) = (sheet.right("joint.guide.fx_N"), sheet.right("joint.guide.fy_N"));
            let arm = |of: &str| -> Vec<f64> {
                let (to, from) = (sheet.right(&format!("point.T.{of}")), sheet.right(&format!("point.B.{of}")));
                to.iter().zip(from).map(|(to, from)| to - from).collect()
            };
            let [right, up] = ["x_m", "y_m"].map(arm);
            sheet.each("joint.guide.moment_N_m", |row, value| value - right[row] * y[row] + up[row] * x[row]);
        }),
        named: &["joint.guide.moment_N_m taken about"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "place counted from the rocker's pin",
        make: Make::Values(|sheet| sheet.each("point.D.x_m", |_, value| value - 0.15)),
        named: &["-0.15 m added at every instant to point.D.x_m"],
    },
    Wrong {
        scenario: "norton",
        columns: PLACES,
        what: "place relative to the crank pin",
        make: Make::Values(|sheet| {
            let (x, y) = (sheet.right("point.A.x_m"), sheet.right("point.A.y_m"));
            sheet.each("point.P.x_m", |row, value| value - x[row]);
            sheet.each("point.P.y_m", |row, value| value - y[row]);
        }),
        named: &["point.P.x_m minus point.A.x_m", "point.P.y_m minus point.A.y_m"],
    },
    Wrong {
        scenario: "norton",
        columns: PLACES,
        what: "three rows late",
        make: Make::Values(|sheet| {
            let step = sheet.times[1];
            sheet.times.iter_mut().for_each(|time| *time += 3.0 * step);
        }),
        named: &["3 rows too late"],
    },
    Wrong {
        scenario: "quick_return",
        columns: SHAPER,
        what: "size of an angular velocity",
        make: Make::Values(|sheet| sheet.each("link.guide.omega_rad_s", |_, value| value.abs())),
        named: &["the sign of link.guide.omega_rad_s is lost"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "deg/s^2 in one column",
        make: Make::Values(|sheet| sheet.each("link.rocker.alpha_rad_s2", |_, value| value.to_degrees())),
        named: &["another unit in link.rocker.alpha_rad_s2: degrees instead of radians"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "moment of inertia in g m^2",
        make: Make::Text(&[("inertia_kg_m2 = 0.8356", "inertia_kg_m2 = 835.6")]),
        named: &["moment of inertia of coupler: 1000 times"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "damper as strong as two",
        make: Make::Text(&[("damping_N_s_m = 150", "damping_N_s_m = 300")]),
        named: &["load 3, damper: counted twice"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "statics only",
        make: Make::Case(|parts| {
            let mut weights = Vec::new();
            for (link, body) in parts.mechanism.links().entries().skip(1) {
                let at = linkage::mechanism::JointSide { link, local: body.mass_centre };
                let force = [0.0, -9.81 * body.mass].map(linkage::drive::Course::Constant);
                weights.push(linkage::drive::Load::Force { at, force, follows: false });
            }
            parts.loads.extend(weights);
            for name in ["crank", "coupler", "rocker"] {
                link(parts, name, |own| (own.mass, own.inertia) = (0.0, 0.0));
            }
        }),
        named: &["inertia forces of all links: missing"],
    },
    Wrong {
        scenario: "engine",
        columns: ENGINE,
        what: "gas force a turn late",
        make: Make::Values(|sheet| {
            let half = sheet.times.len() / 2;
            let columns: Vec<String> = sheet.columns.iter().map(|(name, _)| name.clone()).collect();
            for name in columns {
                let own = sheet.of(&name).clone();
                sheet.each(&name, |row, _| own[(row + half) % (2 * half)]);
            }
        }),
        named: &["all channels are"],
    },
    Wrong {
        scenario: "engine",
        columns: ENGINE,
        what: "rod as two masses",
        make: Make::Case(|parts| link(parts, "rod", |own| own.inertia = 0.8 * 0.045 * 0.110)),
        named: &["moment of inertia of rod: 0.00396 kg·m²"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: &["link.rocker.omega_rad_s", "point.D.vx_m_s", "point.D.x_m"],
        what: "first row at rest",
        make: Make::Values(|sheet| {
            for name in ["link.rocker.omega_rad_s", "point.D.vx_m_s"] {
                sheet.each(name, |row, value| if row == 0 { 0.0 } else { value });
            }
        }),
        named: &["one row alone, at t = 0 s"],
    },
];
