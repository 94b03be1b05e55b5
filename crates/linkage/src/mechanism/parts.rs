//! Links with their points, and joints with their two sides.

use super::ids::LinkId;
use crate::input::Input;
use crate::math::{KeepNan, Motion, Vec2, cross, rotated};

/// Number of the ground (frame) in [`Mechanism::links`](super::Mechanism::links).
pub const GROUND: LinkId = LinkId(0);

/// Rigid member of a mechanism. Points and mass centre are given in the link's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name, unique in the mechanism.
    pub name: String,
    /// Named points with their coordinates in the link's frame (m).
    pub points: Vec<Point>,
    /// Mass (kg), not negative; 0 for the ground.
    pub mass: f64,
    /// Mass centre in the link's frame (m).
    pub mass_centre: Vec2,
    /// Moment of inertia about the mass centre (kg m^2), not negative.
    pub inertia: f64,
}

impl Link {
    /// Largest distance between two points of the link (m).
    #[must_use]
    pub fn size(&self) -> f64 {
        let mut square = 0.0;
        for (index, a) in self.points.iter().enumerate() {
            for b in &self.points[index + 1..] {
                square = (a.local - b.local).norm_squared().larger(square);
            }
        }
        square.sqrt()
    }

    /// The lever arm of forces on the link (m): the largest distance between two points, mass centre included.
    /// If a link with mass has a single point at its mass centre (a flywheel), the lever arm is the radius of gyration.
    /// For a link with a single point and no mass, the lever arm is 0.
    #[must_use]
    pub fn extent(&self) -> f64 {
        if self.mass <= 0.0 {
            return self.size();
        }
        let from_centre = self.points.iter().map(|point| (point.local - self.mass_centre).norm_squared());
        let extent = self.size().larger(from_centre.fold(0.0, f64::larger).sqrt());
        if extent > 0.0 { extent } else { (self.inertia / self.mass).sqrt() }
    }
}

/// Named point of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name. Points with the same name on different links coincide, because a joint holds them together.
    pub name: String,
    /// Coordinates in the link's frame (m).
    pub local: Vec2,
}

/// Kind of kinematic pair.
/// [`JointKind::equations`] gives the number of equations of a kind.
/// The links' relative degrees of freedom are three minus this number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Revolute pair (pin): the joint's points on both links coincide.
    Revolute,
    /// Prismatic pair (slider in a guide).
    /// The joint's point on the second link lies on a line parallel to the axis.
    /// The line goes through the joint's point on the first link.
    /// The two links turn together.
    Prismatic {
        /// Unit vectors of the axis in the frame of the first link and in the frame of the second link. Both vectors
        /// describe the same direction in the world.
        axes: [Vec2; 2],
    },
}

/// Properties of the kinds of pair, for all crates.
/// A new kind needs changes in these methods, and in all code that writes equations for each kind.
impl JointKind {
    /// Direction of a line that goes through the joint's point on the first link.
    /// The joint's point on the second link must lie on this line, which is one equation.
    /// The direction is a unit vector in the frame of the first link.
    /// `None` if the joint's points on the two links must coincide, which is two equations.
    #[inline]
    #[must_use]
    pub fn line(self) -> Option<Vec2> {
        match self {
            JointKind::Revolute => None,
            JointKind::Prismatic { axes } => Some(axes[0]),
        }
    }

    /// Axis along which the links slide, as two unit vectors: one in the frame of the first link, one in the frame of
    /// the second link.
    /// `None` if the links do not slide.
    #[inline]
    #[must_use]
    pub fn axes(self) -> Option<[Vec2; 2]> {
        match self {
            JointKind::Revolute => None,
            JointKind::Prismatic { axes } => Some(axes),
        }
    }

    /// Number of constraint equations.
    /// [`Mechanism::rows`](super::Mechanism::rows) gives the position of these equations in a list of all equations.
    #[inline]
    #[must_use]
    pub fn equations(self) -> usize {
        match self {
            JointKind::Revolute | JointKind::Prismatic { .. } => 2,
        }
    }

    /// Whether the links slide along each other. A sliding joint has a guide, a block, and a slide (distance) between
    /// them.
    #[inline]
    #[must_use]
    pub fn slides(self) -> bool {
        match self {
            JointKind::Revolute => false,
            JointKind::Prismatic { .. } => true,
        }
    }

    /// Whether the joint is a common point of the two links, and the links turn about this point.
    #[inline]
    #[must_use]
    pub fn is_pin(self) -> bool {
        match self {
            JointKind::Revolute => true,
            JointKind::Prismatic { .. } => false,
        }
    }

    /// Whether the links turn together.
    /// If the links turn together, the angle between the links is constant, and the reaction includes a moment.
    #[inline]
    #[must_use]
    pub fn keeps_angle(self) -> bool {
        match self {
            JointKind::Revolute => false,
            JointKind::Prismatic { .. } => true,
        }
    }

    /// Whether a drive at this kind of joint can have this input.
    #[must_use]
    pub fn has_input(self, input: Input) -> bool {
        match self {
            JointKind::Revolute => matches!(input, Input::Angle | Input::Turn),
            JointKind::Prismatic { .. } => input == Input::Slide,
        }
    }

    /// Name, as in scenario files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic { .. } => "prismatic",
        }
    }
}

