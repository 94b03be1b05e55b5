//! Names of links, joints and points: they become parts of channels, columns of tables, topics and drawings.

/// Longest name (characters).
pub const LONGEST_NAME: usize = 100;

/// Whether a letter changes a text without being seen: control characters with line breaks, marks and overrides of the
/// writing direction, breaks of lines and paragraphs, letters of no width.
#[must_use]
pub fn is_unseen(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{ad}' | '\u{61c}' | '\u{180e}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(letter, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// Whether a name is allowed for a link, point or joint.
/// Dots, blanks and commas would break the names of channels and the headers of tables, slashes the names of topics.
#[must_use]
pub fn is_sound_name(name: &str) -> bool {
    let letters = || name.chars();
    (1..=LONGEST_NAME).contains(&letters().count())
        && letters().all(|letter| (letter.is_alphanumeric() || "_-'".contains(letter)) && !is_unseen(letter))
}
