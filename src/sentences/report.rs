//! Sentences of reports, of pictures and of proofs in test suites.

linkage::sentences! {
    // draw/media.rs
    EXPECTED_A_FILE_THAT_ENDS = "expected a file that ends in .svg, .png, .gif or .webp, or `-`";
    no_pictures_end_in_expected(other) = "no pictures end in .{other}; expected .svg, .png, .gif or .webp";
    // draw/subject.rs
    DOES_NOT_CLOSE = " (does not close)";
    AS_IN_THE_FILE = " (as in the file)";
    THE_ONLY_CONFIGURATION = "the only configuration";
    name_one_of(names) = "name one of {names}";
    no_point_that_moves_is_called(name) = "no point that moves is called \"{name}\"";
    no_drive_could_be_read_drawn(draft, link) = "{draft}: no drive could be read; drawn as if \"{link}\" were driven";
    and_more(more) = "and {more} more";
    only_the_first_configurations_are_drawn(most) = "only the first {most} configurations are drawn";
    joint_stays_open_by_mm(name, significant) = "joint {name} stays open by {significant} mm";
    crank_at(name, crank) = "{name}, crank at {crank}°";
    // testing.rs
    GIVE_EVERY_INSTANT_ONCE_CRANK = "give every instant once, crank angles in rad or times in s";
    the_grid_cannot_be(message) = "the grid cannot be: {message}";
    GIVE_A_NUMBER_BETWEEN_AND_SUCH_AS = "give a number between 0 and 1, such as 1e-2";
    found_as_tolerance_but_this_is_a_share(share) = "found {share} as tolerance, but this is a share of a channel's scale";
    is_not_proven(scenario, word, proof) = "{scenario} is not proven: {word}\n\n{proof}";
    // testing/folder.rs
    is_to_be_ignored_but_no_scenario(own) = "\"{own}\" is to be ignored, but no scenario is called so";
    THERE_IS_NO_SCENARIO_TOML = "there is no scenario (*.toml) in this folder";
    // plain/brief.rs
    forces_as_itself_exerts_them(name, error) = "Forces as {name} itself exerts them are not judged: {error}";
    step_ms(numbers) = "step {numbers} ms";
    of_numbers_are_open(open, all) = "{open} of {all} numbers are open";
    NO_RUN_STANDS = "no run stands";
    of_numbers_differ(wrong, all) = "{wrong} of {all} numbers differ";
    channels_and_checks(channels, checks) = "{channels} channels and {checks} checks";
    // plain/cells.rs
    and_more_2(named, more) = "{named} and {more} more";
    // plain/diagnosis.rs
    place_of_on(joint, link, axis) = "place of {joint} on {link}, {axis}";
    INERTIA_OF_ROTOR_AND_REDUCER = "inertia of rotor and reducer";
    MOMENT_OF_THE_MOTOR = "moment of the motor";
    speed_at_at(joint) = "speed at {joint} at t = 0";
    angle_of_the_drive_at_at(joint) = "angle of the drive at {joint} at t = 0";
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
    in_the_middle_of_and(one, other) = "in the middle of {one} and {other}";
    mirrored_at_the_line_of_and(one, other) = "mirrored at the line of {one} and {other}";
    measured_from_the_wrong_end(one, other) = "measured from the wrong end, {one} and {other} exchanged";
    at_point(point) = "at point {point}";
    at_joint(joint) = "at joint {joint}";
    times_as_large(number, told) = "{number} times as large, {told}";
    OF_THE_OPPOSITE_SIGN = "of the opposite sign";
    the_error_has_no_order_at_most(percent) = "the error has no order, at most {percent} of the scale: noise, or few digits on the way";
    the_error_is_smooth_at_most(percent) = "the error is smooth, at most {percent} of the scale: integration or step";
    the_error_grows_with_time(how) = "the error grows with time{how}: integration, or the step of it";
    about_with_its_power_of(power) = ", about with its power of {power}";
    ABOUT_IN_PROPORTION_TO_IT = ", about in proportion to it";
    THE_ROW_AND_THE_ONE_BEHIND = "the row and the one behind";
    THE_ROW_AND_THE_ONE_BEFORE = "the row and the one before";
    rows_before_and_behind(rows) = "{rows} rows before and behind";
    THE_ROW_BEFORE_AND_THE_ONE_BEHIND = "the row before and the one behind";
    rates_per_radian_of_the_crank(of) = "rates per radian of the crank instead of per second in {of}";
    from_its_sine_beyond_a_quarter(of) = "{of} from its sine: beyond a quarter turn it is folded back";
    the_sign_of_is_lost(of) = "the sign of {of} is lost";
    zero_instead_of(of) = "zero instead of {of}";
    half_the_values_of(of) = "half the values of {of}";
    twice_the_values_of(of) = "twice the values of {of}";
    half_turns_too_much_or_too(of) = "half turns too much or too little in {of}, as an arc tangent of a quotient gives";
    whole_turns_too_much_or_too(of) = "whole turns too much or too little in {of}";
    the_opposite_sign_of(of) = "the opposite sign of {of}";
    times_the_values_of(number, of) = "{number} times the values of {of}";
    less_and_more_in_place_of_counted(first, second, amount, of) = "{first} less {second} and {amount} more in place of {of}: counted from another link";
    less_in_place_of_counted(first, second, of) = "{first} less {second} in place of {of}: counted from another link";
    and_exchanged_2(one, other) = "{one} and {other} exchanged";
    the_clock_of_all_rows_is_too(how, by) = "the clock of all rows is too {how}: the time of a row is {by} times that of its values";
    another_unit_of_time_times(told, number) = "another unit of time: {told}, {number} times the time of a row";
    one_row_alone_at_in_an_outlier(number, of) = "one row alone, at t = {number} s, in {of}: an outlier";
    about_instead_of(of, to, from) = "{of} about {to} instead of {from}";
    about_instead_of_the_origin(of, to) = "{of} about {to} instead of the origin";
    about_another_point_by_away(of, number, number_2) = "{of} about another point, by ({number}, {number_2}) m away";
    the_coriolis_acceleration_of_the_block(joint, of) = "the Coriolis acceleration of the block at {joint} is missing in {of}";
    differences_of_over_or_such_of_its_like(order, other, over, of) = "{order}differences of {other} over {over}, or such of its like, in place of {of}: take closer rows";
    the_magnitude_of_and_in_place(one, other, of) = "the magnitude of {one} and {other} in place of {of}";
    the_values_of_with_the_opposite(other, of) = "the values of {other} with the opposite sign in place of {of}";
    the_values_of_in_place_of(other, of) = "the values of {other} in place of {of}";
    counted_the_other_way_round(of, amount) = "{of} counted the other way round, from another axis: {amount} less the right value";
    added_at_every_instant_to(amount, of) = "{amount} added at every instant to {of}";
    another_unit_in(told, of) = "another unit, {told}, in {of}";
    and_later_in_more(more) = " and later in {more} more";
    from_deg_in(fixed, fixed_2, channel) = "; from {fixed} s, {fixed_2} deg, in {channel}";
    crank_angle_deg_first_in(fixed, fixed_2, names) = "t = {fixed} s, crank angle {fixed_2} deg, first in {names}";
    cannot_be_told_differ(pairs) = "cannot be told: {pairs} differ";
    nobody_stand_against(one, other) = "nobody: {one} stand against {other}";
    all_others_agree_with_each(name) = "{name}; all others agree with each other";
    NOBODY_EACH_IS_WITHIN_THE_BOUNDS = "nobody: each is within the bounds of all others";
    which_explains_as_much(cause) = "{cause}, which explains as much";
    no_single_one_a_part_is_explained(cause) = "no single one; a part is explained by this: {cause}";
    that_explains_all_to_within(cause, wrong) = "{cause}; that explains all {wrong} to within their bounds";
    nothing_simple_changed_cases_and_all(solved) = "nothing simple: {solved} changed cases and all simple slips explain none of it";
    diagnosis_of(suspect) = "Diagnosis of {suspect}:";
    THE_SEARCH_FOR_A_CAUSE_ENDED = "The search for a cause ended at its limit of work, before all causes were tried: allow more work.";
    // plain/engines.rs
    THE_MOTION_AGREES_AND_THE_FORCES = "The motion agrees, and the forces disagree in both ways: from the motion and as exerted.";
    THE_ENGINE_MOTION_AND_THE_FORCES = "The engine's motion and the forces that belong to it agree: wrong are those that it exerts itself, or how they are read.";
    THE_ENGINE_MOTION_AND_THE_FORCES_THAT_IT_EXERTS = "The engine's motion and the forces that it exerts agree: wrong are the forces that Newton and Euler's equations make of this motion.";
    channels_at_most(own, own_2, numbers) = "{own} channels {own_2}, at most {numbers}";
    of_in(error, bound, channel) = "{error} of {bound} in {channel}";
    in_channels_no_single_one_stands(count, channel, pairs) = "In {count} channels no single one stands alone, first in {channel}: {pairs} differ.";
    the_odd_one_out_in_channels(alone, party, channel) = "The odd one out in {alone} channels is {party}, first in {channel}.";
    NO_TWO_OF_THEM_DIFFER_BY_MORE = "No two of them differ by more than both may be wrong.";
    // plain/judged.rs
    THE_ENGINE_OWN_FORCES = "the engine's own forces";
    forces_as_itself_exerts_them_2(info) = "forces as {info} itself exerts them";
    AS_THE_ENGINE_EXERTS_IT = " as the engine exerts it";
    // plain/reasons.rs
    up_to_of_instants_are_not_judged(most, proof, quantities, info) = "Up to {most} of {proof} instants are not judged in {quantities} ({info}): a drive or a loaded link reverses there, or the motion begins.";
    checks_disagree_as_expected_see(count, told) = "\n{count} checks disagree as expected, see\n  {told}";
    and_more_3(open, tell) = "\n... and {open} more ({tell})";
    // report/accept.rs
    and_more_4(names, more) = "{names}, and {more} more";
    its_bound_was_now(channel, accepted, unit, found) = "\n{channel}: its bound was {accepted} {unit}, now {found}";
    and_more_channels_the_json(worst) = "... and {worst} more channels; the JSON has all of them.";
    ACCEPTED_WITHIN_TIMES_THE_BOUND = "accepted within 100 times the bound of now or more";
    KNOWN_TIMES_WORSE_OR_MORE = "known 100 times worse or more";
    THERE_IS_NO_FIGURE = "there is no figure";
    ITS_INSTANTS_ARE_OTHERS_VALUES = "its instants are others, values are not compared";
    the_proof_was_accepted_as_and(accepted, now) = "the proof was accepted as {accepted} and {now}";
    accepted_in(name, all, file) = "{name}: accepted, {all} in {file}.";
    not_accepted_the_proof_is(name, item) = "{name}: not accepted, the proof is {item}.";
    nothing_has_moved_stays_as_it_is(name, file, all) = "{name}: nothing has moved, {file} stays as it is ({all}).";
    accepted_anew_in(name, file, counts) = "{name}: accepted anew in {file}: {counts}.";
    disagree_is_not_as_accepted(name, file, counts) = "DISAGREE: {name} is not as accepted in {file}: {counts}.";
    inconclusive_is_not_proven_to_be_as_accepted(name, file, counts) = "INCONCLUSIVE: {name} is not proven to be as accepted in {file}: {counts}.";
    agree_is_as_accepted_in_within(name, file, all) = "AGREE: {name} is as accepted in {file}, {all} within their bounds.";
    have_no_finite_bound_and_no_figures(channels) = "{channels} have no finite bound and no figures.";
    // report/bearings.rs
    journals_lever_mm_bending_stress(lever_mm, stress_mpa) = "\njournals: lever {lever_mm} mm, bending stress {stress_mpa} MPa";
    largest_at_deg(name, value, unit, degrees) = "largest {name:16} {value:.6} {unit} at {degrees} deg";
    // report/bench.rs
    SIDE_ASSUR = "side 1 (assur)";
    finer_settings_were_not_run(left_out) = "\n{left_out} finer settings were not run: the work that was allowed is done.";
    judged_in_part_times(times, gap) = "\njudged in part {times} times: {gap}";
    failed_times(times, reason) = "\nfailed {times} times: {reason}";
    other_programs_at(within, told) = "  other programs at {within}: {told}";
    the_reference_is_known_to(stage, floor) = "\n{stage}: the reference is known to {floor}";
    THE_FRONTS_WHAT_NOTHING_BEATS = "The fronts: what nothing beats, then what no engine and no peer beats.";
    settings_on_instants_failed_times(settings, instants, failed, reference) = "{settings} settings on {instants} instants, {failed} failed; times over that of side 1 (assur). Reference: {reference}.";
    AT_THE_FLOOR = "at the floor";
    // report/bench_page.rs
    finer_settings_were_not_run_the_work(left_out) = "- {left_out} finer settings were not run: the work allowed was done.";
    judged_in_part_times_2(times, foreign) = "- Judged in part {times} times: {foreign}";
    failed_times_2(times, foreign) = "- Failed {times} times: {foreign}";
    of_engines_and_peers(of_others) = "  Of engines and peers: {of_others}.";
    front_of(stage, told) = "- Front of {stage}: {told}.";
    settings_on_instants_failed_diagram(bench, instants, failed, pictures, name) = "{bench} settings on {instants} instants, {failed} failed. [Diagram]({pictures}{name}.time.svg), [numbers]({pictures}{name}.csv).\n";
    // report/bench_plot.rs
    and_more_reasons_see_the_table(left) = "and {left} more reasons: see the table";
    in_part(times, text) = "in part {times}: {text}";
    ERRORS_LARGEST_OVER_INSTANTS_AND_CHANNELS = "Errors: largest over instants and channels, as a share of the channel's scale.";
    CROSS_IN_THE_BAND_ABOVE_FAILED = "Cross in the band above: failed.";
    hollow_less_than_times_above(clear) = "Hollow: less than {clear} times above it (dashes), limited by the reference.";
    grey_line_the_reference_own(basis) = "Grey line: the reference's own error ({basis}).";
    LINE_WHAT_NO_OTHER_SETTING = "Line: what no other setting of the same program beats; ring: nothing, or no engine and peer, beats it.";
    IT_COUNTS_NONE_OF_THESE = "; it counts none of these";
    BALANCING_MOMENT_SHAKING_FORCE_AND_MOMENT = "balancing moment, shaking force and moment";
    NO_SETTING_THAT_ANSWERED_COUNTS = "no setting that answered counts this";
    SWEEPS_FACTORISATIONS_ITERATIONS_OR_GROUPS = "sweeps, factorisations, iterations or groups";
    EVALUATIONS_OR_STEPS_AND_PROBES = "evaluations, or steps and probes, or poses";
    TIME_OVER_THAT_OF_SIDE_ASSUR = "time over that of side 1 (assur)";
    error_against(name, axis, about) = "{name}: error against {axis}. {about}";
    // report/chart.rs
    nothing_to_draw(why) = "nothing to draw: {why}";
    // report/check.rs
    FOR_THE_MOST_PART = "for the most part";
    A_MISSING_TERM = "a missing term";
    A_MISSING_FACTOR = "a missing factor";
    the_of(order) = "the {order} of ";
    formula_mechanism(word, place, found, right) = "\n  {word:6} {place}: formula {found}, mechanism {right}";
    crank_angle(fixed_in, fixed) = "crank angle {fixed_in}, t = {fixed} s";
    is_not(of, judged, formula, claim, side) = "{of}{judged} = {formula}\n  is not {of}{claim} ({side})";
    SOMETHING_IS_OPEN = "something is open";
    of_wrong(names, counted) = "{names} of {counted} wrong";
    and_contradict_each_other(first, second) = "{first} and {second} contradict each other";
    at_and(claims, instants, first, second) = "{claims} at {instants}, {first} and {second}";
    CAUSE_NONE_THAT_IS_SIMPLE = "  cause  none that is simple: no single slip, offset, factor or term explains it.";
    cause_not_found(cut) = "  cause  not found: {cut}.";
    cause_with_that_nothing_is_left(found) = "  cause  {found}.\n         With that, nothing is left over.";
    cause_perhaps_another(found, cut) = "  cause  {found}.\n         Perhaps another: {cut}.";
    // report/clearance.rs
    poses_and_distances_of_convex(word, poses, distances, positions, squares) = "{word}: {poses} poses and {distances} distances of convex parts; for areas {positions} poses and {squares} tests of squares\n";
    first_nearer_than_the_mm(millimetres) = "first nearer than the {millimetres} mm wanted";
    and_at_crank_angle_deg_place(what, one, two, crank, place) = "{what}: {one} and {two} at crank angle {crank} deg, place {place} mm";
    not_proven_from_to_deg(degrees, degrees_2, why) = "not proven from {degrees} to {degrees_2} deg: {why}";
    THE_MECHANISM_IS_SINGULAR_THERE = "the mechanism is singular there, or the work allowed is done";
    the_area_of_is_known_to_only_the_work(name, numbers) = "the area of {name} is known to {numbers} only: the work allowed is done";
    no_distance_is_smaller_by_more(numbers) = "no distance is smaller by more than {numbers} mm";
    NO_TWO_BODIES_CAN_MEET_ALL = "no two bodies can meet: all links are joined, and there is no housing\n";
    clearance_over_crank_angles_to_deg(scenario, scenario_2, from, to) = "{scenario}: {scenario_2}\n\nclearance over crank angles {from} to {to} deg\n";
    // report/closed_form.rs
    time_ratio(time_ratio) = "  time ratio    {time_ratio:.6}";
    pressure_deg_at_most_between_rod(found) = "  pressure      {found:.4} deg at most between rod and slider's line";
    crank_slider(name, fixed_in, fixed_in_2) = "  {name:13} crank {fixed_in}, slider {fixed_in_2}";
    crank_rod(crank, rod) = "  crank         {crank:.15} m\n  rod           {rod:.15} m";
    SLIDER_CRANK_FROM_STROKE_AND_OFFSET_2 = "slider-crank from stroke and offset\n";
    time_ratio_mode(time_ratio, found) = "  time ratio    {time_ratio:.6}\n  mode          {found}";
    transmission_deg_at_least_at_crank(transmission, at) = "  transmission  {transmission:.4} deg at least, at crank {at}";
    crank_rocker(name, crank, rocker) = "  {name:13} crank {crank}, rocker {rocker}";
    crank_oa_coupler_ab_rocker(crank, coupler, rocker) = "  crank OA      {crank:.15} m\n  coupler AB    {coupler:.15} m\n  rocker CB     {rocker:.15} m";
    CRANK_ROCKER_FROM_TWO_EXTREME_POSITIONS = "crank-rocker from two extreme positions\n";
    // report/diagram.rs
    orders_of_the_rms_error_from_to_and_from_to_divisions(n, n_2, n_3, n_4) = "\norders: of the rms error, from {n} to {n_2} and from {n_3} to {n_4} divisions";
    OF_HALF_RANGE = "of half range";
    half_range(channel, half, unit) = "  {channel:28} half range {half:>10} {unit}";
    over_one_turn_in_divisions(scenario, course, divisions) = "{scenario}: {course} over one turn in {divisions} divisions";
    // report/drive.rs
    motor_against_reactions_of_the_largest(error) = "; motor against reactions: {error} of the largest moment";
    run_up_at_a_limit_of_rotation(t, degrees) = "run-up: at a limit of rotation at {t:.9} s, crank angle {degrees}";
    run_up_held_at_crank_angle(t, degrees) = "run-up: held at {t:.9} s, crank angle {degrees}";
    RUN_UP_FOLLOWED_TO_ITS_END = "run-up followed to its end";
    THE_SCENARIO_HAS_NO_MOTOR = "the scenario has no motor";
    slowest_fastest(at, at_2) = "  slowest   {at}\n  fastest   {at_2}";
    at_start_rad(start_speed) = "  at start  {start_speed:.10} rad/s";
    mean_rad_period(mean_speed, period) = "  mean      {mean_speed:.10} rad/s, period {period:.13} s\n";
    flywheel_for_a_non_uniformity(wanted, inertia) = "flywheel for a non-uniformity of {wanted}\n  inertia   {inertia:.9} kg m^2";
    steady_motion(of_regime) = "steady motion\n{of_regime}";
    time_constant(constant) = "  time constant{constant}";
    NONE_THE_MOTOR_LAW_IS_NOT_ONE_STRAIGHT = ": none, the motor's law is not one straight line from rest on";
    averaged_model_crank_rad_motor(crank, motor) = "averaged model\n  crank     {crank:.6} rad/s\n  motor     {motor:.6} rad/s";
    NO_MOTOR_ADD_A_MOTOR_SECTION = "no motor: add a `[motor]` section to learn the steady motion\n";
    motor_and_reducer_on_the_crank(added) = "motor and reducer on the crank\n  inertia   {added:.9} kg m^2";
    least_greatest(end, end_2) = "  least     {end}\n  greatest  {end_2}";
    REDUCED_MOMENT_OF_RESISTANCE = "reduced moment of resistance";
    REDUCED_MOMENT_OF_INERTIA = "reduced moment of inertia";
    // report/drive_graphs.rs
    non_uniformity(regime) = "; non-uniformity {regime:.6}";
    MEAN_OVER_TIME = "mean over time";
    ANGULAR_VELOCITY_OF_THE_CRANK = "angular velocity of the crank in the steady motion";
    over_of_the_crank_in_the_sense(over) = "over {over} of the crank in the sense of its motion; motor, reducer and flywheel left out of I*";
    DERIVATIVE_OF_THE_REDUCED_MOMENT = "derivative of the reduced moment of inertia";
    // report/explain.rs
    NOTHING_ASKED_NEEDS_THEM = "nothing asked needs them";
    NOTHING_THAT_IS_COUNTED = "nothing that is counted";
    nothing_asked_depends_on_them(all) = "{all}: nothing asked depends on them";
    NOTHING_EVERY_PART_OF_THE_MECHANISM = "nothing: every part of the mechanism is needed";
    at_instants(some, instants) = "{some} at {instants} instants";
    of_everything_at_instants_of_channels(stages, instants, own, all) = "{stages} of everything at {instants} instants: {own} of {all} channels";
    left_out(left_out) = "left out   {left_out}\n";
    what_ran_how_often_and_why(scenario) = "{scenario}: what ran, how often, and why\n";
    // report/html.rs
    of_instants_evenly_chosen_and_those(shown, all) = "{shown} of {all} instants: evenly chosen, and those with the least and greatest values and errors. Verdicts, errors and bounds in numbers are about all of them.";
    // report/html/findings.rs
    and_more_alike(count) = " (and {count} more alike)";
    of_more_the_channels_and_the_table(all) = "\nOf {all} more, the channels and the table of checks below tell why.";
    engines_and_reference_against_each(engines) = "Engines and reference against each other: {engines}\n";
    // report/html/loads.rs
    between_and(sort, link, link_2) = "{sort} between {link} and {link_2}";
    from_to(sort, start, end) = "{sort} from {start} to {end}";
    at_on(sort, point, link) = "{sort} at {point} on {link}";
    // report/html/words.rs
    SETTINGS_AND_VERSIONS = "Settings and versions";
    INERTIA_KG = "inertia kg m²";
    POINTS_MM_ITS_FRAME = "points (mm, its frame)";
    class_order_mode(links, class, order, pairs, mode) = "{links}: class {class}, order {order}, {pairs}, mode {mode}";
    BASIS_OF_THE_BOUND = "basis of the bound";
    // report/inspect.rs
    from_the_rough_place_the_next(mm, mm_2) = ", {mm} from the rough place, the next configuration {mm_2}";
    from_the_rough_place(mm) = ", {mm} from the rough place";
    class_order_mode_2(names, class, order, pairs, mode, transmission, from) = "  {names:28} class {class}, order {order}, {pairs}, mode {mode}{transmission}{from}";
    transmission_angle_deg(sine) = ", transmission angle {sine:.2} deg";
    groups_at_the_start_crank(fixed_in) = "\ngroups at the start (crank {fixed_in})";
    kg_kg(mass, inertia, at) = "m = {mass} kg, J = {inertia} kg m^2, {at}";
    structure_links(structure) = "structure  {structure}\n\nlinks";
    // report/json.rs
    NOTHING_LEFT_TO_CHOOSE = "nothing left to choose";
    // report/lists.rs
    along_world(what, axis) = "{what}, along world {axis}";
    on_link(quantity, case) = "{quantity} on link {case}";
    on_the_frame(quantity) = "{quantity} on the frame";
    in_on(quantity, of, joint, joint_2) = "{quantity} in {of}, {joint} on {joint_2}";
    of_link(quantity, of) = "{quantity} of link {of}";
    no_scenario_files_toml_in(directory) = "no scenario files (.toml) in {directory}; `linkproof new` writes one, `linkproof new --shipped` the examples";
    cannot_be_read_3(error) = "cannot be read: {error}";
    // report/live.rs
    times_slower_than_the_mechanism(slow, lasts) = "{slow} times slower than the mechanism, anew every {lasts} s";
    as_fast_as_the_mechanism(lasts) = "as fast as the mechanism, anew every {lasts} s";
    ONE_INSTANT_AT_REST = "one instant, at rest";
    // report/markdown.rs
    and_more_5(all) = "- ... and {all} more";
    CANNOT_BE_PROVEN = "cannot be proven";
    // report/modes.rs
    FOLLOWED_BY_THE_SCENARIO = ", followed by the scenario";
    for_configuration_of(number, names) = "  for configuration {number} of {names}";
    not_decided_by_the_scenario(why) = "  not decided by the scenario: {why}";
    only_the_followed_one_is_shown(names, why) = "\n{names}: only the followed one is shown; {why}";
    real_configurations(names, found) = "\n{names}: {found} real configurations";
    at_crank_angle(scenario, fixed_in) = "{scenario} at crank angle {fixed_in}\n";
    THE_CONFIGURATION_IS_SINGULAR_ANGULAR = "the configuration is singular: angular velocities are not determined";
    // report/motor_choice.rs
    ratio_efficiency(ratio, efficiency) = "ratio = {ratio}\nefficiency = {efficiency}";
    periodic_crank_rad_non_uniformity(mean, off_mean, unrest) = "  periodic  crank {mean:.6} rad/s ({off_mean:+.2} %), non-uniformity {unrest:.4}";
    steady_speed_averaged_crank_rad(averaged, off_averaged, geared_up) = "steady speed\n  averaged  crank {averaged:.6} rad/s ({off_averaged:+.2} % of the wanted), motor {geared_up:.4} rad/s";
    breakdown_of_it(breakdown, breakdown_2, holds) = "  breakdown {breakdown:.4} N m, {breakdown_2} of it: {holds}";
    ABOVE_THE_PEAK = "above the peak";
    peak_of_it_without_what_inertia(peak, share) = "  peak      {peak:.4} N m, {share:.3} of it, without what inertia carries";
    on_the_motor_shaft_mean_of_the_rated(mean, share) = "on the motor's shaft\n  mean      {mean:.4} N m, {share:.3} of the rated torque";
    ratio_rpm_to_rpm(ratio, rated, turning) = "  ratio     {ratio:.6} ({rated:.0} rpm to {turning:.4} rpm)";
    motor_kw_rpm_synchronous_rpm(name, kilowatts, rated, synchronous, torque) = "motor\n  {name}: {kilowatts} kW, {rated:.0} rpm, synchronous {synchronous:.0} rpm, rated torque {torque:.4} N m";
    asked_kw_with_an_efficiency(asked, efficiency) = "  asked     {asked:.6} kW with an efficiency of {efficiency}";
    power_peak_at_times_rad_kw(peak, at, wanted, power) = "power\n  peak      {peak:.6} N m at {at}, times {wanted:.6} rad/s: {power:.6} kW";
    // report/mutate.rs
    OPEN_IN_THE_TRUNK = "Open in the trunk:";
    NOT_FOUND_IN_ONE_PARTY = "Not found in one party:";
    the_formula_for(formula, wrong, right) = "the formula {formula}, `{wrong}` for `{right}`";
    EVERY_COMPARISON_AGREES = "every comparison agrees";
    of_found_inconclusive_escaped_change(found, real, what, part, inconclusive, escaped, equivalent) = "{found} of {real} {what} found ({part}), {inconclusive} inconclusive, {escaped} escaped; {equivalent} change nothing";
    in_the_trunk_of_kinds_are_found(found, all, percent) = "; in the trunk {found} of {all} kinds are found from outside ({percent})";
    FAULTS_IN_ONE_PARTY = "faults in one party";
    NOTHING_PLANTED_NO_FAULT_OF_THE_KINDS = "NOTHING PLANTED  no fault of the kinds asked for changes anything: nothing is shown";
    LEAST_MARGIN_DIFFERENCE_OVER_ITS_BOUND = "least margin: difference over its bound of what sees the fault most clearly, where it is least clear.
found down to: sizes above this are found in every scenario, to a factor of two; relative, angles in rad.";
    no_fault_of_the_kinds_asked(name, instead, formulas) = "{name}: no fault of the kinds asked for changes anything; kinds that would: {instead}{formulas}\n";
    NO_FORMULA_OF_IT_CLAIMS_AN_EXACT = "; no formula of it claims an exact value";
    // report/plan.rs
    omega_rad_alpha_rad(link, name, omega, alpha) = "  {link} {name:14} omega {omega:>10} rad/s   alpha {alpha:>10} rad/s^2";
    a_on_the_first_on_the_second(shown, shown_2) = "  a_S {shown} m/s^2 on the first, {shown_2} m/s^2 on the second";
    on_both_base_links(shown) = "  v_S {shown} m/s on both base links";
    singular_point_of_the_class(point, shown) = "\nsingular point of the class IV group   S = {point} at {shown} m";
    singular_point(error) = "\nsingular point: {error}";
    vector_from_to_mm_meaning(unit, x, y) = "  vector     from, to   {unit:>10} {x:>11} {y:>11}       mm  meaning";
    plan_pole_mu_mm(word, plan, symbol, scale, unit) = "\n{word} plan   pole {plan}, mu_{symbol} = {scale} ({unit})/mm";
    kinematic_diagram_mu_mm(scale) = "kinematic diagram   mu_l = {scale} m/mm";
    the_motion_is_free_these(speed) = "the motion is free: these plans are of the nominal motion, the crank turning at {speed} rad/s";
    // report/range.rs
    THE_GROUP_IS_SINGULAR_AT_A_LIMIT = "the group is singular at a limit: the condition number has no bound";
    turns_fully_times(turns) = "turns fully, {turns} times";
    over_deg(swing) = "over {swing:.6} deg";
    DOES_NOT_TURN = "does not turn";
    NO_SINGULAR_POSE_ON_THE_WAY = "No singular pose on the way.\n";
    from_to_deg_deg_in_all(from, to, span) = "from {from} to {to} deg, {span} deg in all";
    turns_fully_the_mechanism_is_back(turns) = "turns fully; the mechanism is back at its first pose after {turns} turns";
    groups_nearest_to_a_singular(groups) = "Groups, nearest to a singular pose:\n{groups}";
    frame_driving_link_coupler_output(frame, driver, coupler, output) = "           frame {frame:.6} m, driving link {driver:.6} m, coupler {coupler:.6} m, output link {output:.6} m";
    // report/schema.rs
    SCENARIO_OF_LINKPROOF = "Scenario of linkproof";
    // report/stress/map.rs
    NO_SOLVER_AND_NO_ENGINE_HAS_NUMBERS = "no solver and no engine has numbers here";
    error_over_the_scale(group) = "{group}: error over the scale";
    // report/stress/summary.rs
    no_mechanism_at(at, why) = "  no mechanism at {at}: {why}";
    points_of_results_agree_are_inconclusive(points, silent, panics, verdicts, agree, open, against, fails, refused) = "{points} points: {silent}, {panics}; of {verdicts} results {agree} agree, {open} are inconclusive, {against} disagree, {fails} fail with a reason; {refused} points are no mechanism, with a reason";
    NO_SILENT_WRONG_NUMBER = "no silent wrong number";
    // report/synthesize.rs
    a_dwell_ends_where_the_output(value) = "A dwell ends where the output leaves the middle of its extremes by {value} % of the stroke, a motion at its extreme position.";
    random_candidates_of_them_assembled(drawn, assembled, cost, refined, worst) = "{drawn} random candidates, {assembled} of them assembled near the limits; cost {cost}, refined {refined} (worst of the refined {worst})\n";
    stroke_largest_motion_in_a_dwell(stroke, angle, unrest, wrong, late, short) = "Stroke {stroke}{angle}. Largest motion in a dwell {unrest:.3} % of the stroke,\nlargest way in a wrong sense {wrong:.3} %. Extreme positions within {late:.2} deg of the table, dwells short by {short:.2} deg at most.";
    smallest_transmission_angle_deg(angle) = ", smallest transmission angle {angle:.2} deg";
    // report/table_csv.rs
    the_table_cannot_be_written(error) = "the table cannot be written: {error}";
    // report/text.rs
    worst_in(detail) = ", worst in {detail}";
    nothing_either_way_of_and_checks(open, prove, channels, checks) = "{open} {prove} nothing either way, of {channels} and {checks} checks.";
    of_and_checks(wrong, are, channels, checks) = "{wrong} {are}, of {channels} and {checks} checks.";
    NUMBERS_ARE_BEYOND_THEIR_BOUNDS = "numbers are beyond their bounds";
    NUMBER_IS_BEYOND_ITS_BOUND = "number is beyond its bound";
    channels_and_checks_are_within(within, expected) = "{within} channels and checks are within their bounds{expected}.";
    and_checks_are_within_their(channels, checks, expected) = "{channels} and {checks} checks are within their bounds{expected}.";
    disagree_as_expected(known) = ", {known} disagree as expected";
    channels_forces_that_the_engine(channels, own) = "{channels} channels, {own} forces that the engine itself exerts";
    channels_of_forces_that_the_engine(channels, closed, own) = "{channels} channels, {closed} of {own} forces that the engine itself exerts (the others are open)";
    found_from_runs_with_the_work(sweeps, times, runs, effort, why) = "found: {sweeps}, {times}, from {runs} runs with the work of {effort} steps{why}";
    AT_THIS_PACE_THE_WORK_THAT_WAS_ALLOWED = "; at this pace the work that was allowed would not be enough";
    THE_WORK_THAT_WAS_ALLOWED = "; the work that was allowed is done";
    FINER_STEPS_WOULD_ADD_ROUNDING = "; finer steps would add rounding";
    NO_OTHER_SETTING_WAS_LEFT = "; no other setting was left to choose";
    extrapolated_times(times) = "extrapolated {times} times";
    route_step(told, settings, step, search) = "{told}\n(route {settings}, step {step} s; {search}):";
    the_forces_above_forces_as_the_engine(source, how) = "The forces above: {source}.\nForces as the engine itself exerts them, by {how}";
    forces_as_itself_exerts_them_route(name, route, how) = "Forces as {name} itself exerts them (route {route}): {how}";
    forces_as_itself_exerts_them_route_are_not_judged(name, route, why) = "Forces as {name} itself exerts them (route {route}) are not judged: {why}";
    step_and_its_own_error_from_and(name, at, coarse, fine) = "{name}, step {at} s, and its own error from {coarse} and {fine} s";
    accuracy_and_its_own_error(name, at, coarse, fine) = "{name}, accuracy {at}, and its own error from {coarse} and {fine}";
    side_by_side_the_largest(table) = "\nSide by side, the largest error over its scale (and its bound):\n{table}";
    engine_against_reference_the_worst(table) = "\nEngine against reference, the worst channel of each quantity:\n{table}";
    // report/tune.rs
    for_or_let_put_it_there(place, write, section) = "\nFor {place} (or let {write} put it there):\n\n{section}";
    THE_WORK_THAT_WAS_ALLOWED_IS_DONE = "The work that was allowed is done: there may be cheaper settings.";
    A_PROOF_AT_THESE_SETTINGS = "A proof at these settings leaves something open: take finer ones for a proof.";
    A_PROOF_AT_THESE_SETTINGS_AGREES = "A proof at these settings agrees.";
    of_the_price_but_proves_less(share) = "{share:.2} of the price, but proves less.";
    a_proof_at_these_settings_agrees_at_with_sweeps(name, step, sweeps) = "A proof at these settings agrees. {name} at {step} with {sweeps} sweeps meets the error for ";
    error_measured_against_the_reference(engine, error, expected, runs) = "{engine}: error {error} measured against the reference, {expected} expected from its own runs; {runs} runs.";
    costs_more_than_the_cheapest(name) = "{name} costs more than the cheapest.";
    does_not_run_it_with_any(name, hints) = "{name} does not run it with any settings: {hints} says why.";
    does_not_meet_it_its_smallest(name, numbers) = "{name} does not meet it: its smallest error was {numbers}.";
    the_cheapest_settings_within_of_every_channel(within, table) = "The cheapest settings within {within} of every channel's scale:\n{table}\n";
    // report/compare.rs
    at_most_of_the_difference(numbers, but) = "at most {numbers} of the difference{but}";
    nothing_beyond_the_bounds(but) = "nothing beyond the bounds{but}";
    but_for_the_row_at_which_is_off(numbers) = ", but for the row at t = {numbers} s, which is off by itself";
    FOR_THE_MOST_PART_2 = "for the most part, ";
    crank_angle_deg(time, crank) = "t = {time} s, crank angle {crank} deg";
    only_in_the(which, some) = "\nonly in the {which}: {some}";
    the_jumps_back_in_row_from_to_has_it_begun(what, row, from, to, unit) = "\nthe {what} jumps back in row {row}, from {from} to {to} {unit}: has it begun anew?";
    rows_and_hold_at_the_same(one, other, what, at, unit, channel, first, second) = "\nrows {one} and {other} hold at the same {what}, {at} {unit}, and contradict each other: {channel} is {first} and {second}";
    left_out_up_to_instants_of_a_channel(count) = "\nleft out: up to {count} instants of a channel at which nothing was measured";
    left_out_instants_of_the_second(unshared) = "\nleft out: {unshared} instants of the second that the first does not have";
    of_values(judged, of) = "{judged} of {of} values";
    of_channels(disagree, all) = "{disagree} of {all} channels";
    the_crank_angle_and_of_channels(disagree, all) = "the crank angle, and {disagree} of {all} channels";
    the_crank_angle_and_none(all) = "the crank angle, and none of {all} channels";
    all_channels(agree) = "all {agree} channels";
    THE_REST_IS_OFF_BY_LESS_THAN_A_FIFTIETH = "The rest is off by less than a fiftieth of its scale, as by the error of a method or of its step. Bounds are what digits and the analytic sides leave open: say what the other party is trusted to.";
    ALL_WITHIN_THEIR_BOUNDS = ", all within their bounds";
    and_more_6(more, is_fine) = "\nand {more} more{is_fine}";
}
