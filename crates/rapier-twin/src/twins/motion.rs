//! Sets and reads poses and velocities, and does the steps.

use super::rapier::prelude::{JointAxesMask, JointAxis, Multibody, PhysicsWorld, Pose, Rotation};
use super::{Place, Twin, joints, reactions, real, wide};
use crate::tree::{SpanningTree, coordinate};
use crate::world::{LinkAngle, LinkFrame, World};
use linkage::drive::Wrench;
use linkage::math::Vec2;
use linkage::math::angle::arc_tangent;
use linkage::mechanism::{JointId, LinkId, LinkPose, TransmissionId};

impl Twin {
    fn multibody(&self, index: usize) -> &Multibody {
        self.world.multibody_joints.get(self.multibodies[index]).expect("the multibody exists").0
    }

    pub(super) fn put_tree(&mut self, poses: &[LinkPose]) {
        let mut displacements: Vec<Vec<_>> =
            (0..self.multibodies.len()).map(|index| vec![0.0; self.multibody(index).ndofs()]).collect();
        let coords =
            |place: &Place| self.multibody(place.multibody).link(place.id).expect("known link").joint().coords();
        for (branch, place) in self.tree.branches.iter().zip(&self.places) {
            let joint = &self.joints[branch.joint];
            let now = coords(place)[joints::free_coordinate(joint)];
            displacements[place.multibody][place.dof] = real(coordinate(joint, branch, poses)) - now;
        }
        for (&link, place) in self.outside.iter().zip(&self.floating) {
            let centre = poses[link].point(self.centres[link]);
            for (k, wanted) in [centre.x, centre.y, poses[link].angle].into_iter().enumerate() {
                displacements[place.multibody][place.dof + k] = real(wanted) - coords(place)[k];
            }
        }
        let PhysicsWorld { multibody_joints, bodies, .. } = &mut self.world;
        for (&handle, displacements) in self.multibodies.iter().zip(&displacements) {
            let (multibody, _) = multibody_joints.get_mut(handle).expect("the multibody exists");
            multibody.apply_displacements(displacements);
            multibody.forward_kinematics(bodies, false);
            multibody.update_rigid_bodies(bodies, true);
        }
    }

    /// Moves separate bodies into the given poses.
    pub(super) fn put_bodies(&mut self, poses: &[LinkPose]) {
        let separate = if self.multibodies.is_empty() { self.outside.as_slice() } else { &[] };
        for &link in separate {
            let pose = Pose::from_parts(joints::vector(poses[link].origin), Rotation::new(real(poses[link].angle)));
            self.world.bodies[self.bodies[link]].set_position(pose, true);
        }
    }

    /// Reads the frames of all links after a step.
    pub(super) fn read_frames(&mut self) {
        for (&body, frame) in self.bodies.iter().zip(&mut self.frames).skip(1) {
            let (origin, direction) = place(self.world.bodies[body].position());
            frame.follow(origin, direction);
        }
        for ((branch, place), twist) in self.tree.branches.iter().zip(&self.places).zip(&self.twists) {
            let link = || self.multibody(place.multibody).link(place.id).expect("known link");
            let coordinate = || wide(link().joint().coords()[2]);
            let parent = self.frames[branch.parent].angle();
            self.frames[branch.link].angle = LinkAngle::Whole(parent + twist.unwrap_or_else(coordinate));
        }
    }

    /// Sets the frames of all links after the links were moved into poses.
    pub(super) fn put_frames(&mut self, poses: &[LinkPose]) {
        for ((&body, frame), pose) in self.bodies.iter().zip(&mut self.frames).zip(poses).skip(1) {
            let (origin, direction) = place(self.world.bodies[body].position());
            frame.put(origin, direction, pose.angle);
        }
    }

    /// Duration of a substep (s), which Rapier itself treats as a step.
    pub(super) fn substep(&self) -> f64 {
        reactions::substep(&self.world.integration_parameters)
    }
}

