//! Required motion of an output over one turn of the crank, as phases: forward motion, backward motion or dwell.

use crate::sentences;
use std::f64::consts::TAU;

use linkage::error::{Error, ErrorKind, Result};

/// Upper limit of the number of phases per turn: one for every ten degrees.
const MOST_PHASES: usize = 36;

linkage::words! {
    /// Motion of the output in a phase.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Sense: name {
        /// The output is at rest.
        Dwell = "dwell",
        /// The output moves forward.
        Forward = "forward",
        /// The output moves back.
        Back = "back",
    }
}

impl Sense {
    /// +1 for forward motion, -1 for backward motion, 0 for rest.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Sense::Dwell => 0.0,
            Sense::Forward => 1.0,
            Sense::Back => -1.0,
        }
    }
}

/// One phase of a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Crank angle at the start of the phase (rad, from crank angle zero in the sense of rotation).
    pub from: f64,
    /// Crank angle at the end of the phase (rad).
    pub to: f64,
    /// Motion of the output.
    pub sense: Sense,
    /// Required position at the end of the phase, as a fraction of the stroke from the rearmost position: 0 to 1.
    /// `None` if the search may choose the position.
    pub level: Option<f64>,
    /// Smallest displacement of a moving phase, as a fraction of the stroke.
    pub least: f64,
}

/// The phases of one turn, in sequence from 0 to a full turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    phases: Vec<Phase>,
    /// Levels at the ends of all phases, if all are known.
    levels: Option<Vec<f64>>,
    /// Whether the output must follow the smooth curve between the levels.
    /// If not, the output must only move in the required sense.
    follow: bool,
}

impl Timing {
    /// The timing of a task that requires precision points only. It has no phases.
    pub fn without_phases() -> Self {
        Timing { phases: Vec::new(), levels: None, follow: false }
    }

    /// The timing of these phases.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if the phases do not follow one another over a whole turn, or contradict one another.
    /// The error states the number of the phase, as in `phases[2]`.
    pub fn of(phases: Vec<Phase>) -> Result<Self> {
        let of_all = |message: String, help: &str| Err(wrong("phases", message).help(help));
        let of_one = |index: usize, message: String, help: &str| {
            Err(wrong(&format!("phases[{}]", index + 1), message).help(help))
        };
        if phases.len() < 2 {
            let help = "write `phases = [{ to_deg = 180, sense = \"forward\" }, { to_deg = 360, sense = \"back\" }]`";
            return of_all(sentences::found_phases_but_a_motion(&phases.len()), help);
        }
        if phases.len() > MOST_PHASES {
            let message = sentences::found_phases_more_than(&phases.len(), &MOST_PHASES);
            return of_all(message, sentences::JOIN_PHASES_OF_ONE_SENSE);
        }
        let mut from = 0.0;
        for (index, phase) in phases.iter().enumerate() {
            if phase.from != from || !(phase.to > phase.from) {
                let message = sentences::the_phase_leads_from_to_deg(&phase.from.to_degrees(), &phase.to.to_degrees());
                return of_one(index, message, sentences::LET_CRANK_ANGLES_ASCEND_FROM_PHASE);
            }
            if phase.level.is_some_and(|level| !(0.0..=1.0).contains(&level)) {
                let message = sentences::A_LEVEL_IS_A_SHARE_OF_THE_STROKE.into();
                return of_one(index, message, sentences::GIVE_A_NUMBER_FROM_TO);
            }
            if !(phase.least >= 0.0 && phase.least < 1.0) {
                let message = sentences::THE_LEAST_DISPLACEMENT_IS_A_SHARE.into();
                return of_one(index, message, sentences::GIVE_A_NUMBER_FROM_TO_BELOW);
            }
            from = phase.to;
        }
        if (from - TAU).abs() > 1e-9 {
            let message = sentences::the_last_phase_ends_at_deg(&from.to_degrees());
            return of_one(phases.len() - 1, message, sentences::LET_IT_END_AT_DEG);
        }
        for sense in [Sense::Forward, Sense::Back] {
            if !phases.iter().any(|phase| phase.sense == sense) {
                let message = sentences::no_phase_goes_the_output(&sense.name());
                return of_all(message, sentences::AN_OUTPUT_THAT_ROCKS_GOES);
            }
        }
        Ok(Timing { levels: levels(&phases), phases, follow: false })
    }

    /// This timing, with a curve that the output must follow.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a level is not known.
    pub fn followed(self) -> Result<Self> {
        if self.levels.is_none() {
            return Err(wrong("follow", sentences::THE_CURVE_IS_TO_BE_FOLLOWED.into())
                .help(sentences::GIVE_EVERY_MOVING_PHASE_ITS_LEVEL));
        }
        Ok(Timing { follow: true, ..self })
    }

    /// Phases.
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// Whether the output must follow [`Timing::wanted`]. If not, the output must only move in the required sense.
    pub fn follows(&self) -> bool {
        self.follow
    }

