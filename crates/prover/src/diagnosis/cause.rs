//! The simple causes that a diagnosis can name. Their wording is in the room of reports.

use linkage::trajectory::{Channel, Stage};

/// What explains a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub enum DisagreementCause {
    /// The values of some channels are another function of the right values.
    Values {
        /// What was done to them.
        slip: DataSlip,
        /// The disagreeing channels that it explains.
        channels: Vec<Channel>,
    },
    /// The suspect's case is another one.
    Case(Change),
}

/// The slips without a number, and the list of them: one that is added is tried.
macro_rules! plain {
    ($($(#[$doc:meta])+ $name:ident,)+) => {
        /// What was done to right values without a number, the simplest first.
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
    /// Whole turns added on the way.
    Turns,
    /// Half turns added on the way: an arc tangent of a quotient.
    HalfTurns,
    /// Twice the values.
    Twice,
    /// Half the values.
    Half,
    /// Zero instead of the values.
    Zero,
    /// The sizes of the values, without their sign; of an angle that of its wrapped value, as an arc cosine gives it.
    Size,
    /// The angle whose sine is right, within a quarter turn.
    ArcSine,
    /// Rates per radian of the crank instead of per second: divided by its speed, accelerations by its square.
    PerRadian,
}

/// What was done to right values.
#[derive(Clone, Debug, PartialEq)]
pub enum DataSlip {
    /// What needs no number.
    Plain(Plain),
    /// Another unit.
    Unit {
        /// The factor on values in the channel's unit.
        factor: f64,
        /// Which unit instead of which.
        told: &'static str,
    },
    /// The same amount added at every instant, in the channel's unit.
    Offset(f64),
    /// The opposite sign, and the same amount added at every instant: counted the other way round, from another axis.
    Mirrored(f64),
    /// The values of another channel.
    Instead(Channel),
    /// The values of another channel with the opposite sign.
    Opposite(Channel),
    /// The magnitude of the vector instead of one of its components, which are these.
    Magnitude([Channel; 2]),
    /// Differences of the values of another channel over some rows on either side instead of its first or second rate.
    Differences {
        /// The channel whose rate it should be.
        of: Channel,
        /// Which rate: 1 or 2.
        order: usize,
        /// Which rows the differences are taken over.
        over: Over,
    },
    /// The acceleration without the Coriolis term of a block on a moving guide, by joint.
    NoCoriolis(String),
    /// The moment about another point: the arm of the force is longer by this.
    About(Arm),
    /// One row alone is off, at this time (s).
    Outlier(f64),
    /// Values of other instants: the time of a row times a factor.
    Clock {
        /// The factor on the time at which the right values are those found.
        factor: f64,
        /// What is meant, where it is a unit.
        told: Option<&'static str>,
    },
    /// Two channels with the values of each other.
    Exchanged([Channel; 2]),
    /// The first less the second of two other channels, and the same amount added at every instant.
    Between {
        /// The two.
        of: [Channel; 2],
        /// The amount, in the channel's unit.
        offset: f64,
    },
    /// Multiplied by the same number at every instant.
    Factor(f64),
    /// Values of another instant.
    Late {
        /// How much later than its own instant a value appears (s); negative for values that come early.
        by: f64,
        /// The same in steps or rows of the suspect, where it is a plain part or multiple of one, and the word for them.
        steps: Option<(f64, &'static str)>,
        /// The stage whose channels are late; `None` if all are.
        stage: Option<Stage>,
    },
}

/// Rows that differences are taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Over {
    /// As many rows before as behind.
    Either(usize),
    /// The row and the one before.
    Before,
    /// The row and the one behind.
    Behind,
}

/// From the point about which a moment should be to the one about which it is.
#[derive(Clone, Debug, PartialEq)]
pub enum Arm {
    /// A constant vector (m), in world axes.
    Constant([f64; 2]),
    /// From the first of two places to the second; from the origin without a first. By name, as channels have them.
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

/// A part of a case. Links, joints and groups have their names.
#[derive(Clone, Debug, PartialEq)]
pub enum CasePart {
    /// Gravity.
    Gravity,
    /// Masses and moments of inertia of all links as far as they resist acceleration; weights stay.
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
    /// Weight of a link; it resists acceleration all the same.
    Weight(String),
    /// Mass and moment of inertia of a link as far as they resist acceleration; its weight stays.
    Inert(String),
    /// Mass centre of a link.
    MassCentre(String),
    /// One coordinate of a link's mass centre.
    MassCentreAlong(String, FrameAxis),
    /// A load: its number in the file, from 1, and its sort.
    Load(usize, &'static str),
    /// Length of a spring without force, or its twist without moment: the load's number in the file, from 1.
    Free(usize),
    /// Configuration of a group of links.
    Configuration(String),
    /// Speed of the drive at a joint.
    Speed(String),
    /// Angle of the drive at a joint at t = 0.
    StartAngle(String),
    /// Speed of a free driving link at t = 0, by joint.
    InitialSpeed(String),
    /// Moment of the motor on the crank.
    MotorMoment,
    /// Moments of inertia of rotor and reducer.
    RotorInertia,
    /// Distance of two joints on a link: the joint that is moved, the other one, the link.
    Length(String, String, String),
    /// One coordinate of a joint's place on a link: joint, link, axis of the link's frame.
    Place(String, String, FrameAxis),
}

/// How a part of a case is different.
#[derive(Clone, Debug, PartialEq)]
pub enum PartChange {
    /// It is missing.
    Missing,
    /// It has the opposite sign.
    Reversed,
    /// It counts twice.
    Twice,
    /// Half of it counts.
    Half,
    /// It is multiplied by a number with a meaning, which the text says.
    Times(f64, &'static str),
    /// It is at a joint.
    AtJoint(String),
    /// It is at another point of the same link.
    AtPoint(String),
    /// It is measured from the second of two joints, towards the first, instead of the other way round.
    FromJoint([String; 2]),
    /// It is on the other side of the line through two joints.
    Across([String; 2]),
    /// It is in the middle between two joints.
    Middle([String; 2]),
    /// It is turned by an angle (rad).
    Turned(f64),
    /// It is taken about a joint instead of the mass centre.
    AboutJoint(String),
    /// Its components, or axes, are exchanged.
    Swapped,
    /// It is the other one: name of an assembly mode, or number of a configuration.
    Other(String),
    /// It has another value.
    Instead {
        /// The value that explains the disagreement.
        found: f64,
        /// The value of the case.
        given: f64,
        /// Unit of both.
        unit: &'static str,
    },
}
