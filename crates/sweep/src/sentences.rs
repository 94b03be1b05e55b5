//! All messages of this crate.

linkage::sentences! {
    // axis.rs
    VARY_KEY_BY_A_GRID_OR =
        "write KEY=FROM:TO:COUNT for a grid, KEY=FROM:TO, KEY=normal(MEAN, DEVIATION) or KEY=normal(MEAN, DEVIATION, FROM, TO) \
         for samples; KEY is a parameter, such as `crank_mm`, or the path of a number, such as `links.crank.mass_kg`";
    no_key_of(text) = "expected KEY=VALUES, found `{text}`";
    no_spread(text) = "`{text}` is neither a grid nor a distribution";
    a_grid_has_a_whole_number(count) = "the number of values of a grid must be a whole number from 1 to 1e15; found {count}";
    the_deviation_is_not_positive(deviation) = "the standard deviation must be positive; found {deviation}";
    the_range_is_too_wide(from, to) = "the range from {from} to {to} is too wide";
    the_limits_are_not_in_order(from, to) = "the lower limit must be less than the upper limit; found {from} and {to}";
    nothing_lies_between(from, to) = "the normal distribution has practically no values between {from} and {to}";
    // design.rs
    NO_NUMBER_IS_VARIED = "no varied number is given";
    is_varied_twice(key) = "the key `{key}` is given twice";
    GIVE_EVERY_KEY_ONE_SPREAD = "give each key once";
    a_grid_needs_steps(axis) = "`{axis}` is a distribution; without samples, a grid with a number of values is needed";
    GIVE_STEPS_OR_SAMPLES = "write KEY=FROM:TO:COUNT, or state the number of samples";
    samples_have_no_steps(axis) = "`{axis}` is a grid; samples need a distribution";
    LEAVE_THE_NUMBER_OF_STEPS_OUT = "write KEY=FROM:TO, without the number of values, or leave out the number of samples";
    too_many_or_no_cases(most) = "the number of cases must be from 1 to {most}";
    TAKE_FEWER_CASES = "take fewer values or samples";
    sobol_has_dimensions(most, found) = "{found} numbers are varied, but the program has only {most} dimensions of Sobol's sequence";
    TAKE_A_LATIN_HYPERCUBE = "take a Latin hypercube, or vary fewer numbers";
    // plan.rs
    NO_FIGURE_IS_WANTED = "no figure is given";
    is_wanted_twice(name) = "two columns would be called `{name}`";
    NAME_EVERY_COLUMN_ONCE = "ask for each figure once";
    no_plan(error) = "`sweep.json` is not the plan of a sweep: {error}";
    IT_IS_OF_ANOTHER_VERSION = "another version of the program wrote the file";
    RUN_THE_SWEEP_WITH_THIS_VERSION = "run the sweep again with this version, in a new directory";
    // run.rs
    a_case_panicked(panic) = "bug in the program: {panic}";
    // store.rs
    cannot_be_used(path, error) = "{path} cannot be used: {error}";
    CHOOSE_ANOTHER_DIRECTORY = "name another directory, or remove this one";
    holds_another_sweep(path) = "{path} contains another sweep: its scenario, varied numbers, figures, proofs or part size differ";
    holds_other_files(path, name) = "{path} contains files that do not belong to a sweep, such as {name}";
    a_part_is_missing(part, first, last) = "part {part} is missing: cases {first} to {last}";
    no_sweep_in(path) = "{path} contains no sweep";
    NAME_THE_DIRECTORY_OF_A_SWEEP = "name the directory of a sweep";
    are_of_different_sweeps(first, other) = "{first} and {other} belong to different sweeps";
    NAME_THE_SHARDS_OF_ONE_SWEEP = "name the directories that the shards of one sweep have written";
    RUN_THE_MISSING_SHARD = "run the missing shard, or name the directory that contains it";
    // summary.rs
    ITS_PARTS_CONTRADICT_EACH_OTHER = "the table's columns and rows do not match the plan of the sweep";
}
