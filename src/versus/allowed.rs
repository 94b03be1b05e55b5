//! What a comparison is asked, and what is allowed besides what is known.

use crate::scenario::mapping::{Allowed, Size};
use crate::scenario::{Claim, PrintedChannel};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

/// How two parties are compared.
#[derive(Clone, Debug, Default)]
pub struct How {
    /// Differences that are allowed; of several for one channel the last counts.
    pub allowed: Vec<Allowed>,
    /// Whether instants are crank angles; `None` for times where there are some.
    pub by_crank: Option<bool>,
    /// Whether a table may be interpolated between its instants.
    pub interpolates: bool,
    /// The side of a recording that is compared; `None` for all.
    pub side: Option<String>,
    /// Words for channels that are compared; empty for all.
    pub only: Vec<String>,
}

impl How {
    /// What is allowed of a channel with this scale, in its unit; `None` if nothing is said of it.
    #[must_use]
    pub fn allows(&self, claim: &Claim, scale: f64) -> Option<f64> {
        let own = self.allowed.iter().filter(|allowed| allowed.of.as_ref().is_none_or(|word| is_called(claim, word)));
        let mut sizes = [None; 2];
        for allowed in own {
            match allowed.size {
                Size::Absolute(size) => sizes[0] = Some(size),
                Size::Relative(share) => sizes[1] = Some(share * scale),
            }
        }
        match sizes {
            [None, None] => None,
            [absolute, relative] => Some(absolute.unwrap_or(0.0).larger(relative.unwrap_or(0.0))),
        }
    }

    /// Whether a channel is asked for.
    #[must_use]
    pub fn asks_for(&self, claim: &Claim) -> bool {
        self.only.is_empty() || self.only.iter().any(|word| is_called(claim, word))
    }

    /// Refuses words that no compared channel answers to.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the word.
    pub(super) fn check_used<'a>(&self, compared: impl Iterator<Item = &'a Claim> + Clone) -> Result<()> {
        let mut words = self.allowed.iter().filter_map(|allowed| allowed.of.as_ref());
        match words.find(|word| !compared.clone().any(|claim| is_called(claim, word))) {
            None => Ok(()),
            Some(word) => {
                let all: Vec<&str> = compared.map(|claim| claim.text.as_str()).take(5).collect();
                let message = format!("no channel that is compared is called {word}");
                let help = format!("name one of them ({}, ...), a subject or a stage", all.join(", "));
                Err(Error::new(ErrorKind::Input, message).help(help))
            }
        }
    }
}

/// Whether a word means a claim: its text, its channel in any unit, the channel's subject, stage, or both.
fn is_called(claim: &Claim, word: &str) -> bool {
    let of = |own: &PrintedChannel| {
        let name = own.channel.to_string();
        let subject = name.rsplit_once('.').map_or("", |(subject, _)| subject);
        let stage = own.channel.kind.stage.name();
        let asked = PrintedChannel::named(word).map(|asked| asked.channel);
        asked.as_ref() == Some(&own.channel)
            || word == subject
            || word == stage
            || word.strip_suffix(stage).and_then(|rest| rest.strip_suffix('.')) == Some(subject)
    };
    claim.text == word || claim.channels.iter().all(|(_, own)| of(own))
}
