//! Scenarios of crank-rocker and slider-crank from their closed forms, followed over a whole revolution.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use analytic::range::{Extent, FourBarType, Range};
use analytic::{AssurSolver, NewtonSolver};
use design::synthesize::DraftContents;
use design::synthesize::crank_rocker::{CrankRocker, CrankRockerSpec};
use design::synthesize::slider_crank::{Given, SliderCrank};
use linkage::case::Case;
use linkage::math::{KeepNan, Vec2};
use scenario::Scenario;

use crate::common::{assert_within, shipped, states};
use linkage::mechanism::{GroupId, LinkId};

fn sheet() -> DraftContents {
    DraftContents { name: "found".into(), title: "Found".into(), comment: "two\nlines".into(), speed: 6.0, bar: 2.0 }
}

fn case(text: &str) -> Case {
    Scenario::parse(text, Path::new("found.toml")).unwrap_or_else(|error| panic!("{error}\n{text}")).case
}

/// Checks that two angles (rad) are the same, except for whole revolutions.
fn same_angle(a: f64, b: f64, within: f64) -> bool {
    let apart = (a - b).rem_euclid(TAU);
    apart.smaller(TAU - apart) <= within
}

fn published() -> CrankRockerSpec {
    CrankRockerSpec {
        crank_pivot: Vec2::zeros(),
        rocker_pivot: Vec2::new(0.15, 0.015),
        rocker: 0.25,
        extreme: 50f64.to_radians(),
        swing: 32f64.to_radians(),
    }
}

#[test]
fn the_published_crank_rocker_equals_the_shipped_scenario() {
    let found = CrankRocker::of(published()).unwrap();
    let (own, shipped) = (case(&found.scenario(&sheet())), shipped("crank_rocker.toml").case);
    for (a, b) in own.mechanism.joints().iter().zip(shipped.mechanism.joints()) {
        assert_eq!(a.name, b.name);
        assert_within!((a.second.local - b.second.local).norm(), 1e-12);
        assert_within!((a.first.local - b.first.local).norm(), 1e-12);
    }
    assert_eq!(own.modes, shipped.modes);
}

/// The mechanism has exactly the requested extreme positions.
/// The extreme positions are checked by the range of motion, which uses arc length and independent equations.
#[test]
fn crank_rockers_have_the_requested_extreme_positions() {
    let mut proven = 0;
    for k in 0..200u32 {
        // Deterministic values spread over the whole sensible range, without random numbers.
        let part = |prime: f64| (f64::from(k) * prime.sqrt()).fract();
        let wish = CrankRockerSpec {
            crank_pivot: Vec2::new(0.3 * part(2.0), -0.2 * part(3.0)),
            rocker_pivot: Vec2::new(0.2 + 0.4 * part(5.0), 0.2 - 0.5 * part(7.0)),
            rocker: 0.05 + 0.3 * part(11.0),
            extreme: TAU * part(13.0),
            swing: (2.0 * part(17.0) - 1.0) * 1.5,
        };
        let Ok(found) = CrankRocker::of(wish) else { continue };
        let case = case(&found.scenario(&sheet()));
        let range = Range::of(&case).unwrap();
        assert_eq!(range.four_bar.unwrap().of_type, FourBarType::CrankRocker, "{found:?}");
        assert_eq!(range.extent, Extent::FullTurn(1));
        // A linkage close to its assembly limit loses digits, so it is skipped.
        if found.transmission < 0.05 {
            continue;
        }
        let rocker = range.links.iter().find(|link| link.link == LinkId(3)).unwrap();
        assert_eq!(rocker.extremes.len(), 2);
        for extreme in &rocker.extremes {
            let near = [found.stretched, found.folded]
                .iter()
                .any(|own| same_angle(own.crank, extreme.crank, 1e-8) && same_angle(own.rocker, extreme.angle, 1e-9));
            assert!(near, "{extreme:?} {found:?}");
        }
        let least = range.groups[GroupId(0)].determinant;
        assert_within!((least.value.abs().asin() - found.transmission).abs(), 1e-6, "{least:?} {found:?}");
        assert!(same_angle(least.crank, found.transmission_at, 1e-6));
        // For one stroke of the rocker, the crank rotates by pi + theta; for the return stroke, by pi - theta.
        // The time ratio is the ratio of these two angles.
        let way = (rocker.extremes[0].crank - rocker.extremes[1].crank).abs();
        let slower = way.larger(TAU - way);
        assert_within!((slower / (TAU - slower) - found.time_ratio).abs(), 1e-7);
        proven += 1;
    }
    assert!(proven > 40, "{proven}");
}

#[test]
fn slider_cranks_have_the_requested_stroke() {
    for (stroke, offset, given) in [
        (0.1, 0.0, Given::Rod(0.2)),
        (0.1, 0.03, Given::Rod(0.12)),
        (0.1, -0.03, Given::Rod(0.12)),
        (0.1, 0.03, Given::TimeRatio(1.2)),
        (0.02, -0.05, Given::TimeRatio(1.1)),
    ] {
        let found = SliderCrank::of(stroke, offset, given).unwrap();
        let case = case(&found.scenario(&sheet()));
        assert_eq!(Range::of(&case).unwrap().extent, Extent::FullTurn(1));
        let place = case.mechanism.link_named("slider").unwrap();
        let cranks: Vec<f64> =
            [found.far[0], found.near[0]].into_iter().chain((0..3600).map(|k| f64::from(k) * TAU / 3600.0)).collect();
        let times: Vec<f64> = cranks.iter().map(|&crank| case.crank().time_of(crank)).collect();
        let newton = states(&NewtonSolver, &case, &times).unwrap();
        let assur = states(&AssurSolver, &case, &times[..2]).unwrap();
        for (row, [_, x]) in [found.far, found.near].into_iter().enumerate() {
            for state in [&newton[row], &assur[row]] {
                assert_within!((state.motions[place].origin - Vec2::new(x, offset)).norm(), 1e-13, "{found:?}");
                assert_within!(state.motions[place].velocity.norm(), 1e-13, "{found:?}");
            }
        }
        // The slider stays between its extreme positions everywhere.
        assert!(newton.iter().all(|state| {
            let x = state.motions[place].origin.x;
            x <= found.far[1] + 1e-13 && x >= found.near[1] - 1e-13
        }));
        let way = (found.far[0] - found.near[0]).abs();
        let slower = way.larger(TAU - way);
        assert_within!((slower / (TAU - slower) - found.time_ratio).abs(), 1e-12, "{found:?}");
        let steepest = newton.iter().map(|state| state.motions[LinkId(2)].direction.y.abs()).fold(0.0, f64::larger);
        assert_within!((steepest.asin() - found.pressure).abs(), 1e-5, "{found:?}");
        assert!(found.pressure < PI / 2.0);
    }
}

/// The rod must be at least as long as crank and offset together.
/// If the rod is slightly shorter, the crank does not rotate fully.
#[test]
fn below_the_shortest_rod_the_crank_does_not_turn_fully() {
    let found = SliderCrank::of(0.1, 0.03, Given::Rod(0.0675)).unwrap();
    let turns = |rod: f64| Range::of(&case(&SliderCrank { rod, ..found }.scenario(&sheet()))).unwrap().extent;
    assert_eq!(turns(found.rod), Extent::FullTurn(1));
    let limit = found.crank + 0.03;
    assert_eq!(turns(limit + 1e-6), Extent::FullTurn(1));
    assert!(matches!(turns(limit - 1e-6), Extent::Limited(_)));
}
