//! A mechanism as a Rapier world: the spanning tree as a multibody, the loops closed by impulse joints, the drive as a
//! motor of its own so that its impulse can be read.

use parry2d_f64::mass_properties::MassProperties;
use rapier2d_f64::prelude::{
    ImpulseJointHandle, IntegrationParameters, JointAxesMask, JointAxis, MotorModel, Multibody, MultibodyJointHandle,
    PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector,
};

use super::joints;
use super::joints::vector;
use super::tree::Tree;
use crate::case::Case;
use crate::drive::{Drive, MotionLaw};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, rotated, unit};
use crate::mechanism::{Link, Mechanism, Side};

/// Damping of the velocity motor (N m s/rad) that holds a prescribed speed to 15 digits.
const RIGID_MOTOR: f64 = 1e30;
/// Share of the mechanism's size to which a loop may open before the run is stopped.
const LARGEST_GAP: f64 = 0.05;

/// A joint that closes a loop: a revolute one.
#[derive(Clone, Copy, Debug)]
struct Cut {
    joint: usize,
    sides: [Side; 2],
    handle: ImpulseJointHandle,
}

/// The Rapier world of a case.
pub struct Twin {
    world: PhysicsWorld,
    tree: Tree,
    bodies: Vec<RigidBodyHandle>,
    any_link: MultibodyJointHandle,
    /// Generalised coordinate of every branch's joint: index in the multibody; its sense is that of the child in its parent.
    dofs: Vec<usize>,
    /// Number of every branch's link in the multibody.
    ids: Vec<usize>,
    cuts: Vec<Cut>,
    /// One a drive, in the case's order.
    motors: Vec<ImpulseJointHandle>,
    largest_gap: f64,
    drive: Drive,
    names: Vec<String>,
    /// Angle of the child less that of its parent (rad) of every branch whose joint keeps it.
    twists: Vec<Option<f64>>,
    /// Angles of all links (rad), turns kept.
    angles: Vec<f64>,
}

impl std::fmt::Debug for Twin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Twin").field("tree", &self.tree).finish_non_exhaustive()
    }
}

impl Twin {
    /// Builds the world in the case's start pose, at rest.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] if Rapier refuses a joint.
    pub fn new(case: &Case, step: f64, sweeps: usize) -> Result<Self> {
        let mechanism = &case.mechanism;
        let tree = Tree::of(mechanism);
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(case.gravity.x, case.gravity.y);
        world.integration_parameters = parameters(step, sweeps);
        let bodies = insert_bodies(&mut world, mechanism);
        let mut last = None;
        for branch in &tree.branches {
            let found = &mechanism.joints()[branch.joint];
            let joint = joints::between(found, [branch.parent, branch.link]);
            last = world.multibody_joints.insert(bodies[branch.parent], bodies[branch.link], joint, true);
            if last.is_none() {
                let name = &found.name;
                return Err(Error::new(ErrorKind::Unsupported, format!("Rapier refuses the tree joint \"{name}\"")));
            }
        }
        let any_link = last.ok_or_else(|| Error::new(ErrorKind::Unsupported, "there is no moving link"))?;
        let cuts = tree.cut.iter().map(|&joint| {
            let found = &mechanism.joints()[joint];
            let sides = [found.first, found.second];
            let [first, second] = sides.map(|side| bodies[side.link]);
            let data = joints::between(found, sides.map(|side| side.link));
            Cut { joint, sides, handle: world.impulse_joints.insert(first, second, data, true) }
        });
        let cuts = cuts.collect();
        let motors = case.drives().map(|drive| insert_motor(&mut world, case, drive, &bodies)).collect();
        let twists = tree.branches.iter().map(|branch| {
            let angle = |link: usize| case.start.0[link].angle;
            mechanism.joints()[branch.joint].is_prismatic().then(|| angle(branch.link) - angle(branch.parent))
        });
        let twists = twists.collect();
        let mut twin = Twin {
            world,
            bodies,
            any_link,
            dofs: Vec::new(),
            ids: Vec::new(),
            cuts,
            motors,
            largest_gap: LARGEST_GAP * mechanism.size(),
            drive: case.drive,
            names: mechanism.joints().iter().map(|joint| joint.name.clone()).collect(),
            twists,
            angles: case.start.0.iter().map(|pose| pose.angle).collect(),
            tree,
        };
        twin.pose(case);
        Ok(twin)
    }

