//! A figure of a whole run: a statistic of one quantity over the instants of the grid, such as the largest reaction.
//!
//! A figure is written `STATISTIC:QUANTITY`, such as `max:joint.A.f_N` or `at=90:drive.torque_N_m`.
//! The quantity is a channel, the magnitude of a vector, or any other text that a [`Claim`] accepts.

use std::fmt;
use std::str::FromStr;

use super::claim::Claim;
use super::formula::refused;
use super::words::suggestion;
use crate::sentences;
use formula::{FormulaGraph, Program, Rounded};
use linkage::case::Case;
use linkage::error::{Error, ErrorKind, Result};
use linkage::input::Input;
use linkage::math::statistics::ascending;
use linkage::math::tally::{LANES, LanePeak, Tally, Weighted};
use linkage::trajectory::Trajectory;

/// How one number follows from the values of a quantity at all instants.
///
/// An extreme is taken over the instants of the grid, without interpolation.
/// A mean is taken over time by the trapezoidal rule. If a turn starts and ends in the same pose, the rule gives each
/// of the two instants half a weight, so this pose does not count twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Statistic {
    /// Largest value.
    Max,
    /// Smallest value.
    Min,
    /// Largest absolute value.
    MaxAbs,
    /// Mean over time.
    Mean,
    /// Root mean square over time.
    Rms,
    /// Largest value minus smallest value.
    Range,
    /// The value at the instant with this input, in degrees or millimetres.
    At(f64),
}

/// The words of the statistics without an input.
const STATISTICS: [(&str, Statistic); 6] = [
    ("max", Statistic::Max),
    ("min", Statistic::Min),
    ("maxabs", Statistic::MaxAbs),
    ("mean", Statistic::Mean),
    ("rms", Statistic::Rms),
    ("range", Statistic::Range),
];

/// The characters before the input in the text of a [`Statistic::At`].
const AT: &str = "at=";

/// Largest difference between the input of a [`Statistic::At`] and the input of the instant that it denotes (degrees or
/// millimetres).
const SAME_INPUT: f64 = 1e-6;

impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, STATISTICS.iter().find(|(_, own)| own == self)) {
            (Statistic::At(input), _) => write!(f, "{AT}{input}"),
            (_, Some((word, _))) => f.write_str(word),
            (_, None) => unreachable!("all other statistics have a word"),
        }
    }
}

/// A statistic of one quantity over the instants of a run.
///
/// ```
/// use linkproof_scenario::{Statistic, TurnFigure};
///
/// let figure: TurnFigure = "max:joint.A.f_N".parse()?;
/// assert_eq!((figure.statistic, figure.quantity.as_str()), (Statistic::Max, "joint.A.f_N"));
/// assert_eq!(figure.to_string(), "max:joint.A.f_N");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TurnFigure {
    /// The statistic.
    pub statistic: Statistic,
    /// The text of the quantity, which [`Claim::parse`] reads.
    pub quantity: String,
}

/// The value of a figure, with the instants that determine it.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledFigure {
    /// The figure, in the unit of its quantity.
    pub value: f64,
    /// The row of the extreme; for a [`Statistic::Range`], the rows of the largest and of the smallest value.
    /// Empty for a mean and a root mean square: these depend on all instants. Of several equal extremes, the first row
    /// counts.
    pub rows: Vec<usize>,
}

impl fmt::Display for TurnFigure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.statistic, self.quantity)
    }
}

impl FromStr for TurnFigure {
    type Err = Error;

    /// # Errors
    /// [`ErrorKind::Input`] for an unknown statistic, or if a part is missing. The quantity is checked by
    /// [`TurnFigure::claim`].
    fn from_str(text: &str) -> Result<Self> {
        let wrong = |message: String, help: String| Error::new(ErrorKind::Input, message).help(help);
        let example = || sentences::WRITE_STATISTIC_AND_QUANTITY.to_string();
        let Some((word, quantity)) = text.split_once(':').filter(|(_, quantity)| !quantity.trim().is_empty()) else {
            return Err(wrong(sentences::is_no_figure(&text), example()));
        };
        let number = word.strip_prefix(AT).map(|number| number.parse::<f64>().ok().filter(|own| own.is_finite()));
        let statistic = match (number, STATISTICS.iter().find(|(own, _)| *own == word)) {
            (Some(Some(input)), _) => Statistic::At(input),
            (Some(None), _) => return Err(wrong(sentences::is_no_figure(&text), example())),
            (None, Some((_, own))) => *own,
            (None, None) => {
                let words = STATISTICS.iter().map(|(own, _)| *own).chain([AT]);
                return Err(wrong(sentences::there_is_no_statistic(&word), suggestion(word, words, "`")));
            }
        };
        Ok(TurnFigure { statistic, quantity: quantity.trim().into() })
    }
}

