//! Tolerance stacks: linear theory from the derivatives, compared with a random sample of solved mechanisms.

use crate::sentences;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use linkage::case::{Case, Grid};
use linkage::error::{Error, ErrorKind, Result};
use linkage::threads::{cores, made};
use scenario::{CaseKey, Claim, Scenario, ScenarioFamily, StartRequest, TurnFigure, sampled_values};

use super::answer::{Sensitivity, SensitivityQuestion};
use super::quantity::solved;

/// A tolerance of a key: the number of the file may differ from its nominal number by at most `limit`.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyTolerance {
    /// Name of the key.
    pub key: String,
    /// Largest deviation in either sense, positive, in the unit of the key.
    pub limit: f64,
}

/// Deviations of one figure under all tolerances, in the unit of the figure.
#[derive(Clone, Debug, PartialEq)]
pub struct ToleranceStack {
    /// Worst case of linear theory: the sum of the magnitudes of all products of derivative and limit.
    pub worst: f64,
    /// Root of the sum of the squares of all products of derivative and limit.
    pub root_sum_square: f64,
    /// Standard deviation of the figure by linear theory, for the sampled deviations of the keys. These deviations are
    /// independent and uniformly distributed between their limits.
    pub linear_deviation: f64,
    /// Standard deviation of the figure over the sampled mechanisms.
    pub sampled_deviation: f64,
    /// Mean of the sampled figures minus the nominal figure.
    pub sampled_shift: f64,
    /// Smallest and largest sampled figure minus the nominal figure.
    pub sampled_ends: [f64; 2],
    /// Number of random mechanisms that could not be solved. The statistics leave out these mechanisms.
    pub unsolved: usize,
    /// Range in which linear theory is valid.
    pub limit: LinearLimit,
}

/// Multiples of all tolerances for which linear theory is valid.
/// The theory counts as valid if its standard deviation differs by at most [`APART`] from the standard deviation of the
/// solved mechanisms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinearLimit {
    /// At this multiple and above, linear theory counts as invalid.
    From(f64),
    /// At this multiple, a random mechanism cannot be solved. Linear theory is valid at all smaller multiples that were
    /// tried.
    UntilUnsolved(f64),
    /// Linear theory is valid up to this multiple of the tolerances; no larger multiple was tried.
    Beyond(f64),
}

impl LinearLimit {
    /// The name of the range in tables and JSON, and its multiple of the tolerances.
    #[must_use]
    pub fn named(self) -> (&'static str, f64) {
        match self {
            LinearLimit::From(multiple) => ("from", multiple),
            LinearLimit::UntilUnsolved(multiple) => ("until_unsolved", multiple),
            LinearLimit::Beyond(multiple) => ("beyond", multiple),
        }
    }
}

/// Relative difference of the two standard deviations above which linear theory counts as invalid.
pub const APART: f64 = 0.1;

/// Largest multiple of the tolerances that is tried.
const MOST_MULTIPLE: f64 = 1024.0;
/// Number of bisections between a multiple and its double.
const HALVINGS: usize = 6;

/// A random sample of mechanisms, with everything that its figures need.
struct Sample<'a> {
    scenario: &'a Scenario,
    figures: &'a [TurnFigure],
    family: ScenarioFamily<'a>,
    /// The keys with tolerances, with their limits.
    keys: Vec<(&'a CaseKey, f64)>,
    /// For every mechanism, the deviations of the keys as fractions of their limits.
    draws: Vec<Vec<f64>>,
    by_input: bool,
}

/// The tolerance stacks of all figures of a sensitivity, from `count` random mechanisms.
///
/// # Errors
/// [`ErrorKind::Input`] for a tolerance without a derivative, or if fewer than two random mechanisms can be solved.
pub fn stacks(
    scenario: &Scenario,
    question: &SensitivityQuestion,
    found: &Sensitivity,
    tolerances: &[KeyTolerance],
    (count, seed): (usize, u64),
) -> Result<Vec<ToleranceStack>> {
    let mut places = Vec::with_capacity(tolerances.len());
    for own in tolerances {
        let Some(place) = found.keys.iter().position(|key| key.name == own.key) else {
            let names = found.keys.iter().map(|key| key.name.as_str());
            let help = scenario::words::suggestion(&own.key, names, "`");
            let message = sentences::a_tolerance_has_no_derivative(&own.key);
            return Err(Error::new(ErrorKind::Input, message).help(help));
        };
        places.push(place);
    }
    let keys: Vec<(&CaseKey, f64)> =
        places.iter().zip(tolerances).map(|(k, own)| (&found.keys[*k], own.limit)).collect();
    let asked = StartRequest { without_grid: true, ..question.asked.clone() };
    let family = ScenarioFamily::of(&scenario.text, &scenario.path, asked, false)?;
    let sample = Sample {
        scenario,
        figures: &question.figures,
        family,
        keys,
        draws: draws(tolerances.len(), count, seed),
        by_input: found.by_input,
    };
    let first = sample.at(1.0);
    let mut all = Vec::with_capacity(found.figures.len());
    for (index, own) in found.figures.iter().enumerate() {
        let parts: Vec<f64> =
            places.iter().zip(tolerances).map(|(k, tolerance)| own.by[*k] * tolerance.limit).collect();
        let Some(spread) = Spread::of(&sample, &first, index, &parts, own.sampled.value, 1.0) else {
            let message = sentences::no_sampled_mechanism_can_be_solved(&count);
            return Err(Error::new(ErrorKind::Input, message).help(sentences::GIVE_SMALLER_TOLERANCES));
        };
        all.push(ToleranceStack {
            worst: parts.iter().map(|own| own.abs()).sum(),
            root_sum_square: parts.iter().map(|own| own * own).sum::<f64>().sqrt(),
            linear_deviation: spread.linear,
            sampled_deviation: spread.sampled,
            sampled_shift: spread.mean - own.sampled.value,
            sampled_ends: spread.ends.map(|end| end - own.sampled.value),
            unsolved: spread.unsolved,
            limit: sample.limit(index, &parts, own.sampled.value, &spread),
        });
    }
    Ok(all)
}

