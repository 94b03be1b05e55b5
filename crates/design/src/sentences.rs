//! Every sentence that this crate can show. All sentences are in one place, so that they can be read as a list.

linkage::sentences! {
    // bearings.rs
    PEAKS_ARE_LOOKED_FOR_OVER = "peaks are searched for over the crank angle, but the drive's law may reach an angle more than once";
    // drive/catalogue.rs
    GIVE_BREAKDOWN_TORQUE_OVER_RATED = "give the breakdown torque divided by the rated torque, usually 2 to 3, or leave it out";
    THE_BREAKDOWN_TORQUE_IS_NOT_ABOVE = "the breakdown torque is not above the rated torque";
    CHECK_THE_TWO_SPEEDS_AND_THEIR = "check the two speeds and their units";
    THE_RATED_SPEED_IS_NOT_BELOW = "the rated speed is not below the synchronous speed";
    ADD_A_TABLE_MOTORS_FOR_EACH = "add a table `[[motors]]` for each motor";
    THE_CATALOGUE_HOLDS_NO_MOTOR = "the catalogue contains no motor";
    GIVE_THE_PATH_OF_A_CATALOGUE = "give the path of a catalogue of motors, such as catalogues/motors.toml";
    the_catalogue_cannot_be_read(path, error) = "the catalogue {path} cannot be read: {error}";
    // clearance.rs
    PRESCRIBE_THE_DRIVES_OR_LET = "prescribe the drives, or let no more than one link move freely";
    clearance_knows_no_cams(name) = "clearance is not proven for cams such as \"{name}\"";
    LEAVE_THE_CAM_OUT = "leave the cam out and drive its follower";
    CLEARANCE_IS_LOOKED_FOR_OVER = "clearance is searched for over crank angles, but several degrees of freedom move under forces";
    // plan/builder.rs
    along_the_guide(joint) = ", along the guide {joint}";
    tangential_part_alpha_perpendicular_to(line) = "tangential part, alpha l, perpendicular to {line}";
    normal_part_along_omega(of) = "normal part along {of}, omega^2 l";
    coriolis_part_omega_perpendicular_to_the_guide(joint) = "Coriolis part, 2 omega x v, perpendicular to the guide {joint}";
    of_relative_to(quantity, own, under, along) = "{quantity} of {own} relative to {under}{along}";
    perpendicular_to(pair) = ", perpendicular to {pair}";
    of_the_point_of_link_under(word, under, guide, named, direction) = "{word} of {under}, the point of link {guide} under {named}{direction}";
    of_the_mass_centre_of_link(word, number, link, guide) = "{word} of the mass centre of link {number} ({link}){guide}";
    // sensitivity.rs
    NAME_A_KEY = "name a number of the file, such as `links.crank.mass_kg`";
    THE_CASE_DEPENDS_ON_NO_KEY = "no parameter, dimension, mass, or number of a law or load has a known effect on the figures";
    is_an_expression(name) = "`{name}` is given by an expression";
    NAME_THE_PARAMETERS_OF_THE_EXPRESSION = "name the parameters that the expression contains";
    no_number_of_the_file_is_called(name) = "no number of the file is called `{name}`";
    no_derivative_is_known(name, part) = "no derivative by `{name}` is known: how `{part}` depends on this number is not known";
    COMPARE_WITH_A_SWEEP = "instead, compare two values of the number in a sweep";
    a_reduced_quantity_is_not_differentiated(text) = "{text} uses masses as plain numbers, so no derivative of it is known";
    the_two_solutions_differ(figure, one, other) = "{figure}: analytic side 1 gives {one}, but the solution in dual numbers gives {other}";
    TAKE_ANOTHER_INSTANT = "the pose may be near a dead point; leave this instant out of the grid";
    // sensitivity/instants.rs
    no_sensitivities(reason) = "sensitivities cannot be computed: {reason}";
    A_LAW_BY_TABLE_KEEPS_NO_INPUT = "sensitivities cannot be computed: the motion law is a table or formula, and the grid is given by inputs; give the grid by times";
    NO_DERIVATIVE_IN_THIS_POSE = "no derivative exists: the pose is singular, or the input stands still";
    // sensitivity/tolerance.rs
    a_tolerance_has_no_derivative(key) = "`{key}` has a tolerance, but no known derivative";
    no_sampled_mechanism_can_be_solved(count) = "at most one of {count} random mechanisms can be solved";
    GIVE_SMALLER_TOLERANCES = "give smaller tolerances or more samples";
    // draw/clearance_sheet.rs
    smallest_distance_at(distance, names, crank) = "smallest distance {distance}: {names} at {crank}";
    first_collision_at(names, crank) = "first collision: {names} at {crank}";
    swept_by(body) = "swept by {body}";
    // draw/cyclogram_sheet.rs
    MOMENT_THAT_ALL_PHASES_ALLOW = "moment: the shaft angles at which every organ is in a phase that belongs to it";
    MAIN_SHAFT = "main shaft";
    // draw/graph_sheet.rs
    CRANK_ANGLE_DEG_2 = "crank angle φ, deg";
    scale_factor(graph, symbol, unit, scale, per) = "{graph} {symbol}, {unit}; scale factor {scale} {per}";
    // draw/motion_sheet.rs
    largest_error_rms_observed_order(one, significant, unit, share, significant_2, orders) = "{one}: largest error {significant} {unit} ({share:.2} %), rms {significant_2} {unit}, observed order {orders}";
    CHORDS_WHOSE_SLOPES_GIVE_THE_VELOCITY = "chords whose slopes give the velocity";
    EXACT_BY_THE_SOLVER = "exact, by the solver";
    scale_factor_2(channel, sub, scale, per) = "{channel}, scale factor μ{sub} = {scale} {per}";
    chord_method_and_graphical_integration(divisions) = "chord method and graphical integration, {divisions} divisions; errors as fractions of half the range of the exact curve";
    // draw/construction_sheet.rs
    construction_with_divisions(sort, divisions) = "construction by {sort}, {divisions} divisions; grey: the exact curve";
    scale_factor_of_time(sub, scale) = "scale factor of time μ{sub} = {scale} s/mm";
    pole_distance(name, pole) = "{name} = {pole} mm";
    the_curve_and_its(sort) = "the curve and its {sort}";
    GIVEN_EXACT_CURVE = "given: the exact curve";
    given_exact_curve_with_areas(pole) = "given: the exact curve; areas of the strips in mm² of the sheet, 1 mm of ordinate for {pole} mm²";
    found_with_largest_error(name, error, unit, share) = "{name}: largest error {error} {unit}, {share:.2} % of half the range";
    // draw/plan_sheet.rs
    INSTANT_CENTRES = "Instant centres and acceleration centres";
    turned_by(scale, sense) = "{scale}; turned by 90 deg {sense}, against the driving link";
    FROM_TO = "from → to";
    scale_factor_3(symbol, sub, scale, scripted) = "scale factor {symbol}{sub} = {scale} {scripted}";
    // draw/tornado_sheet.rs
    EFFECT_OF_ONE_PER_CENT = "change of the figure (%) if the number grows by 1 %";
    EFFECT_OF_THE_TOLERANCE = "change of the figure if the number grows by its tolerance";
    figure_with_its_value(figure, value, unit) = "{figure} = {value} {unit}";
    // draw/timing_sheet.rs
    WANTED_CURVE_REST_OR_AT_LEAST_SO = "required: cycloidal curve, rest, or at least this displacement";
    WANTED_REST_OR_AT_LEAST_SO = "required: rest, or at least this displacement";
    ACHIEVED_SHARE_OF_THE_STROKE = "achieved, share of the stroke";
    // diagram/motion.rs
    SOLVE_WITH_ANOTHER_SOLVER = "solve with another solver";
    does_not_provide(solver, channel) = "{solver} does not provide {channel}";
    GIVE_THE_DRIVE_A_CONSTANT = "give the drive a constant speed";
    THE_GRID_HAS_NO_STROKE = "all instants of the grid have the same slide";
    EXTEND_THE_GRID = "extend the grid over the stroke";
    THE_CHORD_METHOD_DIVIDES_A_TURN = "the chord method divides the motion into equal times, but the drive's speed changes";
    give_from_to_divisions(least, most) = "give from {least} to {most} divisions";
    a_turn_cannot_be_divided(divisions) = "the motion cannot be divided into {divisions} parts";
    allowed_here(names) = "allowed here: {names}";
    CHANNELS_ARE_NAMED_LIKE_POINT = "channels are named like point.B.x_m, point.B.y_m or link.crank.angle_rad";
    is_neither_a_position_nor(name) = "\"{name}\" is neither a position nor an angle";
    ask_for_its_diagram_shows(stem, endings) = "request {stem}{endings}: its diagram also shows this channel";
    is_a_derivative_already_a_motion(name) = "\"{name}\" is already a derivative; a motion diagram starts from a position or an angle";
    the_mechanism_has_no_channel(name) = "the mechanism has no channel \"{name}\"";
    // plan/planner.rs
    give_a_number_in(noun, unit) = "give a {noun} in {unit}, such as 70 or -30; or a time in s";
    name_some_of(all) = "name one or several of {all}";
    no_point_and_no_link_is_called(name) = "no point or link is called \"{name}\"";
    // plan/centre_sheet.rs
    pin(name) = "pin {name}";
    across_the_guide(name) = "across the guide {name}";
    both_centres_with_link_coincide(third) = "both centres with link {third} are this point";
    FROM_THE_VELOCITIES = "from the velocities: fewer than two lines through the centre are known";
    line_of_action_of(name) = "line of action of {name}";
    // draw/assur_figure.rs
    acceleration_of_by_its_leads(name, lines) = "Acceleration of the singular point {name} = {lines}";
    acceleration_of_by_false_positions(name, lines) = "Acceleration of {name} = {lines} by two false positions";
    NORMAL_PARTS_ALONG = "normal parts: ω² l of the lead, then that of the base link";
    TANGENTIAL_PARTS_ACROSS = "tangential parts, across the leads";
    LINE_OF_FALSE_POSITIONS = "line of false positions";
    LINE_OF_TRUE_POSITIONS = "line of true positions, across the arm from the outer joint to the point";
    acceleration_of(name) = "acceleration of {name}";
    false_position_for_alpha(link, alpha) = "false position, for alpha of link {link} = {alpha} rad/s²";
    acceleration_of_with_alphas(name, link, alpha, other, beta) = "acceleration of {name}; alpha of link {link} = {alpha}, of link {other} = {beta} rad/s²";
    // draw/centre_figure.rs
    AT_INFINITY = "at infinity";
    NOWHERE = "nowhere: it translates";
    EVERYWHERE = "everywhere: no motion";
    acceleration_centre_of_link(link) = "acceleration centre of link {link}";
    // plan/vectors.rs
    of_the_singular_point(quantity, name, lines) = "{quantity} of the singular point {name} = {lines}";
    // plan/scales.rs
    EXPECTED_TWO_NUMBERS_SUCH_AS = "expected two numbers greater than zero, such as 1:2";
    EXPECTED_A_SCALE = "expected a scale factor such as mu_v=0.02, the length of a vector on paper such as pa=100mm, 1:2, or crank";
    expected_a_scale_factor(name, unit) = "expected a scale factor greater than zero, such as {name}=0.02 in {unit}";
    expected_a_length_on_paper(name) = "expected a length greater than zero in mm, such as {name}=100mm";
    THE_CRANK_DOES_NOT_TURN_SO_ITS_SCALE = "the scale of the crank needs a crank that turns; here, the driving link does not turn";
    GIVE_A_SCALE_FACTOR_OR_A_LENGTH = "give a scale factor such as mu_v=0.02, or the length of a vector such as v_B=100mm";
    no_vector_and_no_side_is_called(name) = "no vector and no distance of two points is called \"{name}\"";
    name_a_vector_or_a_side(names) = "name a vector of the table, such as v_B, a distance of two points, such as OA, or one of {names}";
    is_given_twice(symbol) = "{symbol} is given twice";
    GIVE_ONE_SCALE_FOR_EACH_DRAWING = "give one scale for each drawing; `crank` sets mu_v and mu_a";
    has_no_length_here(name, mm) = "{name} is zero at this instant, so no scale makes it {mm} mm long";
    NAME_ANOTHER_VECTOR_OR_INSTANT = "name another vector, or choose another instant";
    the_drawing_would_be_mm_large(symbol, scale, paper) = "at {symbol} = {scale}, the drawing would be {paper:.4} mm large";
    give_a_scale_factor_from_to(symbol, from, to) = "give a {symbol} from {from} to {to}: drawings are 1 to 2000 mm large";
    // plan/singular.rs
    all_leads_meet_in_the_singular_point(names) = "all three leads meet in the singular point {names}: a dead point";
    TAKE_A_CRANK_ANGLE_A_LITTLE = "choose a slightly different crank angle";
    the_singular_point_lies_in_line(names) = "the singular point {names} lies in line with the outer joints: a dead point";
    the_leads_are_parallel_their(names) = "the leads {names} are parallel: their singular point lies at infinity";
    // export.rs
    written_by_linkproof(version) = "Written by linkproof {version}; SI units, plane of motion XOY.";
    written_by(version) = "Written by linkproof {version};";
    written_without_loads_by(version) = "Written by linkproof {version} without the loads of the scenario;";
    the_drive_of(joint, law, rate, unit) = "Joint {joint} is driven: law \"{law}\", rate of its coordinate at the start {rate} {unit}.";
    // export/cam.rs
    THE_MECHANISM_HAS_NO_CAM = "the mechanism has no cam, so there is no profile to write";
    ADD_A_CAM = "add a `[[transmissions]]` with `type = \"cam\"`";
    // export/limits.rs
    LEAVE_IT_OUT_OF_THE_SCENARIO = "leave it out of the scenario, and add it to the model by hand";
    A_MOTOR = "the motor of a free link";
    a_drive_with_the_law(drive) = "a drive with the law \"{drive}\"";
    a_load_of_type(sort) = "a load of type \"{sort}\"";
    without_a_hinge_on_the_ground(load) = "{load} on a link without a hinge on the ground";
    the_losses_of(name) = "the efficiency of \"{name}\"";
    a_cam(name) = "cam \"{name}\"";
    the_coupling_of(name) = "the coupling of joints by \"{name}\"";
    cannot_be_written_to(what, format) = "{what} cannot be written to {format}";
    // export/names.rs
    sdf_takes_no_joint_called(name) = "a link and a joint are called \"{name}\": SDF permits a name only once in a model";
    THE_ROOT_OF_THE_FILE_IS_WORLD = "the root of a URDF file is called \"world\", and no second link may have that name";
    sdf_reserves_the_name(name) = "SDF reserves the name \"{name}\"";
    // relations.rs
    WRITE_NO_RELATIONS = "write the file without relations of joints";
    RELATIONS_WITH_SEVERAL_DRIVES = "a relation of joints that depend on several drives";
    // relations/bound.rs
    WRITE_NO_RELATIONS_OR_STAY_AWAY = "write the file without relations of joints, or choose a range that does not come near a singular pose";
    no_error_of_the_relations_is_proven(coordinate) = "no bound on the errors of the joint relations can be proven where the driven joint's coordinate is about {coordinate}";
    // export/urdf.rs
    THE_RELATIONS_OF_THE_JOINTS = "Coordinates of the joints as polynomials of the driven joint's coordinate, with proven bounds (docs/formats.md).";
    URDF_PERMITS_NO_LOOPS = "Joints that close loops. URDF does not permit such joints, but Gazebo adds them to the tree.";
    // export/mjcf/effects.rs
    ITS_LENGTH_IS_THE_ANGLE_THAT_THE_LOAD = "The tendon's length is the angle that the load depends on.";
    ITS_LENGTH_IS_CONSTANT = "A transmission: the tendon's length is constant.";
    ITS_LENGTH_IS_THE_LINK_ANGLE = "The tendon's length is the link's angle.";
    FORCES_IN_WORLD_AXES_REFER = "Forces in world axes refer to this site.";
    // export/mjcf/limits.rs
    GIVE_THE_MOTOR_THE_LAW_LINEAR = "give the motor the law \"linear\" or \"constant\"";
    a_motor_with_the_law(name) = "a motor with the law \"{name}\"";
    a_load_of_type_that_acts(sort) = "a load of type \"{sort}\" that acts in one sense or on one side only";
    a_load_of_type_with_a_table(sort) = "a load of type \"{sort}\" with a table";
    // export/mjcf/model.rs
    GIVE_A_STEP_SUCH_AS = "give a step such as 1e-3";
    the_time_step_is_but_must(step) = "the time step is {step} s, but must be positive";
    // export/mjcf/names.rs
    the_file_would_have_two_sites(name) = "the file would have two sites called \"{name}\"";
    MUJOCO_TAKES_NO_EMPTY_NAMES = "MuJoCo accepts neither empty names nor names with control characters";
    MUJOCO_CALLS_THE_GROUND_WORLD = "MuJoCo calls the ground \"world\" and accepts no second body with that name";
    GIVE_IT_ANOTHER_NAME_IN_THE_SCENARIO = "give it another name in the scenario";
    // export/mjcf/write.rs
    WHAT_ACTS_ON_THE_BODY_IN_THE_JOINT = "Force or moment that the parent body exerts on the body at their joint, in the body's frame. Moments are about the joint's position and do not include frictionloss.";
    DRIVE_A_ROTOR_SO_HEAVY_THAT_ITS_SPEED = "Drive: a rotor so heavy that its speed stays at its initial value.";
    ROTOR_AND_REDUCER_OF_THE_MOTOR = "Rotor and reducer of the motor.";
    IT_HAS_NO_MASS_OR_NO_INERTIA = "The body has no mass or no moment of inertia: the file has a small value instead.";
    IT_HAS_NO_MASS = "The body has no mass: MuJoCo gets a small mass and a small moment of inertia instead.";
    IT_HAS_NO_INERTIA = "The body has no moment of inertia: MuJoCo gets a small value instead.";
    AS_STIFF_AS_A_STEP_ALLOWS = "As stiff as the time step allows: the time constant is raised to twice the time step.";
    // import.rs
    THE_XML_IS_OF_NO_KNOWN_KIND = "the file is XML, but neither a model for MuJoCo (`<mujoco>`) nor a file of Linkage (`<linkage2>`)";
    GIVE_A_LINK_OR_A_FILE = "give the share link of PMKS+ in quotes, a file of Linkage (.linkage2), or a model for MuJoCo that this program has exported (.xml)";
    // import/parts.rs
    imported_from(source) = "Imported from {source}";
    the_source_has_too_many_parts(count, most) = "the source has {count} links, joints and loads, but at most {most} are allowed";
    IMPORT_A_PART_OF_IT = "in the other program, remove the parts that do not belong to the mechanism, and export again";
    // import/write.rs
    THE_FRAME_OF_A_LINK_BEGINS_AT = "The frame of a link begins at its first point; its x axis points to the second.";
    THE_POSE_IS_THAT_OF_THE_SOURCE = "The pose at t = 0 is the pose in the source.";
    // import/finish.rs
    the_input_reaches_only(noun, from, to, unit) = "the {noun} reaches only from {from:.6} to {to:.6} {unit}: the grid covers a part of the way from the start in the direction of motion";
    // import/xml.rs
    the_file_is_no_xml(error) = "the file is not valid XML: {error}";
    SAVE_THE_FILE_AGAIN = "correct this line, or save the file again in the other program";
    the_element_has_no(element, name) = "`{element}` has no `{name}`";
    is_no_list_of_numbers(name, text) = "`{name}` is \"{text}\", but expected numbers separated by blanks";
    expected_so_many_numbers(name, count, found) = "`{name}` has {found} numbers, but expected {count}";
    it_leaves_the_plane(name, z) = "`{name}` has the third component {z}, but a planar mechanism has 0 there";
    // import/mjcf.rs
    the_element_is_left_out(element, name, line) = "`{element}`{name} in line {line} is not understood: it is left out";
    IMPORT_MODELS_THAT_EXPORT_WROTE = "the import reads only models that this program has exported";
    // import/mjcf/bodies.rs
    THE_BODY_TURNS_OUT_OF_THE_PLANE = "`axisangle` is not a rotation about z: the body leaves the plane";
    the_attribute_is_not_understood(name, element) = "`{name}` of a `{element}` is not understood";
    WRITE_THE_POSE_AS_AXISANGLE = "write the rotation of the body as `axisangle`, about z";
    the_body_has_no_inertial(name) = "body \"{name}\" has no `inertial`: it has no mass";
    // import/mjcf/joints.rs
    the_body_has_so_many_joints(count) = "the body has {count} joints, but expected one hinge or slide";
    the_joint_has_the_type(kind) = "the joint has the type \"{kind}\", but expected \"hinge\" or \"slide\"";
    THE_LOOP_HAS_NO_SITES = "`connect` does not name two sites of the file";
    // import/mjcf/drives.rs
    the_joint_moves_freely(name) = "joint \"{name}\" has no rotor that keeps its speed: it moves freely, and forces determine its motion";
    // import/mjcf/loads.rs
    the_transmission_is_left_out(name) = "\"{name}\" couples joints as a transmission, but the model does not state the kind of transmission; add a table [[transmissions]]";
    the_actuator_is_left_out(name, line) = "actuator \"{name}\" in line {line} is not understood: it is left out";
    // import/linkage2/elements.rs
    LINKAGE_HAS_NO_MASSES = "Linkage has no masses and no forces: the links have no mass";
    the_scale_is_left_out(factor) = "the scale factor {factor} of the drawing is ignored: lengths are taken as drawn, with 96 units to the inch";
    the_slider_has_no_path(name, line) = "slider \"{name}\" in line {line} does not name two ends of its path: it becomes a pin";
    THE_LINK_NAMES_NO_CONNECTOR = "the link names a connector that the file does not have";
    THE_WHEEL_HAS_NO_SIZE = "the wheel has no positive `size`";
    // import/linkage2/build.rs
    the_actuator_stands_still(name) = "actuator \"{name}\" has no stroke or no speed: it is not driven";
    the_actuator_makes_one_stroke(name, stroke, unit) = "actuator \"{name}\" moves to and fro by {stroke:.6} {unit} in Linkage: here it makes one stroke at the same speed";
    // import/linkage2/sliders.rs
    the_path_is_curved(name) = "the path of slider \"{name}\" is curved: it is left out";
    the_slider_has_no_guide(name) = "slider \"{name}\" is left out: no link contains both ends of its path, or the slider itself is on no link";
    // import/linkage2/gears.rs
    THE_RATIO_NEEDS_TWO_WHEELS = "the ratio does not have exactly two wheels";
    the_wheels_have_no_carrier(line) = "the axles of the wheels in line {line} are not on one link: the ratio is left out";
    // import/pmks.rs
    THE_SOURCE_HAS_SEVERAL_LINES = "the source has several lines, but it is not XML; a share link has one line";
    THE_ADDRESS_HAS_NO_QUERY = "the source is empty, or the address has nothing after its `?`: there is no mechanism";
    THE_LINK_HAS_ANOTHER_VERSION = "the share link has the newer form `pmks2:` of PMKS+, which this version does not read";
    // import/pmks/classic.rs
    THE_LINK_HAS_NO_UNIT = "the share link has no units and no masses: coordinates are taken as mm, the speed as rpm, or as mm/s for a slide";
    THE_RECORD_HAS_NO_KIND = "the record names no links, or no kind of joint after the links";
    the_kind_is_not_read(kind) = "joints of the kind {kind} are not read, only R and P";
    DRAW_A_SLIDE_AND_A_PIN = "draw the joint as a slide P and a pin R with a further link between them";
    // import/pmks/token.rs
    the_last_sign_of_the_link_is_wrong(sign, expected, length) = "the last character of the link is \"{sign}\", but after {length} characters it must be \"{expected}\": the link is incomplete or changed";
    COPY_THE_WHOLE_LINK = "copy the whole link again from the share dialog of PMKS+, and put it in quotes";
    the_record_ends_before(what) = "the record ends before {what}";
    is_no_number_of_a_link(text, what) = "found \"{text}\" as {what}, but a number consists of up to 9 of the signs 0-9, A-Z, a-z, _ and -";
    // import/pmks/records.rs
    are_no_flags_of_a_link(text) = "found \"{text}\" in place of the flags of this record";
    is_no_unit_of_lengths(text) = "found \"{text}\" as units, but the unit of lengths is 0 (in), 1 (cm) or 2 (m)";
    // import/pmks/build.rs
    NO_JOINT_IS_THE_INPUT = "no joint is the input; add a section [drive]";
    the_section_is_left_out(section) = "the section \"{section}\" is left out: marks for editing, gears and friction of development versions are not understood";
    THE_NAME_IS_GIVEN_TWICE = "two joints or links have this name";
    the_joint_is_called(wanted, name) = "joint \"{wanted}\" is called \"{name}\" here";
    the_link_is_called(wanted, name) = "link \"{wanted}\" is called \"{name}\" here";
    the_link_has_no_joint(id) = "the joint \"{id}\" is named, but does not exist";
    the_fixed_joint_has_no_link(name) = "joint \"{name}\" is fixed, but no link is there: it is left out";
    the_weld_is_a_pin(name) = "joint \"{name}\" is welded, but joins separate links: it becomes a pin";
    the_input_has_several_links(name) = "input \"{name}\" joins several links: it drives the first of them";
    the_slot_has_no_link(carrier) = "the slot is on the link \"{carrier}\", but there is no such link";
    the_slide_needs_one_block(count) = "the slide joins {count} links, but expected one block with a pin";
    the_slide_is_fixed(name) = "slide \"{name}\" is not fixed and has no slot: its guide is taken as fixed";
    the_input_joins_nothing(name) = "input \"{name}\" does not join two links: it is left out";
    its_own_speed_is_left_out(name) = "the separate speed of input \"{name}\" is not understood: the input gets the speed of the document";
    the_slide_has_the_speed(name, speed, unit) = "a share link contains no speed for the slide \"{name}\": it moves at {speed} {unit}/s along its direction";
    the_speed_is_zero(usual) = "the speed of the input is 0: it turns at {usual} rpm, as in a new document";
    the_force_has_no_link(link) = "the force acts on the link \"{link}\", but there is no such link";
    the_force_has_no_direction(name) = "force \"{name}\" has no direction: it is left out";
    // drive/flywheel.rs
    ASK_FOR_A_LARGER_COEFFICIENT = "request a larger coefficient";
    the_flywheel_for_a_coefficient(wanted, steps) = "the flywheel for a coefficient of non-uniformity of {wanted} was not found in {steps} steps";
    no_flywheel_makes_the_coefficient(wanted) = "no flywheel reaches a coefficient of non-uniformity of {wanted}";
    GIVE_A_NUMBER_ABOVE_ZERO = "give a number above zero, such as 0.02";
    a_coefficient_of_non_uniformity(wanted) = "a coefficient of non-uniformity of {wanted} is requested";
    // drive/motor.rs
    GIVE_A_CATALOGUE_WITH_STRONGER = "use a catalogue with stronger motors, or lower the peak of the resistance; a flywheel on the crank carries the mechanism over a peak";
    the_drive_asks_for_kw_the_strongest(asked, strongest) = "the drive needs {asked:.4} kW, but the strongest motor has {strongest:.4} kW";
    GIVE_THE_SCENARIO_THE_LOADS = "add the loads against which the drive works to the scenario";
    the_greatest_moment_of_resistance(greatest) = "the greatest moment of resistance is {greatest:.6} N·m: no motor is needed";
    GIVE_A_SHARE_ABOVE_AND_AT_MOST = "give a fraction above 0 and at most 1: 0.92 for 92 %";
    the_efficiency_is(efficiency) = "the efficiency is {efficiency}";
    // synthesize/redraw.rs
    GIVE_THE_TEXT_OF_THE_SCENARIO = "give the text of the scenario that the task names";
    the_drawing_has_no_where(name) = "the text of the drawing has no `{name}`, which the scenario of the task has";
    left_out_of_the_drawing_because(keys) = "\nThese keys of the drawing are left out, because they are valid only for the original dimensions: {keys}.\nThe comments below come from the drawing.";
    the_file_is_not_valid_toml(error) = "the file is not valid TOML: {error}";
    // synthesize/achieved.rs
    THE_MECHANISM_CANNOT_BE_ASSEMBLED = "the mechanism cannot be assembled over a whole turn of its crank, or its output does not rock";
    // synthesize/crank_rocker.rs
    GIVE_THE_ROCKER_A_PIVOT_OF_ITS_OWN = "give the rocker a separate pivot";
    BOTH_PIVOTS_ARE_ONE_POINT = "the two pivots coincide";
    GIVE_AN_ANGLE_BETWEEN_AND_DEG = "give an angle between -180 and 180 deg that is not zero";
    the_swing_is_deg(wish) = "the swing is {wish} deg";
    GIVE_A_LENGTH_GREATER_THAN_ZERO = "give a length greater than zero";
    the_rocker_length_is(rocker) = "the rocker's length is {rocker} m";
    GIVE_DECIMAL_NUMBERS = "give decimal numbers";
    A_COORDINATE_OR_AN_ANGLE = "a coordinate or an angle is not finite";
    MOVE_A_PIVOT_OR_TURN_THE_EXTREME = "move a pivot, or turn the extreme positions away from the line of the pivots";
    an_extreme_position_lies_on_the_line(told, found) = "{told}: within rounding error, an extreme position lies on the line through the pivots, so the four-bar would not be a crank-rocker but a {found}";
    CHOOSE_A_SMALLER_SWING_OR_PIVOTS = "choose a smaller swing, or pivots whose connecting line leaves both positions of B on one side";
    THE_LINE_OF_THE_TWO_PIVOTS = "the line through the two pivots passes between the two extreme positions, or through one of them: a crank could move the rocker from one to the other only if the dyad were taken apart";
    MOVE_A_PIVOT_OR_TURN_THE_EXTREME_POSITIONS = "move a pivot, or turn the extreme positions, so that B is farther from the crank's pivot in one extreme position than in the other";
    a_crank_of_no_length_would(told) = "{told}: a crank of zero length would be needed";
    is_from_in_one_extreme_position(distances, distances_2) = "O is {distances:.6} m from B in one extreme position and {distances_2:.6} m in the other";
    // synthesize/draft.rs
    JOINTS_NAME_GUIDE_TYPE_PRISMATIC = "[[joints]]\nname = \"guide\"\ntype = \"prismatic\"\nlinks = [\"ground\", \"slider\"]\npoints = [\"G\", \"B\"]\naxis_deg = 0\n\n";
    ground_points_on_the_slider(offset) = "[ground.points]\nO = {{ x_m = 0, y_m = 0 }}\nG = {{ x_m = 0, y_m = {offset} }} # on the slider's line\n";
    joints_name_type_revolute_links(name, first, second) = "[[joints]]\nname = \"{name}\"\ntype = \"revolute\"\nlinks = [\"{first}\", \"{second}\"]\n\n";
    // synthesize/precision/choice.rs
    NO_FOUR_BAR_PASSES_THE_POSITIONS = "no four-bar passes all positions";
    MOVE_A_POSITION_OR_LEAVE_ONE_OUT = "change a position a little, or leave one out: fewer positions have more solutions";
    // synthesize/precision/function.rs
    world_angles_of_so_many_pairs(count) = "world angles of {count} pairs determine no four-bar: Freudenstein's equation has three unknowns";
    LET_THE_START_BE_FREE = "give three pairs, or let the start be free, so that only the differences from the first pair matter";
    THE_PAIRS_DETERMINE_NO_FOUR_BAR = "Freudenstein's equation has no unique solution for these three pairs";
    CHANGE_A_PAIR_OR_FREE_THE_START = "change an angle, or let the start be free, so that only the differences from the first pair matter";
    ROCKER_AND_CRANK_TURN_ALIKE = "the rocker turns like the crank in all pairs, or not at all";
    CHANGE_A_PAIR_OR_USE_A_PARALLELOGRAM = "change a pair; a parallelogram turns the rocker like the crank";
    // synthesize/precision/motion.rs
    THE_POSES_ARE_ONE_ROTATION = "all poses are rotations about one point, or translations: no finite dyad is determined";
    TURN_A_POSE_OR_USE_A_PARALLELOGRAM = "change the angle or the point of a pose; one pin guides rotations about one point, a parallelogram guides translations";
    pivots_and_pins_are_given(count, poses) = "{count} pivots and pins are given with {poses} poses";
    GIVE_TWO_PIVOTS_OR_PINS_WITH_THREE_POSES = "give at most two pivots and pins together, and only with three poses: four or five poses determine all pivots and pins";
    the_pin_of_the_pivot_is_at_infinity(x, y) = "seen from the coupler, the pivot ({x:.6}, {y:.6}) m has its three positions on a line: its pin is at infinity";
    the_pivot_of_the_pin_is_at_infinity(x, y) = "the three positions of the pin ({x:.6}, {y:.6}) m of the coupler lie on a line: its pivot is at infinity";
    MOVE_THE_PIVOT_OR_THE_PIN = "move this pivot or pin, or leave it out";
    // synthesize/precision/path.rs
    THE_POINTS_ARE_A_CIRCLE = "the crank alone moves its pin through all points at these crank angles: no coupler is determined";
    MOVE_A_POINT_OR_CHANGE_A_CRANK_ANGLE = "move a point, or change a crank angle";
    // synthesize/precision/points.rs
    found_so_many_positions(count, least, most) = "found {count} positions, but expected {least} to {most}";
    GIVE_THREE_TO_FIVE_POSITIONS = "give three, four or five positions";
    positions_coincide(first, second) = "positions {first} and {second} coincide";
    LEAVE_ONE_OF_THE_POSITIONS_OUT = "leave one of the two out, or change it";
    // synthesize/search.rs
    DRAW_MORE_CANDIDATES_NARROW_THE_BOUNDS = "draw more candidates, narrow the bounds around a drawing that turns fully, or relax `limits`";
    none_of_candidates_can_be_assembled(candidates) = "none of {candidates} candidates can be assembled over a whole turn of the crank with the required transmission angle and stroke";
    // synthesize/slider_crank.rs
    ask_for_less_than_or_choose(most) = "give a time ratio below {most:.6}, or choose a smaller offset";
    a_time_ratio_of_is_out_of_reach(ratio, stroke, e) = "a time ratio of {ratio} cannot be reached with a stroke of {stroke:.6} m at an offset of {e:.6} m";
    GIVE_THE_LENGTH_OF_THE_ROD = "give the length of the rod instead of the time ratio, or change the offset";
    WITH_AN_OFFSET_THE_TWO_STROKES = "with an offset, the forward and the return stroke never take the same time";
    without_an_offset_both_strokes(ratio) = "without an offset both strokes take the same time, not {ratio} times as long";
    WITHOUT_AN_OFFSET_ANY_ROD = "without an offset any rod gives a time ratio of 1";
    the_time_ratio_is(ratio) = "the time ratio is {ratio}";
    GIVE_THE_TIME_OF_THE_SLOWER = "give the duration of the slower stroke divided by the duration of the faster stroke: 1 or more";
    give_a_rod_longer_than(shortest) = "give a rod longer than {shortest:.6} m";
    a_rod_of_is_too_short_for_a_stroke(rod, stroke, e) = "a rod of {rod:.6} m is too short for a stroke of {stroke:.6} m at an offset of {e:.6} m: the crank could not turn fully";
    the_rod_length_is(rod) = "the rod's length is {rod} m";
    the_offset_is(offset) = "the offset is {offset} m";
    GIVE_A_DECIMAL_NUMBER_FOR_A_CENTRAL = "give a decimal number; 0 for a central slider-crank";
    the_stroke_is(stroke) = "the stroke is {stroke} m";
    // synthesize/task.rs
    THE_SEARCH_HAS_NO_CANDIDATES = "a number in the section `search` is outside its limits";
    GIVE_COUNTS_OF_OR_MORE_AND_NO_MORE = "give counts from 1 to 1000000000, and no more refinements than candidates";
    LEAVE_TRANSMISSION_OUT = "leave `transmission` out";
    A_SMALLEST_TRANSMISSION_ANGLE_IS_ASKED = "a smallest transmission angle is required, but higher groups have no transmission angle";
    NOTHING_MAY_VARY = "no dimension may vary";
    ADD_A_TABLE_VARY_FOR_EACH = "add a table `[[vary]]` for each length or pivot to be found";
    NAME_THE_WORKING_POINT_OF_THE_OUTPUT = "name the working point of the output link: `working_point = \"8\"` in `[output]`";
    AN_ACCELERATION_IS_LIMITED_BUT_NO_POINT = "an acceleration is limited, but the output has no point";
    TAKE_A_SCENARIO_WITH_ONE_DRIVE = "use a scenario with one `[drive]`";
    THE_MECHANISM_HAS_SEVERAL_DRIVES = "the mechanism has several drives, but a timing belongs to one crank";
    // synthesize/task/timing.rs
    GIVE_EVERY_MOVING_PHASE_ITS_LEVEL = "give every moving phase its `level`, or leave out `follow`";
    THE_CURVE_IS_TO_BE_FOLLOWED = "the output must follow the curve, but some levels are not given";
    AN_OUTPUT_THAT_ROCKS_GOES = "an output that rocks goes forward and back in every turn";
    no_phase_goes_the_output(sense) = "no phase moves {sense}: the output would not return";
    LET_IT_END_AT_DEG = "let the last phase end at 360 deg";
    the_last_phase_ends_at_deg(to_degrees) = "the last phase ends at {to_degrees:.6} deg, not after a whole turn";
    GIVE_A_NUMBER_FROM_TO_BELOW = "give a number of at least 0 and below 1";
    THE_LEAST_DISPLACEMENT_IS_A_SHARE = "the least displacement is a fraction of the stroke";
    GIVE_A_NUMBER_FROM_TO = "give a number from 0 to 1";
    A_LEVEL_IS_A_SHARE_OF_THE_STROKE = "a level is a fraction of the stroke";
    LET_CRANK_ANGLES_ASCEND_FROM_PHASE = "let crank angles ascend from phase to phase; the first begins at 0";
    the_phase_leads_from_to_deg(phase, phase_2) = "the phase runs from {phase:.6} to {phase_2:.6} deg";
    JOIN_PHASES_OF_ONE_SENSE = "merge successive phases of the same sense";
    found_phases_more_than(phases, most_phases) = "found {phases} phases, more than {most_phases}";
    found_phases_but_a_motion(phases) = "found {phases} phases, but a motion has at least two";
    // synthesize/machine_file.rs
    CHECK_THE_NUMBERS_OF_THE_PHASES = "check the numbers of the phases; the first phase of a task has the number 1";
    the_phases_of_the_moment_have_nothing_in_common(name) = "no shaft angle lies in the given phases of all organs of the moment \"{name}\"";
    give_numbers_from_to(count) = "give numbers from 1 to {count}";
    the_organ_has_no_phase(key, number) = "\"{key}\" has no phase {number}";
    no_organ_is_called(key) = "no organ is called \"{key}\"";
    NAME_THE_SCENARIO_BESIDE = "name the scenario of the drive, relative to the directory of this file";
    NAME_THE_SYNTHESIS_FILE_BESIDE = "name the synthesis file of the organ, relative to the directory of this file";
    GIVE_EVERY_ORGAN_ANOTHER_NAME = "give every organ a different name";
    two_organs_are_called(name) = "two organs are called \"{name}\"";
    give_from_to_of_them(least, most, key) = "give {least} to {most} tables `[[{key}]]`";
    the_machine_has_so_many(count, key) = "found {count} {key}";
    GIVE_THE_PATH_OF_A_MACHINE_FILE = "give the path of a machine file, such as machine.toml";
    // synthesize/target.rs
    has_several_drives(name) = "{name} has several drives, but a task has one crank";
    TAKE_A_SCENARIO_WITH_A_CRANK = "choose a scenario whose first drive turns a crank";
    drives_a_slide(name) = "the drive of {name} is a slide, but phases are given over the angle of a crank";
    no_output_link_is_called(name, own) = "{name} has no link \"{own}\", and its last group does not have exactly one rocker";
    name_the_output_link(names) = "name the output link; the moving links are {names}";
    no_output_point_is_called(name, own) = "{name} has no point \"{own}\", and does not have exactly one point without a joint";
    name_the_output_point(names) = "name the output point; the points of moving links are {names}";
    // synthesize/task_file.rs
    NOTHING_ABOUT_THIS_POINT_VARIES = "no property of this point varies";
    PUT_ALL_THAT_VARIES_ABOUT = "put everything that varies about a point into one table";
    THIS_POINT_VARIES_ALREADY = "this point varies already";
    DRAW_THE_TWO_POINTS_IN_DIFFERENT = "draw the two points at different positions";
    point_of_the_drawing_lies(point_name) = "point \"{point_name}\" of the drawing coincides with another point of the link: its joints cannot be distinguished";
    link_has_no_point(link_name, name) = "link \"{link_name}\" has no point \"{name}\"";
    LET_FROM_BE_THE_SMALLER_OF_THE_TWO = "make `from` the smaller of the two";
    THE_GREATEST_VALUE_IS_BELOW = "`to` is below `from`";
    GIVE_A_WHOLE_NUMBER_FROM_ON = "give a whole number of at least 0";
    found_but_a_count_is_not_negative(found) = "found {found}, but a count must not be negative";
    GIVE_LESS_THAN_DEG_TO_DEG = "give less than 90 deg; 30 to 45 deg are usual";
    a_transmission_angle_of_deg(transmission) = "a transmission angle of {transmission:.6} deg cannot be kept over a turn";
    AN_OUTPUT_IS_ONE_LINK_OR_ONE_POINT = "an output is one link or one point";
    WRITE_LINK_LEVER_FOR_ITS_ANGLE = "write `link = \"lever\"` for its angle, or `point = \"F\"` and `along_deg = 90` for a coordinate";
    no_moving_link_has_a_point(name) = "no moving link has a point \"{name}\"";
    NAME_THE_MOVING_LINK_WHOSE = "name the moving link whose angle is the output";
    THE_GROUND_DOES_NOT_TURN = "the ground does not turn";
    is_no_sense_of_an_output(other) = "\"{other}\" is not a sense of an output";
    no_gradients(reason) = "a refinement with exact derivatives is not possible: {reason}";
    A_GROUP_HAS_DRIVEN_JOINTS = "a transmission angle is limited, and a group has driven joints";
    REFINE_BY_EVOLUTION = "write `refinement = \"evolution\"` in the section `search`";
    ONLY_GRADIENTS_KEEP_LIMITS = "an evolution strategy keeps neither precision points nor limits of quantities, clearance and mass";
    REFINE_BY_GRADIENTS = "write `refinement = \"gradients\"` in the section `search`";
    A_POINT_HAS_NO_POSITION = "a precision point needs both coordinates, an angle, or all three";
    GIVE_X_AND_Y_OR_AN_ANGLE = "write `x_mm` and `y_mm`, `angle_deg`, or all three";
    A_POINT_NEEDS_A_WORKING_POINT = "a precision point has coordinates, but the output link has no working point";
    LARGEST_ACCELERATION = "largest acceleration of the output point";
    SMALLEST_TRANSMISSION_ANGLE = "smallest transmission angle";
    no_limit_is_called(name) = "the synthesis file has no limit \"{name}\"";
    name_one_of(names) = "name one of: {names}";
    THE_DRAWING_HAS_NO_OUTLINES = "a clearance is limited, but the drawing has no section `clearance`";
    ADD_CLEARANCE_TO_THE_DRAWING = "add a section `clearance` with a radius or outlines to the drawing";
    is_no_refinement(word) = "\"{word}\" is not a method of refinement";
    LIMIT_A_CHANNEL = "limit a channel, or an expression of channels";
    A_QUANTITY_HAS_NO_LIMITS = "a limited quantity needs a number `from`, a number `to`, or both in ascending order";
    GIVE_FROM_OR_TO = "write `from = 0`, `to = 100` or both, in the unit of the quantity";
    is_no_sense_of_a_phase(word) = "\"{word}\" is not a sense of a phase";
    NAME_THE_SCENARIO_FILE_OF_THE_DRAWING = "name the scenario file of the drawing, in the directory of this file";
    GIVE_THE_PATH_OF_A_SYNTHESIS = "give the path of a synthesis file, such as sinker_task.toml";
    the_synthesis_file_cannot_be_read(path, error) = "the file {path} cannot be read: {error}";
    // exercise.rs
    the_motion_of_is_not_one_of_a_crank(name) = "{name} does not have exactly one drive whose motion follows from the crank angle alone";
    GIVE_A_SCENARIO_WITH_ONE_PRESCRIBED_DRIVE = "give a scenario with one prescribed drive at constant speed; a motion under forces has no answers by crank angle";
    no_numbers_of_of_this_sort(name, sorts) = "{name} has no {sorts} that can be changed";
    WRITE_THE_NUMBERS_AS_NUMBERS = "write the values as numbers, or name them in `[parameters]`; or make sheets with the original numbers of the files";
    none_of_draws_of_keeps_the_range(draws, name) = "none of {draws} draws of numbers for {name} keeps its range of motion";
    DRAW_CLOSER_TO_THE_NUMBERS = "draw closer to the numbers of the file, or allow a smaller transmission angle; dimensions that must be equal belong in `[parameters]`";
    has_too_few_poses_for_positions(name, count) = "{name} has large enough transmission angles at fewer than {count} whole degrees of the crank angle";
    ASK_FOR_FEWER_POSITIONS = "ask for fewer positions, or allow a smaller transmission angle";
}
