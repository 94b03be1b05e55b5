//! Selects channels of a case by words that a user writes.

use super::Case;
use crate::trajectory::{Channel, Stage};

impl Case {
    /// Channels selected by `word`, out of all channels that the case can have, in the order of columns.
    /// A word is the name of a stage (`positions`), a subject (`point.P`, `link.rocker`, `joint.B`, `frame`, `drive`),
    /// a subject's stage (`point.P.positions`) or a channel (`joint.B.fx_N`). `drive` means all drives.
    /// The list is empty for any other word.
    #[must_use]
    pub fn channels_called(&self, word: &str) -> Vec<Channel> {
        let is_meant = |channel: &Channel| {
            let (subject, stage) = (channel.subject(), channel.kind.stage.name());
            let rest = word.strip_prefix(subject.as_str());
            word == stage
                || rest.is_some_and(|rest| rest.is_empty() || rest.strip_prefix('.') == Some(stage))
                || channel.to_string() == word
                || word == "drive" && subject.starts_with("drive.")
        };
        let mut all = self.all_channels();
        all.retain(is_meant);
        all
    }

    /// All words that [`Case::channels_called`] knows, for suggestions.
    /// Stages come first, then subjects, then single channels.
    #[must_use]
    pub fn channel_words(&self) -> Vec<String> {
        let all = self.all_channels();
        let mut words: Vec<String> = Stage::ALL.into_iter().map(|stage| stage.name().into()).collect();
        words.extend(all.iter().map(Channel::subject));
        words.dedup();
        words.extend(all.iter().map(|channel| format!("{}.{}", channel.subject(), channel.kind.stage.name())));
        words.dedup();
        words.extend(all.iter().map(Channel::to_string));
        words
    }
}

#[cfg(test)]
mod tests {
    use crate::fixtures::{four_bar, turning};

    #[test]
    fn words_select_stages_subjects_and_single_channels() {
        let case = turning(four_bar());
        let called = |word: &str| case.channels_called(word).iter().map(ToString::to_string).collect::<Vec<_>>();
        let point = case.mechanism.moving_points().next().unwrap().0.to_string();
        assert_eq!(called(&format!("point.{point}")).len(), 6);
        assert_eq!(
            called(&format!("point.{point}.positions")),
            [format!("point.{point}.x_m"), format!("point.{point}.y_m")]
        );
        assert_eq!(called("drive"), ["drive.torque_N_m"]);
        assert_eq!(called("frame").len(), 3);
        assert_eq!(
            called("positions").len(),
            case.all_channels().iter().filter(|own| own.kind.stage.name() == "positions").count()
        );
        assert!(called("point").is_empty() && called("").is_empty() && called("drive.").is_empty());
        for word in case.channel_words() {
            assert!(!called(&word).is_empty(), "{word}");
        }
    }
}
