//! A mechanism as a Simbody model: the tree of bodies, the joints that close loops, and the prescribed motion.

use crate::sentences;
use linkproof_simbody::{
    BodyState, Failure, Inertia, Law, LoopClosure, LoopState, SimbodyBody, SimbodyJoint, SimbodyModel,
};

use linkage::case::Case;
use linkage::drive::{Drive, Load, Wrench};
use linkage::engine::bodies::stand_in;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::{Vec2, cross};
use linkage::mechanism;
use linkage::mechanism::{
    LinkId,
    spanning_tree::{SpanningTree, TreeBranch, coordinate},
};
use linkage::solver::State;

/// The model of a case, and the mapping from bodies and loops of the model to links and joints of the mechanism.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    /// Simbody's model: bodies in the order of the tree's branches, loops in the order of its cuts.
    pub(super) model: SimbodyModel,
    /// The spanning tree, which contains all drives.
    pub(super) tree: SpanningTree,
    /// Direction of time: +1 forwards, -1 backwards.
    sense: f64,
    /// For every branch whose joint keeps the angle constant: angle of the child minus that of its parent (rad).
    twists: Vec<Option<f64>>,
}

impl Linkage {
    /// The case's mechanism in its start pose.
    /// If `sense` is -1, time runs backwards.
    /// Drives then turn in the opposite direction and resistance acts with the motion; everything else is the same.
    ///
    /// In a free motion, `rates` gives the rates of all bodies' coordinates at t = 0.
    /// If `rates` is `None`, the initial speeds of free links are prescribed, so free links turn like driven links.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a number that Simbody cannot use.
    pub(super) fn new(case: &Case, sense: f64, rates: Option<&[f64]>) -> Result<Self> {
        let wrong = |failure: Failure| {
            Error::new(ErrorKind::Input, sentences::simbody_cannot_take_the_mechanism(&failure.message))
        };
        let mechanism = &case.mechanism;
        let driven = case.drives.joint_ids();
        let tree = SpanningTree::with(mechanism, &driven);
        let mut model = SimbodyModel::new(case.gravity.into());
        // Bodies are numbered in the order of the branches. The ground is 0 in Simbody and in the mechanism.
        let mut numbers = vec![0; mechanism.links().len()];
        let mut twists = Vec::new();
        for (index, branch) in tree.branches.iter().enumerate() {
            let found = &mechanism.joints()[branch.joint];
            let [parent, child] = [branch.parent, branch.link].map(|link| case.start.0[link].angle);
            let drive = case.drives.iter().find(|drive| drive.joint == branch.joint);
            let body = SimbodyBody {
                parent: numbers[branch.parent],
                joint: joint(found, branch),
                inertia: inertia(case, branch.link),
                // In a free motion all loads are applied together: see `acting`.
                resistance: if case.is_free() { 0.0 } else { sense * resistance(case, branch.link) },
                coordinate: coordinate(found, branch, &case.start.0),
                rate: rates.map_or(0.0, |rates| rates[index]),
                // Only laws of constant speed occur here, because all other laws were rejected earlier.
                law: drive
                    .and_then(|drive| law(case, branch, drive, rates.is_some()))
                    .map(|rate| Law { rate: sense * rate }),
            };
            numbers[branch.link] = model.add(body).map_err(wrong)?;
            twists.push(found.keeps_angle().then_some(child - parent));
        }
        for &cut in &tree.cut {
            let mechanism::Joint { first, second, .. } = &mechanism.joints()[cut];
            let sides = [first, second];
            let closing = LoopClosure {
                bodies: sides.map(|side| numbers[side.link]),
                places: sides.map(|side| side.local.into()),
            };
            model.close(closing).map_err(wrong)?;
        }
        Ok(Linkage { model, tree, sense, twists })
    }

    /// Fills a state with the motion that Simbody reports.
    /// If Simbody's time runs backwards, velocities are reversed to refer to the case's time.
    pub(super) fn motion(&self, bodies: &[BodyState], state: &mut State) {
        for ((branch, body), twist) in self.tree.branches.iter().zip(bodies).zip(&self.twists) {
            let motion = &mut state.motions[branch.link];
            motion.origin = body.origin.into();
            motion.direction = body.direction.into();
            motion.velocity = Vec2::from(body.velocity) * self.sense;
            motion.omega = body.omega * self.sense;
            motion.acceleration = body.acceleration.into();
            motion.alpha = body.alpha;
            state.angles[branch.link] = state.angles[branch.parent] + twist.unwrap_or(body.coordinate);
        }
    }

    /// Force at the mass centre (N) and moment about the mass centre (N m) for every Simbody body, from the loads on
    /// the links.
    pub(super) fn loads<'a>(&'a self, wrenches: &'a [Wrench]) -> impl Iterator<Item = [f64; 3]> + 'a {
        self.tree.branches.iter().map(|branch| {
            let Wrench { force, moment } = wrenches[branch.link];
            [force.x, force.y, moment]
        })
    }

