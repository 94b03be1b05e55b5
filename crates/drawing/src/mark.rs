//! Marks: shapes in the frame of a link, and the meaning of each.

use std::f64::consts::TAU;

use linkage::math::{Vec2, unit};

/// Number of straight pieces that represent a full circle.
const CORNERS: f64 = 32.0;

/// A shape in the frame of a link (m).
#[derive(Clone, Debug, PartialEq)]
pub enum MarkShape {
    /// A line through points, or a polygon.
    Line {
        /// Corners of the line or polygon.
        points: Vec<Vec2>,
        /// Whether the last corner is joined to the first corner.
        closed: bool,
    },
    /// A circle.
    Circle {
        /// Centre of the circle.
        centre: Vec2,
        /// Radius of the circle.
        radius: f64,
    },
    /// A part of a circle.
    Arc {
        /// Centre of the circle.
        centre: Vec2,
        /// Radius of the circle.
        radius: f64,
        /// Direction of the first end from the centre (rad), counter-clockwise from the frame's x axis.
        from: f64,
        /// Angle from the first end to the last end (rad), counter-clockwise positive.
        sweep: f64,
    },
}

impl MarkShape {
    /// The shape as a line through points, for output formats that have only lines.
    /// [`MarkShape::is_closed`] states whether the line is closed.
    pub fn points(&self) -> Vec<Vec2> {
        let arc = |centre: Vec2, radius: f64, from: f64, sweep: f64, count: usize| {
            (0..=count).map(move |k| centre + unit(from + sweep * k as f64 / count as f64) * radius)
        };
        match *self {
            MarkShape::Line { ref points, .. } => points.clone(),
            MarkShape::Circle { centre, radius } => {
                arc(centre, radius, 0.0, TAU, CORNERS as usize).take(CORNERS as usize).collect()
            }
            MarkShape::Arc { centre, radius, from, sweep } => {
                let count = (CORNERS * sweep.abs() / TAU).ceil() as usize;
                arc(centre, radius, from, sweep, count.max(2)).collect()
            }
        }
    }

    /// Whether the last point of the shape is joined to its first point.
    pub fn is_closed(&self) -> bool {
        matches!(self, MarkShape::Line { closed: true, .. } | MarkShape::Circle { .. })
    }
}

