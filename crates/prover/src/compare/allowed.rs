//! The rules of a comparison: which channels are compared, and which differences are allowed in addition to the known
//! errors.

use crate::sentences;
use std::collections::{BTreeMap, BTreeSet};

use crate::tables::By;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::KeepNan;
use scenario::mapping::{Allowed, Size};
use scenario::{Claim, PrintedChannel};

use columns::Allowance;

/// How two parties are compared.
#[derive(Clone, Debug, Default)]
pub struct ComparisonRule {
    /// Allowed differences, of three kinds: absolute, relative to the scale, and relative to the value. If a channel
    /// has several allowed differences of one kind, the last one counts.
    pub allowed: Vec<Allowed>,
    /// Quantity by which rows are matched. `None`: times if both parties have times, otherwise crank angles.
    pub by: Option<By>,
    /// Whether a table may be interpolated between its instants.
    pub interpolates: bool,
    /// The side of a recording to compare; `None` for all.
    pub side: Option<String>,
    /// Words that select the channels to compare; empty for all channels.
    pub only: Vec<String>,
    /// Memory allowed (bytes); `None` for the limit of a proof.
    pub memory: Option<f64>,
}

impl ComparisonRule {
    /// Allowed differences by channel.
    #[must_use]
    pub fn allowances(&self) -> Allowances<'_> {
        let mut all = [None; 3];
        for (index, allowed) in self.allowed.iter().enumerate().filter(|(_, allowed)| allowed.of.is_none()) {
            all[allowed.size.kind()] = Some(index);
        }
        Allowances { allowed: &self.allowed, all, words: self.allowed_words() }
    }

    fn allowed_words(&self) -> Words {
        let own = self.allowed.iter().enumerate();
        Words::of(own.filter_map(|(index, allowed)| Some((index, allowed.of.as_deref()?))))
    }

    /// Allowed difference of the input (SI), such as the crank angle. `scale` is the scale of the input.
    /// The difference follows from allowances for all channels and for the word `crank`. Absolute allowances are in
    /// the displayed unit of the input, such as degrees for a crank angle.
    #[must_use]
    pub fn allows_crank(&self, scale: f64, input: Input) -> Option<Allowance> {
        let own = self.allowed.iter().filter(|own| own.of.as_deref().is_none_or(|word| word == CRANK));
        allowance(own, scale, input.read(1.0))
    }

    /// Whether the crank angle is requested.
    #[must_use]
    pub fn asks_for_crank(&self) -> bool {
        self.only.is_empty() || self.only.iter().any(|word| word == CRANK)
    }

    /// Returns a function that tells whether a channel is requested.
    pub fn asked(&self) -> impl Fn(&Claim) -> bool + use<> {
        let words = Words::of(self.only.iter().map(String::as_str).enumerate());
        let is_all = self.only.is_empty();
        move |claim| is_all || words.meaning(claim).next().is_some()
    }

    /// Refuses allowances for a word that matches no compared channel.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] with the word.
    pub(super) fn check_used<'a>(&self, compared: impl Iterator<Item = &'a Claim> + Clone) -> Result<()> {
        let words = self.allowed_words();
        let used: BTreeSet<usize> = compared.clone().flat_map(|claim| words.meaning(claim)).collect();
        let is_unused = |(index, word): &(usize, &String)| *word != CRANK && !used.contains(index);
        let own = self.allowed.iter().enumerate();
        match own.filter_map(|(index, allowed)| Some((index, allowed.of.as_ref()?))).find(is_unused) {
            None => Ok(()),
            Some((_, word)) => {
                let all: Vec<&str> = compared.map(|claim| claim.text.as_str()).take(5).collect();
                let help = sentences::name_one_of_them_a_subject(&all.join(", "));
                Err(Error::new(ErrorKind::Input, sentences::no_channel_that_is_compared(&word)).help(help))
            }
        }
    }
}

/// The word that selects the crank angle of the compared rows.
const CRANK: &str = "crank";

/// Words that select claims, with the indices of the words. A map keeps the search fast if there are many words and
/// many claims.
struct Words(BTreeMap<String, Vec<usize>>);

impl Words {
    fn of<'a>(words: impl Iterator<Item = (usize, &'a str)>) -> Self {
        let mut own: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (index, word) in words {
            own.entry(in_si(word)).or_default().push(index);
        }
        Words(own)
    }

    /// Indices of the words that match a claim.
    /// A word matches a claim if it is the claim's text, the name of the claim's channel in any unit, the subject or
    /// the stage of this channel, or subject and stage together.
    /// If the claim is an expression of several channels, a word other than its text must match all these channels.
    fn meaning(&self, claim: &Claim) -> impl Iterator<Item = usize> + use<'_> {
        let mut channels = claim.channels.iter().map(|(_, own)| called(own));
        let first = channels.next().unwrap_or_default();
        let mut names = channels.fold(first, |all, own| all.intersection(&own).cloned().collect());
        names.insert(in_si(&claim.text));
        names.into_iter().filter_map(|name| self.0.get(&name)).flatten().copied()
    }
}

