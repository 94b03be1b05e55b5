//! Every sentence that this crate can show, in one place, to be read as a list.

linkage::sentences! {
    // beside.rs
    its_is_not(key, told, told_2) = "its {key} is {told}, not {told_2}";
    ITS_SCENARIO_HAS_ANOTHER_TEXT = "its scenario has another text";
    IT_IS_NO_RECORDING_OF_A_RUN = "it is no recording of a run";
    IT_CANNOT_BE_READ = "it cannot be read";
    IT_IS_NO_FILE = "it is no file";
    IT_IS_A_SYMBOLIC_LINK = "it is a symbolic link";
    REMOVE_THOSE_THAT_ARE_NOT_NEEDED = "remove those that are not needed any more, or record elsewhere";
    holds_recordings_of_other_runs(directory, most, name) = "{directory} holds {most} recordings of other runs of {name}";
    // film.rs
    RECORD_THE_SCENARIO_AGAIN_WITH_ITS_POSITIONS = "record the scenario again with its positions";
    the_recording_has_no_picture(path) = "the recording {path} has no picture: no positions were recorded";
    // messages.rs
    RECORD_IT_AGAIN_OR_SAVE_WHAT = "record it again, or save what is left of it with `pymcap-cli recover`";
    the_recording_is_cut_off(path, error) = "the recording {path} is cut off or damaged: {error}";
    // read.rs
    EVERY_TOPIC_OF_A_SIDE_NEEDS = "every topic of a side needs one message for each of its grid, with the same sequence number";
    in_the_recording_the_side(path, name, what) = "in the recording {path}, the side \"{name}\" lacks samples of {what}";
    A_SIDE_NEEDS_A_TOPIC_SIDE = "a side needs a topic `/<side>/grid` with the fields t_s and crank_rad";
    the_recording_holds_no_trajectory(path) = "the recording {path} holds no trajectory";
    NAME_A_RECORDING_MCAP_WHICH_A_RUN = "name a recording (.mcap), which a run leaves";
    the_file(path, what) = "the file {path} {what}";
    IS_NO_RECORDING_IT_DOES_NOT_BEGIN = "is no recording: it does not begin as MCAP files do";
    RECORD_IT_AGAIN_RECORDINGS_OF_THIS_PROGRAM = "record it again: recordings of this program hold some three times their size";
    the_recording_has_and_says(path, length, told, most) = "the recording {path} has {length} and says that it holds {told}; of such a file at most {most} are read";
    CHECK_THE_PATH = "check the path";
    the_recording_cannot_be_read(path, error) = "the recording {path} cannot be read: {error}";
    IT_IS_NO_REGULAR_FILE = "it is no regular file";
    // reel.rs
    the_recording_cannot_be_played(error) = "the recording cannot be played: {error}";
    // view.rs
    error_of(channel, field) = "error of {channel}.{field}";
    // write.rs
    GIVE_A_SMALLER_TIME_SCALE = "give a smaller time scale";
    a_recording_cannot_last_viewers(lasts) = "a recording cannot last {lasts} s: viewers count less";
    a_time_of_the_recording_grid(time) = "a time of the recording's grid is {time} s";
    GIVE_A_FINITE_NUMBER_GREATER = "give a finite number greater than 0";
    a_recording_cannot_have_a_time(wrong) = "a recording cannot have a time scale or a number of samples a second of {wrong}";
    GIVE_IT_A_NAME_OF_ITS_OWN = "give it a name of its own without `/`; \"error\" and \"mechanism\" are taken";
    a_side_of_a_recording_cannot(side) = "a side of a recording cannot be called \"{side}\"";
    cannot_be_written(what, other) = "{what} cannot be written: {other}";
    CHECK_THAT_THE_DIRECTORY_EXISTS = "check that the directory exists, may be written to and has room, or record elsewhere";
    the_recording(path) = "the recording {path}";
}
