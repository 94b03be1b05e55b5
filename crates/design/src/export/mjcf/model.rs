//! Contents of the file as numbers: bodies, joints, loops, frictions and the first state.

use super::limits;
use super::names;
use crate::sentences;
use linkage::case::Case;
use linkage::drive::Load;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::{KeepNan, Vec2, rotated, unit};
use linkage::mechanism::{
    Coordinate, GROUND, JointId, JointKind, LinkId, PerLink, SpanningTree, Transmission, TreeBranch,
};
use linkage::solver::State;

/// Inertia of a drive's rotor, divided by an estimate of the mechanism's moment of inertia about one of its points.
/// The mechanism's inertia forces cause moments of about this estimate times the square of the speed.
/// With such a rotor, these moments change the speed by 1e-9 of its value per radian.
const ROTOR: f64 = 1e9;
/// Mass of a massless link, divided by the mass of the whole mechanism. MuJoCo refuses a mass of zero.
/// A smaller mass would falsify reactions less, but it would make loops softer.
/// MuJoCo softens every loop in proportion to the inverse of the masses that the loop connects.
/// docs/mjcf.md states the resulting errors.
const LIGHT: f64 = 1e-5;
/// Radius of gyration of a link without inertia, divided by the link's size.
/// If the link's size is below the fraction `SHORTEST` of the mechanism's size, this fraction replaces the link's size.
const GYRATION: f64 = 0.3;
const SHORTEST: f64 = 0.1;

/// Dry friction on the rotation of one link.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Friction {
    /// The link.
    pub link: LinkId,
    /// Moment (N m).
    pub moment: f64,
    /// Hinges from the ground to the link, as indices of branches: the sum of their angles is the link's angle.
    pub hinges: Vec<usize>,
    /// Whether the joint that carries the link in the tree is the only hinge between the ground and the link.
    pub own_hinge: bool,
}

/// A mechanism as a MuJoCo model.
#[derive(Debug)]
pub struct MjcfModel<'a> {
    pub(super) case: &'a Case,
    pub(super) name: &'a str,
    pub(super) step: f64,
    pub(super) tree: SpanningTree,
    /// One body for each branch of the tree.
    pub(super) bodies: Vec<Body>,
    pub(super) frictions: Vec<Friction>,
}

