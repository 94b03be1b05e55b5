//! Simbody against the analytic reference: all mechanisms of the repository, random mechanisms and other instants.
//! Cases that Simbody must refuse are tested too.

use crate::common::higher::{Among, FAMILIES, mechanism};
use crate::common::random::for_each;
use crate::common::sketch::RandomSource;
use crate::common::sliders;
use crate::common::spec::{Spec, four_bar};
use crate::common::{assert_within, shipped, states};
use analytic::{AssurSolver, NewtonSolver};
use linkage::ErrorKind;
use linkage::case::{Case, Grid};
use linkage::engine::Engine;
use linkage::math::{KeepNan, Vec2};
use linkage::mechanism::{GroupId, JointId, LinkId};
use linkage::solver::Solver;
use linkage::trajectory::{Channel, Stage, Trajectory, Unit};
use prover::bounds::{Verdict, residuals};
use prover::engines::EngineName;
use prover::engines::Simbody;
use prover::run::{Options, prove};
use std::collections::BTreeMap;

/// Every scenario in the directory `scenarios` itself that Simbody accepts and whose drives have constant speed.
fn scenarios() -> Vec<String> {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios");
    let names = std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".toml")).collect();
    // The engine refuses motion laws other than constant speed; free motions have a separate test.
    // The engine also refuses transmissions and friction.
    names.retain(|name| {
        let case = shipped(name).case;
        case.is_steady() && case.mechanism.transmissions().is_empty() && !case.has_friction()
    });
    names.sort();
    assert!(names.len() >= 12, "{names:?}");
    names
}

fn solve(solver: &dyn Solver, case: &Case) -> Trajectory {
    solver.solve(case).unwrap_or_else(|error| panic!("{error}"))
}

fn default() -> Simbody {
    Simbody::new(Simbody::ACCURACY)
}

/// Checks that Simbody and the reference agree in every channel within `condition` times the engine's error bound.
/// Returns the largest errors relative to their scales: first of angles, then of reactions and moments.
fn agree(case: &Case, engine: &Simbody, reference: &dyn Solver, condition: f64) -> [f64; 2] {
    let (truth, run) = (solve(reference, case), solve(engine, case));
    let mut worst = [0.0_f64; 2];
    let found = residuals(&truth, &run).unwrap();
    assert_eq!(found.len(), truth.channels().len(), "a channel is missing");
    for residual in found {
        let kind = residual.channel.kind;
        let bound = condition * engine.noise(case, kind);
        assert_within!(residual.max, bound, "{}: {:e} is beyond {bound:e}", residual.channel, residual.max);
        let share = residual.share();
        match kind.stage {
            Stage::Positions if kind.unit == Unit::Radian => worst[0] = worst[0].larger(share),
            Stage::Reactions | Stage::BalancingMoment => worst[1] = worst[1].larger(share),
            _ => {}
        }
    }
    worst
}

/// Errors may be at most 1e-8 of half the range for angles, and 1e-7 of half the range for reactions and moments.
/// Three accuracies are tested: the loosest useful accuracy, the default, and the tightest accuracy that does not take
/// minutes.
/// Under prescribed motion the results at the three accuracies do not differ: see the engine's `noise`.
#[test]
fn all_scenarios_agree_with_the_reference() {
    for name in scenarios() {
        let case = shipped(&name).case;
        for accuracy in [1e-2, Simbody::ACCURACY, 1e-12] {
            let [angles, reactions] = agree(&case, &Simbody::new(accuracy), &AssurSolver, 1.0);
            println!("{name:24} {accuracy:e}: angles {angles:.1e}, reactions and moments {reactions:.1e}");
            assert_within!(angles, 1e-8, "{name}: {angles:e} {reactions:e}");
            assert_within!(reactions, 1e-7, "{name}: {angles:e} {reactions:e}");
        }
    }
}

#[test]
fn the_other_analytic_side_agrees_too() {
    for name in ["ov7_base.toml", "fourth_class.toml", "quick_return.toml"] {
        agree(&shipped(name).case, &default(), &NewtonSolver, 1.0);
    }
}

