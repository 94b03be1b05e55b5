//! Bodies and joints of a world as plain numbers.

use crate::plane::{Placement, Vec2, cross, larger, turned};
use crate::rows::{JointRows, JointType, ROTATION};

/// A body of the world that has a joint.
#[derive(Clone, Debug)]
pub(crate) struct ModelBody {
    /// Mass centre in the body's frame (m).
    pub(crate) centre: Vec2,
    /// Mass (kg) and moment of inertia (kg m^2). `None` for a fixed or kinematic body, which no force moves.
    pub(crate) inertia: Option<[f64; 2]>,
    /// Whether the body is a link of a multibody.
    pub(crate) is_link: bool,
    /// Weight and user force (N).
    pub(crate) force: Vec2,
    /// User torque (N m).
    pub(crate) moment: f64,
    /// Linear and angular damping of Rapier (1/s).
    pub(crate) damping: [f64; 2],
}

/// A joint of the world.
#[derive(Clone, Debug)]
pub(crate) struct ModelJoint {
    /// Indices of the two bodies.
    pub(crate) bodies: [usize; 2],
    pub(crate) joint_type: JointType,
    /// The two joint frames, each in the frame of its body.
    pub(crate) frames: [Placement; 2],
    /// The free coordinates along which the joint may exert a force: by a motor, a damper, a spring or dry friction.
    pub(crate) efforts: [bool; 3],
}

/// All bodies and joints that are read.
#[derive(Clone, Debug)]
pub(crate) struct Model {
    pub(crate) bodies: Vec<ModelBody>,
    pub(crate) joints: Vec<ModelJoint>,
}

/// A joint at one instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stance {
    pub(crate) rows: JointRows,
    /// Origin of joint frame 2, where the force on body 2 acts (m).
    pub(crate) point: Vec2,
    /// Distance by which the locked translations are violated (m).
    pub(crate) gap: f64,
    /// Sine of the angle by which a locked rotation is violated.
    pub(crate) twist: f64,
}

impl ModelJoint {
    /// Whether the joint may transmit a force along a coordinate, or a moment.
    pub(crate) fn transmits(&self, coordinate: usize) -> bool {
        self.joint_type.locked().contains(&coordinate) || self.efforts[coordinate]
    }

    /// Position and lines of action of the joint if the bodies have these placements.
    ///
    /// As in Rapier, the constraint rows act on body 1 at the origin of joint frame 2, moved back along the locked axes
    /// by the gap of the joint.
    pub(crate) fn stance(&self, bodies: &[ModelBody], placements: &[Placement]) -> Stance {
        let of = self.bodies.map(|body| placements[body]);
        let [first, second] = [0, 1].map(|k| of[k].placed(&self.frames[k]));
        let error = second.origin - first.origin;
        let axes = [first.direction, turned(first.direction)];
        let locked = |k: &usize| *k != ROTATION && self.joint_type.locked().contains(k);
        let gap: Vec2 = [0, 1].iter().filter(|k| locked(k)).map(|&k| axes[k] * axes[k].dot(&error)).sum();
        let centres = [0, 1].map(|k| of[k].point(bodies[self.bodies[k]].centre));
        let is_turned = self.joint_type.locked().contains(&ROTATION);
        Stance {
            rows: JointRows {
                axis: first.direction,
                arms: [second.origin - gap - centres[0], second.origin - centres[1]],
            },
            point: second.origin,
            gap: gap.norm(),
            twist: if is_turned { cross(first.direction, second.direction).abs() } else { 0.0 },
        }
    }
}

impl Stance {
    /// Force on body 2 (N, world axes) and moment about [`Stance::point`] (N m), from their components along the
    /// coordinates of the joint.
    pub(crate) fn action(&self, components: [f64; 3]) -> (Vec2, f64) {
        let axis = self.rows.axis;
        (axis * components[0] + turned(axis) * components[1], components[ROTATION])
    }

    /// Interpolates between this stance (`share` 0) and the stance `end` (`share` 1).
    pub(crate) fn towards(self, end: Stance, share: f64) -> Stance {
        if share == 0.0 {
            return self;
        }
        let point = self.point + (end.point - self.point) * share;
        Stance { rows: self.rows.towards(end.rows, share), point, ..end }
    }

    /// Violation of the locked coordinates (m): the gap, or the sine of the violated rotation times `size` (m) if this
    /// product is larger.
    pub(crate) fn violation(&self, size: f64) -> f64 {
        larger(self.gap, self.twist * size)
    }
}

impl Model {
    /// The stances of all joints if the bodies have these placements.
    pub(crate) fn stances(&self, placements: &[Placement]) -> Vec<Stance> {
        self.joints.iter().map(|joint| joint.stance(&self.bodies, placements)).collect()
    }

    /// Groups of dynamic bodies that joints connect, each with its joints.
    /// Fixed and kinematic bodies connect nothing, because no force moves them.
    pub(crate) fn groups(&self) -> Vec<Group> {
        let mut home: Vec<usize> = (0..self.bodies.len()).collect();
        for joint in &self.joints {
            let [one, other] = joint.bodies;
            if joint.bodies.iter().all(|&body| self.bodies[body].inertia.is_some()) {
                let (from, to) = (home[one], home[other]);
                home.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
            }
        }
        let mut groups: Vec<Group> = Vec::new();
        for root in 0..self.bodies.len() {
            let is_member = |body: &usize| home[*body] == root && self.bodies[*body].inertia.is_some();
            let bodies: Vec<usize> = (0..self.bodies.len()).filter(is_member).collect();
            let held = |&joint: &usize| self.joints[joint].bodies.iter().any(|body| bodies.contains(body));
            let joints: Vec<usize> = (0..self.joints.len()).filter(held).collect();
            if !bodies.is_empty() {
                groups.push(Group { bodies, joints });
            }
        }
        groups
    }
}

/// Dynamic bodies that joints connect, and these joints, as indices into a model.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) bodies: Vec<usize>,
    pub(crate) joints: Vec<usize>,
}
