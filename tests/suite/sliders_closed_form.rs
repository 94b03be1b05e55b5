//! Shipped mechanisms with sliders, and the class III group of a published paper, against published and textbook closed
//! forms.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::common::{assert_within, shipped, states};
use analytic::all;
use analytic::range::Range;
use linkage::case::{Case, Grid};
use linkage::math::{KeepNan, Matrix, Vec2, unit};
use linkage::solver::State;

/// States of both analytic solvers at every instant of the grid, with the crank angles.
fn solved(case: &Case) -> Vec<Vec<(f64, State)>> {
    let states_of = |&solver: &&'static dyn linkage::solver::Solver| {
        let found = states(solver, case, &case.grid.times).unwrap();
        case.grid.inputs.iter().copied().zip(found).collect()
    };
    all().iter().map(states_of).collect()
}

/// Largest difference in a series of pairs, divided by the largest value of the series.
fn relative(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (error, size) = pairs.fold((0.0f64, 0.0f64), |(error, size), (found, expected)| {
        (error.larger((found - expected).abs()), size.larger(expected.abs()))
    });
    error / size
}

fn place(case: &Case, state: &State, name: &str) -> [Vec2; 3] {
    let (_, side) = case.mechanism.moving_points().find(|&(point, _)| point == name).unwrap();
    let motion = &state.motions[side.link];
    [motion.point(side.local), motion.point_velocity(side.local), motion.point_acceleration(side.local)]
}

/// One cylinder in the authors' notation, with angles clockwise from +y: phi2, l3, omega2, v3, eps2, a3.
fn cylinder(l1: f64, l2: f64, phi1: f64, omega1: f64) -> [f64; 6] {
    let phi2 = -(l1 * phi1.sin() / l2).asin();
    let l3 = l1 * phi1.cos() + l2 * phi2.cos();
    let omega2 = -l1 * omega1 * phi1.cos() / (l2 * phi2.cos());
    let v3 = -l1 * omega1 * phi1.sin() + l1 * omega1 * phi1.cos() * phi2.tan();
    let eps2 = (l1 * omega1 * omega1 * phi1.sin() + l2 * omega2 * omega2 * phi2.sin()) / (l2 * phi2.cos());
    let a3 = -l1 * omega1 * omega1 * phi1.cos() - l2 * omega2 * omega2 * phi2.cos() - l2 * eps2 * phi2.sin();
    [phi2, l3, omega2, v3, eps2, a3]
}

/// Dimensions of scenarios/compressor.toml: crank arm, rod, offset of the arm; names of rod and pin.
const CYLINDERS: [(f64, f64, f64, &str, &str); 2] =
    [(0.06, 0.24, 0.0, "rod_2", "B"), (0.05, 0.24, FRAC_PI_2, "rod_4", "D")];
const COMPRESSOR_SPEED: f64 = 104.719_755_119_659_78;

/// Each printed formula of a rate is the derivative of the printed formula before it.
/// Fourth-order differences have a truncation error of h^4 / 30 times the harmonics, which are small for the length
/// ratio 1 / 4.
/// The rounding error of the differences is 1e-16 / h.
#[test]
fn val_compressor_printed_rates_are_derivatives() {
    let h = 1e-3;
    for (l1, l2, delta, ..) in CYLINDERS {
        for [of, rate] in [[0, 2], [2, 4], [1, 3], [3, 5]] {
            let at = |phi: f64| cylinder(l1, l2, phi + delta, COMPRESSOR_SPEED);
            let pairs = (0..360).map(|k| {
                let phi = f64::from(k).to_radians();
                let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(phi + k * h)[of]);
                (COMPRESSOR_SPEED * (8.0 * (c - b) - (d - a)) / (12.0 * h), at(phi)[rate])
            });
            let error = relative(pairs);
            assert_within!(error, 1e-11, "{of} {rate}: {error:e}");
        }
    }
}

