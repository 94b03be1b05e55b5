//! All messages that this crate can show, in one file, so that they can be read as a list.

linkage::sentences! {
    // seal.rs
    MADE_BY_LINKPROOF_SEAL = "made by linkproof, seal ";
    // target.rs
    cannot_be_written(what, why, needs) = "{what} cannot be written: {why}{needs}";
    are_needed(size) = "; {size} are needed";
    RAISE_THE_LIMIT_ON_THE_SIZE = "raise the limit on the size of files, or request fewer instants or channels";
    RENAME_OR_REMOVE_WHAT_IS_THERE = "rename or remove the existing entry, or choose another path";
    MAKE_ROOM_THERE_OR_WRITE = "free space there, or write to another device";
    A_FILE_OF_THIS_SIZE_IS_NOT_ALLOWED = "a file of this size is not allowed";
    THE_QUOTA_ON_THE_DEVICE_IS_USED = "the quota on the device is used up";
    NO_ROOM_IS_LEFT_ON_THE_DEVICE = "no space is left on the device";
    expected_a_directory_that_may(directory, why) = "{directory}: {why}; expected a writable directory";
    expected_a_directory(there, error) = "{there}: {error}; expected a directory";
    is_no_directory_expected_one(there) = "{there} is not a directory; expected a directory";
    there_is_no_directory_expected(directory) = "the directory {directory} does not exist; expected an existing directory";
    is_no_directory_expected_a_file(directory) = "{directory} is not a directory; expected a file in a directory";
    expected_a_file(error) = "{error}; expected a file";
    THIS_IS_A_DIRECTORY_EXPECTED = "this is a directory; expected a file";
    more_than_symbolic_links_lead(links) = "more than {links} symbolic links follow one another there";
    A_FILE_IS_THERE_THAT_THIS_PROGRAM = "a file exists there that this program did not write, or that was changed since";
    SOMETHING_ELSE_THAN_A_FILE = "the path exists, but is not a file";
    A_SYMBOLIC_LINK_THAT_NOBODY = "an unexpected symbolic link exists there";
    // text.rs
    it_is_not_written_in_utf(line, byte, char) = "it is not written in UTF-8: line {line} has the byte 0x{byte}, in Latin-1 the letter `{char}`";
    it_is_no_text_byte_is_zero(at) = "it is not a text file: byte {at} is zero";
    it_is_written_in_but_utf(name) = "it is written in {name}, but UTF-8 is needed";
    save_it_as_utf_in_your_editor(name) = "save it as UTF-8 in your editor, or convert it: `iconv -f {name} -t UTF-8 OLD > NEW`";
    GIVE_A_TEXT_FILE_IN_UTF = "give a text file in UTF-8";
    IT_IS_NO_REGULAR_FILE = "it is not a regular file";
    it_has_more_than_mib(value) = "it is larger than {value} MiB";
}