/// If the word is the name of a channel in any unit, returns the name in SI units. Returns any other word unchanged.
fn in_si(word: &str) -> String {
    PrintedChannel::named(word).map_or_else(|| word.into(), |own| own.channel.to_string())
}

/// Words that match a channel.
fn called(own: &PrintedChannel) -> BTreeSet<String> {
    let (name, stage) = (own.channel.to_string(), own.channel.kind.stage.name());
    let subject = name.rsplit_once('.').map_or("", |(subject, _)| subject).to_string();
    [format!("{subject}.{stage}"), subject, stage.into(), name].into()
}

/// Allowed differences, found by the names of channels.
pub struct Allowances<'a> {
    allowed: &'a [Allowed],
    /// For each kind of allowance, the index of the last allowance that applies to all channels.
    all: [Option<usize>; 3],
    words: Words,
}

impl Allowances<'_> {
    /// Allowed difference of a channel with this scale, in the channel's unit; `None` if the channel has no allowance.
    #[must_use]
    pub fn of(&self, claim: &Claim, scale: f64) -> Option<Allowance> {
        let own: BTreeSet<usize> = self.words.meaning(claim).chain(self.all.into_iter().flatten()).collect();
        allowance(own.into_iter().map(|index| &self.allowed[index]), scale, 1.0)
    }
}

/// Allowed difference by all allowances in `own`. An absolute allowance is multiplied by `unit`.
/// If several allowances are of the same kind, the last one counts.
fn allowance<'a>(own: impl Iterator<Item = &'a Allowed>, scale: f64, unit: f64) -> Option<Allowance> {
    let mut sizes: [Option<f64>; 3] = [None; 3];
    for allowed in own {
        sizes[allowed.size.kind()] = Some(match allowed.size {
            Size::Absolute(size) => unit * size,
            Size::Relative(share) => share * scale,
            Size::OfValue(share) => share,
        });
    }
    let [absolute, relative, of_value] = sizes.map(Option::unwrap_or_default);
    let is_allowed = sizes.iter().any(Option::is_some);
    is_allowed.then_some(Allowance { fixed: absolute.larger(relative), of_value })
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::trajectory::Channel;

    fn how(allowed: &[(Option<&str>, Size)]) -> ComparisonRule {
        let of = |(of, size): &(Option<&str>, Size)| Allowed { of: of.map(Into::into), size: *size };
        ComparisonRule { allowed: allowed.iter().map(of).collect(), ..ComparisonRule::default() }
    }

    /// The channel has a scale of 4. If a channel has several allowances, the last one of each kind counts.
    #[test]
    fn the_larger_of_absolute_and_relative_allowances_counts() {
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
            assert_eq!(how(&said).allowances().of(&claim, 4.0), allowed, "{said:?}");
        }
        // The crank accepts an allowance in degrees or as a fraction of its range, and ignores an allowance for another
        // channel.
        let crank = |said: &[(Option<&str>, Size)]| how(said).allows_crank(4.0, Input::Angle).map(|own| own.fixed);
        assert_eq!(crank(&[(Some("crank"), absolute(180.0))]), Some(std::f64::consts::PI));
        assert_eq!(crank(&[(None, relative(0.5))]), Some(2.0));
        assert_eq!(crank(&[(Some("point.B"), absolute(1.0))]), None);
    }

    /// A word matches an expression of channels if the word is the expression's text or matches all its channels. The
    /// error for a word without a match contains the word.
    #[test]
    fn a_word_selects_claims_whose_channels_all_match() {
        let channels = ["point.B.x_m", "point.B.y_m"].map(|name| Channel::named(name).unwrap());
        let claim = Claim::of_channels("point.B.x_m + point.B.y_m", &channels).unwrap();
        for (word, is_meant) in [
            ("point.B.x_m + point.B.y_m", true),
            ("point.B", true),
            ("positions", true),
            ("point.B.positions", true),
            ("point.B.x_m", false),
            ("velocities", false),
        ] {
            let only = ComparisonRule { only: vec!["point.C".into(), word.into()], ..ComparisonRule::default() };
            assert_eq!(only.asked()(&claim), is_meant, "{word}");
            let said = how(&[(Some("crank"), Size::Absolute(1.0)), (Some(word), Size::Absolute(1.0))]);
            assert_eq!(said.allowances().of(&claim, 1.0).is_some(), is_meant, "{word}");
            let refused = said.check_used([&claim].into_iter()).err();
            assert_eq!(refused.map(|error| error.message().contains(word)), (!is_meant).then_some(true), "{word}");
        }
        assert!(ComparisonRule::default().asked()(&claim));
    }
}