/// The bound is 1e-13 of the largest value of the revolution: the rounding error of a few products in the solver and in
/// the formula.
#[test]
fn val_compressor_closed_form() {
    let case = shipped("compressor.toml").case;
    assert_eq!(case.grid.len(), 361);
    for rows in solved(&case) {
        for (l1, l2, delta, rod, pin) in CYLINDERS {
            let link = case.mechanism.link_named(rod).unwrap();
            for quantity in 0..6 {
                let pair = |(crank, state): &(f64, State)| {
                    let [at, velocity, acceleration] = place(&case, state, pin);
                    let motion = &state.motions[link];
                    // The authors measure angles clockwise from +y. Their angle is therefore 90 deg minus the state's
                    // angle, and their angular rates have the opposite sign.
                    let phi2 = linkage::math::angle::wrapped(FRAC_PI_2 - state.angles[link]);
                    let found = [phi2, at.y, -motion.omega, velocity.y, -motion.alpha, acceleration.y];
                    (found[quantity], cylinder(l1, l2, FRAC_PI_2 - crank + delta, COMPRESSOR_SPEED)[quantity])
                };
                let error = relative(rows.iter().map(pair));
                assert_within!(error, 1e-13, "{rod} {quantity}: {error:e}");
            }
        }
    }
}

/// Crank angles at which B is directly above O2: law of cosines in the triangle O1-A-B.
fn upright() -> [f64; 2] {
    let (o1, b) = (Vec2::new(-0.26, 0.12), Vec2::new(0.0, 0.15));
    let reach = b - o1;
    let cosine = (0.05f64.powi(2) + reach.norm_squared() - 0.25f64.powi(2)) / (0.1 * reach.norm());
    let line = reach.y.atan2(reach.x);
    [line + cosine.acos(), line - cosine.acos() + TAU]
}

#[test]
fn val_six_bar_slider_stands_highest_where_the_rocker_is_upright() {
    let scenario = shipped("six_bar_slider.toml");
    let case = &scenario.case;
    let local = |name: &str| {
        let rocker = &case.mechanism.links()[case.mechanism.link_named("rocker").unwrap()];
        rocker.points.iter().find(|point| point.name == name).unwrap().local
    };
    assert_eq!((local("C") - local("O2")).norm(), 2.0 * (local("B") - local("O2")).norm());
    let mut cranks = upright().to_vec();
    // The scenario's oracles for the topmost position are at the crank angles of `upright`, to the digits in the file.
    let topmost = || scenario.oracles.iter().filter(|oracle| oracle.name.starts_with("topmost position"));
    for (oracle, crank) in topmost().zip(&cranks) {
        for series in &oracle.series {
            assert_within!((series.points[0].at.crank().unwrap() - crank).abs(), 1e-14 * TAU, "{}", oracle.name);
        }
    }
    assert_eq!(topmost().count(), 2);
    cranks.sort_by(f64::total_cmp);
    let there = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap();
    let highest = solved(case)[0].iter().map(|(_, state)| place(case, state, "D")[0].y).fold(0.0, f64::larger);
    for rows in solved(&there) {
        for (crank, state) in rows {
            let rocker = state.angles[case.mechanism.link_named("rocker").unwrap()];
            let [at, velocity, _] = place(case, &state, "D");
            // The height is O2C + CD.
            // The bound allows for the rounding error of lengths below a metre and of a speed below 3 m/s.
            let errors = [rocker - FRAC_PI_2, at.y - 0.7, velocity.norm()];
            errors.iter().for_each(|error| assert_within!(error.abs(), 1e-14, "{crank}: {errors:?}"));
            assert!(at.y >= highest, "{crank}: {} below {highest}", at.y);
        }
    }
}

