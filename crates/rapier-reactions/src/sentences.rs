//! All messages that this crate can show, in one file, so that they can be read as a list.

// Declares the messages that a crate can show.
// `NAME = "text";` declares a constant.
// `name(a, b) = "text with {a} and {b}";` declares a function from values to a `String`.
// Each crate has all its messages in one file, so that they can be read as a list.
macro_rules! sentences {
    (@one $name:ident = $text:literal) => { pub(crate) const $name: &str = $text; };
    (@one $name:ident($($value:ident),+) = $text:literal) => {
        #[allow(clippy::too_many_arguments, reason = "a sentence has as many values as it needs")]
        pub(crate) fn $name($($value: &dyn std::fmt::Display),+) -> String { format!($text) }
    };
    ($($name:ident $(($($value:ident),+))? = $text:literal;)*) => {
        $(sentences! { @one $name $(($($value),+))? = $text })*
    };
}

sentences! {
    // engine/snapshot.rs
    impulse_joint(index) = "impulse joint {index}";
    multibody_joint(index) = "multibody joint {index}";
    rigid_body(index) = "rigid body {index}";
    LIMITS = "limits; remove the limits of joints that do not reach them";
    COUPLED_AXES = "coupled axes, as rope and spring joints have";
    A_PIN_IN_A_SLOT = "a pin in a slot";
    OTHER_LOCKED_AXES = "locked axes of no revolute, prismatic or fixed joint";
    COUPLED_COORDINATES = "coordinates that are coupled with the coordinates of another joint";
    LOCKED_MOTIONS = "locked translations or rotations; use a joint to a fixed body instead";
    NO_MASS = "no mass or no moment of inertia; step the world once, or give the body both";
    // engine/impulses.rs
    IT_SLEEPS = "no present impulse, because its bodies sleep; keep the bodies awake";
    ROWS_IN_UNKNOWN_ORDER = "an unknown order of rows, because the world has 64 impulse joints or more; use second differences";
    // error.rs
    is_not_supported(name, property) = "{name} has {property}";
    three_poses_are_needed(count) = "three poses are needed, but {count} were given; push a pose after every step";
    BODIES_OR_JOINTS_HAVE_CHANGED = "bodies or joints have changed during the step; read the reactions of the next step";
    the_forces_are_not_determined(names) = "the motion does not determine the forces in: {names}; remove a joint that repeats another joint, or leave the dead point";
    the_sweeps_have_not_converged(sweeps, change) = "forces still change by {change} of the largest force with {sweeps} sweeps; allow more sweeps, or use second differences";
    the_step_must_be_positive(step) = "the time step is {step} s, but must be greater than 0";
    A_NUMBER_IS_NOT_FINITE = "a pose, a load or a force is not finite; the simulation has diverged";
}