/// All roles in one table, each with its name, ink, fill, line width and layer.
macro_rules! roles {
    ($($(#[$meaning:meta])* $role:ident = $name:literal: $ink:ident, $fill:ident, $width:literal, $layer:ident;)*) => {
        linkage::words! {
            /// Meaning of a mark.
            #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
            pub enum MarkRole: name { $($(#[$meaning])* $role = $name,)* }
        }

        impl MarkRole {
            /// How marks of this role are drawn.
            pub fn look(self) -> Look {
                match self {
                    $(MarkRole::$role => Look { ink: Ink::$ink, fill: Fill::$fill, width: $width, layer: Layer::$layer },)*
                }
            }
        }
    };
}

roles! {
    /// Centre line of a fixed guide.
    Axis = "axis": Quiet, None, 0.2, Ground;
    /// Hatching, which shows on which side of a line the ground is.
    Hatch = "hatch": Text, None, 0.25, Ground;
    /// Rail of a fixed guide.
    Rail = "rail": Text, None, 0.5, Ground;
    /// Wall of a fixed cylinder.
    Bore = "bore": Text, None, 0.5, Ground;
    /// Pivot on the ground: its triangle, the line below the triangle, and the hatching below this line.
    Pivot = "pivot": Text, Tint, 0.35, Blocks;
    /// Stroke across a guide at a ground point that is not a pivot.
    Stop = "stop": Text, None, 0.4, Ground;
    /// A link with three or more points that are not on a line.
    Plate = "plate": Link, Tint, 0.9, Links;
    /// A link with two points, or with several points on one line.
    Bar = "bar": Link, None, 1.1, Links;
    /// Shows that a bar continues past the pin in its middle.
    Weld = "weld": Link, Ink, 0.2, Links;
    /// Slot in a moving link, for a sliding block.
    Slot = "slot": Link, Paper, 0.6, Links;
    /// Cylinder of a moving link, in which a piston slides.
    Cylinder = "cylinder": Link, Paper, 0.6, Links;
    /// Pitch circle of a wheel, with a stroke that turns with the wheel.
    /// The same style is used for the pitch line of a rack, the profile of a cam, and the roller or face that touches
    /// the cam.
    Wheel = "wheel": Link, None, 0.45, Links;
    /// Strand of a belt.
    Strand = "strand": Link, None, 0.45, Links;
    /// Block on a guide.
    Block = "block": Link, Paper, 0.7, Blocks;
    /// Piston, and its rings.
    Piston = "piston": Link, Paper, 0.7, Blocks;
    /// Zigzag of a spring.
    Spring = "spring": Load, None, 0.4, Stretched;
    /// Cup, rod and piston of a damper.
    Damper = "damper": Load, None, 0.4, Stretched;
    /// Spiral of a torsional spring.
    TorsionSpring = "torsion-spring": Load, None, 0.4, Stretched;
    /// Drum of a torsional damper.
    TorsionDamper = "torsion-damper": Load, None, 0.4, Stretched;
    /// Revolute pair.
    Pin = "pin": Text, Paper, 0.5, Joints;
    /// Ring around a pin that joins more than two links: one ring for each link after the second.
    CoincidentPin = "coincident-pin": Text, None, 0.35, Joints;
    /// Mass centre: its circle, and the line from the circle to the link.
    MassCentre = "mass-centre": Link, Paper, 0.3, Stretched;
    /// Mass centre: two opposite quarters of its disc.
    MassQuarter = "mass-quarter": Link, Ink, 0.1, Stretched;
    /// Named point of a link that is not a joint.
    Tracer = "tracer": Link, None, 0.5, Joints;
    /// Line of the arrow that shows in which direction a drive moves its link: an arc, or for a slide a straight line.
    Drive = "drive": Text, None, 0.4, Signs;
    /// Head of the arrow that shows in which direction a drive moves its link.
    DriveHead = "drive-head": Text, Ink, 0.1, Signs;
    /// Circle of a motor. The letter M beside the circle is a label, [`Lettering::Motor`](crate::Lettering::Motor).
    Motor = "motor": Text, None, 0.4, Signs;
    /// Line of the arrow of a force or a moment.
    Load = "load": Load, None, 0.6, Signs;
    /// Head of the arrow of a force or a moment.
    LoadHead = "load-head": Load, Ink, 0.1, Signs;
}

/// The colour of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    /// The colour of the link.
    Link,
    /// The colour of text.
    Text,
    /// A pale colour for auxiliary lines.
    Quiet,
    /// The colour of loads.
    Load,
}

/// Fill of a closed line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// No fill: what lies beneath is visible.
    None,
    /// The colour of the paper: what lies beneath is covered.
    Paper,
    /// A tint of the ink.
    Tint,
    /// The ink.
    Ink,
}

/// Drawing layers, lowest first. Within a layer, larger links lie below smaller links, so that no link hides another
/// link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Layer {
    /// Marks of the ground, which never move.
    Ground,
    /// Links.
    Links,
    /// Blocks that slide on links, and the pivots about which links turn.
    Blocks,
    /// Mass centres, springs and dampers.
    Stretched,
    /// Joints.
    Joints,
    /// Arrows and motors.
    Signs,
}

/// How a mark is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour of the mark's line.
    pub ink: Ink,
    /// Fill of the area that a closed line encloses.
    pub fill: Fill,
    /// Thickness of the mark's line, in units of the sketch.
    pub width: f64,
    /// Drawing layer of the mark.
    pub layer: Layer,
}

/// A shape and its meaning.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The shape, in the frame of the mark's link (m).
    pub shape: MarkShape,
    /// The role of the mark.
    pub role: MarkRole,
}

impl Mark {
    /// An open line.
    pub fn line(role: MarkRole, points: impl Into<Vec<Vec2>>) -> Mark {
        Mark { role, shape: MarkShape::Line { points: points.into(), closed: false } }
    }

    /// A polygon.
    pub fn area(role: MarkRole, points: impl Into<Vec<Vec2>>) -> Mark {
        Mark { role, shape: MarkShape::Line { points: points.into(), closed: true } }
    }

    /// A circle.
    pub fn circle(role: MarkRole, centre: Vec2, radius: f64) -> Mark {
        Mark { role, shape: MarkShape::Circle { centre, radius } }
    }

    /// A part of a circle, with the direction of its first end and the angle from the first end to the last end (rad).
    pub fn arc(role: MarkRole, centre: Vec2, radius: f64, [from, sweep]: [f64; 2]) -> Mark {
        Mark { role, shape: MarkShape::Arc { centre, radius, from, sweep } }
    }
}
