//! Checks formulas against a mechanism over its whole motion.

use linkage::error::{Error, ErrorKind, Result};
use prover::run::solved::{Claimed, judge};
use scenario::formula::{fault_of_claim, refused};
use scenario::{Claim, Scenario};

/// A formula, and the channel of a mechanism that the formula claims to equal.
/// [`check_formula`] judges the formula.
#[derive(Clone, Debug, Default)]
pub struct FormulaQuestion {
    /// The formula: a function of the crank angle `phi` (rad), the time `t` (s), and parameters and formulas of the
    /// scenario.
    pub formula: String,
    /// The quantity that the formula claims to equal: a channel in its unit, such as `link.rocker.angle_deg`, or an
    /// expression of channels.
    pub channel: String,
    /// Steps of the derivation, by name: formulas that later steps and `formula` may use.
    pub steps: Vec<(String, String)>,
    /// First and last crank angle (rad) between which the formula is claimed to be valid.
    pub valid: [Option<f64>; 2],
    /// Claimed error in the channel's unit, for series and approximations.
    pub error: Option<f64>,
}

/// Names that messages use for the parts of a [`FormulaQuestion`].
pub(crate) struct Words {
    pub formula: &'static str,
    pub channel: &'static str,
    pub step: &'static str,
    pub valid: &'static str,
    pub error: &'static str,
}

const WORDS: Words = Words { formula: "formula", channel: "channel", step: "steps", valid: "valid", error: "error" };

impl FormulaQuestion {
    /// The question whether `formula` equals `channel`.
    pub fn of(formula: impl Into<String>, channel: impl Into<String>) -> FormulaQuestion {
        FormulaQuestion { formula: formula.into(), channel: channel.into(), ..FormulaQuestion::default() }
    }

    /// The scenario with this formula as its only claim. The claims of the scenario file are removed.
    pub(crate) fn of_scenario(&self, mut scenario: Scenario, words: &Words) -> Result<Scenario> {
        scenario.formulas.list.iter_mut().for_each(|formula| formula.claim = None);
        for (name, text) in &self.steps {
            scenario.formulas.check_name(name).map_err(|error| error.key(words.step))?;
            scenario.formulas.add(name, text).map_err(|fault| refused(words.step, text, &fault))?;
        }
        let claim = Claim::with_parameters(&self.channel, &scenario.case, &scenario.formulas.parameters);
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

/// Judges every `[[formula]]` of a scenario that claims a channel.
/// The values and the derivatives of the formula are compared with both analytic sides at all instants of the grid.
/// The bound of a comparison is the sum of three errors: the rounding error of the formula, the error of the side, and
/// the error that the formula claims, if any.
/// If a formula is wrong and the cause is simple, the result names the cause.
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
/// [`ErrorKind::Input`] if no formula claims a channel.
/// If an analytic side cannot solve the scenario, the error of that side is returned, with the crank angle.
pub fn check(scenario: &Scenario) -> Result<Claimed> {
    judge(scenario)
}

/// Judges one formula against a scenario, as [`check`] judges the formulas of a file.
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
/// [`ErrorKind::Input`] for an invalid formula or channel, with its location.
/// The errors of [`check`] are returned as well.
pub fn check_formula(scenario: &Scenario, question: &FormulaQuestion) -> Result<Claimed> {
    check(&question.of_scenario(scenario.clone(), &WORDS)?)
}
