//! Only requested quantities are computed, and the requested quantities keep their values.

use std::collections::BTreeMap;
use std::path::Path;

use analytic::{AssurSolver, NewtonSolver};
use linkage::case::{Case, Grid};
use linkage::math::{KeepNan, largest_size};
use linkage::solver::Solver;
use linkage::work::{Count, counted};
use scenario::{Scenario, files_in};

use crate::common::expected::agrees_with;
use crate::common::specimens::specimen;
use crate::common::{assert_within, draws, shipped};

/// Rounding error of a side relative to its largest number.
/// The value is valid for poses as well conditioned as those of the shipped scenarios.
const ROUNDING: f64 = 1e-9;

/// Requests every subject of a case alone.
/// On either side, the values must equal those of the solution of the whole mechanism.
fn subjects_keep_their_values(case: &Case, about: &str) {
    let times = case.grid.times.iter().step_by(case.grid.len().div_ceil(12)).copied().collect();
    // All channels are requested here, because a file may request only some of them.
    let case = &case.on(Grid::of_times(case.crank(), times)).unwrap().wanting_only(&case.all_channels());
    for solver in [&AssurSolver as &dyn Solver, &NewtonSolver] {
        let Ok(whole) = solver.solve(case) else { continue };
        let mut words = case.channel_words();
        words.retain(|word| word.split('.').count() < 3 || word.ends_with(".positions"));
        // If forces determine the motion, a word only selects columns of the whole solution, so a few words are enough.
        words.truncate(if case.is_free() { 8 } else { words.len() });
        for word in words {
            let own = case.wanting_only(&case.channels_called(&word));
            let scene = own.scene().unwrap_or_else(|error| panic!("{about}, {word}: {error}"));
            let part = solver.solve(&scene.case).unwrap_or_else(|error| panic!("{about}, {word}: {error}"));
            assert_eq!(part.channels().len(), own.channels().len(), "{about}, {word}");
            for (channel, values) in part.iter() {
                let expected = whole.column(channel).expect("a channel of the whole");
                let off = values.iter().zip(expected).fold(0.0f64, |most, (a, b)| most.larger((a - b).abs()));
                // If a channel is only rounding error, its scale is not usable.
                // The difference is therefore divided by the largest value of all channels with the same unit.
                let of_stage = whole.iter().filter(|(other, _)| other.kind.unit == channel.kind.unit);
                let size = of_stage.map(|(_, values)| largest_size(values)).fold(0.0, f64::larger);
                assert_within!(off, ROUNDING * size, "{about}, {word}, {channel} by {}", solver.name());
            }
        }
    }
}

