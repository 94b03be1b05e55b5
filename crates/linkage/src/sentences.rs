//! All messages that this crate can show, in one file, so that they can be read as a list.

crate::sentences! {
    // case/builder.rs
    use_one_of(known) = "use one of: {known}";
    intervals_are_requested(found, most) = "{found} intervals are requested; the limit is {most}";
    ASK_FOR_FEWER_INTERVALS = "request fewer instants";
    there_is_no_called(what, asked) = "there is no {what} called \"{asked}\"";
    NOTHING_DRIVES_THE_MECHANISM = "the mechanism has no drive";
    NAME_THE_DRIVEN_JOINT_WITH_CRANK = "name the driven joint with `crank`, `driven` or `free`";
    point_of_link(link) = "point of link \"{link}\"";
    GIVE_ITS_POINTS_WITH_GROUND = "give its points with `ground`";
    THE_MECHANISM_HAS_NO_GROUND = "the mechanism has no ground";
    // case/check.rs
    the_mode_is_none_of_group(mode, group) = "group {group} has no assembly mode \"{mode}\"";
    there_are_assembly_modes_but_groups(modes, groups) = "there are {modes} assembly modes, but {groups} groups";
    TAKE_FIRST_POSE_AT_THE_WORLD = "use `first_pose` at the coordinates of the drives, or another pose in which all joints are closed";
    link_is_away_from_its_start(name, off, unit) = "link \"{name}\" is {off} {unit} away from the start of its drive";
    joint_is_open_in_the_start(joint, at, gap, turn) = "joint \"{joint}\" is open in the start pose, {at}: by {gap} m and {turn} rad";
    link_has_no_place_in_the_start(link, pose) = "link \"{link}\" has no valid pose in the start pose: {pose}";
    the_ground_is_moved_in_the_start(poses) = "the ground is moved in the start pose: {poses}";
    the_start_pose_has_places(poses, links) = "the start pose has {poses} link poses, but there are {links} links";
    it_acts_in_joint_but_there(joint, count) = "the load acts in joint {joint}, but there are {count} joints";
    its_links_are_not_those_of_joint(name) = "the links of the load are not the links of joint \"{name}\"";
    joint_has_two_frictions(name) = "joint \"{name}\" has friction already";
    friction_grows_without_bound(name) = "at a change point, reactions and the friction of joint \"{name}\" grow without bound: leave out `through = \"smooth\"` or the friction";
    losses_grow_without_bound(name) = "at a change point, the losses of transmission \"{name}\" grow without bound: leave out `through = \"smooth\"` or the efficiency";
    a_number_is_not_finite_or_negative(load) = "a number is not finite, or negative where it must not be: {load}";
    it_acts_on_link_but_there(link, count) = "the load acts on link {link}, but there are {count} links";
    joint_drives_link_not(name, turned, said) = "joint \"{name}\" drives link \"{turned}\", not \"{said}\"";
    TAKE_STRUCTURE_OF_THE_MECHANISM = "use `Structure::of` with the mechanism and its driven joints";
    the_structure_of_parts_is_not_that_of_mechanism(given, own) = "the structure has {given} parts, but mechanism and drives give a structure of {own} parts";
    has_a_motor_but_only_the_crank(names) = "{names} has a motor, but only the crank may have a motor";
    hangs_on_a_moving_link_but_the_motion(names) = "{names} is attached to a moving link, but the motion is prescribed";
    GIVE_THE_CRANK_ANGLE_OF_THE_START = "give the crank angle of the start within a turn";
    starts_turns_away_the_limit(names, turns, value) = "{names} starts {turns} turns from zero; the limit is {value}";
    has_a_number_that_is_not_finite(names, drive) = "{names} has a number that is not finite or out of range: {drive}";
    joint_or_link_is_driven_already(names) = "{names}: joint or link is driven already";
    GIVE_THE_CRANK_A_LENGTH = "give the crank a length";
    moves_nothing_all_joints_of_the_link(names) = "{names} moves no point: all joints of the link lie at one point";
    the_joint_is_but_a_drive(names, joint) = "{names}: the joint is {joint}, and such a joint does not have this input";
    the_joint_does_not_carry(names) = "{names}: the joint does not carry a moving link of that name";
    the_drive_of_link_at_joint(link, joint) = "the drive of link \"{link}\" at joint \"{joint}\"";
    but_there_are_links_and_joints(message, links, joints) = "{message}, but there are {links} links and {joints} joints";
    drive_turns_link_at_joint(index, link, joint) = "drive {index} moves link {link} at joint {joint}";
    ASK_FOR_INSTANTS_AND_CRANK = "request instants and inputs that the drive reaches";
    the_grid_has_times_but_crank(times, cranks) = "the grid has {times} times, but {cranks} inputs";
    gravity_is(x, y) = "gravity is ({x}, {y}) m/s²";
    // case/grid.rs
    the_grid_leads_turns_away(most, value) = "the grid extends to {most} turns from zero; the limit is {value}";
    the_grid_leads_to_but_the_drive(t, name, end) = "the time {t} s is requested, but the drive's law \"{name}\" is defined from 0 to {end} s";
    the_grid_leads_to_but_drive(t, number, name, end) = "the time {t} s is requested, but the law \"{name}\" of drive {number} is defined from 0 to {end} s";
    the_drive_law_does_not_come(name, drive, value) = "the drive's law \"{name}\" reaches the requested {drive} {value} never or more than once; expected exactly one time";
    THE_MOTION_IS_FREE_WHEN_THE_CRANK = "the motion is free: the time at which the input reaches a value depends on the forces";
    // engine/bodies.rs
    GIVE_EVERY_LINK_BOTH = "give every link a mass and a moment of inertia";
    link_has_no_mass_or_no_moment(bare, software) = "link \"{bare}\" has no mass or no moment of inertia: {software} cannot move it under forces";
    // engine/extrapolated.rs
    from_runs_at(halves) = "from runs at {halves}";
    EXTRAPOLATED_FROM_RUNS_AT_THE_STEP = "extrapolated from runs at the step and at repeatedly halved steps";
    // error.rs
    the_run_stands_up_to(at) = "the results are valid up to {at}";
    the_run_stands_up_to_2(t) = "the results are valid up to t = {t:.6} s";
    // error/advice.rs
    LEAVE_ALL_LOADS_OUT = "leave all loads out, and add them to the model by hand";
    THE_COMPLETE_RESULTS_HAVE_ALL = "all of them are in the complete results";
    ASK_FOR_A_LARGER_ERROR_OTHER = "allow a larger error, request other channels, or admit more engines";
    name_a_channel_of_the_solution(groups) = "name a channel of the solution, such as joint.A.fx_N, or a group: {groups}";
    READ_THEM_OFF_A_TABLE_OF_THE_SOLUTION = "take the values from a table of the solution instead";
    THE_RANGE_OF_MOTION_SHOWS = "the range of motion shows what limits the crank and which links turn fully";
    SHORTEN_THE_GRID_TO_THE_CRANK = "shorten the grid to the inputs that can be reached on this branch";
    solve_the_scenario_with_side(solver) = "solve the scenario with side \"{solver}\" alone";
    take_side_as_the_reference(solver) = "use side \"{solver}\" as the reference";
    take_another_way_to_the_reactions(routes) = "choose another method for the reactions: {routes}";
    TAKE_ANOTHER_ENGINE = "use another engine";
    TAKE_AN_ENGINE_IN_DOUBLE = "use an engine in double precision";
    allow_more_memory_such_as_gb(rounded_up) = "allow more memory, such as {rounded_up:.1} GB";
    TAKE_FEWER_INSTANTS_OR_FEWER = "use fewer instants, or fewer channels (`want` in `[channels]`)";
    allow_more_work_such_as_steps(to) = "allow more work, such as {to} steps";
    LEAVE_OUT_THE_ENGINE_SETTINGS = "leave out the engine settings, so that the proof chooses them";
    raise_the_number_of_sweeps(to) = "raise the number of sweeps, for example to {to}";
    RAISE_THE_NUMBER_OF_SWEEPS_2 = "raise the number of sweeps";
    choose_a_looser_accuracy_such_as(to) = "choose a looser accuracy, such as {to}";
    choose_a_tighter_accuracy_such_as(to) = "choose a tighter accuracy, such as {to}";
    choose_a_larger_time_step(to) = "choose a larger time step, such as {to} s";
    CHOOSE_A_LARGER_TIME_STEP_2 = "choose a larger time step";
    choose_a_smaller_time_step(to) = "choose a smaller time step, such as {to} s";
    CHOOSE_A_SMALLER_TIME_STEP_2 = "choose a smaller time step";
    // error/several.rs
    more_mistakes_are_not_shown(many) = "{many} more mistakes are not shown";
    MORE_MISTAKE_IS_NOT_SHOWN = "1 more mistake is not shown";
    // mechanism.rs
    GIVE_THE_MASS_TOO_OR_LEAVE = "give the mass too, or leave out the moment of inertia";
    the_link_has_a_moment_of_inertia(inertia) = "the link has a moment of inertia ({inertia} kg·m²) but no mass";
    GIVE_A_NUMBER_THAT_IS_ZERO = "give a number that is zero or positive";
    the_is(what, value) = "the {what} is {value}";
    MOMENT_OF_INERTIA = "moment of inertia";
    RENAME_ONE_OF_THE_POINTS = "rename one of the points, or add the joint";
    links_and_both_have_a_point(other, body, point) = "links \"{other}\" and \"{body}\" both have a point \"{point}\", but no joint connects them";
    THE_LINK_HAS_TWO_POINTS_OF_THIS_NAME = "the link has two points of this name";
    NAME_TWO_DIFFERENT_LINKS = "name two different links";
    it_joins_with_itself(link) = "it joins \"{link}\" with itself";
    GIVE_THE_AXIS_BY_ITS_ANGLE = "give the axis by its angle";
    ITS_AXIS_IS_NO_UNIT_VECTOR = "its axis is not a unit vector";
    GIVE_EVERY_TRANSMISSION_ITS_OWN_NAME = "give every transmission a unique name";
    two_transmissions_are_called(name) = "two transmissions are called \"{name}\"";
    GIVE_EVERY_JOINT_ITS_OWN = "give every joint a unique name";
    two_joints_are_called(joint) = "two joints are called \"{joint}\"";
    GIVE_EVERY_LINK_ITS_OWN_NAME = "give every link a unique name (\"ground\" is taken)";
    two_links_are_called(link) = "two links are called \"{link}\"";
    NAMES_CONSIST_OF_LETTERS_DIGITS = "names consist of at most 100 letters, digits, `_`, `-` and `'`";
    cannot_be_a_name(chars) = "\"{chars}\" cannot be a name";
    // mechanism/assembly/blame.rs
    of_the_group_or_check_the_lengths(fits, own, later) = "{fits} of the group ({own}), or check the lengths and approximate positions of ({later})";
    this_configuration_of_the_group(own, later, fits, error) = "this configuration of the group ({own}) does not fit the group ({later}), but {fits} does: {error}";
    // mechanism/assembly/choice.rs
    CHECK_ITS_COORDINATES_AND_THEIR = "check its coordinates and their unit";
    from_the_nearest_configuration_farther(rough_places, first) = "{rough_places} {first:.4} m from the nearest configuration, more than the length of the longest link";
    A_PLACE_NEARER_TO_THE_CONFIGURATION = "a position nearer to the intended configuration, or its mode";
    from_the_and_from_the_configuration(rough_places, first, named, second, named_2) = "{rough_places} {first:.4} m from the {named} and {second:.4} m from the {named_2} configuration: it decides for neither";
    CORRECT_THE_MODE_OR_THE_ROUGH = "correct the mode or the approximate position; the wrong branch is never chosen silently";
    nearer_to_another_configuration_than_to_mode(rough_places, mode) = "{rough_places} nearer to another configuration than to mode {mode}";
    THE_ROUGH_PLACE_IS = "the approximate position is";
    the_rough_places_of_points(first, last) = "the approximate positions of points {first} and {last} are";
    the_rough_place_of_point(one) = "the approximate position of point {one} is";
    NO_ROUGH_PLACE_IS_GIVEN_FOR_THIS_GROUP = "no approximate position is given for this group, which has up to six configurations";
    add_mode_or_mode_or(one, other, near) = "add `mode = \"{one}\"` or `mode = \"{other}\"`, or {near}";
    NEITHER_AN_ASSEMBLY_MODE_NOR = "neither an assembly mode nor an approximate position is given for this group";
    a_number_from_to(count) = "a number from 1 to {count}";
    configuration_is_asked_for_but_the_group(rank, count) = "configuration {rank} is requested, but the group has {count} here";
    configuration_is_asked_for_but_the_group_has_here(rank) = "configuration {rank} is requested, but the group has 1 here";
    // mechanism/assembly/dyads.rs
    its_outer_joints_are_apart(distance, across) = "its outer joints are {distance:.6} m apart, but its links keep them {across:.6} m apart perpendicular to the axis of its prismatic joint";
    its_inner_joint_slides_along(height, length) = "its inner joint slides along a line {height:.6} m away from its outer pin, but its rod is {length:.6} m long";
    its_outer_joints_are_apart_its_links(distance, radius_1, radius_1_2) = "its outer joints are {distance:.6} m apart, but its links span {radius_1:.6} to {radius_1_2:.6} m";
    CHECK_THE_AXES_OR_START_AT_A_CRANK = "check the axes, or start at an input at which they cross";
    the_dyad_cannot_be_assembled(sine) = "the dyad cannot be assembled: the axes of its two prismatic joints are parallel (sine {sine})";
    CHECK_THE_LENGTHS_AND_THE_GROUND = "check the lengths and the ground points, or start at an input that can be reached";
    the_dyad_cannot_be_assembled_2(what) = "the dyad cannot be assembled: {what}";
    // mechanism/assembly/four_link.rs
    THE_GROUP_CANNOT_BE_ASSEMBLED = "the group cannot be assembled: it has no real configuration";
    CHECK_THE_LENGTHS_AND_AXES = "check the lengths and axes: two links of the group may be parallel and equal by mistake";
    THE_GROUP_CAN_MOVE_WHILE = "the group can move while its outer joints are held: its lengths are singular";
    START_FROM_A_ROUGH_DRAWING = "start from a rough drawing: give `near` for enough points; or drive another link, which may split the group";
    the_configurations_of_a_group(links, class) = "the configurations of a group of {links} links of class {class} are not all known";
    // mechanism/assembly/rough.rs
    GIVE_NEAR_FOR_TWO_POINTS = "give `near` for two points of the link, or for one point if the link has a joint with a link that is already placed";
    the_rough_places_do_not_tell(name) = "the approximate positions do not determine where link \"{name}\" of the group lies";
    GIVE_PLACES_NEARER_TO_THE_CONFIGURATION = "give positions nearer to the intended configuration, or more of them; or check the lengths";
    the_configuration_found_from_the_rough(point, distance, half) = "in the configuration found from the approximate positions, point \"{point}\" is {distance:.4} m from its approximate position, more than half a link ({half:.4} m)";
    NO_CONFIGURATION_OF_THE_GROUP = "no configuration of the group is found from the approximate positions";
    // mechanism/structure.rs
    THE_DRIVEN_JOINT_TURNS_LINKS_WITH_KEPT_ANGLES = "the driven joint gives an angle between two links, but other drives and prismatic joints already fix this angle";
    DRIVE_ANOTHER_JOINT = "drive another joint, or make one of the prismatic joints revolute";
    the_mobility_is_but_the_number(n, p, mobility, drives) = "the mobility is W = 3*{n} - 2*{p} = {mobility}, but the number of drives is {drives}";
    the_mobility_with_transmissions_is(n, p, t, mobility, drives) = "the mobility is W = 3*{n} - 2*{p} - {t} = {mobility}, with {t} transmissions, but the number of drives is {drives}";
    the_start_joint_of_a_transmission_changes(group) = "given coordinates of the start joints of the transmissions would change group {group}, although this group contains no transmission";
    the_start_joint_is_driven(name, joint) = "the start joint \"{joint}\" of transmission \"{name}\" is driven";
    GIVE_A_JOINT_OF_THE_TRANSMISSION = "name another joint of a member or of the carrier with `start_joint`";
    the_start_of_the_transmissions(message) = "with given coordinates of the start joints of the transmissions: {message}";
    THE_MECHANISM_IS_OVER_CONSTRAINED = "the mechanism is over-constrained: remove the surplus joints or drives";
    ADD_THE_MISSING_JOINTS_OR_DRIVES = "add the missing joints or drives, or remove the loose links";
    LINKS_THAT_ARE_JOINED_BY_PRISMATIC = "links that are connected by prismatic joints only cannot turn relative to each other: one joint of the loop must be revolute";
    THE_JOINT_CLOSES_A_LOOP_OF_PRISMATIC = "the joint closes a loop of prismatic joints only";
    join_to_another_link_or_take(name) = "join \"{name}\" to another link, or remove it";
    THE_LINK_IS_NOT_CONNECTED = "the link is not connected to the ground by any chain of joints";
    GIVE_THE_DRIVES_FROM_THE_GROUND = "give the drives from the ground outwards, first the drive of the carrying link";
    joint_hangs_on_link_which_is_driven(joint, name) = "joint \"{joint}\" is attached to link \"{name}\", which is driven later";
    // mechanism/structure/group.rs
    inner_and_outer_pairs(inner, outer) = "{inner} inner and {outer} outer pairs";
    // mechanism/structure/owners.rs
    THE_COUNT_OF_JOINTS_IS_RIGHT = "the total number of joints is right, but some joints connect the wrong links: move a joint";
    the_links_are_over_constrained(names) = "the links {names} are over-constrained, while other links are free to move";
    // solver.rs
    LET_THE_GRID_GO_BY_TIME_FROM_ON = "define the grid by time, from 0 s on";
    the_motion_is_free_from_on_but_an_instant(t) = "the motion is free from t = 0 on, but an instant at {t} s is requested";
    // trajectory.rs
    is_at(channel, column, times, default) = "{channel} is {column} at t = {times:.6} s, {default}";
    THE_COLUMNS_OF_A_TRAJECTORY = "the columns of a trajectory differ in length";
    // trajectory/channel.rs
    MASS_CENTRE_ACCELERATION = "mass centre acceleration";
    MASS_CENTRE_VELOCITY = "mass centre velocity";
    MASS_CENTRE_POSITION = "mass centre position";
    // work.rs
    the_work_that_is_allowed(allowed) = "the work limit of {allowed} steps was reached before the motion was solved";
    // mechanism/assembly/configurations.rs
    the_configurations_of_the_train(group) = "the configurations of the train ({group}) depend on the turns of its wheels";
    // mechanism/transmission.rs
    MOVE_THE_AXLES_APART = "check the positions of the axles, the numbers of teeth and the radii";
    THE_MEMBERS_CANNOT_TOUCH = "the members cannot touch: the axles coincide, or the wheels overlap";
    THE_FLAT_FOLLOWER_DOES_NOT_SLIDE = "no prismatic joint connects the flat follower with the carrier";
    JOIN_THE_FOLLOWER = "join follower and carrier by a prismatic joint, or use a roller";
    JOIN_THE_RACK = "join rack and carrier by a prismatic joint";
    THE_RACK_DOES_NOT_SLIDE = "no prismatic joint connects the rack, the second link, with the carrier";
    JOIN_THE_MEMBER_TO_THE_CARRIER = "join the wheel to the carrier by a revolute joint, or to a third link that is joined to the carrier at the same point";
    the_member_has_no_axle(link, carrier) = "link \"{link}\" has no axle on the carrier \"{carrier}\"";
    NAME_TWO_MEMBERS = "name two different members and, with `carrier`, the link that carries their axles";
    the_efficiencies_are(forward, back) = "the efficiencies are {forward} from the first member to the second and {back} from the second to the first";
    GIVE_EFFICIENCIES = "give an `efficiency` from 1e-6 to 1, and an `efficiency_back` from -1e6 to 1";
    A_CAM_HAS_NO_EFFICIENCY = "a cam has no efficiency";
    GIVE_FRICTION = "give friction to the joints of cam and follower";
    NO_MEMBER_IS_JOINED_TO_THE_CARRIER = "the transmission has an efficiency, but no member has a joint with the carrier";
    JOIN_A_MEMBER_TO_THE_CARRIER = "join one member to the carrier";
    A_TRANSMISSION_NEEDS_THREE_LINKS = "the two members and the carrier are not three different links";
}
