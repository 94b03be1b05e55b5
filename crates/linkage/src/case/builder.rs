//! Builds a case in code. The code refers to links by name. `CaseBuilder::build` checks the names.

use crate::sentences;
use std::f64::consts::TAU;

use super::{Case, CaseParts, Grid, Wanted};
use crate::drive::{Drive, DriveMotion, Drives, Load, MotionLaw, Motor};
use crate::error::{Error, ErrorKind, Result};
use crate::math::{Vec2, unit};
use crate::mechanism::{
    AssemblyMode, GROUND, Joint, JointId, JointKind, JointSide, Link, LinkId, Mechanism, Point, StartGroup, Structure,
    TransmissionDesign, TransmissionKind, first_pose,
};

/// Upper limit of the number of intervals of a turn. The results of more instants would take gigabytes.
const MOST_INTERVALS: usize = 10_000_000;

/// A joint given by names of links and points.
#[derive(Clone, Debug)]
struct Wish {
    name: String,
    /// Link name and point name on each side of the joint.
    sides: [[String; 2]; 2],
    /// Angles of the axis in the frames of both links (rad); prismatic joints only.
    axes: Option<[f64; 2]>,
}

/// A transmission.
/// The fields name the members, the carrier, and the joint with a given start coordinate.
#[derive(Clone, Debug)]
struct Coupling {
    name: String,
    kind: TransmissionKind,
    links: [String; 3],
    start: (String, f64),
    efficiency: [f64; 2],
}

/// Builds a [`Case`] from names and numbers (SI units).
///
/// The methods that add or set a part check nothing. [`CaseBuilder::build`] checks all parts and names every fault.
///
/// ```
/// use linkproof_linkage::case::Case;
/// use linkproof_linkage::mechanism::AssemblyMode;
///
/// let four_bar = Case::builder()
///     .ground(&[("O", [0.0, 0.0]), ("C", [0.4, 0.0])])
///     .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
///     .link("coupler", &[("A", [0.0, 0.0]), ("B", [0.35, 0.0])])
///     .link("rocker", &[("C", [0.0, 0.0]), ("B", [0.25, 0.0])])
///     .mass("coupler", 2.0, [0.175, 0.0], 0.02)
///     .pin("O", "ground", "crank")
///     .pin("A", "crank", "coupler")
///     .pin("B", "coupler", "rocker")
///     .pin("C", "ground", "rocker")
///     .crank("O", 10.0)
///     .mode(&["coupler", "rocker"], AssemblyMode::Left)
///     .build()?;
/// assert_eq!(four_bar.grid.len(), 361);
/// # Ok::<(), linkproof_linkage::Error>(())
/// ```
#[derive(Clone, Debug)]
#[must_use]
pub struct CaseBuilder {
    links: Vec<Link>,
    masses: Vec<(String, f64, Vec2, f64)>,
    joints: Vec<Wish>,
    transmissions: Vec<Coupling>,
    cranks: Vec<(String, f64, DriveMotion)>,
    motor: Option<Motor>,
    start: f64,
    modes: Vec<(Vec<String>, AssemblyMode)>,
    gravity: Vec2,
    loads: Vec<Load>,
    instants: usize,
    times: Option<Vec<f64>>,
    wanted: Wanted,
}

impl Case {
    /// Returns an empty builder for a case written in code, link by link.
    pub fn builder() -> CaseBuilder {
        CaseBuilder::new()
    }
}

impl CaseBuilder {
    fn new() -> Self {
        CaseBuilder {
            links: Vec::new(),
            masses: Vec::new(),
            joints: Vec::new(),
            transmissions: Vec::new(),
            cranks: Vec::new(),
            motor: None,
            start: 0.0,
            modes: Vec::new(),
            gravity: Vec2::zeros(),
            loads: Vec::new(),
            instants: 360,
            times: None,
            wanted: Wanted::ALL,
        }
    }

    /// Sets the ground and its points: names and world coordinates (m).
    pub fn ground(mut self, points: &[(&str, [f64; 2])]) -> Self {
        self.links.insert(GROUND.index(), bare("ground", points));
        self
    }

