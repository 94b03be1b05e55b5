//! The half of the wrong tables with which the diagnosis was improved.

use std::f64::consts::PI;

use super::{Make, Sheet, Wrong, link};
use linkage::drive::{Course, Load};
use linkage::mechanism::{JointSide, LinkId};

const FOUR_BAR: &[&str] = &[
    "link.coupler.angle_rad",
    "link.rocker.angle_rad",
    "link.rocker.omega_rad_s",
    "link.rocker.alpha_rad_s2",
    "point.D.x_m",
    "point.D.y_m",
    "point.D.vx_m_s",
    "point.D.ax_m_s2",
    "joint.A.fx_N",
    "joint.A.fy_N",
    "joint.B.fx_N",
    "joint.B.fy_N",
    "drive.torque_N_m",
];
const MOTION: &[&str] = &["link.rocker.angle_rad", "point.D.x_m", "point.D.vx_m_s", "link.rocker.omega_rad_s"];
const ANGLES: &[&str] = &["link.crank.angle_rad", "link.coupler.angle_rad", "link.rocker.angle_rad"];
const FORCES: &[&str] = &["joint.A.fx_N", "joint.A.fy_N", "joint.B.fx_N", "joint.B.fy_N", "drive.torque_N_m"];
const PRESS: &[&str] =
    &["joint.O.fx_N", "joint.B.fx_N", "joint.B.fy_N", "joint.guide.fx_N", "joint.guide.moment_N_m", "drive.torque_N_m"];
const SHAPER: &[&str] = &["link.guide.angle_rad", "link.ram.x_m", "joint.A.fx_N", "joint.B.fy_N", "drive.torque_N_m"];
const PLACES: &[&str] = &["point.P.x_m", "point.P.y_m", "point.B.x_m", "point.B.y_m", "link.rocker.angle_rad"];

/// Moves the values of the named columns one row later; the first row keeps its values.
fn late(sheet: &mut Sheet, names: &[&str]) {
    for name in names {
        let before = sheet.of(name).clone();
        sheet.each(name, |row, _| before[row.saturating_sub(1)]);
    }
}

/// A pendulum computed with semi-implicit Euler steps of a millisecond.
fn euler(sheet: &mut Sheet) {
    let step = 1e-3;
    let (mut angle, mut omega) = (sheet.of("link.rod.angle_rad")[0], 0.0);
    let mut found = [Vec::new(), Vec::new()];
    for (row, time) in sheet.times.clone().into_iter().enumerate() {
        let steps = if row == 0 { 0 } else { ((time - sheet.times[row - 1]) / step).round() as usize };
        for _ in 0..steps {
            omega -= step * 9.80665 * 0.5 * 2.0 * f64::cos(angle) / (1.0 / 6.0 + 2.0 * 0.25);
            angle += step * omega;
        }
        found[0].push(angle);
        found[1].push(omega);
    }
    let [angles, omegas] = found;
    *sheet.of("link.rod.angle_rad") = angles;
    *sheet.of("link.rod.omega_rad_s") = omegas;
}