    /// Level required at the end of a phase: the given level, or the level that follows from other phases. `None` if
    /// the level is unknown.
    pub fn level(&self, phase: usize) -> Option<f64> {
        self.levels.as_ref().map(|levels| levels[phase]).or(self.phases[phase].level)
    }

    /// Required output at the crank angle `crank` (rad, 0 to a full turn), as a fraction of the stroke (0 rearmost, 1
    /// foremost).
    /// In each phase, the required output follows the cycloidal curve u - sin(2 pi u) / (2 pi) from level to level.
    /// Here, u grows from 0 to 1 over the phase. The acceleration has no jumps.
    /// `None` if a level is unknown.
    pub fn wanted(&self, crank: f64) -> Option<f64> {
        let levels = self.levels.as_ref()?;
        let index = self.phases.iter().position(|phase| crank <= phase.to).unwrap_or(self.phases.len() - 1);
        let phase = &self.phases[index];
        let before = levels[(index + levels.len() - 1) % levels.len()];
        let u = ((crank - phase.from) / (phase.to - phase.from)).clamp(0.0, 1.0);
        Some(before + (levels[index] - before) * (u - (TAU * u).sin() / TAU))
    }
}

fn wrong(key: &str, message: String) -> Error {
    Error::new(ErrorKind::Input, message).key(key)
}

/// Levels at the ends of all phases. If the level of a dwell is not given, the dwell keeps the level of the phase
/// before.
/// If there is only one forward motion and one backward motion, the forward motion ends at the level 1 and the backward
/// motion at the level 0.
fn levels(phases: &[Phase]) -> Option<Vec<f64>> {
    let alone = |sense: Sense| phases.iter().filter(|phase| phase.sense == sense).count() == 1;
    let simple = alone(Sense::Forward) && alone(Sense::Back);
    let mut found: Vec<Option<f64>> = phases
        .iter()
        .map(|phase| match phase.sense {
            Sense::Forward if simple => Some(1.0),
            Sense::Back if simple => Some(0.0),
            Sense::Forward | Sense::Back | Sense::Dwell => phase.level,
        })
        .collect();
    let count = phases.len();
    // Two passes are needed, because a dwell at the start of the turn keeps the level from the end of the turn.
    for index in 0..2 * count {
        let (own, before) = (index % count, (index + count - 1) % count);
        if phases[own].sense == Sense::Dwell && found[own].is_none() {
            found[own] = found[before];
        }
    }
    found.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phases(all: &[(f64, Sense, Option<f64>)]) -> Vec<Phase> {
        let mut from = 0.0;
        let mut phase = |&(to, sense, level): &(f64, Sense, Option<f64>)| {
            let to = f64::to_radians(to);
            let phase = Phase { from, to, sense, level, least: 0.05 };
            from = to;
            phase
        };
        all.iter().map(&mut phase).collect()
    }

    #[test]
    fn levels_follow_from_one_motion_in_each_direction() {
        use Sense::{Back, Dwell, Forward};
        let all = phases(&[(30.0, Dwell, None), (130.0, Forward, None), (240.0, Back, None), (360.0, Dwell, None)]);
        let timing = Timing::of(all).unwrap().followed().unwrap();
        let at = |deg: f64| timing.wanted(deg.to_radians()).unwrap();
        assert_eq!([at(0.0), at(15.0), at(300.0), at(360.0)], [0.0; 4]);
        assert!((at(130.0) - 1.0).abs() < 1e-15 && (at(80.0) - 0.5).abs() < 1e-12);
        assert!((at(185.0) - 0.5).abs() < 1e-12 && at(100.0) > at(90.0));
    }

    #[test]
    fn unknown_levels_stay_undefined() {
        use Sense::{Back, Dwell, Forward};
        let open = [(90.0, Forward, None), (180.0, Dwell, None), (270.0, Forward, Some(1.0)), (360.0, Back, Some(0.0))];
        let timing = Timing::of(phases(&open)).unwrap();
        assert_eq!([timing.level(0), timing.level(2), timing.wanted(1.0)], [None, Some(1.0), None]);
        assert!(timing.followed().unwrap_err().message().contains("some levels"));
    }

    #[test]
    fn phases_that_do_not_form_a_turn_are_refused() {
        use Sense::{Back, Dwell, Forward};
        for (all, words) in [
            (vec![(360.0, Forward, None)], "found 1 phases"),
            (vec![(200.0, Forward, None), (100.0, Back, None)], "runs from 200"),
            (vec![(200.0, Forward, None), (350.0, Back, None)], "ends at 350"),
            (vec![(200.0, Forward, None), (360.0, Dwell, None)], "no phase moves back"),
            (vec![(200.0, Forward, Some(1.5)), (360.0, Back, None)], "fraction of the stroke"),
        ] {
            let error = Timing::of(phases(&all)).unwrap_err();
            assert!(error.message().contains(words) && error.way_out().is_some(), "{error}");
        }
    }
}