    /// Adds a moving link and its points: names and coordinates (m) in the link's frame. The link is massless until
    /// [`CaseBuilder::mass`] sets its mass.
    pub fn link(mut self, name: &str, points: &[(&str, [f64; 2])]) -> Self {
        self.links.push(bare(name, points));
        self
    }

    /// Adds a point (m, in the link's frame) to a link that was added before.
    pub fn point(mut self, link: &str, name: &str, at: [f64; 2]) -> Self {
        let own = self.links.iter_mut().filter(|own| own.name == link);
        own.for_each(|own| own.points.push(Point { name: name.into(), local: at.into() }));
        self
    }

    /// Sets a link's mass (kg), mass centre in the link's frame (m) and moment of inertia about the mass centre (kg
    /// m^2).
    pub fn mass(mut self, link: &str, mass: f64, centre: [f64; 2], inertia: f64) -> Self {
        self.masses.push((link.into(), mass, centre.into(), inertia));
        self
    }

    /// Adds a revolute joint between two links. Both links must have a point called `name`.
    pub fn pin(self, name: &str, first: &str, second: &str) -> Self {
        self.joint(name, [(first, name), (second, name)], None)
    }

    /// Adds a prismatic joint: link and point on both sides, and the angles (rad) of the joint's axis in the frames of
    /// the two links.
    /// The two points must have different names.
    pub fn slider(self, name: &str, first: (&str, &str), second: (&str, &str), axes: [f64; 2]) -> Self {
        self.joint(name, [first, second], Some(axes))
    }

    fn joint(mut self, name: &str, sides: [(&str, &str); 2], axes: Option<[f64; 2]>) -> Self {
        let sides = sides.map(|(link, point)| [link.to_string(), point.to_string()]);
        self.joints.push(Wish { name: name.into(), sides, axes });
        self
    }

    /// Adds a transmission between two links on the axles or guides of `carrier`.
    /// At t = 0 the joint `start.0` has the coordinate `start.1`: the angle of its second link minus that of its first
    /// link (rad), or the slide (m).
    pub fn transmission(
        mut self,
        name: &str,
        kind: TransmissionKind,
        [first, second]: [&str; 2],
        carrier: &str,
        start: (&str, f64),
    ) -> Self {
        let links = [first, second, carrier].map(ToString::to_string);
        let start = (start.0.into(), start.1);
        self.transmissions.push(Coupling { name: name.into(), kind, links, start, efficiency: [1.0; 2] });
        self
    }

    /// Sets the two efficiencies of the transmission added last.
    /// The first efficiency holds if power flows from the first member to the second.
    /// The second efficiency holds if power flows back.
    pub fn efficiency(mut self, efficiency: [f64; 2]) -> Self {
        if let Some(last) = self.transmissions.last_mut() {
            last.efficiency = efficiency;
        }
        self
    }

    /// Adds a driving link at constant speed: rad/s, counter-clockwise positive, or m/s for a prismatic joint.
    /// [`Drive::of_joint`] gives the driving link, usually the link that `joint` connects to the ground.
    /// The first driving link is the crank.
    pub fn crank(self, joint: &str, speed: f64) -> Self {
        self.driven(joint, MotionLaw::ConstantSpeed(speed))
    }

    /// Adds a driving link that follows a motion law.
    /// The first drive starts at the input of [`CaseBuilder::start`], which may be called before or after this method.
    /// For a further drive, [`CaseBuilder::start`] must be called before this method.
    pub fn driven(self, joint: &str, law: MotionLaw) -> Self {
        let start = self.start;
        self.driven_from(joint, start, law)
    }

    /// Adds a drive that follows a motion law from the input `start` (rad or m) at t = 0.
    /// For the first drive, `start` is ignored: this drive starts at [`CaseBuilder::start`].
    pub fn driven_from(mut self, joint: &str, start: f64, law: MotionLaw) -> Self {
        self.cranks.push((joint.into(), start, DriveMotion::Prescribed { law, motor: None }));
        self
    }

