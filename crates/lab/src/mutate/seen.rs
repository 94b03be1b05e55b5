//! Detection of a fault: the channels and checks that exceed their bounds, the first instant at which a bound is
//! exceeded, and the margin.

use crate::sentences;
use linkage::math::statistics::ascending;
use linkage::trajectory::Trajectory;
use prover::bounds::{Check, Verdict, differences, overall};
use prover::run::{ChannelProof, EngineProof, Judgement, ObservedSides};

/// A channel or a check that exceeds its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Sight {
    /// Name of the channel or check, and of the comparison.
    pub what: String,
    /// First instant at which the bound is exceeded (s), and the input at this instant (SI).
    /// `None` for a check of the whole run.
    pub since: Option<(f64, f64)>,
    /// Largest difference divided by its bound.
    pub margin: f64,
}

/// Outcome of a proof with a fault in one party.
#[derive(Clone, Debug, PartialEq)]
pub enum FaultyProof {
    /// At least one channel or check disagrees.
    Detected {
        /// The detection at the earliest instant.
        /// If several detections have this instant, the detection with the largest margin.
        first: Sight,
        /// The detection with the largest margin.
        clearest: Sight,
        /// Number of channels that exceed their bounds.
        channels: usize,
        /// Families of checks that disagree.
        checks: Vec<String>,
    },
    /// A party gives this message in place of an answer.
    Refused(String),
    /// The proof is inconclusive, for this reason.
    Inconclusive(String),
    /// All channels and checks agree.
    Escaped,
    /// Exact answers are the same with and without the fault, up to rounding error.
    /// The number is the largest change, relative to the largest number of the changed quantity.
    Equivalent(f64),
}

impl FaultyProof {
    /// Word for tables.
    pub fn word(&self) -> &'static str {
        match self {
            FaultyProof::Detected { .. } => "detected",
            FaultyProof::Refused(_) => "refused",
            FaultyProof::Inconclusive(_) => "inconclusive",
            FaultyProof::Escaped => "escaped",
            FaultyProof::Equivalent(_) => "equivalent",
        }
    }

    /// Whether the fault is found: a channel or check disagrees, or a party gives no answer.
    pub fn is_found(&self) -> bool {
        match self {
            FaultyProof::Detected { .. } | FaultyProof::Refused(_) => true,
            FaultyProof::Inconclusive(_) | FaultyProof::Escaped | FaultyProof::Equivalent(_) => false,
        }
    }

    /// Largest margin of a detected fault; `None` if the fault is not detected.
    pub fn margin(&self) -> Option<f64> {
        match self {
            FaultyProof::Detected { clearest, .. } => Some(clearest.margin),
            FaultyProof::Refused(_)
            | FaultyProof::Inconclusive(_)
            | FaultyProof::Escaped
            | FaultyProof::Equivalent(_) => None,
        }
    }
}

fn disagrees(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Disagree { .. })
}

/// Collects the detections of a fault.
#[derive(Default)]
pub(super) struct Eyes {
    sights: Vec<Sight>,
    channels: usize,
    checks: Vec<String>,
    verdicts: Vec<Verdict>,
}

impl Eyes {
    /// Adds the detections by the analytic sides. If `is_outside` is true, the comparison of the two sides is omitted.
    pub(super) fn sides(mut self, sides: &ObservedSides, is_outside: bool) -> Self {
        if !is_outside {
            let beyond = sides.beyond();
            self.channels += beyond.len();
            let sights = beyond.into_iter().map(|own| Sight {
                what: sentences::assur_against_newton_2(&own.channel),
                since: Some(own.since),
                margin: own.margin,
            });
            self.sights.extend(sights);
        }
        let between = |check: &&Check| check.family.starts_with("assur against newton");
        self.checks(sides.checks.iter().filter(|check| !is_outside || !between(check)));
        self
    }

    /// Adds the detections by the comparison of an engine with the reference.
    pub(super) fn engine(mut self, proof: &EngineProof, reference: &Trajectory) -> Self {
        let name = proof.info.name;
        if let Some(trajectory) = &proof.trajectory {
            self.channels(&proof.channels, reference, trajectory, &proof.kept, name);
        }
        if let Some(own) = &proof.own_forces
            && let Some(trajectory) = &own.trajectory
            && proof.added().is_some()
        {
            self.channels(&own.channels, reference, trajectory, &[], &sentences::own_forces(&name));
        }
        self.checks(proof.checks.iter());
        self.verdicts.push(proof.verdict.clone());
        self
    }

    /// Adds the detections by the judgement of formulas. `checks` are in the order of the judgement.
    pub(super) fn formulas(mut self, judgement: &Judgement, checks: &[Check]) -> Self {
        let judged = judgement.sides.iter().flat_map(|(_, all)| all.iter().flatten());
        for (check, judged) in checks.iter().zip(judged) {
            let before = self.sights.len();
            self.checks(std::iter::once(check));
            for sight in &mut self.sights[before..] {
                sight.since = judged.since.map(|at| (at.time, at.crank));
            }
        }
        self
    }

    fn channels(
        &mut self,
        judged: &[ChannelProof],
        reference: &Trajectory,
        run: &Trajectory,
        kept: &[bool],
        who: &str,
    ) {
        let rows = ascending(reference.times());
        for own in judged.iter().filter(|own| disagrees(&own.verdict)) {
            let channel = &own.residual.channel;
            self.channels += 1;
            let since = reference.column(channel).zip(run.column(channel)).and_then(|(ours, theirs)| {
                let gaps = differences(ours, theirs, channel.kind.periodic);
                let is_beyond =
                    |row: &&usize| kept.get(**row).copied().unwrap_or(true) && !(gaps[**row].abs() <= own.bound);
                let first = *rows.iter().find(is_beyond)?;
                Some((reference.times()[first], reference.inputs()[first]))
            });
            let what = format!("{channel} ({who})");
            self.sights.push(Sight { what, since, margin: own.residual.max / own.bound });
        }
    }

    fn checks<'a>(&mut self, checks: impl Iterator<Item = &'a Check>) {
        for check in checks {
            self.verdicts.push(check.verdict.clone());
            if disagrees(&check.verdict) {
                if !self.checks.contains(&check.family) {
                    self.checks.push(check.family.clone());
                }
                self.sights.push(Sight { what: check.name(), since: None, margin: check.used() });
            }
        }
    }

    /// Whether one of the collected verdicts is a disagreement.
    pub(super) fn is_decided(&self) -> bool {
        self.verdicts.iter().any(disagrees)
    }

    /// The combined outcome of all verdicts.
    pub(super) fn outcome(self) -> FaultyProof {
        match overall(&self.verdicts) {
            Verdict::Disagree { place } => {
                let unnamed = || Sight { what: place.clone(), since: None, margin: f64::INFINITY };
                let time = |sight: &Sight| sight.since.map_or(f64::INFINITY, |(time, _)| time);
                let earlier = |a: &&Sight, b: &&Sight| time(a).total_cmp(&time(b)).then(b.margin.total_cmp(&a.margin));
                let first = self.sights.iter().min_by(earlier).cloned().unwrap_or_else(unnamed);
                let clearest = self.sights.iter().max_by(|a, b| a.margin.total_cmp(&b.margin));
                let clearest = clearest.cloned().unwrap_or_else(unnamed);
                FaultyProof::Detected { first, clearest, channels: self.channels, checks: self.checks }
            }
            Verdict::Inconclusive { reason, .. } => FaultyProof::Inconclusive(reason),
            Verdict::Agree { .. } | Verdict::Expected { .. } => FaultyProof::Escaped,
        }
    }
}