#[test]
fn scenes_of_shipped_scenarios_keep_all_values() {
    let files = files_in(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")).unwrap();
    for file in files {
        let scenario = Scenario::load(&file).unwrap();
        subjects_keep_their_values(&scenario.case, &scenario.name);
    }
}

/// The random mechanisms combine loads between links, several drives and sliders; no shipped scenario has all three.
#[test]
fn scenes_of_random_mechanisms_keep_all_values() {
    for index in 0..draws(10) as u64 {
        let text = specimen(14, index, &mut BTreeMap::new()).toml(true);
        let scenario = Scenario::parse(&text, Path::new("specimen.toml")).unwrap();
        subjects_keep_their_values(&scenario.case, &format!("specimen {index}"));
    }
}

fn asked(case: &Case, words: &[&str]) -> Case {
    let channels: Vec<_> = words.iter().flat_map(|word| case.channels_called(word)).collect();
    case.wanting_only(&channels)
}

/// Number of groups that are solved per pose.
fn groups(case: &Case) -> f64 {
    let work = counted(|| AssurSolver.solve(&case.scene().unwrap().case).unwrap()).1;
    work.of(Count::Groups) as f64 / work.of(Count::Poses) as f64
}

#[test]
fn several_points_of_one_group_cost_one_group() {
    let case = shipped("ov7_base.toml").case;
    assert_eq!(groups(&asked(&case, &["point.3.positions"])), 1.0);
    assert_eq!(groups(&asked(&case, &["point.3", "link.rod_23.positions", "link.rocker_43"])), 1.0);
    assert_eq!(groups(&asked(&case, &["point.5.positions"])), 2.0);
    assert_eq!(groups(&asked(&case, &["point.9.positions"])), 3.0);
    assert_eq!(groups(&asked(&case, &["point.2.positions"])), 0.0);
}

/// A reaction depends on all parts that its joint carries, and on no part that its joint does not carry.
#[test]
fn reactions_need_everything_attached_to_their_joint() {
    let case = shipped("ov7_base.toml").case;
    let scene = |words: &[&str]| asked(&case, words).scene().unwrap();
    assert!(scene(&["joint.3a"]).left_out.is_empty());
    assert!(scene(&["frame.fx_N"]).left_out.is_empty() && scene(&["drive"]).left_out.is_empty());
    let six_bar = shipped("six_bar_slider.toml").case;
    let last = six_bar.structure.groups.last().unwrap();
    let joint = &six_bar.mechanism.joints()[last.inner[0]].name;
    assert_eq!(asked(&six_bar, &[&format!("joint.{joint}")]).scene().unwrap().left_out.loads, 0);
    // Motions of a link need only the groups between the crank and this link.
    let links = |words: &[&str]| scene(words).case.mechanism.links().len();
    assert_eq!((links(&["link.crank"]), links(&["point.3.velocities"]), links(&["link.rod_35.positions"])), (2, 4, 6));
}

/// If forces determine the motion, every mass influences it, so no link may be omitted.
#[test]
fn the_scene_of_a_free_motion_omits_nothing() {
    let case = shipped("ov7_new_runup.toml").case;
    let own = asked(&case, &["link.crank"]);
    let scene = own.scene().unwrap();
    assert!(scene.left_out.is_empty() && scene.case == own);
    assert_eq!(AssurSolver.solve(&scene.case).unwrap().channels().len(), own.channels().len());
}

/// Two links have points of the same name, and only a third link joins them there.
/// If this third link is omitted, the two points get different names.
#[test]
fn a_point_split_by_an_omitted_link_gets_two_names() {
    let case = shipped("ov7_base.toml").case;
    for word in ["link.rocker_43.positions", "link.rod_35", "point.5.velocities", "link.rocker_65.angle_rad"] {
        let scene = asked(&case, &[word]).scene().unwrap();
        assert!(!scene.left_out.is_empty(), "{word}");
    }
}

/// Exact work of proofs of shipped scenarios, for all channels or only some, with a number for each part of a proof.
/// If these numbers change, the cost has changed.
#[test]
fn work_of_scenes_is_unchanged() {
    let questions = [
        ("crank_rocker.toml", ""),
        ("crank_rocker.toml", "positions"),
        ("ov7_base.toml", ""),
        ("ov7_base.toml", "positions"),
        ("ov7_base.toml", "point.3.positions"),
        ("ov7_base.toml", "joint.7"),
        ("fourth_class.toml", "point.A.positions"),
        ("crank_rocker_runup.toml", ""),
        ("crank_rocker_runup.toml", "link.crank"),
    ];
    let mut pages = Vec::new();
    for (file, word) in questions {
        let mut scenario = shipped(file);
        if !word.is_empty() {
            scenario = scenario.only(&[word.to_string()]).unwrap();
        }
        let proof = linkproof::prove(&scenario, &linkproof::Options::default()).unwrap();
        assert_eq!(proof.verdict.word(), "agree", "{file} {word}");
        let mut page = String::new();
        // The list of channels is not part of the cost.
        for line in linkproof::report::explain::text(&proof, &[]).lines() {
            let requested = format!("requested  {word}").trim_end().to_string();
            page += if line.starts_with("requested ") { &requested } else { line };
            page += "\n";
        }
        pages.push(page);
    }
    agrees_with("tests/suite/scenes/work.txt", &pages.join("\n"), "scenes");
}
