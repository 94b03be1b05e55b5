use super::super::random::{Lcg, group, mechanism, size};
use super::super::transmission_sine;
use super::*;
use crate::math::KeepNan;
use crate::mechanism::{Joint, JointId, JointKind, LinkId};

const CASES: usize = 100_000;

/// A dyad of links 3 and 4, attached to links 1 and 2. Links 1 and 2 have random poses.
struct Case {
    mechanism: Mechanism,
    group: Group,
    pose: Pose,
}

fn case(random: &mut Lcg, kind: GroupKind) -> Case {
    let letters: Vec<bool> = kind.letters().unwrap().chars().map(|letter| letter == 'P').collect();
    let outer = if random.yes() { [letters[0], letters[2]] } else { [letters[2], letters[0]] };
    let joints = vec![
        random.joint("A", outer[0], LinkId(1), LinkId(3)),
        random.joint("B", letters[1], LinkId(3), LinkId(4)),
        random.joint("C", outer[1], LinkId(2), LinkId(4)),
    ];
    let mechanism = mechanism(5, joints);
    let mut pose = Pose((0..5).map(|_| random.pose()).collect());
    pose.0[LinkId(0)] = LinkPose::GROUND;
    let group = group(&mechanism, &[LinkId(3), LinkId(4)], kind);
    Case { mechanism, group, pose }
}

impl Case {
    fn joint(&self, index: JointId) -> &Joint {
        &self.mechanism.joints()[index]
    }

    fn place(&self, pose: &Pose, joint: JointId, link: LinkId) -> Vec2 {
        pose.0[link].point(self.joint(joint).on(link).unwrap())
    }

    fn axis(&self, pose: &Pose, joint: JointId) -> Vec2 {
        let joint = self.joint(joint);
        rotated(unit(pose.0[joint.first.link].angle), joint.axis_on(joint.first.link).unwrap())
    }

    /// Rotates `link` until the two axes of the prismatic `joint` agree: the axis on `link` and the axis on the joint's
    /// other link.
    fn with_turned(&self, mut pose: Pose, joint: JointId, link: LinkId) -> Pose {
        let other = self.joint(joint).other(link).link;
        let angle = |axis: Vec2| axis.y.atan2(axis.x);
        let axis = |of: LinkId| angle(self.joint(joint).axis_on(of).unwrap());
        pose.0[link].angle = pose.0[other].angle + axis(other) - axis(link);
        pose
    }

    /// Opening of a prismatic `joint`: the distance of the joint's point on the second link from the axis through the
    /// joint's point on the first link.
    fn off_line(&self, pose: &Pose, joint: JointId) -> f64 {
        let own = self.joint(joint);
        cross(
            self.axis(pose, joint),
            self.place(pose, joint, own.second.link) - self.place(pose, joint, own.first.link),
        )
    }

