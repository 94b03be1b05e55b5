//! Formulas against a mechanism, over its whole motion.

use linkage::error::{Error, ErrorKind, Result};
use prover::run::solved::{Claimed, judge};
use scenario::formula::{fault_of_claim, refused};
use scenario::{Claim, Scenario};

/// A formula that is claimed to be a channel of a mechanism: what [`check_formula`] judges.
#[derive(Clone, Debug, Default)]
pub struct FormulaQuestion {
    /// The formula, over the crank angle `phi` (rad), the time `t` (s), parameters and formulas of the scenario.
    pub formula: String,
    /// What it claims to be: a channel in its unit, such as `link.rocker.angle_deg`, or an arithmetic of channels.
    pub channel: String,
    /// Steps of the derivation, by their names: formulas that those after them and `formula` may use.
    pub steps: Vec<(String, String)>,
    /// First and last crank angle (rad) for which the formula is claimed.
    pub valid: [Option<f64>; 2],
    /// Error that it is claimed to have, in the channel's unit: for series and approximations.
    pub error: Option<f64>,
}

/// What messages call the parts of a [`FormulaQuestion`].
pub(crate) struct Words {
    pub formula: &'static str,
    pub channel: &'static str,
    pub step: &'static str,
    pub valid: &'static str,
    pub error: &'static str,
}

const WORDS: Words = Words { formula: "formula", channel: "channel", step: "steps", valid: "valid", error: "error" };

impl FormulaQuestion {
    /// Whether `formula` is `channel`.
    pub fn of(formula: impl Into<String>, channel: impl Into<String>) -> FormulaQuestion {
        FormulaQuestion { formula: formula.into(), channel: channel.into(), ..FormulaQuestion::default() }
    }

    /// The scenario that asks this, and nothing of what its file claims.
    pub(crate) fn of_scenario(&self, mut scenario: Scenario, words: &Words) -> Result<Scenario> {
        scenario.formulas.list.iter_mut().for_each(|formula| formula.claim = None);
        for (name, text) in &self.steps {
            scenario.formulas.check_name(name).map_err(|error| error.key(words.step))?;
            scenario.formulas.add(name, text).map_err(|fault| refused(words.step, text, &fault))?;
        }
        let claim = Claim::parse(&self.channel, &scenario.case);
        let claim = claim.map_err(|fault| refused(words.channel, &self.channel, &fault))?;
        let formula = scenario.formulas.add("formula", &self.formula);
        let formula = formula.map_err(|fault| refused(words.formula, &self.formula, &fault))?;
        (formula.claim, formula.valid, formula.error) = (Some(claim), self.valid, self.error);
        if let Some((key, message, help)) = fault_of_claim(self.valid, self.error) {
            let word = if key == "to" { words.valid } else { words.error };
            return Err(Error::new(ErrorKind::Input, message).key(word).help(help));
        }
        Ok(scenario)
    }
}

/// Judges every `[[formula]]` of a scenario that claims a channel: by value and by its derivatives, at all instants of
/// the grid and against both analytic sides, within the rounding of the formula. A wrong one is explained, where that
/// is simple.
///
/// ```
/// use linkproof::{Scenario, check};
///
/// # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
/// let scenario = Scenario::load("scenarios/formulas/slider_crank_centric.toml")?;
/// assert_eq!(check(&scenario)?.verdict.word(), "agree");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Input`] if no formula claims a channel, and those of the sides, with the crank angle.
pub fn check(scenario: &Scenario) -> Result<Claimed> {
    judge(scenario)
}

/// Judges one formula against a scenario, as [`check`] does those of its file.
///
/// ```
/// use linkproof::parts::FormulaQuestion;
/// use linkproof::{Scenario, check_formula};
///
/// # std::env::set_current_dir(env!("CARGO_MANIFEST_DIR"))?;
/// let scenario = Scenario::load("scenarios/formulas/slider_crank_centric.toml")?;
/// let right = FormulaQuestion::of("r*cos(phi) + sqrt(l^2 - (r*sin(phi))^2)", "point.B.x_m");
/// let wrong = FormulaQuestion::of("r*cos(phi) + sqrt(l^2 + (r*sin(phi))^2)", "point.B.x_m");
/// assert_eq!(check_formula(&scenario, &right)?.verdict.word(), "agree");
/// assert_eq!(check_formula(&scenario, &wrong)?.verdict.word(), "disagree");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Input`] for a formula or channel that is not understood, with its place; those of [`check`].
pub fn check_formula(scenario: &Scenario, question: &FormulaQuestion) -> Result<Claimed> {
    check(&question.of_scenario(scenario.clone(), &WORDS)?)
}
