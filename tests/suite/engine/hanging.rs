//! A free link that hangs on another free link, or on a link with a motion law, with and without a loop behind it.

use super::solve;
use crate::common::{assert_within, rapiers};
use linkage::case::Grid;
use linkage::trajectory::Channel;
use prover::engines::{EngineName, with_step};
use prover::run::{Options, prove};
use scenario::Scenario;

const ON_A_LOOP: &str = include_str!("hanging_on_loop.toml");
const CRANK: &str = "joint = \"O\"\nmotion = \"free\"\n";
const PENDULUM: &str = "start_deg = -60\nmotion = \"free\"\n";

fn with(text: &str, changes: &[(&str, &str)]) -> Scenario {
    let changed = changes.iter().fold(text.to_string(), |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    });
    Scenario::parse(&changed, "hanging.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// The crank and its pendulum alone.
fn alone() -> String {
    let cut = |text: &str, from: &str, to: &str| {
        let (start, rest) = text.split_once(from).expect("the text contains the beginning of the part");
        format!("{start}{}", &rest[rest.find(to).expect("the text contains the end of the part")..])
    };
    let text = cut(ON_A_LOOP, "C = { x_m = 0.4, y_m = 0 }\n", "\n[links.crank]");
    let text = cut(&text, "[links.coupler]", "[[joints]]");
    let text = cut(&text, "[[joints]]\nname = \"A\"", "[[drive]]\njoint = \"O\"");
    cut(&text, "[[start.groups]]", "[grid]")
}

/// A second pendulum that hangs on the first pendulum.
const SECOND: [(&str, &str); 3] = [
    (
        "[links.pendulum.points]\nN = { x_m = 0, y_m = 0 }\n",
        "[links.pendulum.points]\nN = { x_m = 0, y_m = 0 }\nP = { x_m = 0.2, y_m = 0 }\n\n[links.second]\n\
         mass_kg = 0.5\ninertia_kg_m2 = 0.004\nmass_centre = { x_m = 0.08, y_m = 0.01 }\n\
         [links.second.points]\nP = { x_m = 0, y_m = 0 }\n",
    ),
    (
        "[[joints]]\nname = \"A\"",
        "[[joints]]\nname = \"P\"\ntype = \"revolute\"\nlinks = [\"pendulum\", \"second\"]\n[[joints]]\nname = \"A\"",
    ),
    ("[gravity]", "[[drive]]\njoint = \"P\"\nstart_deg = 10\nmotion = \"free\"\nspeed_rad_s = 5\n\n[gravity]"),
];

const DRIVEN: (&str, &str) = (CRANK, "joint = \"O\"\n");
const ONLY_ITS_FORCE: (&str, &str) = ("[grid]", "[channels]\nwant = [\"joint.N\"]\n\n[grid]");

/// Story 71.
/// Symptom: if a free link hangs on a link of a loop, Rapier's force at its hinge is wrong by newtons.
/// All results except the force at this hinge are right.
/// In a chain without a loop, the force is also wrong if no second reaction is requested.
/// Cause: the force at the hinge is read in a world that cuts the hinge. In that world the hanging link was a separate
/// body, and Rapier never rotated the separate body.
/// Remedy: the hanging link is a floating link of the multibody.
#[test]
fn regress_71_a_link_hanging_on_a_loop_has_the_right_reaction() {
    let one = alone();
    let scenarios = [
        ("on a loop", with(ON_A_LOOP, &[])),
        ("on a driven loop", with(ON_A_LOOP, &[DRIVEN])),
        ("two on a loop", with(ON_A_LOOP, &SECOND)),
        ("on a loop, only its force", with(ON_A_LOOP, &[ONLY_ITS_FORCE])),
        ("on a crank, only its force", with(&one, &[ONLY_ITS_FORCE])),
    ];
    for (name, scenario) in scenarios {
        let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(proof.verdict.word(), "agree", "{name}: {:?}", proof.verdict);
        let own = proof.engine().own_forces.as_ref().expect("the exerted forces are judged");
        for channel in ["joint.N.fx_N", "joint.N.fy_N"].map(|channel| Channel::named(channel).unwrap()) {
            let judged = own.channels.iter().find(|own| own.residual.channel == channel);
            assert_eq!(judged.map(|own| own.verdict.word()), Some("agree"), "{name}: {channel}");
        }
    }
}

/// Story 72.
/// Symptom: a free link that hangs on a moving link starts with the moving link's speed, although it should start at
/// rest.
/// With an initial speed, the free link starts with the sum of the two speeds.
/// Cause: the motors that set the start velocities rotate a link relative to the second link of its joint.
/// The initial speed, however, is relative to the world.
#[test]
fn regress_72_a_hanging_link_starts_with_its_own_speed() {
    let two: Vec<(&str, &str)> = SECOND.into_iter().collect();
    let (fast, against) = (
        (CRANK, "joint = \"O\"\nmotion = \"free\"\ninitial_speed_rad_s = 4\n"),
        (PENDULUM, "start_deg = -60\nmotion = \"free\"\ninitial_speed_rad_s = -7\n"),
    );
    let one = alone();
    let scenarios = [
        ("at rest on a crank", with(&one, &[fast]), vec![0.0]),
        ("at rest on a loop", with(ON_A_LOOP, &[fast]), vec![0.0]),
        ("against the crank", with(ON_A_LOOP, &[fast, against]), vec![-7.0]),
        ("against a driven crank", with(ON_A_LOOP, &[DRIVEN, against]), vec![-7.0]),
        ("two in a row", with(ON_A_LOOP, &[two.as_slice(), &[fast, against]].concat()), vec![-7.0, 0.0]),
    ];
    for (name, scenario, speeds) in scenarios {
        for engine in rapiers() {
            let engine = with_step(EngineName::named(engine).unwrap(), 1e-5).unwrap();
            let start = Grid::of_times(scenario.case.crank(), vec![0.0]);
            let found = solve(engine.as_ref(), &scenario.case.on(start).unwrap());
            for (link, speed) in ["pendulum", "second"].into_iter().zip(&speeds) {
                let omega = Channel::named(&format!("link.{link}.omega_rad_s")).unwrap();
                let off = (found.column(&omega).unwrap()[0] - speed).abs();
                // At about 100 rad/s^2, the speed changes by 1e-3 rad/s in one step; the bound is twenty times this change.
                assert_within!(off, 2e-2, "{name}, {}: {link}", engine.name());
            }
        }
        let proof = prove(&scenario, &Options::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(proof.verdict.word(), "agree", "{name}: {:?}", proof.verdict);
    }
}