/// Between distant instants the integrator alone chooses its steps.
/// The projection must therefore correct more than between close instants.
#[test]
fn distant_instants_are_as_accurate() {
    for name in ["crank_rocker.toml", "ov7_base.toml", "fourth_class.toml", "compressor.toml", "five_bar.toml"] {
        let case = shipped(name).case;
        let sense = case.crank().sense();
        let cranks = (0..=5).map(|k| case.crank().start + sense * 1.9 * f64::from(k)).collect();
        let case = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap();
        for accuracy in [1e-2, 1e-4, 1e-6, Simbody::ACCURACY] {
            agree(&case, &Simbody::new(accuracy), &AssurSolver, 1.0);
        }
    }
}

/// The instants lie before and after the start; they are unordered, and one of them is repeated.
/// Some grids do not contain the start itself.
#[test]
fn instants_may_be_unordered_and_before_the_start() {
    for name in ["crank_rocker.toml", "quick_return.toml", "five_bar.toml"] {
        let case = shipped(name).case;
        let times: Vec<f64> = [3.0, -1.0, 0.5, -2.5, 3.0, 0.0, -0.001].iter().map(|turns| turns * 0.1).collect();
        for times in [times, vec![-0.3, -0.2], vec![0.25, 0.3], vec![0.0]] {
            let case = case.on(Grid::of_times(case.crank(), times)).unwrap();
            agree(&case, &default(), &AssurSolver, 1.0);
        }
    }
    assert_eq!(solve(&default(), &shipped("crank_rocker.toml").case.on(Grid::default()).unwrap()).times().len(), 0);
}

/// Eight variants of a four-bar: unchanged, mirrored, a thousand times as heavy, moved far away, with the two links of
/// every joint exchanged, with one link without mass, with no masses, and with point masses.
/// All variants carry loads.
#[test]
fn variants_of_a_four_bar_agree() {
    let mut base = four_bar([0.4, 0.1, 0.35, 0.3], true);
    base.loads = vec![("rocker".into(), 12.0), ("coupler".into(), 3.0)];
    let mut reversed = base.clone();
    reversed.pins.iter_mut().for_each(|pin| pin.links.reverse());
    let mut light = base.clone();
    light.links[1].mass = None;
    let mut empty = base.clone();
    empty.links.iter_mut().for_each(|link| link.mass = None);
    let mut points = base.clone();
    points.links.iter_mut().for_each(|link| link.mass = Some((2.0, Vec2::zeros(), 0.0)));
    let far = base.moved(Vec2::new(300.0, -200.0), 2.0);
    let variants: [(&str, Spec); 8] = [
        ("mirrored", base.mirrored()),
        ("heavier", base.heavier(1e3)),
        ("base", base),
        ("reversed", reversed),
        ("light", light),
        ("empty", empty),
        ("points", points),
        ("far", far),
    ];
    for (name, spec) in variants {
        let case = spec.scenario().unwrap().case;
        println!("{name}: {:?}", agree(&case, &default(), &AssurSolver, 1.0));
    }
}

/// Largest change of each kind of channel when one joint of a four-bar is displaced by `open` (m), computed by side 1.
fn felt(spec: &Spec, open: f64) -> BTreeMap<(Stage, &'static str), f64> {
    let case = |spec: &Spec| spec.scenario().unwrap().case;
    let truth = solve(&AssurSolver, &case(spec));
    let mut felt = BTreeMap::new();
    for link in 0..spec.links.len() {
        for shift in [Vec2::new(open, 0.0), Vec2::new(0.0, open)] {
            let mut opened = spec.clone();
            opened.links[link].points[1].1 += shift;
            for residual in residuals(&truth, &solve(&AssurSolver, &case(&opened))).unwrap() {
                let kind = residual.channel.kind;
                let most: &mut f64 = felt.entry((kind.stage, kind.unit.symbol())).or_insert(0.0);
                *most = most.larger(residual.max);
            }
        }
    }
    felt
}

