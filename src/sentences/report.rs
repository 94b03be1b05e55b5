//! Sentences of reports, and of proofs in test suites.

linkage::sentences! {
    // testing.rs
    GIVE_EVERY_INSTANT_ONCE_CRANK = "give every instant only once, as a crank angle (rad) or as a time (s)";
    the_grid_cannot_be(message) = "invalid grid: {message}";
    GIVE_A_NUMBER_BETWEEN_AND_SUCH_AS = "give a number between 0 and 1, such as 1e-2";
    found_as_tolerance_but_this_is_a_share(share) = "found tolerance {share}, but a tolerance is a fraction of a channel's scale";
    is_not_proven(scenario, word, proof) = "{scenario} is not proven: {word}\n\n{proof}";
    // testing/folder.rs
    is_to_be_ignored_but_no_scenario(own) = "\"{own}\" is listed as ignored, but no scenario has this name";
    THERE_IS_NO_SCENARIO_TOML = "there is no scenario (*.toml) in this folder";
    // plain/errors.rs
    also_in_places(times, place, lines) = "\n   = note: the same mistake {times}, in {place} {lines}";
    // plain/brief.rs
    step_ms(numbers) = "step {numbers} ms";
    of_numbers_are_open(open, all) = "{open} of {all} results could not be decided";
    NO_RUN_STANDS = "no engine run could be judged";
    of_numbers_differ(wrong, all) = "{wrong} of {all} results disagree";
    channels_and_checks(channels, quantities, checks) = "{channels} {quantities} agree, {checks} checks passed";
    // plain/cells.rs
    and_more_2(named, more) = "{named} and {more} more";
    // plain/diagnosis.rs
    place_of_on(joint, link, axis) = "position of {joint} on {link}, {axis}";
    INERTIA_OF_ROTOR_AND_REDUCER = "inertia of rotor and reducer";
    MOMENT_OF_THE_MOTOR = "moment of the motor";
    speed_at_at(joint) = "speed at {joint} at t = 0";
    angle_of_the_drive_at_at(joint) = "angle of the drive at {joint} at t = 0";
    lift_of_cam(name) = "lift of cam {name}";
    ratio_of_transmission(name) = "ratio of transmission {name}";
    pressure_angle_of_transmission(name) = "pressure angle of transmission {name}";
    axis_of_on(joint, link) = "axis of joint {joint} on {link}";
    start_of_transmission(name) = "start of transmission {name} at t = 0";
    at_the_motor_shaft(of) = "{of} at the motor's shaft, before the reducer, instead of at the crank";
    speed_of_the_drive_at(joint) = "speed of the drive at {joint}";
    another_configuration_of(group) = "another configuration of {group}";
    free_length_of_load_spring(number) = "free length of load {number}, spring";
    mass_centre_of(link, axis) = "mass centre of {link}, {axis}";
    mass_centre_of_2(link) = "mass centre of {link}";
    distance_of_and_on(one, other, link) = "distance of {one} and {other} on {link}";
    inertia_forces_of(link) = "inertia forces of {link}";
    weight_of(link) = "weight of {link}";
    mass_and_inertia_of(link) = "mass and inertia of {link}";
    mass_of(link) = "mass of {link}";
    moment_of_inertia_of(link) = "moment of inertia of {link}";
    MASSES_OF_ALL_LINKS = "masses of all links";
    MOMENTS_OF_INERTIA_OF_ALL = "moments of inertia of all links";
    INERTIA_FORCES_OF_ALL_LINKS = "inertia forces of all links";
    instead_of(found, given) = "{found} instead of {given}";
    AND_EXCHANGED = "x and y exchanged";
    taken_about_joint_instead_of_the_mass(joint) = "taken about joint {joint} instead of the mass centre";
    turned_by_deg(number) = "turned by {number} deg";
    in_the_middle_of_and(one, other) = "midway between {one} and {other}";
    mirrored_at_the_line_of_and(one, other) = "mirrored about the line through {one} and {other}";
    measured_from_the_wrong_end(one, other) = "measured from the wrong end, {one} and {other} exchanged";
    at_point(point) = "at point {point}";
    at_joint(joint) = "at joint {joint}";
    times_as_large(number, told) = "{number} times as large, {told}";
    OF_THE_OPPOSITE_SIGN = "of the opposite sign";
    the_error_has_no_order_at_most(percent) = "the error looks random, at most {percent} of the scale: noise, or values passed on with few digits";
    the_error_is_smooth_at_most(percent) = "the error is smooth, at most {percent} of the scale: integration error or time step";
    the_error_grows_with_time(how) = "the error grows with time{how}: integration error or time step";
    about_with_its_power_of(power) = ", roughly with the power {power} of time";
    ABOUT_IN_PROPORTION_TO_IT = ", roughly in proportion";
    THE_ROW_AND_THE_ONE_BEHIND = "the row and the next one";
    THE_ROW_AND_THE_ONE_BEFORE = "the row and the previous one";
    rows_before_and_behind(rows) = "{rows} rows before and after";
    THE_ROW_BEFORE_AND_THE_ONE_BEHIND = "the previous and the next row";
    rates_per_radian_of_the_crank(of) = "rates per radian of the crank instead of per second in {of}";
    from_its_sine_beyond_a_quarter(of) = "{of} computed as an arc sine: angles beyond 90 deg are folded back";
    the_sign_of_is_lost(of) = "the sign of {of} is lost";
    zero_instead_of(of) = "zero instead of {of}";
    half_the_values_of(of) = "half the values of {of}";
    twice_the_values_of(of) = "twice the values of {of}";
    half_turns_too_much_or_too(of) = "half turns too many or too few in {of}, as from an arc tangent of a quotient";
    whole_turns_too_much_or_too(of) = "whole turns too many or too few in {of}";
    the_opposite_sign_of(of) = "the opposite sign of {of}";
    times_the_values_of(number, of) = "{number} times the values of {of}";
    less_and_more_in_place_of_counted(first, second, amount, of) = "{first} minus {second} plus {amount} instead of {of}: measured from another link";
    less_in_place_of_counted(first, second, of) = "{first} minus {second} instead of {of}: measured from another link";
    and_exchanged_2(one, other) = "{one} and {other} exchanged";
    the_clock_of_all_rows_is_too(how, by) = "the clock runs too {how}: in every row, the stated time is {by} times the time at which the values occur";
    another_unit_of_time_times(told, number) = "time in another unit: {told}, {number} times the time of a row";
    one_row_alone_at_in_an_outlier(number, of) = "one row alone, at t = {number} s, in {of}: an outlier";
    about_instead_of(of, to, from) = "{of} taken about {to} instead of {from}";
    about_instead_of_the_origin(of, to) = "{of} taken about {to} instead of the origin";
    about_another_point_by_away(of, number, number_2) = "{of} taken about another point, ({number}, {number_2}) m away";
    the_coriolis_acceleration_of_the_block(joint, of) = "the Coriolis acceleration of the block at {joint} is missing in {of}";
    differences_of_over_or_such_of_its_like(order, other, over, of) = "{order}finite differences, such as those of {other}, over {over} instead of {of}: use a finer row spacing";
    the_magnitude_of_and_in_place(one, other, of) = "the magnitude of {one} and {other} instead of {of}";
    the_values_of_with_the_opposite(other, of) = "the values of {other} with the opposite sign instead of {of}";
    the_values_of_in_place_of(other, of) = "the values of {other} instead of {of}";
    counted_the_other_way_round(of, amount) = "{of} measured in the opposite sense and from another axis: {amount} minus the correct value";
    added_at_every_instant_to(amount, of) = "{amount} added at every instant to {of}";
    another_unit_in(told, of) = "another unit in {of}: {told}";
    and_later_in_more(more) = " and later in {more} more";
    from_in(fixed, at, channel) = "; from {fixed} s, {at}, in {channel}";
    at_time_first_in(fixed, at, names) = "t = {fixed} s, {at}, first in {names}";
    cannot_be_told_differ(pairs) = "cannot be decided: {pairs} differ";
    nobody_stand_against(one, other) = "no single party: the parties {one} disagree with {other}";
    all_others_agree_with_each(name) = "{name}; all other parties agree with each other";
    NOBODY_EACH_IS_WITHIN_THE_BOUNDS = "no party: any two parties agree within their bounds";
    which_explains_as_much(cause) = "{cause}: an equally good explanation";
    no_single_one_a_part_is_explained(cause) = "no single cause found; this cause explains a part of the difference: {cause}";
    that_explains_all_to_within(cause, wrong) = "{cause}; this explains all {wrong} to within their bounds";
    nothing_simple_changed_cases_and_all(solved) = "not found: neither {solved} modified cases nor any simple slip explains the difference";
    diagnosis_of(suspect) = "Diagnosis of {suspect}:";
    THE_SEARCH_FOR_A_CAUSE_ENDED = "The search for a cause reached its work limit before all causes were tried: allow more work.";
    // plain/engines.rs
    THE_MOTION_AGREES_AND_THE_FORCES = "The motion agrees, but both sets of forces disagree: those computed from the motion and those that the engine exerts.";
    THE_ENGINE_MOTION_AND_THE_FORCES = "The engine's motion and the forces computed from it agree. The forces that the engine itself exerts are wrong, or are read wrongly.";
    THE_ENGINE_MOTION_AND_THE_FORCES_THAT_IT_EXERTS = "The engine's motion and the forces that it exerts agree. The forces computed from this motion with the Newton-Euler equations are wrong.";
    channels_at_most(own, own_2, numbers) = "{own} channels {own_2}, the worst: {numbers}";
    of_in(error, bound, channel) = "{error} with a bound of {bound} in {channel}";
    in_channels_no_single_one_stands(count, channel, pairs) = "In {count} channels the disagreement cannot be assigned to one party. In the first, {channel}, {pairs} differ.";
    the_odd_one_out_in_channels(alone, party, channel) = "{party} alone disagrees with all others in {alone} channels, first in {channel}.";
    NO_TWO_OF_THEM_DIFFER_BY_MORE = "Any two of these parties differ by at most the sum of their bounds.";
    // plain/judged.rs
    THE_ENGINE_OWN_FORCES = "the forces that the engine itself exerts";
    forces_as_itself_exerts_them_2(info) = "the forces that {info} itself exerts";
    AS_THE_ENGINE_EXERTS_IT = " as the engine exerts it";
    // plain/reasons.rs
    it_rests(what, name, count, all, at, least, most) = "{what} {name} rests at {count} of {all} instants, and its friction is taken as zero there. At {at}, the friction at rest allows any moment or force of the drive from {least} to {most}.";
    the_follower_leaves_the_cam(name, count, all, at) = "The follower leaves cam \"{name}\": the force between them is negative at {count} of {all} instants, first at {at}. A stronger spring or a groove must hold it.";
    up_to_of_instants_are_not_judged(most, proof, quantities, info) = "Up to {most} of {proof} instants are not judged in {quantities} ({info}): a drive or a loaded link reverses there, an acceleration or its rate jumps, the mechanism passes a change point, or the motion begins.";
    checks_disagree_as_expected_see(count, told) = "\n{count} checks disagree as expected, see\n  {told}";
    and_more_3(open, tell) = "\n... and {open} more ({tell})";
    // report/accept.rs
    and_more_4(names, more) = "{names}, and {more} more";
    its_bound_was_now(channel, accepted, unit, found) = "\n{channel}: its bound was {accepted} {unit}, now {found}";
    and_more_channels_the_json(worst) = "... and {worst} more channels; the JSON lists all of them.";
    ACCEPTED_WITHIN_TIMES_THE_BOUND = "accepted with a bound at least 100 times larger than now";
    KNOWN_TIMES_WORSE_OR_MORE = "with a bound at least 100 times larger than accepted";
    THERE_IS_NO_FIGURE = "there are no figures to compare";
    ITS_INSTANTS_ARE_OTHERS_VALUES = "the instants differ from the accepted ones, so values are not compared";
    the_proof_was_accepted_as_and(accepted, now) = "the verdict was accepted as {accepted} and {now}";
    accepted_in(name, all, file) = "{name}: accepted, {all} in {file}.";
    not_accepted_the_proof_is(name, item) = "{name}: not accepted, the verdict is {item}.";
    nothing_has_moved_stays_as_it_is(name, file, all) = "{name}: all figures are unchanged, {file} stays as it is ({all}).";
    accepted_anew_in(name, file, counts) = "{name}: new figures accepted in {file}: {counts}.";
    disagree_is_not_as_accepted(name, file, counts) = "DISAGREE: {name} differs from the figures accepted in {file}: {counts}.";
    inconclusive_is_not_proven_to_be_as_accepted(name, file, counts) = "INCONCLUSIVE: it is undecided whether {name} matches the figures accepted in {file}: {counts}.";
    agree_is_as_accepted_in_within(name, file, all) = "AGREE: {name} matches the figures accepted in {file}, {all} within their bounds.";
    have_no_finite_bound_and_no_figures(channels) = "{channels} have no figures, because their bounds are not finite.";
    // report/bearings.rs
    work_of_the_drives(drive, lost) = "work of the drives over the grid {drive}, of which friction takes {lost}";
    efficiency_over_the_grid(efficiency) = "efficiency over the grid {efficiency}";
    journals_lever_mm_bending_stress(lever_mm, stress_mpa) = "\njournals: lever {lever_mm} mm, bending stress {stress_mpa} MPa";
    largest_at(name, value, at) = "largest {name:16} {value} at {at}";
    // report/bench.rs
    SIDE_ASSUR = "side 1 (assur)";
    finer_settings_were_not_run(left_out) = "\n{left_out} finer settings were not run: the work limit was reached.";
    judged_in_part_times(times, gap) = "\npartly judged {times} times: {gap}";
    failed_times(times, reason) = "\nfailed {times} times: {reason}";
    other_programs_at(within, told) = "  fastest other program with an error of at most {within}: {told}";
    the_reference_is_known_to(stage, floor) = "\n{stage}: error of the reference {floor}";
    THE_FRONTS_WHAT_NOTHING_BEATS = "Pareto fronts: first of all programs, then of engines and peers only.";
    settings_on_instants_failed_times(settings, instants, failed, reference) = "{settings} settings on {instants} instants, {failed} failed; times relative to side 1 (assur). Reference: {reference}.";
    AT_THE_FLOOR = "below the reference's error";
    // report/bench_page.rs
    finer_settings_were_not_run_the_work(left_out) = "- {left_out} finer settings were not run: the work limit was reached.";
    judged_in_part_times_2(times, foreign) = "- Partly judged {times} times: {foreign}";
    failed_times_2(times, foreign) = "- Failed {times} times: {foreign}";
    of_engines_and_peers(of_others) = "  Front of engines and peers only: {of_others}.";
    front_of(stage, told) = "- Front of {stage}: {told}.";
    settings_on_instants_failed_diagram(bench, instants, failed, pictures, name) = "{bench} settings on {instants} instants, {failed} failed. [Diagram]({pictures}{name}.time.svg), [numbers]({pictures}{name}.csv).\n";
    // report/bench_plot.rs
    and_more_reasons_see_the_table(left) = "and {left} more reasons: see the table";
    in_part(times, text) = "partly judged {times}: {text}";
    ERRORS_LARGEST_OVER_INSTANTS_AND_CHANNELS = "Error: largest over instants and channels, as a fraction of the channel's scale.";
    CROSS_IN_THE_BAND_ABOVE_FAILED = "Cross in the band at the top: failed.";
    hollow_less_than_times_above(clear) = "Hollow mark: error less than {clear} times the reference's error (dashed line), so limited by the reference.";
    grey_line_the_reference_own(basis) = "Grey line: the reference's own error ({basis}).";
    LINE_WHAT_NO_OTHER_SETTING = "Line: Pareto front of one program. Ring: on the Pareto front of all programs, or on that of engines and peers only.";
    IT_COUNTS_NONE_OF_THESE = "; does not report this cost";
    BALANCING_MOMENT_SHAKING_FORCE_AND_MOMENT = "balancing moment, shaking force and moment";
    NO_SETTING_THAT_ANSWERED_COUNTS = "no successful setting reports this cost";
    SWEEPS_FACTORISATIONS_ITERATIONS_OR_GROUPS = "number of inner operations: sweeps, factorisations, iterations or placed groups";
    EVALUATIONS_OR_STEPS_AND_PROBES = "number of solutions of the mechanism: evaluations, steps and probes, or poses";
    processor_time_over_that_of_side_assur(own_ms, motion_s) = "processor time / that of side 1 (assur: {own_ms} ms for {motion_s} s of motion)";
    PROCESSOR_TIME = "processor time";
    NUMBER_OF_SOLUTIONS = "number of solutions";
    NUMBER_OF_INNER_OPERATIONS = "number of inner operations";
    error_against(name, cost, about) = "{name}: largest error of every setting over its {cost}. {about}";
    // report/chart.rs
    LARGEST_ERROR_OVER_THE_SCALE = "largest error / scale of its channel";
    nothing_to_draw(why) = "no data to draw: {why}";
    // report/check.rs
    FOR_THE_MOST_PART = "for the most part";
    A_MISSING_TERM = "a missing term";
    A_MISSING_FACTOR = "a missing factor";
    the_of(order) = "the {order} of ";
    formula_mechanism(word, place, found, right) = "  {word:6} {place}: formula {found}, mechanism {right}";
    at_instant(at, fixed) = "{at}, t = {fixed} s";
    is_not(of, claim, side) = "  is not {of}{claim} ({side})";
    in_the_step(cause, step) = "{cause}, in {step}";
    is_wrong_as_the_finding_says(name, place) = "{name}: wrong as printed, see {place}";
    agrees_although_the_finding(name, place) = "{name} agrees with the mechanism, although {place} calls it wrong: correct the finding or the formula";
    and_wrong_as_printed(right, wrong) = "{right} right and {wrong} wrong as printed";
    SOMETHING_IS_OPEN = "not all formulas could be decided";
    of_wrong(names, counted) = "{names} of {counted} wrong";
    and_contradict_each_other(first, second) = "{first} and {second} disagree with each other";
    at_and(claims, instants, first, second) = "{claims} at {instants} ({first}, {second})";
    all_right(claims) = "{claims} right";
    CAUSE_NONE_THAT_IS_SIMPLE = "  cause  not found: no single slip, offset, factor or missing term explains it.";
    cause_not_found(cut) = "  cause  not found: {cut}.";
    cause_with_that_nothing_is_left(found) = "  cause  {found}.\n         This explains the whole difference.";
    cause_perhaps_another(found, cut) = "  cause  {found}.\n         Another cause is possible: {cut}.";
    // report/clearance.rs
    poses_and_distances_of_convex(word, poses, distances, positions, squares) = "{word}: computed {poses} poses and {distances} distances between convex parts; for swept areas {positions} poses and {squares} tests of squares\n";
    first_nearer_than_the_mm(millimetres) = "first closer than the required {millimetres} mm";
    and_at_place(what, one, two, at, place) = "{what}: {one} and {two} at {at}, position {place} mm";
    not_proven_from_to(from, to, why) = "not proven from {from} to {to}: {why}";
    THE_MECHANISM_IS_SINGULAR_THERE = "the mechanism is singular there, or the work limit was reached";
    the_area_of_is_known_to_only_the_work(name, numbers) = "the area of {name} is known only to {numbers}: the work limit was reached";
    no_distance_is_smaller_by_more(numbers) = "the true distances are smaller than these by at most {numbers} mm";
    NO_TWO_BODIES_CAN_MEET_ALL = "no two bodies can meet: all links are joined, and there is no housing\n";
    clearance_over_to(scenario, scenario_2, noun, from, to) = "{scenario}: {scenario_2}\n\nclearance over {noun}s {from} to {to}\n";
    // report/closed_form.rs
    time_ratio(time_ratio) = "  time ratio    {time_ratio:.6}";
    pressure_deg_at_most_between_rod(found) = "  pressure      {found:.4} deg at most, between the rod and the slider's line";
    crank_slider(name, fixed_in, fixed_in_2) = "  {name:13} crank {fixed_in}, slider {fixed_in_2}";
    crank_rod(crank, rod) = "  crank         {crank:.6} m\n  rod           {rod:.6} m";
    SLIDER_CRANK_FROM_STROKE_AND_OFFSET_2 = "slider-crank from stroke and offset\n";
    time_ratio_mode(time_ratio, found) = "  time ratio    {time_ratio:.6}\n  mode          {found}";
    transmission_deg_at_least_at_crank(transmission, at) = "  transmission  {transmission:.4} deg at least, at crank {at}";
    crank_rocker(name, crank, rocker) = "  {name:13} crank {crank}, rocker {rocker}";
    crank_oa_coupler_ab_rocker(crank, coupler, rocker) = "  crank OA      {crank:.6} m\n  coupler AB    {coupler:.6} m\n  rocker CB     {rocker:.6} m";
    CRANK_ROCKER_FROM_TWO_EXTREME_POSITIONS = "crank-rocker from two extreme positions\n";
    proof_of_the_scenario(proof) = "  proof         {proof}";
    // report/diagram.rs
    construction_scale_of_time(sort, scale) = "\nconstruction by {sort}   mu_t = {scale} s/mm";
    rays_from_the_pole(method, from, given, unit, to, pole, scale, unit_2) = "\n{method}   mu_{from} = {given} {unit}, pole distance H = {pole} mm, mu_{to} = {scale} {unit_2}";
    areas_of_width(method, from, given, unit, to, pole, scale, unit_2) = "\n{method}   mu_{from} = {given} {unit}, 1 mm of ordinate for {pole} mm², mu_{to} = {scale} {unit_2}";
    orders_of_the_rms_error_from_to_and_from_to_divisions(n, n_2, n_3, n_4) = "\norder: observed order of convergence of the rms error, from {n} to {n_2} and from {n_3} to {n_4} divisions";
    OF_HALF_RANGE = "of half range";
    half_range(channel, half, unit) = "  {channel:28} half range {half:>10} {unit}";
    over_one_turn_in_divisions(scenario, course, range, divisions) = "{scenario}: {course} over {range} in {divisions} divisions";
    // report/drive.rs
    motor_against_reactions_of_the_largest(error) = "; motor moment and moment from the reactions differ by {error} of the largest moment";
    run_up_at_a_limit_of_rotation(t, degrees) = "run-up: ends at a limit of rotation at {t:.6} s, crank angle {degrees}";
    run_up_held_at_crank_angle(t, degrees) = "run-up: stalls at {t:.6} s, crank angle {degrees}";
    RUN_UP_FOLLOWED_TO_ITS_END = "run-up completed";
    THE_SCENARIO_HAS_NO_MOTOR = "the scenario has no motor";
    slowest_fastest(at, at_2) = "  slowest   {at}\n  fastest   {at_2}";
    at_start_rad(start_speed) = "  at start  {start_speed:.6} rad/s";
    mean_rad_period(mean_speed, period) = "  mean      {mean_speed:.6} rad/s, period {period:.6} s\n";
    flywheel_for_a_non_uniformity(wanted, inertia) = "flywheel for a non-uniformity of {wanted}\n  inertia   {inertia}";
    steady_motion(of_regime) = "steady motion\n{of_regime}";
    time_constant(constant) = "  time constant{constant}";
    NONE_THE_MOTOR_LAW_IS_NOT_ONE_STRAIGHT = ": none, the motor characteristic is not a single straight line from standstill";
    averaged_model_crank_rad_motor(crank, motor) = "averaged model\n  crank     {crank:.6} rad/s\n  motor     {motor:.6} rad/s";
    NO_MOTOR_ADD_A_MOTOR_SECTION = "no motor: add a `[motor]` section to get the steady motion\n";
    motor_and_reducer_on_the_crank(added) = "motor and reducer on the crank\n  inertia   {added}";
    least_greatest(end, end_2) = "  least     {end}\n  greatest  {end_2}";
    REDUCED_MOMENT_OF_RESISTANCE = "reduced moment of resistance";
    REDUCED_MOMENT_OF_INERTIA = "reduced moment of inertia";
    // report/drive_graphs.rs
    non_uniformity(regime) = "; non-uniformity {regime:.6}";
    MEAN_OVER_TIME = "mean over time";
    ANGULAR_VELOCITY_OF_THE_CRANK = "angular velocity of the crank in the steady motion";
    over_of_the_crank_in_the_sense(over) = "over {over} of the crank in its sense of motion; I* without motor, reducer and flywheel";
    DERIVATIVE_OF_THE_REDUCED_MOMENT = "derivative of the reduced moment of inertia";
    // report/explain.rs
    NOTHING_ASKED_NEEDS_THEM = "not needed for any requested quantity";
    NOTHING_THAT_IS_COUNTED = "no counted work";
    nothing_asked_depends_on_them(all) = "{all}: not needed for any requested quantity";
    NOTHING_EVERY_PART_OF_THE_MECHANISM = "none: every part of the mechanism is needed";
    at_instants(some, instants) = "{some} at {instants} instants";
    of_everything_at_instants_of_channels(stages, instants, own, all) = "all {stages} at {instants} instants: {own} of {all} channels";
    left_out(left_out) = "left out   {left_out}\n";
    what_ran_how_often_and_why(scenario) = "{scenario}: what ran, how often, and why\n";
    // report/html.rs
    of_instants_evenly_chosen_and_those(shown, all) = "{shown} of {all} instants are shown: evenly spaced ones, and those with the smallest and largest values and errors. All verdicts, errors and bounds refer to all instants.";
    // report/html/findings.rs
    and_more_alike(count) = " (and {count} more for the same reason)";
    of_more_the_channels_and_the_table(all) = "\nThe tables of channels and checks below give {all} more reasons.";
    engines_and_reference_against_each(engines) = "Engines and reference compared with each other: {engines}\n";
    // report/html/loads.rs
    between_and(sort, link, link_2) = "{sort} between {link} and {link_2}";
    from_to(sort, start, end) = "{sort} from {start} to {end}";
    at_on(sort, point, link) = "{sort} at {point} on {link}";
    // report/html/words.rs
    SETTINGS_AND_VERSIONS = "Settings and versions";
    INERTIA_KG = "moment of inertia, kg·m²";
    POINTS_MM_ITS_FRAME = "points (mm, in the link's frame)";
    class_order_mode(links, class, order, pairs, mode) = "{links}: class {class}, order {order}, {pairs}, mode {mode}";
    BASIS_OF_THE_BOUND = "basis of the bound";
    // report/drivers.rs
    STRUCTURE_FOR_OTHER_DRIVEN_JOINTS = "structure for each choice of the joint of the first drive\n";
    a_drawing_shows_one_driver(count) = "the link has {count} joints with the ground, but a drawing shows the groups for one driven joint";
    GIVE_THE_JOINT_INSTEAD = "give the joint instead of the link";
    COLUMNS_OF_DRIVERS = "driving link, joint, class, structure";
    driver_at(links, joint, kind) = "driver     {links} at joint {joint} ({kind})\n";
    not_possible(why) = "not possible: {why}\n";
    A_CHAIN_OF_DYADS = ", a chain of dyads";
    driven_in_the_file(joint, class) = "; driven at joint {joint} as in the file: class {class}";
    class_of_the_mechanism(class, dyads, before) = "class      {class}{dyads}{before}\n";
    structure_and_numbers(formula, numbered, numbers) = "structure  {formula}\n           {numbered}\nlinks      {numbers}\n";
    GROUPS_IN_THE_ORDER_OF_SOLUTION = "\ngroups in the order of solution\n";
    a_group(bodies, class, order, pairs, inner, outer) = "  {bodies}: class {class}, order {order}, {pairs}; inner joints {inner}; outer joints {outer}\n";
    chains_of_dyads(joints) = "a chain of dyads if driven at {joints}\n";
    numbers_of_links(numbers) = "links: {numbers}\n";
    // report/inspect.rs
    from_the_rough_place_the_next(mm, mm_2) = ", {mm} from the approximate position in the file, the next configuration {mm_2}";
    from_the_rough_place(mm) = ", {mm} from the approximate position in the file";
    class_order_mode_2(names, class, order, pairs, mode, transmission, from) = "  {names:28} class {class}, order {order}, {pairs}, mode {mode}{transmission}{from}";
    transmission_angle_deg(sine) = ", transmission angle {sine:.2} deg";
    groups_at_the_start(word, fixed_in) = "\ngroups at the start ({word} {fixed_in}); a mode holds for this order of the links";
    kg_kg(mass, inertia, at) = "m = {mass} kg, J = {inertia} kg·m², {at}";
    NO_CONFIGURATION_CLOSES = "no configuration of the structure closes";
    OR_MORE = " or more";
    a_fixed_structure(links, joints, formula) = "a structure without a drive: mobility 0, {links} moving links, {joints} joints\nformula    {formula}";
    class_and_order(names, class, order, pairs) = "  {names}: class {class}, order {order}, {pairs}";
    configurations_of_the_structure(count, more) = "{count}{more} real configurations";
    mobility_and_given(links, joints, transmissions, mobility, given) = "mobility   W = 3*{links} - 2*{joints}{transmissions} = {mobility}, given coordinates {given}";
    a_transmission(name, kind, first, second, carrier, ratio, radii) = "  {name:14} {kind}, {first} - {second} on {carrier}, ratio {ratio}, {radii}";
    pitch_radii(first, second) = "pitch radii {first} and {second}";
    a_cam(name, kind, first, second, carrier, lift, base, angle, curvature) = "  {name:14} {kind}, {first} - {second} on {carrier}, lift {lift}, base circle {base}, pressure angle up to {angle} deg, {curvature}";
    least_radius_of_curvature(radius) = "least convex radius {radius}";
    the_profile_is_undercut(radius, remedy) = "UNDERCUT by {radius}: {remedy}";
    the_cam_is_undercut(name, radius, remedy) = "The profile of cam \"{name}\" is undercut by {radius} mm and cannot be made: {remedy}.";
    ENLARGE_THE_BASE_CIRCLE = "enlarge the base circle";
    ENLARGE_THE_BASE_CIRCLE_OR_REDUCE_THE_ROLLER = "enlarge the base circle or reduce the roller";
    pitch_radius(first) = "pitch radius {first}";
    structure_links(structure) = "structure  {structure}\n\nlinks";
    // report/json.rs
    NOTHING_LEFT_TO_CHOOSE = "nothing left to choose";
    // report/lists.rs
    along_world(what, axis) = "{what}, along world {axis}";
    on_link(quantity, case) = "{quantity} on link {case}";
    on_the_frame(quantity) = "{quantity} on the frame";
    in_on(quantity, of, joint, joint_2) = "{quantity} in {of}, {joint} on {joint_2}";
    COMPUTED_FROM_CHANNELS = "
Computed from channels, for formulas and tables:
  drive.reduced_inertia_kg_m2, drive.reduced_moment_N_m  reduced to the crank
  link.NAME.dangle_dphi, link.NAME.d2angle_dphi2         transfer functions
  point.NAME.dx_dphi_m, point.NAME.d2x_dphi2_m           of points, also of links
  centre.NAME.NAME.x_m, centre.NAME.NAME.y_m             instant centre of two links
  pole.NAME.x_m, pole.NAME.y_m                           acceleration pole of a link
";
    of_link(quantity, of) = "{quantity} of link {of}";
    no_scenario_files_toml_in(directory) = "no scenario files (.toml) in {directory}";
    cannot_be_read_3(error) = "cannot be read: {error}";
    // report/live.rs
    times_slower_than_the_mechanism(slow, lasts) = "{slow} times slower than the mechanism, restarting every {lasts} s";
    as_fast_as_the_mechanism(lasts) = "as fast as the mechanism, restarting every {lasts} s";
    ONE_INSTANT_AT_REST = "a single instant, a still picture";
    // report/markdown.rs
    and_more_5(all) = "- ... and {all} more";
    CANNOT_BE_PROVEN = "could not be proven";
    // report/modes.rs
    FOLLOWED_BY_THE_SCENARIO = ", chosen by the scenario";
    for_configuration_of(number, names) = "  for configuration {number} of {names}";
    not_decided_by_the_scenario(why) = "  not chosen by the scenario: {why}";
    only_the_followed_one_is_shown(names, why) = "\n{names}: only the configuration chosen by the scenario is shown; {why}";
    real_configurations(names, found) = "\n{names}: {found} real configurations";
    scenario_at(scenario, at) = "{scenario} at {at}\n";
    THE_CONFIGURATION_IS_SINGULAR_ANGULAR = "the configuration is singular: angular velocities are not determined";
    // report/motor_choice.rs
    ratio_efficiency(ratio, efficiency) = "ratio = {ratio}\nefficiency = {efficiency}";
    periodic_crank_rad_non_uniformity(mean, off_mean, unrest) = "  periodic  crank {mean:.6} rad/s ({off_mean:+.2} %), non-uniformity {unrest:.4}";
    rotor_inertia(rotor) = "  rotor     {rotor}";
    ROTOR_WITHOUT_INERTIA = "  rotor     without inertia: the catalogue has no rotor_inertia_kg_m2";
    the_motor_turns_faster_than(speed, synchronous) = "note: the motor reaches {speed}, above its no-load speed {synchronous}: there it brakes the mechanism as a generator";
    the_linear_law_asks_for(torque, share, speed, most) = "note: at {speed} of the motor, the linear law gives {torque}, {share:.1} times the rated torque; the breakdown torque of induction motors is at most {most} times the rated torque: the law describes the stable branch only";
    the_motor_turns_below_breakdown(speed, breakdown) = "note: the motor falls to {speed}, below its breakdown speed {breakdown}: there it stalls under a constant load";
    steady_speed_averaged_crank_rad(averaged, off_averaged, geared_up) = "steady speed\n  averaged  crank {averaged:.6} rad/s ({off_averaged:+.2} % from the required speed), motor {geared_up:.4} rad/s";
    breakdown_of_it(breakdown, breakdown_2, holds) = "  breakdown {breakdown}, {breakdown_2} times the rated torque: {holds}";
    ABOVE_THE_PEAK = "above the peak";
    peak_of_it_without_what_inertia(peak, share) = "  peak      {peak}, {share:.3} of the rated torque, without inertia";
    on_the_motor_shaft_mean_of_the_rated(mean, share) = "on the motor shaft\n  mean      {mean}, {share:.3} of the rated torque";
    ratio_rpm_to_rpm(ratio, rated, turning) = "  ratio     {ratio:.6} ({rated:.0} rpm to {turning:.4} rpm)";
    motor_kw_rpm_synchronous_rpm(name, kilowatts, rated, synchronous, torque) = "motor\n  {name}: {kilowatts} kW, {rated:.0} rpm, synchronous {synchronous:.0} rpm, rated torque {torque}";
    asked_kw_with_an_efficiency(asked, efficiency) = "  required  {asked} at an efficiency of {efficiency}";
    power_peak_at_times_rad_kw(peak, at, wanted, power) = "power\n  peak      {peak} at {at}; multiplied by the required speed of {wanted:.6} rad/s: {power}";
    // report/mutate.rs
    OPEN_IN_THE_TRUNK = "Not found in the code and data that all parties share:";
    NOT_FOUND_IN_ONE_PARTY = "Not found in one party:";
    the_formula_for(formula, wrong, right) = "the formula {formula}, `{wrong}` instead of `{right}`";
    EVERY_COMPARISON_AGREES = "every comparison agrees";
    of_found_inconclusive_escaped_change(found, real, what, part, inconclusive, escaped, equivalent) = "{found} of {real} {what} found ({part}), {inconclusive} inconclusive, {escaped} escaped; {equivalent} without effect";
    in_the_trunk_of_kinds_are_found(found, all, percent) = "; in the code and data that all parties share, independent evidence finds {found} of {all} kinds of fault ({percent})";
    FAULTS_IN_ONE_PARTY = "faults in one party";
    NOTHING_PLANTED_NO_FAULT_OF_THE_KINDS = "NOTHING PLANTED  no fault of the requested kinds changes a result, so detection is not tested";
    LEAST_MARGIN_DIFFERENCE_OVER_ITS_BOUND = "least margin: the smallest ratio of difference to bound over all found faults of a kind in one party or formula; for each fault the channel or check with the largest ratio counts.
found down to: every fault larger than this size is found in every scenario. The size is relative (angles in rad), and known to a factor of two.";
    no_fault_of_the_kinds_asked(name, instead, formulas) = "{name}: no fault of the requested kinds changes a result; kinds that change a result: {instead}{formulas}\n";
    NO_FORMULA_OF_IT_CLAIMS_AN_EXACT = "; no formula of the scenario claims an exact value, so formula faults cannot be planted";
    // report/plan.rs
    omega_rad_alpha_rad(link, name, omega, alpha) = "  {link} {name:14} omega {omega:>10} rad/s   alpha {alpha:>10} rad/s²";
    a_on_the_first_on_the_second(shown, shown_2) = "  a_Σ {shown} m/s² on the first base link, {shown_2} m/s² on the second";
    on_both_base_links(shown) = "  v_Σ {shown} m/s on both base links";
    on_the_base_link(velocity, acceleration) = "  v_Σ {velocity} m/s, a_Σ {acceleration} m/s² on the base link";
    false_position(link, alpha, at) = "  false position for alpha of link {link} = {alpha} rad/s²: a_Σ {at} m/s²";
    lines_of_positions_meet(at, link, alpha) = "  line of false positions and line of true positions meet at {at} m/s²: alpha of link {link} = {alpha} rad/s²";
    turned_by_deg_on_paper(sense) = "on paper, the plan is turned by 90 deg {sense}, against the rotation of the driving link; x and y are values before this turn";
    INSTANT_CENTRES_OF_ALL_PAIRS = "\ninstant centres P of all pairs of links (0 is the ground), acceleration centres π";
    NOWHERE = "nowhere: it translates";
    EVERYWHERE = "everywhere: no motion";
    acceleration_centre_of_link(link) = "acceleration centre of link {link}";
    largest_relative_velocity_at_a_centre(velocity) = "largest difference of the solved velocities of both links at their centre: {velocity} m/s";
    singular_point_of_the_class(class, point, shown) = "\nsingular point of the class {class} group   Σ = {point} at {shown} m";
    singular_point(error) = "\nsingular point: {error}";
    plan_pole_mu_mm(word, plan, symbol, scale, unit) = "\n{word} plan   pole {plan}, mu_{symbol} = {scale} ({unit})/mm";
    kinematic_diagram_mu_mm(scale) = "kinematic diagram   mu_l = {scale} m/mm";
    the_motion_is_free_these(moves, speed, unit) = "the motion is free: these plans show the nominal motion, with the {moves} at {speed} {unit}/s";
    // report/range.rs
    THE_GROUP_IS_SINGULAR_AT_A_LIMIT = "the group is singular at a limit: the condition number is unbounded";
    turns_fully_times(turns) = "turns fully, {turns} times";
    over_deg(swing) = "over {swing:.6} deg";
    DOES_NOT_TURN = "does not turn";
    NO_SINGULAR_POSE_ON_THE_WAY = "No singular pose in the range of motion.\n";
    from_to_in_all(from, to, span, unit) = "from {from} to {to} {unit}, {span} {unit} in all";
    turns_fully_the_mechanism_is_back(turns) = "turns fully; the mechanism returns to its first pose after {turns} turns";
    groups_nearest_to_a_singular(groups) = "Groups at their poses nearest to a singular pose:\n{groups}";
    frame_driving_link_coupler_output(frame, driver, coupler, output) = "           frame {frame:.6} m, driving link {driver:.6} m, coupler {coupler:.6} m, output link {output:.6} m";
    // report/schema.rs
    SCENARIO_OF_LINKPROOF = "Scenario of linkproof";
    // report/sensitivity.rs
    KINK = "kink";
    per_unit(number, unit) = "{number} per {unit}";
    figure_over_all_instants(figure, value) = "{figure} = {value}, over all instants";
    figure_at_instants(figure, value, instants) = "{figure} = {value} at {instants}";
    another_extreme_is_as_large(instant) = "kink: the figure has the same extreme again at {instant}; the derivatives hold only for changes that leave the extreme at the first instant";
    THE_FIGURE_HAS_A_KINK =
        "kink: the figure is the absolute value of zero, the magnitude of a zero vector, or an extreme that several \
         successive instants share";
    further_keys(count) = "{count} further keys: a table (.csv) contains all";
    INSTANTS_KEEP_THEIR_INPUTS = "derivatives at constant inputs of the instants";
    INSTANTS_KEEP_THEIR_TIMES = "derivatives at constant times of the instants";
    worst_case_and_root_sum_square(worst, root) = "tolerances: worst case {worst}, root of the sum of squares {root}";
    deviations(sampled, linear, count, seed) = "standard deviation {sampled} of {count} random mechanisms (seed {seed}), {linear} by linear theory";
    sampled_shift_and_ends(shift, least, greatest) = "random mechanisms: mean shifted by {shift}, from {least} to {greatest}";
    mechanisms_cannot_be_solved(unsolved, count) = "{unsolved} of {count} random mechanisms cannot be solved and are left out";
    linear_theory_holds_below(multiple) = "linear theory holds (to 10 % of the standard deviation) below {multiple} times the tolerances";
    linear_theory_holds_until_unsolved(multiple) = "linear theory holds as far as all random mechanisms can be solved: below {multiple} times the tolerances";
    linear_theory_holds_beyond(multiple) = "linear theory holds (to 10 % of the standard deviation) up to {multiple} times the tolerances, the largest multiple tried";
    // report/stress/map.rs
    NO_SOLVER_AND_NO_ENGINE_HAS_NUMBERS = "no solver and no engine gives numbers here";
    WITHOUT_NUMBERS = " (no numbers)";
    // report/stress/summary.rs
    no_mechanism_at(at, why) = "  not a valid mechanism at {at}: {why}";
    points_of_results_agree_are_inconclusive(points, silent, panics, verdicts, agree, open, against, fails, refused) = "{points} points: {silent}, {panics}; of {verdicts} results {agree} agree, {open} are inconclusive, {against} disagree, {fails} fail with a reason; {refused} points gave no results, each with its reason";
    NO_SILENT_WRONG_NUMBER = "no silent wrong number";
    // report/comparison.rs
    link_with_point(link, point) = "{link}, point {point}";
    DEVIATION_OF_EXTREMES = "deviation of extreme positions";
    DWELL_TOO_SHORT = "dwells too short by at most";
    LARGEST_DWELL_MOTION = "largest motion in a dwell";
    PERCENT_OF_STROKE = "% of stroke";
    LARGEST_WRONG_MOTION = "largest motion in the wrong sense";
    PEAK_ANGULAR_ACCELERATION = "largest angular acceleration of the output";
    PEAK_POINT_ACCELERATION = "largest acceleration of the output point";
    DIVIDED_BY_SPEED_SQUARED = "acceleration divided by speed squared";
    SMALLEST_TRANSMISSION_ANGLE = "smallest transmission angle";
    LARGEST_REACTION = "largest reaction in a joint";
    IN_JOINT = "in joint";
    LARGEST_SHAKING_FORCE = "largest shaking force";
    LARGEST_DRIVING_TORQUE = "largest driving torque";
    task_at_one_speed(task, rpm, speed) = "Task {task}: all mechanisms at {rpm} rpm ({speed} rad/s)";
    outputs_compared(outputs) = "Outputs: {outputs}.";
    MASSES_OF_EACH_FILE = "Reactions, shaking forces and torques depend on the masses in each scenario.";
    THE_BEST_OF_A_ROW_IS_MARKED = "* best value of the row";
    // report/cyclogram.rs
    drive_of_an_organ(name, stroke, unrest, late) = "drive {name}, stroke {stroke}, motion in dwells up to {unrest:.2} % of the stroke, extremes within {late:.2} deg";
    MOMENTS_OF_THE_CYCLE = "Moments: at these shaft angles, every organ is in one of the phases listed for the moment.";
    required_of(name) = "{name}, required";
    // report/synthesize.rs
    a_dwell_ends_where_the_output(value) = "A dwell ends when the output is {value} % of the stroke away from the middle of its extremes. A motion ends at its extreme position.";
    stroke_largest_motion_in_a_dwell(stroke, angle, unrest, wrong, late, short) = "Stroke {stroke}{angle}. Largest motion in a dwell {unrest:.3} % of the stroke,\nlargest motion in the wrong direction {wrong:.3} %. Extreme positions within {late:.2} deg of their required crank angles, dwells at most {short:.2} deg too short.";
    smallest_transmission_angle_deg(angle) = ", smallest transmission angle {angle:.2} deg";
    // report/table_csv.rs
    the_table_cannot_be_written(error) = "the table cannot be written: {error}";
    // report/text.rs
    worst_in(detail) = ", worst in {detail}";
    nothing_either_way_of_and_checks(open, prove, channels, checks) = "{open} {prove}, of {channels} and {checks} checks.";
    of_and_checks(wrong, are, channels, checks) = "{wrong} {are}, of {channels} and {checks} checks.";
    NUMBERS_ARE_BEYOND_THEIR_BOUNDS = "numbers are beyond their bounds";
    NUMBER_IS_BEYOND_ITS_BOUND = "number is beyond its bound";
    channels_and_checks_are_within(within, expected) = "{within} channels and checks are within their bounds{expected}.";
    and_checks_are_within_their(channels, checks, expected) = "{channels} and {checks} checks are within their bounds{expected}.";
    disagree_as_expected(known) = ", {known} disagree as expected";
    channels_forces_that_the_engine(channels, own) = "{channels} channels, {own} forces that the engine itself exerts";
    channels_of_forces_that_the_engine(channels, closed, own) = "{channels} channels, {closed} of {own} forces that the engine itself exerts (the others are undecided)";
    found_from_runs_with_the_work(sweeps, times, runs, effort, why) = "found: {sweeps}, {times}, in {runs} runs that cost {effort} steps{why}";
    AT_THIS_PACE_THE_WORK_THAT_WAS_ALLOWED = "; at this rate of progress the work limit would not be enough";
    THE_WORK_THAT_WAS_ALLOWED = "; the work limit was reached";
    FINER_STEPS_WOULD_ADD_ROUNDING = "; finer steps would add rounding error";
    NO_OTHER_SETTING_WAS_LEFT = "; no other value of a free setting narrows the bound";
    extrapolated_times(times) = "extrapolated {times} times";
    route_step(told, settings, step, search) = "{told}\n(method {settings}, step {step} s; {search}):";
    the_forces_above_forces_as_the_engine(source, how) = "Source of the forces above: {source}.\nForces that the engine itself exerts: {how}";
    forces_as_itself_exerts_them_route(name, route, how) = "Forces that {name} itself exerts (method {route}): {how}";
    forces_as_itself_exerts_them_route_are_not_judged(name, route, why) = "Forces that {name} itself exerts (method {route}) are not judged: {why}";
    step_and_its_own_error_from_and(name, at, coarse, fine) = "{name}, step {at} s; its error is estimated from runs at {coarse} and {fine} s";
    accuracy_and_its_own_error(name, at, coarse, fine) = "{name}, accuracy {at}; its error is estimated from runs at {coarse} and {fine}";
    side_by_side_the_largest(table) = "\nAll engines: largest error as a fraction of the channel's scale (bound in brackets):\n{table}";
    engine_against_reference_the_worst(table) = "\nEngine against reference, the worst channel of each quantity:\n{table}";
    // report/tune.rs
    for_or_let_put_it_there(place, write, section) = "\nSection for {place} ({write} writes it):\n\n{section}";
    THE_WORK_THAT_WAS_ALLOWED_IS_DONE = "The work limit was reached: cheaper settings may exist.";
    A_PROOF_AT_THESE_SETTINGS = "A proof at these settings is inconclusive: use finer settings for a proof.";
    A_PROOF_AT_THESE_SETTINGS_AGREES = "A proof at these settings agrees.";
    of_the_price_but_proves_less(share) = "{share:.2} of the cost, but a proof at the cheaper settings is not conclusive.";
    a_proof_at_these_settings_agrees_at_with_sweeps(name, step, sweeps) = "A proof at these settings agrees. {name} at {step} with {sweeps} sweeps meets the error for ";
    error_measured_against_the_reference(engine, error, expected, runs) = "{engine}: error {error} measured against the reference, {expected} expected from its own runs; {runs} runs.";
    costs_more_than_the_cheapest(name) = "{name} costs more than the cheapest engine.";
    does_not_run_it_with_any(name, hints) = "{name} cannot run this scenario at any settings; {hints} gives the reason.";
    does_not_meet_it_its_smallest(name, numbers) = "{name} does not reach this error: its smallest error was {numbers}.";
    the_cheapest_settings_within_of_every_channel(within, table) = "The cheapest settings within {within} of every channel's scale:\n{table}\n";
    // report/compare.rs
    at_most_of_the_difference(numbers, but) = "at most {numbers} of the difference{but}";
    nothing_beyond_the_bounds(but) = "no difference: this explains everything{but}";
    but_for_the_row_at_which_is_off(numbers) = ", except for the row at t = {numbers} s, which is an outlier";
    FOR_THE_MOST_PART_2 = "for the most part, ";
    at_time(time, at) = "t = {time} s, {at}";
    THE_SEARCH_OF_A_COMPARISON_ENDED = "The search for causes reached its work limit before all causes were tried: compare fewer channels.";
    has_no_number_at(channel, instants, what, first, unit) = "\n{channel} has no number at {instants}, first at {what} {first} {unit}";
    further_channels_have_no_number(channels) = "\nnor have {channels} more at some instants";
    only_in_the(which, some) = "\nonly in the {which}: {some}";
    the_jumps_back_in_row_from_to_has_it_begun(what, row, from, to, unit) = "\nthe {what} jumps back in row {row}, from {from} to {to} {unit}: does a second run start there?";
    rows_and_hold_at_the_same(one, other, what, at, unit, channel, first, second) = "\nrows {one} and {other} have the same {what}, {at} {unit}, but different values: {channel} is {first} and {second}";
    left_out_up_to_instants_of_a_channel(count) = "\nleft out: up to {count} instants per channel without a measured value";
    left_out_instants_of_the_second(unshared) = "\nleft out: {unshared} instants that only the second party has";
    of_values(judged, of) = "{judged} of {of} values";
    of_channels(disagree, all) = "{disagree} of {all} channels";
    the_input_and_of_channels(noun, disagree, all) = "the {noun} and {disagree} of {all} channels";
    the_input_and_none(noun, all) = "the {noun} disagrees; all {all} channels agree";
    all_channels(agree) = "all {agree} channels agree";
    THE_REST_IS_OFF_BY_LESS_THAN_A_FIFTIETH = "The other differences are below 2 % of their scale; an integration method or its time step can cause differences of this size. Bounds cover only rounding of the data and the uncertainty of the analytic sides: state how accurate the other party is.";
    ALL_WITHIN_THEIR_BOUNDS = ", all within their bounds";
    and_more_6(more, is_fine) = "\nand {more} more{is_fine}";
    // report/exercise/key.rs
    is_not_the_key_of_a_class(place, why) = "{place} is not the key of a class: {why}";
    expected_format_found(expected, found) = "expected format {expected}, found {found}";
    is_no_name_of_a_sheet(name) = "\"{name}\" is not a valid name of a sheet";
}
