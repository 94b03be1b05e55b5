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
    // ffi.rs
    SIMBODY_ANSWERED_WITH_A_NUMBER = "Simbody returned a number that is not finite";
    A_LOAD_IS_NOT_FINITE = "a load is not finite";
    loads_are_given_for_bodies(loads, state) = "{loads} loads are given for {state} bodies";
    is_asked_for_after(time, time_2) = "t = {time} s is requested after t = {time_2} s";
    SIMBODY_GAVE_NO_SYSTEM = "Simbody returned no model";
    SIMTK_EXCEPTION_THROWN_AT = "SimTK Exception thrown at ";
    // model.rs
    THERE_IS_NO_BODY = "no body is given";
    GRAVITY_IS_NOT_FINITE = "gravity is not finite";
    the_is_it_must_be_greater(what, value) = "the {what} is {value}, but must be greater than 0";
    the_accuracy_is_it_must_lie(accuracy) = "the accuracy is {accuracy}, but must lie between 0 and 1";
    IT_HOLDS_A_NUMBER_THAT_IS_NOT_FINITE = "the body or loop contains a number that is not finite";
    bodies_and_cannot_be_joined(first, second) = "bodies {first} and {second} cannot be joined";
    THE_AXIS_OF_ITS_SLIDER_IS_NO_UNIT = "the axis of the body's slider is not a unit vector";
    A_MASS_OR_A_MOMENT_OF_INERTIA = "a mass or a moment of inertia is negative";
    its_parent_is_which_has_not_been(parent) = "the parent of the body is {parent}, which has not been added";
}
