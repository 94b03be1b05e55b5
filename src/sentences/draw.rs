//! Sentences of drawings and graphs.

linkage::sentences! {
    // draw/media.rs
    EXPECTED_A_FILE_THAT_ENDS = "expected a file that ends in .svg, .pdf, .png, .dxf, .gif or .webp, or `-`";
    no_pictures_end_in_expected(other) = "unknown picture type .{other}; expected .svg, .pdf, .png, .dxf, .gif or .webp";
    AN_ANIMATION_SHOWS_ONE_POSITION = "an animation shows one position at a time";
    GROUPS_ARE_DRAWN_AT_ONE_INSTANT = "groups are drawn apart at one instant; such a picture has no paths and no loads";
    ALL_CONFIGURATIONS_HAVE_ONE_INSTANT = "all configurations are drawn as a whole; such a picture shows one instant and no separate groups";
    MAKE_TWO_PICTURES = "make two pictures";
    positions_are_requested(count) = "{count} positions are requested";
    give_positions_between(least, most) = "give a number from {least} to {most}";
    // draw/motion.rs
    THE_GRID_HAS_ONE_INSTANT = "the positions are spaced in time, but the grid has only one instant";
    GIVE_A_GRID_OVER_THE_MOTION = "give a grid that covers the motion";
    // draw.rs
    formula_and_class(formula, class) = "{formula}, class {class}";
    // draw/positions.rs
    positions_apart(count, apart, from) = "{count} positions, {apart} apart, from {from}";
    position_drawn_fully(number) = "position {number} drawn fully";
    position_number(number) = "position {number}";
    path_of_a_point(name, ratio) = "path of {name}, scale {ratio}";
    the_scale_is(ratio) = "scale {ratio}";
    wide_and_high(wide, high) = "{wide} mm wide, {high} mm high";
    // draw/subject.rs
    DOES_NOT_CLOSE = " (does not close)";
    AS_IN_THE_FILE = " (as in the file)";
    THE_ONLY_CONFIGURATION = "the only configuration";
    name_one_of(names) = "name one of {names}";
    no_point_that_moves_is_called(name) = "no moving point is called \"{name}\"";
    no_drive_could_be_read_drawn(draft, link) = "{draft}: no drive could be read; drawn with \"{link}\" as the driven link";
    and_more(more) = "and {more} more";
    only_the_first_configurations_are_drawn(most) = "only the first {most} configurations are drawn";
    driven_at_joint(headline, joint) = "{headline}, driven at {joint}";
    joint_stays_open_by_mm(name, significant) = "joint {name} stays open by {significant} mm";
    // graph.rs
    GIVE_A_NAME_FOR_EACH_CURVE = "give a name for each curve, in the order of the charts, or leave the names out";
    has_no_value_at_any_instant(curve) = "{curve} has no value at any instant";
    CHOOSE_A_CURVE_WITH_VALUES = "choose another curve: this one divides by zero, or takes the root of a negative number";
    y_labels_are_given_for_charts(labels, charts) = "{labels} labels of vertical axes are given, but the number of charts is {charts}";
    GIVE_A_LABEL_FOR_EACH_CHART = "give at most one label for each chart, in the order of the charts";
    names_are_given_for_curves(names, curves) = "{names} names are given, but {curves} curves are drawn";
    // graph/ask.rs
    is_a_chart_of_its_kind(word) = "the chart \"{word}\" cannot have further curves";
    ASK_FOR_IT_ALONE = "request this chart separately";
    A_PATTERN_SUCH_AS_JOINT_F_N = "a pattern is a channel name with a star in place of a part, such as joint.*.f_N or link.*.omega_rad_s";
    no_channel_fits(pattern) = "no channel fits the pattern {pattern}";
    is_one_number_and_no_curve(name) = "{name} is one number for the whole mechanism, not a curve";
    NAME_CHANNELS_THAT_CHANGE = "name channels, which change during the motion";
    there_is_no_vector(name) = "there is no vector {name}";
    // graph/curve.rs
    the_horizontal_axes_differ(one, unit, other, other_unit) = "the horizontal axes differ: {one}, {unit} and {other}, {other_unit}";
    DRAW_OVER_TIME_OR_EACH_ALONE = "draw over the time, or draw each scenario alone";
    // graph/curves.rs
    minus(one, other) = "{one} minus {other}";
    formula(name) = "formula {name}";
    MECHANISM = "mechanism";
    A_DIFFERENCE_HAS_NO_HODOGRAPH = "a difference has no hodograph";
    DRAW_BOTH_OR_THE_COMPONENTS = "draw both parties, or the difference of the components";
    // graph/under_motor.rs
    has_no_motor(name) = "{name} has no motor, so there is no run-up";
    ADD_A_MOTOR_TO_THE_DRIVE = "add a motor to the drive of the scenario";
    there_is_no_averaged_curve(name) = "{name}: no averaged curve, because the motor's law is not a straight line, or the motor cannot start against the mean resistance";
    EXACT_MODEL = "equation of motion";
    AVERAGED_MODEL = "averaged, closed form";
    ANGULAR_VELOCITY_OF_THE_CRANK_2 = "angular velocity of the crank";
    ANGULAR_VELOCITY_OF_THE_MOTOR = "angular velocity of the motor";
    has_no_balancing_moment_of_one_drive(name) = "{name} does not have exactly one drive with a balancing moment";
    TAKE_A_SCENARIO_WITH_ONE_DRIVE_2 = "draw it for a scenario with one driven crank or slide";
    RELATIVE_DIFFERENCE_OF_THE_BALANCING_MOMENT = "relative difference of the balancing moment";
}
