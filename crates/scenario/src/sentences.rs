//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // engine.rs
    THE_STEP_IS_AN_ANGLE_BUT = "the step is given as a rotation of the crank, but the input of the first drive is a slide";
    GIVE_THE_TIME_STEP_OF_THE_ENGINE = "give the time step: `dt_s` or `dt_ms`";
    // lib.rs
    a_table_of_a_load_is_over(sort, over, noun) = "a load of type {sort} is a table over {over}, but the input of the first drive is a {noun}";
    GIVE_THE_LOAD_A_CONSTANT = "give the rows of the table in the unit of the drive: `crank_deg` for an angle, `crank_mm` for a slide";
    THE_START_OF_TRANSMISSIONS_IS_THAT_OF_THE_FILE = "the starts of the transmissions are valid only if the first drive has the start of the file";
    CHANGE_THE_STARTS_IN_THE_FILE = "change the starts of the drive and of the transmissions in the file, or keep them and request a grid that begins at the desired input";
    // motion.rs
    a_motor_needs_a_crank(noun) = "the motor drives a crank, but the input of the first drive is a {noun}";
    TAKE_MOTOR_OUT_OR_DRIVE = "remove `[motor]`, or drive the mechanism at a crank";
    // grid.rs
    the_grid_has_units_of_but_the_input_is(family, noun) = "the grid is given by {family}, but the input of the first drive is a {noun}";
    give_the_grid_in(unit) = "give the grid in {unit} (`from_{unit}`, `to_{unit}`, `step_{unit}`) or by time (`from_s`, `to_s`, `step_s`)";
    // stated.rs
    the_first_drive_has_the_input(noun) = "the first drive moves no crank: its input is a {noun}";
    GIVE_ITS_START_IN_DRIVE = "give the start of the first drive in `[drive]`, for example `start_mm = 300` or `start_deg = 30`";
    // accepted.rs
    DELETE_ONE_OF_THE_TWO = "delete one of the two entries";
    the_channel_stands_twice(pair) = "the channel {pair} is given twice";
    values_are_kept_for_instants(at, count) = "`at` has {at} values, but there are {count} instants";
    GIVE_ONE_VALUE_FOR_EACH_OF_TIMES = "give one value for each of `times_s`, or accept the figures again";
    ACCEPT_THE_FIGURES_ANEW = "accept the figures again";
    the_bound_is_negative(bound) = "the bound {bound} is negative";
    GIVE_THEIR_NUMBER = "give the number of instants";
    found_instants(instants) = "found {instants} instants";
    WRITE_AGREE_DISAGREE_OR_INCONCLUSIVE = "write agree, disagree or inconclusive";
    is_no_verdict(verdict) = "\"{verdict}\" is not a verdict";
    MOVE_THE_FILE_TO_ITS_OWN = "move the file to its own scenario; if the scenario was renamed, change the name here too";
    these_are_accepted_figures_of_not_of(scenario, name) = "these are accepted figures of \"{scenario}\", not of \"{name}\"";
    RESTORE_THE_FILE_OR_DELETE = "restore the file, or delete it and accept the figures again";
    THE_FILE_HOLDS_NO_ACCEPTED = "the file contains no accepted figures";
    the_accepted_figures_cannot_be_read(path, error) = "the accepted figures {path} cannot be read: {error}";
    // asked.rs
    an_input_nearer_to_the_file(noun) = "a {noun} nearer to the start in the file, or the number of a configuration";
    the_configuration_of_the_group(names, at, to, unit) = "the configuration of the group ({names}) at the start, {at}, cannot be followed to {to:.4} {unit}";
    // case_figure.rs
    A_FIGURE_IS =
        "a figure is a statistic and a quantity, such as `maxabs:drive.torque_N_m`, the input at an extreme, such as \
         `at_max:joint.A.f_N`, or transmission_angle_deg, reach_from, reach_to, verdict:FORMULA";
    no_figure(text) = "`{text}` is not a figure";
    no_formula_claims(name) = "the file has no formula `{name}` that claims a channel";
    is_one_number_already(quantity) = "`{quantity}` is one number for the whole motion, so it has no statistic";
    NO_FIGURE_IS_REPORTED = "the list of figures is empty";
    A_REPORTED_FIGURE_IS =
        "name figures such as `maxabs:drive.torque_N_m`, `at_max:joint.A.f_N` or transmission_angle_deg, or leave the \
         section out";
    is_no_figure_of_a_report(text) = "`{text}` does not follow from the solution at the instants of the grid";
    the_figure_needs_the_channel(text, channel) = "`{text}` needs the channel {channel}, which `[channels]` does not request";
    ASK_FOR_THE_CHANNEL = "add the channel to `want`, or leave the figure out";
    // claim.rs
    there_is_no_channel_here(name) = "there is no channel {name} here";
    NAME_ONE_OF_THIS_SCENARIO = "name a channel of this scenario, such as link.rocker.angle_deg or point.B.x_mm";
    did_you_mean(near) = "did you mean `{near}`?";
    THE_CLAIM_NAMES_NO_CHANNEL = "the claim names no channel";
    NAME_A_CHANNEL_SUCH_AS_LINK = "name a channel, such as link.rocker.angle_deg";
    // clearance.rs
    there_is_no_link_and_no_part(name) = "there is no link or part of the housing \"{name}\"";
    found_names_but_a_pair_has_two(names) = "found {names} names, but a pair has two";
    GIVE_FINITE_NUMBERS = "give finite numbers";
    A_COORDINATE_OR_THE_RADIUS = "a coordinate or the radius is not a number";
    WRITE_A_LINE_OR_GIVE_CORNERS = "write a `line`, or give corners around an area";
    ALL_CORNERS_LIE_ON_ONE_LINE = "all corners lie on one line";
    GIVE_THE_CORNERS_IN_THEIR = "give the corners in their order around the outline";
    the_sides_that_begin_at_corners(a, b) = "the sides that begin at corners {a} and {b} touch or cross";
    GIVE_EVERY_CORNER_ONCE_THE_LAST = "give every corner once; the last side closes automatically";
    corners_and_are_in_one_place(a, b) = "corners {a} and {b} coincide";
    LEAVE_OUT_CORNERS_THAT_CHANGE = "leave out corners that change the outline by less than its clearance";
    found_corners_but_at_most(count, most_corners) = "found {count} corners, but at most {most_corners} are handled";
    ADD_CORNERS_OR_WRITE_A_LINE = "add corners, or write a `line`";
    found_corners_but_a_polygon(count) = "found {count} corners, but a polygon has three or more";
    ONE_PLACE_IS_A_DISC_TWO_ARE_A_CAPSULE = "one point gives a disc, two give a capsule";
    A_LINE_NEEDS_A_PLACE_OR_MORE = "a line needs at least one point";
    KEEP_ONE_OF_THE_TWO = "keep one of the two entries";
    CORNERS_AND_LINE_ARE_BOTH = "`corners` and `line` are both given";
    THIS_PART_OF_THE_HOUSING = "this part of the housing has no outline";
    ADD_CORNERS_OF_A_SOLID_PART = "add `corners` of a solid part, or the points of a wall as `line`";
    GIVE_EVERY_PART_A_NAME_OF_ITS_OWN = "give every part a unique name; \"housing\" means all parts";
    is_taken(name) = "\"{name}\" is taken";
    A_PART_OF_THE_HOUSING = "a part of the housing";
    ADD_RADIUS_MM_OR_GIVE_CORNERS = "add `radius_mm`, or give `corners`";
    THE_OUTLINE_HAS_NO_RADIUS = "the outline has no radius";
    give_all_links_capsules_with_radius(name) = "give all links capsules with `radius_mm` in `[clearance]`, or give this link an outline in `[clearance.outlines.{name}]`";
    link_has_no_outline(name) = "link \"{name}\" has no outline";
    there_is_no_link(name) = "there is no link \"{name}\"";
    THE_GROUND_HAS_NO_OUTLINE = "the ground has no separate outline";
    give_a_number_from_to_such_as(smallest_area) = "give a number from {smallest_area} to below 1, such as 1e-3";
    found_but_this_is_the_share(share) = "found {share}, but this is the allowed error of a swept area as a fraction of the area";
    CHECK_THE_UNITS_OF_ITS_CORNERS = "check the units of the outline's corners and radius";
    the_outline_of_extends_to_the_mechanism(far, far_2, size) = "the outline of \"{far}\" extends to {far_2} m, but the mechanism only to {size} m";
    LEAVE_OUT_PARTS_THAT_NO_LINK = "leave out parts that no link comes near";
    found_parts_of_the_housing(housing, most_parts) = "found {housing} parts of the housing, but at most {most_parts} are handled";
    GIVE_A_LARGER_TOLERANCE_OR_LEAVE = "give a larger tolerance, or leave out the tolerance";
    distances_are_found_to_and_no_better(size, finest) = "distances cannot be found more accurately than {size} m, {finest} of the mechanism's size";
    // edit.rs
    no_plain_number(path) = "`{path}` is not a plain number, so it cannot be changed here";
    no_point(point, link) = "the file has no coordinates x and y of the point \"{point}\" of \"{link}\"";
    not_one_parameter(place) = "`{place}` is an expression, not one parameter: change its parameters";
    WRITE_IT_AS_ENGINE = "write the section as `[engine]`";
    ENGINE_IS_NOT_A_SECTION = "`engine` is not a section";
    the_file_is_not_valid_toml(error) = "the file is not valid TOML: {error}";
    // engine.rs
    give_a_whole_number_from_to_or_true(most) = "give a whole number from 0 to {most}, or true for 1";
    found_extrapolations(number) = "found {number} extrapolations";
    GIVE_A_WHOLE_NUMBER_GREATER = "give a whole number greater than zero";
    found_but_an_engine_needs(number) = "found {number}, but an engine needs at least one";
    CHECK_THE_STEP_AND_DRIVE = "check the step and `drive.speed`";
    the_engine_step_would_be(dt) = "the engine's step would be {dt} s";
    THE_ENGINE_STEP_IS_GIVEN = "the engine's step is given twice";
    KEEP_EITHER_DT_A_TIME_OR_STEP = "keep either `dt` (a time) or `step` (a crank angle)";
    IS_NO_ROUTE_TO_REACTIONS = "is not a route (method) to the reactions";
    IS_NO_ENGINE = "is not an engine";
    COMBINE_RUNS_AT_THE_STEP = "Combine runs at the step and at repeatedly halved steps, so that the leading errors cancel: once if no number is given [default: as in the scenario; otherwise `run` chooses it unless the step is given, and other commands do not extrapolate]";
    ROUTE_BY_WHICH_REACTIONS_AND_BALANCING = "Method by which reactions and balancing moment are computed";
    NUMBER_OF_SUBSTEPS_INTO_WHICH_THE_ENGINE = "Number of substeps into which the engine divides a step";
    SWEEPS_OF_THE_ENGINE_ITERATION = "Sweeps of the engine's iteration in a step [default: as in the scenario; otherwise `run` chooses it, and other commands use the engine's default]";
    RELATIVE_ACCURACY_OF_AN_ENGINE = "Relative accuracy of an engine that chooses its own steps [default: the accuracy of the engine; simbody: 1e-8]";
    ENGINE_OR_ALL_TO_RUN_EVERY_ONE_SIDE = "Engine, or `all` to run all of them side by side. May be given several times [default: the engine of the scenario, otherwise the first engine]";
    TIME_STEP_OF_THE_ENGINE_IN_SECONDS = "Time step of the engine in seconds [default: as in the scenario; otherwise `run` chooses it, and other commands use a step in which the fastest driving link turns by a quarter of a degree or less]";
    // figure.rs
    the_mechanism_has_no_point(name) = "the mechanism has no point \"{name}\"";
    NAME_POINTS_WHOSE_DISTANCE_FOLLOWS = "name points whose distance depends on the pose of the mechanism";
    the_distance_of_stands_in_the_file(names) = "the distance of {names} is given in the file: only one link has both points";
    a_distance_lies_between_two(names) = "a distance needs two points, found {names}";
    there_is_no_figure(name) = "there is no figure \"{name}\"";
    THERE_IS_NO_FIGURE_2 = "no figure is given";
    ADD_A_MOTOR_SECTION_ITS_LAW = "add a `[motor]` section: its law, and the ratio of the reducer";
    A_STEADY_SPEED_NEEDS_A_MOTOR = "a steady speed needs a motor, but the scenario has no motor";
    // formula.rs
    ADD_CHANNEL_OR_TAKE_IT_OUT = "add `channel`, or remove the key";
    belongs_to_a_claim_and_this_formula(key) = "`{key}` belongs to a claim, but this formula has no claim";
    LEAVE_IT_OUT_IF_THE_FORMULA = "leave out `error` if the formula is exact";
    A_CLAIMED_ERROR_MUST_BE_A_POSITIVE = "a claimed error must be a positive number";
    THE_LAST_CRANK_ANGLE_IS_LESS = "the last input is less than the first";
    there_is_no(name) = "there is no `{name}`";
    write_or(name, key) = "write `{name}` or `{key}`";
    CHOOSE_ANOTHER_NAME = "choose another name";
    is_a_parameter_or_a_formula(name) = "`{name}` is already a parameter or a formula";
    // grid.rs
    CHECK_FROM_TO_AND_THE_SIZE = "check `from`, `to` and the size and sign of `step`";
    CHECK_THE_UNIT_AND_SIZE_OF_THE_GRID = "check the unit and size of the grid, and the law of the drive";
    A_FREE_MOTION_HAS_NO_GRID_OF_INPUTS = "the grid begins at an input, but the motion is free, so its inputs are not known in advance";
    GIVE_THE_GRID_BY_TIME_FROM_TO_STEP = "give the grid by time (`from_s`, `to_s`, `step_s`, or a list `times_s`)";
    THE_GRID_IS_GIVEN_TWICE = "the grid is given twice";
    KEEP_ONE_OF_A_RANGE_FROM_TO_STEP = "keep one of: a range (`from`, `to`, `step`), a list of crank angles (`angles`), of slides (`slides`) or of times (`times`)";
    A_GRID_GOES_BY_CRANK_ANGLE = "define a grid by crank angle (`from_deg`, `to_deg`, `step_deg`) or by time (`from_s`, `to_s`, `step_s`), or list its values (`angles_deg`, `times_s`)";
    GIVE_EVERY_INSTANT_ONCE_FOR_EXAMPLE = "give every instant once, for example `times_s = [0, 0.1, 0.3]`";
    values_and_of_the_list_are_the_same(pair, pair_2) = "values {pair} and {pair_2} of the list are the same";
    the_list_has_more_than_values(most) = "the list has more than {most} values";
    THE_LIST_IS_EMPTY = "the list is empty";
    the_range_has_more_than_points(most) = "the range has more than {most} points";
    a_step_leads_away_from_the_end(way) = "a {way} step leads away from the end of the range";
    THE_STEP_MUST_NOT_BE_ZERO = "the step must not be zero";
    the_range_from_to_by_is_not_finite(from, to, step) = "the range from {from} to {to} by {step} is not finite";
    // header.rs
    cannot_be_the_name_of_a_scenario(name) = "\"{name}\" cannot be the name of a scenario";
    IT_NAMES_FILES_USE_AT_MOST = "files are named after it: use at most 100 lower-case letters, digits and `_`, and no device name such as `con`";
    this_version_reads_format(format) = "this version reads `format = {format}`";
    format_is_not_handled_by_this_version(other) = "format {other} is not handled by this version";
    A_SCENARIO_STARTS_WITH_FORMAT = "a scenario starts with `format = 1`; docs/scenario.md builds one up step by step";
    THE_FILE_HOLDS_NO_SCENARIO = "the file contains no scenario";
    // joints.rs
    IS_NOT_HOW_A_PRISMATIC_PAIR = "is not a way to draw a prismatic joint";
    IS_NO_TYPE_OF_JOINT = "is not a type of joint";
    POINTS_NAMES_A_POINT_OF_THE_FIRST = "`points` names a point of the first link and a point of the second link";
    WRITE_POINTS_A_POINT_OF_THE_FIRST = "write `points = [\"O\", \"B\"]`: a point of the first link on the guide's line, and the point of the second link that slides along this line";
    found_points_but_a_guide(names) = "found {names} points, but a guide takes two";
    A_JOINT_LIES_AT_THE_POINT = "a joint lies at the point of its name, or of its key `point`, on both links";
    link_has_no_point(link, point) = "link \"{link}\" has no point \"{point}\"";
    MAKE_THE_TWO_ONE_LINK_WITH_ALL = "combine the two links into one link with all points, or join other links";
    joint_joins_and_already_two(other, first, second) = "joint \"{other}\" already joins \"{first}\" and \"{second}\"; two joints lock two links together";
    NAME_TWO_DIFFERENT_LINKS = "name two different links";
    it_joins_with_itself(first) = "the joint joins \"{first}\" with itself";
    found_links_but_a_joint_has_two(pair) = "found {pair} links, but a joint has two";
    GIVE_EVERY_JOINT_ITS_OWN = "give every joint a unique name; two joints on one pin share the point instead: `point = \"...\"`";
    two_joints_are_called(name) = "two joints are called \"{name}\"";
    // lib.rs
    TAKE_THE_NUMBERS_OUT_OR_GIVE = "remove the numbers, or give them at crank angles that the drive reaches";
    GIVE_THE_NUMBERS_AT_TIMES = "give the numbers at times (`time_s`)";
    published_numbers(message) = "published numbers: {message}";
    the_directory_cannot_be_read(directory, error) = "the directory {directory} cannot be read: {error}";
    // links.rs
    NAMES_CONSIST_OF_LETTERS_DIGITS = "names consist of at most 100 letters, digits, `_`, `-` and `'`";
    cannot_be_the_name_of_a(table, what) = "\"{table}\" cannot be the name of a {what}";
    cannot_be_the_name_of(name, what) = "\"{name}\" cannot be the name of {what}";
    no_point_stands_before_this_one(from) = "no point \"{from}\" is defined before this one";
    ADD_A_POINT_A = "add a point: `A = { x_mm = 0, y_mm = 0 }`";
    THERE_IS_NO_POINT = "no point is given";
    THE_LINK_HAS_A_MASS_BUT_NO_MASS = "the link has a mass but no mass centre";
    ADD_MASS_CENTRE_IN_THE_LINK = "add `mass_centre = { x_mm = ..., y_mm = ... }`, in the link's frame";
    THE_LINK_HAS_A_MASS_CENTRE = "the link has a mass centre but no mass";
    ADD_MASS_KG_IS_ALLOWED_OR_LEAVE = "add `mass_kg` (0 is allowed), or leave out the mass centre";
    THE_LINK_HAS_A_MOMENT_OF_INERTIA = "the link has a moment of inertia but no mass";
    ADD_MASS_KG_OR_LEAVE_OUT = "add `mass_kg`, or leave out the inertia";
    ADD_A_SECTION_LINKS_NAME = "add a section `[links.NAME]` for each moving link";
    THERE_IS_NO_LINK_2 = "no link is given";
    // loads.rs
    joint_does_not_slide(name) = "joint \"{name}\" does not slide";
    NAME_A_PRISMATIC_JOINT = "name a prismatic joint";
    found_but_a_coefficient_lies(found, most) = "found {found}, but a coefficient of friction is not negative and below {most}";
    STEEL_ON_BRONZE = "dry steel on steel has about 0.15, an oiled journal about 0.05";
    NAME_TWO_POINTS_THAT_MOVE = "name two points that move apart";
    a_joint_holds_the_two_points(first) = "a joint holds the two points \"{first}\" together";
    found_points_but_this_load(points) = "found {points} points, but this load acts between two";
    WRITE_POINTS_A_POINT_OF_THE_FIRST_LINK = "write `points = [\"S\", \"B\"]`: a point of the first link and a point of the second link";
    it_acts_between_and_itself(first) = "the load acts between \"{first}\" and itself";
    found_links_but_this_load(names) = "found {names} links, but this load acts between two";
    NAME_A_LINK_THAT_TURNS = "name a link that turns";
    link_does_not_turn_prismatic(name) = "link \"{name}\" does not turn: only prismatic joints connect it with the ground";
    NAME_A_MOVING_LINK = "name a moving link";
    THE_GROUND_DOES_NOT_TURN = "the ground does not turn";
    THE_GROUND_DOES_NOT_MOVE = "the ground does not move, so a load on it has no effect";
    WRITE_FOR_A_FOUR_STROKE_ENGINE = "write `turns = 2` for a four-stroke engine, otherwise leave out `turns`";
    found_but_a_table_repeats(other, most_turns) = "found {other}, but a table repeats after 1 to {most_turns} turns of the crank";
    A_TABLE_REPEATS_AFTER_A_TURN = "a table repeats after one turn or after `turns` turns: leave out the last point of the table if this point repeats the first point";
    the_table_is_longer_than_its_period(u64) = "the table is longer than its period, {u64} deg";
    WRITE_THE_POINTS_IN_ASCENDING = "write the points in ascending order of the input; in a table of straight lines, two points with the same input are a jump";
    GIVE_THE_INPUT = "give the crank angle, or the slide of the first drive";
    A_TABLE_OVER_A_SLIDE_IS_NOT_PERIODIC = "a table over a slide has slides in all rows, straight lines and no `turns`";
    GIVE_SLIDES_IN_ALL_ROWS = "give `crank_m` or `crank_mm` in all rows, and leave out `turns` and `interpolation`";
    A_SPLINE_CANNOT_JUMP = "the table jumps here, but its interpolation is smooth";
    TAKE_LINES_FOR_JUMPS = "write `interpolation = \"linear\"`, or give each crank angle once";
    A_JUMP_HAS_TWO_POINTS = "three points have the same input";
    THE_CRANK_ANGLES_OF_THE_TABLE = "the crank angles or slides of the table do not ascend";
    A_TABLE_OVER_THE_CRANK_ANGLE = "a table needs at least one point";
    WRITE_A_CONSTANT_OR_ADD_POINTS = "write a constant, or add points";
    and_table_are_both_given(name) = "`{name}` and `table` are both given";
    ADD_TABLE_OR_LEAVE_THE_KEY = "add `table`, or leave out the key";
    THIS_BELONGS_TO_A_TABLE_OVER = "this key belongs to a table, but no table is given";
    IS_NO_INTERPOLATION = "is not an interpolation";
    NAME_A_POINT_THAT_MOVES = "name a point that moves";
    THE_POINT_DOES_NOT_MOVE_IT_IS_HINGED = "the point does not move: it is hinged to the ground";
    IS_NO_FRAME_OF_A_FORCE = "is not a frame of a force";
    DOES_NOT_SAY_WHEN_THE_MOMENT = "does not state when the load acts";
    IS_NO_TYPE_OF_LOAD = "is not a type of load";
    // malformed.rs
    first_in_line(message, line) = "{message}, first in line {line}";
    the_file_is_not_valid_toml_duplicate(key) = "the file is not valid TOML: duplicate key, `{key}` is given twice";
    QUOTE_NAMES_WITH_OTHER_LETTERS = "write a name with other signs than a-z, A-Z, 0-9, _ and - in quotes, such as \"О\" = 1";
    WRITE_THE_KEYS_INSIDE_THE_BRACES = "a table in braces is complete: write its keys inside the braces, or write the table as a section `[name]` without braces";
    A_KEY_IS_WRITTEN_NAME_VALUE = "write a key as `name = value`, a section as `[name]`, and text in \"quotes\"";
    decimals_take_a_point_write(found) = "write decimals with a point: {found}";
    the_file_is_not_valid_toml_has_a_decimal(found) = "the file is not valid TOML: `{found}` has a decimal comma";
    // mapping.rs
    A_DIFFERENCE_THAT_IS_ALLOWED = "an allowed difference is zero or more";
    rows_do_not_hold_at(name) = "instants of rows cannot be given as `{name}`";
    GIVE_A_MAPPING_FILE_OR_ONE_COLUMN = "give a mapping file, or each column as EXPR=CHANNEL";
    the_mapping_cannot_be_read(path, error) = "the mapping {path} cannot be read: {error}";
    WRITE_IT_SUCH_AS_PHI3_PI = "write, for example, phi3*180/pi=link.rocker.angle_deg";
    A_MAPPING_IS_AN_ARITHMETIC = "a mapping is an expression of columns, `=`, and a channel";
    // stated.rs
    ADD_A_DRIVE = "add a `[drive]`; only structures that cannot move may be without one, for inspection and drawings";
    // curve.rs
    A_LAW_USES_T = "a law of motion uses the time `t` in seconds; an angle is in rad, a slide in m";
    A_LIFT_USES_PHI = "a lift uses the angle of the cam, `phi` in rad; the lift is in m, or in rad for a follower that swings";
    is_no_variable_here(name) = "`{name}` has no meaning in this formula";
    has_a_kink(name) = "`{name}` has a kink, at which velocities jump";
    GIVE_A_FORMULA_WITH_TWO_DERIVATIVES = "give a formula with two continuous derivatives";
    the_formula_is_undefined_at(variable, x, unit) = "the formula or one of its first two derivatives is undefined at {variable} = {x} {unit}";
    THE_FORMULA_IS_CONSTANT = "the formula is constant";
    // masses.rs
    CHECK_THE_UNIT_LEAVE_OUT = "check the unit; leave out masses that no requested quantity needs";
    link_has_a_moment_of_inertia(link, own, own_2) = "link \"{link}\": its moment of inertia plus its mass times the square of the largest link's length is {own} kg·m²; this is {own_2} times the sum over all other links and the motors";
    CHECK_THE_UNIT_A_LINK_THAT_IS_SO = "check the unit; if the link really is so large, add a point at the mass centre";
    the_mass_centre_of_link_is_away(link, far, far_2) = "the mass centre of link \"{link}\" is {far} m away from all its points, {far_2} times the largest link";
    CHECK_THE_UNITS_OF_ITS_SPEED = "check the units of the link's speed and length";
    at_rad_link_of_has_points(speed, link, link_2) = "at the speed {speed} (rad/s or m/s), link \"{link}\" of {link_2} m has points that are faster than light";
    // motion.rs
    A_TABLE_OF_ANGLES_NEEDS_TWO = "a table needs at least two points with different values";
    WRITE_THE_POINTS_IN_ASCENDING_ORDER = "write the points in ascending order of time, each time once";
    the_times_do_not_ascend_comes(time, last) = "the times do not ascend: {time} s comes after {last} s";
    LET_LAW_AND_START_BE_EQUAL = "let the value of the table or formula at t = 0 be equal to the start";
    the_law_does_not_begin(begin, input, input_2) = "the law begins with {begin} {input_2}, but the start is {input} {input_2}";
    THE_TABLE_BEGINS_LATER = "the first point of the table is not at 0 s";
    GIVE_A_CRANK_ANGLE_OTHER = "give a value that differs from the start";
    THE_CRANK_IS_TO_STAY_WHERE = "the input would not change";
    THE_FIRST_DRIVE_HOLDS = "the first drive identifies the instants, but does not move its joint";
    PUT_A_MOVING_DRIVE_FIRST = "write a drive that moves its joint before this drive; if nothing moves, leave out `[drive]` and inspect the structure";
    IS_NO_LAW_OF_MOTION = "is not a law of motion";
    is_no_way_through_a_change(other) = "\"{other}\" is not a way to pass a change point";
    WRITE_THROUGH_SMOOTH_FOR_THE_BRANCH = "write `through = \"smooth\"` for the branch with continuous velocities, or remove the key";
    ON_THE_OTHER_BRANCH_VELOCITIES = "on the other branch velocities jump at a change point, which needs infinite forces";
    is_no_sort_of_motion(other) = "\"{other}\" is not a kind of motion";
    THE_LINK_IS_GIVEN_A_SPEED = "the link has a speed at t = 0, but its motion is prescribed";
    WRITE_MOTION_FREE_TO_LEAVE = "write `motion = \"free\"` to let motor and loads determine the motion, or remove the key";
    A_LINK_WITH_A_SPEED_AT_MOVES = "a link with a speed at t = 0 moves freely: write `motion = \"free\"`, or remove `initial_speed`";
    THE_MOTION_IS_FREE_BUT_A_LAW = "the motion is free, but a law is given";
    FORCES_DECIDE_A_FREE_MOTION = "forces determine a free motion: give only its nominal speed (`speed_rpm`)";
    GIVE_EVERY_DRIVE_A_JOINT = "give every drive a separate joint";
    THIS_JOINT_IS_DRIVEN_ALREADY = "this joint is already driven";
    there_is_no_joint(name) = "there is no joint \"{name}\"";
    TAKE_THE_KEY_OUT = "remove the key";
    CHANGE_POINTS_ARE_PASSED_WITH_ONE_DRIVE = "change points can be passed with one drive only, but there are several";
    // motor.rs
    ADD_INTERMEDIATE_RATIO_ITS_SPEED = "add `intermediate_ratio`: the shaft's speed divided by the speed of the crank";
    THE_INTERMEDIATE_SHAFT_HAS_A_MOMENT = "the intermediate shaft has a moment of inertia, but its speed is not known";
    GIVE_THE_SPEED_OF_THE_INTERMEDIATE = "give the speed of the intermediate shaft divided by the speed of the crank";
    found_but_a_ratio_of_speeds(ratio) = "found {ratio}, but a ratio of speeds is positive";
    a_table_of_torques_needs(speeds) = "a table of torques needs at least two points, found {speeds}";
    WRITE_THE_POINTS_IN_ASCENDING_ORDER_OF_SPEED = "write the points in ascending order of speed, each speed once";
    the_speeds_do_not_ascend(speed, last) = "the speeds do not ascend: {speed} rad/s comes after {last} rad/s";
    CHECK_BREAKDOWN_SPEED_AND_SYNCHRONOUS = "check `breakdown_speed` and `synchronous_speed` and their units";
    the_motor_breaks_down_at_rad(speed, synchronous_speed) = "the breakdown speed, {speed:.6} rad/s, is not below the synchronous speed, {synchronous_speed:.6} rad/s";
    found_but_the_slip_of_breakdown(slip) = "found {slip}, but the breakdown slip is positive";
    GIVE_SYNCHRONOUS_SPEED_SPEED_OF_BREAKDOWN = "give (synchronous speed - breakdown speed) divided by the synchronous speed";
    THE_SLIP_AND_THE_SPEED_OF_BREAKDOWN = "breakdown slip and breakdown speed are both given";
    GIVE_ONE_OF_THE_TWO_BREAKDOWN = "give one of the two: `breakdown_slip`, or `breakdown_speed_rpm` or `breakdown_speed_rad_s`";
    GIVE_A_SHARE_FOR = "give a fraction: 0.92 for 92 %";
    found_but_an_efficiency_lies(efficiency) = "found {efficiency}, but an efficiency is above 0 and at most 1";
    GIVE_THE_SPEED_OF_THE_MOTOR = "give the speed of the motor divided by the speed of the crank; 1 without a reducer";
    IS_NO_LAW_OF_A_MOTOR = "is not a law of a motor";
    // oracle.rs
    THERE_IS_NO_VALUE = "no value is given";
    SPLIT_IT_INTO_SEVERAL_ORACLE = "split the oracle into several [[oracle]] tables";
    AN_ORACLE_HAS_EXACTLY_ONE_OF_FILE = "an oracle has exactly one of `file`, `values` and `figures`";
    GIVE_THE_NUMBERS_DOCS_SCENARIO = "give the numbers: docs/scenario.md describes how";
    IS_NO_WAY_TO_KNOW_NUMBERS = "is not a basis of published numbers";
    // parameter_table.rs
    KEEP_ONE_OF_THE_TWO_OR_CALL = "keep one of the two parameters, or rename one of them";
    would_stand_for_and_for(name, key, key_2) = "`{name}` would mean both `{key}` and `{key_2}`";
    SET_THE_PARAMETER_WITH_THE_UNIT = "set the parameter with the unit that the file gives it";
    is_the_path_of_a_parameter(key) = "`{key}` is the path of a parameter";
    name_the_parameter(key) = "name the parameter by its key: `{key}`";
    the_scenario_has_no_parameter(key) = "the scenario has no parameter `{key}`";
    // parameters.rs
    has_a_meaning_in_every_formula(name) = "`{name}` is a reserved name in formulas";
    cannot_be_a_name_in_a_formula(name) = "\"{name}\" cannot be a name in a formula";
    NAMES_BEGIN_WITH_A_LETTER = "names begin with a letter and have letters, digits and `_` only";
    NOTHING_IS_KNOWN_OF_ITS_VALUE = "the value of the expression cannot be determined";
    CHECK_ITS_UNITS_AND_WHETHER = "check the units of the expression, and whether a divisor is zero apart from rounding error";
    WRITE_A_NUMBER_OR_GIVE_IT_A_NAME = "write a number, or give it a name in a section [parameters]";
    // printed.rs
    found_but_no_number_is_printed(digits) = "found {digits}, but no number is printed with that many decimals";
    give_the_count_of_printed(value, most_digits) = "give the count of printed decimals, from {value} to {most_digits}";
    GIVE_THE_RIGHT_NUMBER_WITH_MORE = "give the right number with more decimals, or remove `finding` and `right` if the printed number is right";
    with_decimals_is_not_apart(value, digits, value_2, digits_2) = "{value} with {digits} decimals cannot be distinguished from the printed {value_2} with {digits_2}";
    A_NUMBER_KNOWN_TO_BE_WRONG = "a number known to be wrong needs a `finding` with the reason, and the correct number as `right`: `right = { value = 2.6, digits = 1 }`";
    // reader.rs
    write_a_section_for_each(path) = "write a section [[{path}]] for each entry";
    WRITE_KEYS_WITH_THEIR_VALUES = "write keys with their values in braces, such as { x_mm = 0, y_mm = 0 }, or a section";
    WRITE_TRUE_OR_FALSE_WITHOUT = "write `true` or `false`, without quotes";
    WRITE_A_WHOLE_NUMBER_SUCH_AS = "write a whole number, such as 3";
    WRITE_NUMBERS_IN_BRACKETS_SUCH_AS = "write numbers in brackets, such as [0, 0.1, 0.3]";
    WRITE_A_DECIMAL_NUMBER_NAN = "write a decimal number; nan and inf are not quantities";
    WRITE_A_DECIMAL_NUMBER_SUCH_AS_WITHOUT = "write a decimal number, such as 12.5, without quotes";
    WRITE_TEXTS_IN_BRACKETS_SUCH_AS_GROUND = "write texts in brackets, such as [\"ground\", \"crank\"]";
    PUT_A_TEXT_IN_QUOTES_THERE = "write a text in \"quotes\" there";
    PUT_THE_TEXT_IN_QUOTES = "put the text in \"quotes\"";
    AN_ARRAY_OF_TABLES = "an array of tables";
    TRUE_OR_FALSE = "true or false";
    A_WHOLE_NUMBER = "a whole number";
    AN_ARRAY_OF_NUMBERS = "an array of numbers";
    A_FINITE_NUMBER = "a finite number";
    AN_ARRAY_OF_TEXTS = "an array of texts";
    found_but_is_needed(found, needed) = "found {found}, but {needed} is needed";
    // reader/quantity.rs
    is_in_an_unsupported_unit(key, name) = "`{key}` is in {name}, which are not supported";
    does_not_end_in_a_unit_that_has_here(key, noun) = "`{key}` does not end in a unit of {noun} that is allowed here";
    carries_no_unit(base) = "`{base}` has no unit";
    and_are_both_given(key, key_2) = "`{key}` and `{key_2}` are both given";
    CHECK_THE_UNIT_AND_THE_EXPONENT = "check the unit and the exponent";
    found_but_is_zero_or_of_a_size(found, noun, smallest, most, unit) = "found {found}, but {noun} must be zero or of a magnitude from {smallest} to {most} {unit}";
    found_but_here(found, noun, rule) = "found {found}, but {noun} {rule} here";
    // reader/several.rs
    THIS_KEY_IS_NOT_KNOWN_HERE = "this key is not known here";
    known_here(choice) = "known here: {choice}";
    add_to(wanted, path) = "add {wanted} to `{path}`";
    add_docs_scenario_md_describes(wanted) = "add {wanted}; docs/scenario.md describes every key";
    there_is_did_you_mean(key, spelling) = "there is `{key}`: did you mean `{spelling}`?";
    is_missing(wanted) = "{wanted} is missing";
    // reduced.rs
    NOTHING_IN_THE_MECHANISM_HAS_A_MASS = "no part of the mechanism has a mass, so there is no inertia to reduce to the crank";
    GIVE_THE_LINKS_MASS_KG_AND_INERTIA = "give the links mass_kg and inertia_kg_m2; a motor's rotor is not counted";
    TAKE_A_SCENARIO_WITH_ONE_DRIVE = "use a scenario with one [drive], or claim channels of single links";
    the_quantity_is_not_of_a(name, noun) = "{name} does not exist here: the input of the drive is a {noun}";
    use_one_of(known) = "use one of: {known}";
    is_of_one_crank_but_the_mechanism(name, count) = "{name} belongs to one crank, but the mechanism has {count} drives";
    // series.rs
    is_not_in_the_run_which_goes(time, end) = "{time} s is outside the run, which goes from 0 to {end} s";
    GIVE_A_TIME_WITHIN_THE_RUN = "give a time within the run, or extend the grid";
    NAME_THE_COLUMN_OF_CRANK = "name the column of crank angles (`crank = \"crank_deg\"`) or the column of times (`time = \"t_s\"`)";
    column_does_not_say_its_unit(column) = "column \"{column}\" does not state its unit";
    THE_COLUMN_OF_TIMES_ENDS = "the name of the column of times must end in `_s` or `_ms`";
    THE_COLUMN_OF_CRANK_ANGLES = "the name of the column must end in `_deg` or `_rad` for crank angles, in `_m` or `_mm` for slides";
    keep_one_of_the_two_2(help) = "keep one of the two: {help}";
    A_COLUMN_OF_CRANK_ANGLES = "a column of crank angles and a column of times are both named";
    A_CRANK_ANGLE_AND_A_TIME = "a crank angle and a time are both given";
    A_NUMBER_HOLDS_AT_A_CRANK = "give either a crank angle or a time for each number; if forces determine the motion, the crank angle is that of the nominal motion";
    CHANNELS_ARE_NAMED_LIKE_POINT = "channels are named like \"point.A.x_mm\", \"link.crank.angle_deg\", \"link.crank.omega_rad_s\", \"joint.A.fx_N\" or \"drive.torque_N_m\"";
    of_what_moves(suggestion) = "channels of a moving part: {suggestion}";
    add_to_want_or_take_the_published(stage) = "add \"{stage}\" to `want`, or remove the published numbers";
    this_channel_is_one_of_the_which_channels(stage) = "this channel is one of the {stage}, which `channels.want` leaves out";
    the_mechanism_has_no_channel(name) = "the mechanism has no channel \"{name}\"";
    // settings.rs
    GIVE_A_NUMBER_BETWEEN_AND_SUCH_AS = "give a number between 0 and 1, such as 1e-2";
    found_but_this_is_a_share(share) = "found {share}, but this is a fraction of a channel's scale";
    there_are_no_channels(word) = "there is no channel \"{word}\"";
    ask_for_for_a_subject_such_as_for_its_stage(choice, known, known_2) = "ask for {choice}, for a subject such as \"{known}\", for its stage, \"{known_2}.positions\", or for one channel";
    did_you_mean_2(near) = "did you mean \"{near}\"?";
    NOTHING_IS_WANTED = "no channel is requested";
    name_at_least_one_or_leave(suggestion) = "name at least one channel, or leave out the section to get all channels; {suggestion}";
    // source.rs
    DIVIDE_IT_INTO_SEVERAL_FILES = "divide the file into several files";
    the_file_has_more_than_parts(most_parts, parts) = "the file has more than {most_parts} parts ({parts})";
    POINTS_LINKS_JOINTS_LOADS_FORMULAS = "points, links, joints, loads, formulas and other tables";
    the_text_has_more_than_letters(longest_text) = "the text has more than {longest_text} characters";
    THE_TEXT_HOLDS_A_LETTER_THAT_IS_NOT_SEEN = "the text contains an invisible character";
    GIVE_IT_A_SHORTER_NAME = "give the key a shorter name";
    a_key_has_more_than_letters(longest_name) = "a key has more than {longest_name} characters";
    A_KEY_HOLDS_A_LETTER_THAT_IS_NOT_SEEN = "a key contains an invisible character";
    DIVIDE_IT_OR_TAKE_A_COARSER = "divide the file, or use a coarser grid; long columns of published numbers belong in a table (`file`)";
    the_file_has_more_than_values(most_values) = "the file has more than {most_values} values (signs `,` `=` `[` `{{` `.`)";
    GIVE_THE_PATH_OF_A_SCENARIO = "give the path of a scenario file, such as four_bar.toml";
    the_scenario_cannot_be_read(path, error) = "the scenario {path} cannot be read: {error}";
    TAKE_OUT_LINE_BREAKS_CONTROL = "remove line breaks, control characters and changes of the writing direction";
    // start.rs
    start_groups_links(names, mode) = "[[start.groups]]\nlinks = [{names}]\n{mode}";
    mode_or(one, other) = "mode = \"{one}\" # or \"{other}\"";
    its_groups_are(ready_to_paste) = "the groups of the mechanism are:\n{ready_to_paste}";
    IT_HAS_NO_GROUP_AT_ALL_TAKE = "the mechanism has no groups: remove the table";
    the_mechanism_has_no_assur(names) = "the mechanism has no Assur group ({names})";
    no_link_of_the_group_has_a_point(name) = "no link of the group has a point \"{name}\"";
    IT_HAS_ONE_CONFIGURATION_LEAVE = "the group has one configuration: leave out the mode";
    GIVE_NEAR_INSTEAD = "give `near` instead";
    write_or_2(one, other) = "write \"{one}\" or \"{other}\"";
    mode_does_not_belong_to_a_group(asked, group) = "a group of {group} has no mode \"{asked}\"";
    a_number_from_the_list_of_configurations(names, or) = "{names}{or}a number from the list of configurations";
    is_no_assembly_mode_of_the_group(mode, group) = "\"{mode}\" is not an assembly mode of the group ({group})";
    ask_for_one_of_its_groups(examples) = "ask for one of the mechanism's groups: {examples}";
    write_the_links_of_a_group(examples) = "write the links of a group, `=`, and a mode or a number: {examples}";
    names_no_group_and_mode(text) = "\"{text}\" does not name a group and a mode";
    THIS_GROUP_IS_GIVEN_TWICE = "this group is given twice";
    add_with_the_right_mode(ready_to_paste) = "add, with the right mode:\n{ready_to_paste}";
    the_assembly_mode_of_the_group(first) = "the assembly mode of the group {first} is not given";
    the_assembly_modes_of_groups(groups) = "the assembly modes of these groups are not given: {groups}";
    IS_NO_ASSEMBLY_MODE = "is not an assembly mode";
    // statistic.rs
    WRITE_STATISTIC_AND_QUANTITY = "write STATISTIC:QUANTITY, such as `max:joint.A.f_N`, `mean:drive.torque_N_m` or `at=90:point.B.x_mm`";
    is_no_figure(text) = "\"{text}\" is not a figure of a run";
    there_is_no_statistic(word) = "there is no statistic `{word}`";
    the_figure_has_no_instant(figure) = "the figure {figure} needs at least one instant";
    GIVE_THE_GRID_INSTANTS = "give the grid at least one instant";
    the_quantity_has_no_value(quantity, input) = "{quantity} has no value at {input}";
    LEAVE_THAT_INSTANT_OUT = "leave this instant out of the grid, or choose another quantity";
    no_instant_has_the_input(input, unit) = "the grid has no instant at {input} {unit}";
    NAME_AN_INSTANT_OF_THE_GRID = "name an instant of the grid, or add this instant to the grid";
    is_one_number_for_all(text) = "{text} is one number for the whole mechanism, not a quantity at each instant";
    NAME_A_CHANNEL_FOR_A_FIGURE = "name a channel, such as `joint.A.f_N`";
    the_run_lacks(name) = "the run does not contain {name}";
    SOLVE_WITH_THE_CHANNELS_OF_THE_FIGURE = "request the channel in `want` of `[channels]`";
    // table_file.rs
    WRITE_IT_AS_PRINTED_WITH_A_DECIMAL = "write the number as printed, with a decimal point; list a cell known to be wrong under `expect`, with the finding";
    found_but_a_decimal_number(text, comma) = "expected a decimal number{comma}, found \"{text}\"";
    AND_DECIMALS_TAKE_A_POINT = ", written with a decimal point";
    the_table_has_no_column(name) = "the table has no column \"{name}\"";
    GIVE_A_HEADER_AND_AT_LEAST = "give a header and at least one row";
    THE_TABLE_HAS_NO_ROWS = "the table has no rows";
    TAKE_OUT_LINE_BREAKS_AND_CONTROL = "remove line breaks and control characters";
    THE_HEADER_HOLDS_A_LETTER = "the header contains an invisible character";
    SEPARATE_CELLS_WITH_COMMAS_AND_GIVE = "separate cells with commas and give every row as many cells as the header; write decimals with a point";
    the_row_has_cells_but_the_header(count, expected, commas) = "the row has {count} cells, but the header has {expected}{commas}";
    ITS_DECIMALS_SEEM_TO_HAVE_COMMAS = ": its decimals seem to be written with commas";
    SEPARATE_CELLS_WITH_COMMAS_AND_WRITE = "separate cells with commas, and write decimals with a point";
    the_header_has_one_cell_because(other) = "the header has one cell, because its columns are separated by {other}";
    found_explained_by(slack, why) = "found {slack}, explained by \"{why}\"";
    GIVE_A_POSITIVE_NUMBER_AND_THE_REASON = "give a positive number and the reason why the published numbers are off by that much";
    WHY_EXPLAINS_SLACK_BY_WHICH_ALL = "`why` explains `slack`, by which all numbers of the table may be off";
    GIVE_ONE_VALUE_FOR_EVERY_ROW = "give one value for every row, in the order of the rows";
    found_right_values_for_the_column(values, printed) = "found {values} right values for the column's {printed} rows";
    SAY_WHICH_FINDING_CALLS_THE_CELL = "name the finding that says that the cell is wrong";
    FINDING_IS_MISSING = "`finding` is missing";
    the_table_has_no_row_with_this(what) = "the table has no row with this {what}";
    give_a_that_stands_in_the_table(what) = "give a {what} that is in the table";
    KEEP_EITHER_EXPECT_OR_FINDING = "keep either `expect` or `finding`";
    A_COLUMN_THAT_IS_WRONG_AS_A_WHOLE = "the whole column is marked as wrong, so single cells cannot be marked as well";
    THERE_IS_NO_COLUMN = "no column is mapped";
    MAP_AT_LEAST_ONE_COLUMN_P2X = "map at least one column: `P2x_mm = { channel = \"point.2.x_mm\" }`";
    GIVE_FEWER_ROWS_OR_FEWER = "give fewer rows, or fewer columns";
    reading_rows_of_what_oracle(rows, needs, allowed) = "reading {rows} rows of [[oracle]] data needs about {needs} of memory; {allowed} are allowed";
    THE_PATH_IS_RELATIVE_TO_THE_SCENARIO = "the path is relative to the scenario's directory";
    the_table_cannot_be_read(path, error) = "the table {path} cannot be read: {error}";
    // unit.rs
    A_MASS_PER_LENGTH = "a mass per length";
    A_TORSIONAL_STIFFNESS = "a torsional stiffness";
    A_CHANGE_OF_A_MOMENT_WITH_AN_ANGULAR = "a moment per angular velocity";
    A_MOMENT_OF_INERTIA = "a moment of inertia";
    AN_ANGULAR_VELOCITY = "an angular velocity";
    // words.rs
    allowed_here(near, choice) = "{near}allowed here: {choice}";
    did_you_mean_3(near) = "did you mean \"{near}\"? ";
    allowed_here_2(choice) = "allowed here: {choice}";
    THERE_IS_NONE_THAT_COULD = "no name is possible here";
    did_you_mean_4(quote, near) = "did you mean {quote}{near}{quote}?";
    did_you_mean_one_of(names) = "did you mean one of these: {names}?";
    and_names_more(names, more) = "{names} and {more} more";
    it_is_none_of_more_than_names(most) = "it is not among the more than {most} names that are allowed here";
    // transmissions/cam.rs
    IS_NO_FOLLOWER = "is not a follower of a cam";
    the_follower_has_no_point(link, point) = "follower \"{link}\" has no point \"{point}\"";
    GIVE_THE_ROLLER = "give the radius of the roller, or take `follower = \"knife\"`";
    ONLY_A_ROLLER_HAS_A_RADIUS = "only a roller has a radius";
    TAKE_A_ROLLER = "remove the radius, or write `follower = \"roller\"`";
    GIVE_THE_MOTION_OF_THE_FOLLOWER = "write `motion = [{ to_deg = 120, lift_mm = 20 }, { to_deg = 180 }, { to_deg = 300, lift_mm = 0 }, { to_deg = 360 }]`";
    IS_NO_CURVE_OF_A_CAM = "is not a curve of a cam";
    the_cam_angles_do_not_ascend(to, last) = "the piece ends at {to} deg, but must end after {last} deg and not after 360 deg";
    ASCEND_TO_360 = "let the angles ascend, and let the last piece end at 360 deg with lift 0";
    LIFTS_IN_TWO_UNITS = "some lifts are lengths, others are angles";
    THE_FOLLOWER_DOES_NOT_MOVE = "the follower has no lift";
    THE_CAM_HAS_TWO_LAWS = "the lift of the cam is given twice";
    the_angle_of_the_lift(angle) = "the angle {angle} deg of a lift does not ascend, or is not below 360 deg";
    ASCEND_BELOW_360 = "let the angles ascend from 0 and stay below 360 deg; the table repeats with every turn";
    GIVE_LIFTS = "give lifts: `lifts = [{ angle_deg = 0, lift_mm = 0 }, { angle_deg = 120, lift_mm = 20 }, { angle_deg = 240, lift_mm = 5 }]`";
    THE_FORMULA_DOES_NOT_REPEAT = "the lift, or one of its first two derivatives, is different at `phi` = 0 and 2 pi";
    GIVE_A_LIFT = "give a lift: `{ to_deg = 120, lift_mm = 20 }`";
    the_law_of_the_cam_ends_at(angle) = "the last piece ends at {angle} deg; it must end at 360 deg with lift 0";
    // transmissions.rs
    GIVE_LIFTS_LIKE_THE_JOINT = "give `lift_mm` for a sliding follower and `lift_deg` for a swinging one";
    the_lift_has_units_of(family, joint, kind) = "the lift is {family}, but joint \"{joint}\" of the follower is {kind}";
    IS_NO_TYPE_OF_TRANSMISSION = "is not a type of transmission";
    found_links_but_a_transmission_has_two(links) = "found {links} links, but a transmission has two members";
    NAME_TWO_WHEELS = "write `links = [\"pinion\", \"wheel\"]`";
    the_start_joint_is_taken(joint, other) = "joint \"{joint}\" already fixes the start of transmission \"{other}\"";
    the_start_has_units_of(family, joint, kind) = "the start is given by {family}, but joint \"{joint}\" is {kind}";
    GIVE_AN_ANGLE_OR_A_SLIDE = "give the angle of a revolute joint (`start_deg`) or the slide of a prismatic joint (`start_mm`)";
    NAME_ANOTHER_START_JOINT = "name another joint of a member or of the carrier with `start_joint`";
    no_joint_connects_with_the_carrier(link, carrier) = "no joint connects the second link \"{link}\" with the carrier \"{carrier}\"";
    NAME_THE_START_JOINT = "name a joint of a member or of the carrier with `start_joint`";
    IS_NO_CONTACT_OF_GEARS = "is not a contact of gears";
    EQUAL_GEARS_CANNOT_BE_INTERNAL = "a ring gear has more teeth than its wheel";
    GIVE_THE_RING_MORE_TEETH = "give the ring gear more teeth";
    GIVE_THE_PITCH_RADII = "give the pitch radii of both wheels";
    IS_NO_COURSE_OF_STRANDS = "is not an arrangement of strands";
    the_pressure_angle_is(degrees) = "the pressure angle is {degrees} deg";
    GIVE_A_PRESSURE_ANGLE_BELOW_90 = "give a pressure angle below 90 deg; 20 deg is usual";
    found_numbers_for_two_wheels(key) = "`{key}` must have two positive numbers";
    // numbers.rs, varied.rs
    the_file_has_no_number_at(path) = "the file has no number at `{path}`";
    GIVE_THE_TEXT_WHOSE_NUMBERS_THESE_ARE = "give the text from which the numbers were read";
}
