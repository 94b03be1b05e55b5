//! All messages of this crate, one per line.

linkage::sentences! {
    // task.rs
    no_thread_begins(error) = "no thread can be started: {error}";
    THIS_IS_A_FAULT_OF_THE_PROGRAM = "this is a bug in the program: it panicked";
    REPORT_IT_WITH_THE_SCENARIO = "report the bug, with the scenario";
    // table.rs
    and_more_rows(left) = "and {left} more rows";
    there_is_no_column(name, near) = "there is no column \"{name}\"; {near}";
    a_table_of(rows, columns) = "<linkproof.Table: {rows} rows, {columns} columns>";
    // solution.rs
    a_solution_of(rows, channels) = "<linkproof.Solution: {rows} instants, {channels} channels>";
    // scenario_class.rs
    the_scenario_was_built_in_code(name) = "the scenario \"{name}\" was built in code, so it has no parameters and no other start";
    BUILD_IT_AGAIN_OR_READ_IT_FROM_A_FILE = "build the scenario again with the other numbers, or read it from a file";
    GIVE_EVERY_INSTANT_ONCE = "give every instant only once, and only instants that the drive reaches";
    INSTANTS_ARE_INPUTS_OR_TIMES = "expected instants either as values of the input or as times";
    GIVE_ONE_OF_THE_TWO = "give `input` or `time`, for example `at(time=[0.0, 0.1])`";
    a_scenario_called(name, title) = "<linkproof.Scenario {name}: {title}>";
    // errors.rs
    found_the_number(number) = "found {number}";
    GIVE_A_POSITIVE_NUMBER = "give a positive number";
    give_a_number_from(least, most) = "give a number from {least} to {most}";
    // draw.rs
    GIVE_INPUT_OR_TIME = "give `input` or `time`, for example `draw(\"png\", time=0.1)`";
    GIVE_A_MEDIUM = "give \"svg\", \"pdf\", \"png\", \"dxf\", \"gif\" or \"webp\"";
    there_is_no_option(key) = "there is no option \"{key}\"";
    OPTIONS_OF_PICTURES = "use input, time, each_mode, loads, dimensions, all_traces, traces, positions, enlarged, groups, width, frames or seconds";
    a_picture_of(name, kind, bytes) = "<linkproof.Picture of {name}: {kind}, {bytes} bytes>";
    // proof.rs
    NO_ENGINE_IS_NAMED = "no engine is named";
    OMIT_THE_OPTION = "name one or several engines, or omit the option";
    OPTIONS_OF_PROOFS = "use engine, reference, route, step, accuracy, sweeps, substeps, extrapolated, budget, memory or tolerance";
    there_is_no_such_choice(word) = "unknown word \"{word}\"";
    it_has(names) = "use {names}";
    the_tolerance_is_a_share(share) = "found {share}, but the tolerance is a fraction of a channel's scale";
    GIVE_A_NUMBER_BETWEEN_0_AND_1 = "give a number between 0 and 1, such as 1e-3";
    a_proof_of(name, verdict) = "<linkproof.Proof of {name}: {verdict}>";
    // check.rs
    A_FORMULA_NEEDS_A_CHANNEL = "a formula needs a channel, and a channel needs a formula";
    GIVE_BOTH_OR_NEITHER = "give both the formula and the channel, or leave out both to check the formulas of the file";
    a_check_against(name, verdict) = "<linkproof.FormulaCheck against {name}: {verdict}>";
    NO_SIMPLE_CAUSE = "no simple cause was found";
    // foreign.rs
    this_is_no_table(found) = "an object of the class `{found}` is not a table";
    GIVE_A_TABLE = "give a data frame, an Arrow table, a dictionary of columns, a path, a scenario or a solution";
    the_columns_differ_in_length(first, other) = "the columns \"{first}\" and \"{other}\" have different lengths";
    GIVE_ONE_ROW_PER_INSTANT = "give one row of numbers per instant";
    THE_TABLE_HAS_NO_NUMBERS = "the table has no column of numbers";
    // compare.rs
    ROWS_ARE_MATCHED_BY = "use \"time\" or \"input\"";
    this_difference_is_negative(number) = "the allowed difference {number} is negative or not a number";
    GIVE_A_DIFFERENCE_OF_0_OR_MORE = "give a difference of 0 or more, for all channels or by channel";
    a_comparison_of(first, second, verdict) = "<linkproof.Comparison of {first} and {second}: {verdict}>";
    // builder.rs
    there_is_no_link(name) = "there is no moving link \"{name}\"";
    a_builder_of(name) = "<linkproof.Builder of {name}>";
    // sweep.rs
    VARY_A_KEY_BY = "write vary={\"crank_mm\": \"20:60:41\"} for a grid, \"20:60\", \"normal(40, 0.02)\" or \"normal(40, 0.02, 39.9, 40.1)\" for samples, or a tuple such as (20, 60, 41) or (20, 60); a key is a parameter, or the path of a number, such as \"links.crank.mass_kg\"";
    these_are_no_values(key) = "the values of `{key}` are neither a text nor a tuple of two or three numbers";
    SAMPLES_ARE_TAKEN_IN_ONE_WAY = "found several kinds of samples";
    GIVE_ONE_OF_RANDOM_LATIN_SOBOL = "give one of `random`, `latin` and `sobol`, or none of them for a grid";
    a_sweep_takes_its_start_from_the_file(name) = "a sweep of \"{name}\" takes the start and the instants only from the file";
    WRITE_THEM_IN_THE_FILE = "write `[start]` and `[grid]` in the text of the scenario, or vary a number of them, such as \"grid.step_deg\"";
    this_is_no_shard(number, count) = "there is no share {number} of {count}";
    GIVE_A_SHARE_OF_ALL = "give the number of the share, from 1, and the number of all shares, such as (2, 8)";
    THIS_NUMBER_IS_0 = "found 0";
    GIVE_A_WHOLE_NUMBER_ABOVE_0 = "give a whole number above 0";
    NO_DIRECTORY_IS_NAMED = "no directory is named";
    NAME_THE_DIRECTORIES_OF_SHARDS = "name the directories that the shards have written";
    A_SHARE_NEEDS_A_DIRECTORY = "a share of the cases, or a plan alone, needs a directory";
    NAME_A_DIRECTORY_WITH_OUT = "name a directory with `out`";
    the_proof_of_a_case_disagrees(case) = "the sweep has stopped, because the proof of case {case} disagrees";
    prove_the_case(setting) = "read the report: `scenario.set({setting}).prove().report()`";
    // swept.rs
    a_sweep_of(cases, keys, figures, state) = "<linkproof.Sweep: {cases} cases, {keys} varied numbers, {figures} figures, {state}>";
    COMPLETE = "complete";
    INCOMPLETE = "not complete";
    THE_TABLE_IS_NOT_JOINED = "some cases of the sweep are not solved yet, so there is no table";
    solve_the_other_cases(directory) = "solve the other shards, then call `linkproof.resume(\"{directory}\")`";
    there_is_no_case(case) = "there is no case {case}";
    cases_are_counted_from_0(cases) = "cases are counted from 0; the sweep has {cases}";
    there_is_no_figure(figure) = "the sweep has no figure \"{figure}\"";
    // sensitivity.rs
    the_tolerance_is_not_above_zero(key, limit) = "the tolerance of `{key}` is {limit}";
    GIVE_A_NUMBER_ABOVE_ZERO = "give the largest deviation in either sense, above 0, in the unit of the key";
    A_SAMPLE_IS_TOO_SMALL_OR_LARGE = "a sample has from 10 to 100000 mechanisms";
    GIVE_MORE_OR_FEWER_SAMPLES = "give a number from 10 to 100000";
    a_sensitivity_of(name, figures, keys) = "<linkproof.Sensitivity of {name}: {figures} figures by {keys} keys>";
}
