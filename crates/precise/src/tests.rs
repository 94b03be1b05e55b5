//! Derivatives, compared with differences in double-double; loads, compared with `Load::act`.

use std::f64::consts::PI;
use std::sync::Arc;

use linkage::case::{Case, CaseNumber};
use linkage::drive::{Acts, Course, Load, MotionLaw};
use linkage::math::{Curve, Vec2};
use linkage::mechanism::{AssemblyMode, JointId, JointSide, LinkId};

use super::{CaseNumbers, Dual, Long, Readings, Scalar, Whole};

/// A crank, a rod, and a block on an inclined guide, with masses.
fn slider_crank() -> Case {
    Case::builder()
        .ground(&[("O", [0.01, 0.02]), ("G", [0.3, 0.05])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.01])])
        .link("rod", &[("A", [0.0, 0.0]), ("B", [0.35, 0.02]), ("C", [0.2, 0.1])])
        .link("block", &[("B", [0.0, 0.0]), ("P", [0.02, 0.01])])
        .mass("crank", 1.0, [0.03, 0.01], 0.002)
        .mass("rod", 2.0, [0.175, 0.01], 0.02)
        .mass("block", 3.0, [0.01, 0.0], 0.004)
        .pin("O", "ground", "crank")
        .pin("A", "crank", "rod")
        .pin("B", "rod", "block")
        .slider("guide", ("ground", "G"), ("block", "P"), [0.2, 0.1])
        .crank("O", 10.0)
        .start(0.7)
        .mode(&["rod", "block"], AssemblyMode::Ahead)
        .instants(8)
        .build()
        .unwrap()
}

fn side(link: usize, x: f64, y: f64) -> JointSide {
    JointSide { link: LinkId(link), local: Vec2::new(x, y) }
}

/// Every kind of load that the solver accepts.
fn all_loads() -> Vec<Load> {
    let (guide, links) = (JointId(3), [LinkId(0), LinkId(3)]);
    let points: Vec<(f64, f64)> = (0..6).map(|k| (f64::from(k), f64::from(k * k) - 4.0)).collect();
    vec![
        Load::Resistance { link: LinkId(2), moment: 3.0 },
        Load::Moment { link: LinkId(1), moment: Course::table(&points, 1, true), acts: Acts::CounterClockwise },
        Load::Moment { link: LinkId(2), moment: Course::Constant(4.0), acts: Acts::Always },
        Load::Force {
            at: side(2, 0.2, 0.1),
            force: [Course::Constant(30.0), Course::table(&points, 1, false)],
            follows: true,
        },
        Load::Force { at: side(3, 0.02, 0.01), force: [Course::Constant(9.0), Course::Constant(2.0)], follows: false },
        Load::ResistingForce { at: side(2, 0.2, 0.1), force: 7.0 },
        Load::Spring { ends: [side(0, 0.4, 0.3), side(2, 0.2, 0.1)], stiffness: 200.0, free_length: 0.1 },
        Load::Damper { ends: [side(0, 0.4, 0.3), side(2, 0.2, 0.1)], damping: 5.0 },
        Load::TorsionSpring { links: [LinkId(1), LinkId(2)], stiffness: 3.0, free_angle: 0.2, acts: Acts::Always },
        Load::TorsionDamper { links: [LinkId(0), LinkId(2)], damping: 0.3 },
        Load::SlideForce { joint: guide, links, force: Course::Constant(40.0), acts: Acts::Clockwise },
        Load::SlideForce { joint: guide, links, force: Course::Constant(50.0), acts: Acts::CounterClockwise },
        Load::SlideSpring { joint: guide, links, stiffness: 90.0, free_slide: -0.7, acts: Acts::CounterClockwise },
        Load::SlideDamper { joint: guide, links, damping: 11.0 },
    ]
}

fn laws() -> Vec<MotionLaw> {
    vec![
        MotionLaw::ConstantSpeed(10.0),
        MotionLaw::Ramp { speed: 12.0, time: 0.4 },
        MotionLaw::Cycloidal { rise: 2.0, time: 0.3 },
        MotionLaw::Curve(Arc::new(Curve::Harmonic { amplitude: 0.6, period: 0.5, phase: 0.3 })),
    ]
}