/// A joint may be open by the constraint tolerance.
/// The engine's bound on each channel covers the effect of this opening.
/// The bound is never below the effect of the opening, and not much above this effect.
/// The bound assumes a transmission angle of 6 deg.
/// At 7 deg the bound is less than a hundred times the effect; at larger angles the ratio of bound to effect is larger.
#[test]
fn the_noise_bound_covers_the_effect_of_an_open_joint() {
    // This displacement is far above rounding error, and small enough that the effect is proportional to it.
    const OPEN: f64 = 1e-8;
    // Upper limit of bound / effect at 7 deg; measured: 2 to 40.
    const ABOVE: f64 = 100.0;
    for (lengths, is_narrow) in
        [([0.4, 0.1, 0.35, 0.3], false), ([0.4, 0.17, 0.35, 0.3], false), ([0.3, 0.1, 0.35, 0.152], true)]
    {
        let spec = four_bar(lengths, true);
        let case = spec.scenario().unwrap().case;
        let reach = lengths[0];
        let felt = felt(&spec, OPEN);
        for kind in solve(&AssurSolver, &case).channels().iter().map(|channel| channel.kind) {
            let what = (kind.stage, kind.unit.symbol());
            let expected = felt[&what] * Simbody::TOLERANCE * reach / OPEN;
            let bound = default().noise(&case, kind);
            assert_within!(expected, bound, "{lengths:?} {what:?}: an open joint has a larger effect than the bound");
            if is_narrow {
                assert_within!(bound, ABOVE * expected, "{lengths:?} {what:?}: the bound is too wide");
            }
        }
    }
}

#[test]
fn laws_other_than_constant_speeds_are_refused_by_name() {
    let case = shipped("cycloidal_start.toml").case;
    let error = default().solve(&case).unwrap_err();
    assert_eq!(error.kind(), linkage::ErrorKind::Unsupported);
    assert!(error.message().contains("law \"cycloidal\"") && error.way_out().is_some(), "{error}");
}

/// The loads of the press, a force against the motion of its ram, and a torsional spring and a resistance on its rod.
/// The instants lie before and after the start.
#[test]
fn loads_of_all_sorts_agree() {
    let case = shipped("loaded_slider.toml").case;
    let ram = case.mechanism.link_named("ram").unwrap();
    let local = case.mechanism.links()[ram].points[2].local;
    let at = linkage::mechanism::JointSide { link: ram, local };
    let rod = case.mechanism.link_named("rod").unwrap();
    let more = [
        linkage::drive::Load::ResistingForce { at, force: 200.0 },
        linkage::drive::Load::TorsionSpring {
            links: [LinkId(0), rod],
            stiffness: 30.0,
            free_angle: 0.4,
            acts: linkage::drive::Acts::Always,
        },
        linkage::drive::Load::Resistance { link: rod, moment: 7.0 },
    ];
    let case = case.with(|parts| parts.loads.extend(more)).unwrap();
    let cranks = (-7..20).map(|k| 0.05 + 0.31 * f64::from(k)).collect();
    let case = case.on(Grid::of_inputs(case.crank(), cranks)).unwrap();
    println!("{:?}", agree(&case, &default(), &AssurSolver, 1.0));
}

/// All kinds of sliders, with their links in either order.
/// In the Oldham coupling, only sliding joints connect the disc and the output to the crank.
#[test]
fn sliders_agree_however_their_joints_are_written() {
    for sample in sliders::all() {
        for case in [sample.case.clone(), sliders::swapped(&sample.case), crank_last(&sample.case)] {
            agree(&case, &default(), &AssurSolver, 1.0);
        }
    }
}

/// The same case with its joints in reverse order, so that the driven joint comes last.
fn crank_last(case: &Case) -> Case {
    use linkage::mechanism::{AssemblyMode, Mechanism, Structure};
    let joints: Vec<_> = case.mechanism.joints().iter().rev().cloned().collect();
    let driven = JointId(joints.len() - 1 - case.crank().joint.index());
    let mechanism = Mechanism::new(case.mechanism.links().to_vec(), joints).unwrap();
    let structure = Structure::of(&mechanism, &[driven]).unwrap();
    let drives = linkage::drive::Drive { joint: driven, ..case.crank().clone() }.into();
    // Each sample has one group; the order of its links may have changed.
    let turned = structure.groups[GroupId(0)].links != case.structure.groups[GroupId(0)].links;
    let mode = |&mode: &AssemblyMode| match mode {
        AssemblyMode::Ahead if turned => AssemblyMode::Behind,
        AssemblyMode::Behind if turned => AssemblyMode::Ahead,
        mode => mode,
    };
    let modes = case.modes.iter().map(mode).collect();
    case.with(|parts| {
        (parts.mechanism, parts.structure, parts.drives, parts.modes) = (mechanism, structure, drives, modes);
    })
    .unwrap()
}

