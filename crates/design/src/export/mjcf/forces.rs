//! Motors and loads in the terms of MuJoCo: actuators, and tendons with springs and dampers.

use super::limits::line;
use super::model::MjcfModel;
use linkage::drive::{Course, Load, Motor};
use linkage::error::Result;
use linkage::math::{Vec2, angle};
use linkage::mechanism::{JointSide, LinkId};

/// Limit of a force, so large that no force reaches it.
const ENDLESS: f64 = 1e30;

/// The element on which an actuator acts.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    /// The hinge of a branch.
    Hinge(usize),
    /// A fixed tendon: the sum of the coordinates of these branches, each times its coefficient.
    Sum(Vec<(usize, f64)>),
    /// A force (N) at a point of a link, and a moment (N m) on the link.
    Place {
        /// The point, in the frame of the link.
        at: JointSide,
        /// The force.
        force: Vec2,
        /// The moment.
        moment: f64,
        /// Whether the components of the force refer to the axes of the link (`true`) or to the axes of the world
        /// (`false`).
        follows: bool,
    },
}

/// A force or moment `bias[0] + bias[1] * length + bias[2] * rate` (SI), limited to `range`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Actuator {
    pub name: String,
    pub target: Target,
    pub bias: [f64; 3],
    pub range: Option<[f64; 2]>,
}

/// A tendon between two points, with a spring or a damper.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tendon {
    pub name: String,
    pub ends: [JointSide; 2],
    pub stiffness: f64,
    pub free_length: f64,
    pub damping: f64,
}

/// Everything that acts on the links besides gravity, constraints and dry friction.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Forces {
    pub actuators: Vec<Actuator>,
    pub tendons: Vec<Tendon>,
}

/// Forces of all motors and loads except resistances.
/// Resistances are [frictions](super::model::Friction) instead.
pub(super) fn forces(model: &MjcfModel) -> Result<Forces> {
    let mut found = Forces::default();
    for drive in model.case.drives.iter() {
        let joint = &model.case.mechanism.joints()[drive.joint].name;
        let branch = model.branch_of(drive.link).expect("a driving link is in the tree");
        if let Some(motor) = drive.moving_motor() {
            found.actuators.extend(motors(motor, drive.sense(), joint, branch)?);
        }
    }
    for (index, load) in model.case.loads.iter().enumerate() {
        let name = format!("load.{}", index + 1);
        let constant = |course: &Course| course.at(0.0);
        let turning = |links: &[(LinkId, f64)]| {
            let mut sum: Vec<(usize, f64)> = Vec::new();
            for &(link, sign) in links {
                sum.extend(model.hinges(link).into_iter().map(|branch| (branch, sign)));
            }
            // A hinge that turns both links has no effect on the angle between the links. Such a hinge is left out of
            // the sum.
            let both: Vec<usize> = sum.iter().filter(|(_, sign)| *sign < 0.0).map(|(branch, _)| *branch).collect();
            let is_common = |branch: usize| both.contains(&branch) && sum.contains(&(branch, 1.0));
            sum.iter().copied().filter(|&(branch, _)| !is_common(branch)).collect::<Vec<_>>()
        };
        let mut put = |target: Target, bias: [f64; 3]| {
            let target = match target {
                Target::Sum(sum) if sum.is_empty() => return,
                Target::Sum(sum) if sum.len() == 1 && sum[0].1 == 1.0 => Target::Hinge(sum[0].0),
                other @ (Target::Hinge(_) | Target::Sum(_) | Target::Place { .. }) => other,
            };
            found.actuators.push(Actuator { name: name.clone(), target, bias, range: None });
        };
        // Here, loads become actuators or tendons. Resistances become frictions elsewhere.
        // Loads that MJCF cannot express were refused before.
        if let &Load::Moment { link, ref moment, .. } = load {
            if model.slides(link) {
                // A moment on the hinges before a slide would give the same motion, but another moment in the slide.
                let (at, moment) = (JointSide { link, local: Vec2::zeros() }, constant(moment));
                put(Target::Place { at, force: Vec2::zeros(), moment, follows: true }, [1.0, 0.0, 0.0]);
            } else {
                put(Target::Sum(turning(&[(link, 1.0)])), [constant(moment), 0.0, 0.0]);
            }
        } else if let Load::Force { at, force: [x, y], follows } = load {
            let force = Vec2::new(constant(x), constant(y));
            put(Target::Place { at: *at, force, moment: 0.0, follows: *follows }, [1.0, 0.0, 0.0]);
        } else if let &Load::Spring { ends, stiffness, free_length } = load {
            found.tendons.push(Tendon { name, ends, stiffness, free_length, damping: 0.0 });
        } else if let &Load::Damper { ends, damping } = load {
            found.tendons.push(Tendon { name, ends, stiffness: 0.0, free_length: 0.0, damping });
        } else if let &Load::TorsionSpring { links: [first, second], stiffness, free_angle, .. } = load {
            // The tendon's length is the difference of the two link angles, including whole turns.
            // The spring's twist is this difference without whole turns: at t = 0 the twist is in (-pi, pi].
            let begun = model.case.start.0[second].angle - model.case.start.0[first].angle;
            let free = free_angle + begun - angle::wrapped(begun);
            put(Target::Sum(turning(&[(second, 1.0), (first, -1.0)])), [stiffness * free, -stiffness, 0.0]);
        } else if let &Load::TorsionDamper { links: [first, second], damping } = load {
            put(Target::Sum(turning(&[(second, 1.0), (first, -1.0)])), [0.0, 0.0, -damping]);
        }
    }
    Ok(found)
}

/// Actuators of a motor on the hinge that it drives. A motor with losses gets two actuators: one drives, the other
/// brakes.
fn motors(motor: &Motor, sense: f64, joint: &str, branch: usize) -> Result<Vec<Actuator>> {
    let [at_rest, slope] = line(&motor.law)?;
    let (constant, damping) = (sense * motor.ratio * at_rest, motor.ratio * motor.ratio * slope);
    let part = |name: String, share: f64, range: Option<[f64; 2]>| {
        let bias = [share * constant, 0.0, share * damping];
        Actuator { name, target: Target::Hinge(branch), bias, range }
    };
    if motor.efficiency >= 1.0 {
        return Ok(vec![part(format!("{joint}.motor"), 1.0, None)]);
    }
    let [forward, back] =
        if sense > 0.0 { [[0.0, ENDLESS], [-ENDLESS, 0.0]] } else { [[-ENDLESS, 0.0], [0.0, ENDLESS]] };
    Ok(vec![
        part(format!("{joint}.motor.drives"), motor.efficiency, Some(forward)),
        part(format!("{joint}.motor.brakes"), 1.0 / motor.efficiency, Some(back)),
    ])
}
