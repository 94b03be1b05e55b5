//! Sentences about linkages that a synthesis has found.

linkage::sentences! {
    // report/precision.rs
    four_bars_pass_all(found, branch, order, full) = "  found         {found} through all positions, {branch} of these in one assembly mode,\n                {order} also in the given order, {full} also with a full turn of the crank";
    FREE_ROTATIONS_WERE_SCANNED = "  scan          free rotations on a grid; similar four-bars are listed once";
    four_bar_of_the_table(number) = "four-bar {number} of the table";
    pivots_and_pins(o, c, a, b) = "  pivots        O {o}, C {c} mm\n  position 1    A {a}, B {b} mm";
    points_of_the_coupler(point, a, b) = "  coupler       P {point},\n                A {a}, B {b} mm in its frame";
    crank_at_the_positions(angles) = "  crank         at {angles} deg";
    travel_of_the_crank(travel) = "  motion        {travel}";
    FULL_TURN_CLOCKWISE = "full turn, clockwise";
    FULL_TURN_COUNTER_CLOCKWISE = "full turn, counter-clockwise";
    from_to_deg(from, to) = "crank from {from} to {to} deg";
    transmission_and_mode(transmission, mode) = "  transmission  {transmission:.4} deg at least\n  mode          {mode}";
    // report/front.rs, report/synthesize.rs
    random_candidates(drawn, assembled) = "{drawn} random candidates, of which {assembled} can be assembled over the whole turn and nearly keep the limits";
    refined_without_derivatives(cost, refined, worst) = "; best cost {cost}, after refinement {refined} (worst refined candidate {worst})";
    refined_with_derivatives(refined, worst) = "; refined with exact derivatives, largest deviation {refined} % (worst refined candidate {worst} %)";
    poses_solved(all, random, refined) = "\n{all} poses solved: {random} for random candidates, {refined} for the refinement\n";
    largest_distance(distance) = "Largest distance from a precision point {distance} mm.";
    the_smallest_transmission_angle(angle) = "Smallest transmission angle {angle:.2} deg.";
    CRANK_ANGLE = "crank angle";
    ANGLE_OF_THE_OUTPUT = "angle of the output link";
    DEVIATION = "deviation";
    the_front_varies(limit) = "Each row is the mechanism with the smallest deviation at this value of {limit}.\nDeviation: largest motion in a dwell in % of the stroke, or largest distance from a precision point in % of their extent.";
    largest_turned(angle) = "Largest deviation of an angle {angle} deg.";
}
