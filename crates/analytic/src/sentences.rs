//! Every sentence that this crate can show, in one place, to be read as a list.

linkage::sentences! {
    // assur/passing.rs
    PASS_IT_WITH_THROUGH_SMOOTH = "pass it with `through = \"smooth\"` in [drive], if two branches meet there";
    LET_THE_GRID_END_BEFORE_IT = "let the grid end before it";
    LEAVE_THIS_VERY_INSTANT_OUT = "leave this very instant out by another step or start of the grid, or leave out the reactions: want = [\"positions\", \"velocities\", \"accelerations\"] in [channels]";
    this_is_a_change_point_and_towards(at) = "{at}: this is a change point, and towards it reactions grow without bound: they must do what the links no longer can";
    // assur/pose_solver.rs
    CHECK_THE_LENGTHS = "check the lengths";
    the_group_cannot_be_followed(group, at) = "the group ({group}) cannot be followed beyond {at}: it has a dead point there";
    CHANGE_A_LENGTH_BY_A_LITTLE = "change a length by a little";
    the_group_passes_a_change(group, at, meet) = "the group ({group}) passes a change point at {at}: {meet}";
    the_group_is_singular_at(group, at, meet) = "the group ({group}) is singular at {at}: {meet}";
    its_two_axes_are_parallel(assembled) = "{assembled}: its two axes are parallel there";
    its_outer_pins_are_apart(assembled, distance, shortest) = "{assembled}: its outer pins are {distance:.6} m apart, its slider holds them at least {shortest:.6} m apart";
    its_rod_is_long_its_outer(assembled, length, distance) = "{assembled}: its rod is {length:.6} m long, its outer pin {distance:.6} m from the line on which the other end slides";
    its_outer_joints_are_apart(assembled, distance, shortest, longest) = "{assembled}: its outer joints are {distance:.6} m apart, its links span {shortest:.6} to {longest:.6} m";
    the_group_cannot_be_assembled(group, at) = "the group ({group}) cannot be assembled at {at}";
    THERE_THE_LINKS_OF_THE_GROUP = "there the links of the group do not hold it, or two of its branches meet";
    // assur/transfer.rs
    LET_THE_GRID_END_BEFORE_THE_MOTION = "let the grid end before the motion comes there";
    the_group_is_singular_at_two(group, at) = "the group ({group}) is singular at {at}: two of its branches meet there";
    // assur_solver.rs
    LET_THE_GRID_END_BEFORE_OR_GIVE = "let the grid end before, or give the motor more torque";
    THE_MOTION_ENDS = "the motion ends";
    THE_CRANK_COMES_TO_A_LIMIT = "the crank comes to a limit of its rotation";
    LOADS_HOLD_THE_MECHANISM = "loads hold the mechanism";
    // motion/flow.rs
    GIVE_THE_MOTOR_MORE_TORQUE = "give the motor more torque or the mechanism more speed, or let the grid end before";
    link_at_rest_at(what, name, x) = "{what} link \"{name}\" at rest at t = {x:.6} s";
    ITS_RESISTANCE_HOLDS = "its resistance holds";
    THE_LOSSES_OF_THE_REDUCER = "the losses of the reducer hold";
    // motion/free.rs
    A_LOAD_THAT_TURNS_ABOUT_JUST = "a load that turns about just there holds and lets go in turn: start a little aside";
    the_motion_does_not_get_away(from) = "the motion does not get away from t = {from:.9} s, where a sense of motion changes";
    LET_THE_GRID_END_BEFORE_WHERE = "let the grid end before; where masses nearly vanish at a crank angle, give the crank or the rotor a moment of inertia";
    GIVE_THE_LINKS_MASSES_OR_THE_MOTOR = "give the links masses, or the motor a rotor";
    THE_MOTION_UNDER_FORCES_IS_ASKED = "the motion under forces is asked for, but nothing in the mechanism has a mass";
    PRESCRIBE_THE_MOTION_OF_SOME = "prescribe the motion of some of them";
    driving_links_are_free_at_most(free, most_freedoms) = "{free} driving links are free, at most {most_freedoms} are solved";
    // motion/march.rs
    IT_RUNS_AWAY_OR_A_LOAD_TURNS = "it runs away, or a load turns about all the time: check loads and motor, or end the grid before";
    of_the_motion_has_gone_in_pieces(last, x, value) = "of {last} s the motion has gone {x:.9} s in {value} pieces";
    NO_STEP_REACHES_ITS_BOUND = "no step reaches its bound";
    ITS_STEPS_BECOME_TOO_SMALL = "its steps become too small, as at a singular pose (dead point or change point)";
    of_steps_it_is_only_on_of(steps, way, last) = "of {steps} steps it is only {way} on, of {last}";
    // motion/side.rs
    GIVE_ITS_LINKS_OR_THE_MOTOR = "give its links, or the motor's rotor, a moment of inertia";
    THE_EQUATIONS_OF_MOTION_ARE_SINGULAR = "the equations of motion are singular: a freedom has no inertia at this pose";
    // motion/step.rs
    WHERE_MASSES_NEARLY_VANISH_AT_A_CRANK = "where masses nearly vanish at a crank angle it is stiff: give the crank or the rotor a moment of inertia";
    the_equation_of_motion_cannot(x, why) = "the equation of motion cannot be integrated beyond {x:.9}: {why}";
    A_STEP_ONTO_A_KINK_WAS_REFUSED = "a step onto a kink was refused";
    // newton/free.rs
    THE_SOLUTION_HAS_JUMPED_TO_ANOTHER = "the solution has jumped to another branch";
    // newton/passing/multipliers.rs
    this_is_a_change_point_and_towards_it_reactions(at) = "{at}: this is a change point, and towards it reactions grow without bound";
    THE_JACOBIAN_IS_SINGULAR_THERE = "the Jacobian is singular there (dead point)";
    // newton/passing/window.rs
    VELOCITIES_JUMP_THERE_CHANGE_POINT = "velocities jump there (change point)";
    THERE_ARE_TWO_CHANGE_POINTS = "there are two change points close together";
    LET_THE_GRID_END_BEFORE = "let the grid end before";
    beside_this_change_point_the_branch(at, why) = "{at}: beside this change point the branch on which velocities go on is not clear{why}";
    // newton/steps.rs
    THE_POSE_IS_SINGULAR_THERE = "the pose is singular there (dead point or change point)";
    THE_MECHANISM_HAS_PASSED_A_DEAD = "the mechanism has passed a dead point on the way there";
    NEWTON_METHOD_DOES_NOT_CONVERGE = "Newton's method does not converge there";
    up_to_turns_on_the_way_to_are_too(turns, t) = "up to {turns} turns on the way to {t} s are too many to be followed";
    // range.rs
    from_to_deg_on_this_branch(from, to) = "from {from:.6} to {to:.6} deg on this branch";
    which_crank_angles_can_be_reached(why) = "; which crank angles can be reached is not known: {why}";
    crank_angles_can_be_reached(interval) = "; crank angles can be reached {interval}";
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
    the_poses_of_the_mechanism(at) = "the poses of the mechanism cannot be followed at {at}";
    START_AT_ANOTHER_CRANK_ANGLE = "start at another crank angle, where the configurations are apart";
    the_start_pose_at_is_singular(at, names) = "the start pose at {at:.6} is singular: two configurations of the group ({names}) meet there";
    // reduced/means.rs
    CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER = "choose a stronger motor or a larger ratio; a constant torque balances nothing";
    the_motor_has_no_stable_speed(resistance) = "the motor has no stable speed at which its moment on the crank is {resistance:.6} N m";
    means_over_a_turn_are_asked(reached) = "means over a turn are asked for, but the crank does not turn fully{reached}";
    it_can_be_turned_from_to_deg(to_degrees, to) = ": it can be turned from {to_degrees:.6} to {to:.6} deg only";
    GIVE_THE_TABLES_TURNS_THAT_DIVIDE = "give the tables turns that divide each other";
    mechanism_and_tables_of_loads(turns, most_turns) = "mechanism and tables of loads repeat together after {turns} turns only, the limit is {most_turns}";
    GIVE_IT_AS_A_TABLE_OF_FORCES = "give it as a table of forces over the crank angle";
    reduced_quantities_are_asked_for_but_a_load(load) = "reduced quantities are asked for, but a load of type \"{load}\" turns with the motion of a point, which the reduction to the crank does not know";
    // reduced/model.rs
    FASTEN_IT_TO_LINKS_THAT_DO_NOT_TURN = "fasten it to links that do not turn against each other";
    IS_WOUND_UP_BY_EVERY_TURN = "is wound up by every turn of the crank";
    LEAVE_IT_OUT_OR_TAKE_ITS_PART = "leave it out, or take its part into the motor's law";
    DEPENDS_ON_THE_SIZE_OF_SPEEDS = "depends on the size of speeds, which this reduction to the crank does not know";
    the_motion_under_forces_is_asked_for_but_a_load(load, why) = "the motion under forces is asked for, but a load of type \"{load}\" {why}";
    TAKE_A_SCENARIO_WITH_ONE_DRIVE = "take a scenario with one `[drive]`";
    the_motion_under_forces_is_asked_for_but_the_mechanism(case) = "the motion under forces is asked for, but the mechanism has {case} freedoms: this version reduces to one crank";
    // reduced/run_up.rs
    GIVE_THE_CRANK_A_SPEED_AT_OR_LET = "give the crank a speed at t = 0, or let the load act in both senses";
    at_the_crank_may_start_from_rest(t, at) = "at t = {t:.6} s, {at}, the crank may start from rest in either sense: a load that acts in one sense only drives it";
    A_LOAD_THAT_TURNS_ABOUT_JUST_THERE = "a load that turns about just there holds and lets go in turn: start it a little aside";
    the_motion_does_not_get_away_from_at(at, from) = "the motion does not get away from {at:.6} at {from:.9} s";
    GIVE_FINITE_TIMES_IN_ASCENDING = "give finite times in ascending order, from 0 s on";
    THE_INSTANTS_OF_A_MOTION = "the instants of a motion do not ascend from zero, or the speed is not finite";
    // steady/regime.rs
    CHOOSE_A_STRONGER_MOTOR_OR_A_LARGER_RATIO = "choose a stronger motor or a larger ratio, or add a flywheel";
    the_motor_does_not_carry(crank) = "the motor does not carry the crank over a turn: it comes to a standstill beyond {crank:.3} deg";
    GIVE_CRANK_ANGLES_FROM_THE_START = "give crank angles from the start on, in the sense of motion";
    the_steady_speed_is_asked(crank) = "the steady speed is asked for at {crank:.6} deg, which is not in the first period";
    FOLLOW_THE_RUN_UP_INSTEAD = "follow the run-up instead, and look what the crank's speed does";
    no_steady_motion_was_found(most_shots, share) = "no steady motion was found in {most_shots} turns: a deviation is left by {share:.3} after a turn";
    ADD_A_MOTOR_SECTION_ITS_LAW = "add a `[motor]` section: its law, and the ratio of the reducer";
    A_STEADY_MOTION_IS_ASKED = "a steady motion is asked for, but there is no motor";
    // witness/triad.rs
    TAKE_A_CRANK_ANGLE_AT_WHICH_THE_LINES = "take a crank angle at which the lines of the leads form a triangle";
    the_lines_of_the_three_leads(method) = "{method}: the lines of the three leads meet in one point or are parallel, the group has a dead point";
    // witness/triad/assur_point.rs
    SINGULAR_ASSUR_POINT = "singular Assur point";
    // witness/triad/class_change.rs
    USE_CRAMER_RULE_WHICH_TAKES = "use Cramer's rule, which takes any supports";
    class_change_asks_for_a_group(crank, names, supports) = "class change asks for a group with two leads on the ground and one on the driving link \"{crank}\", turning about the ground; the leads of the group ({names}) hang on: {supports}";
    class_change_the_group_cannot(names, at) = "class change: the group ({names}) cannot be followed beyond {at}: it has a dead point there";
    // witness/triad/linear_system.rs
    LINEAR_SYSTEM_OF_THE_GROUP = "linear system of the group";
}
