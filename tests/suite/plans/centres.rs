//! Instant centres by the theorem of three centres, and acceleration centres, compared with the solved motions.

use std::fs;
use std::path::Path;

use analytic::AssurSolver;
use design::draw;
use design::plan::centre_sheet::position;
use design::plan::centres::{CentreLine, CentreOrigin, Centres};
use design::plan::{Plans, state_at};
use linkage::case::{Case, When};
use linkage::math::centre::MotionCentre;
use linkage::math::{KeepNan, cross};
use linkage::mechanism::LinkId;
use linkage::solver::State;
use scenario::Scenario;

use super::{plans, scenario};
use crate::common::assert_within;

/// The states of a case at the start and at two later crank angles, if they can be reached.
fn states(case: &Case) -> Vec<State> {
    let start = case.crank().start;
    let later = [0.15, 0.4].map(|share| start + case.crank().sense() * share);
    let all = [start].into_iter().chain(later);
    all.filter_map(|crank| state_at(case, &AssurSolver, When::Crank(crank)).ok()).collect()
}

/// All shipped scenarios.
fn shipped() -> Vec<Scenario> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    files.iter().map(|path| Scenario::load(path).unwrap_or_else(|error| panic!("{error}")).nominal()).collect()
}

#[test]
fn both_links_have_one_velocity_at_every_centre_of_every_scenario() {
    let (mut scenarios, mut lines, mut infinite, mut contacts, mut by_velocities) = (0, 0, 0, 0, 0);
    for scenario in shipped() {
        let case = &scenario.case;
        let links = case.mechanism.links().len();
        let states = states(case);
        scenarios += usize::from(!states.is_empty());
        for state in &states {
            let centres = Centres::of(&case.mechanism, &state.motions);
            assert_eq!(centres.instant.len(), links * (links - 1) / 2, "{}", scenario.name);
            let fastest = state.motions.iter().map(|own| own.velocity.norm() + own.omega.abs() * case.mechanism.size());
            let fastest = fastest.fold(0.0, f64::larger);
            for centre in &centres.instant {
                let away = position(centre.place).map_or(0.0, |at| at.norm() / case.mechanism.size());
                // A centre loses digits if its two lines meet at a small angle, or if it is far away.
                let bound = 1e-9 * fastest * (1.0 + away);
                assert_within!(centre.slip, bound, "{} P{} {}", scenario.name, centre.numbers(), centre.told());
                let is_contact = |line: &CentreLine| matches!(line, CentreLine::Contact { .. });
                infinite += usize::from(matches!(centre.place, MotionCentre::AtInfinity(_)));
                match &centre.origin {
                    CentreOrigin::Lines(both) if both.iter().any(is_contact) => contacts += 1,
                    CentreOrigin::Lines(_) => lines += 1,
                    CentreOrigin::Velocities => by_velocities += 1,
                    CentreOrigin::Pin(_) | CentreOrigin::Guide { .. } | CentreOrigin::Common(_) => {}
                }
            }
            for (link, place) in &centres.acceleration {
                let Some(at) = position(*place) else { continue };
                let motion = &state.motions[*link];
                let turning = motion.omega.powi(2) + motion.alpha.abs();
                let size = motion.acceleration.norm() + turning * (at.norm() + motion.origin.norm());
                assert_within!(motion.acceleration_at(at).norm(), 1e-13 * size, "{} {link}", scenario.name);
            }
        }
    }
    assert!(scenarios >= 20, "{scenarios}");
    assert!(
        lines > 300 && infinite > 30 && contacts > 5 && by_velocities > 2,
        "{lines} {infinite} {contacts} {by_velocities}"
    );
}

/// The centres are constructed without velocities. A wrong velocity then gives the two links different velocities at
/// their centre.
#[test]
fn a_wrong_angular_velocity_is_seen_at_the_centres() {
    let case = scenario("six_bar_slider").case;
    let mut state = states(&case).remove(1);
    let right = Centres::of(&case.mechanism, &state.motions);
    state.motions[LinkId(2)].omega *= 1.01;
    let wrong = Centres::of(&case.mechanism, &state.motions);
    let worst = |all: &Centres| all.instant.iter().map(|centre| centre.slip / centre.speed).fold(0.0, f64::larger);
    assert!(worst(&right) < 1e-12 && worst(&wrong) > 1e-3, "{:e} {:e}", worst(&right), worst(&wrong));
    for (one, other) in right.instant.iter().zip(&wrong.instant) {
        assert_eq!((one.place, &one.origin), (other.place, &other.origin));
    }
}