    /// Puts the multibody into the start pose. The order of calls matters: see the comments.
    fn pose(&mut self, case: &Case) {
        let PhysicsWorld { multibody_joints, bodies, .. } = &mut self.world;
        let root = multibody_joints.rigid_body_link(self.bodies[0]).expect("the ground is in the multibody").multibody;
        let ids = self.tree.branches.iter().map(|branch| {
            multibody_joints.rigid_body_link(self.bodies[branch.link]).expect("every link is in the multibody").id
        });
        let ids: Vec<usize> = ids.collect();
        let multibody = multibody_joints.get_multibody_mut(root).expect("the multibody exists");
        // Collapses the freedoms of the fixed root; before this call the indices below do not hold.
        multibody.forward_kinematics(bodies, true);
        // Rapier puts 0.1 N m s/rad on every pin by default.
        multibody.damping_mut().fill(0.0);
        self.dofs = ids.iter().map(|&id| multibody.link(id).expect("the link exists").assembly_id()).collect();
        self.ids = ids;
        let mut displacements = vec![0.0; multibody.ndofs()];
        for (branch, &dof) in self.tree.branches.iter().zip(&self.dofs) {
            displacements[dof] = joints::coordinate(&case.mechanism.joints()[branch.joint], branch, &case.start);
        }
        multibody.apply_displacements(&displacements);
        multibody.forward_kinematics(bodies, false);
        multibody.update_rigid_bodies(bodies, true);
    }

    /// Sets the motors to their drives' speeds times `sense` (-1 runs the mechanism backwards).
    pub fn drive_at(&mut self, case: &Case, sense: f64) {
        for (drive, &motor) in case.drives().zip(&self.motors) {
            let MotionLaw::ConstantSpeed(omega) = drive.law;
            let speed = omega * sense * motor_sense(case, drive);
            let motor = self.world.impulse_joints.get_mut(motor, true).expect("the motor exists");
            motor.data.set_motor_velocity(JointAxis::AngX, speed, RIGID_MOTOR);
        }
    }

    /// One time step.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a loop has opened: the pose cannot be assembled, or the step is far too large.
    pub fn step(&mut self) -> Result<()> {
        self.world.step();
        self.read_angles();
        for cut in &self.cuts {
            let gap = (self.point(cut.sides[1]) - self.point(cut.sides[0])).norm();
            // Written so that NaN stops the run too.
            if !(gap <= self.largest_gap) {
                let crank = (self.angles[self.drive.link] - self.drive.zero).to_degrees();
                let joint = &self.names[cut.joint];
                return Err(Error::new(
                    ErrorKind::Numeric,
                    format!(
                        "the engine's loop has opened by {gap:.3e} m at joint \"{joint}\", crank angle {crank:.4} deg"
                    ),
                )
                .help("choose a smaller time step (--dt), or check that the pose can be assembled there"));
            }
        }
        Ok(())
    }

    /// That the twin stands in the case's start pose again, after it has driven itself away and back.
    ///
    /// # Errors
    /// [`ErrorKind::Numeric`] if a link is farther away than a loop may open: on the way it went past a dead point, into another
    /// configuration.
    pub fn check_start(&self, case: &Case) -> Result<()> {
        for (index, (link, pose)) in case.mechanism.links().iter().zip(&case.start.0).enumerate().skip(1) {
            let off = |local: Vec2| (self.point(Side { link: index, local }) - pose.point(local)).norm();
            let far = link.points.iter().map(|point| off(point.local)).fold(off(link.mass_centre), f64::max);
            // Written so that NaN stops the run too.
            if !(far <= self.largest_gap) {
                let crank = case.drive.start.to_degrees();
                return Err(Error::new(
                    ErrorKind::Numeric,
                    format!(
                        "the engine ran up from a few steps before the grid and came back to the start at crank angle {crank:.4} deg with link \"{}\" {far:.3e} m off: it has passed a dead point on the way",
                        link.name
                    ),
                )
                .help("choose a smaller time step (--dt), or begin the grid farther from the dead point"));
            }
        }
        Ok(())
    }

    fn multibody(&self) -> &Multibody {
        self.world.multibody_joints.get(self.any_link).expect("the multibody exists").0
    }

    fn read_angles(&mut self) {
        let (multibody, _) = self.world.multibody_joints.get(self.any_link).expect("the multibody exists");
        for ((branch, &id), twist) in self.tree.branches.iter().zip(&self.ids).zip(&self.twists) {
            let relative = twist.unwrap_or_else(|| multibody.link(id).expect("known link").joint().coords()[2]);
            self.angles[branch.link] = self.angles[branch.parent] + relative;
        }
    }

    /// The spanning tree.
    #[must_use]
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Angle of a link's frame (rad), turns kept.
    #[must_use]
    pub fn angle(&self, link: usize) -> f64 {
        self.angles[link]
    }