/// Chains of dyads magnify the errors of motion from dyad to dyad, and the errors of forces in the opposite direction.
#[test]
fn random_mechanisms_agree() {
    for_each(40, |sample| {
        agree(&sample.scenario.case, &default(), &AssurSolver, sample.condition.powi(2));
        Ok(())
    });
}

/// A measure of how near a run comes to a singular pose.
/// The measure is the largest of all speeds and of the square roots of all accelerations, divided by the crank's speed.
/// The measure is at least 1.
/// Lengths are about a metre, so linear and angular speeds have similar magnitudes.
/// The effect of a small error grows with the square of `nearness`.
fn nearness(case: &Case, truth: &Trajectory) -> f64 {
    let crank = case.crank().at(0.0).rate.abs();
    let of = |(channel, values): (&Channel, &[f64])| {
        let most = values.iter().fold(0.0f64, |max, value| max.larger(value.abs()));
        match channel.kind.stage {
            Stage::Velocities => most / crank,
            Stage::Accelerations => most.sqrt() / crank,
            _ => 0.0,
        }
    };
    truth.iter().map(of).fold(1.0, f64::larger)
}

#[test]
fn random_higher_groups_agree() {
    let mut solved = 0;
    for (index, family) in FAMILIES.iter().enumerate() {
        let mut random = RandomSource::from_seed(60 + index as u8);
        for among in [Among::Alone, Among::BehindADyad, Among::CarryingADyad] {
            let (spec, _) = mechanism(&mut random, family, among);
            let Ok(scenario) = spec.scenario() else { continue };
            // Beyond a dead point there is no solution with which to compare, so such a mechanism is skipped.
            if let Ok(truth) = AssurSolver.solve(&scenario.case) {
                agree(&scenario.case, &default(), &AssurSolver, nearness(&scenario.case, &truth).powi(2));
                solved += 1;
            }
        }
    }
    println!("{solved} groups of {} families", FAMILIES.len());
    assert!(solved >= FAMILIES.len(), "{solved}");
}

#[test]
fn the_same_run_gives_the_same_bits() {
    for name in ["ov7_base.toml", "compressor.toml"] {
        let case = shipped(name).case;
        let [one, two] = [(), ()].map(|()| solve(&default(), &case));
        for ((channel, a), (_, b)) in one.iter().zip(two.iter()) {
            assert!(a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()), "{channel}");
        }
    }
}

/// Channels that are not requested have no effect on the requested ones.
#[test]
fn requesting_positions_alone_gives_the_same_positions() {
    let case = shipped("six_bar_slider.toml").case;
    let times = [0.0, 0.01, 0.02];
    let whole = states(&default(), &case, &times).unwrap();
    let bare = case.wanting(linkage::case::Wanted::of(&[Stage::Positions]));
    for (a, b) in whole.iter().zip(states(&default(), &bare, &times).unwrap()) {
        assert!(a.motions == b.motions && a.angles == b.angles);
    }
}

#[test]
fn a_proof_with_simbody_agrees() {
    for name in ["crank_rocker.toml", "quick_return.toml"] {
        let proof = prove(&shipped(name), &Options::default().engine(EngineName::Simbody));
        let proof = proof.unwrap();
        assert_eq!(proof.verdict.word(), "agree", "{name}: {:?}", proof.verdict);
        assert!(proof.engine().info.version.starts_with("Simbody 3."), "{}", proof.engine().info.version);
    }
}

#[test]
fn simbody_is_listed_with_an_accuracy_instead_of_a_step() {
    let engine = prover::engines::named("simbody", 1e-3).unwrap();
    assert!(engine.controls_error());
    assert_eq!(engine.settings().resolution, Simbody::ACCURACY);
    assert_eq!(engine.at(1e-5).settings().resolution, 1e-5);
    assert!(engine.told().iter().any(|(name, value)| *name == "accuracy" && value == "1e-8"));
}

