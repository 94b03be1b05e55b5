//! A mechanism as data.
//! A test can turn, mirror or load the mechanism before it writes the mechanism as scenario text.

use std::fmt::Write;
use std::path::Path;

use linkage::math::{Vec2, rotated, unit};
use scenario::Scenario;

/// A link with its points.
#[derive(Clone, Debug)]
pub struct SpecimenLink {
    /// Name.
    pub name: String,
    /// Names and positions of the link's points, in the link's frame (m).
    pub points: Vec<(String, Vec2)>,
    /// Mass, mass centre and moment of inertia; `None` for a massless link.
    pub mass: Option<(f64, Vec2, f64)>,
}

/// A revolute joint. The joint has the name of its point.
#[derive(Clone, Debug)]
pub struct Pin {
    /// Name of the joint and of its point.
    pub name: String,
    /// The two links of the joint.
    pub links: [String; 2],
}

/// A prismatic joint between two links, with one point and one axis angle (rad) on each link.
#[derive(Clone, Debug)]
pub struct Guide {
    /// Name.
    pub name: String,
    /// The two links of the joint.
    pub links: [String; 2],
    /// Names of the joint's points on the two links.
    pub points: [String; 2],
    /// Angles of the joint's axis in the frames of the two links (rad).
    pub axes: [f64; 2],
}

impl Guide {
    /// Exchanges the order of the links in the joint.
    pub fn reverse(&mut self) {
        self.links.reverse();
        self.points.reverse();
        self.axes.reverse();
    }
}

/// Start configuration of a group other than an RRR dyad.
#[derive(Clone, Debug)]
pub enum Ask {
    /// The assembly mode `ahead` of an RRP or RPR dyad.
    Ahead,
    /// The assembly mode `behind` of an RRP or RPR dyad.
    Behind,
    /// The configuration near these approximate positions of points.
    Near(Vec<(String, Vec2)>),
}

impl Ask {
    /// Exchanges `Ahead` and `Behind`, for RRP and RPR dyads.
    pub fn reverse(&mut self) {
        match self {
            Ask::Ahead => *self = Ask::Behind,
            Ask::Behind => *self = Ask::Ahead,
            Ask::Near(_) => {}
        }
    }
}

/// The links of a group, and the configuration in which the group starts.
#[derive(Clone, Debug)]
pub struct Start {
    /// The links of the group.
    pub links: Vec<String>,
    /// Requested configuration of the group.
    pub ask: Ask,
}

/// The links of an RRR dyad, and its assembly mode.
#[derive(Clone, Debug)]
pub struct Dyad {
    /// The links of the dyad.
    pub links: [String; 2],
    /// Whether the inner joint is on the left of the line from the first to the second outer joint.
    pub left: bool,
}

/// A whole scenario, in SI units.
#[derive(Clone, Debug, Default)]
pub struct Spec {
    /// Points of the ground (m).
    pub ground: Vec<(String, Vec2)>,
    /// Moving links; the first is the crank.
    pub links: Vec<SpecimenLink>,
    /// Revolute joints.
    pub pins: Vec<Pin>,
    /// Prismatic joints.
    pub guides: Vec<Guide>,
    /// Whether the prismatic joints come before the revolute ones.
    pub guides_first: bool,
    /// Speed of the crank (rad/s).
    pub speed: f64,
    /// World direction of the crank at crank angle zero (rad).
    pub zero: f64,
    /// Crank angle at t = 0 (rad).
    pub start: f64,
    /// Gravity (m/s^2).
    pub gravity: Vec2,
    /// Links with a moment of resistance (N m).
    pub loads: Vec<(String, f64)>,
    /// RRR dyads with their assembly modes.
    pub dyads: Vec<Dyad>,
    /// Start configurations of the other groups that have more than one configuration.
    pub starts: Vec<Start>,
    /// First crank angle (rad), step (rad) and number of steps of the grid.
    pub grid: (f64, f64, usize),
    /// The engine's step; if `None`, the text has no engine section.
    pub dt: Option<f64>,
    /// Parts that only some mechanisms have.
    pub other: Other,
}

/// Parts that only some mechanisms have.
#[derive(Clone, Debug, Default)]
pub struct Other {
    /// Name of the scenario. If the field is empty, the scenario is called "test".
    pub name: String,
    /// Keys for a motion law or a free motion in the drive section. They replace the key for the speed.
    pub drive: String,
    /// Further sections, such as a motor or loads.
    pub sections: String,
    /// Last instant (s) and number of steps of a grid in time. A grid in time replaces the grid of crank angles.
    pub times: Option<(f64, usize)>,
}