    /// Margin to the limit of assembly: positive if the dyad has configurations, negative otherwise.
    /// The margin is computed without the tested formulas, from the triangle inequality or from samples of a function.
    fn reach(&self) -> f64 {
        let outer_pin =
            |joint: JointId, link: LinkId| self.place(&self.pose, joint, self.joint(joint).other(link).link);
        match self.group.kind {
            GroupKind::Rrr => {
                // The margin of the triangle inequality, for each of the three sides.
                let span = |link: LinkId, outer: JointId| {
                    (self.joint(JointId(1)).on(link).unwrap() - self.joint(outer).on(link).unwrap()).norm()
                };
                let (a, b) = (span(LinkId(3), JointId(0)), span(LinkId(4), JointId(2)));
                let c = (outer_pin(JointId(0), LinkId(3)) - outer_pin(JointId(2), LinkId(4))).norm();
                (a + b - c).smaller(a + c - b).smaller(b + c - a)
            }
            GroupKind::Rrp => {
                // The squared distance of the inner joint from the outer pin is a function of the slide.
                // This function is a parabola, so three values determine it.
                let (slider, outer, rod, pin) =
                    if self.joint(JointId(0)).slides() { (3, 0, 4, 2) } else { (4, 2, 3, 0) };
                let ([slider, rod], [outer, pin]) = ([slider, rod].map(LinkId), [outer, pin].map(JointId));
                let mut pose = self.with_turned(self.pose.clone(), outer, slider);
                let axis = self.axis(&pose, outer);
                let normal = turned(axis);
                let off = normal.dot(&(self.place(&pose, outer, slider) - outer_pin(outer, slider)));
                pose.0[slider].origin -= normal * off;
                let squared = |slide: f64| {
                    let mut moved = pose.clone();
                    moved.0[slider].origin += axis * slide;
                    (self.place(&moved, JointId(1), slider) - outer_pin(pin, rod)).norm_squared()
                };
                let [before, here, after] = [-1.0, 0.0, 1.0].map(squared);
                let (a, b) = ((before + after) / 2.0 - here, (after - before) / 2.0);
                let least = here - b * b / (4.0 * a);
                let rod = self.joint(JointId(1)).on(rod).unwrap() - self.joint(pin).on(rod).unwrap();
                rod.norm() - least.larger(0.0).sqrt()
            }
            GroupKind::Rpr => {
                // The distance from the line is a function of the links' common angle.
                // This function is a sinusoid plus a constant, so three values determine it.
                let off = |angle: f64| {
                    let mut pose = self.pose.clone();
                    pose.0[LinkId(3)].angle = angle;
                    pose = self.with_turned(pose, JointId(1), LinkId(4));
                    for (link, joint) in [(LinkId(3), JointId(0)), (LinkId(4), JointId(2))] {
                        let local = self.joint(joint).on(link).unwrap();
                        pose.0[link] = LinkPose::through(local, outer_pin(joint, link), pose.0[link].angle);
                    }
                    self.off_line(&pose, JointId(1))
                };
                let [f0, f1, f2] = [0.0, 2.0, 4.0].map(|k: f64| off(k * std::f64::consts::FRAC_PI_3));
                let mean = (f0 + f1 + f2) / 3.0;
                let (a, b) = (f0 - mean, (f1 - f2) / 3f64.sqrt());
                a.hypot(b) - mean.abs()
            }
            GroupKind::Rpp | GroupKind::Prp | GroupKind::Higher | GroupKind::Driven => f64::INFINITY,
        }
    }

    /// The mode of an assembled dyad by the definitions of [`AssemblyMode`].
    fn mode(&self, pose: &Pose) -> AssemblyMode {
        let inner = self.place(pose, JointId(1), LinkId(3));
        let (a, c) = (self.place(pose, JointId(0), LinkId(3)), self.place(pose, JointId(2), LinkId(4)));
        let ahead = |is: bool| if is { AssemblyMode::Ahead } else { AssemblyMode::Behind };
        match self.group.kind {
            GroupKind::Rrr if cross(c - a, inner - a) > 0.0 => AssemblyMode::Left,
            GroupKind::Rrr => AssemblyMode::Right,
            GroupKind::Rrp => {
                let (guide, pin) = if self.joint(JointId(0)).slides() { (JointId(0), c) } else { (JointId(2), a) };
                ahead(self.axis(pose, guide).dot(&(inner - pin)) > 0.0)
            }
            GroupKind::Rpr => {
                let base = if self.joint(JointId(1)).first.link == LinkId(3) { c - a } else { a - c };
                ahead(self.axis(pose, JointId(1)).dot(&base) > 0.0)
            }
            GroupKind::Rpp | GroupKind::Prp | GroupKind::Higher | GroupKind::Driven => AssemblyMode::Only,
        }
    }
}

