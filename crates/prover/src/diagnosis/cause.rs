//! The simple causes that a diagnosis can name. Reports put them into words.

use linkage::trajectory::{Channel, Stage};

/// What explains a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub enum DisagreementCause {
    /// The values of some channels result from the right values by a wrong rule.
    Values {
        /// The wrong rule.
        slip: DataSlip,
        /// The disagreeing channels that the slip explains.
        channels: Vec<Channel>,
    },
    /// The suspect solved a different case.
    Case(Change),
}

/// Declares the slips that need no number, and a list of these slips. Every slip of the list is tried.
macro_rules! plain {
    ($($(#[$doc:meta])+ $name:ident,)+) => {
        /// Wrong rules without a number, by which right values become wrong, the simplest rule first.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Plain {
            $($(#[$doc])+ $name,)+
        }

        impl Plain {
            /// All, in order.
            pub const ALL: &[Plain] = &[$(Plain::$name,)+];
        }
    };
}

plain! {
    /// The opposite sign.
    Sign,
    /// Whole revolutions added during the motion.
    Turns,
    /// Half revolutions added during the motion. An arc tangent of a quotient gives such angles.
    HalfTurns,
    /// Twice the values.
    Twice,
    /// Half the values.
    Half,
    /// Zero instead of the values.
    Zero,
    /// Absolute values. For an angle, the absolute value after wrapping, as an arc cosine returns it.
    Size,
    /// An angle within a quarter revolution of zero with the right sine, as an arc sine returns it.
    ArcSine,
    /// Rates per radian of the crank instead of per second: velocities divided by the crank's speed, accelerations by
    /// its square.
    PerRadian,
    /// The driving moment at the motor's shaft instead of at the crank: divided by the ratio of the reducer.
    BeforeReducer,
}

/// The wrong rule by which right values were changed.
#[derive(Clone, Debug, PartialEq)]
pub enum DataSlip {
    /// A slip without a number.
    Plain(Plain),
    /// Another unit.
    Unit {
        /// The factor on values in the channel's unit.
        factor: f64,
        /// The wrong unit and the right unit, in words.
        told: &'static str,
    },
    /// The same amount added at every instant, in the channel's unit.
    Offset(f64),
    /// The opposite sign, and the same amount added at every instant. Example: an angle that is measured in the
    /// opposite direction from another axis.
    Mirrored(f64),
    /// The values of another channel.
    Instead(Channel),
    /// The values of another channel with the opposite sign.
    Opposite(Channel),
    /// The magnitude of a vector instead of one of its components. The variant contains both components.
    Magnitude([Channel; 2]),
    /// A numerical derivative of another channel, from differences between rows, in place of the exact derivative.
    Differences {
        /// The channel that is differentiated.
        of: Channel,
        /// Order of the rate: 1 or 2.
        order: usize,
        /// The rows whose values are subtracted.
        over: Over,
    },
    /// The acceleration without the Coriolis term of a block on a moving guide. The field is the name of the joint.
    NoCoriolis(String),
    /// The moment about a wrong point of reference. The field is the vector to this point from the right one.
    About(Arm),
    /// A single row is wrong, at this time (s).
    Outlier(f64),
    /// Values of other instants: the time of each row is multiplied by a factor.
    Clock {
        /// Factor that turns the time of a row into the time at which the values of the row are right.
        factor: f64,
        /// Meaning of the factor, if it is a unit conversion.
        told: Option<&'static str>,
    },
    /// Two channels with exchanged values.
    Exchanged([Channel; 2]),
    /// The difference of two other channels, first minus second, and the same amount added at every instant.
    Between {
        /// The two channels.
        of: [Channel; 2],
        /// The amount, in the channel's unit.
        offset: f64,
    },
    /// Values multiplied by the same number at every instant.
    Factor(f64),
    /// Values of another instant.
    Late {
        /// Delay of the values (s); negative for values that are early.
        by: f64,
        /// The delay as a number of steps or rows of the suspect, with the word for step or row; `None` if this number
        /// is not simple.
        steps: Option<(f64, &'static str)>,
        /// The late channels.
        of: LateChannels,
    },
}

/// The channels whose values belong to other instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LateChannels {
    /// All channels.
    All,
    /// The channels of one stage.
    OfStage(Stage),
    /// Only the disagreeing channels that the cause explains.
    Explained,
}

/// The rows whose values are subtracted to obtain a numerical derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// The rows at this distance before and after the row.
    Either(usize),
    /// The row and the previous row.
    Before,
    /// The row and the next row.
    Behind,
}

/// Vector from the right point of reference of a moment to the wrong point of reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Arm {
    /// A constant vector (m), in world axes.
    Constant([f64; 2]),
    /// The vector from the first point to the second point. The first point is the origin if its name is `None`. Points
    /// have the names that channels use.
    Between(Option<String>, String),
}

/// An axis of a link's frame, or of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameAxis {
    /// The first.
    X,
    /// The second.
    Y,
}

