//! All sentences that this crate can show, in one list.

linkage::sentences! {
    // run.rs
    NOTHING_IS_COMPARED_YET = "nothing is compared yet";
    // accept.rs
    TOO_LITTLE_IS_KNOWN_NOW_OR_WHEN = "agreement with the accepted figures proves nothing: a bound has changed too much, the accepted proof or the present proof does not end in AGREE, or the run has no channel";
    NOT_AS_ACCEPTED = "differs from the accepted figures";
    // check/cause.rs
    THE_SEARCH_ENDED_AT_ITS_LIMIT = "the search reached its work limit before all slips and terms were tried";
    for_the_most_part_with_that_of_the_difference(cause, left) = "for the most part {cause}; {left:.2} % of the difference remains";
    no_single_slip_or_term_it_is_right(significant, significant_2) = "no single slip or missing term explains the difference; the formula is right to {significant} % of the largest value; if it is an approximation or has rounded numbers, state `error = {significant_2}`";
    IT_IS_A_CONSTANT_AND_WHAT = "the formula is constant, but the claimed quantity changes with the crank";
    another_quantity_is_claimed_it_is(channel) = "the formula gives another quantity: {channel}";
    or_more(more) = "; or {more} more";
    one_of_several_that_fit_equally(told) = "one of several causes that fit equally well: {told}";
    another_branch_it_is_right(after, before) = "another branch: the formula is right up to {after}, but wrong at {before}; replace acos, asin or atan by atan2, which follows the branch";
    A_MISSING_TERM = "a missing term";
    a_missing_in(noun, formula, what, beside) = "a missing {noun}, in {formula}: `{what}`{beside}";
    DIVISOR_OR_A_FACTOR_TOO_MANY = "divisor, or a factor too many";
    too_large_by_the_factor_everywhere(significant) = "{significant} times the right value everywhere";
    too_little_everywhere(significant) = "too small by {significant} everywhere";
    too_much_everywhere(significant) = "too large by {significant} everywhere";
    in_instead_of(kind, formula, right, written, wherever) = "{kind}, in {formula}: `{right}` instead of `{written}`{wherever}";
    in_place_of(right, written) = "`{right}` instead of `{written}`";
    it_should_be(right) = "right would be `{right}`";
    nothing_in_place_of(written) = "`{written}` too many";
    WHEREVER_IT_STANDS = " wherever it occurs";
    // check/course.rs
    was_not_asked_for(what) = "{what} was not requested";
    // check/judged.rs
    WRITE_IT_SO_THAT_NO_DIGITS = "write it so that no digits cancel, for example with atan2 instead of acos";
    rounding_leaves_the_formula_less(lost, all) = "because of rounding error, the formula has fewer than six digits at {lost} of {all} instants";
    LET_THE_GRID_COME_TO_THEM = "extend the grid to the crank angles of the claim, or claim the formula for crank angles in the grid";
    NO_INSTANT_LIES_BETWEEN_THE_CRANK = "no instant lies between the crank angles for which the formula is claimed";
    CLAIM_IT_WHERE_THE_CRANK = "claim it for instants at which the crank turns";
    the_claim_has_no_number_at_any(undefined) = "the claimed quantity has no value at any of {undefined} instants: it divides by zero";
    // check/slips/rules.rs
    PI_PI_PI_PI_PI_PI_PI_PI = "q => q + pi/2; q - pi/2; q + pi; q - pi; q + 2*pi; q - 2*pi; pi - q; pi/2 - q";
    PI_PI_PI_PI_PI_PI = "r => r*(180/pi); r/(180/pi); r*(30/pi); r/(30/pi); r*60; r/60; r*(2*pi); r/(2*pi)";
    PI_PI = "t => t*(180/pi); t/(180/pi)";
    // check/undefined.rs
    at_whatever(message, at, place, help) = "{message} at {at}, {place}: {help}, even if the result is multiplied by zero";
    in_from_its_letter(written, formula, start) = "`{written}` in {formula}, from character {start} on";
    // bounds/residual.rs
    COMPARE_ONLY_TRAJECTORIES_THAT_WERE_SOLVED = "compare only trajectories that were solved for the same times";
    THE_TWO_TRAJECTORIES_STAND_ON_DIFFERENT = "the two trajectories have different grids";
    // bounds/verdict.rs
    is_beyond_the_bound(error_in, error_in_2) = "{error_in} is beyond the bound {error_in_2}";
    neither_the_printed_number_nor(finding, place) = "the printed number and the correction in finding \"{finding}\" are both wrong: {place}";
    the_finding_calls_the_formula(finding) = "the finding \"{finding}\" says that the formula is wrong, but the formula agrees with the mechanism: correct the finding or the formula";
    the_finding_says_that_the_printed(finding) = "the finding \"{finding}\" says that the printed number is wrong, but the number agrees with the mechanism: correct the finding or the number";
    MOST_OF_IT_IS_THE_REFERENCE = "; the largest part is the error of the reference";
    MOST_OF_IT_IS_LEFT_BY_THE_SWEEPS = "; the largest part is iteration error: too few sweeps";
    MOST_OF_IT_IS_ROUNDING = "; the largest part is rounding error";
    the_engine_error_may_reach(reached, proves) = "the engine's error may reach {reached} of the channel's scale; more than {proves} is inconclusive";
    the_engine_converges_with_order(observed, formal) = "the engine converges with order {observed:.2} instead of {formal:.0} here: its error cannot be estimated";
    THE_SWEEPS_HAVE_HARDLY_BEGUN = "the sweeps have hardly begun to converge here: the error cannot be estimated";
    THE_REFERENCE_IS_ZERO_THROUGHOUT = "the reference is zero throughout, so there is no scale for the error; add masses, loads or instants";
    is_beyond_the_bound_at(error, bound, t, at) = "{error} is beyond the bound {bound} at t = {t} s, {at}";
    expected_see(place) = "expected, see {place}";
    // diagnosis/knobs.rs
    THE_INVERSE_RATIO = "the inverse ratio";
    WITH_THE_REDUCER_RATIO_TWICE = "with the reducer's ratio applied twice";
    WITHOUT_THE_REDUCER_RATIO = "without the reducer's ratio";
    DIVIDED_BY_THE_EFFICIENCY_INSTEAD = "divided by the efficiency instead of multiplied";
    WITH_THE_EFFICIENCY_TWICE = "with the efficiency applied twice";
    WITHOUT_THE_EFFICIENCY = "without the efficiency";
    AS_RAD_FOR_DEG = "as rad/s for deg/s";
    AS_RAD_FOR_RPM = "as rad/s for rpm";
    AS_RPM_FOR_RAD = "as rpm for rad/s";
    MULTIPLIED_BY_THE_REDUCER_RATIO = "multiplied by the reducer's ratio once more";
    DIVIDED_BY_THE_REDUCER_RATIO = "divided by the reducer's ratio once more";
    AS_KG_FOR_OR_MM_FOR = "as kg for g, or m for mm";
    AS_FOR_KG_OR_FOR_MM = "as g for kg, or mm for m";
    // diagnosis/late.rs
    MINUTES_TAKEN_FOR_SECONDS = "minutes taken for seconds";
    SECONDS_TAKEN_FOR_MINUTES = "seconds taken for minutes";
    SECONDS_TAKEN_FOR_MILLISECONDS = "seconds taken for milliseconds";
    MILLISECONDS_TAKEN_FOR_SECONDS = "milliseconds taken for seconds";
    // diagnosis/slips.rs
    POUND_INCHES_INSTEAD_OF = "pound-inches instead of N·m";
    POUND_FEET_INSTEAD_OF = "pound-feet instead of N·m";
    TAKEN_FOR_CM = "N·m taken for N·cm";
    CM_INSTEAD_OF = "N·cm instead of N·m";
    POUNDS_FORCE_INSTEAD_OF_NEWTONS = "pounds-force instead of newtons";
    MULTIPLES_OF_STANDARD_GRAVITY_INSTEAD = "multiples of standard gravity instead of m/s²";
    KM_INSTEAD_OF = "km/h instead of m/s";
    RAD_TAKEN_FOR_REVOLUTIONS_PER = "rad/s taken for revolutions per minute";
    REVOLUTIONS_PER_MINUTE_INSTEAD_OF_RAD = "revolutions per minute instead of rad/s";
    NEWTONS_TAKEN_FOR_KILOPONDS = "newtons taken for kiloponds";
    KILOPONDS_INSTEAD_OF_NEWTONS = "kiloponds instead of newtons";
    A_THOUSANDTH_AS_KG_FOR_OR_KN = "a thousand times too small, as with kg for g or kN for N";
    A_THOUSANDFOLD_AS_FOR_KG = "a thousand times too large, as with g for kg or mN for N";
    PER_SECOND_TAKEN_FOR_PER = "per second taken for per minute";
    PER_MINUTE_INSTEAD_OF_PER = "per minute instead of per second";
    FEET_INSTEAD_OF_METRES = "feet instead of metres";
    INCHES_INSTEAD_OF_METRES = "inches instead of metres";
    METRES_TAKEN_FOR_CENTIMETRES = "metres taken for centimetres";
    CENTIMETRES_INSTEAD_OF_METRES = "centimetres instead of metres";
    METRES_TAKEN_FOR_MILLIMETRES = "metres taken for millimetres";
    MILLIMETRES_INSTEAD_OF_METRES = "millimetres instead of metres";
    TURNS_INSTEAD_OF_RADIANS = "turns instead of radians";
    RADIANS_TAKEN_FOR_DEGREES_AND_CONVERTED = "radians taken for degrees and converted once more";
    DEGREES_INSTEAD_OF_RADIANS = "degrees instead of radians";
    // engines.rs
    build_with_the_cargo_feature(feature) = "build with the cargo feature \"{feature}\"";
    the_engine_is_asked_for_but_this_build(name) = "the engine \"{name}\" is requested, but this build does not include it";
    // run.rs
    ITS_SHARE_OF_THE_WORK_THAT_WAS_ALLOWED = "the part of the work limit that the diagnosis may use is used up";
    REST_OF_THE_DIAGNOSIS = "rest of the diagnosis";
    WHAT_ORACLE_SAYS = "the data of [[oracle]]";
    // run/reported.rs
    smallest_transmission_angle(dyad) = "smallest transmission angle ({dyad})";
    stroke_of(link) = "stroke of {link}";
    swing_of(link) = "swing of {link}";
    top_speed_of(link) = "largest speed of {link}";
    speed_ratio_of(link, crank) = "mean speed ratio of {link} to {crank}";
    joint_force_in(joint) = "largest force in joint {joint}";
    contact_force_in(name) = "largest force in transmission {name}";
    driving_force_at(joint) = "largest driving force at {joint}";
    driving_torque_at(joint) = "largest driving torque at {joint}";
    driving_power_at(joint) = "largest power of the drive at {joint}";
    extent_of_the_path_of(point, axis) = "extent of the path of {point} along {axis}";
    // run/checks.rs
    REACTIONS_AND_SPEEDS_COME_FROM_THE_ENGINE = "reactions and speeds are read from the engine independently";
    BOTH_FROM_THE_SAME_ACCELERATIONS = "the moments from reactions and from powers use the same accelerations, so their agreement checks the equations of motion and the loop velocities, but not the accelerations";
    driving_moment_from_reactions_and_from_powers(engine) = "driving moment from reactions and from powers ({engine})";
    AN_OPENING_IS_ALL_ERROR_IT_MUST = "the gap of an open joint is pure error: it must vanish with the observed order of convergence";
    closure_of_all_joints(engine) = "closure of all joints ({engine})";
    in_at(channel, reference) = "in {channel} at {reference:.3}";
    TWO_SOLVERS_WITHOUT_A_COMMON = "two solvers without a common equation; the error of each is its rounding error plus the integration error found by a run with a smaller tolerance";
    SHAKING_FORCE_AND_MOMENT_FROM_REACTIONS = "shaking force and moment from reactions and from momentum";
    SUMS_OF_AS_MANY_FORCES_AS_THERE = "the rounding error of sums with one force per link";
    BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS = "balancing moment from equilibrium and from powers";
    SUMS_OF_A_FEW_FORCES_AND_POWERS = "the rounding error of sums of a few forces and powers";
    CLOSURE_OF_ALL_JOINTS_2 = "closure of all joints";
    POSITIONS_ARE_GOOD_TO_A_FEW = "positions are accurate to a few units in the last place of the largest coordinate";
    // run/dial.rs
    is_beyond_the_scaled_bound(error, error_2) = "{error} is beyond the scaled bound {error_2}";
    // run/engine_proof.rs
    a_millionth_more_of_gravity(share) = "; increasing gravity and motor torque by a millionth changes the channel by {share:.2} millionths of its scale";
    AT_THE_PACE_OF_ITS_ROUNDS = "at this rate of progress the work limit would not be enough";
    THE_WORK_THAT_WAS_ALLOWED = "the work limit was reached";
    A_FINER_STEP_ADDS_MORE_ROUNDING = "a finer step adds more rounding error than the truncation error that it removes";
    // run/engines.rs
    leave_the_step_to_the_proof(error, sweeps, combined, outcome) = "let the proof choose the step: it chooses {error} s and {sweeps} sweeps, {combined}, and {outcome}";
    extrapolated_times(times) = "extrapolated {times} times";
    the_verdict_there_is(verdict) = "the verdict with these settings is {verdict}";
    NOTHING_IS_PROVEN_THERE_EITHER = "the result with these settings is inconclusive too";
    THE_WORK_ALLOWED_IS_NOT_ENOUGH = "the result with these settings is inconclusive too, because the work limit is reached";
    A_RUN_WITH_A_QUARTER_OF_THE_SWEEPS = "a run with a quarter of the sweeps fails, so the iteration error is unknown";
    NO_FORCE_IS_WANTED_OR_ITS_FORCES = "no force is requested, a method is given, or the default method already gives the engine's own forces";
    WHAT_IT_EXERTS_ITSELF_BESIDE = "the forces that the engine itself exerts, besides those computed from its motion";
    own_forces(engine) = "{engine}, own forces";
    other_settings(engine) = "{engine}, other settings";
    THE_GIVEN_STEP_PROVES_NOTHING = "the result with the given step is inconclusive, so the settings that the proof would choose are tried";
    the_work_that_was_allowed_is_done(error) = "the work limit was reached without a usable run: {error}";
    ITS_ERROR_FROM_ITS_OWN_RUNS = "estimates its error from its own runs";
    FINDS_ITS_SETTINGS_AND_ITS_ERROR = "chooses its settings and estimates its error from its own runs";
    // run/entrants.rs
    BY_VALUE_AND_BY_DERIVATIVE = "judged by value and by derivative, against both sides";
    NONE_CLAIMS_A_WANTED_CHANNEL = "no formula claims a requested channel";
    SOLVED_AT_THEIR_OWN_INSTANTS = "solved at the instants of these numbers";
    THERE_ARE_NONE_OF_WANTED = "no published number belongs to a requested channel";
    THERE_IS_NO_TRIAD_OF_CLASS = "there is no triad of class III";
    OTHERS_THAN_OURS_FOR_ITS_TRIAD = "checks the triad by published methods that the solvers do not use";
    THE_SIDES_DIFFER_BY_USUAL = "the sides differ by usual rounding error only";
    CONDITION_OF_EVERY_POSE = "condition of every pose";
    THE_SIDES_DIFFER_BY_MORE = "the sides differ by more than usual rounding error";
    THE_MOTION_IS_PRESCRIBED = "the motion is prescribed";
    SHOWS_THE_ERROR_THAT_BOTH = "shows the error that both sides share";
    CHECKS_THE_REFERENCE = "checks the reference";
    // run/figures.rs
    ADD_MOTOR_OR_LEAVE_THE_FIGURE = "add `[motor]`, or leave out the figure";
    THE_STEADY_SPEED_NEEDS_A_MOTOR = "the steady speed needs a motor, but the crank has no motor";
    // run/formulas.rs
    first_at(fixed, at, found, significant) = "first at t = {fixed} s, {at}: {found}, the mechanism gives {significant}";
    it_gives(significant) = "it gives {significant}";
    IT_HAS_NO_VALUE = "it has no value";
    cause_not_found(cut) = "cause not found: {cut}";
    cause_perhaps_another(cause, cut) = "cause: {cause}; another cause is possible: {cut}";
    // run/judge.rs
    A_DRIVE_OR_A_LOADED_LINK = "no instant is judged: a drive or a loaded link reverses, an acceleration or its rate jumps, or the motion begins";
    THE_MOTION_CHANGES_WITHIN_A_FRACTION = "the motion changes within a fraction of a step, so runs at such steps cannot show their error";
    // run/memory.rs
    instants_of_channels_need_about(instants, channels, gigabytes) = "{instants} instants of {channels} channels need about {gigabytes} of memory";
    are_allowed(what, gigabytes) = "{what}; {gigabytes} are allowed";
    needs_about_of_memory(what, gigabytes) = "{what} needs about {gigabytes} of memory";
    GIVE_FEWER_ROWS_OR_FEWER = "give fewer rows, or fewer columns";
    // run/methods.rs
    CLASS_III_REACTIONS_BY_THE_GROUP = "class III reactions by the group's linear system";
    CLASS_III_REACTIONS_BY_THE_SINGULAR = "class III reactions by the singular Assur point";
    CLASS_III_BY_CLASS_CHANGE = "class III by class change";
    CLASS_III_BY_CRAMER_RULE = "class III by Cramer's rule";
    TWO_METHODS_WITHOUT_A_COMMON = "two methods without a common equation, each accurate to rounding error";
    // run/options.rs
    choose_one_of(offered) = "choose one of: {offered}";
    there_is_no_route_of_engine(engine, asked) = "engine {engine} has no route (method for the reactions) called \"{asked}\"";
    GIVE_A_WHOLE_NUMBER_GREATER = "give a whole number greater than zero";
    found_but_an_engine_needs(what) = "found 0 {what}, but an engine needs at least one";
    // run/oracle.rs
    KNOWN_TO_BE_WRONG = ", known to be wrong";
    given_found(value, unit, value_2) = "given {value} {unit}, found {value_2:.10}";
    NAME_A_LINK_POINT_OR_JOINT = "name a link, point or joint of this scenario";
    oracle_there_is_no_channel(oracle, channel) = "oracle {oracle}: there is no channel {channel}";
    PRINT_THE_INSTANTS_WITH_MORE = "print the instants with more digits, including trailing zeros";
    at_the_rounding_of_the_instant(at) = "at {at} the number deviates by more than a hundredth of the channel's scale; this deviation is within the bound only because the instant is rounded";
    // run/order.rs
    the_runs_converge_with_order(order, error, error_2, formal) = "the runs converge with order {order:.2} at all five steps from {error} to {error_2} s, but the method has order {formal}: the values that were read or computed do not come from this method";
    // run/own_forces.rs
    the_motion_has_taken_the_work(error, error_2) = "the motion cost {error} steps; the forces that the engine exerts need at least as many steps, but the limit for these forces is {error_2} steps";
    // run/planted.rs
    VALUE_DIGITS = "value = 0.26, digits = 2";
    VALUE_DIGITS_2 = "value = 0.25, digits = 2";
    VALUE_DIGITS_3 = "value = 302.6267, digits = 4 },";
    VALUE_DIGITS_4 = "value = 302.6266, digits = 4 },";
    VALUE_DIGITS_5 = "value = 14.33205, digits = 5 },";
    VALUE_DIGITS_6 = "value = 14.33204, digits = 5 },";
    VALUE_DIGITS_7 = "value = 50.000000001, digits = 9";
    VALUE_DIGITS_8 = "value = 50, digits = 9";
    SHAKING_FORCE_AND_MOMENT_FROM_REACTIONS_AND_FROM_MOMENTUM = "shaking force and moment from reactions and from momentum (assur)";
    BALANCING_MOMENT_FROM_EQUILIBRIUM_AND_FROM_POWERS_ASSUR = "balancing moment from equilibrium and from powers (assur)";
    CLOSURE_OF_ALL_JOINTS_ASSUR = "closure of all joints (assur)";
    ASSUR_AGAINST_NEWTON_BALANCING_MOMENT = "assur against newton, balancing_moment";
    ASSUR_AGAINST_NEWTON_REACTIONS = "assur against newton, reactions";
    ASSUR_AGAINST_NEWTON_ACCELERATIONS = "assur against newton, accelerations";
    ASSUR_AGAINST_NEWTON_VELOCITIES = "assur against newton, velocities";
    ASSUR_AGAINST_NEWTON_POSITIONS = "assur against newton, positions";
    // run/runs.rs
    the_run_from_which_the_error(what, message) = "the run {what}, which is needed to estimate the error of the requested run, failed: {message}";
    with_sweeps(sweeps) = "with {sweeps} sweeps";
    // run/settle.rs
    THE_OTHERS_ARE_NOT_CONCLUSIVE = "other channels are not yet conclusive";
    NO_FINER_RUN_BEARS_IT_OUT = "no finer run confirms the disagreement";
    the_first_runs_of_the_engine(error, error_2) = "the first runs of the engine, with all their substeps, cost as much as {error} engine steps of a four-bar; the work limit is {error_2}";
    // run/solved.rs
    CLAIM_A_CHANNEL_OF_THE_SCENARIO = "claim a channel of the scenario";
    NO_CLAIMED_CHANNEL_WAS_SOLVED = "none of the channels that the formulas claim was solved";
    ADD_CHANNEL_TO_A_FORMULA = "add `channel` to a [[formula]], or give a formula as an argument; docs/formulas.md has examples";
    no_formula_of_the_scenario(scenario) = "no formula of the scenario {scenario} claims a channel";
    // tables.rs
    GIVE_A_TABLE_WITH_A_HEADER = "give a table with a header and one row per instant";
    has_no_rows_of_numbers(path) = "{path} has no rows of numbers";
    WRITE_IT_TO_A_FILE_FIRST = "write the table to a file first, because a Parquet file is read from its end";
    the_table_is_a_parquet_file(path) = "the table {path} is a Parquet file that comes through a pipe";
    BUILD_WITH_THE_FEATURE_PARQUET = "build with the feature `parquet`, or write the table as CSV";
    the_table_is_a_parquet_file_which_this_build(path) = "the table {path} is a Parquet file, which this build does not read";
    // tables/held.rs
    its_columns_are_backquotes_hold(some) = "its columns are {some}; put a name with blanks or signs in backquotes";
    did_you_mean(near) = "did you mean `{near}`?";
    the_table_has_no_column(name) = "the table has no column `{name}`";
    else_leave_the_row_out_or_its_cell(help) = "{help}; otherwise leave out the row, or leave its cell empty";
    and_more(shown, more) = "{shown} and {more} more";
    compare_by_or_map_a_column(has, lacks) = "compare by {has}, or map a column to {lacks}";
    the_rows_of_a_table_have_and_no(has, lacks) = "the rows of a table have {has}, but no {lacks}";
    MAP_COLUMNS_TO_CHANNELS_SUCH_AS_PHI3 = "map columns to channels, such as phi3*180/pi=link.rocker.angle_deg";
    no_column_of_the_table_is_a_channel(some) = "no column of the table is a channel; its columns are {some}";
    MAP_A_COLUMN_TO_TIME_TIME = "map a column to time_s, time_ms, crank_deg, joint_deg or slide_mm, such as time=time_s";
    nothing_says_where_the_rows(some) = "the table has no column of times or crank angles; its columns are {some}";
    TAKE_THE_ROW_OUT_OR_COMPLETE = "remove the row, or complete it";
    holds_at_no_instant_is_no_number(raw, mapped) = "{raw} has no instant: the value of `{mapped}` in this row is not a number";
    MAP_A_TIME = "map a time";
    THIS_IS_NO_INSTANT = "this is not an instant";
    // tables/parquet_file.rs
    A_COLUMN_HAS_FEWER_VALUES = "a column has fewer values than it announces";
    A_COLUMN_HAS_FEWER_VALUES_THAN_THERE = "a column has fewer values than there are rows";
    it_has_values_more_than(values, most) = "it has {values} values, but the limit is {most}";
    ITS_GROUPS_HAVE_OTHER_ROWS = "the row groups have a different number of rows than the file announces";
    its_columns_are_compressed_with_which_is_not_read(name) = "its columns are compressed with {name}, which is not read here";
    the_table(path, message) = "the table {path}: {message}";
    ITS_PARTS_CONTRADICT_EACH_OTHER = "the parts of the file contradict each other";
    WRITE_IT_AGAIN_AS_PARQUET = "write the table again, as Parquet or as CSV";
    the_table_is_cut_off_or_damaged(path, error) = "the table {path} is cut off or damaged: {error}";
    // tables/parquet_file/announced.rs
    a_page_holds_more_than_the_bytes(held) = "a page holds more than the {held} bytes that it announces";
    a_page_announces_bytes_such_a_page(held, most) = "a page announces {held} bytes; the limit for this kind of page is {most}";
    a_dictionary_of_bytes_has_values(held, count) = "a dictionary of {held} bytes has {count} values";
    its_pages_have_more_values(rows) = "its pages have more values than the {rows} rows of their group";
    A_PAGE_IS_LONGER_THAN_ITS_COLUMN = "a page is longer than its column";
    A_PAGE_HAS_NO_SIZE = "a page has no size";
    THE_SIZE_OF_A_PAGE_IS_NO_NUMBER = "the size of a page is not a number";
    a_page_announces_bytes(number) = "invalid page header: {number}";
    more_than_of_its_columns(deepest) = "the columns are nested more than {deepest} levels deep";
    IT_ANNOUNCES_COLUMNS_THAT_ARE_NOT_THERE = "the file announces columns that do not exist";
    ITS_END_IS_NOT_THAT_OF_A_PARQUET = "the file does not end like a Parquet file";
    // tables/parquet_file/thrift.rs
    IT_HAS_A_NUMBER_WITHOUT_AN_END = "the file has an unterminated number";
    it_is_described_by_more_than_parts(most) = "the description of the file has more than {most} parts";
    it_has_a_part_of_the_unknown(kind) = "the file has a part of the unknown kind {kind}";
    more_than_of_its_parts_are_within(deepest) = "the parts of the file are nested more than {deepest} levels deep";
    // tables/source.rs
    GIVE_A_SCENARIO_TOML_A_RECORDING = "give a scenario (.toml), a recording (.mcap), a table of text (.csv) or a Parquet file";
    the_table_cannot_be_read(path, error) = "the table {path} cannot be read: {error}";
    // tolerance.rs
    rounding_passed_through_its_operations(origin, error) = "{origin}: {error} rounding error, propagated through its operations, and the uncertainty of the side";
    THE_ERROR_THAT_THE_FORMULA = "the error that the formula claims, the formula's";
    of_the_bound_for_the_rounding(instant) = "; {instant} of the bound covers the rounding of the instant";
    with_decimals(origin, digits, source) = "{origin} with {digits} decimals: {source}";
    truncation_at_resolutions_and_safety(origin, order, resolution, resolution_2, resolution_3, safety, discretisation, iteration, rounding, noise, reference) = "{origin}: truncation, {order} at resolutions {resolution}, {resolution_2} and {resolution_3}, safety factor {safety}; discretisation {discretisation}, iteration {iteration}, rounding {rounding} ({noise}), reference {reference}";
    observed_order_formal(observed, formal) = "observed order {observed:.2} (formal {formal})";
    below_round_off_order_assumed(formal) = "below round-off, order {formal} assumed";
    // compare.rs
    NAME_A_SIDE_THAT_BOTH_HAVE_SUCH_AS_REFERENCE = "name a side that both parties have, such as reference";
    and_have_no_side_of_the_same(names, names_2) = "{names} and {names_2} have no side of the same name";
    it_has(choice) = "it has: {choice}";
    a_recording_has_no_side(side) = "a recording has no side {side}";
    // compare/align.rs
    ALLOW_INTERPOLATION_OR_GIVE_BOTH = "allow interpolation, or give both parties the same instants; check the units of the instants";
    of_the_second_party_is_one_of_the_first(which, what) = "{which} {what} of the second party is also in the first party";
    the_rows_of_the_parties_have_different_inputs(one, other) = "the rows of one party have a {one}, the rows of the other party a {other}";
    MAP_THE_INSTANTS_OF_BOTH_TO_THE_SAME_INPUT = "map the instants of both parties to the same input, or to times";
    MAP_THE_COLUMNS_OF_BOTH_TO_THE_SAME = "map the columns of both parties to the same channels";
    the_two_have_no_channel_in_common(some, some_2) = "the two parties have no channel in common: {some} against {some_2}";
    // compare/allowed.rs
    name_one_of_them_a_subject(all) = "name one of them ({all}, ...), a subject or a stage";
    no_channel_that_is_compared(word) = "no compared channel is called {word}";
    // compare/analytic_party.rs
    the_instants_of_the_other(message) = "the instants of the other party: {message}";
    CHECK_THE_UNIT_OF_THE_INSTANTS = "check the unit of the instants, and where they begin";
    GIVE_THE_TABLE_A_COLUMN_OF_TIMES = "give the table a column of times";
    COMPARE_THE_SAME_MECHANISM_OR_MAP = "compare the same mechanism, or map columns to channels of the scenario";
    the_scenario_has_no_channel(scenario) = "the scenario {scenario} has no channel in common with the other party";
    NAME_A_CHANNEL_A_SUBJECT = "name a channel, a subject or a stage that both parties have";
    no_channel_that_both_have_is_called(how) = "no common channel is called {how}";
    comparing_rows(at) = "comparing {at} rows";
    // compare/cause.rs
    THE_OTHER_PARTY = "the other party";
    THE_ANALYTIC_SIDES = "the analytic sides";
    // compare/judge.rs
    first_at_against(when, told, told_2, way_out) = "first at {when}: {told} against {told_2}{way_out}";
    LEAVE_A_CELL_EMPTY_WHERE = "; leave a cell empty where there is no measured value";
    GIVE_MORE_DIGITS_OR_CLOSER = "give more digits or closer instants, or state the allowed difference";
    the_numbers_are_known_to_of_their(scale) = "the numbers are known only to {scale} of their scale, limited by digits, instants or interpolation";
    SAY_WHAT_DIFFERENCE_IS_ALLOWED = "state the allowed difference";
    they_differ_by_up_to_and_neither(largest) = "the parties differ by up to {largest}, but neither is analytic, so no bound is known";
    AT_NO_INSTANT_DO_BOTH_HAVE_A_NUMBER = "there is no instant at which both parties have a number";
    // compare/pair.rs
    the_inputs_differ_and_neither(noun) = "the {noun}s differ, but neither party is analytic: state the allowed difference of the channel crank";
    BOTH_ARE_SAID_TO_COUNT_THE_CRANK = "both parties are declared to measure the crank angle alike; the bound allows for digits, rounding error and integration error";
    // mark/answers.rs
    in_the_file(file, message) = "{file}: {message}";
    the_answers_belong_to_another_sheet(file, found, expected) = "{file} has the answers to sheet {found}; expected sheet {expected}";
    PUT_THE_ANSWERS_INTO_THE_FILE_OF_THEIR_SHEET = "each student has a separate sheet in each exercise: name the directory of the exercise to which the answers belong, or move the answers to the file of their sheet";
    the_sheet_does_not_ask_for(file, line, column, name) = "{file}, line {line}, column {column}: the sheet does not ask for \"{name}\"";
    the_column_is_there_twice(file, line, column, name) = "{file}, line {line}, column {column}: the column \"{name}\" occurs twice";
    LEAVE_ONE_OF_THE_TWO_COLUMNS = "keep one of the two columns";
    the_first_column_is_not(file, line, expected, found) = "{file}, line {line}, column 1: expected the column \"{expected}\", found \"{found}\"";
    KEEP_THE_HEADER_OF_THE_SHEET = "keep the header of the answer sheet; the first column has the positions of the crank";
    the_column_is_missing(file, line, name) = "{file}, line {line}: the column \"{name}\" is missing";
    KEEP_ALL_COLUMNS_AND_LEAVE_CELLS_EMPTY = "keep all columns of the answer sheet; a cell without an answer stays empty";
    the_row_has_more_cells(file, line, found, expected) = "{file}, line {line}: the row has {found} cells, but the header has {expected}";
    SEPARATE_CELLS_BY_SEMICOLONS = "separate the cells by semicolons if decimals have a comma, or write decimals with a point";
    the_row_is_for_no_position(file, line, found, key) = "{file}, line {line}, column 1 ({key}): the sheet does not ask for the position \"{found}\"";
    the_sheet_asks_for_the_positions(positions) = "the sheet asks for the positions {positions}; put the answers to another sheet into the file of that sheet";
    the_position_is_there_twice(file, line, position, first) = "{file}, line {line}: the position {position} occurs twice, first in line {first}";
    LEAVE_ONE_ROW_FOR_EACH_POSITION = "keep one row for each position";
    the_cell_is_no_number(file, line, column, name, text) = "{file}, line {line}, column {column} ({name}): expected a number, found \"{text}\"";
    WRITE_ONE_NUMBER_WITHOUT_ITS_UNIT = "write one number without its unit; leave the cell empty if it has no answer";
    // mark/question.rs
    no_answer_is_called(name) = "this mechanism has no answer called \"{name}\"";
    // mark/sheet.rs
    AN_ANSWER_IS_MISSING = "an answer is missing in the solution";
    the_sides_disagree_in(name, by) = "the two analytic sides disagree in {name}, by {by}";
    PROVE_THE_SCENARIO_FIRST = "prove the scenario first, and ask for positions that are farther from singular poses";
}