    /// Adds a driving link in free motion, as in [`DriveMotion::Free`].
    /// The arguments are the link's speed at t = 0 and the link's nominal speed.
    /// Both speeds are in rad/s, counter-clockwise positive; the nominal speed is not zero.
    /// The link is hinged to the ground or to a driving link added before.
    pub fn free(mut self, joint: &str, initial_speed: f64, nominal_speed: f64) -> Self {
        let motion = DriveMotion::Free { initial_speed, nominal_speed, motor: None };
        self.cranks.push((joint.into(), self.start, motion));
        self
    }

    /// Sets the motor of the crank. Default: no motor.
    pub fn motor(mut self, motor: Motor) -> Self {
        self.motor = Some(motor);
        self
    }

    /// Sets the input of the first drive at t = 0: the world angle of the crank's x axis (rad), or a slide (m).
    /// The default is 0.
    pub fn start(mut self, crank: f64) -> Self {
        self.start = crank;
        self
    }

    /// Sets the assembly mode of the Assur group with these links.
    pub fn mode(mut self, links: &[&str], mode: AssemblyMode) -> Self {
        self.modes.push((links.iter().map(ToString::to_string).collect(), mode));
        self
    }

    /// Sets the acceleration of gravity (m/s^2). Default: no gravity.
    pub fn gravity(mut self, gravity: [f64; 2]) -> Self {
        self.gravity = gravity.into();
        self
    }

    /// Adds a load.
    /// A load refers to moving links by the numbers 1, 2, ... in the order of the calls to [`CaseBuilder::link`].
    /// The ground has the number 0.
    pub fn load(mut self, load: Load) -> Self {
        self.loads.push(load);
        self
    }

    /// Sets the number of equal intervals into which the requested instants divide one turn of the crank.
    /// For a free crank the intervals divide the time of one turn at the nominal speed. Default: 360.
    pub fn instants(mut self, parts: usize) -> Self {
        self.instants = parts;
        self
    }

    /// Sets the requested instants (s).
    /// Instants set by [`CaseBuilder::instants`] are replaced.
    pub fn times(mut self, times: &[f64]) -> Self {
        self.times = Some(times.to_vec());
        self
    }

    /// Sets the requested channels. Default: all.
    pub fn wanted(mut self, wanted: Wanted) -> Self {
        self.wanted = wanted;
        self
    }

    /// Checks the input and returns the case.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for an unknown link, point, joint or group, with a list of the known names.
    /// [`ErrorKind::Input`] also for a mechanism without ground or crank.
    /// [`ErrorKind::Unsupported`] for more than ten million intervals.
    /// The errors of [`Mechanism::new`], [`Mechanism::with_transmissions`], [`Structure::of`], [`first_pose`] and
    /// [`Case::new`] are passed on.
    pub fn build(mut self) -> Result<Case> {
        if self.links.first().is_none_or(|link| link.name != "ground") {
            return Err(missing(
                "ground",
                sentences::THE_MECHANISM_HAS_NO_GROUND,
                sentences::GIVE_ITS_POINTS_WITH_GROUND,
            ));
        }
        for (name, mass, centre, inertia) in std::mem::take(&mut self.masses) {
            let index = self.link_of(&name, "masses")?;
            let link = &mut self.links[index];
            (link.mass, link.mass_centre, link.inertia) = (mass, centre, inertia);
        }
        if self.times.is_none() && self.instants > MOST_INTERVALS {
            let message = sentences::intervals_are_requested(&self.instants, &MOST_INTERVALS);
            return Err(Error::new(ErrorKind::Unsupported, message)
                .key("instants")
                .help(sentences::ASK_FOR_FEWER_INTERVALS));
        }
        let joints = self.joints.iter().map(|wish| self.made(wish)).collect::<Result<Vec<Joint>>>()?;
        let couplings = std::mem::take(&mut self.transmissions);
        let designs = couplings.iter().map(|own| self.coupled(own, &joints)).collect::<Result<Vec<_>>>()?;
        let mechanism = Mechanism::new(std::mem::take(&mut self.links), joints)?.with_transmissions(designs)?;
        let drives = self.drives(&mechanism)?;
        let structure = Structure::of(&mechanism, &drives.joints())?;
        let starts = self.starts(&mechanism, &structure)?;
        let (start, modes) = first_pose(&mechanism, &structure, &drives.coordinates(self.start), &starts)?;
        let grid = self.grid(drives.crank());
        let (gravity, loads, wanted) = (self.gravity, self.loads, self.wanted);
        Case::new(CaseParts { mechanism, structure, drives, loads, gravity, start, modes, grid, wanted, only: None })
    }