/// Checks x, v and a of a point along `axis`, by both solvers against a closed form, each relative to its largest
/// value.
/// The coordinate along the second axis must equal `other` at every instant.
fn assert_closed_form(name: &str, point: &str, axis: usize, other: f64, form: impl Fn(f64) -> [f64; 3]) {
    let case = shipped(name).case;
    for rows in solved(&case) {
        for order in 0..3 {
            let pair = |(crank, state): &(f64, State)| (place(&case, state, point)[order][axis], form(*crank)[order]);
            let error = relative(rows.iter().map(pair));
            // The bound allows for the rounding error of a few products, and of the crank angle itself.
            assert_within!(error, 1e-14, "{name} {order}: {error:e}");
        }
        for (crank, state) in &rows {
            let [at, velocity, acceleration] = place(&case, state, point).map(|v| v[1 - axis]);
            assert_within!((at - other).abs(), 1e-16, "{name} at {crank}: {at}");
            let sizes = form(*crank).map(|value| 1.0 + value.abs());
            assert_within!(velocity.abs(), 1e-14 * sizes[1], "{name} at {crank}");
            assert_within!(acceleration.abs(), 1e-14 * sizes[2], "{name} at {crank}");
        }
    }
}

#[test]
fn val_scotch_yoke_is_a_cosine() {
    let (r, w) = (0.08, 30.0);
    let form = |phi: f64| [r * phi.cos(), -r * w * phi.sin(), -r * w * w * phi.cos()];
    assert_closed_form("scotch_yoke.toml", "Y", 0, 0.0, form);
}

#[test]
fn val_tangent_mechanism_is_a_tangent() {
    let (h, w) = (0.2, 2.0);
    let form = |phi: f64| {
        let (tan, square) = (phi.tan(), phi.cos().powi(2));
        [h * tan, h * w / square, 2.0 * h * w * w * tan / square]
    };
    assert_closed_form("tangent.toml", "B", 1, h, form);
}

/// The guide is at its extreme positions where it is perpendicular to the crank.
/// The angle at O1 between O1-O2 and the crank is then acos(r / d).
/// The crank therefore rotates by the angle 2 acos(r / d) during the quick stroke.
#[test]
fn val_quick_return_time_ratio() {
    let case = shipped("quick_return.toml").case;
    let range = Range::of(&case).unwrap();
    let guide = case.mechanism.link_named("guide").unwrap();
    let [first, second] = &range.links.iter().find(|link| link.link == guide).unwrap().extremes[..] else {
        panic!("two extremes")
    };
    let quick = 2.0 * (0.1f64 / 0.3).acos();
    let between = (second.crank - first.crank).rem_euclid(TAU);
    let found = between.smaller(TAU - between);
    // The promised accuracy of each extreme position is 1e-9 rad.
    assert_within!((found - quick).abs(), 2e-9, "{found} for {quick}");
    let ratio = (TAU - found) / found;
    assert_within!((ratio - (TAU - quick) / quick).abs(), 1e-8, "{ratio}");
    let swing = (first.angle - second.angle).abs();
    assert_within!((swing - 2.0 * (0.1f64 / 0.3).asin()).abs(), 1e-9, "{swing}");
    // At the extreme positions of the guide, the ram also reverses.
    // Between two extreme positions, the ram's speed is up to 3 m/s.
    // At an extreme position, the computed speed of the ram is only the effect of an angle error of 1e-9 rad.
    let mut cranks = vec![first.crank, second.crank];
    cranks.sort_by(f64::total_cmp);
    for rows in solved(&case.on(Grid::of_inputs(case.crank(), cranks)).unwrap()) {
        for (crank, state) in rows {
            let speed = place(&case, &state, "C")[1].norm();
            assert_within!(speed, 1e-7, "{crank}: {speed:e}");
        }
    }
}

/// Lengths of scenarios/class3_group.toml.
const LEADS: [f64; 3] = [0.16, 0.14, 0.31];
const BASE: [f64; 2] = [0.12, 0.22];
const FRAME_A: Vec2 = Vec2::new(0.0, 0.0);
const FRAME_B: Vec2 = Vec2::new(0.24, -0.04);

/// alpha1 to alpha4.
fn angles(case: &Case, state: &State) -> [f64; 4] {
    ["lead_1", "lead_2", "lead_3", "base"].map(|name| state.angles[case.mechanism.link_named(name).unwrap()])
}

fn rates(case: &Case, state: &State) -> [[f64; 2]; 4] {
    ["lead_1", "lead_2", "lead_3", "base"].map(|name| {
        let motion = &state.motions[case.mechanism.link_named(name).unwrap()];
        [motion.omega, motion.alpha]
    })
}

