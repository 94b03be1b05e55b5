//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // bench/ladder.rs
    extrapolated_times(times) = "extrapolated {times} times";
    IT_WAS_NOT_RUN = "it was not run";
    // bench/measure.rs
    NO_REASON_WAS_GIVEN = "no reason was given";
    and_more(more) = " and {more} more";
    THE_ANSWER_HAS_NONE_OF_THE_WANTED = "the answer contains no requested channel";
    THE_ANSWER_HAS_NO_TIME_ABOVE = "the answer has no time above 0 s";
    row_of_the_answer_is_at_and_is_wanted(row, times, wanted) = "row {row} of the answer is at {times} s; expected {wanted} s";
    the_answer_has_instants_and_are_wanted(times, wanted) = "the answer has {times} instants; expected {wanted}";
    THE_ANSWER_HAS_NO_COLUMN = "the answer has no column t_s";
    // bench/reference.rs
    DIFFERENCE_OF_THE_TWO_SIDES = "difference of the two sides";
    SIDE_ASSUR = "side 1 (assur)";
    SIDE_ASSUR_INTEGRATED_A_HUNDRED = "side 1 (assur), integrated with a tolerance a hundred times tighter";
    DIFFERENCE_OF_BOTH_SIDES_AT_THE_TIGHTER = "the larger of two errors: the difference of both sides at the tighter tolerance, and the estimated integration error";
    // mutate/plan.rs
    PLANT_FEWER_OF_THEM_SOME = "plant fewer faults: select some kinds or one party, or omit the sizes";
    planting_faults_takes_the_work(scenario, faults, work, budget) = "{scenario}: planting {faults} faults costs about as much as {work} engine steps of a four-bar; the work limit is {budget}";
    PROVE_IT_WITHOUT_A_FAULT = "prove the scenario without a fault, and correct what disagrees";
    disagrees_without_a_fault_so(scenario) = "{scenario} disagrees without a fault, so every fault would count as found";
    // mutate/seen.rs
    own_forces(name) = "forces that {name} itself exerts";
    assur_against_newton_2(channel) = "{channel} (assur against newton)";
    // mutate/stage.rs
    the_case_with_the_fault_cannot(kind) = "the case with the fault {kind} cannot be built";
    THE_CASE_CANNOT_BE_PUT_TOGETHER = "the case cannot be built";
    MISTAKES_OF_FORMULAS_ARE_PLANTED = "mistakes of formulas can only be planted in formulas";
    // outside/answer.rs
    row_of_is(row, name, chars) = "row {row} of {name}: expected a number, found \"{chars}\"";
    row_of_its_table(row, error) = "row {row} of its table: {error}";
    its_table(twice) = "its table: {twice}";
    its_table_has_columns_and_at_most(header, columns) = "its table has {header} columns, but at most {columns} are allowed";
    its_table_cannot_be_read(error) = "its table cannot be read: {error}";
    its_count_of_is_which_is_no_whole(name, times) = "the count of {name} is not a whole number: {times}";
    it_counts_things_and_at_most(all, counted) = "it reports {all} counts, but at most {counted} are allowed";
    ITS_WORK_IS_NO_JSON_OBJECT = "its \"work\" is not a JSON object";
    its_time_is_and_to_can_be_measured(value, least, most) = "its time is {value}; expected {least} s to {most} s";
    ITS_ANSWER_HAS_NO_SECONDS = "its answer has no \"seconds\"";
    ITS_ANSWER_IS_NO_JSON_OBJECT = "its answer is not a JSON object";
    it_refuses(reason) = "it refuses: {reason}";
    the_way_has_no_name_or_no_resolution(value) = "the setting {value} has no name or no resolution";
    it_has_ways_and_to_are_possible(list, most) = "it offers {list} settings; 1 to {most} are allowed";
    ITS_WAYS_ARE_NO_JSON_ARRAY = "its list of settings is not a JSON array";
    the_last_line_of_its_output(error) = "the last line of its output is not JSON: {error}";
    IT_WROTE_NOTHING_TO_STANDARD = "its standard output is empty";
    // outside/machine.rs
    WITH_DEBUG_ASSERTIONS = "with debug assertions";
    LOAD_AT_THE_START = "load at the start";
    // outside/peer.rs
    the_request_cannot_be_written(error) = "the request cannot be written: {error}";
    no_temporary_directory(error) = "no temporary directory can be created: {error}";
    // outside/process.rs
    has_more_than_bytes(most) = "is larger than {most} bytes";
    cannot_be_read(error) = "cannot be read: {error}";
    cannot_be_read_2(path, error) = "{path} cannot be read: {error}";
    is_no_regular_file(path) = "{path} is not a regular file";
    is_not_there(path, error) = "{path} does not exist: {error}";
    it_was_stopped_after_bytes(most) = "it was stopped after {most} bytes of output";
    it_was_stopped_after_without(limit) = "it was stopped after {limit} s without an answer";
    it_cannot_be_waited_for(error) = "cannot wait for it: {error}";
    it_ended_with(status, last) = "it ended with {status}: {last}";
    NOTHING_ON_STANDARD_ERROR = "its standard error is empty";
    it_cannot_be_started(error) = "it cannot be started: {error}";
    // outside/viewer.rs
    it_ended_with_2(status) = "it ended with {status}";
    exec_rerun(python) = "exec {python} -m rerun \"$1\"";
    // stress/point.rs
    THERE_IS_NOTHING_TO_HOLD = "the engine cannot be compared, because no reference exists";
    the_other_side(without) = "the other side ({without})";
    THE_OTHER_SIDE_2 = "the other side";
    // tune.rs
    the_scenario_wants_no_channel(asked) = "the scenario does not request a channel \"{asked}\"";
    the_work_that_was_allowed(message) = "{message}; the work limit was reached";
    no_settings_meet_an_error(significant, tells) = "no settings reach an error of at most {significant} of the scale: {tells}";
    does_not_run_it(name) = "{name} cannot run the scenario";
    comes_to(name, significant) = "{name} reaches an error of {significant}";
    GIVE_A_SHARE_OF_A_CHANNEL = "give a fraction of a channel's scale between 0 and 1, such as 1e-4";
    an_error_within_is_wanted(within) = "an error of at most {within} is requested";
}
