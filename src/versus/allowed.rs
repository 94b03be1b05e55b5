//! What a comparison is asked, and what is allowed besides what is known.

use crate::scenario::mapping::{Allowed, Size};
use crate::scenario::{Claim, PrintedChannel};
use linkage::error::{Error, ErrorKind, Result};
use linkage::math::KeepNan;

use columns::Allowance;

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
    /// Memory allowed (bytes); `None` for what a proof is allowed.
    pub memory: Option<f64>,
}

impl How {
    /// What is allowed of a channel with this scale, in its unit; `None` if nothing is said of it.
    #[must_use]
    pub fn allows(&self, claim: &Claim, scale: f64) -> Option<Allowance> {
        self.of(|word| is_called(claim, word), scale, 1.0)
    }

    /// What is allowed of the crank angle (rad) with this scale: what is allowed of all, and of the word `crank`, with
    /// sizes in degrees.
    #[must_use]
    pub fn allows_crank(&self, scale: f64) -> Option<Allowance> {
        self.of(|word| word == CRANK, scale, 1f64.to_radians())
    }

    /// Whether the crank angle is asked for.
    #[must_use]
    pub fn asks_for_crank(&self) -> bool {
        self.only.is_empty() || self.only.iter().any(|word| word == CRANK)
    }

    fn of(&self, is_meant: impl Fn(&str) -> bool, scale: f64, unit: f64) -> Option<Allowance> {
        let own = self.allowed.iter().filter(|allowed| allowed.of.as_deref().is_none_or(&is_meant));
        let mut sizes: [Option<f64>; 3] = [None; 3];
        for allowed in own {
            match allowed.size {
                Size::Absolute(size) => sizes[0] = Some(unit * size),
                Size::Relative(share) => sizes[1] = Some(share * scale),
                Size::OfValue(share) => sizes[2] = Some(share),
            }
        }
        let [absolute, relative, of_value] = sizes.map(Option::unwrap_or_default);
        let is_allowed = sizes.iter().any(Option::is_some);
        is_allowed.then_some(Allowance { fixed: absolute.larger(relative), of_value })
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
        let is_meant = |word: &str| word == CRANK || compared.clone().any(|claim| is_called(claim, word));
        match words.find(|word| !is_meant(word)) {
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

/// The word for the crank angle of rows.
const CRANK: &str = "crank";

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

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::trajectory::Channel;

    fn how(allowed: &[(Option<&str>, Size)]) -> How {
        let of = |(of, size): &(Option<&str>, Size)| Allowed { of: of.map(Into::into), size: *size };
        How { allowed: allowed.iter().map(of).collect(), ..How::default() }
    }

    /// Of a channel with a scale of 4, in its unit; of several allowances for one the last of each kind counts.
    #[test]
    fn what_is_allowed_is_the_larger_of_what_is_said() {
        let channel = Channel::named("point.B.x_m").unwrap();
        let claim = Claim::of_channels("point.B.x_mm", &[channel]).unwrap();
        let (absolute, relative, of_value) = (Size::Absolute, Size::Relative, Size::OfValue);
        let allows = |fixed: f64, of_value: f64| Some(Allowance { fixed, of_value });
        for (said, allowed) in [
            (vec![(None, absolute(3.0))], allows(3.0, 0.0)),
            (vec![(None, relative(0.5))], allows(2.0, 0.0)),
            (vec![(None, of_value(0.125))], allows(0.0, 0.125)),
            (vec![(None, absolute(3.0)), (Some("point.B"), relative(0.5))], allows(3.0, 0.0)),
            (vec![(Some("positions"), absolute(1.0)), (None, relative(0.5))], allows(2.0, 0.0)),
            (vec![(None, absolute(9.0)), (Some("point.B.x_m"), absolute(1.0))], allows(1.0, 0.0)),
            (vec![(Some("point.B.positions"), of_value(0.25)), (None, absolute(1.0))], allows(1.0, 0.25)),
            (vec![(Some("point.A"), absolute(3.0)), (Some("velocities"), relative(0.5))], None),
            (vec![], None),
        ] {
            assert_eq!(how(&said).allows(&claim, 4.0), allowed, "{said:?}");
        }
        // Of the crank in degrees, of its range, and of nothing that is said of a channel alone.
        let crank = |said: &[(Option<&str>, Size)]| how(said).allows_crank(4.0).map(|own| own.fixed);
        assert_eq!(crank(&[(Some("crank"), absolute(180.0))]), Some(std::f64::consts::PI));
        assert_eq!(crank(&[(None, relative(0.5))]), Some(2.0));
        assert_eq!(crank(&[(Some("point.B"), absolute(1.0))]), None);
    }
}