/// Centres of a four-bar: P02 lies on the lines of crank and rocker, P13 on the lines of the coupler and of the pivots.
#[test]
fn centres_of_a_four_bar_lie_on_its_lines() {
    let plans = plans("crank_rocker", 70.0);
    let case = scenario("crank_rocker").case;
    let state = state_at(&case, &AssurSolver, When::Crank(70f64.to_radians())).unwrap();
    let centres = Centres::of(&case.mechanism, &state.motions);
    let point = |name: &str| plans.scheme.points.iter().find(|(own, _)| own == name).unwrap().1;
    for (pair, lines) in [([0, 2], [["O", "A"], ["C", "B"]]), ([1, 3], [["O", "C"], ["A", "B"]])] {
        let centre = centres.between(LinkId(pair[0]), LinkId(pair[1])).unwrap();
        assert!(matches!(centre.origin, CentreOrigin::Lines(_)));
        let at = position(centre.place).unwrap();
        for [a, b] in lines.map(|line| line.map(point)) {
            assert_within!(cross(b - a, at - a).abs(), 1e-12 * (b - a).norm(), "{pair:?}");
        }
    }
    // Kennedy's theorem: omega2 / omega1 = P01P12 / P02P12.
    let [p02, a, o] = [position(centres.between(LinkId(0), LinkId(2)).unwrap().place).unwrap(), point("A"), point("O")];
    let ratio = (state.motions[LinkId(2)].omega / state.motions[LinkId(1)].omega).abs();
    assert_within!((ratio - (a - o).norm() / (p02 - a).norm()).abs(), 1e-12);
}

/// The singular point of a class IV group is the instant centre of its two base links.
/// From this centre, the theorem of three centres gives all further centres, without the use of velocities.
#[test]
fn the_singular_point_is_the_centre_of_both_base_links() {
    let plans = plans("fourth_class", 70.0);
    let case = scenario("fourth_class").case;
    let state = state_at(&case, &AssurSolver, When::Crank(70f64.to_radians())).unwrap();
    let centres = Centres::of(&case.mechanism, &state.motions);
    let at = position(centres.between(LinkId(2), LinkId(5)).unwrap().place).unwrap();
    assert_within!((at - plans.scheme.singular[0].at).norm(), 1e-12);
    assert!(centres.instant.iter().all(|centre| centre.origin != CentreOrigin::Velocities));
}

#[test]
fn the_drawing_names_every_centre_and_only_chosen_links_if_asked() {
    for (name, degrees) in [("crank_rocker", 70.0), ("six_bar_slider", 40.0), ("quick_return", 40.0)] {
        let case = scenario(name).case;
        let state = state_at(&case, &AssurSolver, When::Crank(f64::to_radians(degrees))).unwrap();
        let all = Plans::of(&case, &AssurSolver, &state, degrees.to_radians()).with_centres(&case, &state);
        let words = |plans: &Plans| {
            let text = draw::plans(plans, name, "").svg();
            let document = roxmltree::Document::parse(&text).unwrap();
            let texts = document.descendants().filter(|node| node.has_tag_name("text"));
            let italic = texts.filter(|node| node.attribute("font-style") == Some("italic"));
            italic
                .map(|node| node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect::<String>())
                .flat_map(|text| text.split(", ").map(|own| own.trim().to_string()).collect::<Vec<_>>())
                .collect::<Vec<String>>()
        };
        let drawn = words(&all);
        for centre in &all.centres.as_ref().unwrap().centres.instant {
            assert!(drawn.contains(&format!("P{}", centre.numbers())), "{name} {}: {drawn:?}", centre.numbers());
        }
        let link = case.mechanism.links()[LinkId(2)].name.clone();
        let some = all.only(&[link]).unwrap();
        let sheet = some.centres.as_ref().unwrap();
        assert!(sheet.instant().all(|centre| centre.links.contains(&LinkId(2))) && sheet.acceleration().count() == 1);
    }
}
