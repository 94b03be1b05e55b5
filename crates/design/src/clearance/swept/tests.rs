//! Tests of covered and free squares, and of outline sides that pass over discs, at sample squares, sides and discs.

use std::f64::consts::TAU;

use linkage::math::unit;

use super::super::tests::slider_crank;
use super::*;
use linkage::mechanism::LinkId;

/// A crank of length 0.1 m with a rounding radius of 0.02 m sweeps a disc of radius 0.12 m.
/// Every covered square lies inside the disc, and every free square lies outside the disc.
#[test]
fn squares_are_covered_or_free_including_their_corners() {
    let case = slider_crank();
    let mut tubes = Tubes::new(&case, [0.0, TAU], 0.12).unwrap();
    let outline = Outline::line(&[Vec2::new(0.0, 0.0), Vec2::new(0.1, 0.0)], 0.02).unwrap();
    let mut sweep = Sweep::new(&mut tubes, LinkId(1), &outline);
    let near = sweep.sound_parts().unwrap();
    let mut counts = [0; 3];
    for half in [4e-3, 1e-3] {
        for (k, direction) in (0..25).flat_map(|k| (0..16).map(move |direction| (k, direction))) {
            let centre = unit(TAU * f64::from(direction) / 16.0) * (0.12 + half * (f64::from(k) - 12.0) / 6.0);
            let far = (centre.abs() + Vec2::repeat(half)).norm();
            let close = (centre.abs() - Vec2::repeat(half)).map(|x| x.larger(0.0)).norm();
            let found = sweep.judge(centre, half, &near).unwrap();
            let kind = match found {
                Square::Covered => 0,
                Square::Free => 1,
                Square::Border(..) => 2,
            };
            counts[kind] += 1;
            assert!(kind != 0 || far <= 0.12, "covered, but {far} m away: {centre} {half}");
            assert!(kind != 1 || close >= 0.12, "free, but {close} m away: {centre} {half}");
        }
    }
    assert!(counts.iter().all(|count| *count > 50), "{counts:?}");
}

/// If [`passes`] is true, every point of the disc is left of the outline side at one end of the part and right of the
/// outline side at the other end.
/// At every instant, every point of the disc lies between the two ends of the outline side.
/// The test draws the positions of the ends at random within their errors.
#[test]
fn a_side_that_passes_a_disc_passes_all_its_points() {
    // Knuth's MMIX generator: repeatable random numbers.
    let mut state: u64 = 7;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    let (half, mut passed) = (0.5, 0);
    for _ in 0..40_000 {
        let mut end = |x: f64| {
            let error = if number() > 0.0 { 0.05 * number().abs() } else { 0.0 };
            Track {
                at: Vec2::new(x + 0.5 * number(), 0.5 * number()),
                rate: Vec2::new(2.0 * number(), 4.0 * number()),
                error,
            }
        };
        let side = [end(-0.5), end(0.5)];
        let (centre, about) = (Vec2::new(0.5 * number(), 0.5 * number()), 0.1 * number().abs());
        if !passes(&side, half, centre, about) {
            continue;
        }
        passed += 1;
        for _ in 0..10 {
            let ends = [0, 1].map(|k| side[k].at + unit(4.0 * number()) * side[k].error);
            let place = centre + unit(4.0 * number()) * about;
            let at = |by: f64| {
                let [a, b] = [ends[0] + side[0].rate * by, ends[1] + side[1].rate * by];
                (cross(b - a, place - a), (place - a).dot(&(b - a)) / (b - a).norm_squared())
            };
            assert!(at(-half).0 * at(half).0 < 0.0, "{side:?} {centre} {about}");
            let between = |k: i32| (0.0..=1.0).contains(&at(half * f64::from(k) / 40.0).1);
            assert!((-40..=40).all(between), "{side:?} {centre} {about}");
        }
    }
    assert!(passed > 400, "{passed}");
}
