//! The remedy for an error, as data.
//! The text of a remedy does not mention command-line options. The command line adds the names of its options.

use crate::sentences;
use std::fmt;

/// One remedy. Several remedies of one error are alternatives.
///
/// [`Advice::Text`] is advice about a scenario's text, for a person to read. Programs can act on the other variants.
#[derive(Clone, Debug, PartialEq)]
pub enum Advice {
    /// Advice in words only. The words name, for example, the scenario key to change.
    Text(String),
    /// A smaller time step of the engine.
    SmallerStep {
        /// A step to try (s), if the present step is known.
        to: Option<f64>,
    },
    /// A larger time step of the engine.
    LargerStep {
        /// A step to try (s), if the present step is known.
        to: Option<f64>,
    },
    /// A smaller accuracy value for an engine that chooses its time steps itself.
    TighterAccuracy {
        /// A relative accuracy to try.
        to: f64,
    },
    /// A larger accuracy value for an engine that chooses its time steps itself.
    LooserAccuracy {
        /// A relative accuracy to try.
        to: f64,
    },
    /// More iteration sweeps per step of the engine.
    MoreSweeps {
        /// A number of sweeps to try, if the present number is known.
        to: Option<usize>,
    },
    /// Settings chosen by the proof instead of the given settings.
    FreeSettings,
    /// More work for the search of settings.
    MoreWork {
        /// Amount of work to allow, in the unit of budgets: one time step of an engine on a four-bar, without sweeps.
        to: f64,
    },
    /// Fewer instants, or fewer channels.
    FewerInstants,
    /// More memory for a run.
    MoreMemory {
        /// Memory to allow (bytes).
        to: f64,
    },
    /// An engine in double precision.
    DoublePrecision,
    /// Another engine.
    OtherEngine,
    /// A method for the reactions other than the present method.
    OtherRoute {
        /// Names of the methods that work.
        routes: &'static [&'static str],
    },
    /// An analytic solver other than the present one as the reference of a proof.
    OtherReference {
        /// Name.
        solver: &'static str,
    },
    /// An analytic solver alone, without an engine.
    OtherSolver {
        /// Name.
        solver: &'static str,
    },
    /// A grid within the crank angles that the branch reaches.
    ShortenGrid,
    /// An analysis of the range of motion. The analysis shows what limits the crank and which links turn fully.
    LookAtRange,
    /// A configuration of an Assur group other than the present configuration.
    Configuration {
        /// Text that says what the user can specify.
        give: String,
    },
    /// The solution as a table instead of the requested form.
    SolutionTable,
    /// Channels that exist.
    OtherChannel {
        /// Names of the groups of channels, as a text.
        groups: String,
    },
    /// A weaker request, because no engine meets the present request.
    /// A weaker request allows a larger error, asks for different channels or admits more engines.
    WeakerWish,
    /// The complete results instead of an extract.
    AllResults,
    /// A model without the loads of the case.
    NoLoads,
}

impl Advice {
    /// This advice, completed with a number to try.
    /// If the engine controls its error, advice on the time step becomes advice on the accuracy.
    /// The number is computed from the engine's present settings: its `resolution` and its number of `sweeps`.
    /// `resolution` is a time step (s), or a relative accuracy if the engine `controls_error`.
    #[must_use]
    pub fn from_settings(self, resolution: f64, controls_error: bool, sweeps: usize) -> Self {
        let (half, double) = (rounded(resolution / 2.0), rounded(resolution * 2.0));
        let is_finer = matches!(self, Advice::SmallerStep { .. } | Advice::TighterAccuracy { .. });
        let is_coarser = matches!(self, Advice::LargerStep { .. } | Advice::LooserAccuracy { .. });
        match (is_finer, is_coarser) {
            (true, _) if controls_error => Advice::TighterAccuracy { to: half },
            (_, true) if controls_error => Advice::LooserAccuracy { to: double },
            _ if matches!(self, Advice::SmallerStep { .. }) => Advice::SmallerStep { to: Some(half) },
            _ if matches!(self, Advice::LargerStep { .. }) => Advice::LargerStep { to: Some(double) },
            _ if matches!(self, Advice::MoreSweeps { .. }) => Advice::MoreSweeps { to: Some(2 * sweeps) },
            // All other variants do not depend on an engine's settings and stay unchanged.
            _ => self,
        }
    }

    /// The alternatives as one sentence; `None` if the list is empty. `tell` puts each alternative into words.
    #[must_use]
    pub fn sentence(all: &[Advice], tell: impl Fn(&Advice) -> String) -> Option<String> {
        (!all.is_empty()).then(|| all.iter().map(tell).collect::<Vec<_>>().join(", or "))
    }
}

/// A number to try, rounded to two digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.1e}").parse().unwrap_or(number)
}

/// A number to allow, rounded up to a multiple of 0.1.
#[must_use]
pub fn rounded_up(number: f64) -> f64 {
    (number * 10.0).ceil() / 10.0
}