    /// Adds the reactions to a state after [`Linkage::motion`]. Unlike velocities, forces keep their
    /// signs if Simbody's time runs backwards.
    pub(super) fn reactions(&self, case: &Case, bodies: &[BodyState], loops: &[LoopState], state: &mut State) {
        for (branch, body) in self.tree.branches.iter().zip(bodies) {
            let joint = &case.mechanism.joints()[branch.joint];
            let force = Vec2::from(body.force);
            let places = [joint.first, joint.second].map(|side| state.motions[side.link].point(side.local));
            // Simbody reports force and moment on the child, at the joint's point on the child. If the child is the
            // joint's first link, the signs are reversed and the moment is moved to the point on the second link.
            let (force, moment) = if joint.second.link == branch.link {
                (force, body.moment)
            } else {
                (-force, -body.moment - cross(places[0] - places[1], force))
            };
            state.forces[branch.joint] = force;
            state.moments[branch.joint] = if joint.keeps_angle() { moment } else { 0.0 };
            if let Some(index) = case.drives.iter().position(|drive| drive.joint == branch.joint) {
                let sign = sign_of(&case.drives[index], joint, branch);
                state.torques[index] = body.drive * sign;
                if case.drives[index].input == Input::Slide {
                    // Simbody's reaction includes the driving force.
                    let [_, thrust] = case.effort(&case.drives[index], state.torques[index], &state.motions);
                    state.forces[branch.joint] -= thrust.force;
                }
            }
        }
        if let Some(motor) = case.crank().moving_motor() {
            let (sense, crank) = (case.crank().sense(), &state.motions[case.crank().link]);
            let inertial = motor.inertia_on_crank() * crank.alpha;
            state.torques[0] = sense * motor.moment_on_crank(sense * crank.omega) - inertial;
        }
        for (&joint, closed) in self.tree.cut.iter().zip(loops) {
            state.forces[joint] = closed.force.into();
        }
    }

    /// Converts the failure of a run to an error with the case's time, crank angle and joint.
    pub(super) fn stopped(&self, case: &Case, failure: &Failure) -> Error {
        let t = failure.time.unwrap_or(0.0) * self.sense;
        let at = case.told(case.crank().at(t).value);
        // A gap that is not a number (NaN) counts as larger than all gaps before it.
        let widest = failure.gaps.iter().zip(&self.tree.cut).reduce(|a, b| if a.0 >= b.0 { a } else { b });
        let gap = widest.map_or(String::new(), |(gap, &joint)| {
            sentences::joint_open_by(&case.mechanism.joints()[joint].name, &format_args!("{gap:.3e}"))
        });
        let message = sentences::simbody_stopped_at(&t, &at, &gap, &failure.message);
        let mut error = Error::new(ErrorKind::Numeric, message).at_time(t).at_input(at);
        if let Some((_, &joint)) = widest {
            error = error.of_joint(&case.mechanism.joints()[joint].name);
        }
        error.help(sentences::CHECK_THAT_THE_POSE_CAN_BE_ASSEMBLED).or_help(sentences::SHORTEN_THE_GRID_TO_THE_CRANK)
    }
}

/// Rate of a driven coordinate, or `None` if forces move it.
fn law(case: &Case, branch: &TreeBranch, drive: &Drive, moving: bool) -> Option<f64> {
    if moving && drive.is_free() {
        return None;
    }
    if drive.input != Input::Angle {
        return Some(drive.initial_speed() * sign_of(drive, &case.mechanism.joints()[drive.joint], branch));
    }
    // The drive of a crank prescribes the rotation in the world, but a coordinate is relative to the parent. The
    // parent's rate is therefore subtracted.
    let parent = case.drives.iter().find(|other| other.link == branch.parent);
    Some(drive.initial_speed() - parent.map_or(0.0, Drive::initial_speed))
}

/// Sign of a drive's input in the coordinate of the branch. This coordinate measures the child relative to its parent.
fn sign_of(drive: &Drive, joint: &mechanism::Joint, branch: &TreeBranch) -> f64 {
    if drive.input == Input::Angle || joint.second.link == branch.link { 1.0 } else { -1.0 }
}

fn joint(found: &mechanism::Joint, branch: &TreeBranch) -> SimbodyJoint {
    let [parent, child] = [branch.parent, branch.link];
    let on = |link: LinkId| found.on(link).expect("the joint is on the link").into();
    match found.kind {
        mechanism::JointKind::Revolute => SimbodyJoint::Pin { on_parent: on(parent), on_child: on(child) },
        mechanism::JointKind::Prismatic { .. } => {
            let axis = |link: LinkId| found.axis_on(link).expect("the joint is on the link").into();
            SimbodyJoint::Slider {
                on_parent: on(parent),
                on_child: on(child),
                axis_parent: axis(parent),
                axis_child: axis(child),
            }
        }
    }
}

/// Mass and moment of inertia of a link. Simbody cannot accelerate a free body without mass and inertia.
/// A link without mass or inertia gets substitutes, which do not affect the reactions of the link.
pub(super) fn inertia(case: &Case, link: LinkId) -> Inertia {
    let body = &case.mechanism.links()[link];
    let [extra_mass, extra_inertia] = stand_in(case, link);
    let inertia = body.inertia + if link == case.crank().link { case.crank().moving_inertia() } else { 0.0 };
    Inertia { mass: body.mass, centre: body.mass_centre.into(), inertia, extra_mass, extra_inertia }
}

/// Constant moment against a link's rotation (N m).
fn resistance(case: &Case, link: LinkId) -> f64 {
    let on_link =
        |load: &Load| load.resistance().map_or(0.0, |(loaded, moment)| if loaded == link { moment } else { 0.0 });
    case.loads.iter().map(on_link).sum()
}