/// The stretched links of the dyad reach 0.45 m.
/// At crank angles beyond acos(0.0475 / 0.24) = 78.5843 deg, the outer joints of the dyad are farther apart than 0.45
/// m.
#[test]
fn a_dead_point_is_an_error_with_time_crank_angle_and_joint() {
    let mut spec = four_bar([0.4, 0.3, 0.25, 0.2], true);
    spec.start = 0.5;
    for (speed, step) in [(10.0, 0.05), (-10.0, 0.05)] {
        spec.speed = speed;
        spec.grid = (0.5, step, 60);
        let case = spec.scenario().unwrap().case;
        for accuracy in [1e-2, Simbody::ACCURACY, 1e-11] {
            let error = Simbody::new(accuracy).solve(&case).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Numeric, "{error}");
            let (_, rest) = error.message().split_once("crank angle ").expect("the message states the crank angle");
            let crank: f64 = rest.split_once(" deg").unwrap().0.parse().unwrap();
            let dead = (0.0475_f64 / 0.24).acos().to_degrees();
            assert_within!((crank - dead).abs(), 0.01, "{crank} instead of {dead}: {error}");
            assert!(error.message().contains("t = ") && error.message().contains("joint \"B\""), "{error}");
            assert!(error.way_out().is_some_and(|way| way.contains("assembled")), "{error}");
            assert!(!error.message().contains(".cpp"), "{error}");
        }
    }
}

/// A slider-crank whose rod is too short at crank angles beyond 261.347 deg.
#[test]
fn a_slider_out_of_reach_is_an_error() {
    let error = default().solve(&sliders::short_rod()).unwrap_err();
    assert!(error.kind() == ErrorKind::Numeric && error.message().contains("crank angle 261.34"), "{error}");
}

/// Without the check that the start pose is closed, Simbody would assemble another nearby pose without a message.
#[test]
fn an_open_start_pose_is_refused() {
    let mut case = shipped("crank_rocker.toml").case;
    case.renumber(|_, joints| joints.last_mut().unwrap().second.local.x += 1e-3);
    assert_eq!(Case::new(case.clone().into_parts()).unwrap_err().kind(), ErrorKind::Geometry);
    let error = default().solve(&case).unwrap_err();
    assert!(error.kind() == ErrorKind::Geometry && error.message().contains("at joint \""), "{error}");
}

#[test]
fn an_invalid_accuracy_is_refused() {
    let case = shipped("crank_rocker.toml").case;
    for accuracy in [0.0, -1e-3, 1.0, f64::NAN, f64::INFINITY] {
        let error = Simbody::new(accuracy).solve(&case).unwrap_err();
        assert!(error.kind() == ErrorKind::Input && error.message().contains("accuracy"), "{error}");
    }
}

/// Free motion by a third solver that shares no code with the two sides.
/// Simbody requests the forces of motor and loads, and integrates the motion by itself.
#[test]
fn run_ups_and_pendulums_agree_with_the_reference() {
    let mut agreed = 0;
    for name in ["crank_rocker_runup", "ov7_new_runup", "compressor_runup", "pendulum", "double_pendulum"] {
        let case = shipped(&format!("{name}.toml")).case;
        let reference = NewtonSolver.solve(&case).unwrap();
        let found = Simbody::new(1e-9).solve(&case).unwrap_or_else(|error| panic!("{name}: {error}"));
        let all = residuals(&reference, &found).unwrap();
        let worst = all.iter().map(|r| r.share()).fold(0.0, f64::larger);
        println!("{name}: {worst:.1e} of the scale");
        assert_within!(worst, 1e-6, "{name}: {worst:e}");
        let proof = prove(&shipped(&format!("{name}.toml")), &Options::default().engine(EngineName::Simbody)).unwrap();
        // Some channels of the compressor's pistons are a thousandth of their natural size, and Simbody is not accurate
        // enough for them.
        // The verdict may therefore be inconclusive, but must not be disagree.
        assert!(!matches!(proof.verdict, Verdict::Disagree { .. }), "{name}: {:?}", proof.verdict);
        agreed += usize::from(matches!(proof.verdict, Verdict::Agree { .. }));
    }
    assert!(agreed >= 4, "{agreed} of 5 agree");
}
