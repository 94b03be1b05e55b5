//! Follows mechanisms through change points, with many different numbers of steps.
//! With any number of steps, no change point is passed silently, and no false change point is reported.

use analytic::PoseSolver;
use linkage::case::Case;
use linkage::error::Result;
use linkage::math::{KeepNan, Vec2, cross};
use linkage::mechanism::{AssemblyMode, LinkId};
use linkage::trajectory::Stage;
use scenario::Scenario;

use crate::common::higher::{Among, FAMILIES, mechanism};
use crate::common::sketch::RandomSource;

/// Numbers of equal steps in which the tests follow the same crank angle.
/// Some numbers are small, some are large, and some have no common factor with any other number of the list.
const STEPS: [usize; 12] = [1, 2, 3, 5, 7, 12, 24, 37, 90, 101, 360, 1009];

/// Follows the branch from the start of a case over an angle of the crank (rad), in equal steps. Returns the directions
/// of all links at the end.
fn end(case: &Case, way: f64, steps: usize, deepest: Stage) -> Result<Vec<Vec2>> {
    let (mut poses, start) = (PoseSolver::new(case)?, case.crank().start);
    for step in 1..=steps {
        poses.solve(start + way * step as f64 / steps as f64, 1.0, 0.0, deepest)?;
    }
    let state = poses.solve(start + way, 1.0, 0.0, Stage::Positions)?;
    Ok(state.motions.iter().map(|motion| motion.direction).collect())
}

/// A four-bar with crank, coupler, rocker and frame of these lengths.
/// The dyad, if there is one, joins the point `at` of the rocker to the ground at `pivot`.
fn six_bar(
    [crank, coupler, rocker, frame]: [f64; 4],
    dyad: Option<(Vec2, Vec2, [f64; 2])>,
    start: f64,
) -> Result<Case> {
    let (at, pivot, [rod, bar]) = dyad.unwrap_or((Vec2::zeros(), Vec2::zeros(), [1.0; 2]));
    let case = Case::builder()
        .ground(&[("O", [0.0, 0.0]), ("C", [frame, 0.0]), ("Q", [pivot.x, pivot.y])])
        .link("crank", &[("O", [0.0, 0.0]), ("A", [crank, 0.0])])
        .link("coupler", &[("A", [0.0, 0.0]), ("B", [coupler, 0.0])])
        .link("rocker", &[("C", [0.0, 0.0]), ("B", [rocker, 0.0]), ("P", [at.x, at.y])])
        .pin("O", "ground", "crank")
        .pin("A", "crank", "coupler")
        .pin("B", "coupler", "rocker")
        .pin("C", "ground", "rocker")
        .crank("O", 1.0)
        .start(start)
        .mode(&["coupler", "rocker"], AssemblyMode::Left);
    match dyad {
        None => case.build(),
        Some(_) => case
            .link("rod", &[("P", [0.0, 0.0]), ("R", [rod, 0.0])])
            .link("bar", &[("Q", [0.1, 0.2]), ("R", [0.1 + bar, 0.2])])
            .pin("P", "rocker", "rod")
            .pin("R", "rod", "bar")
            .pin("Q", "ground", "bar")
            .mode(&["rod", "bar"], AssemblyMode::Right)
            .build(),
    }
}

/// The outer joints of the dyad of a four-bar are farthest apart where the crank points away from the rocker's ground
/// joint (crank angle pi). This pose is a change point if coupler and rocker together are exactly as long as the
/// distance of the outer joints.
#[test]
fn no_step_passes_over_the_change_point_of_a_four_bar() {
    let mut random = RandomSource::from_seed(41);
    for _ in 0..40 {
        let [crank, frame] = [random.number(0.1, 1.0), random.number(1.1, 3.0)];
        let rocker = random.number(0.5, 2.0).larger(crank).smaller(frame);
        let (start, way) = (random.number(1.0, 2.9), random.number(2.3, 3.2));
        for defect in [0.0, 1e-10, 1e-8, 1e-5, 1e-2, -1e-10, -1e-8, -1e-5] {
            let coupler = crank + frame - rocker + defect * frame;
            let case = six_bar([crank, coupler, rocker, frame], None, start).unwrap();
            for steps in STEPS {
                for deepest in [Stage::Positions, Stage::Accelerations] {
                    let found = end(&case, way, steps, deepest);
                    let side = |directions: &[Vec2]| cross(directions[2], directions[3]).signum();
                    let what = format!("{crank} {frame} {rocker} {defect:e} in {steps} from {start} by {way}");
                    if defect > 0.0 {
                        let directions = found.unwrap_or_else(|error| panic!("{what}: {error}"));
                        let begun = end(&case, 0.0, 1, deepest).unwrap();
                        assert_eq!(side(&directions), side(&begun), "{what}: the run ends on the other branch");
                    } else {
                        let error = found.expect_err(&what);
                        let at = error.input().unwrap_or_else(|| panic!("{what}: {error}")).value;
                        let off = if defect == 0.0 { 1e-3 } else { way };
                        assert!((at - std::f64::consts::PI).abs() < off, "{what}: {error}");
                    }
                }
            }
        }
    }
}