fn with_law(case: &Case, law: &MotionLaw) -> Case {
    let law = law.clone();
    case.with(|parts| {
        parts.grid = linkage::case::Grid { times: vec![0.0], inputs: vec![parts.drives.crank().start] };
        parts.drives.crank_mut().motion = linkage::drive::DriveMotion::Prescribed { law, motor: None };
    })
    .unwrap()
}

/// All channels of the case at a time (s), in any scalar.
fn channels<S: Scalar>(case: &Case, numbers: &CaseNumbers<S>, time: f64, keeps_input: bool) -> Vec<S> {
    let whole = Whole::new(case, numbers);
    let angles: Vec<f64> = case.start.0.iter().map(|pose| pose.angle).collect();
    let at = whole.near(&case.start.motions(), &angles, time, keeps_input).unwrap();
    let readings = Readings::of(whole);
    case.all_channels().iter().map(|channel| readings.read(&at, channel).unwrap()).collect()
}

/// Derivatives of all channels with respect to one number, from differences in double-double.
/// Extrapolation removes the error terms in h^2 and h^4.
fn differences(case: &Case, number: CaseNumber, time: f64) -> Vec<f64> {
    let moved = |h: f64| {
        let lift = |own: CaseNumber, value: f64| Long::of(value) + if own == number { Long::of(h) } else { Long::ZERO };
        let numbers = CaseNumbers::lifted(case, &lift, &|_, _| Vec::new()).unwrap();
        channels(case, &numbers, time, false)
    };
    let central = |h: f64| -> Vec<Long> {
        let (up, down) = (moved(h), moved(-h));
        up.iter().zip(&down).map(|(up, down)| (*up - *down) / Long::of(2.0 * h)).collect()
    };
    let h = 1e-4;
    let [one, half, quarter] = [central(h), central(h / 2.0), central(h / 4.0)];
    (0..one.len())
        .map(|k| {
            let better = |a: Long, b: Long| (b * Long::of(4.0) - a) / Long::of(3.0);
            let (first, second) = (better(one[k], half[k]), better(half[k], quarter[k]));
            ((second * Long::of(16.0) - first) / Long::of(15.0)).rounded()
        })
        .collect()
}

#[test]
fn derivatives_equal_differences_in_double_double() {
    let case = slider_crank().with(|parts| parts.loads = all_loads()).unwrap();
    for law in laws() {
        let case = with_law(&case, &law);
        let numbers = case.numbers();
        let mut found: Vec<Vec<f64>> = Vec::new();
        for part in numbers.chunks(8) {
            let lift = |own: CaseNumber, value: f64| {
                let slopes = std::array::from_fn(|k| f64::from(part.get(k).is_some_and(|(number, _)| *number == own)));
                Dual::<f64, 8> { value, slopes }
            };
            let duals = CaseNumbers::lifted(&case, &lift, &|_, _| Vec::new()).unwrap();
            let values = channels(&case, &duals, 0.02, false);
            found.extend((0..part.len()).map(|k| values.iter().map(|own| own.slopes[k]).collect()));
        }
        let mut not_zero = 0;
        for ((number, _), found) in numbers.iter().zip(&found) {
            let expected = differences(&case, *number, 0.02);
            let most = expected.iter().fold(0.0, |most: f64, own| if own.abs() > most { own.abs() } else { most });
            not_zero += usize::from(most > 0.0);
            for ((found, expected), channel) in found.iter().zip(&expected).zip(case.all_channels()) {
                // Tables are evaluated in doubles, which limits the accuracy of the differences.
                let off = (found - expected).abs();
                assert!(off <= 1e-10 * most, "{law:?} {number:?} {channel}: {found} and {expected}, of {most}");
            }
        }
        // Some numbers, such as the mass of the ground, change no channel. A point that carries no joint and no load
        // affects only the channels of this point.
        assert!(not_zero > 60, "{not_zero}");
    }
}