    fn link_of(&self, name: &str, key: &str) -> Result<LinkId> {
        let known = self.links.iter().map(|link| link.name.as_str());
        known.clone().position(|own| own == name).map(LinkId).ok_or_else(|| unknown("link", name, key, known))
    }

    fn made(&self, wish: &Wish) -> Result<Joint> {
        let key = format!("joints.{}", wish.name);
        let side = |[link, name]: &[String; 2]| -> Result<JointSide> {
            let index = self.link_of(link, &key)?;
            let points = &self.links[index].points;
            let point = points.iter().find(|point| point.name == *name).ok_or_else(|| {
                unknown(&sentences::point_of_link(&link), name, &key, points.iter().map(|own| own.name.as_str()))
            })?;
            Ok(JointSide { link: index, local: point.local })
        };
        let kind = match wish.axes {
            None => JointKind::Revolute,
            Some(angles) => JointKind::Prismatic { axes: angles.map(unit) },
        };
        Ok(Joint {
            name: wish.name.clone(),
            kind,
            first: side(&wish.sides[0])?,
            second: side(&wish.sides[1])?,
            drawn: None,
        })
    }

    fn coupled(&self, own: &Coupling, joints: &[Joint]) -> Result<TransmissionDesign> {
        let key = format!("transmissions.{}", own.name);
        let [first, second, carrier] = &own.links;
        let known = joints.iter().map(|joint| joint.name.as_str());
        let joint = known.clone().position(|name| name == own.start.0).map(JointId);
        Ok(TransmissionDesign {
            name: own.name.clone(),
            kind: own.kind.clone(),
            links: [self.link_of(first, &key)?, self.link_of(second, &key)?],
            carrier: self.link_of(carrier, &key)?,
            joint: joint.ok_or_else(|| unknown("joint", &own.start.0, &key, known))?,
            start: own.start.1,
            efficiency: own.efficiency,
        })
    }

    /// Grid of the given times. If no times are given, the grid divides a turn into equal intervals.
    fn grid(&self, crank: &Drive) -> Grid {
        let share = |part: usize| part as f64 / self.instants.max(1) as f64;
        let parts = 0..=self.instants;
        match &self.times {
            Some(times) => Grid::of_times(crank, times.clone()),
            None if crank.is_free() => {
                let period = TAU / crank.top_speed().abs();
                Grid::of_times(crank, parts.map(|part| period * share(part)).collect())
            }
            None => {
                let sense = crank.sense();
                let turn = |part: usize| self.start + sense * TAU * part as f64 / self.instants.max(1) as f64;
                Grid::of_inputs(crank, parts.map(turn).collect())
            }
        }
    }

    fn drives(&self, mechanism: &Mechanism) -> Result<Drives> {
        let mut all: Vec<Drive> = Vec::with_capacity(self.cranks.len());
        for (name, start, motion) in &self.cranks {
            let known = mechanism.joints().iter().map(|joint| joint.name.as_str());
            let joint = mechanism.joint_named(name).ok_or_else(|| unknown("joint", name, "drive", known))?;
            let (input, link) = Drive::of_joint(&mechanism.joints()[joint], &all, motion.is_free());
            let (zero, start) = (0.0, if all.is_empty() { self.start } else { *start });
            all.push(Drive { input, joint, link, zero, start, motion: motion.clone(), through: false });
        }
        if all.is_empty() {
            let help = sentences::NAME_THE_DRIVEN_JOINT_WITH_CRANK;
            return Err(missing("drive", sentences::NOTHING_DRIVES_THE_MECHANISM, help));
        }
        let crank = all.remove(0);
        let crank = if self.motor.is_some() { crank.with_motor(self.motor.clone()) } else { crank };
        Ok(Drives::new(crank, all))
    }