impl Spec {
    /// The scenario as text. The driven joint is the first revolute one.
    pub fn toml(&self) -> String {
        let name = if self.other.name.is_empty() { "test" } else { &self.other.name };
        let mut text = format!("format = 1\nname = \"{name}\"\ntitle = \"{name}\"\n[ground.points]\n");
        let place = |v: Vec2| format!("{{ x_m = {:?}, y_m = {:?} }}", v.x, v.y);
        for (name, at) in &self.ground {
            writeln!(text, "{name} = {}", place(*at)).unwrap();
        }
        for body in &self.links {
            writeln!(text, "[links.{}]", body.name).unwrap();
            if let Some((mass, centre, inertia)) = body.mass {
                writeln!(text, "mass_kg = {mass:?}\ninertia_kg_m2 = {inertia:?}\nmass_centre = {}", place(centre))
                    .unwrap();
            }
            writeln!(text, "[links.{}.points]", body.name).unwrap();
            for (name, at) in &body.points {
                writeln!(text, "{name} = {}", place(*at)).unwrap();
            }
        }
        let pins = self.pins.iter().map(|Pin { name, links }| {
            format!("[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = {links:?}\n")
        });
        let guides = self.guides.iter().map(|Guide { name, links, points, axes: [first, second] }| {
            format!(
                "[[joints]]\nname = \"{name}\"\ntype = \"prismatic\"\nlinks = {links:?}\npoints = {points:?}\n\
                 axis_rad = {first:?}\nsecond_axis_rad = {second:?}\n"
            )
        });
        if self.guides_first {
            text.extend(guides.chain(pins));
        } else {
            text.extend(pins.chain(guides));
        }
        let (driven, zero) = (&self.pins[0].name, self.zero);
        let motion = match self.other.drive.as_str() {
            "" => format!("speed_rad_s = {:?}", self.speed),
            keys => keys.trim_end().into(),
        };
        writeln!(text, "[drive]\njoint = \"{driven}\"\n{motion}\nzero_rad = {zero:?}").unwrap();
        writeln!(text, "[gravity]\nx_m_s2 = {:?}\ny_m_s2 = {:?}", self.gravity.x, self.gravity.y).unwrap();
        for (link, moment) in &self.loads {
            writeln!(text, "[[loads]]\ntype = \"resistance\"\nlink = \"{link}\"\nmoment_N_m = {moment:?}").unwrap();
        }
        text.push_str(&self.other.sections);
        writeln!(text, "[start]\ncrank_rad = {:?}", self.start).unwrap();
        for Dyad { links: [a, b], left } in &self.dyads {
            let mode = if *left { "left" } else { "right" };
            writeln!(text, "[[start.groups]]\nlinks = [\"{a}\", \"{b}\"]\nmode = \"{mode}\"").unwrap();
        }
        for Start { links, ask } in &self.starts {
            writeln!(text, "[[start.groups]]\nlinks = {links:?}").unwrap();
            match ask {
                Ask::Ahead => text.push_str("mode = \"ahead\"\n"),
                Ask::Behind => text.push_str("mode = \"behind\"\n"),
                Ask::Near(points) => {
                    let one = |(name, at): &(String, Vec2)| {
                        format!("{{ point = \"{name}\", x_m = {:?}, y_m = {:?} }}", at.x, at.y)
                    };
                    let all: Vec<String> = points.iter().map(one).collect();
                    writeln!(text, "near = [{}]", all.join(", ")).unwrap();
                }
            }
        }
        if let Some((to, count)) = self.other.times {
            writeln!(text, "[grid]\nfrom_s = 0\nto_s = {to:?}\nstep_s = {:?}", to / count as f64).unwrap();
        } else {
            let (from, step, count) = self.grid;
            let to = from + step * count as f64;
            writeln!(text, "[grid]\nfrom_rad = {from:?}\nto_rad = {to:?}\nstep_rad = {step:?}").unwrap();
        }
        if let Some(dt) = self.dt {
            writeln!(text, "[engine]\ndt_s = {dt:?}").unwrap();
        }
        text
    }

    /// The scenario, read from its text.
    pub fn scenario(&self) -> linkage::Result<Scenario> {
        Scenario::parse(&self.toml(), Path::new("test.toml"))
    }