    /// World position of a point of a link (m).
    #[must_use]
    pub fn point(&self, side: Side) -> Vec2 {
        let pose = self.world.bodies[self.bodies[side.link]].position();
        let at = pose.transform_point(vector(side.local));
        Vec2::new(at.x, at.y)
    }

    /// Speed of the joint of branch `index` of the tree, as it stood at the START of the last step (Rapier reports velocities
    /// one step late): angular velocity of the child less that of its parent (rad/s), or of a prismatic joint, speed of the
    /// child along the parent's axis (m/s).
    #[must_use]
    pub fn relative_speed(&self, index: usize) -> f64 {
        self.multibody().generalized_velocity()[self.dofs[index]]
    }

    /// Force of the first link on the second in a joint that closes a loop (N, world axes), from the impulse of the last
    /// step; `None` for joints of the tree, which report none (all prismatic ones are among them). First order in the step.
    ///
    /// `before` is the angle of the first link at the start of that step: the impulse is given in its axes there.
    #[must_use]
    pub fn native_force(&self, joint: usize, before: f64) -> Option<Vec2> {
        let cut = self.cuts.iter().find(|cut| cut.joint == joint)?;
        let impulse = self.world.impulse_joints.get(cut.handle)?.impulses;
        let force = Vec2::new(impulse[0], impulse[1]) / -self.world.integration_parameters.dt;
        Some(rotated(unit(before), force))
    }

    /// Moment of the crank's drive on the crank (N m), from the motor's impulse in the last step. First order in the step.
    #[must_use]
    pub fn native_torque(&self, case: &Case) -> f64 {
        let motor = self.world.impulse_joints.get(self.motors[0]).expect("the motor exists");
        let on_second = -motor.data.motors[2].impulse / self.world.integration_parameters.dt;
        on_second * motor_sense(case, &case.drive)
    }
}

/// +1 if the driving link is the second of the driven joint, as the motor counts, else -1.
fn motor_sense(case: &Case, drive: &Drive) -> f64 {
    if case.mechanism.joints()[drive.joint].second.link == drive.link { 1.0 } else { -1.0 }
}

fn parameters(step: f64, sweeps: usize) -> IntegrationParameters {
    IntegrationParameters {
        dt: step,
        // These are substeps: each would restart the sweeps from nothing.
        num_solver_iterations: 1,
        num_internal_pgs_iterations: sweeps,
        num_internal_stabilization_iterations: sweeps,
        max_ccd_substeps: 0,
        normalized_max_linear_velocity: f64::MAX,
        normalized_max_corrective_velocity: f64::MAX,
        ..IntegrationParameters::default()
    }
}

fn insert_bodies(world: &mut PhysicsWorld, mechanism: &Mechanism) -> Vec<RigidBodyHandle> {
    let moving = &mechanism.links()[1..];
    let total: f64 = moving.iter().map(|link| link.mass).sum();
    let stand_in = if total > 0.0 { total / moving.len() as f64 } else { 1.0 };
    let mut handles = vec![world.bodies.insert(RigidBodyBuilder::fixed())];
    for link in moving {
        let body = RigidBodyBuilder::dynamic()
            .can_sleep(false)
            .allow_fast_rotation(true)
            .additional_mass_properties(mass_properties(link, stand_in, mechanism.size()));
        handles.push(world.bodies.insert(body));
    }
    handles
}

/// Rapier cannot move a body without inertia. Under a prescribed speed the motion does not depend on the masses, and
/// reactions are derived with the true ones, so a massless link gets a stand-in here.
fn mass_properties(link: &Link, stand_in: f64, size: f64) -> MassProperties {
    let mass = if link.mass > 0.0 { link.mass } else { stand_in };
    let inertia = if link.inertia > 0.0 { link.inertia } else { mass * size * size / 12.0 };
    MassProperties::new(vector(link.mass_centre), mass, inertia)
}

fn insert_motor(
    world: &mut PhysicsWorld,
    case: &Case,
    drive: &Drive,
    bodies: &[RigidBodyHandle],
) -> ImpulseJointHandle {
    let joint = &case.mechanism.joints()[drive.joint];
    let links = [joint.first.link, joint.second.link];
    let data = joints::holding(JointAxesMask::empty(), joint, links)
        .motor_model(JointAxis::AngX, MotorModel::ForceBased)
        .motor_velocity(JointAxis::AngX, 0.0, RIGID_MOTOR)
        .build();
    world.impulse_joints.insert(bodies[joint.first.link], bodies[joint.second.link], data, true)
}