/// The instants of a grid, prepared for the figures of many runs.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureGrid {
    input: Input,
    inputs: Vec<f64>,
    /// An empty accumulator for a mean: it has the weights of the grid, but no values yet.
    mean: Weighted,
}

impl FigureGrid {
    /// The instants of a grid: times (s), and the inputs that move the mechanism (SI).
    #[must_use]
    pub fn of(times: &[f64], input: Input, inputs: &[f64]) -> FigureGrid {
        FigureGrid { input, inputs: inputs.to_vec(), mean: Weighted::of(&mean_weights(times)) }
    }

    /// An empty accumulator for a statistic of the instants; `None` if no instant has the input of a [`Statistic::At`].
    #[must_use]
    pub fn tally(&self, statistic: Statistic) -> Option<Tally> {
        Some(match statistic {
            Statistic::Max => Tally::Max(LanePeak::NONE),
            Statistic::Min => Tally::Min(LanePeak::NONE),
            Statistic::MaxAbs => Tally::MaxAbs(LanePeak::NONE),
            Statistic::Range => Tally::Range([LanePeak::NONE; 2]),
            Statistic::Mean => Tally::Mean(self.mean.clone()),
            Statistic::Rms => Tally::Rms(self.mean.clone()),
            Statistic::At(input) => {
                let is_there = |own: &f64| (self.input.shown(*own) - input).abs() <= SAME_INPUT;
                Tally::At(self.inputs.iter().position(is_there)?, f64::NAN)
            }
        })
    }
}

impl TurnFigure {
    /// The quantity of the figure in a case.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] for a mistake in the text of the quantity, with its position.
    pub fn claim(&self, case: &Case) -> Result<Claim> {
        Claim::parse(&self.quantity, case).map_err(|fault| refused("figure", &self.quantity, &fault))
    }

    /// The figure of a solved run, from the values of its quantity at the instants of the run.
    ///
    /// # Errors
    /// [`ErrorKind::Input`] if a value is not a number, if there is no instant, or if no instant has the input of a
    /// [`Statistic::At`].
    pub fn of(&self, run: &Trajectory, values: &[f64]) -> Result<SampledFigure> {
        self.on(&FigureGrid::of(run.times(), run.input(), run.inputs()), values)
    }

    /// The figure from the values of its quantity at the instants of a grid.
    ///
    /// # Errors
    /// The errors of [`TurnFigure::of`].
    pub fn on(&self, grid: &FigureGrid, values: &[f64]) -> Result<SampledFigure> {
        let fault = |message: String, help: &'static str| Err(Error::new(ErrorKind::Input, message).help(help));
        if values.is_empty() {
            return fault(sentences::the_figure_has_no_instant(&self), sentences::GIVE_THE_GRID_INSTANTS);
        }
        if let Some(row) = values.iter().position(|value| !value.is_finite()) {
            let message = sentences::the_quantity_has_no_value(&self.quantity, &grid.input.at(grid.inputs[row]));
            return fault(message, sentences::LEAVE_THAT_INSTANT_OUT);
        }
        let Some(mut tally) = grid.tally(self.statistic) else {
            let Statistic::At(input) = self.statistic else { unreachable!("other statistics need no input") };
            let message = sentences::no_instant_has_the_input(&input, &grid.input.shown_in().0);
            return fault(message, sentences::NAME_AN_INSTANT_OF_THE_GRID);
        };
        for row in (0..values.len()).step_by(LANES) {
            // The last group may have fewer values than lanes. Copies of the last value fill the remaining lanes of
            // this group.
            tally.add(row, &std::array::from_fn(|lane| values[(row + lane).min(values.len() - 1)]));
        }
        Ok(SampledFigure { value: tally.value(), rows: tally.rows().into_iter().flatten().collect() })
    }

    /// The figure of a solved run. The run must contain all channels of the figure's quantity.
    ///
    /// # Errors
    /// The errors of [`TurnFigure::of`] and of [`sampled_values`].
    pub fn sampled(&self, claim: &Claim, run: &Trajectory) -> Result<SampledFigure> {
        self.of(run, &sampled_values(claim, run)?)
    }
}

/// Weights of the mean over time by the trapezoidal rule, one for each time (s); their sum is 1.
/// Times may be in any order. A single instant has the weight 1.
#[must_use]
pub fn mean_weights(times: &[f64]) -> Vec<f64> {
    let order = ascending(times);
    let mut weights = vec![0.0; times.len()];
    for pair in order.windows(2) {
        let half = (times[pair[1]] - times[pair[0]]) / 2.0;
        weights[pair[0]] += half;
        weights[pair[1]] += half;
    }
    let sum: f64 = weights.iter().sum();
    match sum > 0.0 {
        true => weights.iter().map(|weight| weight / sum).collect(),
        false => vec![1.0 / times.len() as f64; times.len()],
    }
}