    /// Required mode of each group, in the order of the structure. A group that has only one configuration needs no
    /// mode.
    fn starts(&self, mechanism: &Mechanism, structure: &Structure) -> Result<Vec<StartGroup>> {
        let structure = structure.at_start();
        let mut starts = vec![StartGroup::default(); structure.groups.len()];
        for (start, group) in starts.iter_mut().zip(&structure.groups) {
            if group.kind.has_one_configuration() {
                start.mode = Some(AssemblyMode::Only);
            }
        }
        for (links, mode) in &self.modes {
            let own = |name: &String| mechanism.link_named(name);
            let wanted: Option<Vec<LinkId>> = links.iter().map(own).collect();
            let is_it = |of: &[LinkId]| {
                wanted.as_ref().is_some_and(|all| all.len() == of.len() && all.iter().all(|link| of.contains(link)))
            };
            let Some(index) = structure.groups.find(|group| is_it(&group.links)) else {
                let known: Vec<String> = structure.groups.iter().map(|group| group.names(mechanism)).collect();
                return Err(unknown("group", &links.join(", "), "start.groups", known.iter().map(String::as_str)));
            };
            let first = structure.groups[index].links[0];
            let in_order = mechanism.link_named(&links[0]) == Some(first);
            starts[index].mode = Some(if in_order { *mode } else { mode.swapped() });
        }
        Ok(starts)
    }
}

/// A massless link.
fn bare(name: &str, points: &[(&str, [f64; 2])]) -> Link {
    let point = |&(name, local): &(&str, [f64; 2])| Point { name: name.into(), local: local.into() };
    let points = points.iter().map(point).collect();
    Link { name: name.into(), points, mass: 0.0, mass_centre: Vec2::zeros(), inertia: 0.0 }
}

fn unknown<'a>(what: &str, asked: &str, key: &str, known: impl Iterator<Item = &'a str>) -> Error {
    let known: Vec<&str> = known.collect();
    let error = Error::new(ErrorKind::Input, sentences::there_is_no_called(&what, &asked)).key(key);
    error.help(sentences::use_one_of(&(known.join("; "))))
}