/// Uniformly distributed numbers between -1 and 1, determined by the seed.
fn draws(keys: usize, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut one = || (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0;
    (0..count).map(|_| (0..keys).map(|_| one()).collect()).collect()
}

/// Figures of one sampled mechanism; `None` if the mechanism cannot be solved.
type Figures = Option<Vec<f64>>;

impl Sample<'_> {
    /// The figures of all mechanisms with the tolerances times `multiple`.
    fn at(&self, multiple: f64) -> Vec<Figures> {
        made(&self.draws, cores(), |draw| self.solved(draw, multiple).ok(), |_| {})
    }

    fn solved(&self, draw: &[f64], multiple: f64) -> Result<Vec<f64>> {
        let moved = |((key, limit), part): (&(&CaseKey, f64), &f64)| key.value + multiple * limit * part;
        let set = self.keys.iter().zip(draw).map(|(own, part)| (own.0.name.clone(), moved((own, part))));
        let scenario = self.family.member(&set.collect::<Vec<_>>())?;
        let old = &self.scenario.case.grid;
        let grid = match self.by_input {
            true => Grid::of_inputs(scenario.case.crank(), old.inputs.clone()),
            false => Grid::of_times(scenario.case.crank(), old.times.clone()),
        };
        figures(&scenario.case.on(grid)?, self.figures)
    }

    /// Range of tolerances in which linear theory holds for a figure. `first` is the spread at the tolerances times 1.
    fn limit(&self, figure: usize, parts: &[f64], nominal: f64, first: &Spread) -> LinearLimit {
        let mut unsolved = first.unsolved > 0;
        let mut differs = |multiple: f64| {
            let found = self.at(multiple);
            match Spread::of(self, &found, figure, parts, nominal, multiple) {
                Some(spread) if spread.is_apart() => Some(true),
                Some(spread) if spread.unsolved == 0 => Some(false),
                Some(_) | None => {
                    unsolved = true;
                    None
                }
            }
        };
        let begins_apart = first.is_apart();
        let mut multiple = 1.0;
        if begins_apart {
            // Multiples below 1 are tried, down to the reciprocal of the largest multiple.
            while multiple > 1.0 / MOST_MULTIPLE && differs(multiple / 2.0) == Some(true) {
                multiple /= 2.0;
            }
            multiple /= 2.0;
        } else if first.unsolved > 0 {
            return LinearLimit::UntilUnsolved(1.0);
        } else {
            loop {
                match differs(2.0 * multiple) {
                    Some(true) => break,
                    None => return LinearLimit::UntilUnsolved(2.0 * multiple),
                    Some(false) if multiple >= MOST_MULTIPLE / 2.0 => return LinearLimit::Beyond(MOST_MULTIPLE),
                    Some(false) => multiple *= 2.0,
                }
            }
        }
        let (mut low, mut high) = (multiple, 2.0 * multiple);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if differs(middle) == Some(false) { low = middle } else { high = middle }
        }
        LinearLimit::From(high)
    }
}

/// The figures of a case.
fn figures(case: &Case, figures: &[TurnFigure]) -> Result<Vec<f64>> {
    let claims = figures.iter().map(|figure| figure.claim(case)).collect::<Result<Vec<Claim>>>()?;
    let run = solved(case, &claims)?;
    let one = |(figure, claim): (&TurnFigure, &Claim)| Ok(figure.of(&run, &sampled_values(claim, &run)?)?.value);
    figures.iter().zip(&claims).map(one).collect()
}

/// Spread of a figure over a sample.
struct Spread {
    linear: f64,
    sampled: f64,
    mean: f64,
    ends: [f64; 2],
    unsolved: usize,
}

impl Spread {
    /// `parts` are the products of derivative and limit of all keys.
    /// `None` if fewer than two mechanisms could be solved.
    fn of(
        sample: &Sample,
        found: &[Figures],
        figure: usize,
        parts: &[f64],
        nominal: f64,
        multiple: f64,
    ) -> Option<Spread> {
        let both = sample.draws.iter().zip(found).filter_map(|(draw, found)| {
            let change: f64 = draw.iter().zip(parts).map(|(draw, part)| draw * part * multiple).sum();
            Some([nominal + change, found.as_ref()?[figure]])
        });
        let both: Vec<[f64; 2]> = both.collect();
        if both.len() < 2 {
            return None;
        }
        let count = both.len() as f64;
        let mean = |k: usize| both.iter().map(|own| own[k]).sum::<f64>() / count;
        let means = [mean(0), mean(1)];
        let deviation = |k: usize| {
            let squares: f64 = both.iter().map(|own| (own[k] - means[k]).powi(2)).sum();
            (squares / (count - 1.0)).sqrt()
        };
        let ends = both.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], own| {
            [if own[1] < least { own[1] } else { least }, if own[1] > most { own[1] } else { most }]
        });
        let unsolved = found.len() - both.len();
        Some(Spread { linear: deviation(0), sampled: deviation(1), mean: means[1], ends, unsolved })
    }

    fn is_apart(&self) -> bool {
        !((self.sampled - self.linear).abs() <= APART * self.linear)
    }
}