/// The values of a claim at the instants of a run, in the unit of the claim. A value outside the domain of an operation
/// is NaN.
///
/// # Errors
/// [`ErrorKind::Input`] for a claim with a figure of the whole mechanism, or if the run lacks a channel of the claim.
pub fn sampled_values(claim: &Claim, run: &Trajectory) -> Result<Vec<f64>> {
    let wrong = |message: String, help: &'static str| Error::new(ErrorKind::Input, message).help(help);
    if !claim.figures.is_empty() {
        return Err(wrong(sentences::is_one_number_for_all(&claim.text), sentences::NAME_A_CHANNEL_FOR_A_FIGURE));
    }
    let mut columns: Vec<Vec<f64>> = Vec::with_capacity(claim.channels.len());
    for (name, printed) in &claim.channels {
        let missing = || wrong(sentences::the_run_lacks(&name), sentences::SOLVE_WITH_THE_CHANNELS_OF_THE_FIGURE);
        let own = run.column(&printed.channel).ok_or_else(missing)?;
        let other = match printed.other_component() {
            Some(other) => Some(run.column(&other).ok_or_else(missing)?),
            None => None,
        };
        columns.push((0..own.len()).map(|row| printed.from_si(own[row], other.map(|other| other[row]))).collect());
    }
    let names: Vec<&str> = claim.channels.iter().map(|(name, _)| name.as_str()).collect();
    let mut graph = FormulaGraph::new(&names, 0);
    let node = graph.add(&claim.tree).map_err(|fault| refused("figure", &claim.text, &fault))?;
    let mut program = Program::of(&graph, &[node]);
    let mut values = Vec::with_capacity(run.times().len());
    for row in 0..run.times().len() {
        let inputs: Vec<Rounded> = columns.iter().map(|column| Rounded::exact(column[row])).collect();
        values.push(program.run(&inputs)[0].known());
    }
    Ok(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use linkage::trajectory::Channel;

    fn run(times: &[f64], values: &[f64]) -> Trajectory {
        let channels = vec![Channel::named("drive.torque_N_m").unwrap()];
        let inputs = times.iter().map(|t| t.to_radians()).collect();
        Trajectory::new(times.to_vec(), inputs, channels, vec![values.to_vec()]).unwrap()
    }

    fn figure(text: &str, run: &Trajectory) -> SampledFigure {
        let claim = Claim::of_channels("drive.torque_N_m", run.channels()).unwrap();
        text.parse::<TurnFigure>().unwrap().sampled(&claim, run).unwrap()
    }

    #[test]
    fn every_statistic_of_a_column() {
        let run = run(&[0.0, 1.0, 2.0, 4.0], &[1.0, -5.0, 3.0, 1.0]);
        let of = |statistic: &str| {
            let found = figure(&format!("{statistic}:drive.torque_N_m"), &run);
            (found.value, found.rows)
        };
        assert_eq!(of("max"), (3.0, vec![2]));
        assert_eq!(of("min"), (-5.0, vec![1]));
        assert_eq!(of("maxabs"), (5.0, vec![1]));
        assert_eq!(of("range"), (8.0, vec![2, 1]));
        // Trapezoids: (1 - 5)/2 + (-5 + 3)/2 + (3 + 1)/2 * 2 = 1, over 4 s.
        assert_eq!(of("mean"), (0.25, Vec::new()));
        // Trapezoids of the squares: 13 + 17 + 10 = 40, over 4 s.
        assert!((of("rms").0 - 10f64.sqrt()).abs() < 1e-15);
        assert_eq!(of("at=2"), (3.0, vec![2]));
    }

    #[test]
    fn figures_print_as_they_are_written() {
        for text in ["max:joint.A.f_N", "at=-12.5:point.B.x_mm", "rms:joint.A.fx_N - joint.A.fy_N"] {
            assert_eq!(text.parse::<TurnFigure>().unwrap().to_string(), text);
        }
        for wrong in ["joint.A.f_N", "max:", "most:joint.A.f_N", "at:joint.A.f_N", "at=x:joint.A.f_N", "at=nan:a"] {
            assert!(wrong.parse::<TurnFigure>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_figure_without_a_value_is_refused() {
        let run = run(&[0.0, 1.0], &[1.0, 0.0]);
        let claim = Claim::of_channels("1 / drive.torque_N_m", run.channels()).unwrap();
        let found = "max:x".parse::<TurnFigure>().unwrap().sampled(&claim, &run).unwrap_err();
        assert!(found.to_string().contains("no value"), "{found}");
        let found = "at=7:x".parse::<TurnFigure>().unwrap().of(&run, &[1.0, 2.0]).unwrap_err();
        assert!(found.to_string().contains("no instant"), "{found}");
    }

    #[test]
    fn the_order_of_the_times_does_not_change_a_mean() {
        assert_eq!(mean_weights(&[4.0, 0.0, 1.0]), [0.375, 0.125, 0.5]);
        assert_eq!(mean_weights(&[3.0]), [1.0]);
        assert!(mean_weights(&[]).is_empty());
    }
}
