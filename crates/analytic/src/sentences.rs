//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // reduced/means.rs
    THE_REDUCTION_KNOWS_NO_FRICTION = "quantities reduced to the crank are requested, but the friction of joints depends on their reactions, which the reduction cannot represent";
    LET_THE_MOTION_BE_FREE = "let forces move the crank with `motion = \"free\"` in [drive] and solve the motion over time, or leave out the friction";
    the_drive_moves_no_crank(noun) = "quantities reduced to the crank are requested, but the input of the drive is a {noun}";
    DRIVE_THE_MECHANISM_AT_A_CRANK = "drive a link that is hinged to the ground, or claim `drive.reduced_mass_kg` and `drive.reduced_force_N` as formulas";
    // range/tracking.rs
    the_slide_has_no_limit(at) = "the mechanism can be followed up to {at} without reaching a limit";
    THE_MECHANISM_MOVES_OVER = "no limit was found in this direction from the start, so the grid may contain any input in this direction";
    ONE_OF_SEVERAL_DRIVES_CHANGES = "the range of motion is a curve only if all drives have constant speeds, and one of several drives changes its speed";
    GIVE_THE_DRIVES_CONSTANT_SPEEDS = "give all drives constant speeds";
    // assur/passing.rs
    PASS_IT_WITH_THROUGH_SMOOTH = "pass this pose with `through = \"smooth\"` in [drive], if two branches meet there";
    LET_THE_GRID_END_BEFORE_IT = "end the grid before this pose";
    LEAVE_THIS_VERY_INSTANT_OUT = "choose another step or start of the grid so that this instant is left out, or leave out the reactions: want = [\"positions\", \"velocities\", \"accelerations\"] in [channels]";
    this_is_a_change_point_and_towards(at) = "{at}: this is a change point; reactions grow without bound towards it, because the constraints of the links are singular there";
    // assur/pose_solver.rs
    CHECK_THE_LENGTHS = "check the lengths";
    the_group_cannot_be_followed(group, at) = "the group ({group}) cannot be followed beyond {at}: it has a dead point there";
    CHANGE_A_LENGTH_BY_A_LITTLE = "change a length slightly";
    the_group_passes_a_change(group, at, meet) = "the group ({group}) passes a change point at {at}: {meet}";
    the_group_is_singular_at(group, at, meet) = "the group ({group}) is singular at {at}: {meet}";
    its_two_axes_are_parallel(assembled) = "{assembled}: its two axes are parallel there";
    its_outer_pins_are_apart(assembled, distance, shortest) = "{assembled}: its outer pins are {distance:.6} m apart, but its slider keeps them at least {shortest:.6} m apart";
    its_rod_is_long_its_outer(assembled, length, distance) = "{assembled}: its rod is {length:.6} m long, but its outer pin is {distance:.6} m from the line on which the other end slides";
    its_outer_joints_are_apart(assembled, distance, shortest, longest) = "{assembled}: its outer joints are {distance:.6} m apart, but its links span {shortest:.6} to {longest:.6} m";
    the_group_cannot_be_assembled(group, at) = "the group ({group}) cannot be assembled at {at}";
    THERE_THE_LINKS_OF_THE_GROUP = "the group is not fully constrained there, or two of its branches meet";
    // assur/transfer.rs
    LET_THE_GRID_END_BEFORE_THE_MOTION = "end the grid before the motion reaches this pose";
    the_group_is_singular_at_two(group, at) = "the group ({group}) is singular at {at}: two of its branches meet there";
    // assur/forces/friction.rs
    friction_locks_the_mechanism(at) = "{at}: friction locks the mechanism; no forces in the joints are in equilibrium with their friction";
    friction_allows_several_states(at) = "{at}: friction leaves the forces undetermined; several states of the forces are in equilibrium";
    LOWER_A_COEFFICIENT_OF_FRICTION = "lower a coefficient of friction or the radius of a journal, lengthen a guide, drive another joint, or end the grid before this pose";
    // newton/friction.rs
    FRICTION_HAS_NO_EQUILIBRIUM = "friction locks the mechanism: no reactions satisfy equilibrium with friction";
    // assur_solver.rs
    LET_THE_GRID_END_BEFORE_OR_GIVE = "end the grid before this instant, or give the motor more torque";
    THE_MOTION_ENDS = "the motion ends";
    THE_CRANK_COMES_TO_A_LIMIT = "the crank reaches a limit of its rotation";
    LOADS_HOLD_THE_MECHANISM = "the loads stall the mechanism";
    // motion/flow.rs
    GIVE_THE_MOTOR_MORE_TORQUE = "give the motor more torque or the mechanism more speed, or end the grid before this instant";
    link_at_rest_at(what, name, x) = "{what} link \"{name}\" at rest at t = {x:.6} s";
    ITS_RESISTANCE_HOLDS = "a resistance holds";
    FRICTION_HOLDS = "friction holds";
    THE_LOSSES_OF_THE_REDUCER = "the losses of the reducer hold";
    // motion/free.rs
    A_LOAD_THAT_TURNS_ABOUT_JUST = "a load reverses exactly at this point, and so holds and releases the link in turn: start slightly beside this point";
    the_motion_does_not_get_away(from) = "the motion cannot be continued beyond t = {from:.9} s, where a direction of motion reverses";
    LET_THE_GRID_END_BEFORE_WHERE = "end the grid before this instant; where the inertia nearly vanishes at a crank angle, give the crank or the rotor a moment of inertia";
    GIVE_THE_LINKS_MASSES_OR_THE_MOTOR = "give the links masses, or the motor a rotor";
    THE_MOTION_UNDER_FORCES_IS_ASKED = "the motion under forces is requested, but no part of the mechanism has a mass";
    PRESCRIBE_THE_MOTION_OF_SOME = "prescribe the motion of some of these links";
    driving_links_are_free_at_most(free, most_freedoms) = "{free} driving links move freely, but at most {most_freedoms} can be solved";
    // motion/march.rs
    IT_RUNS_AWAY_OR_A_LOAD_TURNS = "the speed grows without bound, or a load reverses again and again: check loads and motor, or end the grid earlier";
    of_the_motion_has_gone_in_pieces(last, x, value) = "the motion had to be divided into {value} pieces within the first {x:.9} s of {last} s";
    NO_STEP_REACHES_ITS_BOUND = "no time step can be made to end where a load or the motor's law changes";
    ITS_STEPS_BECOME_TOO_SMALL = "the time steps become too small, as at a singular pose (dead point or change point)";
    of_steps_it_is_only_on_of(steps, way, last) = "{steps} steps have covered only {way} of {last}";
    // motion/side.rs
    GIVE_ITS_LINKS_OR_THE_MOTOR = "give the links, or the motor's rotor, a moment of inertia";
    THE_EQUATIONS_OF_MOTION_ARE_SINGULAR = "the equations of motion are singular: a degree of freedom has no inertia at this pose";
    // motion/step.rs
    WHERE_MASSES_NEARLY_VANISH_AT_A_CRANK = "the equation is stiff where the inertia nearly vanishes at a crank angle: give the crank or the rotor a moment of inertia";
    the_equation_of_motion_cannot(x, why) = "the equation of motion cannot be integrated beyond {x:.9} (time in s; crank angle in rad in a steady motion): {why}";
    A_STEP_ONTO_A_KINK_WAS_REFUSED = "a step that ends at a kink was refused";
    // newton/free.rs
    THE_SOLUTION_HAS_JUMPED_TO_ANOTHER = "the solution has jumped to another branch";
    // newton/passing/multipliers.rs
    this_is_a_change_point_and_towards_it_reactions(at) = "{at}: this is a change point; reactions grow without bound towards it";
    THE_JACOBIAN_IS_SINGULAR_THERE = "the Jacobian is singular there (dead point)";
    // newton/passing/window.rs
    VELOCITIES_JUMP_THERE_CHANGE_POINT = "velocities jump there (change point)";
    THERE_ARE_TWO_CHANGE_POINTS = "two change points are close together";
    LET_THE_GRID_END_BEFORE = "end the grid before this point";
    beside_this_change_point_the_branch(at, why) = "{at}: the branch with continuous velocities cannot be determined near this change point{why}";
    // newton/steps.rs
    THE_POSE_IS_SINGULAR_THERE = "the pose is singular there (dead point or change point)";
    THE_MECHANISM_HAS_PASSED_A_DEAD = "the mechanism has passed a dead point before this instant";
    NEWTON_METHOD_DOES_NOT_CONVERGE = "Newton's method does not converge there";
    up_to_turns_on_the_way_to_are_too(turns, t) = "up to {turns} turns until {t} s are too many to follow";
    // range.rs
    from_to_on_this_branch(from, to, unit) = "from {from:.6} to {to:.6} {unit} on this branch";
    which_inputs_can_be_reached(noun, why) = "; the reachable {noun}s are not known: {why}";
    inputs_can_be_reached(noun, interval) = "; reachable {noun}s: {interval}";
    // range/grashof.rs
    CHANGE_POINT_MECHANISM = "change-point mechanism (s + l = p + q)";
    TRIPLE_ROCKER_NON_GRASHOF = "triple-rocker (non-Grashof, s + l > p + q)";
    DOUBLE_ROCKER_GRASHOF_THE_COUPLER = "double-rocker (Grashof, the coupler is shortest)";
    DOUBLE_CRANK_DRAG_LINK_GRASHOF = "double-crank, drag link (Grashof, the frame is shortest)";
    ROCKER_CRANK_GRASHOF_THE_OUTPUT = "rocker-crank (Grashof, the output link is shortest: the driving link rocks)";
    CRANK_ROCKER_GRASHOF_THE_DRIVING = "crank-rocker (Grashof, the driving link is shortest)";
    // range/singularity.rs
    LIMIT_OF_ROTATION_DEAD_POINT = "limit of rotation (dead point)";
    // range/tracking.rs
    CHECK_THE_LENGTHS_OR_START = "check the lengths, or start at another crank angle";
    ASK_FOR_INSTANTS_OF_A_GRID = "use `solve` over the turns of interest";
    the_mechanism_does_not_return(turns) = "the mechanism does not return to its first pose within {turns} turns";
    the_poses_of_the_mechanism(at) = "the poses of the mechanism cannot be followed at {at}";
    START_AT_ANOTHER_CRANK_ANGLE = "start at another crank angle, where the configurations are distinct";
    the_start_pose_at_is_singular(at, names) = "the start pose at {at:.6} is singular: two configurations of the group ({names}) meet there";
    // reduced/means.rs
    CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER = "choose a stronger motor or a larger ratio; a constant torque has no stable speed";
    the_motor_has_no_stable_speed(resistance) = "the motor has no stable speed at which its moment on the crank is {resistance:.6} N·m";
    means_over_a_turn_are_asked(reached) = "means over a turn are requested, but the crank does not turn fully{reached}";
    it_can_be_turned_from_to_deg(to_degrees, to) = ": it can turn only from {to_degrees:.6} to {to:.6} deg";
    GIVE_THE_TABLES_TURNS_THAT_DIVIDE = "choose `turns` of the tables so that one number divides the other";
    mechanism_and_tables_of_loads(turns, most_turns) = "mechanism and load tables together repeat only after {turns} turns; the limit is {most_turns}";
    GIVE_IT_AS_A_TABLE_OF_FORCES = "give the load as a table of forces over the crank angle";
    reduced_quantities_are_asked_for_but_a_load(load) = "reduced quantities are requested, but the direction of a load of type \"{load}\" follows the motion of a point, which the reduction to the crank cannot represent";
    // reduced/model.rs
    FASTEN_IT_TO_LINKS_THAT_DO_NOT_TURN = "attach the load to links that do not turn relative to each other";
    IS_WOUND_UP_BY_EVERY_TURN = "is wound up by every turn of the crank";
    LEAVE_IT_OUT_OR_TAKE_ITS_PART = "leave this load out, or include it in the motor's law";
    DEPENDS_ON_THE_SIZE_OF_SPEEDS = "depends on the magnitude of speeds, which this reduction to the crank cannot represent";
    the_motion_under_forces_is_asked_for_but_a_load(load, why) = "the motion under forces is requested, but a load of type \"{load}\" {why}";
    TAKE_A_SCENARIO_WITH_ONE_DRIVE = "use a scenario with one `[drive]`";
    the_motion_under_forces_is_asked_for_but_the_mechanism(case) = "the motion under forces is requested, but the mechanism has {case} degrees of freedom: this version reduces the motion to one crank";
    // reduced/run_up.rs
    GIVE_THE_CRANK_A_SPEED_AT_OR_LET = "give the crank a speed at t = 0, or let the load act in both senses";
    at_the_crank_may_start_from_rest(t, at) = "at t = {t:.6} s, {at}, the crank may start from rest in either sense, because a load that acts in one sense only is driving it";
    A_LOAD_THAT_TURNS_ABOUT_JUST_THERE = "a load reverses exactly at this point, and so holds and releases the crank in turn: start slightly beside this point";
    the_motion_does_not_get_away_from_at(at, from) = "the motion cannot be continued beyond t = {from:.9} s, {at:.6}";
    GIVE_FINITE_TIMES_IN_ASCENDING = "give finite times from 0 s in ascending order";
    THE_INSTANTS_OF_A_MOTION = "the instants of a motion do not ascend from zero, or the speed is not finite";
    // steady/regime.rs
    CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER_RATIO = "choose a stronger motor or a larger ratio, or add a flywheel";
    the_motor_does_not_carry(crank) = "the motor cannot turn the crank through a full turn: it stalls beyond {crank:.3} deg";
    GIVE_CRANK_ANGLES_FROM_THE_START = "give crank angles that follow the start angle in the sense of motion";
    the_steady_speed_is_asked(crank) = "the steady speed is requested at {crank:.6} deg, which is not in the first period";
    FOLLOW_THE_RUN_UP_INSTEAD = "follow the run-up instead, and inspect the crank's speed";
    no_steady_motion_was_found(most_shots, share) = "no steady motion was found in {most_shots} Newton steps: each period multiplies a deviation by {share:.3}";
    ADD_A_MOTOR_SECTION_ITS_LAW = "add a `[motor]` section: its law, and the ratio of the reducer";
    A_STEADY_MOTION_IS_ASKED = "a steady motion is requested, but there is no motor";
    // witness/triad.rs
    TAKE_A_CRANK_ANGLE_AT_WHICH_THE_LINES = "choose a crank angle at which the lines of the leads form a triangle";
    the_lines_of_the_three_leads(method) = "{method}: the lines of the three leads meet in one point or are parallel, so the group has a dead point";
    // witness/triad/assur_point.rs
    SINGULAR_ASSUR_POINT = "singular Assur point";
    // witness/triad/class_change.rs
    USE_CRAMER_RULE_WHICH_TAKES = "use Cramer's rule, which works with any supports";
    class_change_asks_for_a_group(crank, names, supports) = "class change needs a group with two leads on the ground and one on the driving link \"{crank}\", which turns about the ground; the leads of the group ({names}) are attached to: {supports}";
    class_change_the_group_cannot(names, at) = "class change: the group ({names}) cannot be followed beyond {at}: it has a dead point there";
    // witness/triad/linear_system.rs
    LINEAR_SYSTEM_OF_THE_GROUP = "linear system of the group";
}
