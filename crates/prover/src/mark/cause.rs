//! The causes of wrong answers, as data. Reports put these causes into words.

/// A cell of a sheet: number of the position and of the quantity, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellPlace {
    /// Number of the position.
    pub row: usize,
    /// Number of the quantity.
    pub column: usize,
}

/// A term of the velocity or acceleration of a point P. Q is another point of the same link: v_P = v_Q + v_PQ and a_P =
/// a_Q + a_PQ^n + a_PQ^t.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PartOfPoint {
    /// The velocity or acceleration of the point Q.
    Carried,
    /// The normal (centripetal) part of the relative acceleration.
    Normal,
    /// The tangential part of the relative acceleration.
    Tangential,
}

/// Mistake that turns right answers into the student's number.
#[derive(Clone, Debug, PartialEq)]
pub enum MarkCause {
    /// The opposite sign.
    Sign,
    /// The number is right in another unit. The fields are the symbols of both units.
    Unit {
        /// Unit of the student's number.
        written: &'static str,
        /// Unit that the sheet asks for.
        asked: &'static str,
    },
    /// The decimal point is at the wrong position. The number is too large by a power of ten, whose exponent is the
    /// field.
    DecimalPoint(i32),
    /// Twice the value.
    Twice,
    /// Half the value.
    Half,
    /// Zero instead of the value.
    Zero,
    /// The derivative with respect to the crank angle instead of the derivative with respect to time.
    PerRadian,
    /// The supplement: 180 deg minus the correct angle.
    Supplement,
    /// The correct angle plus 180 deg: the direction of the link is taken from the wrong end.
    OtherEnd,
    /// The complement: 90 deg minus the correct angle. The student may have exchanged cosine and sine.
    Complement,
    /// The correct angle plus or minus 90 deg: the angle is measured from the vertical.
    FromVertical,
    /// The angle relative to another link. The field is the name of that link.
    RelativeAngle(String),
    /// Two cells exchanged: each has the right value of the other cell.
    Exchanged(CellPlace),
    /// The right value of another cell.
    OfCell(CellPlace),
    /// The right value of another cell, with the opposite sign.
    OppositeOfCell(CellPlace),
    /// Two neighbouring digits exchanged.
    DigitsSwapped,
    /// One digit is wrong.
    OneDigit,
    /// One digit is left out, or one digit is added.
    DigitLost,
    /// A term of a point's velocity or acceleration is missing. The fields are the term, the point P and the point Q.
    WithoutPart(PartOfPoint, String, String),
    /// The angular velocity is computed from the whole velocity of a point, instead of the point's velocity relative to
    /// another point of the link. The field is the name of the point.
    FromWholeSpeed(String),
    /// Accelerations without the normal (centripetal) part of one link. The field is the name of the link.
    NoNormal(String),
    /// Accelerations without the normal parts of all links.
    NoNormals,
    /// Accelerations without the Coriolis part in one sliding joint. The field is the name of the joint.
    NoCoriolis(String),
    /// A group, or several groups, in another configuration.
    Configuration {
        /// Names of the links of the groups.
        group: String,
        /// The student's configurations: name of the mode, or number of the configuration.
        mode: String,
    },
    /// The crank turns in the opposite direction.
    Reversed,
    /// The crank's speed is taken in the wrong unit. The fields are the unit that the student took and the right unit.
    SpeedUnit(&'static str, &'static str),
    /// The crank angle is measured in the opposite direction.
    Clockwise,
    /// The crank angle is too large. The field is the excess in degrees.
    CrankTurned(i32),
    /// Gravity is missing.
    NoGravity,
    /// Gravity acts upwards.
    GravityUp,
    /// The inertia forces and moments are missing.
    NoInertiaForces,
    /// A load is missing. The field is the number of the load in the file, from 1.
    NoLoad(usize),
    /// The distance of a point is measured from the wrong end of its link. The fields are the names of the link and of
    /// the point.
    FromOtherEnd(String, String),
    /// The right answers of another student. The field is the name of that student's sheet.
    OfStudent(String),
}
