//! Random mechanisms made of dyads of all five kinds.

use linkage::math::{KeepNan, cross};
use linkage::mechanism::assembly::transmission_sine;
use linkage::mechanism::{GroupKind, JointId, LinkPose, Pose, StartGroup, first_pose};

use super::sketch::{RandomSource, SpecimenSketch};
use super::spec::{Ask, Dyad, Spec, Start};
use scenario::Scenario;

/// Upper limit of the distance of joints and mass centres from the origin (m).
/// The constant is also used as the scale of link angles (rad).
pub const REACH: f64 = 4.0;
/// Smallest allowed sine of a transmission angle: the sine of 10 degrees.
pub const DEAD: f64 = 0.17364817766693033;
/// Smallest distance between the outer pins of an RPR dyad (m): the shortest length that is drawn for a link.
const CLOSE: f64 = 0.1;

/// The five kinds of dyads.
/// Each kind has three flags: whether the first outer, the inner and the second outer joint are
/// prismatic.
pub const SORTS: [[bool; 3]; 5] =
    [[false, false, false], [false, false, true], [false, true, false], [false, true, true], [true, false, true]];

/// A mechanism that can be assembled at every instant of its grid and stays away from dead points.
pub struct DyadSpecimen {
    /// The mechanism as data.
    pub spec: Spec,
    /// The scenario, read from the text of `spec`.
    pub scenario: Scenario,
    /// Product of 1 / sin(smallest transmission angle) of all dyads.
    /// A chain of dyads can magnify an error by this factor.
    pub condition: f64,
}

/// Adds a dyad between two links, and its assembly mode.
pub fn dyad(sketch: &mut SpecimenSketch, slides: [bool; 3], bases: [usize; 2]) -> [usize; 2] {
    let hook = sketch.poses[bases[0]].origin + sketch.random.vector(0.1, 0.6);
    let (mut one, mut two) = (sketch.link(hook), sketch.link(hook));
    // The two links are exchanged at random, so that their order in the mechanism and in the group varies.
    if sketch.random.yes() {
        (one, two) = (two, one);
    }
    let first = sketch.join(slides[0], bases[0], one, hook);
    let at = first.places[1] + sketch.random.vector(0.1, 1.0);
    let inner = sketch.join(slides[1], one, two, at);
    let at = inner.places[1] + sketch.random.vector(0.1, 1.0);
    let last = sketch.join(slides[2], two, bases[1], at);
    let mut links = [one, two].map(|link| sketch.name(link));
    let ahead = match slides {
        [false, false, false] => {
            let (a, b) = (first.places[1], last.places[0]);
            let mut left = cross(b - a, inner.places[0] - a) > 0.0;
            if sketch.random.yes() {
                links.reverse();
                left = !left;
            }
            sketch.spec.dyads.push(Dyad { links, left });
            return [one, two];
        }
        [false, false, true] => last.axis.dot(&(inner.places[0] - first.places[1])),
        [true, false, false] => first.axis.dot(&(inner.places[0] - last.places[0])),
        [false, true, false] => {
            let along = inner.axis.dot(&(last.places[0] - first.places[1]));
            if inner.first == one { along } else { -along }
        }
        _ => return [one, two],
    };
    if sketch.random.yes() {
        links.reverse();
    }
    let ask = if ahead > 0.0 { Ask::Ahead } else { Ask::Behind };
    sketch.spec.starts.push(Start { links: links.into(), ask });
    [one, two]
}

/// A kind of dyad, chosen at random from the allowed kinds. The order of its joints may be reversed.
pub fn sort(random: &mut RandomSource, allowed: &[[bool; 3]]) -> [bool; 3] {
    let mut slides = allowed[random.index(allowed.len())];
    if random.yes() {
        slides.reverse();
    }
    slides
}

/// A crank and `dyads` dyads.
/// Each dyad has one end on one of the last two links, and the other end on a random link or the ground.
pub fn chain(random: &mut RandomSource, allowed: &[[bool; 3]], dyads: usize) -> (Spec, Vec<LinkPose>) {
    let mut sketch = SpecimenSketch::new(random, [0.1, 1.0]);
    for _ in 0..dyads {
        let count = sketch.poses.len();
        let moving = count - 1 - sketch.random.index(2.min(count - 1));
        let other = if sketch.random.yes() { 0 } else { sketch.random.index(count) };
        // If both ends of a dyad were on the same link, the dyad would only enlarge this link. In this case one end is
        // moved to the ground.
        let other = if other == moving { 0 } else { other };
        let bases = if sketch.random.yes() { [moving, other] } else { [other, moving] };
        let slides = sort(sketch.random, allowed);
        dyad(&mut sketch, slides, bases);
    }
    sketch.finish()
}

/// Reads a chain.
/// `None` if, at an instant of the grid, the mechanism leaves `REACH` or comes near a dead point.
/// The poses come from [`first_pose`].
/// No solver is used, because a solver also computes the range of the mechanism, which takes longer than the rest of
/// this function.
pub fn sample(spec: Spec) -> Option<DyadSpecimen> {
    let scenario = spec.scenario().ok()?;
    let case = &scenario.case;
    let (mechanism, structure) = (&case.mechanism, &case.structure);
    let wanted: Vec<StartGroup> =
        case.modes.iter().map(|&mode| StartGroup { mode: Some(mode), ..StartGroup::default() }).collect();
    let place = |cranks: &f64| first_pose(mechanism, structure, &[case.crank().coordinate(*cranks)], &wanted).ok();
    let poses: Vec<Pose> =
        case.grid.inputs.iter().map(place).map(|found| found.map(|(pose, _)| pose)).collect::<Option<_>>()?;
    let joint = |pose: &Pose, joint: JointId| {
        let side = mechanism.joints()[joint].second;
        pose.0[side.link].point(side.local)
    };
    let far = |pose: &Pose| {
        let centres = mechanism.links().iter().zip(&pose.0).map(|(link, own)| own.point(link.mass_centre));
        centres.chain(mechanism.joints().ids().map(|index| joint(pose, index))).any(|at| !(at.norm() <= REACH))
    };
    if poses.iter().any(far) {
        return None;
    }
    let mut condition = 1.0;
    for group in &structure.groups {
        let is_close = |pose: &Pose| (joint(pose, group.outer[0]) - joint(pose, group.outer[1])).norm() < CLOSE;
        if group.kind == GroupKind::Rpr && poses.iter().any(is_close) {
            return None;
        }
        let sine = |pose: &Pose| transmission_sine(mechanism, group, pose).expect("a dyad");
        // The sign of the sine must not change.
        // At a change of sign, two axes become parallel: a slider goes to infinity and returns from the opposite
        // direction.
        let sign = sine(&poses[0]).signum();
        let least = poses.iter().map(|pose| sign * sine(pose)).fold(1.0, f64::smaller);
        if !(least >= DEAD) {
            return None;
        }
        condition /= least;
    }
    Some(DyadSpecimen { spec, scenario, condition })
}