/// Checks 100 000 dyads of every kind, in all orders of links and sides.
/// Every configuration closes and has the mode that it reports.
/// The sign of a configuration's transmission sine agrees with its mode.
/// The two configurations of a dyad differ from each other.
/// An independent criterion confirms whether a configuration exists.
#[test]
fn random_dyads_of_every_kind() {
    let kinds = [GroupKind::Rrr, GroupKind::Rrp, GroupKind::Rpr, GroupKind::Rpp, GroupKind::Prp];
    for kind in kinds {
        let mut random = Lcg(kind as u64 + 1);
        let (mut some, mut worst) = (0, 0.0f64);
        for _ in 0..CASES {
            let case = case(&mut random, kind);
            let reach = case.reach();
            let all = match configurations(&case.mechanism, &case.group, &case.pose) {
                Ok(all) => all,
                Err(error) => {
                    // The independent criterion has different rounding errors from the module under test. The two
                    // results may therefore differ at the limit of assembly.
                    assert!(reach <= 1e-14, "{kind:?}: {error}, but there is room of {reach}");
                    assert!(error.kind() == ErrorKind::Geometry && error.way_out().is_some(), "{error}");
                    continue;
                }
            };
            some += 1;
            assert!(reach >= -1e-14, "{kind:?}: a configuration beyond reach by {reach}");
            let poses: Vec<Pose> = all
                .iter()
                .map(|one| {
                    let mut pose = case.pose.clone();
                    (pose.0[LinkId(3)], pose.0[LinkId(4)]) = (one.links[0], one.links[1]);
                    pose
                })
                .collect();
            for (one, pose) in all.iter().zip(&poses) {
                // Nearly parallel axes intersect far away, so the size includes the assembled dyad.
                let size = size(&case.mechanism, pose);
                let sine = transmission_sine(&case.mechanism, &case.group, pose).unwrap();
                worst = worst.larger(pose.closure(&case.mechanism) / size);
                // The two modes coincide at the dead point.
                if sine.abs() > 1e-12 {
                    assert_eq!(case.mode(pose), one.mode, "{kind:?} {sine}");
                    if one.mode != AssemblyMode::Only {
                        let first = [AssemblyMode::Left, AssemblyMode::Ahead].contains(&one.mode);
                        assert!(sine.abs() <= 1.0 + 1e-15 && (sine > 0.0) == first, "{kind:?} {sine}");
                    }
                }
            }
            let expected = if matches!(kind, GroupKind::Rpp | GroupKind::Prp) { 1 } else { 2 };
            assert_eq!(all.len(), expected, "{kind:?}");
            if let [one, other] = &all[..] {
                assert!(one.mode != other.mode && one.links != other.links, "{kind:?}");
            }
        }
        println!("{kind:?}: {some} of {CASES} assembled, closure at worst {worst:.1e} of the size");
        assert!(some > CASES / 5, "{kind:?}: {some}");
        // All tests of closure have this bound: the closure error is at most 1e-12 of the size.
        assert!(worst <= 1e-12, "{kind:?}: {worst}");
    }
}

/// Dyads of two sliders have no configuration if their axes are parallel.
/// A tiny angle between the axes is enough for a configuration.
#[test]
fn parallel_axes_are_refused() {
    for kind in [GroupKind::Rpp, GroupKind::Prp] {
        let mut random = Lcg(77);
        for _ in 0..1000 {
            let mut case = case(&mut random, kind);
            let (Some(joint), Some(other)) = (0..3)
                .filter(|&k| case.joint(JointId(k)).slides())
                .fold((None, None), |(first, _), k| if first.is_none() { (Some(k), None) } else { (first, Some(k)) })
            else {
                panic!("two prismatic joints");
            };
            // The axes are made parallel. PRP: one base is rotated until its guide is parallel to the guide of the
            // second base.
            // RPP: the slider gets two parallel axes.
            let turned_by = |case: &mut Case, angle: f64| {
                if kind == GroupKind::Prp {
                    let guide = |k: JointId, link: LinkId| {
                        let base = case.joint(k).other(link).link;
                        let axis = case.joint(k).axis_on(base).unwrap();
                        case.pose.0[base].angle + axis.y.atan2(axis.x)
                    };
                    let off = guide(JointId(joint), LinkId(3)) - guide(JointId(other), LinkId(4)) + angle;
                    case.pose.0[LinkId(2)].angle += off;
                } else {
                    let slider = if case.joint(JointId(0)).slides() { LinkId(3) } else { LinkId(4) };
                    let (outer, inner) =
                        if slider == LinkId(3) { (JointId(0), JointId(1)) } else { (JointId(2), JointId(1)) };
                    let along = case.joint(outer).axis_on(slider).unwrap();
                    let mut joints = case.mechanism.joints().to_vec();
                    let side = usize::from(joints[inner].second.link == slider);
                    let JointKind::Prismatic { axes } = &mut joints[inner].kind else { panic!("a prismatic joint") };
                    axes[side] = rotated(unit(angle), along);
                    case.mechanism = mechanism(5, joints);
                }
            };
            turned_by(&mut case, 0.0);
            let error = configurations(&case.mechanism, &case.group, &case.pose).unwrap_err();
            assert!(error.to_string().contains("are parallel"), "{error}");
            turned_by(&mut case, 1e-6);
            assert_eq!(configurations(&case.mechanism, &case.group, &case.pose).unwrap().len(), 1);
        }
    }
}

#[test]
fn unreachable_distances_are_reported_in_metres() {
    let mut random = Lcg(5);
    let mut told = [false; 2];
    while told != [true; 2] {
        for (index, kind) in [GroupKind::Rrp, GroupKind::Rpr].into_iter().enumerate() {
            let case = case(&mut random, kind);
            if let Err(error) = configurations(&case.mechanism, &case.group, &case.pose) {
                let words = ["but its rod is", "perpendicular to the axis of its prismatic joint"][index];
                assert!(error.to_string().contains(words) && error.to_string().contains(" m"), "{error}");
                told[index] = true;
            }
        }
    }
}