/// A dyad on the rocker of a crank-rocker.
/// At some crank angle, the distance of the dyad's outer joints has an extreme.
/// The pose at this crank angle is a change point if the lengths of the dyad's links just allow the extreme distance.
#[test]
fn no_step_passes_over_the_change_point_of_a_dyad_on_a_dyad() {
    let mut random = RandomSource::from_seed(43);
    let lengths = [0.3, 1.1, 0.8, 1.0];
    for _ in 0..24 {
        let (at, pivot) = (random.vector(0.3, 1.2), Vec2::new(1.0, 0.0) + random.vector(1.0, 3.0));
        let (start, way) = (random.number(-3.0, 3.0), if random.yes() { 6.0 } else { -6.0 });
        // The distance of the dyad's outer joints has its extremes at the ends of the rocker's swing, and where the
        // rocker is in line with `pivot`.
        let plain = six_bar(lengths, None, start).unwrap();
        let mut poses = PoseSolver::new(&plain).unwrap();
        let mut distance = |gone: f64| {
            let state = poses.solve(start + gone, 1.0, 0.0, Stage::Positions).unwrap();
            (state.motions[LinkId(3)].point(at) - pivot).norm()
        };
        let places: Vec<f64> = (0..=6000).map(|k| way * f64::from(k) / 6000.0).collect();
        let distances: Vec<f64> = places.iter().map(|&gone| distance(gone)).collect();
        let extreme = |sign: f64| {
            let most = (1..6000).max_by(|&a, &b| (sign * distances[a]).total_cmp(&(sign * distances[b]))).unwrap();
            (sign * distances[most] > sign * distances[0] + 1e-3
                && sign * distances[most] > sign * distances[6000] + 1e-3)
                .then_some(most)
        };
        for sign in [1.0, -1.0] {
            let Some(most) = extreme(sign) else { continue };
            let (mut low, mut high) = (places[most - 1], places[most + 1]);
            for _ in 0..80 {
                let [a, b] = [1.0, 2.0].map(|third| low + (high - low) * third / 3.0);
                if sign * distance(a) < sign * distance(b) { low = a } else { high = b }
            }
            let extreme = distance(f64::midpoint(low, high));
            let [least, most] = [f64::smaller, f64::larger].map(|of| distances.iter().copied().fold(extreme, of));
            for defect in [0.0, 1e-9, 1e-7, 1e-4, -1e-7, -1e-4] {
                let reach = extreme * (1.0 + sign * defect);
                // The distance of the dyad's outer joints has two extremes; `reach` decides whether the dyad fits at
                // `extreme`.
                // At the opposite extreme, the dyad fits with a margin.
                let [rod, bar] = if sign > 0.0 {
                    let off = random.number(-0.4, 0.4) * least;
                    [0.5 * reach - off, 0.5 * reach + off]
                } else {
                    let bar = random.number(0.6, 0.9) * most;
                    [reach + bar, bar]
                };
                let case = six_bar(lengths, Some((at, pivot, [rod, bar])), start).unwrap();
                for steps in STEPS {
                    let found = end(&case, way, steps, Stage::Accelerations);
                    let what = format!("{at:?} {pivot:?} {rod} {bar} {defect:e} in {steps} from {start} by {way}");
                    assert_eq!(found.is_ok(), defect > 0.0, "{what}: {:?}", found.err());
                }
            }
        }
    }
}

/// The case with one of its ground points moved.
fn moved(spec: &lab::specimens::spec::Spec, by: f64) -> Option<Scenario> {
    let mut spec = spec.clone();
    let last = spec.ground.len() - 1;
    spec.ground[last].1.x += by;
    spec.scenario().ok()
}

/// Random higher groups: a ground point is moved until the group just passes a dead point, or just cannot pass it.
/// For any number of steps, a run ends near the pose of a run with 6000 steps, or reports an error.
#[test]
fn higher_groups_do_not_change_branch_silently() {
    const WAY: f64 = 1.5;
    let (mut random, mut tried, mut ended, mut refused) = (RandomSource::from_seed(47), 0, 0, 0);
    for family in &FAMILIES {
        for among in [Among::Alone, Among::BehindADyad] {
            for _ in 0..6 {
                let spec = mechanism(&mut random, family, among).0;
                let fine = |by: f64, steps: usize| {
                    let found = moved(&spec, by).map(|scenario| end(&scenario.case, WAY, steps, Stage::Positions));
                    found.and_then(Result::ok)
                };
                let (Some(_), None) = (fine(0.0, 1500), fine(0.15, 1500)) else { continue };
                let [mut passes, mut ends] = [0.0, 0.15];
                for _ in 0..30 {
                    let middle = f64::midpoint(passes, ends);
                    if fine(middle, 1500).is_some() { passes = middle } else { ends = middle }
                }
                let Some(expected) = fine(passes - 1e-4, 6000) else { continue };
                tried += 1;
                for defect in [-1e-5, -1e-7, -1e-9, 0.0, 1e-9, 1e-7, 1e-5, 1e-3] {
                    let Some(scenario) = moved(&spec, passes + defect) else { continue };
                    for steps in STEPS {
                        let Ok(found) = end(&scenario.case, WAY, steps, Stage::Positions) else {
                            refused += 1;
                            continue;
                        };
                        ended += 1;
                        let off = found.iter().zip(&expected).fold(0.0f64, |off, (a, b)| off.larger((a - b).norm()));
                        let what = format!("{}, {among:?}, {defect:e} in {steps}", family.topology.name);
                        assert!(off < 0.05, "{what}: off by {off:e}\n{}", spec.toml());
                    }
                }
            }
        }
    }
    println!("{tried} mechanisms, {ended} ended, {refused} refused");
    assert!(tried >= 10 && ended >= 100 && refused >= 100, "{tried} mechanisms, {ended} ended, {refused} refused");
}
