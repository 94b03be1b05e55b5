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
    // domain.rs
    ATAN2_TAKES_TWO_NUMBERS_OF_WHICH_ONE_IS_NOT_ZERO = "atan2 takes two numbers that are not both zero";
    ASIN_AND_ACOS_TAKE_A_NUMBER = "asin and acos take a number from -1 to 1";
    SQRT_TAKES_ZERO_OR_A_POSITIVE = "sqrt takes zero or a positive number";
    LN_TAKES_A_POSITIVE_NUMBER = "ln takes a positive number";
    A_NEGATIVE_BASE_TAKES_A_WHOLE = "a negative base needs a whole exponent, and a base of zero needs an exponent that is not negative";
    A_DIVISOR_MUST_NOT_BE_ZERO = "a divisor must not be zero";
    ITS_PARTS_MUST_HAVE_VALUES = "every operand and argument of the operation must have a value";
    is_undefined(what) = "{what} is undefined";
    WHAT_IT_STANDS_FOR_HAS_NO_VALUE = "the definition of this name has no value";
    // graph.rs
    there_is_no(name) = "there is no `{name}`";
    known_are(names) = "known names: {names}";
    // parse.rs
    WRITE_ATAN2_WITH_THE_SINE = "write atan2(y, x): first y, then x";
    needs_arguments(function, function_2) = "{function} needs {function_2} arguments";
    CLOSE_IT_BEHIND_THE_NAME = "close the backquote after the name: `body 2.x`";
    THIS_BACKQUOTE_OPENS_NO_NAME = "this backquote does not enclose a name";
    there_is_no_function(name) = "there is no function `{name}`";
    the_functions_are_write_a_product(known) = "the functions are {known}; write a product with `*`";
    WRITE_A_POWER_WITH = "write a power with `^`";
    WRITE_IT_BY_SIN_COS_AND_TAN = "write it with sin, cos and tan";
    WRITE_LN_FOR_THE_NATURAL = "write ln for the natural logarithm, and ln(x)/ln(10) for the logarithm to base 10";
    write_it_with_parentheses_phi(function) = "write it with parentheses: {function}(phi)";
    the_function_has_no_argument(function) = "the function `{function}` is written without its argument";
    WRITE_A_NUMBER_SUCH_AS = "write a number such as 1.5e-3";
    is_no_finite_number(written) = "`{written}` is not a finite number";
    THIS_IS_NOT_CLOSED = "this `(` is not closed";
    ADD_A_NUMBER_A_NAME_OR_A_CALL = "add a number, a name or a call";
    a_part_is_missing_before(sign) = "an operand or argument is missing before `{sign}`";
    THE_FORMULA_ENDS_WHERE_A_PART = "the formula is incomplete at its end";
    A_PART_IS_MISSING_BEFORE_THIS_OPERATOR = "an operand is missing before this operator";
    has_no_meaning_in_a_formula(sign) = "`{sign}` has no meaning in a formula";
    NUMBERS_NAMES_AND_FUNCTIONS_MAKE = "numbers, names, + - * / ^ ( ) and functions make up a formula";
    USE_PARENTHESES = "use parentheses: ( )";
    WRITE_A_SQUARE_ROOT_AS_SQRT = "write a square root as sqrt(x)";
    WRITE_THE_CRANK_ANGLE_AS_PHI = "write the crank angle as phi";
    WRITE_A_MINUS_AS = "write a minus as `-`";
    WRITE_A_POWER_WITH_SUCH_AS = "write a power with `^`, such as x^2";
    WRITE_A_QUOTIENT_WITH = "write a quotient with `/`";
    WRITE_A_PRODUCT_WITH = "write a product with `*`";
    WRITE_A_PRODUCT_WITH_SUCH_AS_PHI = "write a product with `*`, such as 2*phi";
    an_operator_is_missing_before(sign) = "an operator is missing before `{sign}`";
    A_COMMA_STANDS_BETWEEN_ARGUMENTS = "a comma is allowed only between the arguments of atan2";
    WRITE_NUMBERS_WITH_A_DECIMAL = "write numbers with a decimal point, such as 0.5";
    WRITE_THE_RIGHT_SIDE_ONLY = "write only the right side of the equation";
    A_FORMULA_HAS_NO = "a formula has no `=`";
    TAKE_IT_OUT_OR_OPEN_IT = "remove this `)`, or add `(`";
    THERE_IS_NO_BEFORE_THIS = "there is no `(` before this `)`";
    DIVIDE_IT_A_FORMULA_MAY_USE = "divide the formula: a formula can use earlier formulas by name";
    the_formula_is_nested_deeper(deepest) = "the formula is nested deeper than {deepest}";
    the_formula_has_bytes_more(text, longest) = "the formula has {text} bytes, more than {longest}";
    WRITE_AN_EXPRESSION_SUCH_AS_A_COS = "write an expression such as a*cos(phi) + b";
    THIS_IS_NO_FORMULA = "this is not a formula";
}