fn missing(key: &str, what: &str, help: &str) -> Error {
    Error::new(ErrorKind::Input, what).key(key).help(help.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn four_bar() -> CaseBuilder {
        Case::builder()
            .ground(&[("O", [0.0, 0.0]), ("C", [4.0, 0.0])])
            .link("crank", &[("O", [0.0, 0.0]), ("A", [1.0, 0.0])])
            .link("coupler", &[("A", [0.0, 0.0]), ("B", [4.0, 0.0])])
            .link("rocker", &[("C", [0.0, 0.0]), ("B", [3.0, 0.0])])
            .pin("O", "ground", "crank")
            .pin("A", "crank", "coupler")
            .pin("B", "coupler", "rocker")
            .pin("C", "ground", "rocker")
    }

    fn message(builder: CaseBuilder) -> String {
        builder.build().unwrap_err().to_string()
    }

    #[test]
    fn the_built_four_bar_equals_the_fixture() {
        let case = four_bar().crank("O", -2.0).mode(&["rocker", "coupler"], AssemblyMode::Right).build().unwrap();
        assert_eq!(case.mechanism, crate::fixtures::four_bar());
        assert_eq!(case.modes, [AssemblyMode::Left]);
        assert_eq!((case.grid.len(), case.grid.inputs[360]), (361, -TAU));
        assert_eq!(case.crank().link, LinkId(1));
    }

    #[test]
    fn a_slider_crank_takes_its_axis_in_both_frames() {
        let case = Case::builder()
            .ground(&[("O", [0.0, 0.0]), ("D", [0.0, 0.0])])
            .link("crank", &[("O", [0.0, 0.0]), ("A", [0.1, 0.0])])
            .link("rod", &[("A", [0.0, 0.0]), ("B", [0.4, 0.0])])
            .link("piston", &[("B", [0.0, 0.0])])
            .pin("O", "ground", "crank")
            .pin("A", "crank", "rod")
            .pin("B", "rod", "piston")
            .slider("D", ("ground", "D"), ("piston", "B"), [0.0, 0.0])
            .crank("O", 10.0)
            .mode(&["rod", "piston"], AssemblyMode::Ahead)
            .instants(8)
            .build()
            .unwrap();
        assert!((case.start.0[LinkId(3)].origin.x - 0.5).abs() < 1e-15, "{:?}", case.start);
    }

    /// Regression: the builder chose the instants of a free motion by crank angle.
    /// Crank angles cannot be used, because the time at which a free crank reaches an angle depends on the forces.
    #[test]
    fn the_instants_of_a_free_motion_are_times() {
        let left = |builder: CaseBuilder| builder.mode(&["coupler", "rocker"], AssemblyMode::Left);
        let case = left(four_bar().free("O", 0.5, -4.0)).instants(8).build().unwrap();
        assert!(case.crank().is_free() && case.crank().initial_speed() == 0.5 && case.crank().motor().is_none());
        assert_eq!(case.grid, Grid::of_times(case.crank(), (0..=8).map(|k| TAU / 4.0 * f64::from(k) / 8.0).collect()));
        let case = left(four_bar().free("O", 0.0, 4.0)).times(&[0.0, 0.3, 0.1]).build().unwrap();
        assert_eq!(case.grid.times, [0.0, 0.3, 0.1]);
        // A grid of crank angles is rejected for a free crank, even if the builder did not make the grid.
        let angles = Grid::of_inputs(case.crank(), vec![0.0, 1.0]);
        assert!(case.on(angles.clone()).unwrap_err().to_string().contains("the motion is free"));
        assert!(case.with(|parts| parts.grid = angles).unwrap_err().to_string().contains("the motion is free"));
        // A prescribed crank also accepts times. A free link may be hinged to another free link.
        let prescribed = left(four_bar().crank("O", 2.0)).times(&[0.5]).build().unwrap();
        assert_eq!((prescribed.grid.times[0], prescribed.grid.inputs[0]), (0.5, 1.0));
        let pendulum = Case::builder()
            .ground(&[("O", [0.0; 2])])
            .link("lower", &[("A", [0.0; 2]), ("B", [1.0, 0.0])])
            .link("upper", &[("O", [0.0; 2]), ("A", [1.0, 0.0])])
            .pin("O", "ground", "upper")
            .pin("A", "lower", "upper")
            .free("O", 0.0, 1.0)
            .free("A", 0.0, 1.0);
        let drives = pendulum.build().unwrap().into_parts().drives;
        assert_eq!([drives[0].link, drives[1].link], [LinkId(2), LinkId(1)]);
    }

    #[test]
    fn the_builder_gives_the_motor_to_the_crank() {
        let motor = Motor::ideal(crate::drive::MotorLaw::Constant { torque: 2.0 }, 1.0);
        let built =
            four_bar().free("O", 0.0, 4.0).motor(motor.clone()).mode(&["coupler", "rocker"], AssemblyMode::Left);
        assert_eq!(built.build().unwrap().crank().moving_motor(), Some(&motor));
    }

    #[test]
    fn unknown_names_are_reported_with_the_known_ones() {
        let said = message(four_bar().crank("P", 1.0));
        assert!(said.contains("no joint called \"P\"") && said.contains("O; A; B; C"), "{said}");
        let said = message(four_bar().pin("E", "crank", "coupler").crank("O", 1.0));
        assert!(said.contains("no point of link \"crank\" called \"E\"") && said.contains("O; A"), "{said}");
        let said = message(four_bar().mass("lever", 1.0, [0.0; 2], 0.0).crank("O", 1.0));
        assert!(said.contains("no link called \"lever\"") && said.contains("rocker"), "{said}");
        let said = message(four_bar().crank("O", 1.0).mode(&["crank"], AssemblyMode::Left));
        assert!(said.contains("no group called \"crank\"") && said.contains("coupler, rocker"), "{said}");
        assert!(message(four_bar()).contains("the mechanism has no drive"));
        assert!(message(Case::builder()).contains("no ground"));
        let said = message(four_bar().crank("O", 1.0));
        assert!(said.contains("coupler, rocker"), "{said}");
        let nan = message(four_bar().crank("O", f64::NAN).mode(&["coupler", "rocker"], AssemblyMode::Left));
        assert!(nan.contains("NaN"), "{nan}");
    }
}
