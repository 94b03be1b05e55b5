//! Sentences about the mechanism and the figures of a proof.

linkage::sentences! {
    // plain/brief.rs
    all_agree(parties, all, largest) = "{parties} agree in all {all} quantities{largest}.";
    the_only_one_agrees(parties, largest) = "{parties} agree in the only quantity{largest}.";
    most_agree(parties, agree, all, largest) = "{parties} agree in {agree} of {all} quantities, and the others could not be decided{largest}.";
    the_largest_difference(share, channel) = "; the largest difference is {share} of the range of {channel}";
    both_sides_and(engines) = "Both analytic solutions and {engines}";
    the_simulation(engine) = "the {engine} simulation";
    the_simulations(engines) = "the simulations {engines}";
    // report/html/words.rs, report/markdown.rs
    FIGURES_OF_THE_MOTION = "Figures of the motion";
    // plain/machine.rs
    links_and_frame(count, links, names) = "{count} moving {links} on the frame: {names}";
    an_axis_at(joint, first, second, deg, on) = "{joint} ({first}, {second}; axis at {deg} deg on {on})";
    joint_turns(joint, link, law) = "{link} at joint {joint}: {law}";
    joint_slides(joint, link, law) = "{link} along the axis of joint {joint}: {law}";
    joint_turns_from(joint, link, first, law) = "{link} relative to {first} at joint {joint}: {law}";
    constant_speed(rpm) = "constant speed, {rpm} rpm";
    constant_slide_speed(speed) = "constant speed, {speed} m/s";
    HELD = "held";
    law_up_to(law, speed, unit) = "{law} law, up to {speed} {unit}";
    free_from(speed, unit) = "free motion from {speed} {unit}";
    UNDER_ITS_MOTOR = ", under its motor";
    UNDER_LOADS_ALONE = ", without a motor";
    WITH_A_MOTOR = ", with a motor";
    gravity_down(size) = "gravity {size} m/s² downwards";
    gravity_at(size, deg) = "gravity {size} m/s² at {deg} deg";
    NO_GRAVITY = "no gravity";
    load_on(load, links) = "{load} on {links}";
    load_between(load, first, second) = "{load} between {first} and {second}";
}
