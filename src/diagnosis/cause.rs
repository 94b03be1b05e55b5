//! The simple causes that a diagnosis can name. Their wording is in the room of reports.

use linkage::drive::LoadSort;
use linkage::trajectory::{Channel, Stage};

/// What explains a disagreement.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// The values of some channels are another function of the right values.
    Values {
        /// What was done to them.
        slip: Slip,
        /// The disagreeing channels that it explains.
        channels: Vec<Channel>,
    },
    /// The suspect's case is another one.
    Case(Change),
}

/// What was done to right values.
#[derive(Clone, Debug, PartialEq)]
pub enum Slip {
    /// The opposite sign.
    Sign,
    /// Whole turns added on the way.
    Turns,
    /// Twice the values.
    Twice,
    /// Half the values.
    Half,
    /// Zero instead of the values.
    Zero,
    /// Another unit.
    Unit {
        /// The factor on values in the channel's unit.
        factor: f64,
        /// Which unit instead of which.
        told: &'static str,
    },
    /// Rates per radian of the crank instead of per second: divided by its speed, accelerations by its square.
    PerRadian,
    /// The same amount added at every instant, in the channel's unit.
    Offset(f64),
    /// The opposite sign, and the same amount added at every instant: counted the other way round, from another axis.
    Mirrored(f64),
    /// The values of another channel.
    Instead(Channel),
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
        /// The same in steps of the suspect, where it is a plain part or multiple of one.
        steps: Option<f64>,
        /// The stage whose channels are late; `None` if all are.
        stage: Option<Stage>,
    },
}

/// An axis of a link's frame, or of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
}

/// One difference between two cases.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What is different.
    pub part: Part,
    /// How.
    pub how: How,
}

/// A part of a case. Links, joints and groups have their names.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
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
    /// Mass centre of a link.
    MassCentre(String),
    /// One coordinate of a link's mass centre.
    MassCentreAlong(String, Axis),
    /// A load: its number in the file, from 1, and its sort.
    Load(usize, LoadSort),
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
    /// One coordinate of a joint's place on a link: joint, link, axis of the link's frame.
    Place(String, String, Axis),
}

/// How a part of a case is different.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
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