fn beta() -> f64 {
    f64::to_radians(-110.0)
}

#[test]
fn val_class3_group_contours_close() {
    let case = shipped("class3_group.toml").case;
    for rows in solved(&case) {
        for (crank, state) in rows {
            let [a1, a2, a3, a4] = angles(&case, &state);
            let c = Vec2::new(0.21, -0.33) + unit(crank) * 0.04;
            let first = unit(a1) * LEADS[0] + unit(a4) * BASE[0] - (FRAME_B - FRAME_A) - unit(a2) * LEADS[1];
            let second = unit(a1) * LEADS[0] + unit(a4 + beta()) * BASE[1] - (c - FRAME_A) - unit(a3) * LEADS[2];
            // The bound allows for the rounding error of vectors shorter than half a metre.
            assert_within!(first.norm().larger(second.norm()), 1e-15, "{crank}: {first} {second}");
        }
    }
}

/// First transfer functions by Cramer's rule from the contours, as the authors compute them.
fn by_cramer([a1, a2, a3, a4]: [f64; 4], crank: f64) -> [f64; 4] {
    let slope = |length: f64, angle: f64| Vec2::new(-angle.sin(), angle.cos()) * length;
    let zero = Vec2::zeros();
    let rows = [
        [slope(LEADS[0], a1), -slope(LEADS[1], a2), zero, slope(BASE[0], a4)],
        [slope(LEADS[0], a1), zero, -slope(LEADS[2], a3), slope(BASE[1], a4 + beta())],
    ];
    let right = [zero, slope(0.04, crank)];
    let system = Matrix::from_fn(4, 4, |r, k| rows[r / 2][k][r % 2]);
    let determinant = system.determinant();
    [0, 1, 2, 3].map(|k| {
        let mut replaced = system.clone();
        (0..4).for_each(|r| replaced[(r, k)] = right[r / 2][r % 2]);
        replaced.determinant() / determinant
    })
}

/// The first transfer functions agree with Cramer's rule, and with fourth-order central differences of the angles.
/// The second transfer functions agree with fourth-order central differences of the first transfer functions.
#[test]
fn val_class3_group_transfer_functions() {
    let (h, speed) = (1e-3, 10.0);
    let case = shipped("class3_group.toml").case;
    for solver in all() {
        let mut pairs: [[Vec<(f64, f64)>; 3]; 4] = Default::default();
        for degrees in (0..360).step_by(5) {
            let crank = f64::from(degrees).to_radians();
            let times = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| (crank + k * h) / speed);
            let around = states(solver, &case, &times).unwrap();
            let difference = |of: &dyn Fn(&State) -> f64| {
                let [a, b, _, c, d] = [0, 1, 2, 3, 4].map(|k| of(&around[k]));
                (8.0 * (c - b) - (d - a)) / (12.0 * h)
            };
            let here = rates(&case, &around[2]);
            let cramer = by_cramer(angles(&case, &around[2]), crank);
            for link in 0..4 {
                let first = here[link][0] / speed;
                let [of_angle, of_first] = [
                    difference(&|state| angles(&case, state)[link]),
                    difference(&|state| rates(&case, state)[link][0] / speed),
                ];
                pairs[link][0].push((first, cramer[link]));
                pairs[link][1].push((of_angle, first));
                pairs[link][2].push((of_first, here[link][1] / speed.powi(2)));
            }
        }
        for (link, pairs) in pairs.into_iter().enumerate() {
            let errors = pairs.map(|pairs| relative(pairs.into_iter()));
            // Cramer's rule has only rounding errors.
            // Differences have truncation errors of h^4 / 30 times harmonics up to the sixth, and rounding errors of
            // 1e-16 / h.
            assert_within!(errors[0], 1e-13, "{} alpha{}: {errors:?}", solver.name(), link + 1);
            assert_within!(errors[1].larger(errors[2]), 1e-9, "{} alpha{}: {errors:?}", solver.name(), link + 1);
        }
    }
}
