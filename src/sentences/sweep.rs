//! Sentences of sweeps.

linkage::sentences! {
    // cli/sweep.rs
    EXPECTED_EVERY_AND_A_NUMBER = "expected `every:` and a positive number, such as every:1000";
    EXPECTED_A_SHARE_OF_THE_CASES = "expected the number of a shard and the number of all shards, such as 2/8";
    is_no_end_of_a_figure(text) = "`{text}` is not `min:` or `max:` with a figure of this sweep";
    write_min_or_max_of(figures) = "write `min:` or `max:` and one of {figures}";
    // report/sweep.rs
    a_shard_is_stored(number, count, directory, done, refused, stored) =
        "shard {number} of {count} is stored in {directory}: {done}, {refused} of them refused; stored before: \
         {stored}";
    cases_are_in(table, cases, solved) = "{table}: {cases}, {solved} solved";
    cases_refused(refused) = "{refused} refused; each reason has the numbers of its first case:";
    and_further_reasons(further) = "and {further}";
    proofs_end_in(proofs, verdict) = "{proofs}: {verdict}";
    LARGEST = "largest";
    SMALLEST = "smallest";
    best_cases(end, figure) = "Cases with the {end} values of {figure}";
    case_number(case) = "case {case}";
    cases_of_which_solved(cases, solved) = "{cases}, {solved} solved";
    the_lines_show(count) = "; the lines show {count} of the solved cases, the best ones included";
}