/// Derivatives at a constant input: a higher speed shortens the time.
#[test]
fn an_instant_of_an_input_moves_in_time() {
    let case = slider_crank();
    let lift = |own: CaseNumber, value: f64| Dual::<f64, 1> {
        value,
        slopes: [f64::from(own == CaseNumber::Law { drive: 0, part: 0 })],
    };
    let numbers = CaseNumbers::lifted(&case, &lift, &|_, _| Vec::new()).unwrap();
    let values = channels(&case, &numbers, 0.02, true);
    for (channel, own) in case.all_channels().iter().zip(&values) {
        // Positions do not depend on the speed. Velocities are proportional to the speed, accelerations to its square.
        let [power, scale] = match channel.kind.stage {
            linkage::trajectory::Stage::Positions => [0.0, 1.0],
            linkage::trajectory::Stage::Velocities => [1.0, 1.0],
            linkage::trajectory::Stage::Accelerations => [2.0, 10.0],
            linkage::trajectory::Stage::Reactions | linkage::trajectory::Stage::BalancingMoment => continue,
        };
        let off = (own.slopes[0] - power * own.value / 10.0).abs();
        assert!(off < 1e-13 * (scale + own.value.abs()), "{channel}: {own:?}");
    }
}

/// The resultants of the loads equal the resultants that the other solvers compute.
#[test]
fn loads_equal_those_of_the_sides() {
    use linkage::case::JointReactions;
    let plain = slider_crank();
    for load in all_loads() {
        let case = plain.with(|parts| parts.loads = vec![load.clone()]).unwrap();
        let at = |case: &Case| {
            let numbers = CaseNumbers::<f64>::of(case).unwrap();
            let whole = Whole::new(case, &numbers);
            let angles: Vec<f64> = case.start.0.iter().map(|pose| pose.angle).collect();
            whole.near(&case.start.motions(), &angles, 0.0, false).unwrap()
        };
        let (loaded, free) = (at(&case), at(&plain));
        let motions: Vec<linkage::math::Motion> = loaded
            .frames
            .iter()
            .map(|own| linkage::math::Motion {
                origin: Vec2::new(own.origin.x, own.origin.y),
                direction: Vec2::new(own.direction.x, own.direction.y),
                velocity: Vec2::new(own.velocity.x, own.velocity.y),
                omega: own.omega,
                acceleration: Vec2::new(own.acceleration.x, own.acceleration.y),
                alpha: own.alpha,
            })
            .collect();
        let joints = case.mechanism.joints().len();
        let (forces, moments) = (vec![Vec2::zeros(); joints], vec![0.0; joints]);
        let reactions = JointReactions { forces: &forces, moments: &moments, transmitted: &[] };
        // By the principle of virtual work, the load reduces the crank's moment by the power of the load divided by the
        // crank's speed (10 rad/s).
        let power = case.load_power(&motions, &loaded.angles, reactions);
        let off = (loaded.efforts[0] - free.efforts[0]) + power / 10.0;
        assert!(off.abs() < 1e-12 * (1.0 + power.abs()), "{load:?}: {off}, {power}");
    }
}

/// The force on the ground is the sum of weights, inertia forces and loads.
#[test]
fn the_frame_carries_all_forces() {
    let case = slider_crank().with(|parts| parts.loads = all_loads()).unwrap();
    let numbers = CaseNumbers::<Long>::of(&case).unwrap();
    let whole = Whole::new(&case, &numbers);
    let angles: Vec<f64> = case.start.0.iter().map(|pose| pose.angle).collect();
    let at = whole.near(&case.start.motions(), &angles, 0.0, false).unwrap();
    let (force, moment) = whole.shaking(&at);
    let loads = super::loads::loads(&case, &numbers, &at, Long::of(case.crank().start));
    let (mut sum, mut turning) = (loads[0].0, loads[0].1);
    for (link, load) in loads.iter().enumerate().skip(1) {
        let own = at.inertia(&numbers, LinkId(link));
        (sum, turning) = (sum + own.0 + load.0, turning + own.1 + load.1);
    }
    let off = [sum.x - force.x, sum.y - force.y, turning - moment];
    assert!(off.iter().all(|own| own.abs().rounded() < 1e-25), "{off:?}");
}

#[test]
fn duals_of_long_numbers_keep_thirty_digits() {
    let x = Dual::<Long, 1> { value: Long::of(2.0), slopes: [Long::ONE] };
    let (sin, cos) = (x * x).sin_cos();
    // d sin(x^2) / dx = 2 x cos(x^2).
    let off = sin.slopes[0] - Long::of(4.0) * cos.value;
    assert!(off.abs().rounded() < 1e-30);
    let root = (x / Dual::of(PI)).sqrt();
    let off = root.slopes[0] * root.value * Long::of(2.0 * PI) - Long::ONE;
    assert!(off.abs().rounded() < 1e-30);
}