impl From<&str> for Advice {
    fn from(words: &str) -> Self {
        Advice::Text(words.into())
    }
}

impl From<String> for Advice {
    fn from(words: String) -> Self {
        Advice::Text(words)
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Advice::Text(words) => f.write_str(words),
            Advice::SmallerStep { to: None } => f.write_str(sentences::CHOOSE_A_SMALLER_TIME_STEP_2),
            Advice::SmallerStep { to: Some(to) } => {
                write!(f, "{}", sentences::choose_a_smaller_time_step(&format_args!("{to:e}")))
            }
            Advice::LargerStep { to: None } => f.write_str(sentences::CHOOSE_A_LARGER_TIME_STEP_2),
            Advice::LargerStep { to: Some(to) } => {
                write!(f, "{}", sentences::choose_a_larger_time_step(&format_args!("{to:e}")))
            }
            Advice::TighterAccuracy { to } => {
                write!(f, "{}", sentences::choose_a_tighter_accuracy_such_as(&format_args!("{to:e}")))
            }
            Advice::LooserAccuracy { to } => {
                write!(f, "{}", sentences::choose_a_looser_accuracy_such_as(&format_args!("{to:e}")))
            }
            Advice::MoreSweeps { to: None } => f.write_str(sentences::RAISE_THE_NUMBER_OF_SWEEPS_2),
            Advice::MoreSweeps { to: Some(to) } => write!(f, "{}", sentences::raise_the_number_of_sweeps(&to)),
            Advice::FreeSettings => f.write_str(sentences::LEAVE_OUT_THE_ENGINE_SETTINGS),
            Advice::MoreWork { to } => {
                write!(f, "{}", sentences::allow_more_work_such_as_steps(&format_args!("{to:e}")))
            }
            Advice::FewerInstants => f.write_str(sentences::TAKE_FEWER_INSTANTS_OR_FEWER),
            Advice::MoreMemory { to } => {
                write!(f, "{}", sentences::allow_more_memory_such_as_gb(&(rounded_up(*to / 1e9))))
            }
            Advice::DoublePrecision => f.write_str(sentences::TAKE_AN_ENGINE_IN_DOUBLE),
            Advice::OtherEngine => f.write_str(sentences::TAKE_ANOTHER_ENGINE),
            Advice::OtherRoute { routes } => {
                write!(f, "{}", sentences::take_another_way_to_the_reactions(&routes.join(" or ")))
            }
            Advice::OtherReference { solver } => write!(f, "{}", sentences::take_side_as_the_reference(&solver)),
            Advice::OtherSolver { solver } => write!(f, "{}", sentences::solve_the_scenario_with_side(&solver)),
            Advice::ShortenGrid => f.write_str(sentences::SHORTEN_THE_GRID_TO_THE_CRANK),
            Advice::LookAtRange => f.write_str(sentences::THE_RANGE_OF_MOTION_SHOWS),
            Advice::Configuration { give } => write!(f, "give {give}"),
            Advice::SolutionTable => f.write_str(sentences::READ_THEM_OFF_A_TABLE_OF_THE_SOLUTION),
            Advice::OtherChannel { groups } => {
                write!(f, "{}", sentences::name_a_channel_of_the_solution(&groups))
            }
            Advice::WeakerWish => f.write_str(sentences::ASK_FOR_A_LARGER_ERROR_OTHER),
            Advice::AllResults => f.write_str(sentences::THE_COMPLETE_RESULTS_HAVE_ALL),
            Advice::NoLoads => f.write_str(sentences::LEAVE_ALL_LOADS_OUT),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alternatives_form_one_sentence() {
        let all = [Advice::SmallerStep { to: Some(5e-4) }, "check the lengths".into()];
        let told = Advice::sentence(&all, Advice::to_string);
        assert_eq!(told.unwrap(), "choose a smaller time step, such as 5e-4 s, or check the lengths");
        assert_eq!(Advice::sentence(&[], Advice::to_string), None);
    }

    #[test]
    fn suggested_values_follow_from_the_current_settings() {
        let from = |advice: Advice, controls| advice.from_settings(1e-3, controls, 32);
        let smaller = Advice::SmallerStep { to: None };
        assert_eq!(from(smaller.clone(), false), Advice::SmallerStep { to: Some(5e-4) });
        assert_eq!(from(smaller, true), Advice::TighterAccuracy { to: 5e-4 });
        assert_eq!(from(Advice::LargerStep { to: None }, false), Advice::LargerStep { to: Some(2e-3) });
        assert_eq!(from(Advice::LargerStep { to: None }, true), Advice::LooserAccuracy { to: 2e-3 });
        assert_eq!(from(Advice::MoreSweeps { to: None }, false), Advice::MoreSweeps { to: Some(64) });
        assert_eq!(from(Advice::OtherEngine, false), Advice::OtherEngine);
    }
}