/// One difference between two cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What is different.
    pub part: CasePart,
    /// How.
    pub how: PartChange,
}

/// A quantity or property of a case that can be wrong. Links, joints and groups are given by name.
#[derive(Clone, Debug, PartialEq)]
pub enum CasePart {
    /// Gravity.
    Gravity,
    /// Inertia forces and inertia moments of all links. The weights of the links stay unchanged.
    InertiaForces,
    /// Moments of inertia of all links.
    Inertias,
    /// Masses of all links.
    Masses,
    /// Moment of inertia of a link about its mass centre.
    Inertia(String),
    /// Mass of a link.
    Mass(String),
    /// Mass and moment of inertia of a link together.
    Body(String),
    /// Weight of a link. The inertia forces of the link stay unchanged.
    Weight(String),
    /// Inertia forces and inertia moment of a link. The weight of the link stays unchanged.
    Inert(String),
    /// Mass centre of a link.
    MassCentre(String),
    /// One coordinate of a link's mass centre.
    MassCentreAlong(String, FrameAxis),
    /// A load: its number in the file, from 1, and its kind.
    Load(usize, &'static str),
    /// Free length or free angle of a spring. The field is the load's number in the file, from 1.
    Free(usize),
    /// Configuration of a group of links.
    Configuration(String),
    /// Speed of the drive at a joint.
    Speed(String),
    /// Angle of the drive at a joint at t = 0.
    StartAngle(String),
    /// Speed at t = 0 of a driving link whose motion is free. The field is the name of the drive's joint.
    InitialSpeed(String),
    /// Ratio of a transmission.
    Ratio(String),
    /// Lift of a cam.
    Lift(String),
    /// Pressure angle of a transmission.
    PressureAngle(String),
    /// Coordinate of a transmission's joint at t = 0.
    Phase(String),
    /// Moment of the motor on the crank.
    MotorMoment,
    /// Moments of inertia of rotor and reducer.
    RotorInertia,
    /// Distance of two joints on a link. The fields are the names of the moved joint, of the other joint and of the
    /// link.
    Length(String, String, String),
    /// One coordinate of a joint's position on a link. The fields are the joint, the link and the axis of the link's
    /// frame.
    Place(String, String, FrameAxis),
    /// Direction of sliding of a prismatic joint in the frame of a link. The fields are the joint and the link.
    Axis(String, String),
}

/// How a property of a case ([`CasePart`]) differs from the right one.
#[derive(Clone, Debug, PartialEq)]
pub enum PartChange {
    /// The property is missing, as if it were zero.
    Missing,
    /// The property has the opposite sign.
    Reversed,
    /// The property counts twice.
    Twice,
    /// Only half of the property counts.
    Half,
    /// The property is multiplied by a number; the text says what the number means.
    Times(f64, &'static str),
    /// The mass centre is at a joint.
    AtJoint(String),
    /// The load acts at another point of the same link.
    AtPoint(String),
    /// The mass centre is measured from the wrong end: from the second joint towards the first joint, instead of from
    /// the first joint towards the second joint.
    FromJoint([String; 2]),
    /// The mass centre is on the other side of the line through two joints.
    Across([String; 2]),
    /// The mass centre is in the middle between two joints.
    Middle([String; 2]),
    /// The gravity vector is rotated by an angle (rad).
    Turned(f64),
    /// The moment of inertia is taken about a joint instead of the mass centre.
    AboutJoint(String),
    /// The components of the vector, or its axes, are exchanged.
    Swapped,
    /// The group has another assembly mode (by name) or another configuration (by number).
    Other(String),
    /// The quantity has another value.
    Instead {
        /// The value that explains the disagreement.
        found: f64,
        /// The value of the case.
        given: f64,
        /// Unit of both.
        unit: &'static str,
    },
}