/// Origin and direction of a body's frame.
fn place(pose: &Pose) -> (Vec2, Vec2) {
    let (at, rotation) = (pose.translation, pose.rotation);
    (Vec2::new(wide(at.x), wide(at.y)), Vec2::new(wide(rotation.re), wide(rotation.im)))
}

impl World for Twin {
    fn tree(&self) -> &SpanningTree {
        &self.tree
    }

    fn step(&mut self) {
        if self.read {
            self.keep_frames(1.0);
        }
        self.aim();
        self.world.step();
        self.read_frames();
        let substeps = self.world.integration_parameters.num_solver_iterations;
        if self.read && substeps > 1 {
            self.keep_frames(1.0 - 1.0 / substeps as f64);
        }
    }

    fn bare_step(&mut self) {
        if !self.meshes.is_empty() {
            self.read_frames();
            self.aim();
        }
        self.world.step();
    }

    fn set_step(&mut self, step: f64) {
        self.world.integration_parameters.dt = real(step);
    }

    fn set_stabilised(&mut self, stabilised: bool) {
        let parameters = &mut self.world.integration_parameters;
        let sweeps = parameters.num_internal_pgs_iterations;
        parameters.num_internal_stabilization_iterations = if stabilised { sweeps } else { 0 };
    }

    fn set_drive(&mut self, drive: usize, omega: f64) {
        let motor = &self.motors[drive];
        let turn = omega * self.substep();
        // A separate body turns by atan(omega dt) per substep, so its target speed is raised to tan(omega dt) / dt.
        // Above one radian per substep, the body cannot keep the prescribed speed, so the target speed is not raised.
        let is_angle = motor.axis == JointAxis::AngX;
        let omega = if is_angle && self.multibodies.is_empty() && turn.abs() < 1.0 {
            turn.tan() / self.substep()
        } else {
            omega
        };
        let joint = self.world.impulse_joints.get_mut(motor.handle, true).expect("the motor exists");
        joint.data.set_motor_velocity(motor.axis, real(omega * motor.sense), real(joints::RIGID_MOTOR));
    }

    fn set_motor(&mut self, drive: usize, target: f64, damping: f64) {
        let motor = &self.motors[drive];
        let joint = self.world.impulse_joints.get_mut(motor.handle, true).expect("the motor exists");
        joint.data.set_motor_velocity(motor.axis, real(target * motor.sense), real(damping));
        if damping == 0.0 {
            // Rapier would treat a motor without stiffness and damping as rigid, so the motor is switched off.
            joint.data.motor_axes = JointAxesMask::empty();
        }
    }

    fn set_load(&mut self, link: LinkId, load: Wrench) {
        let body = &mut self.world.bodies[self.bodies[link]];
        body.reset_forces(true);
        body.reset_torques(true);
        body.add_force(joints::vector(load.force), true);
        body.add_torque(real(load.moment), true);
    }

    fn place(&mut self, poses: &[LinkPose]) {
        self.put(poses);
    }

    fn frames(&self) -> &[LinkFrame] {
        &self.frames
    }

    fn relative_speed(&self, index: usize) -> f64 {
        let Place { multibody, dof, .. } = self.places[index];
        wide(self.multibody(multibody).generalized_velocity()[dof])
    }

    fn velocity(&self, link: LinkId) -> Option<(Vec2, f64)> {
        if let LinkAngle::Whole(_) = self.frames[link].angle {
            return None;
        }
        let body = &self.world.bodies[self.bodies[link]];
        let (velocity, step) = (body.linvel(), self.substep());
        // In a substep, the body turns by the arc tangent of omega dt (see `set_drive`). The actual angular velocity
        // follows from this angle.
        let omega = arc_tangent(wide(body.angvel()) * step) / step;
        Some((Vec2::new(wide(velocity.x), wide(velocity.y)), omega))
    }

    fn reaction(&self, joint: JointId) -> Option<(Vec2, f64)> {
        self.read_reaction(joint)
    }

    fn transmitted(&self, transmission: TransmissionId) -> f64 {
        self.read_transmitted(transmission)
    }

    fn torque(&self, drive: usize) -> f64 {
        self.read_torque(drive)
    }
}
