//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // lib.rs
    GIVE_A_START_POSE_IN_WHICH_ALL = "give a start pose in which all joints are closed";
    the_pose_at_is_open_by_most(at, closure, name) = "the pose at t = 0, {at}, is open by {closure} m, most at joint \"{name}\"";
    A_LOOP_IS_OPEN_BY_MORE_THAN_ITS_TOLERANCE = "a loop is open by more than its tolerance";
    MOBILIZER_REACTIONS_AND_MULTIPLIERS = "mobilizer reactions and multipliers";
    of_the_mechanism_reach(value) = "{value} of the mechanism's reach";
    RUNGE_KUTTA_MERSON_EVERY_STEP = "Runge-Kutta-Merson, every step projected";
    PRESCRIBED_COORDINATES_UNDER_FORCES_MOTOR = "prescribed coordinates; under forces, motor and loads at every evaluation";
    SPANNING_TREE_OF_PINS_AND_SLIDERS = "spanning tree of pins and sliders, loops closed by two point-in-plane constraints each";
    a_drive_with_the_law_is_not_handed(drive) = "a drive with the law \"{drive}\" is not supported with Simbody in this version";
    FRICTION_IS_NOT_HANDED = "friction and losses of transmissions are not supported with Simbody in this version";
    a_transmission_is_not_handed(name) = "transmission \"{name}\": transmissions are not supported with Simbody in this version";
    GIVE_AN_ACCURACY_BETWEEN_AND_FOR_ONE = "give an accuracy between 0 and 1, such as 1e-8";
    the_engine_accuracy_is(accuracy) = "the engine's accuracy is {accuracy}";
    // model.rs
    SHORTEN_THE_GRID_TO_THE_CRANK = "shorten the grid to the inputs before the dead point";
    CHECK_THAT_THE_POSE_CAN_BE_ASSEMBLED = "check that the mechanism can be assembled at this input";
    simbody_stopped_at(t, at, gap, message) = "Simbody stopped at t = {t:.6} s, {at}{gap}: {message}";
    joint_open_by(case, gap) = ", joint \"{case}\" open by {gap} m";
    simbody_cannot_take_the_mechanism(message) = "Simbody cannot represent the mechanism: {message}";
}
