//! Transfer functions, instant centres and acceleration poles as claims.

use std::path::Path;

use super::load;
use crate::cli::tools::Place;
use crate::common::assert_within;
use formula::Rounded;
use linkage::math::KeepNan;
use linkproof::Scenario;
use prover::run::solved::Solved;
use scenario::Claim;

fn scenario(name: &str) -> Scenario {
    load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios").join(format!("{name}.toml")))
}

/// For each instant of the scenario's grid, the values of some claims; NaN where a claim is undefined.
fn values(scenario: &Scenario, claims: &[&str]) -> Vec<Vec<f64>> {
    let parsed: Vec<Claim> = claims.iter().map(|text| Claim::parse(text, &scenario.case).unwrap()).collect();
    let solved = Solved::of(scenario, scenario.case.grid.clone(), &parsed).unwrap();
    let columns: Vec<Vec<f64>> = solved
        .on_course(|course| {
            let number = |own: Rounded| if own.error.is_finite() { own.value } else { f64::NAN };
            let of = |claim| Ok(course.values(claim)?.into_iter().map(number).collect());
            parsed.iter().map(of).collect()
        })
        .unwrap();
    (0..columns[0].len()).map(|row| columns.iter().map(|column| column[row]).collect()).collect()
}

/// Transfer functions depend on the pose only: they are equal at constant speed and during a run-up.
#[test]
fn transfer_functions_do_not_depend_on_the_motion() {
    let asked =
        ["link.rocker.dangle_dphi", "link.coupler.d2angle_dphi2", "point.B.dx_dphi_m", "link.coupler.d2y_dphi2_m"];
    let text = std::fs::read_to_string("scenarios/crank_rocker.toml").unwrap();
    let at = |drive: &str| {
        let changed = text.replacen("speed_rpm = 130", drive, 1);
        let changed = Scenario::parse(&changed, Path::new("scenarios/crank_rocker.toml")).unwrap();
        values(&changed, &asked)
    };
    let [slow, fast] = ["speed_rpm = 13", "speed_rpm = 700"].map(at);
    let ramp = at("law = \"ramp\"\ntime_s = 2\nspeed_rad_s = 9");
    assert!(slow.len() == ramp.len() && slow.len() == fast.len() && slow.len() > 300);
    // The ramp begins at rest, where transfer functions are undefined.
    assert!(ramp[0].iter().all(|value| value.is_nan()), "{:?}", ramp[0]);
    for ((slow, fast), ramp) in slow.iter().zip(&fast).zip(&ramp).skip(1) {
        for (k, ((slow, fast), ramp)) in slow.iter().zip(fast).zip(ramp).enumerate() {
            assert_within!((slow - fast).abs(), 1e-10, "{} {slow} {fast}", asked[k]);
            assert_within!((slow - ramp).abs(), 1e-10, "{} {slow} {ramp}", asked[k]);
        }
    }
}

/// Central differences of positions over the crank angle give the first transfer functions.
/// Central differences of the first transfer functions give the second transfer functions.
/// The error of the differences is of second order in the step of 1 deg.
#[test]
fn transfer_functions_are_derivatives_by_the_crank_angle() {
    let asked = [
        "link.coupler.angle_rad",
        "link.coupler.dangle_dphi",
        "link.coupler.d2angle_dphi2",
        "point.B.x_mm",
        "point.B.dx_dphi_mm",
        "point.B.d2x_dphi2_mm",
    ];
    let rows = values(&scenario("crank_rocker"), &asked);
    let step = 1f64.to_radians();
    for three in rows.windows(3) {
        for own in [0, 1, 3, 4] {
            let slope = (three[2][own] - three[0][own]) / (2.0 * step);
            let size = if own < 3 { 1.0 } else { 100.0 };
            assert_within!((slope - three[1][own + 1]).abs(), 2e-3 * size, "{}: {slope}", asked[own + 1]);
        }
    }
}

