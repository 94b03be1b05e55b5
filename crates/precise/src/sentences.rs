//! All messages of this crate.

linkage::sentences! {
    // dyads.rs
    NO_CLOSED_FORM_IN_FULL_PRECISION = "no closed form in double-double: a group is not a dyad of revolute joints";
    A_DYAD_CANNOT_BE_ASSEMBLED = "a dyad cannot be assembled";
    // law.rs
    A_MOTION_IS_FREE = "the motion is free";
    // lib.rs
    ALL_EQUATIONS_IN_DOUBLE_DOUBLE = "all equations in double-double";
    CLOSED_FORM_IN_DOUBLE_DOUBLE = "closed form in double-double";
    // numbers.rs
    THERE_IS_FRICTION = "there is friction";
    // task.rs
    no_precise_numbers(what) = "no precise reference: {what}";
    AN_INSTANT_LIES_BEFORE = "an instant lies before t = 0";
    THERE_ARE_TRANSMISSIONS = "there are transmissions";
    THERE_ARE_LOADS = "there are loads";
    CHANGE_POINTS_MAY_BE_PASSED = "change points may be passed";
    THERE_ARE_SEVERAL_DRIVES = "there are several drives";
    ONLY_A_CRANK_AT_CONSTANT = "only a crank at constant speed is supported";
    // whole.rs
    THE_POSE_IS_SINGULAR = "the pose is singular";
}
