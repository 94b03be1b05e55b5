//! Every sentence that this crate can show. All sentences are in one place, so that they can be read as a list.

linkage::sentences! {
    // branch.rs
    LET_THE_GRID_END_BEFORE_THE_CHANGE = "end the grid before the change point";
    the_engine_has_not_gone_on_smoothly(names, t, at) = "the engine did not continue smoothly at the change point of the group ({names}) before t = {t:.6} s, {at}: velocities jumped to the other branch";
    KEEP_THE_GRID_FARTHER_FROM_THE_DEAD = "keep the grid farther from the dead point";
    the_engine_has_slipped_into(names, t, at) = "the engine slipped into another assembly mode of the group ({names}) before t = {t:.6} s, {at}: the engine has passed a dead point";
    // engine.rs
    CENTRED_SECOND_DIFFERENCES_OF_THE_ENGINE = "centred second differences of the engine's positions";
    READ_AS_THE_BODIES_VELOCITIES = "the bodies' velocities as read from the engine, one step old; omega from the rotation in a step; where a drive's speed changes, centred differences of positions";
    READ_AS_GENERALISED_VELOCITIES_ONE_STEP = "the joints' speeds as read from the engine, one step old, added up from the ground along the spanning tree; where a drive's speed changes, centred differences of positions";
    THE_ENGINE_IMPULSES_IN_TINY = "the engine's impulses in tiny extra steps, each started from a pose of the run";
    THE_ENGINE_IMPULSES_IN_TINY_STEPS = "the engine's impulses in tiny extra steps, each started from a pose of the run; the impulse of each joint is read in a world whose spanning tree is cut at this joint";
    THE_ENGINE_IMPULSES = "the engine's impulses";
    THE_ENGINE_IMPULSES_EACH_JOINT = "the engine's impulses; the impulse of each joint is read in a world whose spanning tree is cut at this joint";
    NEWTON_EULER_ON_CENTRED_SECOND = "Newton-Euler on centred second differences of the engine's positions";
    ON_DRIVING_LINKS_ALL_MASSES = "on driving links: all masses times the square of the largest length";
    GROUND_CRANK_MOTOR_FORCE_BASED = "ground-crank motor, force-based, damping 1e30, speed tan(omega dt) / dt";
    GROUND_CRANK_MOTOR_FORCE_BASED_DAMPING = "ground-crank motor, force-based, damping 1e30";
    BODIES_OF_THEIR_OWN_EVERY_JOINT = "separate bodies, every joint an impulse joint";
    SPANNING_TREE_AS_MULTIBODY_LOOPS = "spanning tree as multibody, loops closed by impulse joints";
    // free.rs
    RAPIER_IN_SINGLE_PRECISION = "Rapier in single precision";
    // guard.rs
    the_engine_has_panicked(words, place) = "the engine has panicked (\"{words}\"), {place}";
    CHECK_THAT_THE_POSE_CAN_BE_ASSEMBLED = "check that the mechanism can be assembled at this input";
    BEGIN_THE_GRID_FARTHER_FROM_THE_DEAD = "begin the grid farther from the dead point";
    the_engine_ran_up_from_a_few(at, link, far) = "the engine started a few steps before the grid and arrived at the start of the grid, {at}, with link \"{link}\" {far} m off: the engine has passed a dead point";
    the_engine_loop_has_opened(gap, name, place) = "the engine's loop has opened by {gap} m at joint \"{name}\", {place}";
    the_engine_kinetic_energy_has_grown(growth, place) = "the engine's kinetic energy has grown {growth} times in one step, {place}";
    the_engine_link_has_turned(name, degrees, place) = "the engine's link \"{name}\" has turned by {degrees:.1} deg in one step, {place}";
    // newton_euler.rs
    SHORTEN_THE_GRID_TO_THE_CRANK = "shorten the grid to the inputs before the dead point";
    // friction.rs
    friction_has_no_equilibrium(t) = "friction locks the mechanism at t = {t:.6} s; the joint forces cannot be in equilibrium with the friction";
    LOWER_A_COEFFICIENT_OF_FRICTION = "lower a coefficient of friction or the radius of a journal, or end the grid before this instant";
    THE_ROUTE_KNOWS_NO_FRICTION = "Rapier's joints report no friction and no losses of transmissions";
    the_reactions_are_not_determined(t) = "the reactions are not determined at t = {t:.6} s (dead point)";
    // reactions.rs
    THE_MOTION_IS_FREE_BUT_A_PROBE = "the motion is free, but a probe needs prescribed speeds";
    // run.rs
    GIVE_A_SHORTER_GRID = "give a shorter grid";
    a_time_step_of_needs_steps(step, steps, max_steps) = "a time step of {step} s needs {steps} steps for this grid; the limit is {max_steps}";
    GIVE_AT_LEAST_ONE_OF_EACH = "give at least one sweep and one substep";
    the_engine_has_sweeps_and_substeps(sweeps, substeps) = "the engine has {sweeps} sweeps and {substeps} substeps per step";
    GIVE_A_TIME_STEP_GREATER = "give a time step greater than zero";
    the_engine_time_step_is(step) = "the engine's time step is {step} s";
    // twins/worlds.rs
    rapier_refuses_the_tree_joint(name) = "Rapier refuses the tree joint \"{name}\"";
}