impl<'a> MjcfModel<'a> {
    /// The model of a case whose state at t = 0 is `start`; see [`mjcf`](super::mjcf).
    ///
    /// # Errors
    /// The errors of [`mjcf`](super::mjcf) that do not come from the solver.
    pub fn new(case: &'a Case, start: &State, name: &'a str, step: f64) -> Result<Self> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(Error::new(ErrorKind::Input, sentences::the_time_step_is_but_must(&step))
                .help(sentences::GIVE_A_STEP_SUCH_AS));
        }
        names::check(&case.mechanism)?;
        case.drives.iter().try_for_each(limits::check_drive)?;
        case.loads.iter().try_for_each(limits::check)?;
        case.mechanism.transmissions().iter().try_for_each(limits::check_transmission)?;
        let driven = case.drives.joint_ids();
        let mut tree = SpanningTree::of(&case.mechanism);
        if driven.iter().any(|joint| tree.cut.contains(joint)) {
            tree = SpanningTree::with(&case.mechanism, &driven);
        }
        let bodies = tree.branches.iter().map(|branch| body(case, start, branch)).collect();
        let mut model = MjcfModel { case, name, step, tree, bodies, frictions: Vec::new() };
        model.frictions = model.frictions();
        Ok(model)
    }

    /// Mass of the mechanism (kg). A mechanism without mass gets 1 kg, so that its motion can still be simulated.
    fn mass(&self) -> f64 {
        let mass: f64 = self.case.mechanism.links().iter().map(|link| link.mass).sum();
        if mass > 0.0 { mass } else { 1.0 }
    }

    /// Size of the mechanism (m), for drawing and for inertias.
    pub(super) fn size(&self) -> f64 {
        let size = self.case.mechanism.size();
        if size > 0.0 { size } else { 1.0 }
    }

    /// Inertia of the rotor that keeps the speed of a prescribed drive (kg m^2; of a slide kg).
    pub fn rotor(&self, input: Input) -> f64 {
        let (size, links) = (self.size(), self.case.mechanism.links());
        // All mass at the distance `size` from a point.
        let inertia = ROTOR * (links.iter().map(|link| link.inertia).sum::<f64>() + self.mass() * size * size);
        if input == Input::Slide { inertia / (size * size) } else { inertia }
    }

    /// Inertia that moves with a driven joint (kg m^2; of a slide kg): the rotor of a prescribed drive, or the inertia
    /// of a free link's motor.
    pub(super) fn armature(&self, joint: JointId) -> Option<f64> {
        let drive = self.case.drives.iter().find(|drive| drive.joint == joint)?;
        if drive.is_free() {
            Some(drive.moving_inertia()).filter(|own| *own > 0.0)
        } else {
            Some(self.rotor(drive.input))
        }
    }

    /// Whether a joint is driven.
    pub(super) fn is_driven(&self, joint: JointId) -> bool {
        self.case.drives.iter().any(|drive| drive.joint == joint)
    }

    /// Mass (kg) and moment of inertia (kg m^2) of a link for MuJoCo.
    /// If the link has no mass or no inertia, the missing value is that of a light rod.
    pub fn inertial(&self, link: LinkId) -> (f64, f64) {
        let link = &self.case.mechanism.links()[link];
        let light = LIGHT * self.mass();
        let radius = GYRATION * link.size().larger(SHORTEST * self.size());
        let own_or = |own: f64, lent: f64| if own > 0.0 { own } else { lent };
        (own_or(link.mass, light), own_or(link.inertia, light * radius * radius))
    }

    /// Index of the branch that carries `link`.
    pub(super) fn branch_of(&self, link: LinkId) -> Option<usize> {
        self.tree.branches.iter().position(|branch| branch.link == link)
    }

    /// Child links of `parent`, in the tree's order.
    pub(super) fn children(&self, parent: LinkId) -> Vec<LinkId> {
        self.tree.branches.iter().filter(|branch| branch.parent == parent).map(|branch| branch.link).collect()
    }

    /// Bodies in the order of MuJoCo's coordinates.
    /// Each body precedes its children, and the children precede the body's next sibling.
    pub(super) fn in_order(&self) -> Vec<&Body> {
        let mut order = Vec::new();
        let mut waiting = self.children(GROUND);
        waiting.reverse();
        while let Some(link) = waiting.pop() {
            order.extend(self.branch_of(link).map(|branch| &self.bodies[branch]));
            waiting.extend(self.children(link).into_iter().rev());
        }
        order
    }

    /// Hinges from the ground to `link`, as indices of branches. The hinge nearest to `link` is last.
    pub(super) fn hinges(&self, mut link: LinkId) -> Vec<usize> {
        let mut hinges = Vec::new();
        while link != GROUND {
            let branch = self.branch_of(link).expect("every moving link is in the tree");
            if !self.case.mechanism.joints()[self.tree.branches[branch].joint].keeps_angle() {
                hinges.push(branch);
            }
            link = self.tree.branches[branch].parent;
        }
        hinges.reverse();
        hinges
    }

    /// Branches whose coordinates a transmission couples, each with a factor.
    /// The sum of the coordinates times their factors is constant.
    pub(super) fn coupled(&self, transmission: &Transmission) -> Vec<(usize, f64)> {
        let mut sum: Vec<(usize, f64)> = Vec::new();
        let mut add = |branch: usize, factor: f64| match sum.iter_mut().find(|(own, _)| *own == branch) {
            Some((_, own)) => *own += factor,
            None => sum.push((branch, factor)),
        };
        let [first, second] = &transmission.coordinates;
        let ratio = transmission.ratio().expect("cams are refused");
        let terms = second.iter().copied().chain(first.iter().map(|&(of, sign)| (of, -ratio * sign)));
        for (of, factor) in terms {
            match of {
                Coordinate::Angle(link) => self.hinges(link).into_iter().for_each(|hinge| add(hinge, factor)),
                Coordinate::Slide(joint) => {
                    let branch = self.tree.branches.iter().position(|branch| branch.joint == joint);
                    add(branch.expect("prismatic joints are in the tree"), factor);
                }
            }
        }
        let most = sum.iter().fold(0.0, |most: f64, (_, factor)| most.larger(factor.abs()));
        sum.retain(|(_, factor)| factor.abs() > 1e-12 * most);
        sum
    }

    /// One friction for each link with a resistance. A link that cannot turn gets no friction.
    fn frictions(&self) -> Vec<Friction> {
        let mut moments = PerLink::from(vec![0.0; self.case.mechanism.links().len()]);
        for (link, moment) in self.case.loads.iter().filter_map(Load::resistance) {
            moments[link] += moment;
        }
        let resisted = moments.entries().filter(|(_, moment)| **moment > 0.0);
        let frictions = resisted.map(|(link, &moment)| {
            let hinges = self.hinges(link);
            let own_hinge = hinges.len() == 1 && self.branch_of(link) == hinges.first().copied();
            Friction { link, moment, hinges, own_hinge }
        });
        frictions.filter(|friction| !friction.hinges.is_empty()).collect()
    }
}

/// The only degree of freedom of a body relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Freedom {
    /// Hinge about z at a point of the body's frame (m).
    Hinge(Vec2),
    /// Slide along a unit vector of the body's frame.
    Slide(Vec2),
}

/// A link as a body within its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Body {
    /// Origin of the link's frame in the frame of the parent link, in the start pose (m).
    pub offset: Vec2,
    /// Angle of the link minus that of its parent in the start pose (rad).
    pub turn: f64,
    /// The joint.
    pub freedom: Freedom,
    /// The joint's coordinate in the start pose: the slide (m), or the angle of the link minus that of its parent
    /// (rad).
    pub coordinate: f64,
    /// Rate of the joint's coordinate at the start (rad/s, m/s).
    pub rate: f64,
}

/// The body of a branch. Poses are those of the case at t = 0; rates are those of `start`.
pub(super) fn body(case: &Case, start: &State, branch: &TreeBranch) -> Body {
    let joint = &case.mechanism.joints()[branch.joint];
    let [parent, child] = [branch.parent, branch.link].map(|link| case.start.0[link]);
    let offset = rotated(unit(-parent.angle), child.origin - parent.origin);
    let turn = child.angle - parent.angle;
    let (freedom, coordinate, rate) = match joint.kind {
        JointKind::Revolute => {
            let place = joint.on(branch.link).expect("a branch's joint is on its link");
            let rate = start.motions[branch.link].omega - start.motions[branch.parent].omega;
            (Freedom::Hinge(place), turn, rate)
        }
        JointKind::Prismatic { .. } => {
            let axis = joint.axis_on(branch.link).expect("a branch's joint is on its link");
            // A slide is measured from the first link to the second, so its sign depends on which of the two is the
            // child.
            let sense = if branch.link == joint.second.link { 1.0 } else { -1.0 };
            let of = |state: &State| state.slide(joint).expect("the joint slides");
            (Freedom::Slide(axis * sense), of(&State::at_start(case))[0], of(start)[1])
        }
    };
    Body { offset, turn, freedom, coordinate, rate }
}