    /// This mechanism moved by `by` and turned by `turn` (rad). Gravity is turned too.
    pub fn moved(&self, by: Vec2, turn: f64) -> Spec {
        let mut other = self.clone();
        let carried = |at: Vec2| by + rotated(unit(turn), at);
        other.ground.iter_mut().for_each(|(_, at)| *at = carried(*at));
        for guide in &mut other.guides {
            let axes = guide.links.iter().zip(&mut guide.axes).filter(|(link, _)| *link == "ground");
            axes.for_each(|(_, axis)| *axis += turn);
        }
        other.near_points().for_each(|at| *at = carried(*at));
        other.zero += turn;
        other.gravity = rotated(unit(turn), self.gravity);
        other
    }

    /// The mirror image about the x axis: positions, angles, senses of rotation, gravity and assembly modes.
    pub fn mirrored(&self) -> Spec {
        let mut other = self.with_places(|at| Vec2::new(at.x, -at.y));
        (other.zero, other.start, other.speed) = (-self.zero, -self.start, -self.speed);
        (other.grid.0, other.grid.1) = (-self.grid.0, -self.grid.1);
        other.gravity.y = -self.gravity.y;
        other.guides.iter_mut().flat_map(|guide| &mut guide.axes).for_each(|axis| *axis = -*axis);
        // A mirror exchanges left and right of a line.
        // The modes `ahead` and `behind` refer to an axis. The axis is mirrored too, so these modes stay.
        other.dyads.iter_mut().for_each(|dyad| dyad.left = !dyad.left);
        other
    }

    /// This mechanism with all lengths multiplied by `factor`, and all moments of inertia by the square of `factor`.
    /// Nothing else changes; the masses and the numbers in the texts of the field `other` keep their values.
    pub fn larger(&self, factor: f64) -> Spec {
        let mut other = self.with_places(|at| at * factor);
        for (_, _, inertia) in other.links.iter_mut().filter_map(|body| body.mass.as_mut()) {
            *inertia *= factor * factor;
        }
        other
    }

    /// This mechanism with changed positions of all points and mass centres.
    fn with_places(&self, to: impl Fn(Vec2) -> Vec2) -> Spec {
        let mut other = self.clone();
        let points = other.links.iter_mut().flat_map(|body| &mut body.points).chain(&mut other.ground);
        points.for_each(|(_, at)| *at = to(*at));
        other.links.iter_mut().filter_map(|body| body.mass.as_mut()).for_each(|(_, centre, _)| *centre = to(*centre));
        other.near_points().for_each(|at| *at = to(*at));
        other
    }

    fn near_points(&mut self) -> impl Iterator<Item = &mut Vec2> {
        let asked = self.starts.iter_mut().filter_map(|start| match &mut start.ask {
            Ask::Near(points) => Some(points),
            Ask::Ahead | Ask::Behind => None,
        });
        asked.flatten().map(|(_, at)| at)
    }

    /// This mechanism with every mass and moment of inertia multiplied by `factor`.
    pub fn heavier(&self, factor: f64) -> Spec {
        let mut other = self.clone();
        for (mass, _, inertia) in other.links.iter_mut().filter_map(|body| body.mass.as_mut()) {
            *mass *= factor;
            *inertia *= factor;
        }
        other
    }
}

/// A four-bar O-A-B-C whose base, crank, coupler and rocker have the given lengths.
/// Each moving link lies along the x axis of its frame.
/// The pivots are O = (0, 0) and C = (`base`, 0). The links are slender rods of 10 kg/m.
pub fn four_bar([base, crank, coupler, rocker]: [f64; 4], left: bool) -> Spec {
    let rod = |name: &str, [from, to]: [&str; 2], length: f64| SpecimenLink {
        name: name.into(),
        points: vec![(from.into(), Vec2::zeros()), (to.into(), Vec2::new(length, 0.0))],
        mass: Some((10.0 * length, Vec2::new(length / 2.0, 0.0), 10.0 * length.powi(3) / 12.0)),
    };
    let pin = |name: &str, first: &str, second: &str| Pin { name: name.into(), links: [first.into(), second.into()] };
    Spec {
        ground: vec![("O".into(), Vec2::zeros()), ("C".into(), Vec2::new(base, 0.0))],
        links: vec![
            rod("crank", ["O", "A"], crank),
            rod("coupler", ["A", "B"], coupler),
            rod("rocker", ["C", "B"], rocker),
        ],
        pins: vec![
            pin("O", "ground", "crank"),
            pin("A", "crank", "coupler"),
            pin("B", "coupler", "rocker"),
            pin("C", "ground", "rocker"),
        ],
        speed: 10.0,
        gravity: Vec2::new(0.0, -9.81),
        dyads: vec![Dyad { links: ["coupler".into(), "rocker".into()], left }],
        grid: (0.0, std::f64::consts::PI / 36.0, 72),
        dt: Some(1e-3),
        ..Spec::default()
    }
}