crate::words! {
    /// Appearance of a prismatic pair in pictures. The appearance does not affect any calculation.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Guise: name {
        /// A piston in a cylinder.
        Cylinder = "cylinder",
        /// A block: on rails of the ground, or in a slot of a moving link.
        Block = "block",
    }
}

/// One side of a joint: a point of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSide {
    /// Index of the link.
    pub link: LinkId,
    /// Coordinates of the joint in that link's frame (m).
    pub local: Vec2,
}

/// Kinematic pair between two links. The reaction of a joint is the force of the first link on the second link.
/// In a prismatic pair, the reaction also includes a moment about the joint's point on the second link.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name, unique in the mechanism.
    pub name: String,
    /// Kind of pair.
    pub kind: JointKind,
    /// First link, and the joint's position on it.
    pub first: JointSide,
    /// Second link, and the joint's position on it.
    pub second: JointSide,
    /// Appearance in pictures, if specified; only for prismatic pairs.
    pub drawn: Option<Guise>,
}

impl Joint {
    /// The joint's position on `link`; `None` if the joint is not on this link.
    #[inline]
    #[must_use]
    pub fn on(&self, link: LinkId) -> Option<Vec2> {
        [&self.first, &self.second].into_iter().find(|side| side.link == link).map(|side| side.local)
    }

    /// The side of the joint on the link other than `link`.
    #[must_use]
    pub fn other(&self, link: LinkId) -> JointSide {
        if self.first.link == link { self.second } else { self.first }
    }

    /// Point at which the joint's reaction acts on `link`.
    /// For a pin, the reaction acts at the joint's point on `link`; the points on both links coincide.
    /// For joints other than pins, the reaction acts at the joint's point on the second link.
    #[must_use]
    pub fn acts_at(&self, link: LinkId) -> JointSide {
        match self.kind {
            JointKind::Revolute if self.first.link == link => self.first,
            JointKind::Revolute | JointKind::Prismatic { .. } => self.second,
        }
    }

    /// [`JointKind::slides`] of the joint's kind.
    #[inline]
    #[must_use]
    pub fn slides(&self) -> bool {
        self.kind.slides()
    }

    /// [`JointKind::is_pin`] of the joint's kind.
    #[inline]
    #[must_use]
    pub fn is_pin(&self) -> bool {
        self.kind.is_pin()
    }

    /// [`JointKind::keeps_angle`] of the joint's kind.
    #[inline]
    #[must_use]
    pub fn keeps_angle(&self) -> bool {
        self.kind.keeps_angle()
    }

    /// Unit vector of the sliding axis in the frame of `link`. `None` if the links do not slide or the joint is not on
    /// `link`.
    #[must_use]
    pub fn axis_on(&self, link: LinkId) -> Option<Vec2> {
        let axes = self.kind.axes()?;
        let sides = [self.first, self.second];
        sides.iter().position(|side| side.link == link).map(|index| axes[index])
    }

    /// Slide of a prismatic joint (m) with its first and second derivative; `None` for a revolute joint.
    /// The slide is s = e . (p2 - p1) along the axis e of the first link.
    /// With p2 - p1 = s e: e . (v2 - v1) = s' and e . (a2 - a1) = s'' - s omega^2.
    #[inline]
    #[must_use]
    pub fn slide(&self, motions: &[Motion]) -> Option<[f64; 3]> {
        let [first, second] = [self.first, self.second].map(|side| (&motions[side.link], side.local));
        let axis = first.0.arm(self.axis_on(self.first.link)?);
        let slide = axis.dot(&(second.0.point(second.1) - first.0.point(first.1)));
        let speed = axis.dot(&(second.0.point_velocity(second.1) - first.0.point_velocity(first.1)));
        let second_derivative =
            axis.dot(&(second.0.point_acceleration(second.1) - first.0.point_acceleration(first.1)));
        Some([slide, speed, second_derivative + slide * first.0.omega * first.0.omega])
    }

    /// First and second time derivative of the joint's coordinate (rad/s and rad/s^2, or m/s and m/s^2).
    #[inline]
    #[must_use]
    pub fn rates(&self, motions: &[Motion]) -> [f64; 2] {
        let [first, second] = [self.first, self.second].map(|side| &motions[side.link]);
        self.slide(motions)
            .map_or([second.omega - first.omega, second.alpha - first.alpha], |[_, rate, second]| [rate, second])
    }

    /// The opening of the joint: a distance (m) and the sine of an angle.
    /// The distance is measured between the joint's points on the two links.
    /// In a prismatic pair, the distance is measured perpendicular to the axis.
    /// The angle is measured between the joint's axes on the two links. In a revolute pair the angle is 0.
    /// `places` are the joint's points on the two links in world coordinates.
    /// `directions` are the (cos, sin) of the links' angles.
    #[must_use]
    pub fn opening(&self, places: [Vec2; 2], directions: [Vec2; 2]) -> (f64, f64) {
        let gap = places[1] - places[0];
        match self.kind {
            JointKind::Revolute => (gap.norm(), 0.0),
            JointKind::Prismatic { axes } => {
                let [first, second] = [0, 1].map(|k| rotated(directions[k], axes[k]));
                // If the axes have opposite directions, the sine is small although the joint is open.
                // For such axes the largest possible opening is returned.
                let turn = if first.dot(&second) > 0.0 { cross(first, second).abs() } else { 1.0 };
                (cross(first, gap).abs(), turn)
            }
        }
    }
}
