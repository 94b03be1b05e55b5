//! Sentences about four-bars through precision points.

linkage::sentences! {
    // report/precision.rs
    four_bars_pass_all(found, branch, order, full) = "  found         {found} through all positions, {branch} of these in one assembly mode,\n                {order} also in the given order, {full} also with a full turn of the crank";
    FREE_ROTATIONS_WERE_SCANNED = "  scan          free rotations on a grid; the table has no two similar four-bars";
    four_bar_of_the_table(number) = "four-bar {number} of the table";
    pivots_and_pins(o, c, a, b) = "  pivots        O {o}, C {c} mm\n  position 1    A {a}, B {b} mm";
    points_of_the_coupler(point, a, b) = "  coupler       P {point},\n                A {a}, B {b} mm in its frame";
    crank_at_the_positions(angles) = "  crank         at {angles} deg";
    travel_of_the_crank(travel) = "  motion        {travel}";
    FULL_TURN_CLOCKWISE = "full turn, clockwise";
    FULL_TURN_COUNTER_CLOCKWISE = "full turn, counter-clockwise";
    from_to_deg(from, to) = "crank from {from} to {to} deg";
    transmission_and_mode(transmission, mode) = "  transmission  {transmission:.4} deg at least\n  mode          {mode}";
}