pub(super) const TABLES: &[Wrong] = &[
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "one component of two joints exchanged",
        make: Make::Values(|sheet| {
            let (a, b) = (sheet.of("joint.A.fx_N").clone(), sheet.of("joint.B.fx_N").clone());
            *sheet.of("joint.A.fx_N") = b;
            *sheet.of("joint.B.fx_N") = a;
        }),
        named: &["exchanged"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "degrees in one column of radians",
        make: Make::Values(|sheet| sheet.each("link.rocker.angle_rad", |_, value| value.to_degrees())),
        named: &["degrees instead of radians"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "velocities one row late",
        make: Make::Values(|sheet| late(sheet, &["link.rocker.omega_rad_s", "point.D.vx_m_s"])),
        named: &["velocities are", "differences"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "one row is an outlier",
        make: Make::Values(|sheet| sheet.each("point.D.x_m", |row, value| value + if row == 77 { 0.01 } else { 0.0 })),
        named: &["one row alone, at t = 0.0987"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "weight of one link left out",
        make: Make::Case(|parts| {
            let coupler = 2;
            let body = &parts.mechanism.links()[LinkId(coupler)];
            assert_eq!(body.name, "coupler");
            let lift = Course::Constant(9.81 * body.mass);
            let at = JointSide { link: LinkId(coupler), local: body.mass_centre };
            parts.loads.push(Load::Force { at, force: [Course::Constant(0.0), lift], follows: false });
        }),
        named: &["weight of coupler: missing"],
    },
    Wrong {
        scenario: "quick_return",
        columns: SHAPER,
        what: "gravity upwards",
        make: Make::Text(&[("y_m_s2 = -9.81", "y_m_s2 = 9.81")]),
        named: &["gravity: of the opposite sign"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "mass centre of the ram mirrored",
        make: Make::Case(|parts| link(parts, "ram", |ram| ram.mass_centre.y *= -1.0)),
        named: &["mass centre of ram, y: of the opposite sign"],
    },
    Wrong {
        scenario: "norton",
        columns: FORCES,
        what: "mass centre on the other side of the link",
        make: Make::Case(|parts| link(parts, "coupler", |own| own.mass_centre.y *= -1.0)),
        named: &["mass centre of coupler: mirrored", "mass centre of coupler, y: of the opposite sign"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "mass centre measured from the other end",
        make: Make::Case(|parts| link(parts, "rod", |rod| rod.mass_centre.x = 0.32 - rod.mass_centre.x)),
        named: &["mass centre of rod: measured from the wrong end"],
    },
    Wrong {
        scenario: "engine",
        columns: &["joint.A.fx_N", "joint.B.fx_N", "drive.torque_N_m"],
        what: "no moment of inertia of the rod",
        make: Make::Case(|parts| link(parts, "rod", |rod| rod.inertia = 0.0)),
        named: &["moment of inertia of rod: missing"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "tool force at the pin",
        make: Make::Text(&[("point = \"T\"", "point = \"B\"")]),
        named: &["load 1, force: at point B"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "speed in rpm taken for rad/s",
        make: Make::Text(&[("speed_rpm = 130", "speed_rad_s = 130")]),
        named: &["speed of the drive at O: 9.5493"],
    },
    Wrong {
        scenario: "quick_return",
        columns: &["link.block.ax_m_s2", "link.block.ay_m_s2", "link.guide.alpha_rad_s2"],
        what: "acceleration without the Coriolis term",
        make: Make::Values(|sheet| {
            let [angle, omega, speed] =
                ["link.guide.angle_rad", "link.guide.omega_rad_s", "joint.slot.slide_speed_m_s"]
                    .map(|of| sheet.right(of));
            sheet.each("link.block.ax_m_s2", |row, value| value + 2.0 * omega[row] * speed[row] * angle[row].sin());
            sheet.each("link.block.ay_m_s2", |row, value| value - 2.0 * omega[row] * speed[row] * angle[row].cos());
        }),
        named: &["the Coriolis acceleration of the block at slot is missing"],
    },
    Wrong {
        scenario: "six_bar_slider",
        columns: &["point.D.y_m", "point.D.vy_m_s", "link.rocker.omega_rad_s"],
        what: "velocity by differences of the row before and behind",
        make: Make::Values(|sheet| {
            let (y, t) = (sheet.of("point.D.y_m").clone(), sheet.times.clone());
            let last = t.len() - 1;
            sheet.each("point.D.vy_m_s", |row, _| {
                let (from, to) = (row.saturating_sub(1), last.min(row + 1));
                (y[to] - y[from]) / (t[to] - t[from])
            });
        }),
        named: &["finite differences, such as those of point.D.y_m, over the previous and the next row"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: ANGLES,
        what: "crank angle by an arc tangent of a quotient",
        make: Make::Values(|sheet| sheet.each("link.crank.angle_rad", |_, value| value.tan().atan())),
        named: &["half turns too many or too few in link.crank.angle_rad"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "clockwise crank",
        make: Make::Text(&[("speed_rpm = 130", "speed_rpm = -130")]),
        named: &["speed of the drive at O: of the opposite sign"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "the other assembly mode",
        make: Make::Text(&[("mode = \"ahead\"", "mode = \"behind\"")]),
        named: &["another configuration of rod, ram: behind"],
    },
    Wrong {
        scenario: "norton",
        columns: PLACES,
        what: "mass centre in place of a joint",
        make: Make::Values(|sheet| {
            *sheet.of("point.B.x_m") = sheet.right("link.rocker.x_m");
            *sheet.of("point.B.y_m") = sheet.right("link.rocker.y_m");
        }),
        named: &["the values of link.rocker.x_m instead of point.B.x_m", "the values of link.rocker.y_m instead of"],
    },
    Wrong {
        scenario: "norton",
        columns: PLACES,
        what: "angle of another link",
        make: Make::Values(|sheet| *sheet.of("link.rocker.angle_rad") = sheet.right("link.coupler.angle_rad")),
        named: &["the values of link.coupler.angle_rad instead of link.rocker.angle_rad"],
    },
    Wrong {
        scenario: "loaded_slider",
        columns: PRESS,
        what: "kN in one column",
        make: Make::Values(|sheet| sheet.each("joint.B.fy_N", |_, value| value / 1e3)),
        named: &["a thousand times too small, as with kg for g or kN for N"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "mm in one column",
        make: Make::Values(|sheet| sheet.each("point.D.y_m", |_, value| 1e3 * value)),
        named: &["another unit in point.D.y_m: millimetres instead of metres"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "times in milliseconds",
        make: Make::Values(|sheet| sheet.times.iter_mut().for_each(|time| *time *= 1e3)),
        named: &["milliseconds taken for seconds"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "times begin 2 ms later",
        make: Make::Values(|sheet| sheet.times.iter_mut().for_each(|time| *time += 2e-3)),
        named: &["all channels are 2 ms too late"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "sampling rate 0.1 % off",
        make: Make::Values(|sheet| sheet.times.iter_mut().for_each(|time| *time *= 1.001)),
        named: &["the clock runs too"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: FOUR_BAR,
        what: "coupler 1 % too long",
        make: Make::Text(&[("B = { x_m = 0.34707193189181", "B = { x_m = 0.3505426512108")]),
        named: &["position of B on coupler, x: 0.35054"],
    },
    Wrong {
        scenario: "quick_return",
        columns: SHAPER,
        what: "speed 1 % too high",
        make: Make::Text(&[("speed_rad_s = 10", "speed_rad_s = 10.1")]),
        named: &["speed of the drive at O1: 10.1 rad/s"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "angle that drifts in proportion to time",
        make: Make::Values(|sheet| {
            let times = sheet.times.clone();
            sheet.each("link.rocker.angle_rad", |row, value| value + 1e-3 * times[row]);
        }),
        named: &["grows with time, roughly in proportion", "`- 0.001*t`"],
    },
    Wrong {
        scenario: "pendulum",
        columns: &["link.rod.angle_rad", "link.rod.omega_rad_s"],
        what: "semi-implicit Euler steps of 1 ms",
        make: Make::Values(euler),
        named: &["integration", "too late", "too early"],
    },
    Wrong {
        scenario: "engine",
        columns: &["drive.torque_N_m"],
        what: "no mass and inertia of the rod",
        make: Make::Case(|parts| link(parts, "rod", |rod| (rod.mass, rod.inertia) = (1e-12, 0.0))),
        named: &["mass and inertia of rod: missing"],
    },
    Wrong {
        scenario: "norton",
        columns: PLACES,
        what: "all places of the step before, but in the first row",
        make: Make::Values(|sheet| {
            let names: Vec<String> = sheet.columns.iter().map(|(name, _)| name.clone()).collect();
            late(sheet, &names.iter().map(String::as_str).collect::<Vec<_>>());
        }),
        named: &["1 row too late"],
    },
    Wrong {
        scenario: "crank_rocker",
        columns: MOTION,
        what: "angular velocity in rpm, by 30 and pi the wrong way round",
        make: Make::Values(|sheet| sheet.each("link.rocker.omega_rad_s", |_, value| value * PI / 30.0)),
        named: &["rad/s taken for revolutions per minute"],
    },
];
