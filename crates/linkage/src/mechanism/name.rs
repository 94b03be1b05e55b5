//! Names of links, joints and points. The names become parts of channels, table columns, topics and drawings.

/// Longest name (characters).
pub const LONGEST_NAME: usize = 100;

/// Whether a character is invisible, but changes the text.
/// Such characters are control characters (line breaks included), marks and overrides of the writing direction, line
/// and paragraph separators, and zero-width characters.
#[must_use]
pub fn is_unseen(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(letter, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// Whether a name is allowed for a link, point or joint.
/// Dots, spaces and commas would break channel names and table headers. Slashes would break the names of topics.
#[must_use]
pub fn is_sound_name(name: &str) -> bool {
    let letters = || name.chars();
    (1..=LONGEST_NAME).contains(&letters().count())
        && letters().all(|letter| (letter.is_alphanumeric() || "_-'".contains(letter)) && !is_unseen(letter))
}