/// By the theorem of three centres, the centre of coupler and ground lies on the lines of crank and rocker.
/// By the same theorem, the centre of crank and rocker lies on the line of the coupler and on the line of the ground.
/// At the acceleration pole of the coupler, the acceleration is zero.
#[test]
fn instant_centres_obey_the_theorem_of_three_centres() {
    let centres = [
        "centre.ground.coupler.x_m",
        "centre.ground.coupler.y_m",
        "centre.crank.rocker.x_m",
        "centre.rocker.crank.y_m",
        "centre.crank.ground.x_mm",
        "centre.crank.ground.y_mm",
    ];
    let points = ["point.A.x_m", "point.A.y_m", "point.B.x_m", "point.B.y_m"];
    let asked: Vec<&str> = centres.into_iter().chain(points).collect();
    let [c, d] = [[0.15, 0.015], [0.0, 0.0]];
    let mut judged = 0;
    for row in values(&scenario("crank_rocker"), &asked) {
        let [p, q, a, b] = [[row[0], row[1]], [row[2], row[3]], [row[6], row[7]], [row[8], row[9]]];
        let off = |line: [[f64; 2]; 2], at: [f64; 2]| {
            let [[x, y], [u, v]] = line;
            ((u - x) * (at[1] - y) - (v - y) * (at[0] - x)) / (u - x).hypot(v - y) / at[0].hypot(at[1]).larger(1.0)
        };
        assert_within!(row[4].hypot(row[5]), 1e-9, "{row:?}");
        // If crank and rocker have nearly equal angular velocities, their centre is far away.
        if row.iter().any(|value| value.abs() > 1e3) {
            continue;
        }
        judged += 1;
        for (line, at) in [([d, a], p), ([c, b], p), ([d, c], q), ([a, b], q)] {
            assert_within!(off(line, at).abs(), 1e-11, "{line:?} {at:?}");
        }
    }
    assert!(judged > 300, "{judged}");
    let asked = [
        "pole.coupler.x_m",
        "pole.coupler.y_m",
        "link.coupler.x_m",
        "link.coupler.y_m",
        "link.coupler.ax_m_s2",
        "link.coupler.ay_m_s2",
        "link.coupler.omega_rad_s",
        "link.coupler.alpha_rad_s2",
    ];
    for row in values(&scenario("crank_rocker"), &asked) {
        let [x, y] = [row[0] - row[2], row[1] - row[3]];
        let square = row[6] * row[6];
        let [ax, ay] = [row[4] - row[7] * y - square * x, row[5] + row[7] * x - square * y];
        assert_within!(ax.hypot(ay), 1e-11 * row[4].hypot(row[5]), "{row:?}");
    }
}

/// If the input is a slide, transfer functions are derivatives with respect to the slide.
#[test]
fn a_slide_may_be_the_input() {
    let scenario = scenario("boom_lift");
    let joint = &scenario.case.mechanism.joints()[scenario.case.crank().joint].name;
    let asked = [format!("joint.{joint}.dslide_dphi_m"), format!("joint.{joint}.d2slide_dphi2_mm")];
    let rows = values(&scenario, &asked.each_ref().map(String::as_str));
    let moving: Vec<_> = rows.iter().filter(|row| !row[0].is_nan()).collect();
    assert!(moving.len() > 10, "{}", moving.len());
    for row in moving {
        assert_within!((row[0] - 1.0).abs() + row[1].abs(), 1e-9, "{row:?}");
    }
}

#[test]
fn names_that_do_not_exist_are_refused_with_the_nearest() {
    let place = Place::new();
    for (channel, nearest) in [
        ("link.rocker.dangle_dph", "link.rocker.dangle_dphi"),
        ("point.B.dz_dphi_m", "point.B.dx_dphi_m"),
        ("centre.crank.rokcer.x_m", "centre.crank.rocker.x_m"),
        ("centre.crank.crank.x_m", "no channel centre.crank.crank.x_m"),
        ("pole.ground.x_m", "no channel pole.ground.x_m"),
    ] {
        place.refused(&format!("check scenarios/crank_rocker.toml 1 --channel {channel}"), &[nearest]);
    }
    place.refused("check scenarios/five_bar.toml 1 --channel link.rod_1.dangle_dphi", &["2 drives"]);
}
