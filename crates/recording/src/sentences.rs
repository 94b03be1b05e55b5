//! Every sentence that this crate can show. All sentences are in one place, so that they can be read as a list.

linkage::sentences! {
    // beside.rs
    its_is_not(key, told, told_2) = "its {key} is {told}, not {told_2}";
    ITS_SCENARIO_HAS_ANOTHER_TEXT = "its scenario text differs";
    IT_IS_NO_RECORDING_OF_A_RUN = "it is not a recording of a run";
    IT_CANNOT_BE_READ = "it cannot be read";
    IT_IS_NO_FILE = "it is not a file";
    IT_IS_A_SYMBOLIC_LINK = "it is a symbolic link";
    REMOVE_THOSE_THAT_ARE_NOT_NEEDED = "delete recordings that are no longer needed, or record elsewhere";
    holds_recordings_of_other_runs(directory, most, name) = "{directory} holds {most} recordings of other runs of {name}";
    // film.rs
    RECORD_THE_SCENARIO_AGAIN_WITH_ITS_POSITIONS = "record the scenario again with its positions";
    the_recording_has_no_picture(path) = "the recording {path} has no picture: no positions were recorded";
    // messages.rs
    RECORD_IT_AGAIN_OR_SAVE_WHAT = "record the scenario again, or save the undamaged part of the file with `pymcap-cli recover`";
    the_recording_is_cut_off(path, error) = "the recording {path} is cut off or damaged: {error}";
    // read.rs
    EVERY_TOPIC_OF_A_SIDE_NEEDS = "each topic of a side needs one message for every grid message of the side, with the same sequence number";
    in_the_recording_the_side(path, name, what) = "in the recording {path}, the side \"{name}\" lacks samples of {what}";
    A_SIDE_NEEDS_A_TOPIC_SIDE = "a side needs a topic `/<side>/grid` with the fields t_s and crank_rad, joint_rad or slide_m";
    the_recording_holds_no_trajectory(path) = "the recording {path} contains no trajectory";
    NAME_A_RECORDING_MCAP_WHICH_A_RUN = "name a recording (.mcap) that a run has written";
    the_file(path, what) = "the file {path} {what}";
    IS_NO_RECORDING_IT_DOES_NOT_BEGIN = "is not a recording: it does not start like an MCAP file";
    RECORD_IT_AGAIN_RECORDINGS_OF_THIS_PROGRAM = "record the scenario again: recordings of this program unpack to about three times their size";
    the_recording_has_and_says(path, length, told, most) = "the recording {path} has {length} and claims to unpack to {told}; at most {most} are allowed for a file of this size";
    CHECK_THE_PATH = "check the path";
    the_recording_cannot_be_read(path, error) = "the recording {path} cannot be read: {error}";
    IT_IS_NO_REGULAR_FILE = "it is not a regular file";
    // reel.rs
    the_recording_cannot_be_played(error) = "the recording cannot be played: {error}";
    // view.rs
    error_of(channel, field) = "error of {channel}.{field}";
    // write.rs
    GIVE_A_SMALLER_TIME_SCALE = "give a smaller time scale";
    a_recording_cannot_last_viewers(lasts) = "a recording cannot last {lasts} s: this is beyond the range of viewers";
    a_time_of_the_recording_grid(time) = "a time of the recording's grid is {time} s, but must be finite";
    GIVE_A_FINITE_NUMBER_GREATER = "give a finite number greater than 0";
    a_recording_cannot_have_a_time(wrong) = "a recording cannot have a time scale or a number of samples per second of {wrong}";
    GIVE_IT_A_NAME_OF_ITS_OWN = "give the side a unique name without `/`; \"error\" and \"mechanism\" are taken";
    a_side_of_a_recording_cannot(side) = "a side of a recording cannot be called \"{side}\"";
    cannot_be_written(what, other) = "{what} cannot be written: {other}";
    CHECK_THAT_THE_DIRECTORY_EXISTS = "check that the directory exists, is writable and has free space, or record elsewhere";
    the_recording(path) = "the recording {path}";
}
